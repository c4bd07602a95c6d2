//! Motions of two frequencies: words, table, summary, curves.

use frictionsim_chart::{INK, Line, Stroke};
use frictionsim_output::{Described, Table, columns, significant};
use frictionsim_physics::cycle::periodic::MotionFrame;
use frictionsim_physics::cycle::{BranchEnd, Measured, TwoWaveBranch, TwoWaveMotion};
use serde::Serialize;
use std::f64::consts::TAU;

/// What two waves that may live together come to.
#[derive(Clone, Debug)]
pub struct TwoWaveResult {
    /// Harmonics of the wave that loses its stability and of the one that grows on it.
    pub harmonics: [usize; 2],
    /// Their motion, or why there is none.
    pub outcome: Result<FoundTwoWaves, String>,
}

/// A motion of two frequencies, and its branch.
#[derive(Clone, Debug)]
pub struct FoundTwoWaves {
    /// The motion.
    pub motion: TwoWaveMotion,
    /// Points along both phases.
    pub sides: [usize; 2],
    /// A transient that started on it.
    pub confirmation: Option<Measured>,
    /// Whether that still has both frequencies within a thousandth.
    pub is_confirmed: bool,
    /// Its branch over the case's parameter.
    pub branch: Option<TwoWaveBranch>,
    /// The whole field over one period of the first wave; the second is elsewhere by then.
    pub frames: Vec<MotionFrame>,
}

/// A motion of two frequencies in the summary.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct TwoWaveSummary {
    /// Harmonics of both waves.
    pub harmonics: [usize; 2],
    /// Frequencies, Hz.
    pub frequencies_hz: Option<[f64; 2]>,
    /// Amplitudes of the tangential displacement of the edge, m.
    pub amplitudes_m: Option<[f64; 2]>,
    /// Fractions of the edge that stick, slip, are open, over time.
    pub status: Option<[f64; 3]>,
    /// Points along both phases.
    pub points: Option<[usize; 2]>,
    /// Power of the rotor, W.
    pub external_w: Option<f64>,
    /// Residual of the energy balance, relative to it.
    pub balance_residual: Option<f64>,
    /// Frequencies of a transient that started on it, Hz.
    pub transient_frequencies_hz: Option<[f64; 2]>,
    /// Whether these are its own within a thousandth.
    pub is_confirmed: Option<bool>,
    /// Values of the parameter at which the weaker wave vanishes, in units of its key.
    pub births: Vec<f64>,
    /// Why the branch ends, at either end.
    pub ends: Option<[String; 2]>,
    /// Why there is none.
    pub error: Option<String>,
}

/// A motion of a branch: the parameter, the motion, the thickness.
type Row = (f64, TwoWaveMotion, f64);

columns! {
    /// A motion of two waves, behind the parameter.
    pub(crate) TWO_WAVES: row as Row;
    frequency_1_hz: "frequency of the first wave" = row.1.frequencies_hz()[0];
    frequency_2_hz: "frequency of the second" = row.1.frequencies_hz()[1];
    amplitude_1_m: "amplitude of the first wave along the edge" = row.1.amplitudes[0];
    amplitude_2_m: "amplitude of the second" = row.1.amplitudes[1];
    stick: "fraction of the edge that sticks" = row.1.fractions[0];
    slip: "fraction that slips" = row.1.fractions[1];
    open: "fraction that is open" = row.1.fractions[2];
    external_w: "power of the rotor" = row.1.powers.contact.external * row.2;
    balance_residual: "residual of the energy balance, relative to it"
        = row.1.powers.balance_residual();
}

columns! {
    /// A motion of two waves for people.
    pub(super) SHOWN: own as TwoWaveSummary;
    waves = own.name(), Always "waves" Plain;
    first_hz = own.frequencies_hz.map(|f| f[0]), Always "first frequency" Fixed(2);
    second_hz = own.frequencies_hz.map(|f| f[1]), Always "second frequency" Fixed(2);
    first_m = own.amplitudes_m.map(|a| a[0]), Always "first amplitude" Scientific(3);
    second_m = own.amplitudes_m.map(|a| a[1]), Always "second amplitude" Scientific(3);
    stick = own.status.map(|s| s[0]), Always "stick" Percent(1);
    slip = own.status.map(|s| s[1]), Always "slip" Percent(1);
    open = own.status.map(|s| s[2]), Always "open" Percent(1);
    external_w = own.external_w, Always "power of the rotor" Fixed(2);
    stays = own.is_confirmed, IfAny "a transient stays on it" Plain;
    transient_1_hz = own.transient_frequencies_hz.map(|f| f[0]), IfAny "transient, first" Fixed(2);
    transient_2_hz = own.transient_frequencies_hz.map(|f| f[1]), IfAny "second" Fixed(2);
    births = own.births_text(), IfAny "one wave alone at" Plain;
    error = own.error.clone(), IfAny "why there is none" Plain;
}

