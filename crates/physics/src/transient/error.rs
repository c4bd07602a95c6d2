//! Errors that keep a transient from starting or from going on.

use crate::fem::operator::OperatorError;
use crate::prestress::PrestressError;

/// A transient that cannot start or cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransientError {
    /// A time that must be positive is not.
    #[error("{setting} = {value} s must be a positive finite time")]
    Time {
        /// Name of the setting.
        setting: &'static str,
        /// Given value, s.
        value: f64,
    },
    /// A value that must not be negative is.
    #[error("{setting} = {value} must be zero or a positive finite number")]
    Negative {
        /// Name of the setting.
        setting: &'static str,
        /// Given value.
        value: f64,
    },
    /// A time that must lie within the run does not.
    #[error(
        "{setting} = {value:?} s is beyond the end of the run, duration = {duration:?} s: {remedy}"
    )]
    BeyondEnd {
        /// Name of the setting.
        setting: &'static str,
        /// Given value, s.
        value: f64,
        /// Duration, s.
        duration: f64,
        /// What to change.
        remedy: &'static str,
    },
    /// The step is unstable.
    #[error(
        "time_step = {step:e} s is above the stability limit of {limit:.4e} s on this mesh \
         (largest frequency {largest_frequency:.4e} rad/s, damping included). Lower it, or use \
         \"auto\""
    )]
    StepAboveLimit {
        /// Given step, s.
        step: f64,
        /// Largest stable step, s.
        limit: f64,
        /// `omega_max`, rad/s.
        largest_frequency: f64,
    },
    /// Samples more often than steps.
    #[error(
        "sample_interval = {interval:e} s is below the time step of {step:.4e} s: raise it to at \
         least the step"
    )]
    SampleBelowStep {
        /// Given interval, s.
        interval: f64,
        /// Time step, s.
        step: f64,
    },
    /// A harmonic that the mesh cannot carry.
    #[error(
        "perturbation.harmonics holds {harmonic}, above {limit}, the highest harmonic that \
         {elements} elements around the circumference can carry"
    )]
    HarmonicAboveNyquist {
        /// Given harmonic.
        harmonic: usize,
        /// Highest harmonic.
        limit: usize,
        /// Circumferential elements.
        elements: usize,
    },
    /// A probe that is no node.
    #[error("probes holds {probe}: the mesh has nodes 1 to {count}")]
    UnknownProbe {
        /// Given 1-based node.
        probe: usize,
        /// Node count.
        count: usize,
    },
    /// A snapshot outside the run.
    #[error("snapshots holds {time} s: the run covers 0 to {duration} s")]
    SnapshotOutsideRun {
        /// Given time, s.
        time: f64,
        /// Duration, s.
        duration: f64,
    },
    /// The numbers stopped making sense.
    #[error(
        "the run became numerically unstable at t = {time:.6e} s (step {step}): {symptom}. The \
         fastest node is {node}, at {angle_degrees:.2} degrees and radius {radius:.4e} m, moving \
         at {speed:.3e} m/s; {cause}"
    )]
    Unstable {
        /// Time, s.
        time: f64,
        /// Step number.
        step: u64,
        /// What was seen.
        symptom: String,
        /// 1-based node with the largest velocity.
        node: usize,
        /// Its angle, degrees.
        angle_degrees: f64,
        /// Its radius, m.
        radius: f64,
        /// Its speed, m/s.
        speed: f64,
        /// Likely cause.
        cause: Breakdown,
    },
    /// A saved state that does not belong to this model.
    #[error("the saved state has {found} dofs, this model {expected}: it belongs to another case")]
    ForeignState {
        /// Dofs in the state.
        found: usize,
        /// Dofs of the model.
        expected: usize,
    },
    /// A saved record that does not belong to this run.
    #[error("the saved record does not belong to this run, or it is not whole")]
    ForeignRecord,
    /// A start that the time loop cannot work out by itself.
    #[error("a start on a limit cycle needs the fields of the cycle of {harmonic} nodal diameters")]
    FieldsMissing {
        /// Circumferential harmonic.
        harmonic: usize,
    },
    /// The operator cannot represent the mesh.
    #[error(transparent)]
    Operator(#[from] OperatorError),
    /// The steady sliding start does not exist.
    #[error(transparent)]
    Prestress(#[from] PrestressError),
}

impl TransientError {
    /// Name of the setting that does not fit, which the message begins with; `None` where no single one is to blame.
    pub fn setting(&self) -> Option<&'static str> {
        Some(match self {
            Self::Time { setting, .. }
            | Self::Negative { setting, .. }
            | Self::BeyondEnd { setting, .. } => setting,
            Self::StepAboveLimit { .. } => "time_step",
            Self::SampleBelowStep { .. } => "sample_interval",
            Self::HarmonicAboveNyquist { .. } => "perturbation.harmonics",
            Self::UnknownProbe { .. } => "probes",
            Self::SnapshotOutsideRun { .. } => "snapshots",
            _ => return None,
        })
    }
}

/// Why the numbers of a run stopped making sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Breakdown {
    /// Beyond the range of numbers.
    #[error(
        "values left the range of numbers: rotation speed, interference or perturbation is too large, or the time step"
    )]
    Overflow,
    /// The step is unstable.
    #[error("the time step is above the stability limit")]
    StepTooLong,
    /// Forces and speeds of very different size.
    #[error(
        "round-off dominates: forces and speeds are not of a sensible size, or the time step is too long"
    )]
    RoundOff,
}
