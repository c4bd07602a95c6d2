//! What can go wrong in an eigenvalue sweep.

use crate::linalg::LinalgError;
use thiserror::Error;

/// A sweep that cannot be computed, or whose result cannot be vouched for.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CeaError {
    /// The request names no friction value, or one that is negative or not finite.
    #[error(
        "friction coefficients must be one or more finite numbers of at least 0, got {value}: check \
         cea.friction_coefficients"
    )]
    FrictionCoefficients {
        /// The value refused (NaN where there is none).
        value: f64,
    },
    /// There is nothing to find.
    #[error(
        "no mode lies below {limit_hz} Hz (the lowest is at {lowest_hz:.1} Hz): raise \
         cea.max_frequency_hz above it"
    )]
    NoModes {
        /// Upper end of the frequency range, Hz.
        limit_hz: f64,
        /// Undamped frequency of the lowest mode without friction, Hz.
        lowest_hz: f64,
    },
    /// More modes were asked for than the mesh carries.
    #[error(
        "{wanted} modes were asked for, but the mesh has {unknowns} unknowns and carries at most \
         {bound}: lower cea.modes or refine [mesh]"
    )]
    TooManyModes {
        /// Modes asked for.
        wanted: usize,
        /// Unknowns of the mesh.
        unknowns: usize,
        /// Modes it can carry.
        bound: usize,
    },
    /// The iteration found another number of modes than the inertia of `K - sigma M` proves.
    #[error(
        "without friction the solver found {found} modes below {frequency_hz:.1} Hz, the inertia of \
         the stiffness counts {counted}"
    )]
    CountMismatch {
        /// Modes found.
        found: usize,
        /// Modes counted.
        counted: usize,
        /// Where, Hz.
        frequency_hz: f64,
    },
    /// An eigenpair stays above the residual bound.
    #[error(
        "at friction coefficient {friction_coefficient} the mode at {frequency_hz:.1} Hz keeps a \
         relative residual of {residual:.1e}, the bound is {bound:.0e}: not converged"
    )]
    NotConverged {
        /// Friction coefficient.
        friction_coefficient: f64,
        /// Frequency of the mode, Hz.
        frequency_hz: f64,
        /// Its residual.
        residual: f64,
        /// Largest residual accepted.
        bound: f64,
    },
    /// A branch that could not be continued, after a search for it.
    #[error(
        "the branch at {frequency_hz:.1} Hz (harmonic {harmonic}, branch {branch}) is lost between \
         friction coefficients {from} and {to}, and a search there did not find it"
    )]
    LostBranch {
        /// Circumferential harmonic.
        harmonic: usize,
        /// Branch within the harmonic.
        branch: usize,
        /// Frequency where it was last seen, Hz.
        frequency_hz: f64,
        /// Friction coefficient where it was last seen.
        from: f64,
        /// Friction coefficient where it is missing.
        to: f64,
    },
    /// A factorization or a dense decomposition failed.
    #[error("eigenvalue solver: {0}")]
    Linalg(#[from] LinalgError),
}
