//! Branches of limit cycles over a parameter: their rows, what is kept of them for figures, and what is said of them.

use super::record::CycleMotion;
use crate::charts::palette::{
    CONTACT_DISSIPATION, MATERIAL_DISSIPATION, NORMAL_POWER, SLIDE_POWER, STICK_POWER,
};
use crate::common::*;
use frictionsim_physics::cycle::Verdict;

/// A cycle of a branch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BranchRow {
    /// The parameter, in units of its key.
    pub value: f64,
    /// Circumferential harmonic of a wave.
    pub harmonic: Option<usize>,
    /// Its motion.
    pub motion: CycleMotion,
    /// What a motion of the whole mesh misses its start by.
    pub residual: Option<f64>,
    /// Periods stepped to find it.
    pub periods: Option<usize>,
    /// Growth rate of the leading perturbation, 1/s, where it is known.
    pub growth_rate: Option<f64>,
    /// Whether it is stable, where that is known.
    pub verdict: Option<Verdict>,
    /// Whether the branch turns back here, of motions of the whole mesh.
    pub is_fold: Option<bool>,
}

columns! {
    /// A cycle of a branch, behind the parameter: before its status and its powers.
    pub(crate) BRANCH: row as BranchRow;
    harmonic: "circumferential harmonic of a wave" = row.harmonic;
    main_frequency_hz: "frequency" = row.motion.main_frequency_hz;

    /// What else is known of it, behind its status and its powers.
    pub(crate) ALONG: row as BranchRow;
    amplitude_m: "amplitude along the counterface" = row.motion.amplitude_m;
    velocity_level_db: "level of the velocity over 5e-8 m/s, of motions of the whole mesh"
        = row.motion.velocity_level_db;
    balance_residual: "residual of the energy balance, relative to the external power" = row.motion.balance_residual;
    growth_rate_per_s: "growth rate of the leading perturbation, where it was asked for" = row.growth_rate;
    stability: "stable, unstable or undecided, where it was asked for" = row.verdict.map(Verdict::word);
    residual: "what the motion misses its start by, of motions of the whole mesh" = row.residual;
    periods: "periods stepped to find it, of motions of the whole mesh" = row.periods;
    fold: "whether the branch turns back here, of motions of the whole mesh" = row.is_fold;
}

keys! {
    /// The limit cycles of one harmonic or mode.
    #[derive(Default, Deserialize)]
    FamilyRecord {
        harmonic: usize = "circumferential harmonic; 0 of a body without rotating waves, whose cycles have a mode";
        onset: usize = "onset of that harmonic at which the cycles are born, from 1";
        #[serde(default)]
        mode: Option<usize> = "the mode that leads to the cycles of a body without rotating waves";
        onsets: Vec<[f64; 2]> = "critical friction and frequency (Hz) of every onset";
        cycle: Option<[f64; 2]> = "frequency (Hz) and amplitude (m) of the cycle at the case's own operating point";
        branch: Option<BranchRecord> = "its branch";
    }

    /// Cycles along a branch, in its order.
    #[derive(Default, Deserialize)]
    BranchRecord {
        key: String = "case key of the parameter";
        values: Vec<f64> = "the parameter at each cycle, in units of the key";
        own_value: f64 = "the case's own value";
        frequency_hz: Vec<f64> = "main frequency, Hz";
        amplitude: Vec<f64> = "amplitude along the counterface, m";
        status: [Vec<f64>; 3] = "fractions that stick, slip, are open";
        shares: [Vec<f64>; 5] = "powers relative to the external one: stick, slide, dissipated in \
            the contact, material damping, normal contact";
        #[serde(default)]
        extent: Extent = "what powers are of";
        #[serde(default)]
        external: Vec<f64> = "power of the counterface, W or W/m";
        stable: Vec<Option<bool>> = "whether the cycle is stable, where that is known";
        growth_rate: Vec<Option<f64>> = "growth rate of its leading perturbation, 1/s, where it is known";
        folds: Vec<f64> = "parameter values at which the branch turns back";
        #[serde(default)]
        sliding_onsets: Vec<f64> = "values at which steady sliding loses its stability, where these were looked for";
        #[serde(default)]
        coexistence: Vec<[f64; 2]> = "where cycles live beside stable sliding";
        #[serde(default)]
        threshold: Option<[f64; 2]> = "amplitude (m) and velocity of the kick (m/s) of the \
            unstable cycle between stable sliding and the case's own";
    }
}

/// One of the powers.
type Power = fn(&MeanPowers) -> Option<f64>;

