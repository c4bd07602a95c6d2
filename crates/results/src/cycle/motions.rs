//! Motions of the whole mesh as limit cycles.

use super::branch::{
    BranchRow, BranchRows, BranchSummary, MotionBranch, StabilityChangeSummary, SteppedRow,
};
use super::record::{ContactNode, MotionRecord};
use super::summary::{
    CycleMotion, CycleName, ModeOfCycle, ModeSummary, SoughtCycle, SoundSummary, SteppedMotion,
};
use super::verdicts::{ConfirmationSummary, KnownStability, Perturbation, StabilitySummary, known};
use super::{CycleReport, MotionSearch};
use crate::npz::NpzArchive;
use crate::summary::{MeanPowers, StatusFractions, present};
use frictionsim_chart::extremes;
use frictionsim_physics::contact::ContactInterface;
use frictionsim_physics::cycle::periodic::{
    BranchMotion, ContactInstant, FloquetMultiplier, FloquetMultipliers, PeriodicBranch,
    PeriodicMotion, REMAINDER, Sound, velocity_level,
};
use frictionsim_physics::cycle::{Confirmation, CyclePowers, PhasePoint, Verdict};
use std::f64::consts::TAU;
use std::io;

/// A limit cycle and what is known of it.
#[derive(Clone, Debug)]
pub struct FoundCycle {
    /// The motion.
    pub motion: PeriodicMotion,
    /// What its flat faces radiate, of a body that has any.
    pub sound: Option<Sound>,
    /// Harmonics in which it is told.
    pub harmonic_count: usize,
    /// Its multipliers, where they were asked for, or why there are none.
    pub stability: Option<Result<FloquetMultipliers, String>>,
    /// A transient that started beside it, where one was asked for.
    pub confirmation: Option<Confirmation>,
    /// The branch through it over the parameter of the case, where one was asked for.
    pub branch: Option<PeriodicBranch>,
}

