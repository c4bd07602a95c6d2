//! Nodes, elements, regions and boundaries of plane and solid bodies, generated or made of a mesh file.

mod annulus;
mod body;
mod boundary;
mod chord;
mod coincidence;
mod counterface;
mod curve;
mod cyclic_symmetry;
mod error;
mod faces;
mod frames;
mod grid;
mod modification;
mod plane_body;
mod quality;
mod refinement;
mod repetition;
mod revolution;
mod rim;
mod solid;
mod solid_body;
mod specification;
mod splitting;

pub use annulus::AnnulusMesh;
pub use body::{BodySpecification, CounterfaceSpecification};
pub use boundary::{Boundary, BoundaryCondition, BoundaryFace, ElasticSupport};
pub use chord::Chord;
pub use coincidence::{UnmergedNodes, coincident_nodes};
pub use counterface::Counterface;
pub use error::{BodyError, BodyPart};
pub use frames::NodalFrames;
pub use frictionsim_formats::{
    CurveEdge, CyclicSymmetry, ElementKind, Equation, FacePoint, FileCondition, FileConditionKind,
    FileContact, FileElasticity, FileElement, FileMaterial, FileMesh, FileMotion, FileTie, LeftOut,
    MaterialAxes, MeshFileError, MeshFormat, ModelData, QuadraturePoint, Shape, SurfaceFace,
    included_text,
};
pub(crate) use grid::Grid;
pub use modification::{Attachment, DampedPatch};
pub use quality::MeshQuality;
pub use refinement::refined_file;
pub use repetition::repeated_file;
pub use revolution::{SheetElement, SheetNode, Strip};
pub use solid::{
    ContactRing, FaceElement, SolidContact, SolidFace, SolidPart, SolidSector, SolidSpecification,
    face_quadrature,
};
pub use specification::{AnnulusSpecification, MeshError, ShaftSpecification};

use nalgebra::Matrix3;
use std::collections::BTreeMap;

/// Nodes, elements, regions and named boundaries of a body of two or three dimensions, or of several bodies.
///
/// Each node carries a local frame (see [`NodalFrames`]); all nodal displacement vectors and matrices of this crate are written
/// in these frames, dof `dimension * node + axis`. On the annulus the frame is the polar one, `(e_r, e_theta)`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// 2 for a plane body, 3 for a solid one: components of a node's displacement.
    pub dimension: usize,
    /// Cartesian coordinates of each node, m; `z = 0` in the plane.
    pub nodes: Vec<[f64; 3]>,
    /// Local frame of each node.
    pub frames: NodalFrames,
    /// Kind of each element.
    pub element_kinds: Vec<ElementKind>,
    /// Where each element's nodes begin in `elements`, and the end of the last.
    pub element_starts: Vec<u32>,
    /// 0-based node indices of all elements, in the order of [`ElementKind`].
    pub elements: Vec<u32>,
    /// For each element the index of the first element that it is a rotated copy of (its own index
    /// where there is none): congruent elements share their matrices in nodal frames.
    pub congruent_to: Vec<u32>,
    /// Names of the regions.
    pub regions: Vec<String>,
    /// Region of each element.
    pub element_regions: Vec<u16>,
    /// Number of each node in the mesh file; empty for a generated mesh, whose numbers count from 1.
    pub labels: Vec<usize>,
    /// Named boundaries.
    pub boundaries: Vec<Boundary>,
    /// Which boundary of a plane body is the contact edge.
    pub contact: usize,
    /// The boundary of the other plane body that it slides on; `None` for a rigid counterface.
    pub opposite: Option<usize>,
    /// What slides along the contact edge; of two bodies the surface that both bound, as it is undeformed. The frames of its
    /// nodes are those of this surface.
    pub counterface: Counterface,
    /// Whether the body is a uniform annulus, all of whose sectors are alike.
    pub is_cyclic: bool,
    /// Masses, springs and dashpots at nodes.
    pub attachments: Vec<Attachment>,
    /// Elements with damping beside that of their material.
    pub patches: Vec<DampedPatch>,
    /// Sums of displacements of a solid body that vanish: `(node, axis, coefficient)` along the global axes.
    pub equations: Vec<Equation>,
    /// Symmetry of a mesh that was made of one sector.
    pub symmetry: Option<CyclicSymmetry>,
}

impl Mesh {
    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of degrees of freedom, held ones included.
    pub fn dof_count(&self) -> usize {
        self.dimension * self.nodes.len()
    }

    /// Coordinates `(x, y)` of a node, m.
    pub fn plane_node(&self, node: usize) -> [f64; 2] {
        let [x, y, _] = self.nodes[node];
        [x, y]
    }

    /// Coordinates `(x, y)` of all nodes, m.
    pub fn plane_nodes(&self) -> Vec<[f64; 2]> {
        self.nodes.iter().map(|&[x, y, _]| [x, y]).collect()
    }

