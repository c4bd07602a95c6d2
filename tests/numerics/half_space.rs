//! Independent check far from the disc: waves on a sliding half-space, in closed form.
//!
//! Source: J. A. C. Martins, J. Guimaraes, L. O. Faria, Dynamic surface solutions in linear elasticity and viscoelasticity with frictional
//! boundary conditions, J. Vib. Acoust. 117 (1995) 445. Short waves on the inner edge of an annulus tend to them as their number grows.

use crate::prelude::*;
use frictionsim::linalg::banded::BandedMatrix;

const POISSON_RATIO: f64 = 0.3;
const FRICTION: f64 = 2.0;

/// Speed over that of shear waves of `e^{ik(x - ct)}` on the half-space with `u_n = 0`, `T = mu N`.
///
/// With `p^2 = 1 - c^2 / c_p^2`, `q^2 = 1 - c^2`: `-i p c^2 = mu (2 nu / (1 - 2 nu) (p^2 - 1) + 2 p^2 - 2 p q)`, by Newton's method.
fn half_space_speed() -> c64 {
    let nu = POISSON_RATIO;
    let residual = |c: c64| {
        let root = |z: c64| {
            if z.sqrt().re < 0.0 { -z.sqrt() } else { z.sqrt() }
        };
        let p = root(1.0 - c * c * ((1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))));
        let q = root(1.0 - c * c);
        let stress = (p * p - 1.0) * (2.0 * nu / (1.0 - 2.0 * nu)) + p * p * 2.0 - p * q * 2.0;
        c64::new(0.0, -1.0) * p * c * c - stress * FRICTION
    };
    // Newton's method starts in the sense in which the growing wave travels.
    let mut speed = c64::new(-1.4, 0.3);
    for _ in 0..30 {
        let slope = (residual(speed + 1e-6) - residual(speed - 1e-6)) / 2e-6;
        speed -= residual(speed) / slope;
    }
    speed
}

/// Speed of the fastest growing wave of `n` lengths on the inner edge of the annulus from 1 to 1.5.
fn annulus_speed(n: usize) -> c64 {
    let specification = ring([1.0, 1.5], Quad8, 200, 40);
    // Shear modulus and density one: speeds come in units of that of shear waves.
    let material = elastic(2.0 * (1.0 + POISSON_RATIO), POISSON_RATIO, 1.0, PlaneStrain);
    let undamped = rayleigh_damping(0.0, 0.0);
    let options = TangentOptions { damping: undamped, ..TANGENT };
    let contact = sliding_at(FRICTION, 1e-6, 1.0);
    let sector = Strip::of_annulus(&specification).unwrap();
    let tangent = WaveTangent::of_annulus(&sector, &material, &options, &contact).unwrap();
    let harmonic = tangent.harmonic(n);
    let dense = |terms: &[BandedMatrix]| {
        let size = terms[0].dimension();
        Mat::from_fn(size, size, |i, j| {
            let factors = (0..).map(|power| c64::new(0.0, FRICTION).powi(power));
            terms.iter().zip(factors).map(|(term, factor)| factor * term.get(i, j)).sum::<c64>()
        })
    };
    let (mass, stiffness) = (dense(&harmonic.mass), dense(&harmonic.stiffness));
    let kappas = mass.partial_piv_lu().solve(&stiffness).eigenvalues().unwrap();
    // lambda^2 = -kappa, e^{i n theta + lambda t}: c = i lambda / n.
    let speeds = kappas.into_iter().flat_map(|kappa: c64| {
        let lambda = (-kappa).sqrt();
        [lambda, -lambda].map(|lambda| c64::new(0.0, 1.0) * lambda / n as f64)
    });
    speeds.filter(|speed| speed.re.abs() < 2.0).max_by(|a, b| a.im.total_cmp(&b.im)).unwrap()
}

#[test]
fn short_waves_on_an_annulus_tend_to_those_of_the_sliding_half_space() {
    let (long, short) = (annulus_speed(24), annulus_speed(36));
    // Curvature enters with 1 / n.
    let limit = (short * 36.0 - long * 24.0) / 12.0;
    let theory = half_space_speed();
    near(theory.norm(), c64::new(1.4207, 0.2984).norm(), 1e-4);
    near(limit.re.abs(), theory.re.abs(), 5e-3);
    near(limit.im, theory.im, 5e-3);
}
