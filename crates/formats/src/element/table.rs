//! Table of element kinds: a new kind is an entry of it.

use super::rule::{self, GAUSS, QuadraturePoint};
use super::shapes::{self, Shape, TRIANGLE_EDGES};
use std::sync::LazyLock;

/// Declares the kinds, each with its row of the table.
macro_rules! kinds {
    ($(#[$meta:meta])* $name:ident { $($(#[$own:meta])* $kind:ident = $row:ident { $($fields:tt)+ })+ }) => {
        $(#[$meta])*
        pub enum $name {
            $($(#[$own])* $kind,)+
        }

        impl $name {
            /// Every kind there is.
            pub const ALL: [Self; [$(stringify!($kind)),+].len()] = [$(Self::$kind),+];

            #[inline]
            pub(crate) fn row(self) -> &'static Row {
                match self {
                    $(Self::$kind => &$row,)+
                }
            }
        }

        $(const $row: Row = Row { $($fields)+ };)+
    };
}

// Each by its geometry, its functions and rules, and what files call it.
kinds! {
    /// Kind of an element, or of a face of one.
    ///
    /// Nodes are the corners, then, for quadratic kinds, one mid-side node for each edge in the order of [`Self::edges`]. Corners
    /// of plane elements run counter-clockwise; those of solid elements are numbered as in VTK.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
    ElementKind {
        /// Straight line, `-1 <= xi <= 1`: an edge of a plane element.
        Line2 = LINE2 {
            dimension: 1, is_quadratic: false, corners: &shapes::LINE, edges: &[[0, 1]], faces: &[],
            shapes: |at| shapes::tensor(1, &shapes::LINE, &[], [at[0], 0.0, 0.0]),
            quadrature: || rule::line(&rule::TWO), stiffness_quadrature: None, superconvergent: || vec![[0.0; 3]],
            name: "line2", vtk: 3, gmsh: listed(&[1]), universal: listed(&[]), nastran: listed(&[]), abaqus: &[],
        }
        /// Parabola.
        Line3 = LINE3 {
            is_quadratic: true, shapes: |at| shapes::tensor(1, &shapes::LINE, &[[0, 1]], [at[0], 0.0, 0.0]),
            quadrature: || rule::line(&rule::THREE), superconvergent: || rule::places(rule::line(&rule::TWO)),
            name: "line3", vtk: 21, gmsh: listed(&[8]), ..LINE2
        }
        /// Three-node linear triangle, `0 <= xi, eta` and `xi + eta <= 1`.
        Tri3 = TRI3 {
            dimension: 2, corners: &shapes::TRIANGLE, edges: &TRIANGLE_EDGES, faces: &[&[0, 1], &[1, 2], &[2, 0]],
            shapes: |at| shapes::simplex::<3>(at).to_vec(), quadrature: rule::triangle_three,
            superconvergent: || vec![[THIRD, THIRD, 0.0]],
            name: "tri3", vtk: 5, gmsh: listed(&[2]), universal: listed(&[41, 51, 91]),
            abaqus: &[(&["3", "3H"], "")], ..LINE2
        }
        /// Six-node quadratic triangle.
        Tri6 = TRI6 {
            is_quadratic: true,
            shapes: |at| shapes::quadratic_simplex(&shapes::simplex::<3>(at), &TRIANGLE_EDGES),
            quadrature: rule::triangle_six, superconvergent: || vec![[0.5, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.0]],
            name: "tri6", vtk: 22, gmsh: listed(&[9]),
            universal: ordered(&[42, 52, 92], &[0, 2, 4, 1, 3, 5]),
            abaqus: &[(&["6"], ""), (&["6M", "6H", "6MH"], DISPLACEMENTS)], ..TRI3
        }
        /// Four-node bilinear quadrilateral, `-1 <= xi, eta <= 1`.
        Quad4 = QUAD4 {
            dimension: 2, corners: &shapes::SQUARE, edges: &SQUARE_EDGES, faces: &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]],
            shapes: |at| shapes::tensor(2, &shapes::SQUARE, &[], at), quadrature: || rule::square(&rule::TWO),
            name: "quad4", vtk: 9, gmsh: listed(&[3]), universal: listed(&[44, 54, 94]),
            abaqus: &[(&["4"], ""), (&["4R", "4I", "4H", "4RH", "4IH"], FULL)], ..LINE2
        }
        /// Eight-node serendipity quadrilateral.
        Quad8 = QUAD8 {
            is_quadratic: true, shapes: |at| shapes::tensor(2, &shapes::SQUARE, &SQUARE_EDGES, at),
            quadrature: || rule::square(&rule::THREE), superconvergent: || rule::places(rule::square(&rule::TWO)),
            name: "quad8", vtk: 23, gmsh: listed(&[16]),
            universal: ordered(&[45, 55, 95], &[0, 2, 4, 6, 1, 3, 5, 7]),
            abaqus: &[(&["8"], ""), (&["8R", "8H", "8RH"], FULL)], ..QUAD4
        }
        /// Four-node linear tetrahedron, `0 <= xi, eta, zeta` and `xi + eta + zeta <= 1`.
        Tet4 = TET4 {
            dimension: 3, corners: &shapes::TETRAHEDRON, edges: &TETRAHEDRON_EDGES,
            faces: &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]],
            shapes: |at| shapes::simplex::<4>(at).to_vec(), quadrature: rule::tetrahedron_four,
            stiffness_quadrature: Some(rule::tetrahedron_one), superconvergent: || vec![[0.25; 3]],
            name: "tet4", vtk: 10, gmsh: listed(&[4]), universal: listed(&[111]), nastran: listed(&["CTETRA"]),
            abaqus: &[(&["4"], ""), (&["4H"], DISPLACEMENTS)], ..LINE2
        }
        /// Ten-node quadratic tetrahedron.
        Tet10 = TET10 {
            is_quadratic: true, shapes: |at| shapes::quadratic_simplex(&shapes::simplex::<4>(at), &TETRAHEDRON_EDGES),
            quadrature: rule::tetrahedron_fourteen, stiffness_quadrature: Some(rule::tetrahedron_four),
            superconvergent: || rule::places(rule::tetrahedron_four()),
            name: "tet10", vtk: 24, gmsh: ordered(&[11], &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
            universal: ordered(&[118], &[0, 2, 4, 9, 1, 3, 5, 6, 7, 8]),
            abaqus: &[(&["10"], ""), (&["10H", "10HS", "10M", "10MH", "10I", "10T"], DISPLACEMENTS)], ..TET4
        }
        /// Eight-node trilinear brick, `-1 <= xi, eta, zeta <= 1`; its stiffness has incompatible modes.
        Hex8 = HEX8 {
            dimension: 3, corners: &shapes::BRICK, edges: &BRICK_EDGES,
            faces: &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]],
            shapes: |at| shapes::tensor(3, &shapes::BRICK, &[], at), quadrature: || rule::cube(&rule::TWO),
            name: "hex8", vtk: 12, gmsh: listed(&[5]), universal: listed(&[115]), nastran: listed(&["CHEXA"]),
            abaqus: &[(&["8", "8R", "8H", "8RH"], BRICK), (&["8I", "8IH"], "")], ..LINE2
        }
        /// Twenty-node serendipity brick.
        Hex20 = HEX20 {
            is_quadratic: true, shapes: |at| shapes::tensor(3, &shapes::BRICK, &BRICK_EDGES, at),
            quadrature: || rule::cube(&rule::THREE), superconvergent: || rule::places(rule::cube(&rule::TWO)),
            name: "hex20", vtk: 25, abaqus: &[(&["20"], ""), (&["20H"], FULL)],
            gmsh: ordered(&[17], &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
            universal: ordered(&[116], &[0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11]),
            nastran: ordered(&["CHEXA"], &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15]),
            ..HEX8
        }
        /// The same with 2 x 2 x 2 Gauss points for stiffness and mass: softer in bending on coarse meshes.
        Hex20R = HEX20R {
            quadrature: || rule::cube(&rule::TWO),
            name: "hex20r", abaqus: &[(&["20R"], ""), (&["20RH"], DISPLACEMENTS)], ..HEX20
        }
        /// Six-node linear wedge: a triangle in `(xi, eta)` times `-1 <= zeta <= 1`.
        Wedge6 = WEDGE6 {
            dimension: 3, corners: &shapes::WEDGE, edges: &WEDGE_EDGES,
            faces: &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]],
            shapes: shapes::wedge, quadrature: || rule::prism(&rule::triangle_three(), &rule::TWO),
            superconvergent: || vec![[THIRD, THIRD, 0.0]],
            name: "wedge6", vtk: 13, gmsh: listed(&[6]), universal: listed(&[112]), nastran: listed(&["CPENTA"]),
            abaqus: &[(&["6"], ""), (&["6R", "6H"], FULL)], ..LINE2
        }
        /// Fifteen-node serendipity wedge.
        Wedge15 = WEDGE15 {
            is_quadratic: true, shapes: shapes::quadratic_wedge,
            quadrature: || rule::prism(&rule::triangle_six(), &rule::THREE),
            superconvergent: || {
                let triangle = rule::triangle_three().into_iter();
                triangle.flat_map(|([xi, eta, _], _)| [-GAUSS, GAUSS].map(|zeta| [xi, eta, zeta])).collect()
            },
            name: "wedge15", vtk: 26, abaqus: &[(&["15"], ""), (&["15H"], FULL)],
            gmsh: ordered(&[18], &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
            universal: ordered(&[113], &[0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8]),
            nastran: ordered(&["CPENTA"], &[0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11]), ..WEDGE6
        }
        /// Five-node linear pyramid on the square `-1 <= xi, eta <= 1`, its apex at `zeta = 1`.
        Pyramid5 = PYRAMID5 {
            dimension: 3, corners: &shapes::PYRAMID, edges: &PYRAMID_EDGES,
            faces: &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]],
            shapes: shapes::pyramid, quadrature: || rule::pyramid(&rule::TWO, &rule::TWO_TO_APEX),
            superconvergent: || vec![[0.0, 0.0, 0.25]],
            name: "pyramid5", vtk: 14, gmsh: listed(&[7]), nastran: listed(&["CPYRAM", "CPYRA"]),
            abaqus: &[(&["5"], ""), (&["5H"], DISPLACEMENTS)], ..LINE2
        }
        /// Thirteen-node quadratic pyramid.
        Pyramid13 = PYRAMID13 {
            is_quadratic: true, shapes: shapes::quadratic_pyramid,
            quadrature: || rule::pyramid(&rule::THREE, &rule::THREE_TO_APEX),
            superconvergent: || rule::places(rule::pyramid(&rule::TWO, &rule::TWO_TO_APEX)),
            name: "pyramid13", vtk: 27, gmsh: ordered(&[19], &[0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
            abaqus: &[(&["13"], ""), (&["13H"], DISPLACEMENTS)], ..PYRAMID5
        }
    }
}

