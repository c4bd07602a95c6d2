//! What a transient and small perturbations say of a limit cycle.

use crate::common::*;
use frictionsim_physics::cycle::{FloquetMultiplier, Verdict};

/// What is known of the stability of a cycle, where it was asked for, or why there is nothing.
pub type Finding = Option<Result<FloquetMultipliers, String>>;

/// The analysis of a cycle, where there is one.
pub fn known(finding: &Finding) -> Option<&FloquetMultipliers> {
    finding.as_ref().and_then(|finding| finding.as_ref().ok())
}

/// A transient that started on a cycle, or why none could.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum ConfirmationSummary {
    /// It ran.
    Ran(ConfirmationRun),
    /// It could not.
    Failed {
        /// False.
        agrees: bool,
        /// Why it could not run.
        error: String,
    },
}

keys! {
    /// A transient that started on a cycle.
    ConfirmationRun {
        periods: usize = "length of the run in periods of the cycle";
        agrees: bool = "whether it still is on the cycle";
        main_frequency_hz: Option<f64> = "frequency, Hz; none if it has stopped to vibrate";
        main_harmonic?: usize = "its harmonic, of a wave that still vibrates";
        status: StatusFractions = "fractions of contact nodes";
        power_w: ExternalPower = "power of the counterface";
        e_folds: f64 = "e-folds of the leading perturbation over the run; negative where it \
            decays, 0 where it is not known";
    }
}

impl ConfirmationSummary {
    /// Of a run, and whether that still is on the cycle.
    pub(super) fn ran(run: &Confirmation, thickness: f64) -> Self {
        Self::Ran(ConfirmationRun {
            periods: run.periods,
            agrees: run.agrees,
            main_frequency_hz: run.main_frequency_hz.and_then(present),
            main_harmonic: run.main_harmonic,
            status: StatusFractions::of(run.status),
            power_w: ExternalPower { external: present(run.external_power * thickness) },
            e_folds: run.e_folds,
        })
    }
}

keys! {
    /// Power of the counterface alone.
    #[derive(Copy)]
    ExternalPower {
        external: Option<f64> = "mean power, W";
    }
}

/// Stability of a cycle, or why it is not known.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum StabilitySummary {
    /// It is known.
    Known(Box<KnownStability>),
    /// It could not be found.
    Failed {
        /// Why it is not known.
        error: String,
    },
}

impl StabilitySummary {
    /// Of an analysis, where it was asked for.
    pub(super) fn of(finding: &Finding) -> Option<Self> {
        Some(match finding.as_ref()? {
            Ok(found) => Self::Known(Box::new(KnownStability::of(found))),
            Err(error) => Self::Failed { error: error.clone() },
        })
    }
}

keys! {
    /// Stability of a cycle.
    KnownStability {
        verdict: String = "`stable`, `unstable` or `undecided`";
        is_stable: Option<bool> = "the same as a flag; none if undecided";
        growing_harmonics?: Vec<usize> = "circumferential harmonics that grow, of a wave";
        leading: Option<Perturbation> = "the leading perturbation";
        shift?: f64 = "modulus of the multiplier of a shift in phase, which is 1, of a motion that was stepped in time";
    }
}

impl KnownStability {
    /// What the multipliers of a cycle say; the shift of a wave only goes into their uncertainty.
    fn of(found: &FloquetMultipliers) -> Self {
        let (verdict, leading) = (found.verdict(), found.leading());
        let is_wave = leading.is_some_and(|own| own.mode.is_some());
        Self {
            verdict: verdict.word().to_owned(),
            is_stable: verdict.is_stable(),
            growing_harmonics: is_wave.then(|| found.growing_harmonics()),
            leading: leading.map(Perturbation::of),
            shift: found.shift.filter(|_| !is_wave),
        }
    }
}

keys! {
    /// A small perturbation of a cycle: an exponent of a wave, a multiplier of a motion that was stepped in time.
    #[derive(Default)]
    Perturbation, EXPONENTS {
        class?: usize = "class of the harmonics that it holds, of a wave";
        growth_rate_per_s: f64 = "growth rate";
        wave_frequency_rad_per_s?: f64 = "frequency in the frame of the wave";
        harmonic?: usize = "circumferential harmonic at which it moves the edge most, of a wave";
        frequency_hz?: f64 = "frequency in the fixed frame, of a wave";
        beat_hz?: f64 = "distance of its frequency from the nearest harmonic, of motions of the whole mesh";
        modulus?: f64 = "modulus of its multiplier, of motions of the whole mesh";
        argument_rad?: f64 = "argument of its multiplier, of motions of the whole mesh";
        /// What it leads to where it grows.
        leads_to?: String;
        uncertainty_per_s: Option<f64> = "uncertainty of the growth rate";
    }
}

impl Perturbation {
    /// What is told of a multiplier: where it rides on a wave its mode, else the multiplier itself.
    pub(super) fn of(own: &FloquetMultiplier) -> Self {
        let known = Self {
            growth_rate_per_s: own.growth_rate,
            uncertainty_per_s: present(own.uncertainty),
            ..Self::default()
        };
        match own.mode {
            Some(mode) => Self {
                class: Some(mode.class),
                wave_frequency_rad_per_s: Some(mode.frequency),
                harmonic: Some(mode.harmonic),
                frequency_hz: Some(mode.frequency_hz),
                ..known
            },
            None => Self {
                beat_hz: Some(own.beat_hz),
                modulus: Some(own.multiplier.norm()),
                argument_rad: Some(own.multiplier.arg()),
                leads_to: (own.verdict() == Verdict::Unstable).then(|| own.kind().to_owned()),
                ..known
            },
        }
    }
}
