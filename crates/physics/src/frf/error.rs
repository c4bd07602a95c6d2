//! Errors of a computed frequency response.

use super::Terminal;
use crate::linalg::LinalgError;

/// A frequency response that cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrfError {
    /// A node that cannot be excited or observed.
    #[error("frf.{key} = {node} {fault}")]
    Node {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
        /// Why not.
        fault: NodeFault,
    },
    /// An axis of the mesh, on a body that is solved harmonic by harmonic.
    #[error(
        "frf.{key}: direction \"{direction}\" is for bodies from a mesh file; use \"radial\", \"tangential\" or \"axial\""
    )]
    NoAxes {
        /// Case key of the node.
        key: &'static str,
        /// `x`, `y` or `z`.
        direction: &'static str,
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
    #[error(
        "the reduced model still errs by {error:.1e} (bound {bound:.0e}) with {vectors} vectors: use \
         frf.method = \"auto\", which solves line by line then, or \"direct\""
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

/// Why a node cannot be excited or observed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NodeFault {
    /// It does not exist among so many.
    #[error("does not exist: the mesh has nodes 1 to {0}")]
    Missing(usize),
    /// It cannot move in that direction, `radial`, `tangential` or `axial`.
    #[error(
        "cannot move in {0} direction with this boundary: choose a node inside the body, \
         or frf.boundary = \"free\""
    )]
    Constrained(&'static str),
    /// It lies on the axis, where `radial` or `tangential` is nothing.
    #[error(
        "lies on the axis, where {0} has no direction: use \"x\", \"y\" or \"z\", or another node"
    )]
    OnAxis(&'static str),
    /// A force on a node of a surface that follows another one.
    #[error(
        "lies on a surface that is tied to or slides on another, and follows it. \
         Apply the force to a node beside the surface"
    )]
    Follows,
    /// A plane body, along its axis.
    #[error("cannot move in axial direction: the body is plane; use \"radial\" or \"tangential\"")]
    InPlane,
}

impl FrfError {
    /// The case key of the node that cannot be excited or observed.
    pub fn node_key(&self) -> Option<&'static str> {
        match self {
            Self::Node { key, .. } | Self::NoAxes { key, .. } => Some(key),
            _ => None,
        }
    }
}

impl Terminal {
    /// That it cannot be excited or observed; `key` is the case key of its node.
    pub(super) fn refused(self, key: &'static str, fault: NodeFault) -> FrfError {
        FrfError::Node { key, node: self.node + 1, fault }
    }

    /// That the boundary holds it.
    pub(super) fn constrained(self, key: &'static str) -> FrfError {
        self.refused(key, NodeFault::Constrained(self.direction.name()))
    }
}
