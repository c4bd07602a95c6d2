//! Bodies that move, for pages that animate them.

use super::solid::edge_paths;
use crate::prelude::*;

/// Most displacements of nodes that one page carries.
const MOST_DISPLACEMENTS: usize = 100_000;

/// A body by the corners of its elements; a solid one by those of its surface.
pub struct MovingBody<'a> {
    mesh: &'a Mesh,
    /// Nodes that are corners, ascending.
    corners: Vec<u32>,
    /// Faces of the surface of a solid body, one for each cell.
    faces: Vec<BoundaryFace>,
    /// The body without a motion yet.
    pub at_rest: Motion,
}

impl<'a> MovingBody<'a> {
    /// The corners of a mesh.
    pub fn new(mesh: &'a Mesh) -> Self {
        match mesh.dimension {
            2 => {
                let rings = (0..mesh.element_count()).map(|element| corners_of(mesh, element));
                Self::of_rings(mesh, rings.collect(), Vec::new(), &[])
            }
            _ => Self::of_surface(mesh, false),
        }
    }

    /// The surface of solid bodies, with the edges of all their elements or those of their shape.
    pub fn of_surface(mesh: &'a Mesh, has_all_edges: bool) -> Self {
        let faces = mesh.outer_faces();
        let ring = |face: &BoundaryFace| face.nodes[..face.kind.corner_count()].to_vec();
        let rings = faces.iter().map(ring).collect();
        let edges = edge_paths(mesh, &faces, has_all_edges).into_iter();
        let lines: Vec<[u32; 2]> = edges.map(|path| [path[0], path[path.len() - 1]]).collect();
        Self::of_rings(mesh, rings, faces, &lines)
    }

    fn of_rings(
        mesh: &'a Mesh,
        rings: Vec<Vec<u32>>,
        faces: Vec<BoundaryFace>,
        lines: &[[u32; 2]],
    ) -> Self {
        let mut corners: Vec<u32> = rings.iter().flatten().copied().collect();
        corners.sort_unstable();
        corners.dedup();
        let number = |node: &u32| corners.binary_search(node).ok().map(|at| at as u32);
        let edge: &[u32] = if mesh.dimension == 2 { &mesh.contact_edge().nodes } else { &[] };
        let line = |[start, end]: &[u32; 2]| Some([number(start)?, number(end)?]);
        let at_rest = Motion {
            dimension: mesh.dimension,
            positions: corners.iter().map(|&node| mesh.nodes[node as usize]).collect(),
            cells: rings.iter().map(|ring| ring.iter().filter_map(number).collect()).collect(),
            edge: edge.iter().filter_map(number).collect(),
            lines: lines.iter().filter_map(line).collect(),
            states: Vec::new(),
        };
        Self { mesh, corners, faces, at_rest }
    }

    /// Most motions that a page should carry, one at least.
    pub fn most_states(&self) -> usize {
        (MOST_DISPLACEMENTS / self.corners.len().max(1)).clamp(1, 16)
    }

    /// The surface of a solid body in the colours of parts; `parts` has colour and name of each in mark-up ("": not
    /// there).
    pub fn parts(
        &self,
        part_of: impl Fn(&BoundaryFace) -> usize,
        parts: &[(&'static str, String)],
    ) -> MotionKind {
        MotionKind::Parts {
            part_of: self.faces.iter().map(|face| part_of(face) as u32).collect(),
            parts: parts.iter().map(|(colour, name)| ((*colour).into(), plain(name))).collect(),
        }
    }

    /// Displacements along x, y and z of the corners, from those of all nodes in their frames.
    pub fn cartesian(&self, displacement: impl Fn(usize) -> [f64; 3]) -> Vec<[f64; 3]> {
        let place = |&node: &u32| {
            let node = node as usize;
            (self.mesh.frame(node) * nalgebra::Vector3::from(displacement(node))).into()
        };
        self.corners.iter().map(place).collect()
    }

    /// What varies around each circle of nodes about the origin, in nodal frames of a plane body: the wave without the
    /// state it rides on.
    pub fn wave(&self, displacement: &[f64]) -> Vec<[f64; 3]> {
        let radius = |node: usize| {
            (self.mesh.nodes[node][0].hypot(self.mesh.nodes[node][1]) * 1e9).round() as i64
        };
        let mut sums: BTreeMap<i64, [f64; 3]> = BTreeMap::new();
        for (node, u) in displacement.chunks_exact(2).enumerate() {
            let sum = sums.entry(radius(node)).or_default();
            *sum = [sum[0] + u[0], sum[1] + u[1], sum[2] + 1.0];
        }
        self.cartesian(|node| {
            let mean = sums.get(&radius(node)).map_or([0.0; 2], |s| [s[0] / s[2], s[1] / s[2]]);
            let value = |k: usize| displacement.get(2 * node + k).copied().unwrap_or(0.0);
            [value(0) - mean[0], value(1) - mean[1], 0.0]
        })
    }
}

fn corners_of(mesh: &Mesh, element: usize) -> Vec<u32> {
    let ring = mesh.element_outline(element);
    let step = if mesh.element_kind(element).is_quadratic() { 2 } else { 1 };
    ring.into_iter().step_by(step).collect()
}
