//! Frames of a mesh whose sectors are alike.

use super::{CyclicSymmetry, Mesh, NodalFrames};
use nalgebra::{Matrix3, Vector3};

/// Distance, over the body's reach about the axis, up to which a node lies where its copy comes to lie.
const SAME_PLACE: f64 = 1e-10;

impl Mesh {
    /// Takes up the symmetry of the file that the mesh was made of, lengths multiplied by `scale`: turns the nodal frames of a solid
    /// body with the sectors. Nothing happens to nodes that are not where it says.
    pub(super) fn take_symmetry(&mut self, of_file: Option<CyclicSymmetry>, scale: f64) {
        let Some(mut symmetry) = of_file else { return };
        symmetry.point = symmetry.point.map(|x| scale * x);
        let own = self.node_count() / symmetry.count;
        let center = Vector3::from(symmetry.point);
        let reach = |point: &[f64; 3]| (Vector3::from(*point) - center).norm();
        let reach = self.nodes.iter().map(reach).fold(0.0, f64::max);
        let is_copy = |node: usize| {
            let copy = symmetry.turned(&symmetry.turn(node / own), self.nodes[node % own]);
            (Vector3::from(copy) - Vector3::from(self.nodes[node])).norm() <= SAME_PLACE * reach
        };
        let is_whole = own * symmetry.count == self.node_count();
        if !is_whole || !(own..self.node_count()).all(is_copy) {
            return;
        }
        if let NodalFrames::Solid(_) = &self.frames {
            self.turn_frames_with(&symmetry, own);
        }
        self.symmetry = Some(symmetry);
    }

    /// Turns the frame of each node with its sector, where that leaves what holds it along its axes.
    fn turn_frames_with(&mut self, symmetry: &CyclicSymmetry, own: usize) {
        let turns: Vec<Matrix3<f64>> = (0..symmetry.count).map(|j| symmetry.turn(j)).collect();
        let held = self.held_directions();
        let frames = (0..self.node_count()).map(|node| {
            let turned = turns[node / own] * self.frame(node % own);
            let Some(held) = held.get(&(node as u32)) else { return turned };
            let is_held = |axis: &usize| {
                let column = turned.column(*axis);
                held.iter().map(|b| b.dot(&column).powi(2)).sum::<f64>() > 1.0 - 1e-12
            };
            if (0..3).filter(is_held).count() == held.len() { turned } else { self.frame(node) }
        });
        self.frames = NodalFrames::Solid(frames.collect());
    }
}
