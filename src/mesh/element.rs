//! Element kinds: nodes, edges, faces, shape functions, quadrature, and their numbers in file formats.
//!
//! One table for plane and solid elements: whatever depends on the kind of an element is said here.

mod face;
mod rule;
mod shapes;

pub use face::{FaceKind, FacePoint};
pub use rule::QuadraturePoint;
pub use shapes::Shape;

use rule::GAUSS;

/// Kind of an element.
///
/// Nodes are the corners, then, for quadratic kinds, one mid-side node for each edge in the order of [`Self::edges`]. Corners
/// of plane elements run counter-clockwise; those of solid elements are numbered as in VTK.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ElementKind {
    /// Three-node linear triangle, `0 <= xi, eta` and `xi + eta <= 1`.
    Tri3,
    /// Six-node quadratic triangle.
    Tri6,
    /// Four-node bilinear quadrilateral, `-1 <= xi, eta <= 1`.
    Quad4,
    /// Eight-node serendipity quadrilateral.
    Quad8,
    /// Four-node linear tetrahedron, `0 <= xi, eta, zeta` and `xi + eta + zeta <= 1`.
    Tet4,
    /// Ten-node quadratic tetrahedron.
    Tet10,
    /// Eight-node trilinear brick, `-1 <= xi, eta, zeta <= 1`; its stiffness has incompatible modes.
    Hex8,
    /// Twenty-node serendipity brick.
    Hex20,
    /// The same with 2 x 2 x 2 Gauss points for stiffness and mass: softer in bending on coarse meshes.
    Hex20R,
    /// Six-node linear wedge: a triangle in `(xi, eta)` times `-1 <= zeta <= 1`.
    Wedge6,
    /// Fifteen-node serendipity wedge.
    Wedge15,
}

/// One row of the table of kinds.
struct Row {
    dimension: usize,
    corners: usize,
    is_quadratic: bool,
    /// Corners at the ends of each edge; mid-side nodes follow the corners in this order.
    edges: &'static [[usize; 2]],
    /// Faces of the element with their nodes, the normal pointing outwards by the right-hand rule; edges in the plane.
    faces: &'static [(FaceKind, &'static [usize])],
    gmsh: u32,
    vtk: u8,
    name: &'static str,
}

