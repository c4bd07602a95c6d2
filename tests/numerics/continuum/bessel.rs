//! The same eigenvalues as roots of a 4 x 4 determinant of Bessel functions: a second method that
//! shares no discretisation with the spectral element.

use super::{Annulus, Contact};
use crate::prelude::*;

/// Bessel functions of integer order: `[J_n(z), Y_n(z)]`.
pub type BesselPair = fn(usize, c64) -> [c64; 2];

pub fn of_real_argument(order: usize, z: c64) -> [c64; 2] {
    assert_eq!(z.im, 0.0, "this pair takes real arguments only");
    let order = order as i32;
    [libm::jn(order, z.re), libm::yn(order, z.re)].map(|value| c64::new(value, 0.0))
}

/// For complex arguments, from the ascending series (Abramowitz and Stegun 9.1.10, 9.1.11), whose
/// cancellation costs a factor `e^|z|`: five digits at the largest argument of the tests, 11.
pub fn of_complex_argument(order: usize, z: c64) -> [c64; 2] {
    const EULER: f64 = 0.577_215_664_901_532_9;
    let half = z * 0.5;
    let digamma = |k: usize| -EULER + (1..k).map(|i| 1.0 / i as f64).sum::<f64>();
    let mut power = c64::new(1.0, 0.0);
    for k in 1..=order {
        power = power * half / k as f64;
    }
    let (mut j, mut tail) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
    for k in 0..60 {
        j += power;
        tail += power * (digamma(k + 1) + digamma(order + k + 1));
        power = power * half * half * (-1.0 / ((k + 1) as f64 * (order + k + 1) as f64));
    }
    // Finite sum of (n - k - 1)! / k! (z/2)^(2k - n).
    let mut finite = c64::new(0.0, 0.0);
    for k in 0..order {
        let factorial = |m: usize| (1..=m).map(|i| i as f64).product::<f64>();
        let exponent = 2 * k as i32 - order as i32;
        finite += half.powi(exponent) * (factorial(order - k - 1) / factorial(k));
    }
    let y = (half.ln() * j * 2.0 - finite - tail) * std::f64::consts::FRAC_1_PI;
    [j, y]
}

/// Determinant whose roots are the undamped `omega` (`kappa = omega^2`) of one harmonic.
///
/// `u = grad(phi) + curl(psi)` with `phi` of wave number `omega / c_l` and `psi = i chi` of `omega / c_t`: `U = phi' - n chi / r`, `W = n
/// phi / r - chi'`. Conditions: `U = W = 0` at `b`; at `a` `U = 0` (or `sigma_rr = k_n U`) and `sigma_r theta = mu sigma_rr`.
pub fn determinant(
    annulus: &Annulus,
    harmonic: usize,
    contact: &Contact,
    omega: c64,
    bessel: BesselPair,
) -> c64 {
    assert!(contact.prestress_interference.is_none(), "no Bessel functions with prestress");
    let [lambda, shear] = annulus.lame_constants();
    let pressure_speed = ((lambda + 2.0 * shear) / annulus.density).sqrt();
    let shear_speed = (shear / annulus.density).sqrt();
    let n = harmonic as f64;
    let friction = c64::new(0.0, contact.friction_coefficient);
    // [f, f', f''] of both Bessel functions of one wave speed.
    let functions = |speed: f64, r: f64| {
        let k = omega / speed;
        let z = k * r;
        let (here, above) = (bessel(harmonic, z), bessel(harmonic + 1, z));
        [0, 1].map(|kind| {
            let value = here[kind];
            let slope = value * (n / r) - k * above[kind];
            let curvature = value * (n * n / (r * r)) - k * k * value - slope / r;
            [value, slope, curvature]
        })
    };
    // Columns: phi = J, phi = Y, chi = J, chi = Y. Entries: U, W, sigma_rr, sigma_r theta / i.
    let fields = |r: f64| {
        let [pj, py] = functions(pressure_speed, r);
        let [sj, sy] = functions(shear_speed, r);
        // Displacements and their slopes.
        let dilatational = |f: [c64; 3]| [f[1], f[0] * (n / r), f[2], (f[1] - f[0] / r) * (n / r)];
        let rotational =
            |f: [c64; 3]| [f[0] * (-n / r), -f[1], (f[1] - f[0] / r) * (-n / r), -f[2]];
        let all = [dilatational(pj), dilatational(py), rotational(sj), rotational(sy)];
        all.map(|[u, w, du, dw]| {
            let radial = du * (lambda + 2.0 * shear) + (u - w * n) * (lambda / r);
            [u, w, radial, ((u * n - w) / r + dw) * shear]
        })
    };
    let (a, b) = (annulus.inner_radius, annulus.outer_radius);
    let (inner, outer) = (fields(a), fields(b));
    let stress_unit = shear / a;
    let matrix = Mat::from_fn(4, 4, |row, column| {
        let [u, _, radial, tangential] = inner[column];
        match (row, contact.normal_stiffness) {
            (0, None) => u,
            (0, Some(k_n)) => (radial - u * k_n) / (stress_unit + k_n),
            (1, _) => (tangential + friction * radial) / stress_unit,
            (2, _) => outer[column][0],
            _ => outer[column][1],
        }
    });
    matrix.determinant()
}

/// Root of the determinant near `start`, by the secant method.
pub fn root_near(annulus: &Annulus, harmonic: usize, contact: &Contact, start: c64) -> c64 {
    let value = |omega| determinant(annulus, harmonic, contact, omega, of_complex_argument);
    let mut old = start * (1.0 + 1e-5);
    let mut new = start * (1.0 - 1e-5);
    let (mut old_value, mut new_value) = (value(old), value(new));
    for _ in 0..20 {
        let change = new_value * (new - old) / (new_value - old_value);
        if !change.is_finite() || change.norm() < 1e-15 * new.norm() {
            break;
        }
        (old, old_value) = (new, new_value);
        new -= change;
        new_value = value(new);
    }
    new
}
