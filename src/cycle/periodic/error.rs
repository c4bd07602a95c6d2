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
    /// The motion has two frequencies.
    #[error(
        "the motion does not repeat itself: a transient from this mode vibrates at two \
         frequencies, {:.2} and {:.2} Hz, without a common period. `transient` follows it \
         (end_state two-frequency). From another operating point cycle.continuation tells where a \
         cycle gives way to it",
        frequencies_hz[0], frequencies_hz[1]
    )]
    TwoFrequencies {
        /// Both, the stronger first, Hz.
        frequencies_hz: [f64; 2],
    },
    /// The numbers grow out of all bounds.
    #[error(
        "the motion grows out of all bounds within {periods} periods: nothing in the contact limits it"
    )]
    Unbounded {
        /// Periods spent.
        periods: usize,
    },
    /// The branch that was followed does not reach the operating point.
    #[error(
        "steady sliding is stable at {key} = {value} and has no limit cycle beside it. Those of \
         this mode live from {:.4} to {:.4} within the range of cycle.continuation",
        range[0], range[1]
    )]
    NotHere {
        /// The parameter.
        key: &'static str,
        /// The case's own value, in units of the key.
        value: f64,
        /// Where cycles were found.
        range: [f64; 2],
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

impl PeriodicError {
    /// A motion of such a period that still misses its start.
    pub(super) fn not_converged(periods: usize, residual: f64, period: f64) -> Self {
        Self::NotConverged { periods, residual, frequency_hz: 1.0 / period }
    }
}
