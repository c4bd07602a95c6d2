//! Nodes, elements and boundaries of a two-dimensional mesh, and the annulus generator.

mod annulus;
mod sector;

pub use annulus::{AnnulusMesh, AnnulusSpecification, MeshError};
pub use sector::SectorMesh;

/// Shape of every element of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Four-node bilinear quadrilateral.
    Quad4,
    /// Eight-node serendipity quadrilateral.
    Quad8,
}

impl ElementKind {
    /// Nodes of one element.
    pub fn node_count(self) -> usize {
        match self {
            Self::Quad4 => 4,
            Self::Quad8 => 8,
        }
    }
}

/// An ordered chain of boundary nodes.
///
/// `nodes` are 0-based node indices in order of increasing angle, corner and mid-side nodes alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Boundary {
    /// 0-based node indices along the boundary.
    pub nodes: Vec<u32>,
    /// Tributary length of each node, `∫ N_i (n . e_i) ds` over the boundary with `n` its normal and
    /// `e_i` the node's own first axis, m: the force that unit pressure exerts along that axis.
    pub tributary_lengths: Vec<f64>,
}

/// Nodes, elements and named boundaries of a plane mesh.
///
/// Each node carries a local frame `(e_1, e_2)` turned counter-clockwise from the global axes by
/// `frame_angles[i]`; all nodal displacement vectors and matrices of this crate are written in these
/// frames. On the annulus the frame is the polar one, `(e_r, e_theta)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh2d {
    /// Shape of every element.
    pub element_kind: ElementKind,
    /// Cartesian coordinates of each node, m.
    pub nodes: Vec<[f64; 2]>,
    /// Angle of each node's local frame, rad.
    pub frame_angles: Vec<f64>,
    /// 0-based node indices, `element_kind.node_count()` for each element: corners
    /// counter-clockwise, then (Quad8) the mid-side node after each corner.
    pub elements: Vec<u32>,
    /// For each element the index of the first element that it is a rotated copy of (its own index
    /// where there is none): congruent elements share their matrices in nodal frames.
    pub congruent_to: Vec<u32>,
    /// The contact edge.
    pub inner_edge: Boundary,
    /// The clamped edge.
    pub outer_edge: Boundary,
}

impl Mesh2d {
    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.elements.len() / self.element_kind.node_count()
    }

    /// Node indices of element `element`.
    pub fn element_nodes(&self, element: usize) -> &[u32] {
        let count = self.element_kind.node_count();
        &self.elements[element * count..(element + 1) * count]
    }
}
