//! Element kinds: nodes, edges, faces, shape functions, quadrature, and their numbers in file formats.
//!
//! Whatever depends on the kind of an element is said in the [`table`], for plane and solid elements alike.

mod rule;
mod shapes;
mod table;

use nalgebra::{Matrix3, Vector3};

pub use rule::QuadraturePoint;
pub use shapes::Shape;
pub use table::ElementKind;
use table::{FACES, Row};

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
    /// Shapes of the solid kinds, as messages name them.
    pub const SOLID_SHAPES: &str = "tetrahedra, bricks, wedges and pyramids";

    /// Descriptor of dataset 2412 of universal files, plane elements in plane strain, and the nodes of an element in the order
    /// there; none for a kind that these files do not have.
    pub fn universal(self, nodes: &[u32]) -> Option<(usize, Vec<u32>)> {
        let listing = &self.row().universal;
        let in_plane = usize::from(self.dimension() == 2);
        let mut listed = nodes.to_vec();
        for (node, &place) in nodes.iter().zip(listing.order) {
            listed[place] = *node;
        }
        Some((*listing.names.get(in_plane)?, listed))
    }

    /// 1 for lines, 2 for plane elements, 3 for solid ones.
    #[inline]
    pub fn dimension(self) -> usize {
        self.row().dimension
    }

    /// Its name in messages and tables, such as `tet10`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Corners of one element.
    #[inline]
    pub fn corner_count(self) -> usize {
        self.row().corners.len()
    }

    /// Whether edges are parabolas with a node at their middle.
    #[inline]
    pub fn is_quadratic(self) -> bool {
        self.row().is_quadratic
    }

    /// The kind of the same dimension with so many corners; where it has mid-side nodes or not as asked.
    pub fn with_corners(self, corners: usize, is_quadratic: bool) -> Self {
        let is_asked =
            |row: &Row| row.dimension == self.dimension() && row.has(corners, is_quadratic);
        match is_asked(self.row()) {
            true => self,
            false => Self::listed(is_asked).expect("every shape has a linear and a quadratic kind"),
        }
    }

    /// Nodes of one element.
    #[inline]
    pub fn node_count(self) -> usize {
        self.corner_count() + if self.is_quadratic() { self.edges().len() } else { 0 }
    }

    /// Corners at the ends of each edge.
    #[inline]
    pub fn edges(self) -> &'static [[usize; 2]] {
        self.row().edges
    }

    /// Local nodes of edge `edge`: its ends, counter-clockwise in the plane, then its middle where it has one.
    pub fn edge(self, edge: usize) -> (usize, usize, Option<usize>) {
        let row = self.row();
        let [start, end] = row.edges[edge];
        (start, end, row.is_quadratic.then_some(row.corners.len() + edge))
    }

    /// Faces of a solid element, edges of a plane one, with their local nodes in the order of their kind; the outward normal
    /// follows from it by the right-hand rule, in the plane a quarter turn behind the direction of the edge.
    #[inline]
    pub fn faces(self) -> &'static [(Self, &'static [usize])] {
        &FACES[self as usize]
    }

    /// Shape functions at a point of the parent element, in the order of the nodes; coordinates and slopes that the kind does
    /// not have are zero.
    ///
    /// Lines: those of the ends, and the bubble between. Quad4: `N_I = (1 + xi_I xi)(1 + eta_I eta) / 4`. Quad8: the serendipity functions. Tri3, Tet4: the area or volume
    /// coordinates `L`. Tri6, Tet10: `L (2 L - 1)` at corners, `4 L_I L_J` at the middle of an edge. Hex8, Hex20, Wedge6,
    /// Wedge15: trilinear and serendipity functions. Pyramid5, Pyramid13: rational ones.
    pub fn shape_functions(self, at: [f64; 3]) -> Vec<Shape> {
        (self.row().shapes)(at)
    }

    /// `dx_j / dxi_i` at a point of the parent element, row `i`, of an element with nodes at `points`; in the plane the third parent
    /// axis is z.
    pub fn jacobian(
        self,
        at: [f64; 3],
        points: impl IntoIterator<Item = [f64; 3]>,
    ) -> Matrix3<f64> {
        let mut jacobian = Matrix3::zeros();
        if self.dimension() == 2 {
            jacobian[(2, 2)] = 1.0;
        }
        for ((_, slopes), point) in self.shape_functions(at).iter().zip(points) {
            jacobian += Vector3::from(*slopes) * Vector3::from(point).transpose();
        }
        jacobian
    }

    /// The point of a face with nodes at `points` that stands at a quadrature point: of a line in the plane, of a triangle or a
    /// quadrilateral of a solid.
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
        let [a, b] = tangents.map(Vector3::from);
        let values = shapes.into_iter().map(|shape| shape.0).collect();
        FacePoint { values, position, area: (a.cross(&b) * weight).into() }
    }

    /// Quadrature of the mass: full, exact for the mass of an undistorted element: 3 points for Tri3, 6 (degree 4, Dunavant 1985) for Tri6,
    /// 2 x 2 Gauss points for Quad4, 3 x 3 for Quad8; 4 for Tet4, 14 (degree 5, Walkington 2000) for Tet10; Gauss points on
    /// bricks, reduced ones for Hex20R, triangle times line on wedges, square times line to the apex on pyramids.
    pub fn quadrature(self) -> Vec<QuadraturePoint> {
        (self.row().quadrature)()
    }

    /// Quadrature of the stiffness: that of [`Self::quadrature`], but 1 point for Tet4 and 4 for Tet10, which are exact on
    /// straight edges.
    pub fn stiffness_quadrature(self) -> Vec<QuadraturePoint> {
        let row = self.row();
        row.stiffness_quadrature.unwrap_or(row.quadrature)()
    }

    /// Points at which the stress of a displacement element is most accurate (Zienkiewicz and Zhu 1992).
    pub fn superconvergent_points(self) -> Vec<[f64; 3]> {
        (self.row().superconvergent)()
    }

    /// Local mid-side nodes, each with the corners at the ends of its edge.
    pub fn middles(self) -> impl Iterator<Item = (usize, [usize; 2])> {
        let edges = self.edges().iter().filter(move |_| self.is_quadratic());
        (self.corner_count()..).zip(edges.copied())
    }

    /// Local nodes around the outline of a plane element, mid-side nodes between their corners.
    pub fn outline(self) -> Vec<usize> {
        (0..self.edges().len())
            .flat_map(|edge| {
                let (start, _, middle) = self.edge(edge);
                std::iter::once(start).chain(middle)
            })
            .collect()
    }

    /// Parent coordinates of each node.
    pub fn node_places(self) -> Vec<[f64; 3]> {
        let row = self.row();
        shapes::with_middles(row.corners, if row.is_quadratic { row.edges } else { &[] }).collect()
    }
}

#[cfg(test)]
mod tests;