/// What the search from one mode has led to.
#[derive(Clone, Debug)]
pub struct PeriodicResult {
    /// The mode.
    pub mode: ModeSummary,
    /// The cycle, or why there is none.
    pub outcome: Result<FoundCycle, String>,
    /// Mode that has led to the same cycle before.
    pub same_as: Option<usize>,
    /// Case key and value at which the search has started from its mode, where no mode grows at the case's own.
    pub start: Option<(&'static str, f64)>,
    /// Wall time, s.
    pub wall_s: f64,
}

impl MotionSearch {
    /// Whether no mode looked at grows at the case's own operating point.
    pub(super) fn is_stable(&self) -> bool {
        self.least_stable.is_none_or(|mode| mode.growth_rate_per_s <= 0.0)
    }
}

/// The powers of a body of such a thickness, W.
pub(super) fn mean_powers(powers: &CyclePowers, thickness: f64) -> MeanPowers {
    let powers = powers.scaled(thickness);
    MeanPowers::of(&powers.contact, powers.material_damping)
}

/// What a multiplier is.
fn perturbation(own: &FloquetMultiplier) -> Perturbation {
    Perturbation {
        growth_rate_per_s: own.growth_rate,
        beat_hz: Some(own.beat_hz),
        modulus: Some(own.multiplier.norm()),
        argument_rad: Some(own.multiplier.arg()),
        leads_to: (own.verdict() == Verdict::Unstable).then(|| own.kind().to_owned()),
        uncertainty_per_s: present(own.uncertainty),
        ..Perturbation::default()
    }
}

fn stability(found: &Result<FloquetMultipliers, String>) -> StabilitySummary {
    match found {
        Err(error) => StabilitySummary::Failed { error: error.clone() },
        Ok(found) => StabilitySummary::Known(Box::new(KnownStability {
            shift: found.shift.map(|shift| shift.norm()),
            ..KnownStability::new(found.verdict(), found.leading().map(perturbation))
        })),
    }
}

impl FoundCycle {
    fn summary(&self, report: &CycleReport<'_>, search: &MotionSearch) -> CycleMotion {
        let motion = &self.motion;
        let told = motion.harmonics.iter().take(self.harmonic_count);
        let threshold = self.branch.as_ref().and_then(PeriodicBranch::threshold);
        CycleMotion {
            main_frequency_hz: motion.frequency_hz,
            status: StatusFractions::of(motion.fractions),
            power_w: mean_powers(&motion.powers, report.thickness),
            balance_residual: motion.powers.balance_residual(),
            amplitude_m: Some(motion.amplitude),
            velocity_level_db: Some(velocity_level(motion.velocity)),
            harmonics: told.clone().map(|harmonic| harmonic.amplitude[1]).collect(),
            stepped: Some(SteppedMotion {
                residual: motion.residual,
                periods: motion.periods,
                steps: motion.steps,
                contact_node: report
                    .body
                    .mesh
                    .node_label(search.interface.nodes[motion.node] as usize),
                kick_velocity: threshold.map(PeriodicMotion::kick_velocity),
                sound: self.sound.as_ref().map(|sound| SoundSummary {
                    power_w: sound.power(),
                    level_db: sound.level(),
                    area_m2: sound.area,
                    harmonics_w: sound.harmonics.clone(),
                }),
                harmonic_count: self.harmonic_count,
                harmonic_remainder: told.clone().next_back().map_or(1.0, |last| last.remainder),
            }),
        }
    }
}

fn branch_summary(branch: &PeriodicBranch) -> BranchSummary {
    let in_units = |value: f64| branch.parameter.in_key_units(value);
    let coexistence = branch.coexistence().into_iter();
    let changes = branch.stability_changes().into_iter();
    BranchSummary {
        key: branch.parameter.key().to_owned(),
        cycles: branch.motions.len(),
        range: branch.range().map(|ends| ends.map(in_units)),
        folds: branch.folds().into_iter().map(in_units).collect(),
        ends: branch.ends.map(|end| end.describe().to_owned()),
        stability_changes: changes.map(|at| StabilityChangeSummary::At(in_units(at))).collect(),
        waves: None,
        motions: Some(MotionBranch {
            onsets: branch.onsets.iter().map(|&at| in_units(at)).collect(),
            coexistence: coexistence.map(|ends| ends.map(in_units)).collect(),
        }),
    }
}

fn branch_row(branch: &PeriodicBranch, own: &BranchMotion, thickness: f64) -> BranchRow {
    let motion = &own.motion;
    BranchRow {
        value: branch.parameter.in_key_units(own.value),
        harmonic: None,
        main_frequency_hz: motion.frequency_hz,
        fractions: motion.fractions,
        powers: mean_powers(&motion.powers, thickness),
        amplitude_m: motion.amplitude,
        balance_residual: motion.powers.scaled(thickness).balance_residual(),
        growth_rate: own.growth_rate(),
        verdict: known(&own.stability).map(FloquetMultipliers::verdict),
        stepped: Some(SteppedRow {
            velocity_level_db: velocity_level(motion.velocity),
            residual: motion.residual,
            periods: motion.periods,
            fold: own.is_fold,
        }),
    }
}

impl PeriodicResult {
    /// The cycle, where this mode is the first to lead to it.
    pub fn own(&self) -> Option<&FoundCycle> {
        let found = self.outcome.as_ref().ok();
        found.filter(|_| self.same_as.is_none())
    }

    /// Part of a file name: `mode15`.
    pub fn tag(&self) -> String {
        format!("mode{}", self.mode.mode)
    }

    /// What the summary says of it.
    pub(super) fn sought(&self, report: &CycleReport<'_>, search: &MotionSearch) -> SoughtCycle {
        let found = self.own();
        SoughtCycle {
            name: CycleName::Mode(ModeOfCycle {
                mode: self.mode,
                same_as: self.same_as,
                sought_from: self.start.map(|(_, value)| value),
            }),
            wall_s: self.wall_s,
            cycle: found.map(|found| found.summary(report, search)),
            absent: None,
            error: self.outcome.as_ref().err().cloned(),
            confirmation: found.and_then(|found| {
                let run = found.confirmation.as_ref()?;
                let agrees = run.agrees_with(&found.motion);
                Some(ConfirmationSummary::ran(run, agrees, report.thickness))
            }),
            stability: found.and_then(|found| Some(stability(found.stability.as_ref()?))),
            branch: found.and_then(|found| found.branch.as_ref().map(branch_summary)),
        }
    }

    /// That the harmonics asked for do not tell the motion, if so, and how many would.
    pub(super) fn coarse_harmonics(&self) -> Option<String> {
        let found = self.own()?;
        let left = found.motion.harmonics[..found.harmonic_count].last()?.remainder;
        let enough = found.motion.harmonics_within(REMAINDER);
        (found.harmonic_count < enough).then(|| {
            format!(
                "{}: {} harmonics leave {left:.1e} of the motion of the contact: {enough} leave \
                less than a thousandth (raise \
                 cycle.harmonic_count, or leave it out)",
                self.mode, found.harmonic_count,
            )
        })
    }

