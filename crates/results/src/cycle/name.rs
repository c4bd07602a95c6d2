//! What leads to a limit cycle: a wave of a disc and its onset, or a mode of any other body.

use crate::keys::keys;
use frictionsim_output::Described;
use frictionsim_physics::cycle::{Family, Onset};
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt;

/// What leads to a cycle.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum CycleName {
    /// A wave of a disc.
    Wave(WaveOfCycle),
    /// A mode of a body without rotating waves.
    Mode(ModeOfCycle),
}

keys! {
    /// A mode, and what it leads to.
    ModeOfCycle {
        #[serde(flatten)]
        mode: ModeSummary = "the mode";
        same_as?: usize = "mode that has led to the same cycle before";
        sought_from?: f64 = "value of the parameter of `cycle.continuation` at which the \
            mode grows, where none does at the case's own";
    }

    /// A wave and its onset.
    WaveOfCycle {
        harmonic: usize = "circumferential harmonic";
        onset: usize = "onset of that harmonic at which it is born, from 1";
        critical_friction: Option<f64> = "critical friction coefficient of that onset";
        direction: Option<i8> = "its direction";
        phases: usize = "points along the phase";
        onsets: Vec<OnsetSummary> = "every onset of the harmonic";
    }
}

impl WaveOfCycle {
    /// Of a family, sought with so many points along the phase, and every onset of its harmonic by rising friction: it
    /// is born at its own.
    pub fn new(family: Family, phases: usize, onsets: &[Onset]) -> Self {
        let birth = onsets.get(family.onset - 1);
        Self {
            harmonic: family.harmonic,
            onset: family.onset,
            critical_friction: birth.map(|onset| onset.friction_coefficient),
            direction: birth.map(|onset| onset.direction),
            phases,
            onsets: onsets.iter().map(OnsetSummary::from).collect(),
        }
    }

    /// Which limit cycle of its harmonic.
    pub fn family(&self) -> Family {
        Family { harmonic: self.harmonic, onset: self.onset }
    }
}

impl CycleName {
    /// Part of a file name: `n2`, `n1-onset2` or `mode15`.
    pub fn tag(&self) -> String {
        match self {
            Self::Wave(own) => own.family().tag(),
            Self::Mode(own) => format!("mode{}", own.mode.mode),
        }
    }

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
            Self::Wave(own) => own.family().fmt(f),
            Self::Mode(own) => own.mode.fmt(f),
        }
    }
}

keys! {
    /// Where a wave starts to grow.
    #[derive(Copy)]
    OnsetSummary {
        harmonic: usize = "circumferential harmonic";
        direction: i8 = "+1 with the rotor, -1 against it";
        critical_friction: f64 = "critical friction coefficient";
        frequency_hz: f64 = "frequency, Hz";
    }
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

keys! {
    /// A mode of steady sliding.
    #[derive(Copy)]
    ModeSummary {
        mode: usize = "number by frequency, from 1, at the case's own friction coefficient";
        mode_frequency_hz: f64 = "frequency, Hz";
        growth_rate_per_s: f64 = "growth rate, 1/s";
    }
}

/// `mode 15`.
impl fmt::Display for ModeSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mode {}", self.mode)
    }
}