/// One row of the table of kinds.
pub(crate) struct Row {
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
    /// Its name in messages and tables, such as `tet10`.
    pub name: &'static str,
    /// Cell type of VTK, which numbers its nodes as [`ElementKind`] does.
    pub vtk: u8,
    /// Element types of Gmsh's MSH format.
    pub gmsh: Listing<u32>,
    /// Descriptors of dataset 2412 of universal files, where corners and middles take turns around each face.
    pub universal: Listing<usize>,
    /// Cards of Nastran, where middles along the height come before those of the top.
    pub nastran: Listing<&'static str>,
    /// Element types of Abaqus and CalculiX behind `C3D`, or `CPE` and `CPS` in the plane, with what differs here from what
    /// the name asks for, empty for nothing.
    pub abaqus: &'static [(&'static [&'static str], &'static str)],
}

/// Elements of a kind in one format.
pub(crate) struct Listing<T: 'static> {
    /// Its numbers or names in the format; none where the format has no such element. Of kinds that share one the first in
    /// [`ElementKind::ALL`] is read.
    pub names: &'static [T],
    /// For each node of the kind its place in the file; empty where the order is the same.
    pub order: &'static [usize],
}

impl<T> Listing<T> {
    /// The nodes of an element in the order of its kind, from that of the file.
    pub fn arranged(&self, listed: &[u32]) -> Vec<u32> {
        match self.order {
            [] => listed.to_vec(),
            order => order.iter().map(|&place| listed[place]).collect(),
        }
    }
}