    /// The rows of its branch.
    pub(super) fn branch_rows(&self, thickness: f64) -> Option<BranchRows> {
        let branch = self.own()?.branch.as_ref()?;
        let rows = branch.motions.iter().map(|own| branch_row(branch, own, thickness));
        Some(BranchRows {
            key: branch.parameter.key(),
            own_value: branch.parameter.in_key_units(branch.own),
            threshold: branch.threshold().map(|own| [own.amplitude, own.kick_velocity()]),
            rows: rows.collect(),
        })
    }

    /// What the tables and figures show of its cycle and branch.
    pub(super) fn record(
        &self,
        report: &CycleReport<'_>,
        search: &MotionSearch,
    ) -> Option<MotionRecord> {
        let found = self.own()?;
        let motion = &found.motion;
        let first = motion.instants.first()?;
        let nodes = search.interface.nodes.iter().enumerate().map(|(place, &node)| {
            let (node, body) = (node as usize, &report.body);
            contact_node(motion, place, (body.mesh.node_label(node), body.position(node)))
        });
        let exponents = known(&found.stability)
            .map(|found| found.multipliers.iter().map(|own| (None, perturbation(own))).collect());
        Some(MotionRecord {
            tag: self.tag(),
            diameters: 0,
            mode: self.mode.mode,
            frequency_hz: motion.frequency_hz,
            history: motion.instants.iter().map(|at| point(motion, at, motion.node)).collect(),
            edge: (0..search.interface.len()).map(|node| point(motion, first, node)).collect(),
            status: motion.instants.iter().flat_map(|at| at.status.iter().copied()).collect(),
            node: motion.node,
            counterface_speed: motion.counterface_speed,
            friction_coefficient: motion.friction_coefficient,
            nodes: nodes.collect(),
            harmonics: motion.harmonics.iter().take(found.harmonic_count).copied().collect(),
            fields: motion.frames.first().map_or_else(Default::default, |own| own.fields.clone()),
            exponents,
            branch: self.branch_rows(report.thickness),
        })
    }
}

/// Contact and motion of a contact node at one instant, by its place among those of the contact.
fn point(motion: &PeriodicMotion, at: &ContactInstant, node: usize) -> PhasePoint {
    PhasePoint {
        phase: TAU * at.time * motion.frequency_hz,
        time: at.time,
        status: at.status[node],
        pressure: at.pressure[node],
        shear: at.shear[node],
        displacement: at.displacement[node],
        velocity: at.velocity[node],
    }
}

/// Means and amplitudes of a contact node, by its place among those of the contact.
fn contact_node(motion: &PeriodicMotion, i: usize, node: (usize, [f64; 3])) -> ContactNode {
    let instants = &motion.instants;
    let mean = |values: &dyn Fn(&ContactInstant) -> f64| {
        instants.iter().map(values).sum::<f64>() / instants.len() as f64
    };
    let half_range = |component: usize| {
        let (low, high) = extremes(instants.iter().map(|at| at.displacement[i][component]));
        0.5 * (high - low)
    };
    ContactNode {
        node: node.0,
        place: node.1,
        shares: motion.shares[i],
        mean_pressure: mean(&|at| at.pressure[i]),
        mean_shear: mean(&|at| at.shear[i]),
        amplitude: [0, 1].map(half_range),
    }
}

/// The arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)`, `pressure_pa (F, N)`, `shear_pa (F, N)`, `u_n_m (F, N)`
/// and `u_t_m (F, N)` for `F` instants and `N` contact nodes, with the codes of `status`, as in the `contact.npz` of a
/// transient.
pub(super) fn encode_contact(
    interface: &ContactInterface,
    motion: &PeriodicMotion,
) -> io::Result<Vec<u8>> {
    let instants = &motion.instants;
    let shape = [instants.len(), interface.len()];
    let mut archive = NpzArchive::default();
    archive.array("time_s", &shape[..1], instants.iter().map(|at| at.time))?;
    archive.array("angle_rad", &shape[1..], interface.angles.iter().copied())?;
    let status = instants.iter().flat_map(|at| &at.status);
    archive.array("status", &shape, status.map(|status| *status as u8))?;
    let pressure = instants.iter().flat_map(|at| at.pressure.iter().copied());
    archive.array("pressure_pa", &shape, pressure)?;
    let shear = instants.iter().flat_map(|at| at.shear.iter().copied());
    archive.array("shear_pa", &shape, shear)?;
    for (component, name) in ["u_n_m", "u_t_m"].into_iter().enumerate() {
        let motion = instants.iter().flat_map(|at| &at.displacement);
        archive.array(name, &shape, motion.map(|u| u[component]))?;
    }
    archive.status_codes()?;
    archive.finish()
}