    /// Unit vectors of a node's frame as columns.
    pub fn frame(&self, node: usize) -> Matrix3<f64> {
        self.frames.frame(node)
    }

    /// Angles of the frames of a plane body's nodes, rad.
    ///
    /// # Panics
    /// For a solid body, whose frames are no angles.
    pub fn frame_angles(&self) -> &[f64] {
        match &self.frames {
            NodalFrames::Plane(angles) => angles,
            NodalFrames::Solid(_) => panic!("the nodal frames of a solid body are no angles"),
        }
    }

    /// Adds an element of a region, a rotated copy of `congruent_to`.
    pub(super) fn push_element(
        &mut self,
        kind: ElementKind,
        nodes: impl IntoIterator<Item = u32>,
        (region, congruent_to): (usize, u32),
    ) {
        self.elements.extend(nodes);
        self.element_starts.push(self.elements.len() as u32);
        self.element_kinds.push(kind);
        self.element_regions.push(region as u16);
        self.congruent_to.push(congruent_to);
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.element_kinds.len()
    }

    /// Shape of element `element`.
    pub fn element_kind(&self, element: usize) -> ElementKind {
        self.element_kinds[element]
    }

    /// Region of element `element`.
    pub fn region(&self, element: usize) -> usize {
        usize::from(self.element_regions[element])
    }

    /// Node indices of element `element`.
    pub fn element_nodes(&self, element: usize) -> &[u32] {
        let range = self.element_starts[element]..self.element_starts[element + 1];
        &self.elements[range.start as usize..range.end as usize]
    }

    /// Dofs of the nodes of element `element` in turn.
    pub fn element_dofs(&self, element: usize) -> impl Iterator<Item = usize> {
        let (d, nodes) = (self.dimension, self.element_nodes(element).iter());
        nodes.flat_map(move |&node| d * node as usize..d * (node as usize + 1))
    }

    /// Whether all elements are four-node quadrilaterals.
    pub fn is_quad4(&self) -> bool {
        self.element_kinds.iter().all(|&kind| kind == ElementKind::Quad4)
    }

    /// The boundary called `name`.
    pub fn boundary(&self, name: &str) -> Option<&Boundary> {
        self.boundaries.iter().find(|boundary| boundary.name == name)
    }

    /// Direction of the first axis in which a node's motion and stress are reported, rad: outwards from the
    /// counterface, `e_r` about a shaft. It is that of the node's frame but along a guide.
    pub fn reported_angle(&self, node: usize) -> f64 {
        match self.is_cyclic {
            true => self.frame_angles()[node],
            false => self.counterface.normal_angle(self.plane_node(node)),
        }
    }

    /// Index of the node that lies nearest to a point, and its distance, m; the first of several.
    pub fn nearest_node(&self, point: [f64; 2]) -> Option<(usize, f64)> {
        let distance = |p: &[f64; 3]| (p[0] - point[0]).hypot(p[1] - point[1]);
        self.nodes.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Number of a node as the user knows it: that of the mesh file, or its index from 1.
    pub fn node_label(&self, node: usize) -> usize {
        self.labels.get(node).copied().unwrap_or(node + 1)
    }

    /// The contact edge.
    pub fn contact_edge(&self) -> &Boundary {
        &self.boundaries[self.contact]
    }

    /// Whether the contact edge is a whole hole about the origin, as on the annulus.
    pub fn has_round_contact(&self) -> bool {
        let is_shaft = matches!(
            self.counterface,
            Counterface::Cylinder { center: [0.0, 0.0], is_inside: true, .. }
        );
        is_shaft && self.contact_edge().is_closed
    }

    /// Corner points of a plane element's outline with mid-side nodes between them where it has any.
    pub fn element_outline(&self, element: usize) -> Vec<u32> {
        let nodes = self.element_nodes(element);
        self.element_kind(element).outline().into_iter().map(|local| nodes[local]).collect()
    }

    /// The body of each node, counted from the first: nodes that elements connect.
    pub fn bodies(&self) -> Vec<usize> {
        fn find(root: &mut [usize], mut node: usize) -> usize {
            while root[node] != node {
                root[node] = root[root[node]];
                node = root[node];
            }
            node
        }
        let mut root: Vec<usize> = (0..self.node_count()).collect();
        for element in 0..self.element_count() {
            let nodes = self.element_nodes(element);
            let first = find(&mut root, nodes[0] as usize);
            for &node in nodes {
                let other = find(&mut root, node as usize);
                root[other] = first;
            }
        }
        let mut numbers = BTreeMap::new();
        let number = |node| {
            let next = numbers.len();
            *numbers.entry(find(&mut root, node)).or_insert(next)
        };
        (0..self.node_count()).map(number).collect()
    }
}