/// Value of the parameter of a branch at a motion, in units of its key.
fn value(branch: &TwoWaveBranch, motion: &TwoWaveMotion) -> f64 {
    branch.parameter.in_key_units(branch.parameter.of(&motion.state.point))
}

/// Why a branch of two waves ends, in words.
fn described(end: BranchEnd) -> &'static str {
    match end {
        BranchEnd::Birth => "one wave vanishes",
        other => other.describe(),
    }
}

impl TwoWaveResult {
    /// What the summary says of it.
    pub(super) fn summary(&self, thickness: f64) -> TwoWaveSummary {
        let found = self.outcome.as_ref().ok();
        let motion = found.map(|found| &found.motion);
        let branch = found.and_then(|found| found.branch.as_ref());
        let births = branch.map_or(Vec::new(), |branch| {
            branch.births.iter().map(|&value| branch.parameter.in_key_units(value)).collect()
        });
        TwoWaveSummary {
            harmonics: self.harmonics,
            frequencies_hz: motion.map(TwoWaveMotion::frequencies_hz),
            amplitudes_m: motion.map(|motion| motion.amplitudes),
            status: motion.map(|motion| motion.fractions),
            points: found.map(|found| found.sides),
            external_w: motion.map(|motion| motion.powers.contact.external * thickness),
            balance_residual: motion.map(|motion| motion.powers.balance_residual()),
            transient_frequencies_hz: found
                .and_then(|found| found.confirmation)
                .map(|own| own.frequencies.map(|omega| omega / TAU)),
            is_confirmed: found.map(|found| found.is_confirmed),
            births,
            ends: branch.map(|branch| branch.ends.map(|end| described(end).to_owned())),
            error: self.outcome.as_ref().err().cloned(),
        }
    }

    /// A quantity of both waves along their branch.
    pub(super) fn curves(&self, quantity: fn(&TwoWaveMotion) -> [f64; 2]) -> Vec<Line> {
        let found = self.outcome.as_ref().ok();
        let Some(branch) = found.and_then(|found| found.branch.as_ref()) else {
            return Vec::new();
        };
        let [first, second] = self.harmonics;
        let curve = |wave: usize| {
            let motions = branch.motions.iter();
            Line::through(motions.map(|own| (value(branch, own), quantity(own)[wave])))
                .stroke(Stroke::dotted(INK, 1.1))
                .name(format!("*n* = {first} and {second} together"))
        };
        [0, 1].map(curve).into()
    }

    /// The table of its branch, or of the motion alone.
    pub(super) fn table(&self, thickness: f64) -> Option<Table> {
        let found = self.outcome.as_ref().ok()?;
        let [first, second] = self.harmonics;
        let rows: Vec<Row> = match &found.branch {
            Some(branch) => {
                let rows = branch.motions.iter();
                rows.map(|own| (value(branch, own), own.clone(), thickness)).collect()
            }
            None => vec![(0.0, found.motion.clone(), thickness)],
        };
        let key = found.branch.as_ref().map_or("point", |branch| branch.parameter.key());
        let values = rows.iter().map(|row| row.0);
        let name = format!("two-waves-n{first}-n{second}.csv");
        Some(Table::new(name, "").column(key, None, values).columns(TWO_WAVES, &rows))
    }
}

impl TwoWaveSummary {
    fn name(&self) -> String {
        let [first, second] = self.harmonics;
        format!("n = {first} and {second} together")
    }

    fn births_text(&self) -> Option<String> {
        let births: Vec<String> = self.births.iter().map(|&value| significant(value, 5)).collect();
        (!births.is_empty()).then(|| births.join(", "))
    }

    /// Why its branch ends, in a sentence.
    pub(super) fn ends_text(&self) -> Option<String> {
        let [one, other] = self.ends.as_ref()?;
        Some(format!(
            "{}: the branch ends at one end where {one}, at the other: {other}",
            self.name()
        ))
    }
}
