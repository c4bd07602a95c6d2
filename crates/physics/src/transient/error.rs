//! Errors that keep a transient from starting or from going on.

use crate::fem::operator::OperatorError;
use crate::prestress::PrestressError;

/// A transient that cannot start or cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransientError {
    /// A setting that does not fit.
    #[error("{setting}{problem}")]
    Setting {
        /// Its name, which the message begins with.
        setting: &'static str,
        /// What would fit, in a few words.
        fitting: String,
        /// What is wrong with its value, and the remedy.
        problem: String,
    },
    /// The numbers stopped making sense.
    #[error("the run became numerically unstable at {problem}; {cause}")]
    Unstable {
        /// When, what was seen, and the node with the largest velocity.
        problem: String,
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
    #[error("a start on a limit cycle needs the fields of the cycle of {0} nodal diameters")]
    FieldsMissing(usize),
    /// The operator cannot represent the mesh.
    #[error(transparent)]
    Operator(#[from] OperatorError),
    /// The steady sliding start does not exist.
    #[error(transparent)]
    Prestress(#[from] PrestressError),
}

impl TransientError {
    /// A setting that does not fit: its name, what would fit, and what is wrong with its value, after the name.
    pub(super) fn setting(setting: &'static str, fitting: String, problem: String) -> Self {
        Self::Setting { setting, fitting, problem }
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
