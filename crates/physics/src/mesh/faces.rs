//! Faces on the surface of a body, edges on the rim of a plane one.

use super::{BoundaryFace, FacePoint, Mesh};
use std::collections::{BTreeMap, BTreeSet};

/// Corners of a face in ascending order: what names it whichever side it is seen from.
pub(super) type FaceKey = [u32; 4];

/// The key of a face with the given corners.
pub(super) fn face_key(corners: impl IntoIterator<Item = u32>) -> FaceKey {
    let mut key = [u32::MAX; 4];
    key.iter_mut().zip(corners).for_each(|(place, corner)| *place = corner);
    key.sort_unstable();
    key
}

impl BoundaryFace {
    /// What names it.
    pub(super) fn key(&self) -> FaceKey {
        face_key(self.corners().iter().copied())
    }
}

impl Mesh {
    /// Face `face` of element `element`.
    pub(super) fn element_face(&self, element: usize, face: usize) -> BoundaryFace {
        let (kind, locals) = self.element_kind(element).faces()[face];
        let nodes = self.element_nodes(element);
        BoundaryFace {
            kind,
            element: element as u32,
            nodes: locals.iter().map(|&local| nodes[local]).collect(),
        }
    }

    /// Faces that belong to one element only, in the order of their elements: the surface of the body.
    pub fn outer_faces(&self) -> Vec<BoundaryFace> {
        // Key, element and number within it of every face of every element.
        let of_element = |element: usize| {
            let (kind, nodes) = (self.element_kind(element), self.element_nodes(element));
            kind.faces().iter().enumerate().map(move |(face, (kind, locals))| {
                let corners = locals[..kind.corner_count()].iter().map(|&local| nodes[local]);
                (face_key(corners), element, face)
            })
        };
        let mut faces: Vec<(FaceKey, usize, usize)> =
            (0..self.element_count()).flat_map(of_element).collect();
        faces.sort_unstable();
        let alone = faces.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() == 1);
        let mut alone: Vec<(usize, usize)> = alone.map(|own| (own[0].1, own[0].2)).collect();
        alone.sort_unstable();
        alone.into_iter().map(|(element, face)| self.element_face(element, face)).collect()
    }

    /// The same by what names them.
    pub(super) fn outer_faces_by_key(&self) -> BTreeMap<FaceKey, BoundaryFace> {
        self.outer_faces().into_iter().map(|face| (face.key(), face)).collect()
    }

    /// Edges that belong to one element only, as `(start, end, middle)` with the body on their left.
    pub fn outline_edges(&self) -> Vec<(u32, u32, Option<u32>)> {
        let faces = self.outer_faces().into_iter();
        faces.map(|face| (face.nodes[0], face.nodes[1], face.nodes.get(2).copied())).collect()
    }

    /// Gives every boundary the outline edges whose nodes are all its own.
    pub(super) fn add_edges_of_boundaries(&mut self) {
        let outer = self.outer_faces();
        for boundary in &mut self.boundaries {
            let nodes: BTreeSet<u32> = boundary.nodes.iter().copied().collect();
            let is_own = |face: &&BoundaryFace| face.nodes.iter().all(|node| nodes.contains(node));
            boundary.faces = outer.iter().filter(is_own).cloned().collect();
        }
    }

    /// Coordinates of the nodes of a face, m.
    pub fn face_points(&self, face: &BoundaryFace) -> Vec<[f64; 3]> {
        let nodes = face.nodes.iter();
        nodes.map(|&node| self.nodes[node as usize]).collect()
    }

    /// The points of a face's quadrature.
    pub fn quadrature(&self, face: &BoundaryFace) -> impl Iterator<Item = FacePoint> + use<> {
        let (kind, points) = (face.kind, self.face_points(face));
        kind.quadrature().into_iter().map(move |point| kind.at(&points, point))
    }

    /// Area of faces, m2; length of edges, m.
    pub fn face_area(&self, faces: &[BoundaryFace]) -> f64 {
        let size = |FacePoint { area: [x, y, z], .. }| -> f64 { x.hypot(y).hypot(z) };
        faces.iter().map(|face| self.quadrature(face).map(size).sum::<f64>()).sum()
    }

    /// Unit normal out of a solid body at each node of a surface: the mean of its faces there, by area. Nodes ascend.
    pub fn nodal_normals(&self, faces: &[BoundaryFace]) -> BTreeMap<u32, [f64; 3]> {
        let mut sums: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
        for face in faces {
            let points = self.face_points(face);
            for (&node, place) in face.nodes.iter().zip(face.kind.node_places()) {
                let area = face.kind.at(&points, (place, 1.0)).area;
                let sum = sums.entry(node).or_default();
                (0..3).for_each(|axis| sum[axis] += area[axis]);
            }
        }
        for sum in sums.values_mut() {
            let length = sum[0].hypot(sum[1]).hypot(sum[2]);
            sum.iter_mut().for_each(|component| *component /= length);
        }
        sums
    }
}
