//! Columns of limit cycles, and the document of a search.

use super::branch::{ALONG, BRANCH};
use super::record::{CONTACT_NODES, ContactNode, CycleMotion};
use super::summary::{CycleSummary, SoughtCycle};
use super::two_waves::{SHOWN, TwoWaveSummary};
use super::{found::contact_node, verdicts::EXPONENTS};
use crate::common::*;
use crate::summary::STATUS;
use frictionsim_physics::cycle::periodic::MotionHarmonic;

/// Number and frequency of a harmonic, and its motion.
type Harmonic = (usize, f64, MotionHarmonic);

columns! {
    /// What leads to a cycle.
    pub(crate) NAMES: own as SoughtCycle;
    mode: "number of the mode that leads to it, of a body without rotating waves"
        = own.name.mode().map(|own| own.mode.mode), IfAny "mode" Count;
    harmonic: "nodal diameters of a wave" = own.name.wave().map(|own| own.harmonic), IfAny "n" Count;
    onset: "onset of that harmonic at which the wave is born, from 1"
        = own.name.wave().map(|own| own.onset), IfAny "onset" Count;

    /// What a cycle is.
    pub(crate) MOTION: own as SoughtCycle;
    main_frequency_hz: "frequency" = own.of(|cycle| Some(cycle.main_frequency_hz)), Always "main frequency" Fixed(2);
    amplitude_m: "amplitude along the counterface"
        = own.of(|cycle| cycle.amplitude_m), Always "amplitude" Scientific(3);

    /// Where its power goes.
    pub(crate) POWERS: power as MeanPowers;
    external_w: "power of the counterface" = power.external, Always "power of the counterface" Fixed(2);
    stick_w: "power given to the body by nodes that stick" = power.stick, Always "while sticking" Fixed(2);
    slide_w: "power given to the body by nodes that slide" = power.slide, Always "while sliding" Fixed(2);
    contact_dissipated_w: "power lost to friction"
        = power.contact_dissipated, Always "dissipated in the contact" Fixed(2);
    material_damping_w: "power lost in the body" = power.material_damping, Always "material damping" Fixed(2);
    normal_contact_w: "power of the normal contact forces" = power.normal_contact, Always "normal contact" Fixed(2);

    /// How well its powers balance.
    pub(crate) BALANCE: own as SoughtCycle;
    balance_residual: "residual of the energy balance, relative to the power of the counterface"
        = own.of(|cycle| Some(cycle.balance_residual)), Always "balance" Scientific(1);

    /// What is known of it.
    pub(crate) KNOWN: own as SoughtCycle;
    velocity_level_db: "level of the velocity, root mean square over time and mass, over 5e-8 m/s"
        = own.of(|cycle| cycle.velocity_level_db), IfAny "velocity level" Fixed(1);
    sound_power_db: "level of the sound power over 1e-12 W, estimated"
        = own.of(|cycle| Some(cycle.stepped.as_ref()?.sound.as_ref()?.level_db)),
        IfAny "sound power" Fixed(1);
    stable: "whether small perturbations decay; empty where that is undecided or was not asked for"
        = own.known().and_then(|known| known.is_stable), IfAny "stable" Plain;
    growth_rate_per_s: "growth rate of the leading perturbation"
        = own.known().and_then(|known| Some(known.leading.as_ref()?.growth_rate_per_s)),
        IfAny "leading growth" Fixed(1);
    kick_velocity: "velocity of a kick, m/s, beyond which stable sliding tips into the cycle"
        = own.of(|cycle| cycle.stepped.as_ref()?.kick_velocity),
        IfAny "kick that tips sliding (m/s)" Scientific(3);

    /// Why there is no cycle.
    pub(crate) ERRORS: own as SoughtCycle;
    error: "why none was found" = own.error.clone();

    /// What leads to a cycle, for people.
    BESIDE: own as SoughtCycle;
    phases = own.name.wave().map(|own| own.phases).filter(|&phases| phases > 0), IfAny "phases" Count;
    critical = own.name.wave().and_then(|own| own.critical_friction), IfAny "grows above" Fixed(5);
    mode_at = own.name.mode().and_then(|own| own.sought_from), IfAny "sought from" Plain;
    mode_hz = own.name.mode().map(|own| own.mode.mode_frequency_hz), IfAny "its frequency" Fixed(2);
    mode_per_s = own.name.mode().map(|own| own.mode.growth_rate_per_s), IfAny "its growth rate" Fixed(1);

    /// What a transient says, and why there is none, for people.
    SAID: own as SoughtCycle;
    transient_hz = own.run().and_then(|run| run.main_frequency_hz), IfAny "transient from it" Fixed(2);
    stays = own.agrees(), IfAny "a transient stays on it" Plain;
    absence = own.absence(), IfAny "why there is none" Plain;

    /// A contact node at one instant.
    pub(crate) HISTORY: row as PhasePoint;
    phase_rad: "phase" = row.phase;
    time_s: "time" = row.time;
    status: "stick, slip or open" = row.status.name();
    pressure_pa: "contact pressure" = row.pressure;
    shear_pa: "friction traction on the body, along the rotation or the node's tangent" = row.shear;

    /// Its motion on the disc of a wave.
    pub(crate) WAVE_PATH: row as PhasePoint;
    u_r_m: "radial displacement" = row.displacement[0];
    u_theta_m: "tangential displacement" = row.displacement[1];
    v_r_m_per_s: "radial velocity" = row.velocity[0];
    v_theta_m_per_s: "tangential velocity" = row.velocity[1];

    /// Its motion on any other body.
    pub(crate) PATH: row as PhasePoint;
    u_n_m: "displacement along the normal" = row.displacement[0];
    u_t_m: "displacement along the counterface" = row.displacement[1];
    v_n_m_per_s: "velocity along the normal" = row.velocity[0];
    v_t_m_per_s: "velocity along the counterface" = row.velocity[1];

    /// A harmonic in time.
    pub(crate) HARMONICS: row as Harmonic;
    harmonic: "number of the harmonic" = row.0;
    frequency_hz: "its frequency" = row.1;
    amplitude_n_m: "amplitude along the normal, root mean square over the contact nodes" = row.2.amplitude[0];
    amplitude_t_m: "amplitude along the counterface" = row.2.amplitude[1];
    remainder: "share of the vibration that the harmonics up to this one leave" = row.2.remainder;
}

