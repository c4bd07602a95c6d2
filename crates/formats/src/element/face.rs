//! Faces of elements: lines in the plane, triangles and quadrilaterals of solids.

use super::ElementKind;
use super::rule::{self, QuadraturePoint};
use super::shapes::{self, Shape};

/// Kind of a face: an edge of a plane element or a face of a solid one.
///
/// Nodes are the corners, then the mid-side node after each corner; a line has its ends, then its middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FaceKind {
    /// Straight line, `-1 <= xi <= 1`.
    Line2,
    /// Parabola.
    Line3,
    /// Linear triangle.
    Tri3,
    /// Quadratic triangle.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Serendipity quadrilateral.
    Quad8,
}

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

impl FaceKind {
    /// The face with so many corners, 2 to 4.
    pub(super) fn of(corners: usize, is_quadratic: bool) -> Self {
        match (corners, is_quadratic) {
            (2, false) => Self::Line2,
            (2, true) => Self::Line3,
            (3, false) => Self::Tri3,
            (3, true) => Self::Tri6,
            (_, false) => Self::Quad4,
            (_, true) => Self::Quad8,
        }
    }

    /// Corners of one face, ends of a line.
    #[inline]
    pub fn corner_count(self) -> usize {
        match self {
            Self::Line2 | Self::Line3 => 2,
            Self::Tri3 | Self::Tri6 => 3,
            Self::Quad4 | Self::Quad8 => 4,
        }
    }

    /// Whether edges have a node at their middle.
    #[inline]
    pub fn is_quadratic(self) -> bool {
        matches!(self, Self::Line3 | Self::Tri6 | Self::Quad8)
    }

    /// Nodes of one face.
    #[inline]
    pub fn node_count(self) -> usize {
        let corners = self.corner_count();
        let sides = if corners == 2 { 1 } else { corners };
        corners + if self.is_quadratic() { sides } else { 0 }
    }

    /// The plane element of its shape; a line has none.
    fn plane(self) -> Option<ElementKind> {
        match self {
            Self::Line2 | Self::Line3 => None,
            Self::Tri3 => Some(ElementKind::Tri3),
            Self::Tri6 => Some(ElementKind::Tri6),
            Self::Quad4 => Some(ElementKind::Quad4),
            Self::Quad8 => Some(ElementKind::Quad8),
        }
    }

    /// Shape functions at a point of the face, in the order of its nodes.
    #[inline]
    pub fn shape_functions(self, [xi, eta]: [f64; 2]) -> Vec<Shape> {
        let edges: &[[usize; 2]] = if self.is_quadratic() { &[[0, 1]] } else { &[] };
        match self.plane() {
            Some(kind) => kind.shape_functions([xi, eta, 0.0]),
            None => shapes::tensor(1, &shapes::LINE, edges, [xi, 0.0, 0.0]),
        }
    }

    /// Quadrature that is exact for products of two shape functions on a flat, undistorted face.
    #[inline]
    pub fn quadrature(self) -> Vec<QuadraturePoint> {
        match self.plane() {
            Some(kind) => kind.quadrature(),
            None if self.is_quadratic() => rule::line(&rule::THREE),
            None => rule::line(&rule::TWO),
        }
    }

    /// The point of a face with nodes at `points` that stands at a quadrature point.
    pub fn at(self, points: &[[f64; 3]], (place, weight): QuadraturePoint) -> FacePoint {
        let shapes = self.shape_functions([place[0], place[1]]);
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
        if self.corner_count() == 2 {
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
