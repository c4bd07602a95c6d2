//! `summary.json` of a search for the limit cycles of a body without symmetry.

use super::{FoundCycle, PeriodicReport, PeriodicResult, SoughtMode};
use crate::cycle::Verdict;
use crate::cycle::periodic::{
    FloquetMultipliers, MotionConfirmation, PeriodicBranch, PeriodicMotion,
};
use crate::results::extent::Extent;
use crate::results::manifest::Manifest;
use crate::results::summary::{CriticalSummary, MeanPowers, StatusFractions, present};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// `summary.json` of `frictionsim cycle` on a body without symmetry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeriodicSummary {
    /// `cycle`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Whether no mode looked at grows.
    pub steady_sliding_stable: bool,
    /// Modes of steady sliding looked at.
    pub modes: usize,
    /// The mode that grows fastest or decays slowest.
    pub least_stable: Option<ModeSummary>,
    /// Where sliding loses its stability, where it is stable at the case's own operating point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub critical_value: Option<CriticalSummary>,
    /// What powers are of, in the tables too.
    pub extent: Extent,
    /// The modes that grow, each with its cycle or why there is none.
    pub cycles: Vec<SoughtSummary>,
    /// What it was made from.
    pub manifest: Manifest,
    /// The branches, where no tables hold them: at a point of a study.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curves: Option<Value>,
}

/// A mode of steady sliding.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeSummary {
    /// Number by frequency, from 1.
    pub mode: usize,
    /// Frequency, Hz.
    pub mode_frequency_hz: f64,
    /// Growth rate, 1/s.
    pub growth_rate_per_s: f64,
}

impl From<SoughtMode> for ModeSummary {
    fn from(mode: SoughtMode) -> Self {
        Self {
            mode: mode.number,
            mode_frequency_hz: mode.frequency_hz,
            growth_rate_per_s: mode.growth_rate,
        }
    }
}

/// What the search from one mode has led to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SoughtSummary {
    /// The mode.
    #[serde(flatten)]
    pub mode: ModeSummary,
    /// Wall time, s.
    pub wall_s: f64,
    /// The cycle, where there is one that no mode before has led to.
    #[serde(flatten)]
    pub cycle: Option<MotionSummary>,
    /// Mode that has led to the same cycle before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub same_as: Option<usize>,
    /// Value of the parameter of `cycle.continuation` at which the mode grows, where none does at the case's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sought_from: Option<f64>,
    /// Why none was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What a transient says of it, where one was asked for.
    pub confirmation: Option<PeriodicConfirmation>,
    /// Its stability, where it was asked for.
    pub stability: Option<PeriodicStability>,
    /// Its branch over the case's parameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub branch: Option<PeriodicBranchSummary>,
}

/// A branch of limit cycles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeriodicBranchSummary {
    /// Case key of the parameter.
    pub key: String,
    /// Cycles.
    pub cycles: usize,
    /// Smallest and largest value of the parameter.
    pub range: Option<[f64; 2]>,
    /// Why it ends, at either end.
    pub ends: [String; 2],
    /// Values at which stability changes between folds.
    pub stability_changes: Vec<f64>,
    /// Values at which the branch turns back, in its order.
    #[serde(default)]
    pub folds: Vec<f64>,
    /// Values at which steady sliding loses its stability.
    #[serde(default)]
    pub onsets: Vec<f64>,
    /// Where cycles live beside stable sliding.
    #[serde(default)]
    pub coexistence: Vec<[f64; 2]>,
}

impl From<&PeriodicBranch> for PeriodicBranchSummary {
    fn from(branch: &PeriodicBranch) -> Self {
        let parameter = branch.parameter;
        let in_units = |value: f64| parameter.in_key_units(value);
        let coexistence = branch.coexistence().into_iter();
        let changes = branch.stability_changes().into_iter();
        Self {
            key: parameter.key().to_owned(),
            cycles: branch.motions.len(),
            range: branch.range().map(|ends| ends.map(in_units)),
            ends: branch.ends.map(|end| end.describe().to_owned()),
            stability_changes: changes.map(in_units).collect(),
            folds: branch.folds().into_iter().map(in_units).collect(),
            onsets: branch.onsets.iter().map(|&at| in_units(at)).collect(),
            coexistence: coexistence.map(|ends| ends.map(in_units)).collect(),
        }
    }
}

