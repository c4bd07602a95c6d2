//! Why a limit cycle of a body without symmetry was not found.

use crate::transient::TransientError;

/// A periodic motion that cannot be looked for or was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PeriodicError {
    /// The vibration dies.
    #[error(
        "the vibration dies out: what is left after {periods} periods is steady sliding. The mode \
         grows too slowly, or has no limit cycle of its own: a transient with a seed of this mode \
         tells"
    )]
    Died {
        /// Periods spent.
        periods: usize,
    },
    /// No node touches any more.
    #[error(
        "the body leaves its counterface: no contact node touches it over a whole period. Press it \
         (contact.interference, a boundary with a pressure) or lower the friction coefficient"
    )]
    Separated,
    /// The motion does not come back.
    #[error(
        "the motion does not repeat itself: after {periods} periods it still misses its start by \
         {residual:.1e} of its amplitude, at {frequency_hz:.2} Hz. It may have two frequencies or \
         no period. Let a transient tell, or come from a friction coefficient nearer to the onset"
    )]
    NotConverged {
        /// Periods spent.
        periods: usize,
        /// Smallest residual.
        residual: f64,
        /// Frequency there, Hz.
        frequency_hz: f64,
    },
    /// There is none to be found, or nothing to be told of it: why, and the remedy.
    #[error("{0}")]
    NotFound(String),
    /// The time loop cannot take the body.
    #[error(transparent)]
    Stepping(#[from] TransientError),
}

impl PeriodicError {
    /// The numbers grow out of all bounds.
    pub(super) fn unbounded(periods: usize) -> Self {
        Self::NotFound(format!(
            "the motion grows out of all bounds within {periods} periods: nothing in the contact \
             limits it"
        ))
    }

    /// A motion of such a period that still misses its start.
    pub(super) fn not_converged(periods: usize, residual: f64, period: f64) -> Self {
        Self::NotConverged { periods, residual, frequency_hz: 1.0 / period }
    }
}
