//! `summary.json` of a search for limit cycles.

use super::branch::{BranchSummary, FamilyRecord};
use super::two_waves::TwoWaveSummary;
use super::verdicts::{ConfirmationRun, ConfirmationSummary, KnownStability, StabilitySummary};
use crate::extent::Extent;
use crate::summary::{CriticalSummary, MeanPowers, StatusFractions};
use frictionsim_output::Described;
use frictionsim_physics::cycle::{Family, Onset};
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt;

/// `summary.json` of `frictionsim cycle`.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct CycleSummary {
    /// Whether nothing looked at grows.
    pub steady_sliding_stable: bool,
    /// Where the search has started.
    #[serde(flatten)]
    pub origin: Origin,
    /// Where along the parameter of the case sliding loses its stability, where it is stable at its own operating
    /// point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_value: Option<CriticalSummary>,
    /// What powers are of, in the tables too.
    pub extent: Extent,
    /// The cycles that were sought, each with its motion or why there is none.
    pub cycles: Vec<SoughtCycle>,
    /// Motions of two waves that live together.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub two_waves: Vec<TwoWaveSummary>,
    /// What there is to say.
    pub notes: Vec<String>,
    /// The branches, where no tables hold them: at a point of a study.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curves: Option<Vec<FamilyRecord>>,
}

/// What a search has started from.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum Origin {
    /// From modes of steady sliding of a body without rotating waves.
    Modes {
        /// Modes of steady sliding looked at.
        modes: usize,
        /// The mode that grows fastest or decays slowest.
        least_stable: Option<ModeSummary>,
    },
    /// From waves of a disc.
    Waves {
        /// The lowest onset of all.
        lowest_onset: Option<OnsetSummary>,
    },
}

/// Where a wave starts to grow.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
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

/// A mode of steady sliding.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct ModeSummary {
    /// Number by frequency, from 1, at the case's own friction coefficient.
    pub mode: usize,
    /// Frequency, Hz.
    pub mode_frequency_hz: f64,
    /// Growth rate, 1/s.
    pub growth_rate_per_s: f64,
}

/// `mode 15`.
impl fmt::Display for ModeSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mode {}", self.mode)
    }
}

/// A limit cycle that was sought.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct SoughtCycle {
    /// What leads to it.
    #[serde(flatten)]
    pub name: CycleName,
    /// Wall time, s.
    pub wall_s: f64,
    /// The cycle, where there is one that no other has led to before.
    #[serde(flatten)]
    pub cycle: Option<CycleMotion>,
    /// That there is none because steady sliding is stable against the wave.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absent: Option<String>,
    /// Why none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What a transient says of it, where one was asked for.
    pub confirmation: Option<ConfirmationSummary>,
    /// Its stability, where it was asked for.
    pub stability: Option<StabilitySummary>,
    /// Its branch over the case's parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub branch: Option<BranchSummary>,
}

impl SoughtCycle {
    /// Its stability, where it is known.
    pub(super) fn known(&self) -> Option<&KnownStability> {
        match self.stability.as_ref()? {
            StabilitySummary::Known(known) => Some(known),
            StabilitySummary::Failed { .. } => None,
        }
    }

    /// The transient that started on it, if one ran.
    pub(super) fn run(&self) -> Option<&ConfirmationRun> {
        match self.confirmation.as_ref()? {
            ConfirmationSummary::Ran(run) => Some(run),
            ConfirmationSummary::Failed { .. } => None,
        }
    }

    /// Whether a transient that started on it has stayed there.
    pub(super) fn agrees(&self) -> Option<bool> {
        Some(match self.confirmation.as_ref()? {
            ConfirmationSummary::Ran(run) => run.agrees,
            ConfirmationSummary::Failed { agrees, .. } => *agrees,
        })
    }
}

/// What leads to a cycle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum CycleName {
    /// A wave of a disc.
    Wave(WaveOfCycle),
    /// A mode of a body without rotating waves.
    Mode(ModeOfCycle),
}

/// A mode, and what it leads to.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ModeOfCycle {
    /// The mode.
    #[serde(flatten)]
    pub mode: ModeSummary,
    /// Mode that has led to the same cycle before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same_as: Option<usize>,
    /// Value of the parameter of `cycle.continuation` at which the mode grows, where none does at the case's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sought_from: Option<f64>,
}

/// A wave and its onset.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct WaveOfCycle {
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
}

impl CycleName {
    /// The wave, if it is one.
    pub fn wave(&self) -> Option<&WaveOfCycle> {
        match self {
            Self::Wave(wave) => Some(wave),
            Self::Mode(_) => None,
        }
    }

    /// The mode, if it is one.
    pub fn mode(&self) -> Option<&ModeOfCycle> {
        match self {
            Self::Mode(mode) => Some(mode),
            Self::Wave(_) => None,
        }
    }
}

/// `n = 2`, `n = 1, onset 2` or `mode 15`.
impl fmt::Display for CycleName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wave(WaveOfCycle { harmonic, onset, .. }) => {
                Family { harmonic: *harmonic, onset: *onset }.fmt(f)
            }
            Self::Mode(own) => own.mode.fmt(f),
        }
    }
}

/// A limit cycle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct CycleMotion {
    /// Frequency, Hz.
    pub main_frequency_hz: f64,
    /// Fractions of the contact nodes.
    pub status: StatusFractions,
    /// Mean powers.
    pub power_w: MeanPowers,
    /// Residual of the energy balance, relative to the external power.
    pub balance_residual: f64,
    /// Amplitude along the counterface, m: of the wave's own harmonic. On other bodies half the range of the contact
    /// node that moves most.
    pub amplitude_m: Option<f64>,
    /// Level of the velocity, root mean square over time and mass, over 5e-8 m/s, dB.
    pub velocity_level_db: Option<f64>,
    /// Amplitudes along the counterface, m: of a wave the harmonics 0 to 8 around the contact edge. On other bodies the
    /// harmonics 1, 2, ... in time, root mean square over the contact nodes.
    pub harmonics: Vec<f64>,
    /// What else there is to a motion that was stepped in time.
    #[serde(flatten)]
    pub stepped: Option<SteppedMotion>,
}

/// A motion of the whole mesh that was stepped in time.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct SteppedMotion {
    /// What the motion misses its start by after a period, relative to its amplitude.
    pub residual: f64,
    /// Periods stepped to find it.
    pub periods: usize,
    /// Steps of a period.
    pub steps: usize,
    /// Label of the contact node that moves most along the counterface.
    pub contact_node: usize,
    /// Velocity of a kick that tips stable sliding into this cycle: `2 pi f` times the amplitude of the unstable cycle
    /// between both, m/s.
    pub kick_velocity: Option<f64>,
    /// Estimate of the sound that it radiates, of a body with flat faces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sound: Option<SoundSummary>,
    /// Harmonics in which the motion is told.
    pub harmonic_count: usize,
    /// Share of the vibration of the contact nodes that these leave.
    pub harmonic_remainder: f64,
}

/// Sound radiated into air, by the Rayleigh integral: each flat face in an infinite rigid baffle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
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
