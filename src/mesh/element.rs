//! Element shapes: nodes, edges, shape functions, quadrature, and their numbers in file formats.
//!
//! Everything that depends on the shape of an element is said here, once.

/// Value of a shape function and its gradient in the parent element, `N` and `dN / d(xi, eta)`.
pub type Shape = (f64, [f64; 2]);

/// A point of the parent element with its quadrature weight, `(xi, eta, weight)`.
pub type QuadraturePoint = (f64, f64, f64);

/// Shape of an element.
///
/// Nodes are the corners counter-clockwise, then, for quadratic shapes, the mid-side node after each corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Three-node linear triangle, `0 <= xi, eta` and `xi + eta <= 1`.
    Tri3,
    /// Six-node quadratic triangle.
    Tri6,
    /// Four-node bilinear quadrilateral, `-1 <= xi, eta <= 1`.
    Quad4,
    /// Eight-node serendipity quadrilateral.
    Quad8,
}

const SQUARE: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
const GAUSS: f64 = 0.577_350_269_189_625_8;

impl ElementKind {
    /// Every shape there is.
    pub const ALL: [Self; 4] = [Self::Tri3, Self::Tri6, Self::Quad4, Self::Quad8];

    /// Corners of one element.
    pub fn corner_count(self) -> usize {
        match self {
            Self::Tri3 | Self::Tri6 => 3,
            Self::Quad4 | Self::Quad8 => 4,
        }
    }

    /// Whether edges are parabolas with a node at their middle.
    pub fn is_quadratic(self) -> bool {
        matches!(self, Self::Tri6 | Self::Quad8)
    }

    /// Nodes of one element.
    pub fn node_count(self) -> usize {
        self.corner_count() * if self.is_quadratic() { 2 } else { 1 }
    }

    /// Local nodes of edge `edge`, counter-clockwise: its ends, then its middle where it has one.
    pub fn edge(self, edge: usize) -> (usize, usize, Option<usize>) {
        let corners = self.corner_count();
        let middle = self.is_quadratic().then_some(corners + edge);
        (edge, (edge + 1) % corners, middle)
    }

    /// Element type of Gmsh's MSH format.
    pub fn gmsh_type(self) -> u32 {
        match self {
            Self::Tri3 => 2,
            Self::Tri6 => 9,
            Self::Quad4 => 3,
            Self::Quad8 => 16,
        }
    }

    /// Cell type of VTK, which numbers its nodes as here.
    pub fn vtk_type(self) -> u8 {
        match self {
            Self::Tri3 => 5,
            Self::Tri6 => 22,
            Self::Quad4 => 9,
            Self::Quad8 => 23,
        }
    }

    /// Shape functions at a point of the parent element, in the order of the nodes.
    ///
    /// Quad4: `N_I = (1 + xi_I xi)(1 + eta_I eta) / 4`. Quad8: the serendipity functions. Tri3: the area
    /// coordinates `L`. Tri6: `L (2 L - 1)` at corners, `4 L_I L_J` at the middle of an edge.
    pub fn shape_functions(self, xi: f64, eta: f64) -> Vec<Shape> {
        match self {
            Self::Tri3 => triangle(xi, eta).to_vec(),
            Self::Tri6 => quadratic_triangle(xi, eta),
            Self::Quad4 => SQUARE.map(|corner| bilinear(corner, xi, eta)).to_vec(),
            Self::Quad8 => serendipity(xi, eta),
        }
    }

    /// Full quadrature: 3 points for Tri3, 6 (degree 4, Dunavant 1985) for Tri6, 2 x 2 Gauss points for Quad4,
    /// 3 x 3 for Quad8.
    pub fn quadrature(self) -> Vec<QuadraturePoint> {
        const SIX: f64 = 1.0 / 6.0;
        match self {
            Self::Tri3 => vec![
                (SIX, SIX, SIX),
                (4.0 * SIX, SIX, SIX),
                (SIX, 4.0 * SIX, SIX),
            ],
            Self::Tri6 => six_points(),
            Self::Quad4 => tensor(&[(-GAUSS, 1.0), (GAUSS, 1.0)]),
            Self::Quad8 => tensor(&[
                (-0.774_596_669_241_483_4, 5.0 / 9.0),
                (0.0, 8.0 / 9.0),
                (0.774_596_669_241_483_4, 5.0 / 9.0),
            ]),
        }
    }

    /// Points at which the stress of a displacement element is most accurate (Zienkiewicz and Zhu 1992).
    pub fn superconvergent_points(self) -> Vec<(f64, f64)> {
        const THIRD: f64 = 1.0 / 3.0;
        match self {
            Self::Tri3 => vec![(THIRD, THIRD)],
            Self::Tri6 => vec![(0.5, 0.0), (0.5, 0.5), (0.0, 0.5)],
            Self::Quad4 => vec![(0.0, 0.0)],
            Self::Quad8 => vec![
                (-GAUSS, -GAUSS),
                (GAUSS, -GAUSS),
                (GAUSS, GAUSS),
                (-GAUSS, GAUSS),
            ],
        }
    }

    /// Local nodes around the outline, mid-side nodes between their corners.
    pub fn outline(self) -> Vec<usize> {
        (0..self.corner_count())
            .flat_map(|edge| {
                let (start, _, middle) = self.edge(edge);
                std::iter::once(start).chain(middle)
            })
            .collect()
    }

