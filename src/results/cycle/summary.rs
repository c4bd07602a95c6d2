//! `summary.json` of a search for limit cycles.

use super::confirmation::ConfirmationSummary;
use super::stability::StabilitySummary;
use super::{CycleReport, CycleResult, TwoWaveSummary, amplitude};
use crate::chart::extremes;
use crate::cycle::periodic::velocity_level;
use crate::cycle::{CycleBranch, LimitCycle, Onset};
use crate::results::extent::Extent;
use crate::results::manifest::Manifest;
use crate::results::summary::{CriticalSummary, MeanPowers, StatusFractions, present};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::f64::consts::TAU;

/// `summary.json` of `frictionsim cycle`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CycleSummary {
    /// `cycle`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Whether no wave looked at grows.
    pub steady_sliding_stable: bool,
    /// The lowest onset of all.
    pub lowest_onset: Option<OnsetSummary>,
    /// Where along the parameter of the case sliding loses its stability, where it is stable at its own operating point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical_value: Option<CriticalSummary>,
    /// What powers are of, in the tables too.
    #[serde(default)]
    pub extent: Extent,
    /// The families, each with its cycle or why there is none.
    pub cycles: Vec<FamilySummary>,
    /// Motions of two waves that live together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub two_waves: Vec<TwoWaveSummary>,
    /// What it was made from.
    pub manifest: Manifest,
    /// The branches, where no tables hold them: at a point of a study.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curves: Option<Value>,
}

/// Where a wave starts to grow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OnsetSummary {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// +1 with the rotor, -1 against it.
    pub direction: i8,
    /// Critical friction coefficient.
    pub critical_friction: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
}

impl From<&Onset> for OnsetSummary {
    fn from(onset: &Onset) -> Self {
        Self {
            harmonic: onset.harmonic,
            direction: onset.direction,
            critical_friction: onset.friction_coefficient,
            frequency_hz: onset.frequency / TAU,
        }
    }
}

/// A family of limit cycles at the case's own operating point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FamilySummary {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Onset of that harmonic at which it is born, from 1.
    pub onset: usize,
    /// Critical friction coefficient of that onset.
    pub critical_friction: Option<f64>,
    /// Its direction.
    pub direction: Option<i8>,
    /// Points along the phase.
    pub phases: usize,
    /// Every onset of the harmonic.
    pub onsets: Vec<OnsetSummary>,
    /// Wall time, s.
    pub wall_s: f64,
    /// The cycle, where there is one.
    #[serde(flatten)]
    pub cycle: Option<LimitCycleSummary>,
    /// That there is none because steady sliding is stable against the wave.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub absent: Option<String>,
    /// Why none was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What a transient says of it, where one was asked for.
    pub confirmation: Option<ConfirmationSummary>,
    /// Its stability, where it was asked for.
    pub stability: Option<StabilitySummary>,
    /// Its branch over the case's parameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub branch: Option<BranchSummary>,
}

/// A limit cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitCycleSummary {
    /// Frequency, Hz.
    pub main_frequency_hz: f64,
    /// Fractions of the contact edge.
    pub status: StatusFractions,
    /// Mean powers.
    pub power_w: MeanPowers,
    /// Amplitude of the wave's own harmonic of the contact edge's tangential displacement, m.
    #[serde(default)]
    pub amplitude_m: Option<f64>,
    /// Amplitudes of the harmonics 0 to 8 of the contact edge's tangential displacement, m.
    pub harmonics: Vec<f64>,
    /// Residual of the energy balance, relative to the external power.
    pub balance_residual: f64,
    /// Level of the velocity, root mean square over time and mass, over 5e-8 m/s, dB.
    #[serde(default)]
    pub velocity_level_db: Option<f64>,
}

/// A branch of limit cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchSummary {
    /// Case key of the parameter.
    pub key: String,
    /// Cycles.
    pub cycles: usize,
    /// Smallest and largest value of the parameter.
    #[serde(default)]
    pub range: Option<[f64; 2]>,
    /// Values at which it turns back.
    pub folds: Vec<f64>,
    /// Why it ends, at either end.
    pub ends: [String; 2],
    /// Speed from which on no node sticks, rpm.
    pub saturation_speed_rpm: Option<f64>,
    /// Dense factorizations spent.
    pub factorizations: usize,
    /// Where stability changes.
    pub stability_changes: Vec<StabilityChangeSummary>,
}