impl SoughtCycle {
    /// Its tables; none where there is no cycle. `interface` is the contact of a motion of the whole mesh.
    pub(super) fn tables(
        &self,
        body: &ShownBody<'_>,
        interface: Option<&ContactInterface>,
    ) -> Vec<Table> {
        if self.cycle.is_none() {
            return Vec::new();
        }
        let table = |what: &str| Table::new(format!("{what}-{}.csv", self.name.tag()), "");
        let key = self.branch.as_ref().map(|branch| branch.key.as_str());
        let mut tables = Vec::new();
        let (history, motion) = (self.history(), &self.motion);
        if !history.is_empty() {
            let path = if self.is_wave() { WAVE_PATH } else { PATH };
            let table = table("cycle").columns(HISTORY, &history);
            tables.push(table.columns(path, &history));
        }
        if let Some(interface) = interface {
            let nodes = 0..interface.len();
            let nodes = nodes.map(|node| contact_node(motion, node, body, interface));
            let nodes: Vec<ContactNode> = nodes.collect();
            let (plane, solid) = const { parted(CONTACT_NODES, "z_m") };
            let flat = const { parted(CONTACT_NODES, "stick").1 };
            let rest = if body.is_solid() { solid } else { flat };
            tables.push(table("contact").columns(plane, &nodes).columns(rest, &nodes));
        }
        if !motion.harmonics.is_empty() {
            let numbered = motion.harmonics.iter().zip(1..);
            let rows = numbered.map(|(row, k)| (k, k as f64 * motion.frequency_hz, *row));
            tables.push(table("harmonics").columns(HARMONICS, rows));
        }
        if let Some(exponents) = &self.exponents {
            let mut table = table("stability");
            if self.is_wave() {
                let values = exponents.iter().map(|row| row.0);
                table = table.column(key.unwrap_or("point"), None, values);
            }
            let others: &[&str] = match self.is_wave() {
                true => &["beat_hz", "modulus", "argument_rad"],
                false => &["class", "wave_frequency_rad_per_s", "harmonic", "frequency_hz"],
            };
            let table = table.columns(EXPONENTS, exponents.iter().map(|row| &row.1));
            tables.push(without_empty(table, others));
        }
        if let Some(branch) = &self.branch {
            let rows = &branch.rows;
            let others: &[&str] = match self.is_wave() {
                true => &["velocity_level_db", "stability", "residual", "periods", "fold"],
                false => &["harmonic"],
            };
            let table = table("branch")
                .column(&branch.key, None, rows.iter().map(|row| row.value))
                .columns(BRANCH, rows)
                .columns(STATUS, rows.iter().map(|row| row.motion.status))
                .columns(POWERS, rows.iter().map(|row| row.motion.power_w))
                .columns(ALONG, rows);
            tables.push(without_empty(table, others));
        }
        tables
    }
}

