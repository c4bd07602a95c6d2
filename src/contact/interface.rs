//! The contact edge of a mesh.

use crate::mesh::Mesh2d;

/// Contact nodes with their geometry, in order of rising angle.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactInterface {
    /// 0-based node indices.
    pub nodes: Vec<u32>,
    /// Angle of each node, rad.
    pub angles: Vec<f64>,
    /// Edge length that belongs to each node, `w_i = ∫ N_i (n . e_i) ds`, m.
    pub tributary_lengths: Vec<f64>,
    /// Radius of the edge `a`, m.
    pub radius: f64,
}

impl ContactInterface {
    /// The inner edge of `mesh`.
    pub fn of(mesh: &Mesh2d) -> Self {
        let nodes = mesh.inner_edge.nodes.clone();
        let [x, y] = mesh.nodes[nodes[0] as usize];
        Self {
            angles: nodes
                .iter()
                .map(|&node| mesh.frame_angles[node as usize])
                .collect(),
            tributary_lengths: mesh.inner_edge.tributary_lengths.clone(),
            radius: x.hypot(y),
            nodes,
        }
    }

    /// Full dof of contact node `i`'s normal displacement.
    pub fn normal_dof(&self, i: usize) -> usize {
        2 * self.nodes[i] as usize
    }

    /// Full dof of contact node `i`'s tangential displacement.
    pub fn tangential_dof(&self, i: usize) -> usize {
        2 * self.nodes[i] as usize + 1
    }

    /// Number of contact nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}
