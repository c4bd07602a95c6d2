//! Table of element kinds: a new kind is a variant, a row, and its numbers in [`super::formats`].

use super::face::FaceKind;
use super::formats::{self, Formats};
use super::rule::{self, GAUSS, QuadraturePoint};
use super::shapes::{self, Shape};
use std::sync::LazyLock;

/// Declares the kinds, each with its row of the table.
macro_rules! kinds {
    ($(#[$meta:meta])* $name:ident { $($(#[$own:meta])* $kind:ident => $row:ident,)+ }) => {
        $(#[$meta])*
        pub enum $name {
            $($(#[$own])* $kind,)+
        }

        impl $name {
            /// Every kind there is.
            pub const ALL: [Self; [$(stringify!($kind)),+].len()] = [$(Self::$kind),+];

            #[inline]
            pub(super) fn row(self) -> &'static Row {
                match self {
                    $(Self::$kind => &$row,)+
                }
            }
        }
    };
}

kinds! {
    /// Kind of an element.
    ///
    /// Nodes are the corners, then, for quadratic kinds, one mid-side node for each edge in the order of [`Self::edges`]. Corners
    /// of plane elements run counter-clockwise; those of solid elements are numbered as in VTK.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
    ElementKind {
        /// Three-node linear triangle, `0 <= xi, eta` and `xi + eta <= 1`.
        Tri3 => TRI3,
        /// Six-node quadratic triangle.
        Tri6 => TRI6,
        /// Four-node bilinear quadrilateral, `-1 <= xi, eta <= 1`.
        Quad4 => QUAD4,
        /// Eight-node serendipity quadrilateral.
        Quad8 => QUAD8,
        /// Four-node linear tetrahedron, `0 <= xi, eta, zeta` and `xi + eta + zeta <= 1`.
        Tet4 => TET4,
        /// Ten-node quadratic tetrahedron.
        Tet10 => TET10,
        /// Eight-node trilinear brick, `-1 <= xi, eta, zeta <= 1`; its stiffness has incompatible modes.
        Hex8 => HEX8,
        /// Twenty-node serendipity brick.
        Hex20 => HEX20,
        /// The same with 2 x 2 x 2 Gauss points for stiffness and mass: softer in bending on coarse meshes.
        Hex20R => HEX20R,
        /// Six-node linear wedge: a triangle in `(xi, eta)` times `-1 <= zeta <= 1`.
        Wedge6 => WEDGE6,
        /// Fifteen-node serendipity wedge.
        Wedge15 => WEDGE15,
        /// Five-node linear pyramid on the square `-1 <= xi, eta <= 1`, its apex at `zeta = 1`.
        Pyramid5 => PYRAMID5,
        /// Thirteen-node quadratic pyramid.
        Pyramid13 => PYRAMID13,
    }
}

/// One row of the table of kinds.
pub(super) struct Row {
    pub dimension: usize,
    /// Parent coordinates of the corners.
    pub corners: &'static [[f64; 3]],
    pub is_quadratic: bool,
    /// Corners at the ends of each edge; mid-side nodes follow the corners in this order.
    pub edges: &'static [[usize; 2]],
    /// Corners of the faces, the normal pointing outwards by the right-hand rule; edges in the plane. In the order in
    /// which Abaqus numbers them, `S1` first.
    pub faces: &'static [&'static [usize]],
    pub shapes: fn([f64; 3]) -> Vec<Shape>,
    pub quadrature: fn() -> Vec<QuadraturePoint>,
    /// Rule of the stiffness where it is not that of the mass.
    pub stiffness_quadrature: Option<fn() -> Vec<QuadraturePoint>>,
    pub superconvergent: fn() -> Vec<[f64; 3]>,
    pub name: &'static str,
    /// Its numbers, names and orders in the formats of mesh files.
    pub formats: &'static Formats,
}

/// A face and its nodes.
type Face = (FaceKind, &'static [usize]);

/// Faces of every kind of [`ElementKind::ALL`].
pub(super) static FACES: LazyLock<Vec<Vec<Face>>> =
    LazyLock::new(|| ElementKind::ALL.iter().map(|kind| kind.row().faces()).collect());

impl Row {
    /// Its faces: corners, then the mid-side nodes of the edges between them.
    fn faces(&self) -> Vec<Face> {
        let middle = |ends: [usize; 2]| {
            let edge = self.edges.iter().position(|edge| ends.iter().all(|end| edge.contains(end)));
            self.corners.len() + edge.expect("the side of a face is an edge")
        };
        let face = |corners: &&[usize]| {
            let kind = FaceKind::of(corners.len(), self.is_quadratic);
            let next = corners.iter().cycle().skip(1);
            let sides = corners.iter().zip(next).map(|(&start, &end)| middle([start, end]));
            let middles = sides.take(kind.node_count() - corners.len());
            let nodes: Vec<usize> = corners.iter().copied().chain(middles).collect();
            (kind, &*nodes.leak())
        };
        self.faces.iter().map(face).collect()
    }
}

const THIRD: f64 = 1.0 / 3.0;

const SQUARE_EDGES: [[usize; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];
const TETRAHEDRON_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
#[rustfmt::skip]
const BRICK_EDGES: [[usize; 2]; 12] = [
    [0, 1], [1, 2], [2, 3], [3, 0],
    [4, 5], [5, 6], [6, 7], [7, 4],
    [0, 4], [1, 5], [2, 6], [3, 7],
];
const WEDGE_EDGES: [[usize; 2]; 9] =
    [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];

const PYRAMID_EDGES: [[usize; 2]; 8] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];

const TRI3: Row = Row {
    formats: &formats::TRI3,
    dimension: 2,
    corners: &shapes::TRIANGLE,
    is_quadratic: false,
    edges: &shapes::TRIANGLE_EDGES,
    faces: &[&[0, 1], &[1, 2], &[2, 0]],
    shapes: |[xi, eta, _]| shapes::triangle(xi, eta).to_vec(),
    quadrature: rule::triangle_three,
    stiffness_quadrature: None,
    superconvergent: || vec![[THIRD, THIRD, 0.0]],
    name: "tri3",
};
const TRI6: Row = Row {
    formats: &formats::TRI6,
    is_quadratic: true,
    shapes: |[xi, eta, _]| {
        shapes::quadratic_simplex(&shapes::triangle(xi, eta), &shapes::TRIANGLE_EDGES)
    },
    quadrature: rule::triangle_six,
    superconvergent: || vec![[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]],
    name: "tri6",
    ..TRI3
};
const QUAD4: Row = Row {
    formats: &formats::QUAD4,
    dimension: 2,
    corners: &shapes::SQUARE,
    is_quadratic: false,
    edges: &SQUARE_EDGES,
    faces: &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
    shapes: |[xi, eta, _]| shapes::bilinear(xi, eta),
    quadrature: || rule::square(&rule::TWO),
    stiffness_quadrature: None,
    superconvergent: || vec![[0.0; 3]],
    name: "quad4",
};
const QUAD8: Row = Row {
    formats: &formats::QUAD8,
    is_quadratic: true,
    shapes: |[xi, eta, _]| shapes::serendipity(xi, eta),
    quadrature: || rule::square(&rule::THREE),
    superconvergent: || {
        vec![[-GAUSS, -GAUSS, 0.0], [GAUSS, -GAUSS, 0.0], [GAUSS, GAUSS, 0.0], [-GAUSS, GAUSS, 0.0]]
    },
    name: "quad8",
    ..QUAD4
};
const TET4: Row = Row {
    formats: &formats::TET4,
    dimension: 3,
    corners: &shapes::TETRAHEDRON,
    is_quadratic: false,
    edges: &TETRAHEDRON_EDGES,
    faces: &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]],
    shapes: |at| shapes::tetrahedron(at).to_vec(),
    quadrature: rule::tetrahedron_four,
    stiffness_quadrature: Some(rule::tetrahedron_one),
    superconvergent: || vec![[0.25; 3]],
    name: "tet4",
};
const TET10: Row = Row {
    formats: &formats::TET10,
    is_quadratic: true,
    shapes: |at| shapes::quadratic_simplex(&shapes::tetrahedron(at), &TETRAHEDRON_EDGES),
    quadrature: rule::tetrahedron_fourteen,
    stiffness_quadrature: Some(rule::tetrahedron_four),
    superconvergent: || rule::places(rule::tetrahedron_four()),
    name: "tet10",
    ..TET4
};
const HEX8: Row = Row {
    formats: &formats::HEX8,
    dimension: 3,
    corners: &shapes::BRICK,
    is_quadratic: false,
    edges: &BRICK_EDGES,
    faces: &[
        &[0, 3, 2, 1],
        &[4, 5, 6, 7],
        &[0, 1, 5, 4],
        &[1, 2, 6, 5],
        &[2, 3, 7, 6],
        &[3, 0, 4, 7],
    ],
    shapes: |at| shapes::brick(false, at),
    quadrature: || rule::cube(&rule::TWO),
    stiffness_quadrature: None,
    superconvergent: || vec![[0.0; 3]],
    name: "hex8",
};
const HEX20: Row = Row {
    formats: &formats::HEX20,
    is_quadratic: true,
    shapes: |at| shapes::brick(true, at),
    quadrature: || rule::cube(&rule::THREE),
    superconvergent: || rule::places(rule::cube(&rule::TWO)),
    name: "hex20",
    ..HEX8
};
const HEX20R: Row = Row {
    formats: &formats::HEX20R,
    quadrature: || rule::cube(&rule::TWO),
    name: "hex20r",
    ..HEX20
};
const WEDGE6: Row = Row {
    formats: &formats::WEDGE6,
    dimension: 3,
    corners: &shapes::WEDGE,
    is_quadratic: false,
    edges: &WEDGE_EDGES,
    faces: &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
    shapes: shapes::wedge,
    quadrature: || rule::wedge(&rule::triangle_three(), &rule::TWO),
    stiffness_quadrature: None,
    superconvergent: || vec![[THIRD, THIRD, 0.0]],
    name: "wedge6",
};
const WEDGE15: Row = Row {
    formats: &formats::WEDGE15,
    is_quadratic: true,
    shapes: shapes::quadratic_wedge,
    quadrature: || rule::wedge(&rule::triangle_six(), &rule::THREE),
    superconvergent: || {
        let triangle = rule::triangle_three().into_iter();
        triangle.flat_map(|([xi, eta, _], _)| [-GAUSS, GAUSS].map(|zeta| [xi, eta, zeta])).collect()
    },
    name: "wedge15",
    ..WEDGE6
};
const PYRAMID5: Row = Row {
    formats: &formats::PYRAMID5,
    dimension: 3,
    corners: &shapes::PYRAMID,
    is_quadratic: false,
    edges: &PYRAMID_EDGES,
    faces: &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]],
    shapes: shapes::pyramid,
    quadrature: || rule::pyramid(&rule::TWO, &rule::TWO_TO_APEX),
    stiffness_quadrature: None,
    superconvergent: || vec![[0.0, 0.0, 0.25]],
    name: "pyramid5",
};
const PYRAMID13: Row = Row {
    formats: &formats::PYRAMID13,
    is_quadratic: true,
    shapes: shapes::quadratic_pyramid,
    quadrature: || rule::pyramid(&rule::THREE, &rule::THREE_TO_APEX),
    superconvergent: || rule::places(rule::pyramid(&rule::TWO, &rule::TWO_TO_APEX)),
    name: "pyramid13",
    ..PYRAMID5
};

impl ElementKind {
    /// Its numbers, names and orders in the formats of mesh files.
    pub(crate) fn formats(self) -> &'static Formats {
        self.row().formats
    }

    /// Element type of Gmsh's MSH format.
    pub fn gmsh_type(self) -> u32 {
        self.formats().gmsh.names[0]
    }

    /// Cell type of VTK, which numbers its nodes as here.
    pub fn vtk_type(self) -> u8 {
        self.formats().vtk
    }

    /// The first kind that satisfies a condition on its formats.
    pub(crate) fn listed(condition: impl Fn(&Formats) -> bool) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| condition(kind.formats()))
    }
}