/// A table without those of these columns in which no row has anything.
fn without_empty(table: Table, keys: &[&str]) -> Table {
    keys.iter().fold(table, |table, key| table.without_empty(key))
}

impl SoughtCycle {
    /// A quantity of the cycle, where there is one.
    fn of<T>(&self, of: impl Fn(&CycleMotion) -> Option<T>) -> Option<T> {
        of(self.cycle.as_ref()?)
    }

    /// Why there is no cycle of its own.
    fn absence(&self) -> Option<String> {
        let same = self.name.mode().and_then(|own| own.same_as);
        let same = same.map(|other| format!("the cycle of mode {other}"));
        self.error.clone().or(self.absent.clone()).or(same)
    }

    /// What decides, in a line.
    fn fact(&self) -> (String, String) {
        let Some(cycle) = &self.cycle else {
            return (self.name.to_string(), self.absence().unwrap_or_default());
        };
        let verdict = self.known().map_or(String::new(), |known| format!(", {}", known.verdict));
        let text = format!("{} Hz{verdict}", fixed(cycle.main_frequency_hz, 2));
        (self.name.to_string(), text)
    }
}

impl CycleSummary {
    /// Tables and sentences of a search.
    pub fn document(&self) -> Document {
        let cycles = &self.cycles;
        let found = || cycles.iter().filter(|own| own.cycle.is_some());
        let status = |own: &SoughtCycle| own.of(|cycle| Some(cycle.status));
        let power = |own: &SoughtCycle| own.of(|cycle| Some(cycle.power_w));
        let motions = Table::new("", "Limit cycles at the case's own operating point")
            .columns(NAMES, cycles)
            .columns(BESIDE, cycles)
            .columns(MOTION, cycles)
            .group("", "", STATUS, cycles.iter().map(status))
            .columns(KNOWN, cycles)
            .columns(SAID, cycles);
        let powers = Table::new("", "Their powers")
            .columns(NAMES, found())
            .group("", "", POWERS, found().map(power))
            .columns(BALANCE, found());
        let pairs_of_waves =
            Table::new("", "Motions of two frequencies").columns(SHOWN, &self.two_waves);
        let file = Table::new("cycle.csv", "")
            .columns(NAMES, cycles)
            .columns(MOTION, cycles)
            .group("", "", STATUS, cycles.iter().map(status))
            .group("", "", POWERS, cycles.iter().map(power))
            .columns(BALANCE, cycles)
            .columns(KNOWN, cycles)
            .columns(ERRORS, cycles);
        let results = Section::new("Results");
        let results = match self.steady_sliding_stable && found().next().is_none() {
            true => results,
            false => results.facts(cycles.iter().map(SoughtCycle::fact)).tables([
                motions,
                self.extent.table(powers),
                self.extent.table(pairs_of_waves),
            ]),
        };
        let names = ["status", "contact", "history", "orbit", "harmonics", "velocity", "shear"];
        let pairs = self.two_waves.iter().filter_map(TwoWaveSummary::ends_text);
        Document::new("Limit cycles")
            .section(results)
            .section(
                Section::new("Limit cycles")
                    .text(cycles.iter().flat_map(|own| own.sentences(self.extent)))
                    .figures(names),
            )
            .section(
                Section::new("Branches")
                    .text(cycles.iter().filter_map(SoughtCycle::branch_sentence))
                    .text(pairs)
                    .figures(["branch"]),
            )
            .file(file)
            .notes(&self.notes)
    }
}
