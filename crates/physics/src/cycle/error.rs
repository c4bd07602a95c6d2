//! Errors of the search for a limit cycle, a wave or a motion of the whole mesh.

use super::{Family, LARGEST_FRICTION};
use crate::mesh::MeshError;
use crate::transient::TransientError;

/// A limit cycle that cannot be looked for or was not found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CycleError {
    /// The mesh cannot be built.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The case asks for what cannot be.
    #[error("{0}")]
    Asked(String),
    /// Steady sliding never loses stability to this wave.
    #[error(
        "{0}: steady sliding has no such loss of stability up to a friction coefficient of \
         {limit}, so no limit cycle is born. Only the modes of cea.modes or cea.max_frequency_hz \
         are looked at, else the lowest ones. Name another harmonic or onset",
        limit = LARGEST_FRICTION
    )]
    NoOnset(Family),
    /// The wave grows at any friction.
    #[error(
        "{0}: this wave grows without friction already, so it has no critical friction at \
         which a cycle could be born. Give the body some damping (damping.stiffness_coefficient)"
    )]
    Undamped(Family),
    /// The branch ends before the point asked for.
    #[error(
        "{family}: the branch of limit cycles does not reach {key} = {value:.6}: it ends at {reached:.6} \
         ({reason})"
    )]
    NotReached {
        /// Which limit cycle.
        family: Family,
        /// Case key of the parameter.
        key: &'static str,
        /// Value asked for, SI.
        value: f64,
        /// Last value, SI.
        reached: f64,
        /// Why it ends.
        reason: String,
    },
    /// The vibration dies.
    #[error(
        "the vibration dies out: what is left after {0} periods is steady sliding. The mode \
         grows too slowly, or has no limit cycle of its own: a transient with a seed of this mode \
         tells"
    )]
    Died(usize),
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
    /// There is none at the operating point, or nothing to be told of it: why, and the remedy.
    #[error("{0}")]
    NotFound(String),
    /// The mesh's time stepping cannot take the cycle.
    #[error(transparent)]
    Stepping(#[from] TransientError),
}

impl CycleError {
    /// Whether elements, mesh, damping or harmonics of the case are to blame, which hold for all cycles, rather than the operating point.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::Mesh(_) | Self::Asked(_) | Self::Undamped(_))
    }

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
