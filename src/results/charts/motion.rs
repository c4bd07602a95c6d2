//! Bodies that move, for pages that animate them.

use crate::chart::Motion;
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Most displacements of nodes that one page carries.
const MOST_DISPLACEMENTS: usize = 100_000;

/// A body by the corners of its elements.
pub struct MovingBody<'a> {
    mesh: &'a Mesh,
    /// Nodes that are corners, ascending.
    corners: Vec<u32>,
}

impl<'a> MovingBody<'a> {
    /// The corners of a mesh.
    pub fn new(mesh: &'a Mesh) -> Self {
        let rings = (0..mesh.element_count()).flat_map(|element| corners_of(mesh, element));
        let mut corners: Vec<u32> = rings.collect();
        corners.sort_unstable();
        corners.dedup();
        Self { mesh, corners }
    }

    /// Most motions that a page should carry, one at least.
    pub fn most_states(&self) -> usize {
        (MOST_DISPLACEMENTS / self.corners.len().max(1)).clamp(1, 16)
    }

    /// The body without a motion yet.
    pub fn at_rest(&self) -> Motion {
        let number = |node: u32| self.corners.binary_search(&node).ok().map(|at| at as u32);
        let cells = (0..self.mesh.element_count()).map(|element| {
            let ring = corners_of(self.mesh, element).into_iter();
            ring.filter_map(number).collect()
        });
        let edge = self.mesh.contact_edge().nodes.iter();
        Motion {
            positions: self.of(&self.mesh.plane_nodes()),
            cells: cells.collect(),
            edge: edge.filter_map(|&node| number(node)).collect(),
            states: Vec::new(),
        }
    }

    /// Displacements along x and y of the corners, from those of all nodes in their frames, two values a node.
    pub fn cartesian(&self, displacement: impl Fn(usize) -> [f64; 2]) -> Vec<[f64; 2]> {
        let place = |&node: &u32| {
            let (sin, cos) = self.mesh.frame_angles()[node as usize].sin_cos();
            let [u, v] = displacement(node as usize);
            [cos * u - sin * v, sin * u + cos * v]
        };
        self.corners.iter().map(place).collect()
    }

    /// What varies around each circle of nodes about the origin, in nodal frames: the wave without the state it rides on.
    pub fn wave(&self, displacement: &[f64]) -> Vec<[f64; 2]> {
        let radius = |node: usize| {
            (self.mesh.nodes[node][0].hypot(self.mesh.nodes[node][1]) * 1e9).round() as i64
        };
        let mut sums: BTreeMap<i64, [f64; 3]> = BTreeMap::new();
        for (node, u) in displacement.chunks_exact(2).enumerate() {
            let sum = sums.entry(radius(node)).or_default();
            *sum = [sum[0] + u[0], sum[1] + u[1], sum[2] + 1.0];
        }
        self.cartesian(|node| {
            let mean = sums
                .get(&radius(node))
                .map_or([0.0; 2], |s| [s[0] / s[2], s[1] / s[2]]);
            let value = |k: usize| displacement.get(2 * node + k).copied().unwrap_or(0.0);
            [value(0) - mean[0], value(1) - mean[1]]
        })
    }

    fn of<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let values = self.corners.iter().map(|&node| values[node as usize]);
        values.collect()
    }
}

fn corners_of(mesh: &Mesh, element: usize) -> Vec<u32> {
    let ring = mesh.element_outline(element);
    let step = if mesh.element_kind(element).is_quadratic() {
        2
    } else {
        1
    };
    ring.into_iter().step_by(step).collect()
}
