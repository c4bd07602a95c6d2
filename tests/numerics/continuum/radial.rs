//! One spectral element along the radius: Lagrange polynomials through Chebyshev points, integrated by a Gauss rule.

use std::f64::consts::PI;

/// A quadrature point with the weight of `dr`, m, and value and slope of each basis function, 1 and 1/m.
pub struct RadialPoint {
    pub radius: f64,
    pub weight: f64,
    pub values: Vec<f64>,
    pub slopes: Vec<f64>,
}

/// The element: basis function 0 alone is not zero at the inner edge, the last alone at the outer.
pub struct RadialElement {
    pub points: Vec<RadialPoint>,
}

impl RadialElement {
    /// Basis of the given degree on `[inner, outer]`; the Gauss rule has twice as many points, far
    /// beyond what the products with `1/r^2` and `1/r^4` need.
    pub fn new(inner: f64, outer: f64, degree: usize) -> Self {
        let nodes: Vec<f64> =
            (0..=degree).map(|i| -(PI * i as f64 / degree as f64).cos()).collect();
        let differentiation = differentiation_matrix(&nodes);
        let half = 0.5 * (outer - inner);
        let points = gauss_legendre(2 * degree).into_iter().map(|(x, w)| {
            let values = lagrange(&nodes, x);
            let slope = |j: usize| {
                let at_nodes = values.iter().zip(&differentiation);
                at_nodes.map(|(value, row)| value * row[j]).sum::<f64>() / half
            };
            let slopes = (0..=degree).map(slope).collect();
            RadialPoint { radius: inner + half * (1.0 + x), weight: half * w, values, slopes }
        });
        Self { points: points.collect() }
    }
}

/// Barycentric weights of the Chebyshev points of the second kind.
fn barycentric_weight(i: usize, degree: usize) -> f64 {
    let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    if i == 0 || i == degree { 0.5 * sign } else { sign }
}

/// Lagrange polynomials at `x`, which is none of the nodes.
fn lagrange(nodes: &[f64], x: f64) -> Vec<f64> {
    let degree = nodes.len() - 1;
    let term = |(i, node): (usize, &f64)| barycentric_weight(i, degree) / (x - node);
    let terms: Vec<f64> = nodes.iter().enumerate().map(term).collect();
    let sum: f64 = terms.iter().sum();
    terms.into_iter().map(|term| term / sum).collect()
}

/// Derivative of Lagrange polynomial `j` at node `i`, in `[i][j]`.
fn differentiation_matrix(nodes: &[f64]) -> Vec<Vec<f64>> {
    let degree = nodes.len() - 1;
    let row = |i: usize| {
        let entry = |j: usize| {
            let ratio = barycentric_weight(j, degree) / barycentric_weight(i, degree);
            if i == j { 0.0 } else { ratio / (nodes[i] - nodes[j]) }
        };
        let mut row: Vec<f64> = (0..=degree).map(entry).collect();
        // The derivative of a constant is zero to round-off this way.
        row[i] = -row.iter().sum::<f64>();
        row
    };
    (0..=degree).map(row).collect()
}

/// Gauss-Legendre points and weights on `[-1, 1]` by Newton's method on the Legendre polynomial.
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let point = |i: usize| {
        let mut x = -(PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut previous, mut value) = (1.0, x);
            for k in (2..=count).map(|k| k as f64) {
                let next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k;
                (previous, value) = (value, next);
            }
            slope = count as f64 * (previous - x * value) / (1.0 - x * x);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(point).collect()
}
