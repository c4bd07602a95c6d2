//! Shape functions on the parent elements.

/// Value of a shape function and its slopes in the parent element, `N` and `dN / d(xi, eta, zeta)`.
pub type Shape = (f64, [f64; 3]);

/// Corners of the square.
pub(super) const SQUARE: [[f64; 3]; 4] =
    [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];

/// Corners of the triangle.
pub(super) const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Corners at the ends of its edges.
pub(super) const TRIANGLE_EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// Corners of the tetrahedron.
pub(super) const TETRAHEDRON: [[f64; 3]; 4] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Corners of the wedge, layer by layer.
#[rustfmt::skip]
pub(super) const WEDGE: [[f64; 3]; 6] = [
    [0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0],
];

/// Corners of the pyramid: its base, then its apex.
pub(super) const PYRAMID: [[f64; 3]; 5] =
    [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Corners of the brick, layer by layer.
#[rustfmt::skip]
pub(super) const BRICK: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0],
];

/// Ends of a line.
pub(super) const LINE: [[f64; 3]; 2] = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];

/// Area coordinates of a triangle, `N = 3`, volume coordinates of a tetrahedron, `N = 4`.
pub(super) fn simplex<const N: usize>(at: [f64; 3]) -> [Shape; N] {
    let is_own = |axis: usize| axis + 1 < N;
    std::array::from_fn(|node| match node {
        0 => {
            let rest = at.iter().take(N - 1).fold(1.0, |rest, x| rest - x);
            (rest, [0, 1, 2].map(|axis| if is_own(axis) { -1.0 } else { 0.0 }))
        }
        _ => (at[node - 1], [0, 1, 2].map(|axis| f64::from(u8::from(axis + 1 == node)))),
    })
}

/// `L (2 L - 1)` at corners, `4 L_I L_J` at the middle of the edge from I to J, of area or volume coordinates `L`.
pub(super) fn quadratic_simplex(linear: &[Shape], edges: &[[usize; 2]]) -> Vec<Shape> {
    let corner = |&(l, d): &Shape| {
        let slope = 4.0 * l - 1.0;
        (l * (2.0 * l - 1.0), d.map(|d| slope * d))
    };
    let middle = |&[start, end]: &[usize; 2]| {
        let ((p, dp), (q, dq)) = (linear[start], linear[end]);
        let slope = |axis: usize| 4.0 * (p * dq[axis] + q * dp[axis]);
        (4.0 * p * q, std::array::from_fn(slope))
    };
    linear.iter().map(corner).chain(edges.iter().map(middle)).collect()
}

/// Functions of a line, a square or a brick by its corners, linear along each of its `d` axes, or, with middles of its `edges`, the
/// serendipity functions: with `P` the product of `1 + xi_I xi` over the axes,
/// `N = P (xi_I xi + eta_I eta + zeta_I zeta - d + 1) / 2^d` at corners; at the middle of an edge along `xi` the product that has
/// `1 - xi^2` there, over `2^(d - 1)`.
pub(super) fn tensor(
    dimension: usize,
    corners: &[[f64; 3]],
    edges: &[[usize; 2]],
    at: [f64; 3],
) -> Vec<Shape> {
    let shape = |sign: [f64; 3]| {
        let of_axis = |k: usize| match sign[k] {
            _ if k >= dimension => [1.0, 0.0],
            0.0 => [1.0 - at[k] * at[k], -2.0 * at[k]],
            sign => [1.0 + sign * at[k], sign],
        };
        let [[f, df], [g, dg], [h, dh]] = [0, 1, 2].map(of_axis);
        let (product, others, slopes) = (f * g * h, [g * h, f * h, f * g], [df, dg, dh]);
        let is_middle = sign[..dimension].contains(&0.0);
        let scale = 0.5_f64.powi(dimension as i32 - i32::from(is_middle));
        if is_middle || edges.is_empty() {
            return (scale * product, [0, 1, 2].map(|k| scale * slopes[k] * others[k]));
        }
        let s = (0..dimension).map(|k| sign[k] * at[k]).sum::<f64>() - (dimension - 1) as f64;
        let gradient = |k: usize| scale * sign[k] * (others[k] * s + product);
        (scale * product * s, [0, 1, 2].map(gradient))
    };
    with_middles(corners, edges).map(shape).collect()
}

/// Corners, then the middles of the edges.
pub(super) fn with_middles(
    corners: &[[f64; 3]],
    edges: &[[usize; 2]],
) -> impl Iterator<Item = [f64; 3]> {
    let middle = |&[start, end]: &[usize; 2]| {
        [0, 1, 2].map(|axis| 0.5 * (corners[start][axis] + corners[end][axis]))
    };
    corners.iter().copied().chain(edges.iter().map(middle))
}

/// Linear functions of a wedge, `L_I (1 -+ zeta) / 2`.
pub(super) fn wedge(at: [f64; 3]) -> Vec<Shape> {
    let layer = |sign: f64| {
        let along = 0.5 * (1.0 + sign * at[2]);
        simplex::<3>(at).map(|(l, d)| (l * along, [d[0] * along, d[1] * along, 0.5 * sign * l]))
    };
    [layer(-1.0), layer(1.0)].concat()
}

