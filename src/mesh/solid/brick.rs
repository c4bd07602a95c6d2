//! Shape functions and quadrature of bricks with 8 and 20 nodes.

/// Value of a shape function and its gradient in the parent element.
pub type BrickShape = (f64, [f64; 3]);

const CORNERS: [[isize; 3]; 8] = [
    [-1, -1, -1],
    [1, -1, -1],
    [1, 1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
];

const MIDDLES: [[isize; 3]; 12] = [
    [0, -1, -1],
    [1, 0, -1],
    [0, 1, -1],
    [-1, 0, -1],
    [0, -1, 1],
    [1, 0, 1],
    [0, 1, 1],
    [-1, 0, 1],
    [-1, -1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 1, 0],
];

/// Parent coordinates of each node: radially, around, axially. The order is that of VTK.
pub fn brick_places(is_quadratic: bool) -> Vec<[isize; 3]> {
    let middles = if is_quadratic { &MIDDLES[..] } else { &[] };
    CORNERS.iter().chain(middles).copied().collect()
}

/// Shape functions at a point of the parent element: trilinear, or the serendipity functions
/// `N = (1 + xi_I xi)(1 + eta_I eta)(1 + zeta_I zeta)(xi_I xi + eta_I eta + zeta_I zeta - 2) / 8` at corners and
/// `(1 - xi^2)(1 + eta_I eta)(1 + zeta_I zeta) / 4` at the middle of edges along `xi`.
pub fn brick_shapes(is_quadratic: bool, at: [f64; 3]) -> Vec<BrickShape> {
    let places = brick_places(is_quadratic);
    places
        .into_iter()
        .map(|place| {
            let sign = place.map(|s| s as f64);
            let factor: [f64; 3] = std::array::from_fn(|k| match place[k] {
                0 => 1.0 - at[k] * at[k],
                _ => 1.0 + sign[k] * at[k],
            });
            let slope: [f64; 3] = std::array::from_fn(|k| match place[k] {
                0 => -2.0 * at[k],
                _ => sign[k],
            });
            let product = factor[0] * factor[1] * factor[2];
            let others = [
                factor[1] * factor[2],
                factor[0] * factor[2],
                factor[0] * factor[1],
            ];
            if !is_quadratic {
                return (
                    0.125 * product,
                    std::array::from_fn(|k| 0.125 * slope[k] * others[k]),
                );
            }
            if place.contains(&0) {
                return (
                    0.25 * product,
                    std::array::from_fn(|k| 0.25 * slope[k] * others[k]),
                );
            }
            let s = (0..3).map(|k| sign[k] * at[k]).sum::<f64>() - 2.0;
            let gradient = |k: usize| 0.125 * sign[k] * (others[k] * s + product);
            (0.125 * product * s, std::array::from_fn(gradient))
        })
        .collect()
}

/// Points and weights of one direction.
pub(super) fn line(is_quadratic: bool) -> &'static [(f64, f64)] {
    const TWO: [(f64, f64); 2] = [
        (-0.577_350_269_189_625_8, 1.0),
        (0.577_350_269_189_625_8, 1.0),
    ];
    const THREE: [(f64, f64); 3] = [
        (-0.774_596_669_241_483_4, 5.0 / 9.0),
        (0.0, 8.0 / 9.0),
        (0.774_596_669_241_483_4, 5.0 / 9.0),
    ];
    if is_quadratic { &THREE } else { &TWO }
}

/// Gauss points `(place, weight)`: 2 x 2 x 2, or 3 x 3 x 3 for 20 nodes.
pub fn brick_quadrature(is_quadratic: bool) -> Vec<([f64; 3], f64)> {
    let line = line(is_quadratic);
    let mut points = Vec::with_capacity(line.len().pow(3));
    for &(z, w) in line {
        for &(y, v) in line {
            for &(x, u) in line {
                points.push(([x, y, z], u * v * w));
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shape_functions_are_one_at_their_node_and_sum_to_one() {
        for is_quadratic in [false, true] {
            for (node, place) in brick_places(is_quadratic).into_iter().enumerate() {
                let shapes = brick_shapes(is_quadratic, place.map(|p| p as f64));
                for (other, (value, _)) in shapes.into_iter().enumerate() {
                    assert_eq!(value, f64::from(u8::from(node == other)));
                }
            }
            let at = [0.3, -0.2, 0.7];
            let shapes = brick_shapes(is_quadratic, at);
            assert!((shapes.iter().map(|s| s.0).sum::<f64>() - 1.0).abs() < 1e-15);
            for axis in 0..3 {
                let h = 1e-6;
                let (mut a, mut b) = (at, at);
                (a[axis], b[axis]) = (at[axis] - h, at[axis] + h);
                let ends = [a, b].map(|p| brick_shapes(is_quadratic, p));
                for (k, shape) in shapes.iter().enumerate() {
                    let difference = (ends[1][k].0 - ends[0][k].0) / (2.0 * h);
                    assert!((difference - shape.1[axis]).abs() < 1e-9);
                }
            }
        }
    }
}