/// Where a branch changes its stability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityChangeSummary {
    /// Value of the parameter.
    pub at: f64,
    /// Circumferential harmonic of the mode that starts or ceases to grow.
    pub harmonic: usize,
    /// Its frequency, Hz.
    pub frequency_hz: f64,
    /// Whether the wave gives way to a motion of two frequencies: a Neimark-Sacker bifurcation.
    #[serde(default)]
    pub to_two_frequencies: bool,
}

/// The summary of a search.
pub fn summary(report: &CycleReport<'_>, manifest: &Manifest) -> CycleSummary {
    let families = report.results.iter().map(|result| family(report, result));
    let pairs = report.two_waves.iter();
    let pairs = pairs.map(|result| TwoWaveSummary::of(report, result));
    CycleSummary {
        command: "cycle".to_owned(),
        title: report.title.to_owned(),
        wall_s: report.wall_s,
        steady_sliding_stable: report.stable_sliding().is_some(),
        lowest_onset: report.lowest_onset.as_ref().map(OnsetSummary::from),
        critical_value: report.critical.map(CriticalSummary::from),
        extent: report.extent,
        cycles: families.collect(),
        two_waves: pairs.collect(),
        manifest: manifest.clone(),
        curves: None,
    }
}

/// The summary of one family.
pub(super) fn family(report: &CycleReport<'_>, result: &CycleResult) -> FamilySummary {
    let absence = result.cycle.as_ref().err();
    let reason = |is_stable: bool| {
        let absence = absence.filter(|absence| absence.is_stable == is_stable);
        absence.map(|absence| absence.reason.clone())
    };
    FamilySummary {
        harmonic: result.family.harmonic,
        onset: result.family.onset,
        critical_friction: result.birth().map(|onset| onset.friction_coefficient),
        direction: result.birth().map(|onset| onset.direction),
        phases: result.phases,
        onsets: result.onsets.iter().map(OnsetSummary::from).collect(),
        wall_s: result.wall_s,
        cycle: result.cycle.as_ref().ok().map(|cycle| LimitCycleSummary {
            velocity_level_db: result.velocity.map(velocity_level),
            ..limit_cycle(report, cycle)
        }),
        absent: reason(true),
        error: reason(false),
        confirmation: ConfirmationSummary::of(report, result),
        stability: StabilitySummary::of(&result.stability),
        branch: result.branch.as_ref().map(|branch| branch_of(report, result, branch)),
    }
}

fn limit_cycle(report: &CycleReport<'_>, cycle: &LimitCycle) -> LimitCycleSummary {
    let powers = cycle.powers.scaled(report.thickness);
    let [stick, slip, open] = cycle.fractions.map(present);
    LimitCycleSummary {
        main_frequency_hz: cycle.frequency_hz(),
        status: StatusFractions { stick, slip, open },
        power_w: MeanPowers {
            external: present(powers.external),
            stick: present(powers.stick),
            slide: present(powers.slide),
            contact_dissipated: present(powers.contact_dissipated),
            material_damping: present(powers.material_damping),
            normal_contact: present(powers.normal_contact),
            contact_damping: None,
        },
        amplitude_m: present(amplitude(cycle)),
        harmonics: cycle.harmonics.to_vec(),
        balance_residual: cycle.powers.balance_residual(),
        velocity_level_db: None,
    }
}

fn branch_of(
    report: &CycleReport<'_>,
    result: &CycleResult,
    branch: &CycleBranch,
) -> BranchSummary {
    let in_key_units = |value: f64| branch.parameter.in_key_units(value);
    let values = branch.cycles.iter().map(|cycle| branch.parameter.of(&cycle.state.point));
    let (low, high) = extremes(values.map(in_key_units));
    let mut cycles = branch.cycles.iter();
    let saturation = cycles.find_map(|cycle| cycle.saturation_speed(report.inner_radius));
    let changes = result.stability_changes.iter();
    let changes = changes.map(|change| StabilityChangeSummary {
        at: in_key_units(change.value),
        harmonic: change.harmonic,
        frequency_hz: change.frequency_hz,
        to_two_frequencies: change.harmonic != result.family.harmonic,
    });
    BranchSummary {
        key: branch.parameter.key().to_owned(),
        cycles: branch.cycles.len(),
        range: (low <= high).then_some([low, high]),
        folds: branch.folds.iter().map(|&fold| in_key_units(fold)).collect(),
        ends: branch.ends.map(|end| end.describe().to_owned()),
        saturation_speed_rpm: saturation.map(|speed| speed * 60.0 / TAU),
        factorizations: branch.factorizations,
        stability_changes: changes.collect(),
    }
}
