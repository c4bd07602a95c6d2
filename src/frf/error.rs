//! Errors of a computed frequency response.

use super::Terminal;
use crate::linalg::LinalgError;

/// A frequency response that cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrfError {
    /// The node does not exist.
    #[error("frf.{key} = {node} does not exist: the mesh has nodes 1 to {count}")]
    NoNode {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
        /// Number of nodes.
        count: usize,
    },
    /// The node cannot move in that direction.
    #[error(
        "frf.{key} = {node} cannot move in {direction} direction with this boundary: choose a node \
         inside the body, or frf.boundary = \"free\""
    )]
    Constrained {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
        /// `radial`, `tangential` or `axial`.
        direction: &'static str,
    },
    /// A plane body, along its axis.
    #[error(
        "frf.{key} = {node} cannot move in axial direction: the body is plane; use \"radial\" or \"tangential\", or \
         material.formulation = \"three-dimensional\""
    )]
    InPlane {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
    },
    /// A frequency that is not positive.
    #[error("frequency {value} Hz must be positive and finite: check frf.frequencies")]
    Frequency {
        /// The value, Hz.
        value: f64,
    },
    /// The system is singular at a frequency.
    #[error("at {frequency_hz} Hz: {source}")]
    Factorization {
        /// Frequency, Hz.
        frequency_hz: f64,
        /// What the factorization reported.
        source: LinalgError,
    },
    /// The reduction does not reach its tolerance.
    #[error(
        "the reduced model still errs by {error:.1e} (bound {bound:.0e}) with {vectors} vectors: use \
         frf.method = \"cyclic\""
    )]
    NotReduced {
        /// Error found at the check lines.
        error: f64,
        /// Bound asked for.
        bound: f64,
        /// Vectors in the basis.
        vectors: usize,
    },
}

impl FrfError {
    /// The case key of the node that cannot be excited or observed.
    pub fn node_key(&self) -> Option<&'static str> {
        match self {
            Self::NoNode { key, .. }
            | Self::Constrained { key, .. }
            | Self::InPlane { key, .. } => Some(key),
            _ => None,
        }
    }

    /// The boundary holds this terminal.
    pub(super) fn constrained(terminal: Terminal, key: &'static str) -> Self {
        Self::Constrained {
            key,
            node: terminal.node + 1,
            direction: terminal.direction.name(),
        }
    }

    /// A plane body has no such terminal.
    pub(super) fn in_plane(terminal: Terminal, key: &'static str) -> Self {
        Self::InPlane {
            key,
            node: terminal.node + 1,
        }
    }
}
