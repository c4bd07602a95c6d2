//! Symmetry of a body whose sectors are alike.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use std::f64::consts::TAU;

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
    pub fn axis_text(&self) -> String {
        let [x, y, z] = self.point;
        match self.direction {
            [0.0, 0.0, _] => format!("the z axis through ({x}, {y})"),
            [a, b, c] => format!("the axis through ({x}, {y}, {z}) along ({a}, {b}, {c})"),
        }
    }

    /// Angle over which points reach around the axis: all but the widest gap between them, degrees.
    pub fn extent_degrees(&self, points: &[[f64; 3]]) -> f64 {
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