const TRIANGLE_EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];
const SQUARE_EDGES: [[usize; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];
const TETRAHEDRON_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
const BRICK_EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
const WEDGE_EDGES: [[usize; 2]; 9] = [
    [0, 1],
    [1, 2],
    [2, 0],
    [3, 4],
    [4, 5],
    [5, 3],
    [0, 3],
    [1, 4],
    [2, 5],
];

const TRI3: Row = Row {
    dimension: 2,
    corners: 3,
    is_quadratic: false,
    edges: &TRIANGLE_EDGES,
    faces: &[
        (FaceKind::Line2, &[0, 1]),
        (FaceKind::Line2, &[1, 2]),
        (FaceKind::Line2, &[2, 0]),
    ],
    gmsh: 2,
    vtk: 5,
    name: "tri3",
};
const TRI6: Row = Row {
    is_quadratic: true,
    faces: &[
        (FaceKind::Line3, &[0, 1, 3]),
        (FaceKind::Line3, &[1, 2, 4]),
        (FaceKind::Line3, &[2, 0, 5]),
    ],
    gmsh: 9,
    vtk: 22,
    name: "tri6",
    ..TRI3
};
const QUAD4: Row = Row {
    dimension: 2,
    corners: 4,
    is_quadratic: false,
    edges: &SQUARE_EDGES,
    faces: &[
        (FaceKind::Line2, &[0, 1]),
        (FaceKind::Line2, &[1, 2]),
        (FaceKind::Line2, &[2, 3]),
        (FaceKind::Line2, &[3, 0]),
    ],
    gmsh: 3,
    vtk: 9,
    name: "quad4",
};
const QUAD8: Row = Row {
    is_quadratic: true,
    faces: &[
        (FaceKind::Line3, &[0, 1, 4]),
        (FaceKind::Line3, &[1, 2, 5]),
        (FaceKind::Line3, &[2, 3, 6]),
        (FaceKind::Line3, &[3, 0, 7]),
    ],
    gmsh: 16,
    vtk: 23,
    name: "quad8",
    ..QUAD4
};
const TET4: Row = Row {
    dimension: 3,
    corners: 4,
    is_quadratic: false,
    edges: &TETRAHEDRON_EDGES,
    faces: &[
        (FaceKind::Tri3, &[0, 2, 1]),
        (FaceKind::Tri3, &[0, 1, 3]),
        (FaceKind::Tri3, &[1, 2, 3]),
        (FaceKind::Tri3, &[0, 3, 2]),
    ],
    gmsh: 4,
    vtk: 10,
    name: "tet4",
};
const TET10: Row = Row {
    is_quadratic: true,
    faces: &[
        (FaceKind::Tri6, &[0, 2, 1, 6, 5, 4]),
        (FaceKind::Tri6, &[0, 1, 3, 4, 8, 7]),
        (FaceKind::Tri6, &[1, 2, 3, 5, 9, 8]),
        (FaceKind::Tri6, &[0, 3, 2, 7, 9, 6]),
    ],
    gmsh: 11,
    vtk: 24,
    name: "tet10",
    ..TET4
};
const HEX8: Row = Row {
    dimension: 3,
    corners: 8,
    is_quadratic: false,
    edges: &BRICK_EDGES,
    faces: &[
        (FaceKind::Quad4, &[0, 3, 2, 1]),
        (FaceKind::Quad4, &[4, 5, 6, 7]),
        (FaceKind::Quad4, &[0, 1, 5, 4]),
        (FaceKind::Quad4, &[1, 2, 6, 5]),
        (FaceKind::Quad4, &[2, 3, 7, 6]),
        (FaceKind::Quad4, &[3, 0, 4, 7]),
    ],
    gmsh: 5,
    vtk: 12,
    name: "hex8",
};
const HEX20: Row = Row {
    is_quadratic: true,
    faces: &[
        (FaceKind::Quad8, &[0, 3, 2, 1, 11, 10, 9, 8]),
        (FaceKind::Quad8, &[4, 5, 6, 7, 12, 13, 14, 15]),
        (FaceKind::Quad8, &[0, 1, 5, 4, 8, 17, 12, 16]),
        (FaceKind::Quad8, &[1, 2, 6, 5, 9, 18, 13, 17]),
        (FaceKind::Quad8, &[2, 3, 7, 6, 10, 19, 14, 18]),
        (FaceKind::Quad8, &[3, 0, 4, 7, 11, 16, 15, 19]),
    ],
    gmsh: 17,
    vtk: 25,
    name: "hex20",
    ..HEX8
};
const HEX20R: Row = Row {
    name: "hex20r",
    ..HEX20
};
const WEDGE6: Row = Row {
    dimension: 3,
    corners: 6,
    is_quadratic: false,
    edges: &WEDGE_EDGES,
    faces: &[
        (FaceKind::Tri3, &[0, 2, 1]),
        (FaceKind::Tri3, &[3, 4, 5]),
        (FaceKind::Quad4, &[0, 1, 4, 3]),
        (FaceKind::Quad4, &[1, 2, 5, 4]),
        (FaceKind::Quad4, &[2, 0, 3, 5]),
    ],
    gmsh: 6,
    vtk: 13,
    name: "wedge6",
};
const WEDGE15: Row = Row {
    is_quadratic: true,
    faces: &[
        (FaceKind::Tri6, &[0, 2, 1, 8, 7, 6]),
        (FaceKind::Tri6, &[3, 4, 5, 9, 10, 11]),
        (FaceKind::Quad8, &[0, 1, 4, 3, 6, 13, 9, 12]),
        (FaceKind::Quad8, &[1, 2, 5, 4, 7, 14, 10, 13]),
        (FaceKind::Quad8, &[2, 0, 3, 5, 8, 12, 11, 14]),
    ],
    gmsh: 18,
    vtk: 26,
    name: "wedge15",
    ..WEDGE6
};

impl ElementKind {
    /// Every kind there is.
    pub const ALL: [Self; 11] = [
        Self::Tri3,
        Self::Tri6,
        Self::Quad4,
        Self::Quad8,
        Self::Tet4,
        Self::Tet10,
        Self::Hex8,
        Self::Hex20,
        Self::Hex20R,
        Self::Wedge6,
        Self::Wedge15,
    ];

    fn row(self) -> &'static Row {
        match self {
            Self::Tri3 => &TRI3,
            Self::Tri6 => &TRI6,
            Self::Quad4 => &QUAD4,
            Self::Quad8 => &QUAD8,
            Self::Tet4 => &TET4,
            Self::Tet10 => &TET10,
            Self::Hex8 => &HEX8,
            Self::Hex20 => &HEX20,
            Self::Hex20R => &HEX20R,
            Self::Wedge6 => &WEDGE6,
            Self::Wedge15 => &WEDGE15,
        }
    }

    /// 2 for plane elements, 3 for solid ones.
    pub fn dimension(self) -> usize {
        self.row().dimension
    }

    /// Its name in messages and tables, such as `tet10`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Corners of one element.
    pub fn corner_count(self) -> usize {
        self.row().corners
    }

    /// Whether edges are parabolas with a node at their middle.
    pub fn is_quadratic(self) -> bool {
        self.row().is_quadratic
    }

    /// Nodes of one element.
    pub fn node_count(self) -> usize {
        let row = self.row();
        row.corners + if row.is_quadratic { row.edges.len() } else { 0 }
    }

    /// Corners at the ends of each edge.
    pub fn edges(self) -> &'static [[usize; 2]] {
        self.row().edges
    }

    /// Local nodes of edge `edge`: its ends, counter-clockwise in the plane, then its middle where it has one.
    pub fn edge(self, edge: usize) -> (usize, usize, Option<usize>) {
        let row = self.row();
        let [start, end] = row.edges[edge];
        (start, end, row.is_quadratic.then_some(row.corners + edge))
    }

    /// Faces of a solid element, edges of a plane one, with their local nodes in the order of [`FaceKind`]; the outward normal
    /// follows from it by the right-hand rule, in the plane a quarter turn behind the direction of the edge.
    pub fn faces(self) -> &'static [(FaceKind, &'static [usize])] {
        self.row().faces
    }

    /// The face of a solid element that has the shape of this plane element; none for a solid element.
    pub fn as_face(self) -> Option<FaceKind> {
        match self {
            Self::Tri3 => Some(FaceKind::Tri3),
            Self::Tri6 => Some(FaceKind::Tri6),
            Self::Quad4 => Some(FaceKind::Quad4),
            Self::Quad8 => Some(FaceKind::Quad8),
            _ => None,
        }
    }

    /// Element type of Gmsh's MSH format.
    pub fn gmsh_type(self) -> u32 {
        self.row().gmsh
    }

    /// For each node of the kind its place among the nodes of an element in a Gmsh file.
    pub fn gmsh_order(self) -> Vec<usize> {
        match self {
            Self::Tet10 => vec![0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
            Self::Hex20 | Self::Hex20R => vec![
                0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15,
            ],
            Self::Wedge15 => vec![0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
            _ => (0..self.node_count()).collect(),
        }
    }

    /// Cell type of VTK, which numbers its nodes as here.
    pub fn vtk_type(self) -> u8 {
        self.row().vtk
    }

    /// Shape functions at a point of the parent element, in the order of the nodes; coordinates and slopes that the kind does
    /// not have are zero.
    ///
    /// Quad4: `N_I = (1 + xi_I xi)(1 + eta_I eta) / 4`. Quad8: the serendipity functions. Tri3, Tet4: the area or volume
    /// coordinates `L`. Tri6, Tet10: `L (2 L - 1)` at corners, `4 L_I L_J` at the middle of an edge. Hex8, Hex20, Wedge6,
    /// Wedge15: trilinear and serendipity functions.
    pub fn shape_functions(self, at: [f64; 3]) -> Vec<Shape> {
        let [xi, eta, _] = at;
        match self {
            Self::Tri3 => shapes::triangle(xi, eta).to_vec(),
            Self::Tri6 => shapes::quadratic_simplex(&shapes::triangle(xi, eta), self.edges()),
            Self::Quad4 => shapes::bilinear(xi, eta),
            Self::Quad8 => shapes::serendipity(xi, eta),
            Self::Tet4 => shapes::tetrahedron(at).to_vec(),
            Self::Tet10 => shapes::quadratic_simplex(&shapes::tetrahedron(at), self.edges()),
            Self::Hex8 => shapes::brick(false, at),
            Self::Hex20 | Self::Hex20R => shapes::brick(true, at),
            Self::Wedge6 => shapes::wedge(at),
            Self::Wedge15 => shapes::quadratic_wedge(at),
        }
    }

    /// Quadrature of the mass: full, exact for the mass of an undistorted element: 3 points for Tri3, 6 (degree 4, Dunavant 1985) for Tri6,
    /// 2 x 2 Gauss points for Quad4, 3 x 3 for Quad8; 4 for Tet4, 14 (degree 5, Walkington 2000) for Tet10; Gauss points on
    /// bricks, reduced ones for Hex20R, triangle times line on wedges.
    pub fn quadrature(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Tri3 => rule::triangle_three(),
            Self::Tri6 => rule::triangle_six(),
            Self::Quad4 => rule::square(&rule::TWO),
            Self::Quad8 => rule::square(&rule::THREE),
            Self::Tet4 => rule::tetrahedron_four(),
            Self::Tet10 => rule::tetrahedron_fourteen(),
            Self::Hex8 | Self::Hex20R => rule::cube(&rule::TWO),
            Self::Hex20 => rule::cube(&rule::THREE),
            Self::Wedge6 => rule::wedge(&rule::triangle_three(), &rule::TWO),
            Self::Wedge15 => rule::wedge(&rule::triangle_six(), &rule::THREE),
        }
    }

    /// Quadrature of the stiffness: that of [`Self::quadrature`], but 1 point for Tet4 and 4 for Tet10, which are exact on
    /// straight edges.
    pub fn stiffness_quadrature(self) -> Vec<QuadraturePoint> {
        match self {
            Self::Tet4 => rule::tetrahedron_one(),
            Self::Tet10 => rule::tetrahedron_four(),
            _ => self.quadrature(),
        }
    }

    /// Points at which the stress of a displacement element is most accurate (Zienkiewicz and Zhu 1992).
    pub fn superconvergent_points(self) -> Vec<[f64; 3]> {
        const THIRD: f64 = 1.0 / 3.0;
        let line = [-GAUSS, GAUSS];
        match self {
            Self::Tri3 => vec![[THIRD, THIRD, 0.0]],
            Self::Tri6 => vec![[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]],
            Self::Quad4 | Self::Hex8 => vec![[0.0; 3]],
            Self::Quad8 => vec![
                [-GAUSS, -GAUSS, 0.0],
                [GAUSS, -GAUSS, 0.0],
                [GAUSS, GAUSS, 0.0],
                [-GAUSS, GAUSS, 0.0],
            ],
            Self::Tet4 => vec![[0.25; 3]],
            Self::Wedge6 => vec![[THIRD, THIRD, 0.0]],
            Self::Tet10 => self
                .stiffness_quadrature()
                .into_iter()
                .map(|p| p.0)
                .collect(),
            Self::Hex20 | Self::Hex20R => rule::cube(&rule::TWO).into_iter().map(|p| p.0).collect(),
            Self::Wedge15 => {
                let triangle = rule::triangle_three().into_iter();
                triangle
                    .flat_map(|([xi, eta, _], _)| line.map(|zeta| [xi, eta, zeta]))
                    .collect()
            }
        }
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
        let corners = match self {
            Self::Tri3 | Self::Tri6 => shapes::TETRAHEDRON[..3].to_vec(),
            Self::Quad4 | Self::Quad8 => shapes::SQUARE.map(|(a, b)| [a, b, 0.0]).to_vec(),
            Self::Tet4 | Self::Tet10 => shapes::TETRAHEDRON.to_vec(),
            Self::Hex8 | Self::Hex20 | Self::Hex20R => shapes::brick_places(false),
            Self::Wedge6 | Self::Wedge15 => shapes::WEDGE.to_vec(),
        };
        let middle = |&[start, end]: &[usize; 2]| {
            let (p, q) = (corners[start], corners[end]);
            std::array::from_fn(|axis| 0.5 * (p[axis] + q[axis]))
        };
        let middles = self.edges().iter().filter(|_| self.is_quadratic());
        corners.iter().copied().chain(middles.map(middle)).collect()
    }
}

#[cfg(test)]
mod tests;
