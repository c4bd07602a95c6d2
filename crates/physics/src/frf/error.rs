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
    /// Radius and tangent of a node on the axis.
    #[error(
        "frf.{key} = {node} lies on the axis, where {direction} has no direction: use \"x\", \"y\" or \"z\", or another node"
    )]
    OnAxis {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
        /// `radial` or `tangential`.
        direction: &'static str,
    },
    /// A force on a node of a surface that follows another one.
    #[error(
        "frf.{key} = {node} lies on a surface that is tied to or slides on another, and follows \
         it. Apply the force to a node beside the surface"
    )]
    Follows {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
    },
    /// A plane body, along its axis.
    #[error(
        "frf.{key} = {node} cannot move in axial direction: the body is plane; use \"radial\" or \"tangential\""
    )]
    InPlane {
        /// Case key.
        key: &'static str,
        /// Node id, from 1.
        node: usize,
    },
    /// A frequency that is not positive.
    #[error("frequency {value} Hz must be positive and finite: check frf.frequencies_hz")]
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

impl FrfError {
    /// The case key of the node that cannot be excited or observed.
    pub fn node_key(&self) -> Option<&'static str> {
        match self {
            Self::NoNode { key, .. }
            | Self::Constrained { key, .. }
            | Self::InPlane { key, .. }
            | Self::NoAxes { key, .. }
            | Self::OnAxis { key, .. }
            | Self::Follows { key, .. } => Some(key),
            _ => None,
        }
    }

    /// The boundary holds this terminal.
    pub(super) fn constrained(terminal: Terminal, key: &'static str) -> Self {
        Self::Constrained { key, node: terminal.node + 1, direction: terminal.direction.name() }
    }

    /// A plane body has no such terminal.
    pub(super) fn in_plane(terminal: Terminal, key: &'static str) -> Self {
        Self::InPlane { key, node: terminal.node + 1 }
    }
}