    /// Parent coordinates of each node.
    pub fn node_places(self) -> Vec<(f64, f64)> {
        let corners = match self.corner_count() {
            3 => vec![(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)],
            _ => SQUARE.to_vec(),
        };
        let count = corners.len();
        let middle = |i: usize| {
            let (p, q) = (corners[i], corners[(i + 1) % count]);
            (0.5 * (p.0 + q.0), 0.5 * (p.1 + q.1))
        };
        let middles = (0..count).filter(|_| self.is_quadratic()).map(middle);
        corners.iter().copied().chain(middles).collect()
    }
}

fn triangle(xi: f64, eta: f64) -> [Shape; 3] {
    [
        (1.0 - xi - eta, [-1.0, -1.0]),
        (xi, [1.0, 0.0]),
        (eta, [0.0, 1.0]),
    ]
}

fn quadratic_triangle(xi: f64, eta: f64) -> Vec<Shape> {
    let area = triangle(xi, eta);
    let corner = |(l, d): Shape| {
        let slope = 4.0 * l - 1.0;
        (l * (2.0 * l - 1.0), [slope * d[0], slope * d[1]])
    };
    let middle = |i: usize| {
        let ((p, dp), (q, dq)) = (area[i], area[(i + 1) % 3]);
        let slope = |axis: usize| 4.0 * (p * dq[axis] + q * dp[axis]);
        (4.0 * p * q, [slope(0), slope(1)])
    };
    area.into_iter()
        .map(corner)
        .chain((0..3).map(middle))
        .collect()
}

fn bilinear((a, b): (f64, f64), xi: f64, eta: f64) -> Shape {
    let (p, q) = (1.0 + a * xi, 1.0 + b * eta);
    (0.25 * p * q, [0.25 * a * q, 0.25 * b * p])
}

fn serendipity(xi: f64, eta: f64) -> Vec<Shape> {
    let corner = SQUARE.iter().map(|&(a, b)| {
        let (p, q) = (1.0 + a * xi, 1.0 + b * eta);
        let s = a * xi + b * eta - 1.0;
        (
            0.25 * p * q * s,
            [0.25 * a * q * (s + p), 0.25 * b * p * (s + q)],
        )
    });
    let along_xi = |b: f64| {
        let (p, q) = (1.0 - xi * xi, 1.0 + b * eta);
        (0.5 * p * q, [-xi * q, 0.5 * b * p])
    };
    let along_eta = |a: f64| {
        let (p, q) = (1.0 + a * xi, 1.0 - eta * eta);
        (0.5 * p * q, [0.5 * a * q, -eta * p])
    };
    let middle = [
        along_xi(-1.0),
        along_eta(1.0),
        along_xi(1.0),
        along_eta(-1.0),
    ];
    corner.chain(middle).collect()
}

fn tensor(line: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    line.iter()
        .flat_map(|&(eta, v)| line.iter().map(move |&(xi, w)| (xi, eta, w * v)))
        .collect()
}

/// Two triples of points, each the orbit of one; exact for polynomials of degree 4.
fn six_points() -> Vec<QuadraturePoint> {
    let root = 10.0_f64.sqrt();
    let spread = (38.0 - 44.0 * 0.4_f64.sqrt()).sqrt();
    let share = (213_125.0 - 53_320.0 * root).sqrt();
    let orbit = |sign: f64| {
        let a = (8.0 - root + sign * spread) / 18.0;
        let weight = 0.5 * (620.0 + sign * share) / 3720.0;
        [(a, a), (1.0 - 2.0 * a, a), (a, 1.0 - 2.0 * a)].map(|(xi, eta)| (xi, eta, weight))
    };
    [orbit(1.0), orbit(-1.0)].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shape_functions_are_one_at_their_node_and_sum_to_one() {
        for kind in ElementKind::ALL {
            for (node, (xi, eta)) in kind.node_places().into_iter().enumerate() {
                for (other, (value, _)) in kind.shape_functions(xi, eta).into_iter().enumerate() {
                    let expected = f64::from(u8::from(node == other));
                    assert!((value - expected).abs() < 1e-14, "{kind:?} {node} {other}");
                }
            }
            let shapes = kind.shape_functions(0.3, 0.2);
            let sum: f64 = shapes.iter().map(|s| s.0).sum();
            let slopes = [0, 1].map(|axis| shapes.iter().map(|s| s.1[axis]).sum::<f64>());
            assert!((sum - 1.0).abs() < 1e-14 && slopes.iter().all(|s| s.abs() < 1e-13));
        }
    }

    /// Independent check: `∫ xi^p eta^q = p! q! / (p + q + 2)!` over the unit triangle.
    #[test]
    fn quadrature_of_triangles_is_exact_to_its_degree() {
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        for (kind, degree) in [(ElementKind::Tri3, 2), (ElementKind::Tri6, 4)] {
            for p in 0..=degree {
                for q in 0..=degree - p {
                    let points = kind.quadrature().into_iter();
                    let sum: f64 = points
                        .map(|(x, y, w)| w * x.powi(p as i32) * y.powi(q as i32))
                        .sum();
                    let exact = factorial(p) * factorial(q) / factorial(p + q + 2);
                    assert!(
                        (sum - exact).abs() < 1e-15,
                        "{kind:?} {p} {q}: {sum} {exact}"
                    );
                }
            }
        }
    }
}
