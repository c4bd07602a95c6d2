//! What a mesh file holds, of whatever format.

use crate::prelude::*;
/// A mesh file that is not what its format says.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
pub struct MeshFileError {
    /// Line or byte.
    pub place: String,
    /// What is wrong, and what to do.
    pub message: String,
}

/// What comes of reading a file or a part of it.
pub(crate) type Result<T, E = MeshFileError> = std::result::Result<T, E>;

/// Edge of a physical curve, as indices into the nodes: its ends and, where quadratic, its middle.
pub type CurveEdge = (u32, u32, Option<u32>);

/// Face of a physical surface of a solid body: its kind and its nodes.
pub type SurfaceFace = (ElementKind, Vec<u32>);

/// What a mesh file holds of a body, plane or solid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileMesh {
    /// Number of each node in the file.
    pub labels: Vec<usize>,
    /// Coordinates as in the file.
    pub points: Vec<[f64; 3]>,
    /// 3 where the file has solid elements, else 2.
    pub dimension: usize,
    /// The elements of the body: solid ones where the file has any, else plane ones.
    pub elements: Vec<FileElement>,
    /// Edges of each physical curve.
    pub curves: BTreeMap<String, Vec<CurveEdge>>,
    /// Faces of each physical surface of a solid body.
    pub surfaces: BTreeMap<String, Vec<SurfaceFace>>,
    /// Whether each node has some element, a point included.
    pub is_used: Vec<bool>,
    /// Named sets of nodes of a solid body that are not all the nodes of some faces.
    pub node_sets: BTreeMap<String, Vec<u32>>,
    /// Sums of displacements of a solid body that vanish.
    pub equations: Vec<Equation>,
    /// What the file holds beside the mesh.
    pub model: ModelData,
    /// Symmetry of a body that was made of one sector, in the unit of the file.
    pub symmetry: Option<CyclicSymmetry>,
}

/// One element of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct FileElement {
    /// Its number in the file.
    pub label: usize,
    /// Its shape.
    pub kind: ElementKind,
    /// Name of its physical surface, one text for all its elements.
    pub region: Arc<str>,
    /// The surface it belongs to.
    pub entity: i64,
    /// Its nodes in the order of [`ElementKind`].
    pub nodes: Vec<u32>,
}