/// A limit cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionSummary {
    /// Frequency, Hz.
    pub main_frequency_hz: f64,
    /// Fractions of the contact nodes.
    pub status: StatusFractions,
    /// Mean powers.
    pub power_w: MeanPowers,
    /// Residual of the energy balance, relative to the external power.
    pub balance_residual: f64,
    /// What the motion misses its start by after a period, relative to its amplitude.
    pub residual: f64,
    /// Periods stepped to find it.
    pub periods: usize,
    /// Steps of a period.
    pub steps: usize,
    /// Label of the contact node that moves most along the counterface.
    pub contact_node: usize,
    /// Half the range of its displacement along the counterface, m.
    pub amplitude_m: f64,
    /// Velocity of a kick that tips stable sliding into this cycle: `2 pi f` times the amplitude of the unstable cycle between both,
    /// m/s.
    #[serde(default)]
    pub kick_velocity: Option<f64>,
    /// Level of the velocity, root mean square over time and mass, over 5e-8 m/s, dB.
    #[serde(default)]
    pub velocity_level_db: f64,
    /// Estimate of the sound that it radiates, of a body with flat faces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sound: Option<SoundSummary>,
    /// Harmonics in which the motion is told.
    pub harmonic_count: usize,
    /// Share of the vibration of the contact nodes that these leave.
    pub harmonic_remainder: f64,
    /// Root mean square over the contact nodes of the amplitude along the counterface of harmonics 1, 2, ..., m.
    pub harmonics: Vec<f64>,
}

/// Sound radiated into air, by the Rayleigh integral: each flat face in an infinite rigid baffle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SoundSummary {
    /// Power of all harmonics up to 20 kHz, W.
    pub power_w: f64,
    /// Its level over 1e-12 W, dB.
    pub level_db: f64,
    /// Area of the faces, m2.
    pub area_m2: f64,
    /// Power of harmonics 1, 2, ..., W.
    pub harmonics_w: Vec<f64>,
}

/// A transient that started beside a cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeriodicConfirmation {
    /// Length of the run in periods of the cycle.
    pub periods: usize,
    /// Whether it still is on the cycle.
    pub agrees: bool,
    /// Frequency, Hz.
    pub main_frequency_hz: Option<f64>,
    /// Fractions of contact nodes.
    pub status: StatusFractions,
    /// Power of the counterface.
    pub power_w: ExternalPower,
}

/// Power of the counterface alone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExternalPower {
    /// Mean power, W.
    pub external: Option<f64>,
}

/// Stability of a cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PeriodicStability {
    /// It is known.
    Known {
        /// `stable`, `unstable` or `undecided`.
        verdict: String,
        /// The same as a boolean; none if undecided.
        is_stable: Option<bool>,
        /// The leading perturbation.
        leading: Option<MultiplierSummary>,
        /// Modulus of the multiplier of a shift in phase, which is 1.
        shift: Option<f64>,
    },
    /// It could not be found.
    Failed {
        /// Why.
        error: String,
    },
}

/// A multiplier of small perturbations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MultiplierSummary {
    /// Growth rate, 1/s.
    pub growth_rate_per_s: f64,
    /// Distance of its frequency from the nearest harmonic of the cycle, Hz.
    pub beat_hz: f64,
    /// Modulus of the multiplier.
    pub modulus: f64,
    /// Uncertainty of the growth rate, 1/s.
    pub uncertainty_per_s: Option<f64>,
}

/// The summary of a search.
pub fn summary(report: &PeriodicReport<'_>, manifest: &Manifest) -> PeriodicSummary {
    let cycles = report.results.iter().map(|result| summary_of(report, result));
    PeriodicSummary {
        command: "cycle".to_owned(),
        title: report.title.to_owned(),
        wall_s: report.wall_s,
        steady_sliding_stable: report.is_stable(),
        modes: report.modes,
        least_stable: report.least_stable.map(ModeSummary::from),
        critical_value: report.critical.map(CriticalSummary::from),
        extent: report.extent,
        cycles: cycles.collect(),
        manifest: manifest.clone(),
        curves: None,
    }
}