/// The same order as here.
const fn listed<T>(names: &'static [T]) -> Listing<T> {
    ordered(names, &[])
}

const fn ordered<T>(names: &'static [T], order: &'static [usize]) -> Listing<T> {
    Listing { names, order }
}

/// What differs here from what an element type of Abaqus asks for.
const FULL: &str = "fully integrated here";
const DISPLACEMENTS: &str = "by displacements alone here";
const BRICK: &str = "integrated with incompatible modes here";

/// A face and its nodes.
type Face = (ElementKind, &'static [usize]);

/// Faces of every kind of [`ElementKind::ALL`].
pub(super) static FACES: LazyLock<Vec<Vec<Face>>> =
    LazyLock::new(|| ElementKind::ALL.iter().map(|kind| kind.row().faces()).collect());

impl Row {
    /// Whether it has so many corners, and mid-side nodes or not.
    pub fn has(&self, corners: usize, is_quadratic: bool) -> bool {
        (self.corners.len(), self.is_quadratic) == (corners, is_quadratic)
    }

    /// Its faces: corners, then the mid-side nodes of the edges between them.
    fn faces(&self) -> Vec<Face> {
        let middle = |ends: [usize; 2]| {
            let edge = self.edges.iter().position(|edge| ends.iter().all(|end| edge.contains(end)));
            self.corners.len() + edge.expect("the side of a face is an edge")
        };
        let face = |corners: &&[usize]| {
            let is_face = |row: &Row| {
                row.dimension + 1 == self.dimension && row.has(corners.len(), self.is_quadratic)
            };
            let kind = ElementKind::listed(is_face).expect("every face has a kind");
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

impl ElementKind {
    /// Element type of Gmsh's MSH format.
    pub fn gmsh_type(self) -> u32 {
        self.row().gmsh.names[0]
    }

    /// Cell type of VTK, which numbers its nodes as here.
    pub fn vtk_type(self) -> u8 {
        self.row().vtk
    }

    /// The first kind whose row satisfies a condition.
    pub(crate) fn listed(condition: impl Fn(&Row) -> bool) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| condition(kind.row()))
    }
}
