//! What a limit cycle is in the summary and in its tables and figures: what leads to it, a wave of a disc and its onset
//! or a mode of any other body, and its motion.

use super::verdicts::Perturbation;
use crate::common::*;
use frictionsim_physics::cycle::Onset;
use frictionsim_physics::cycle::periodic::velocity_level;
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
        if let Self::Wave(wave) = self { Some(wave) } else { None }
    }

    /// The mode, if it is one.
    pub fn mode(&self) -> Option<&ModeOfCycle> {
        if let Self::Mode(mode) = self { Some(mode) } else { None }
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

keys! {
    /// A limit cycle.
    #[derive(Default)]
    CycleMotion {
        main_frequency_hz: f64 = "frequency, Hz";
        status: StatusFractions = "fractions of the contact nodes";
        power_w: MeanPowers = "mean powers";
        balance_residual: f64 = "residual of the energy balance, relative to the external power";
        amplitude_m: Option<f64> = "amplitude along the counterface, m: of the wave's own \
            harmonic. On other bodies half the range of the contact node that moves most";
        velocity_level_db: Option<f64>
            = "level of the velocity, root mean square over time and mass, over 5e-8 m/s, dB";
        harmonics: Vec<f64> = "amplitudes along the counterface, m: of a wave the harmonics 0 to 8 around the contact \
            edge. On other bodies the harmonics 1, 2, ... in time, root mean square over the contact nodes";
        #[serde(flatten)]
        stepped: Option<SteppedMotion> = "what else there is to a motion that was stepped in time";
    }

    /// A motion of the whole mesh that was stepped in time.
    SteppedMotion {
        residual: f64 = "what the motion misses its start by after a period, relative to its amplitude";
        periods: usize = "periods stepped to find it";
        steps: usize = "steps of a period";
        contact_node: usize = "label of the contact node that moves most along the counterface";
        kick_velocity: Option<f64> = "velocity of a kick that tips stable sliding into this cycle: \
            `2 pi f` times the amplitude of the unstable cycle between both, m/s";
        sound?: Sound = "estimate of the sound that it radiates, of a body with flat faces";
        harmonic_count: usize = "harmonics in which the motion is told";
        harmonic_remainder: f64 = "share of the vibration of the contact nodes that these leave";
        #[serde(skip)]
        harmonics_needed: usize = "harmonics that leave less than a thousandth";
    }
}

/// A perturbation, of a wave with the value of the parameter of its branch.
pub(super) type Exponent = (Option<f64>, Perturbation);

keys! {
    /// A contact node over the period.
    ContactNode, CONTACT_NODES {
        node: usize = "number of the node";
        x_m: f64 = "its place";
        y_m: f64 = "its place";
        z_m: f64 = "its place, of bodies in three dimensions";
        stick: f64 = "share of the period in which it sticks";
        slip: f64 = "share in which it slips";
        open: f64 = "share in which it is open";
        mean_pressure_pa: f64 = "mean contact pressure";
        mean_shear_pa: f64 = "mean of `shear_pa`, the friction traction along the node's tangent";
        amplitude_n_m: f64 = "half the range of its displacement along the normal";
        amplitude_t_m: f64 = "half the range along the counterface";
    }
}

impl CycleMotion {
    /// What a motion is on a body of such a thickness, m: what depends on its solver is left out.
    pub(super) fn of(motion: &PeriodicMotion, thickness: f64) -> Self {
        let powers = motion.powers.scaled(thickness);
        Self {
            main_frequency_hz: motion.frequency_hz,
            status: StatusFractions::of(motion.fractions),
            power_w: MeanPowers::of(&powers.contact, powers.material_damping),
            balance_residual: motion.powers.balance_residual(),
            amplitude_m: present(motion.amplitude),
            velocity_level_db: present(velocity_level(motion.velocity)),
            ..Self::default()
        }
    }
}
