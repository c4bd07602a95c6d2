//! Why a limit cycle of a body without symmetry was not found.

use crate::transient::TransientError;

/// A periodic motion that cannot be looked for or was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PeriodicError {
    /// The vibration dies.
    #[error(
        "the vibration dies out: what is left after {periods} periods is steady sliding (the mode grows too slowly, or has no \
         limit cycle of its own; a transient with a seed of this mode tells)"
    )]
    Died {
        /// Periods spent.
        periods: usize,
    },
    /// No node touches any more.
    #[error(
        "the body leaves its counterface: no contact node touches it over a whole period; press it (contact.interference, a \
         boundary with a pressure) or lower the friction coefficient"
    )]
    Separated,
    /// The motion does not come back.
    #[error(
        "the motion does not repeat itself: after {periods} periods it still misses its start by {residual:.1e} of its \
         amplitude, at {frequency_hz:.2} Hz; it may be a motion of two frequencies or none that is periodic: let a transient \
         tell, or come from a friction coefficient nearer to the onset"
    )]
    NotConverged {
        /// Periods spent.
        periods: usize,
        /// Smallest residual.
        residual: f64,
        /// Frequency there, Hz.
        frequency_hz: f64,
    },
    /// The numbers grow out of all bounds.
    #[error(
        "the motion grows out of all bounds within {periods} periods: nothing in the contact limits it"
    )]
    Unbounded {
        /// Periods spent.
        periods: usize,
    },
    /// The leading multipliers do not converge.
    #[error(
        "the stability of this limit cycle cannot be told: no multiplier has converged after {dimension} periods; let a \
         transient tell (cycle.confirmation_periods)"
    )]
    Multipliers {
        /// Periods spent.
        dimension: usize,
    },
    /// The time loop cannot take the body.
    #[error(transparent)]
    Stepping(#[from] TransientError),
}
