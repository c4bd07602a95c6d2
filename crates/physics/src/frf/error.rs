//! Errors of a computed frequency response.

use super::Terminal;
use crate::linalg::LinalgError;

/// A frequency response that cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrfError {
    /// A node that cannot be excited or observed.
    #[error("frf.{key}{fault}")]
    Node {
        /// Case key.
        key: &'static str,
        /// Why not, and what to do.
        fault: String,
    },
    /// A frequency that is not positive.
    #[error("frequency {0} Hz must be positive and finite: check frf.frequencies_hz")]
    Frequency(f64),
    /// The system is singular at a frequency.
    #[error("at {frequency_hz} Hz: {source}")]
    Factorization {
        /// Frequency, Hz.
        frequency_hz: f64,
        /// What the factorization reported.
        source: LinalgError,
    },
    /// The reduction does not reach its tolerance.
    #[error("{0}")]
    NotReduced(String),
}

impl FrfError {
    /// The case key of the node that cannot be excited or observed.
    pub fn node_key(&self) -> Option<&'static str> {
        match self {
            Self::Node { key, .. } => Some(key),
            _ => None,
        }
    }
}

impl Terminal {
    /// That it cannot be excited or observed; `key` is the case key of its node.
    pub(super) fn refused(self, key: &'static str, fault: &str) -> FrfError {
        FrfError::Node { key, fault: format!(" = {} {fault}", self.node + 1) }
    }

    /// That it does not exist among so many nodes.
    pub(super) fn missing(self, key: &'static str, count: usize) -> FrfError {
        self.refused(key, &format!("does not exist: the mesh has nodes 1 to {count}"))
    }

    /// That its body is plane, and does not move along its axis.
    pub(super) fn in_plane(self, key: &'static str) -> FrfError {
        let fault =
            "cannot move in axial direction: the body is plane; use \"radial\" or \"tangential\"";
        self.refused(key, fault)
    }

    /// That the boundary holds it.
    pub(super) fn constrained(self, key: &'static str) -> FrfError {
        let direction = self.direction.name();
        let fault = format!(
            "cannot move in {direction} direction with this boundary: choose a node inside the body, or frf.boundary = \"free\""
        );
        self.refused(key, &fault)
    }
}
