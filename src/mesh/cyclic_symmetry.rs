//! Symmetry of a body whose sectors are alike.

use super::{Mesh, NodalFrames};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use std::f64::consts::TAU;

/// Distance, over the body's reach about the axis, up to which a node lies where its copy comes to lie.
const SAME_PLACE: f64 = 1e-10;

/// Rotation by `2 pi / count` about an axis brings the body onto itself.
///
/// The nodes of a mesh that has it come sector by sector in equal order: node `j n / count + i` of `n` is node `i` turned by `j`
/// sectors, and so is its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CyclicSymmetry {
    /// Number of sectors `N`, two or more.
    pub count: usize,
    /// A point of the axis, m.
    pub point: [f64; 3],
    /// Direction of the axis, a unit vector.
    pub direction: [f64; 3],
}

impl CyclicSymmetry {
    /// The rotation by `j` sectors.
    pub fn turn(&self, j: usize) -> Matrix3<f64> {
        let axis = Unit::new_normalize(Vector3::from(self.direction));
        let angle = TAU * (j % self.count) as f64 / self.count as f64;
        Rotation3::from_axis_angle(&axis, angle).into_inner()
    }

    /// A point turned about the axis.
    pub fn turned(&self, turn: &Matrix3<f64>, point: [f64; 3]) -> [f64; 3] {
        let center = Vector3::from(self.point);
        (center + turn * (Vector3::from(point) - center)).into()
    }

    /// The axis in words.
    pub(super) fn axis_text(&self) -> String {
        let [x, y, z] = self.point;
        match self.direction {
            [0.0, 0.0, _] => format!("the z axis through ({x}, {y})"),
            [a, b, c] => format!("the axis through ({x}, {y}, {z}) along ({a}, {b}, {c})"),
        }
    }

    /// Angle over which points reach around the axis: all but the widest gap between them, degrees.
    pub(super) fn extent_degrees(&self, points: &[[f64; 3]]) -> f64 {
        let along = Vector3::from(self.direction);
        let across = along.cross(&Vector3::ith(along.iamin(), 1.0)).normalize();
        let other = along.cross(&across);
        let angle = |point: &[f64; 3]| {
            let from_axis = Vector3::from(*point) - Vector3::from(self.point);
            from_axis.dot(&other).atan2(from_axis.dot(&across))
        };
        let mut angles: Vec<f64> = points.iter().map(angle).collect();
        angles.sort_by(f64::total_cmp);
        let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
            return 0.0;
        };
        let around = first + TAU - last;
        let gaps = angles.windows(2).map(|pair| pair[1] - pair[0]);
        (TAU - gaps.fold(around, f64::max)).to_degrees()
    }
}

impl Mesh {
    /// Nodes of one sector.
    pub fn nodes_per_sector(&self, symmetry: &CyclicSymmetry) -> usize {
        self.node_count() / symmetry.count
    }

    /// Takes up the symmetry of the file that the mesh was made of, lengths multiplied by `scale`: turns the nodal frames of a solid
    /// body with the sectors. Nothing happens to nodes that are not where it says.
    pub(super) fn take_symmetry(&mut self, of_file: Option<CyclicSymmetry>, scale: f64) {
        let Some(mut symmetry) = of_file else {
            return;
        };
        symmetry.point = symmetry.point.map(|x| scale * x);
        let own = self.nodes_per_sector(&symmetry);
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
            let Some(held) = held.get(&(node as u32)) else {
                return turned;
            };
            let is_held = |axis: &usize| {
                let column = turned.column(*axis);
                held.iter().map(|b| b.dot(&column).powi(2)).sum::<f64>() > 1.0 - 1e-12
            };
            match (0..3).filter(is_held).count() == held.len() {
                true => turned,
                false => self.frame(node),
            }
        });
        self.frames = NodalFrames::Solid(frames.collect());
    }
}
