//! Settings of a transient, checked before it runs.

use super::{Perturbation, TransientError};
use crate::fem::{MaterialField, MaxwellChain, RayleighDamping};
use crate::mesh::Mesh;

/// Share of the stability limit that an automatic time step uses.
pub const SAFETY: f64 = 0.95;

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// A fixed share of the stability limit of the operator.
    Auto,
    /// Given, s.
    Seconds(f64),
}

/// State at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InitialState {
    /// Undeformed; the cylinder expands.
    Rest,
    /// The prestressed sliding equilibrium, with the cylinder fully expanded.
    SteadySliding,
    /// The limit cycle of a circumferential harmonic, with the cylinder fully expanded; its fields are handed to
    /// [`CentralDifference::start_from`](super::CentralDifference::start_from).
    LimitCycle {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Onset of that harmonic that the cycle is born at, from 1 by rising critical friction.
        onset: usize,
    },
}

impl InitialState {
    /// Its name, in cases and in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::SteadySliding => "steady-sliding",
            Self::LimitCycle { .. } => "limit-cycle",
        }
    }
}

/// Which operator applies the stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperatorChoice {
    /// The stencil where the mesh has one, else sparse.
    Auto,
    /// The cyclic stencil.
    Cyclic,
    /// 2 x 2 block rows.
    Sparse,
}

/// Choices of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TransientSettings {
    /// Simulated time, s.
    pub duration: f64,
    /// Time step.
    pub time_step: TimeStep,
    /// Time between samples, s.
    pub sample_interval: f64,
    /// Time over which the interference grows linearly from zero, s.
    pub expansion_time: f64,
    /// State at the start.
    pub initial: InitialState,
    /// Initial velocity of the body.
    pub perturbation: Perturbation,
}

impl TransientSettings {
    /// From steady sliding or from given fields, without a perturbation.
    pub fn sliding(duration: f64, time_step: TimeStep, sample_interval: f64) -> Self {
        Self {
            duration,
            time_step,
            sample_interval,
            expansion_time: 0.0,
            initial: InitialState::SteadySliding,
            perturbation: Perturbation::default(),
        }
    }

    /// Time over which the interference grows, s: all starts but that at rest are fully expanded, a ramp of no length.
    pub(super) fn ramp_time(&self) -> f64 {
        if self.initial == InitialState::Rest { self.expansion_time } else { 0.0 }
    }
}

/// Largest stable step of central differences whose damping force lags half a step, s.
///
/// ```text
/// dt <= 2 / omega_max (sqrt(1 + zeta^2) - zeta),   zeta = (alpha_R / omega_max + beta_R omega_max) / 2
/// ```
///
/// `omega_max` in rad/s is that of the body with a free contact edge: contact takes dofs away and lowers it.
pub fn stable_step_limit(largest_frequency: f64, damping: &RayleighDamping) -> f64 {
    let zeta = damping.damping_factor(largest_frequency);
    // The difference of the two terms, without cancellation at heavy damping.
    2.0 / largest_frequency / ((1.0 + zeta * zeta).sqrt() + zeta)
}

/// Time step, samples and steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPlan {
    /// Time step, s.
    pub time_step: f64,
    /// Stability limit, s.
    pub limit: f64,
    /// `omega_max`, rad/s.
    pub largest_frequency: f64,
    /// Steps from one sample to the next.
    pub steps_per_sample: u64,
    /// Samples of the run, the first at time zero and the last at its end.
    pub samples: u64,
    /// Time between samples, s.
    pub sample_interval: f64,
}

