//! Faces of elements: lines in the plane, triangles and quadrilaterals of solids.

use super::ElementKind;
use super::rule::QuadraturePoint;

/// A point of a face.
#[derive(Clone, Debug, PartialEq)]
pub struct FacePoint {
    /// Shape functions of the face's nodes.
    pub values: Vec<f64>,
    /// Where it is, m.
    pub position: [f64; 3],
    /// Outward normal times the area that belongs to the point, m2; of a line times its length, m.
    pub area: [f64; 3],
}

impl ElementKind {
    /// The point of a face with nodes at `points` that stands at a quadrature point.
    pub fn at(self, points: &[[f64; 3]], (place, weight): QuadraturePoint) -> FacePoint {
        let shapes = self.shape_functions(place);
        let mut position = [0.0; 3];
        let mut tangents = [[0.0; 3]; 2];
        for ((value, slopes), point) in shapes.iter().zip(points) {
            for axis in 0..3 {
                position[axis] += value * point[axis];
                tangents[0][axis] += slopes[0] * point[axis];
                tangents[1][axis] += slopes[1] * point[axis];
            }
        }
        // The second tangent of a line points along z: its normal is a quarter turn behind its direction.
        if self.dimension() == 1 {
            tangents[1] = [0.0, 0.0, 1.0];
        }
        let [a, b] = tangents;
        FacePoint {
            values: shapes.into_iter().map(|shape| shape.0).collect(),
            position,
            area: [
                weight * (a[1] * b[2] - a[2] * b[1]),
                weight * (a[2] * b[0] - a[0] * b[2]),
                weight * (a[0] * b[1] - a[1] * b[0]),
            ],
        }
    }
}