/// Name and colour of the powers in the order of a branch's shares, and each of them.
pub(super) const SHARES: [(&str, &str, Power); 5] = [
    ("stick", STICK_POWER, |own| own.stick),
    ("slip", SLIDE_POWER, |own| own.slide),
    ("dissipated in the contact", CONTACT_DISSIPATION, |own| own.contact_dissipated),
    ("material damping", MATERIAL_DISSIPATION, |own| own.material_damping),
    ("normal contact", NORMAL_POWER, |own| own.normal_contact),
];

impl FamilyRecord {
    /// Which limit cycles.
    pub fn family(&self) -> Family {
        Family { harmonic: self.harmonic, onset: self.onset }
    }
}

impl BranchRecord {
    /// The columns of a branch.
    pub(super) fn of(branch: &BranchSummary, extent: Extent) -> Self {
        let rows = &branch.rows;
        let motions = branch.motions.clone().unwrap_or_default();
        let column = |of: &dyn Fn(&CycleMotion) -> Option<f64>| -> Vec<f64> {
            rows.iter().map(|row| of(&row.motion).unwrap_or(f64::NAN)).collect()
        };
        let external = column(&|own| own.power_w.external);
        let share = |of: Power| {
            let powers = column(&|own| of(&own.power_w));
            powers.iter().zip(&external).map(|(own, all)| own / all).collect()
        };
        Self {
            key: branch.key.clone(),
            values: rows.iter().map(|row| row.value).collect(),
            own_value: branch.own_value,
            frequency_hz: column(&|own| Some(own.main_frequency_hz)),
            amplitude: column(&|own| own.amplitude_m),
            status: [
                column(&|own| own.status.stick),
                column(&|own| own.status.slip),
                column(&|own| own.status.open),
            ],
            shares: SHARES.map(|(.., of)| share(of)),
            extent,
            stable: rows.iter().map(|row| row.verdict?.is_stable()).collect(),
            growth_rate: rows.iter().map(|row| row.growth_rate).collect(),
            folds: branch.folds.clone(),
            sliding_onsets: motions.onsets,
            coexistence: motions.coexistence,
            threshold: branch.threshold,
            external,
        }
    }
}

keys! {
    /// A branch of limit cycles.
    #[derive(Default)]
    BranchSummary {
        key: String = "case key of the parameter";
        cycles: usize = "cycles";
        range: Option<[f64; 2]> = "smallest and largest value of the parameter";
        folds: Vec<f64> = "values at which it turns back, in its order";
        ends: [String; 2] = "why it ends, at either end";
        stability_changes: Vec<StabilityChangeSummary>
            = "where stability changes between folds: the value; of waves an object";
        #[serde(flatten)]
        waves: Option<WaveBranch> = "what else there is to a branch of waves";
        #[serde(flatten)]
        motions: Option<MotionBranch> = "what else there is to one of motions of the whole mesh";
        #[serde(skip)]
        own_value: f64 = "the case's own value of the parameter, in units of its key";
        #[serde(skip)]
        threshold: Option<[f64; 2]> = "amplitude (m) and velocity of the kick (m/s) of the \
            unstable cycle between stable sliding and the case's own";
        #[serde(skip)]
        rows: Vec<BranchRow> = "its cycles, in its order";
    }
}

impl BranchSummary {
    /// Of its cycles, and the case's own value in units of the key; no fold and no change of stability.
    pub(super) fn new(
        parameter: Parameter,
        own_value: f64,
        ends: [BranchEnd; 2],
        rows: Vec<BranchRow>,
    ) -> Self {
        let (low, high) = extremes(rows.iter().map(|row| row.value));
        Self {
            key: parameter.key().to_owned(),
            cycles: rows.len(),
            range: (!rows.is_empty()).then_some([low, high]),
            ends: ends.map(|end| end.describe().to_owned()),
            own_value,
            rows,
            ..Self::default()
        }
    }
}

keys! {
    /// What only branches of waves have.
    WaveBranch {
        saturation_speed_rpm: Option<f64> = "speed from which on no node sticks, rpm";
        factorizations: usize = "dense factorizations spent";
    }

    /// What only branches of motions of the whole mesh have.
    #[derive(Default)]
    MotionBranch {
        onsets: Vec<f64> = "values at which steady sliding loses its stability";
        coexistence: Vec<[f64; 2]> = "where cycles live beside stable sliding";
    }
}

/// Where a branch changes its stability.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum StabilityChangeSummary {
    /// Of a motion of the whole mesh.
    At(f64),
    /// Of a wave, by a mode.
    By(ModeOfChange),
}

keys! {
    /// The mode by which a wave changes its stability.
    #[derive(Copy)]
    ModeOfChange {
        at: f64 = "value of the parameter";
        harmonic: usize = "circumferential harmonic of the mode that starts or ceases to grow";
        frequency_hz: f64 = "its frequency, Hz";
        to_two_frequencies: bool = "whether the wave gives way to a motion of two frequencies: a \
            Neimark-Sacker bifurcation";
    }
}
