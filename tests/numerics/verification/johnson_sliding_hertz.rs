//! Hertz's line contact that slides with friction. Independent check: closed form.
//!
//! Source: K. L. Johnson, Contact Mechanics (1985), section 7.2. A cylinder of radius `R` and plane strain on a rigid plane,
//! under the force `P` for each metre, `beta = (1 - 2 nu) / (2 (1 - nu))`, `tan(pi g) = mu beta`, `E* = E / (1 - nu^2)`:
//!
//! ```text
//! p(s) = E* cos(pi g) / (2 R) (a + s)^(1/2 - g) (a - s)^(1/2 + g),    a^2 = 4 P R / (pi E* (1 - 4 g^2))
//! ```
//!
//! with `s` from the middle of the patch, which lies `2 g a` against the friction on the body. R 0.1 m, steel, friction 0.5; the
//! force is the computed one, as the block of 800 x 200 mm above the patch is pushed down.

use super::*;

const RADIUS: f64 = 0.1;

/// Half of the block's width and its height: in a smaller one friction bends the block and turns the patch aside.
const HALF_WIDTH: f64 = 0.4;
const HEIGHT: f64 = 0.2;

/// Half of a line of points from 0: steps of `step` over `core`, then each a quarter longer.
fn graded(length: f64, step: f64, core: f64) -> Vec<f64> {
    let (mut points, mut step) = (vec![0.0], step);
    while points[points.len() - 1] < length {
        let last = points[points.len() - 1];
        step *= if last > core { 1.25 } else { 1.0 };
        points.push(last + step);
    }
    let scale = length / points[points.len() - 1];
    points.iter().map(|point| point * scale).collect()
}

/// Relative error of the pressures in the mean square and of the largest one, with steps of that size under the patch.
fn errors(step: f64) -> [f64; 2] {
    let right = graded(HALF_WIDTH, step, 1.2e-3);
    let xs: Vec<f64> = right[1..].iter().rev().map(|x| -x).chain(right.iter().copied()).collect();
    let ys = graded(HEIGHT, step, 0.6e-3);
    let mesh = quadrilaterals(&xs, &ys, ["face", "top", "body"], |x, y| {
        // Round beside the patch, flat beyond.
        let below = 0.5 * x.abs().min(6e-3).powi(2) / RADIUS;
        [x, below + (HEIGHT - below) * y / HEIGHT]
    });
    let case = include_str!("../../cases/johnson-sliding-hertz.toml");
    let folder = folder("johnson_sliding_hertz", &mesh);
    let nodes = table(&folder, "cea", case, "", "prestress.csv");
    let mut nodes = columns(&nodes, ["x_m", "pressure_pa"]);
    nodes.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let between = nodes.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (p[0][1] + p[1][1]));
    let force: f64 = between.sum();
    // The closed form under this force; friction pulls the body along +x, the patch lies behind.
    let (poisson, friction) = (0.3_f64, 0.5);
    let modulus = 2.1e11 / (1.0 - poisson * poisson);
    let g = (friction * (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson))).atan() / PI;
    let half = (4.0 * force * RADIUS / (PI * modulus * (1.0 - 4.0 * g * g))).sqrt();
    let pressure = |x: f64| match x + 2.0 * g * half {
        s if s.abs() < half => {
            let shape = (half + s).powf(0.5 - g) * (half - s).powf(0.5 + g);
            0.5 * modulus * (PI * g).cos() / RADIUS * shape
        }
        _ => 0.0,
    };
    let (mut off, mut total, mut largest) = (0.0, 0.0, 0.0_f64);
    for &[x, found] in &nodes {
        let exact = pressure(x);
        off += (found - exact).powi(2);
        total += exact * exact;
        largest = largest.max(found);
    }
    // It is largest at s = -2 g a.
    let peak = pressure(-4.0 * g * half);
    println!("step {step:e}: P {force:.0} N/m, a {half:.4e} m, p {largest:.5e} of {peak:.5e} Pa");
    [(off / total).sqrt(), largest / peak - 1.0]
}

#[test]
fn johnson_sliding_hertz_the_patch_shifts_against_friction() {
    let found = [2e-4, 1e-4, 5e-5].map(errors);
    assert!(found[2][0] < 5e-3 && found[2][1].abs() < 1e-3, "{found:?}");
    // The nodes beside the edges of the patch, which pressure leaves nearly as a square root, decide.
    let order = order(found[0][0], found[2][0], 4.0);
    assert!(order > 1.0, "{order}");
}