/// Serendipity functions of a wedge: `L ((2 L - 1)(1 -+ zeta) - (1 - zeta^2)) / 2` at corners, `2 L_I L_J (1 -+ zeta)` at the
/// middle of edges of the triangles, `L (1 - zeta^2)` at the middle of edges between them.
pub(super) fn quadratic_wedge(at: [f64; 3]) -> Vec<Shape> {
    let (zeta, area) = (at[2], simplex::<3>(at));
    let bubble = 1.0 - zeta * zeta;
    let corners = |sign: f64| {
        let along = 1.0 + sign * zeta;
        area.map(|(l, d)| {
            let slope = 0.5 * ((4.0 * l - 1.0) * along - bubble);
            let axial = 0.5 * l * ((2.0 * l - 1.0) * sign + 2.0 * zeta);
            let value = 0.5 * l * ((2.0 * l - 1.0) * along - bubble);
            (value, [slope * d[0], slope * d[1], axial])
        })
    };
    let sides = |sign: f64| {
        let along = 1.0 + sign * zeta;
        TRIANGLE_EDGES.map(|[start, end]| {
            let ((p, dp), (q, dq)) = (area[start], area[end]);
            let slope = |axis: usize| 2.0 * along * (p * dq[axis] + q * dp[axis]);
            (2.0 * p * q * along, [slope(0), slope(1), 2.0 * p * q * sign])
        })
    };
    let between = area.map(|(l, d)| (l * bubble, [d[0] * bubble, d[1] * bubble, -2.0 * zeta * l]));
    [corners(-1.0), corners(1.0), sides(-1.0), sides(1.0), between].concat()
}

/// Smallest distance to the apex at which pyramids are evaluated: slopes at the apex are their limits along the axis.
const NEAR_APEX: f64 = 1e-100;

/// Rational functions of a pyramid, `c = 1 - zeta`: `N = (c + xi_I xi)(c + eta_I eta) / (4 c)` at the corners of the base,
/// `zeta` at the apex. They are those of the square on the base and of a triangle on the other faces.
///
/// Source: G. Bedrosian, Shape functions and integration formulas for three-dimensional finite element analysis, Int. J.
/// Numer. Meth. Engng. 35 (1992).
pub(super) fn pyramid([xi, eta, zeta]: [f64; 3]) -> Vec<Shape> {
    let c = (1.0 - zeta).max(NEAR_APEX);
    let base = PYRAMID[..4].iter().map(|&[a, b, _]| {
        let (p, q) = (c + a * xi, c + b * eta);
        let value = p * q / (4.0 * c);
        let slopes =
            [0.25 * a * (q / c), 0.25 * b * (p / c), 0.25 * ((p / c) * (q / c) - (p + q) / c)];
        (value, slopes)
    });
    base.chain([(zeta, [0.0, 0.0, 1.0])]).collect()
}

/// Rational functions of a quadratic pyramid, products of the linear ones `N` and linear polynomials:
/// `N (xi_I xi + eta_I eta - 1)` at the corners of the base, `zeta (2 zeta - 1)` at the apex, `2 N (c - xi_I xi)` at the middle
/// of an edge of the base along `xi`, `N` and `xi_I` those of one end, and `4 zeta N` at the middle of an edge to the apex.
///
/// Source: as for the linear pyramid.
pub(super) fn quadratic_pyramid(at: [f64; 3]) -> Vec<Shape> {
    let [xi, eta, zeta] = at;
    let linear = pyramid(at);
    // A linear function times a polynomial of value `f` and slopes `df`.
    let times = |(n, dn): Shape, f: f64, df: [f64; 3]| -> Shape {
        (n * f, std::array::from_fn(|axis| dn[axis] * f + n * df[axis]))
    };
    let corner = |(node, &[a, b, _]): (usize, &[f64; 3])| {
        times(linear[node], a * xi + b * eta - 1.0, [a, b, 0.0])
    };
    // The middle of the edge of the base that begins at a corner and runs along an axis.
    let side = |node: usize, axis: usize| {
        let sign = PYRAMID[node][axis];
        let mut slopes = [0.0, 0.0, -2.0];
        slopes[axis] = -2.0 * sign;
        times(linear[node], 2.0 * (1.0 - zeta - sign * at[axis]), slopes)
    };
    let apex = (zeta * (2.0 * zeta - 1.0), [0.0, 0.0, 4.0 * zeta - 1.0]);
    let rising = |node: usize| times(linear[node], 4.0 * zeta, [0.0, 0.0, 4.0]);
    let corners = PYRAMID[..4].iter().enumerate().map(corner);
    corners
        .chain([apex, side(0, 0), side(1, 1), side(2, 0), side(3, 1)])
        .chain((0..4).map(rising))
        .collect()
}