impl StepPlan {
    /// Chooses the step below a `limit` (s), that of the highest frequency (rad/s): the given one, or 0.95 of the limit, lowered so that it
    /// divides the sample interval. It does not depend on the duration; the run is as many whole sample intervals as lie within that.
    pub(super) fn within(
        limit: f64,
        largest_frequency: f64,
        settings: &TransientSettings,
    ) -> Result<Self, TransientError> {
        let wanted = match settings.time_step {
            TimeStep::Auto => (SAFETY * limit).min(settings.sample_interval),
            TimeStep::Seconds(step) if step > limit => {
                let problem = format!(
                    " = {step:e} s is above the stability limit of {limit:.4e} s on this mesh (largest frequency {largest_frequency:.4e} \
                     rad/s, damping included). Lower it, or use \"auto\""
                );
                let fitting = format!("at most {limit:.4e}");
                return Err(TransientError::setting("time_step", fitting, problem));
            }
            TimeStep::Seconds(step) => step,
        };
        let interval = settings.sample_interval;
        // A millionth of slack: 2e-6 / 1e-7 must be 20 steps, not 21.
        if interval < wanted * (1.0 - 1e-6) {
            let problem = format!(
                " = {interval:e} s is below the time step of {wanted:.4e} s: raise it to at least the step"
            );
            let fitting = format!("at least {wanted:.4e}");
            return Err(TransientError::setting("sample_interval", fitting, problem));
        }
        let steps_per_sample = (interval / wanted * (1.0 - 1e-6)).ceil().max(1.0);
        Ok(Self {
            time_step: interval / steps_per_sample,
            limit,
            largest_frequency,
            steps_per_sample: steps_per_sample as u64,
            samples: whole_intervals(settings.duration, interval) + 1,
            sample_interval: interval,
        })
    }

    /// Steps of the whole run; the last one makes the velocity around the last sample.
    pub fn total_steps(&self) -> u64 {
        1_u64.saturating_add((self.samples - 1).saturating_mul(self.steps_per_sample))
    }

    /// Time of a sample, s.
    pub fn sample_time(&self, index: u64) -> f64 {
        index as f64 * self.sample_interval
    }

    /// Time of the last sample, s.
    pub fn end_time(&self) -> f64 {
        self.sample_time(self.samples - 1)
    }
}

/// Whole sample intervals within a duration (both s), a billionth of slack for their round-off.
pub fn whole_intervals(duration: f64, sample_interval: f64) -> u64 {
    (duration / sample_interval * (1.0 + 1e-9)).floor() as u64
}

pub(super) fn check_times(settings: &TransientSettings) -> Result<(), TransientError> {
    let perturbation = &settings.perturbation;
    let step = match settings.time_step {
        TimeStep::Seconds(step) => step,
        TimeStep::Auto => settings.sample_interval,
    };
    let velocities = perturbation.waves.iter().map(|wave| wave.velocity.abs());
    for (setting, value, is_positive) in [
        ("duration", settings.duration, true),
        ("sample_interval", settings.sample_interval, true),
        ("time_step", step, true),
        ("expansion_time", settings.expansion_time, false),
        ("perturbation.velocity", velocities.fold(0.0, f64::max), false),
        ("perturbation.noise", perturbation.noise, false),
        ("perturbation.at", perturbation.time, false),
    ] {
        let (is_high, must, fitting) = match is_positive {
            true => (value > 0.0, "s must be a positive finite time", "a positive time"),
            false => (value >= 0.0, "must be zero or a positive finite number", "zero or more"),
        };
        if !(is_high && value.is_finite()) {
            let problem = format!(" = {value} {must}");
            return Err(TransientError::setting(setting, fitting.to_owned(), problem));
        }
    }
    let duration = settings.duration;
    for (setting, value, remedy) in [
        ("sample_interval", settings.sample_interval, "a run has two samples at least"),
        ("expansion_time", settings.ramp_time(), "the cylinder would never be fully expanded"),
        ("perturbation.at", perturbation.time, "the velocity would never be added"),
    ] {
        if value > duration * (1.0 + 1e-9) {
            let problem = format!(
                " = {value:?} s is beyond the end of the run, duration = {duration:?} s: {remedy}"
            );
            return Err(TransientError::setting(setting, format!("at most {duration:?}"), problem));
        }
    }
    Ok(())
}

/// Square root of the largest stiffness at once over that at rest of the regions of a mesh: Maxwell elements stiffen a body that
/// moves fast.
pub(super) fn stiffening(mesh: &Mesh, materials: &dyn MaterialField) -> f64 {
    let regions = 0..mesh.regions.len().max(1);
    let chains = regions.filter_map(|region| materials.chain(region));
    chains.map(MaxwellChain::glassy).fold(1.0, f64::max).sqrt()
}
