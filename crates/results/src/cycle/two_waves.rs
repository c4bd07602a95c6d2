//! Motions of two frequencies: words, table, summary, curves.

use crate::common::*;
use frictionsim_physics::cycle::{TwoWaveBranch, TwoWaveSearch};

keys! {
    /// What two waves that may live together come to: a motion of two frequencies, or nothing.
    #[derive(Default)]
    TwoWaveSummary {
        harmonics: [usize; 2] = "harmonics of both waves";
        frequencies_hz: Option<[f64; 2]> = "frequencies, Hz";
        amplitudes_m: Option<[f64; 2]> = "amplitudes of the tangential displacement of the edge, m";
        status: Option<[f64; 3]> = "fractions of the edge that stick, slip, are open, over time";
        points: Option<[usize; 2]> = "points along both phases";
        external_w: Option<f64> = "power of the rotor, W";
        balance_residual: Option<f64> = "residual of the energy balance, relative to it";
        transient_frequencies_hz: Option<[f64; 2]> = "frequencies of a transient that started on it, Hz";
        is_confirmed: Option<bool> = "whether these are its own within a thousandth";
        births: Vec<f64> = "values of the parameter at which the weaker wave vanishes, in units of its key";
        ends: Option<[String; 2]> = "why the branch ends, at either end";
        error: Option<String> = "why there is none";
        #[serde(skip)]
        key: Option<&'static str> = "key of the parameter of its branch, where one was asked for";
        #[serde(skip)]
        rows: Vec<TwoWaveRow> = "the motions of the branch in its order, or the motion alone";
        #[serde(skip)]
        frames: Vec<MotionFrame> = "the whole field over one period of the first wave; the second is elsewhere by then";
    }
}

/// A motion of two waves along a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoWaveRow {
    /// The parameter, in units of its key.
    pub value: f64,
    /// The motion.
    pub motion: TwoWaveMotion,
    /// Power of the rotor, W.
    pub external_w: f64,
}

columns! {
    /// A motion of two waves, behind the parameter.
    pub(crate) TWO_WAVES: row as TwoWaveRow;
    frequency_1_hz: "frequency of the first wave" = row.motion.frequencies_hz()[0];
    frequency_2_hz: "frequency of the second" = row.motion.frequencies_hz()[1];
    amplitude_1_m: "amplitude of the first wave along the edge" = row.motion.amplitudes[0];
    amplitude_2_m: "amplitude of the second" = row.motion.amplitudes[1];
    stick: "fraction of the edge that sticks" = row.motion.fractions[0];
    slip: "fraction that slips" = row.motion.fractions[1];
    open: "fraction that is open" = row.motion.fractions[2];
    external_w: "power of the rotor" = row.external_w;
    balance_residual: "residual of the energy balance, relative to it" = row.motion.powers.balance_residual();

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

impl TwoWaveSummary {
    /// Of two waves, by their harmonics, of whose motion nothing is known: an error says why.
    pub fn failed(harmonics: [usize; 2], error: String) -> Self {
        Self { harmonics, error: Some(error), ..Self::default() }
    }

    /// Of what a search has led to on a disc of such a thickness, and the branch over the case's parameter.
    pub fn of(
        harmonics: [usize; 2],
        found: &TwoWaveSearch,
        branch: Option<&TwoWaveBranch>,
        thickness: f64,
    ) -> Self {
        let motion = &found.motion;
        let row = |value: f64, motion: &TwoWaveMotion| TwoWaveRow {
            value,
            motion: motion.clone(),
            external_w: motion.powers.contact.external * thickness,
        };
        let mut own = Self {
            harmonics,
            frequencies_hz: Some(motion.frequencies_hz()),
            amplitudes_m: Some(motion.amplitudes),
            status: Some(motion.fractions),
            points: Some(found.waves.sides),
            external_w: Some(motion.powers.contact.external * thickness),
            balance_residual: Some(motion.powers.balance_residual()),
            transient_frequencies_hz: found
                .confirmation
                .map(|own| own.frequencies.map(|omega| omega / TAU)),
            is_confirmed: Some(found.agrees()),
            rows: vec![row(0.0, motion)],
            ..Self::default()
        };
        if let Some(branch) = branch {
            let parameter = branch.parameter;
            let in_units = |value: f64| parameter.in_key_units(value);
            let value = |own: &TwoWaveMotion| in_units(parameter.of(&own.state.point));
            own.key = Some(parameter.key());
            own.rows = branch.motions.iter().map(|own| row(value(own), own)).collect();
            own.births = branch.births.iter().map(|&value| in_units(value)).collect();
            let described = |end: BranchEnd| match end {
                BranchEnd::Birth => "one wave vanishes",
                other => other.describe(),
            };
            own.ends = Some(branch.ends.map(|end| described(end).to_owned()));
        }
        own
    }

    /// A quantity of both waves along their branch.
    pub(super) fn curves(&self, quantity: fn(&TwoWaveMotion) -> [f64; 2]) -> Vec<Line> {
        if self.key.is_none() {
            return Vec::new();
        }
        let curve = |wave: usize| {
            let points = self.rows.iter().map(|row| (row.value, quantity(&row.motion)[wave]));
            let [first, second] = self.harmonics;
            Line::through(points)
                .stroke(Stroke::dotted(INK, 1.1))
                .name(format!("*n* = {first} and {second} together"))
        };
        [0, 1].map(curve).into()
    }

    /// The table of its branch, or of the motion alone.
    pub(super) fn table(&self) -> Option<Table> {
        self.frequencies_hz?;
        let [first, second] = self.harmonics;
        let values = self.rows.iter().map(|row| row.value);
        let name = format!("two-waves-n{first}-n{second}.csv");
        let table = Table::new(name, "").column(self.key.unwrap_or("point"), None, values);
        Some(table.columns(TWO_WAVES, &self.rows))
    }

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
            "{}: its branch stops at one end where {one}, at the other because {other}",
            self.name()
        ))
    }
}