/// The summary of what the search from one mode has led to.
pub fn summary_of(report: &PeriodicReport<'_>, result: &PeriodicResult) -> SoughtSummary {
    let found = result.own();
    let confirmation = found.and_then(|found| {
        let run = found.confirmation.as_ref()?;
        Some(confirmed(report, run, &found.motion))
    });
    SoughtSummary {
        mode: result.mode.into(),
        wall_s: result.wall_s,
        cycle: found.map(|found| motion(report, found)),
        same_as: result.same_as,
        sought_from: result.start.map(|(_, value)| value),
        error: result.outcome.as_ref().err().cloned(),
        confirmation,
        stability: found.and_then(|found| Some(stability(found.stability.as_ref()?))),
        branch: found.and_then(|found| found.branch.as_ref().map(PeriodicBranchSummary::from)),
    }
}

fn motion(report: &PeriodicReport<'_>, found: &FoundCycle) -> MotionSummary {
    let motion = &found.motion;
    let powers = motion.powers.scaled(report.thickness);
    let contact = &powers.contact;
    let [stick, slip, open] = motion.fractions.map(present);
    let node = report.interface.nodes[motion.node];
    let told = motion.harmonics.iter().take(found.harmonic_count);
    let last = told.clone().next_back();
    MotionSummary {
        main_frequency_hz: motion.frequency_hz,
        status: StatusFractions { stick, slip, open },
        power_w: MeanPowers {
            external: present(contact.external),
            stick: present(contact.stick),
            slide: present(contact.slide),
            contact_dissipated: present(contact.contact_dissipated),
            material_damping: present(powers.material_damping),
            normal_contact: present(contact.normal),
            contact_damping: (contact.damping != 0.0).then_some(contact.damping),
        },
        balance_residual: motion.powers.balance_residual(),
        residual: motion.residual,
        periods: motion.periods,
        steps: motion.steps,
        contact_node: report.node_label(node),
        amplitude_m: motion.amplitude,
        kick_velocity: found.kick_velocity(),
        velocity_level_db: motion.velocity_level(),
        sound: found.sound.as_ref().map(|sound| SoundSummary {
            power_w: sound.power(),
            level_db: sound.level(),
            area_m2: sound.area,
            harmonics_w: sound.harmonics.clone(),
        }),
        harmonic_count: found.harmonic_count,
        harmonic_remainder: last.map_or(1.0, |last| last.remainder),
        harmonics: told.map(|harmonic| harmonic.amplitude[1]).collect(),
    }
}

fn confirmed(
    report: &PeriodicReport<'_>,
    run: &MotionConfirmation,
    motion: &PeriodicMotion,
) -> PeriodicConfirmation {
    let [stick, slip, open] = run.status.map(present);
    PeriodicConfirmation {
        periods: run.periods,
        agrees: run.agrees(motion),
        main_frequency_hz: present(run.main_frequency_hz),
        status: StatusFractions { stick, slip, open },
        power_w: ExternalPower { external: present(run.external_power * report.thickness) },
    }
}

fn stability(found: &Result<FloquetMultipliers, String>) -> PeriodicStability {
    let multipliers = match found {
        Ok(multipliers) => multipliers,
        Err(error) => {
            return PeriodicStability::Failed { error: error.clone() };
        }
    };
    let verdict = multipliers.verdict();
    PeriodicStability::Known {
        verdict: verdict.word().to_owned(),
        is_stable: (verdict != Verdict::Undecided).then_some(verdict == Verdict::Stable),
        leading: multipliers.leading().map(|leading| MultiplierSummary {
            growth_rate_per_s: leading.growth_rate,
            beat_hz: leading.beat_hz,
            modulus: leading.multiplier.norm(),
            uncertainty_per_s: present(leading.uncertainty),
        }),
        shift: multipliers.shift.map(|shift| shift.norm()),
    }
}
