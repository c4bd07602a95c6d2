//! Waves on a ring that turns. Independent check: closed form over a radial Ritz shape.
//!
//! Source: G. H. Bryan, On the beats in the vibrations of a revolving cylinder or bell, Proc. Camb. Phil. Soc. 7 (1890) 101.
//! In the frame that turns with it the two waves of `n` nodal diameters, `U cos n theta`, `V sin n theta`, part:
//!
//! ```text
//! omega = omega_0 +- Omega eta,    eta = 2 int U V r dr / int (U^2 + V^2) r dr
//! ```
//!
//! A steel ring of 80 to 120 mm in plane strain on springs of 1e8 Pa/m along its bore, which are part of the shape; 600 rpm.

use super::*;

const RADII: [f64; 2] = [0.08, 0.12];
const SPRING: f64 = 1e8;

/// Frequency (Hz) and `eta` of the lowest wave of `n` nodal diameters, with polynomials of degree 7 for `U` and `V`.
fn closed_form(n: f64) -> [f64; 2] {
    const TERMS: usize = 8;
    let [inner, outer] = RADII;
    let at = |r: f64| (r - inner) / (outer - inner);
    let value = |j: usize, r: f64| at(r).powi(j as i32);
    let slope = |j: usize, r: f64| j as f64 * at(r).powi(j.max(1) as i32 - 1) / (outer - inner);
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let lame = shear * 2.0 * POISSON / (1.0 - 2.0 * POISSON);
    // Strains rr, tt, rt of U alone or V alone.
    let strains = |k: usize, r: f64| {
        let (j, f) = (k % TERMS, value(k % TERMS, r));
        let (out, around) =
            ([slope(j, r), f / r, -n * f / r], [0.0, n * f / r, slope(j, r) - f / r]);
        if k < TERMS { out } else { around }
    };
    let stiffness = DMatrix::from_fn(2 * TERMS, 2 * TERMS, |a, b| {
        let energy = |r: f64| {
            let ([ar, at, ag], [br, bt, bg]) = (strains(a, r), strains(b, r));
            r * (lame * (ar + at) * (br + bt) + shear * (2.0 * (ar * br + at * bt) + ag * bg))
        };
        let is_same = (a < TERMS) == (b < TERMS);
        let held = value(a % TERMS, inner) * value(b % TERMS, inner) * inner * SPRING;
        integral(inner, outer, energy) + if is_same { held } else { 0.0 }
    });
    let mass = DMatrix::from_fn(2 * TERMS, 2 * TERMS, |a, b| {
        let own = f64::from(u8::from((a < TERMS) == (b < TERMS)));
        own * integral(inner, outer, |r| DENSITY * r * value(a % TERMS, r) * value(b % TERMS, r))
    });
    let (square, shape) = ritz(&stiffness, &mass);
    let part = |k: usize, r: f64| -> f64 { (0..TERMS).map(|j| shape[k + j] * value(j, r)).sum() };
    let [u, v] = [0, TERMS].map(|first| move |r: f64| part(first, r));
    let coupled = integral(inner, outer, |r| 2.0 * r * u(r) * v(r));
    let whole = integral(inner, outer, |r| r * (u(r).powi(2) + v(r).powi(2)));
    [square.sqrt() / TAU, (coupled / whole).abs()]
}

/// The same of a ring of so many equal sectors, for two and three nodal diameters: half the distance of the two waves over the speed.
fn ring(sectors: usize) -> [[f64; 2]; 2] {
    let [inner, outer] = RADII;
    let size = [outer - inner, TAU / sectors as f64, 0.01];
    let block = brick("ring", [inner, 0.0, 0.0], size, [sectors / 12, 1, 1]);
    let mesh = file_of(&[block], polar);
    let case = include_str!("../../cases/bryan-1890.toml");
    let (folder, set) = (folder("bryan_1890", &mesh), format!("mesh.sectors={sectors}"));
    let modes = table(&folder, "cea", case, &set, "eigenvalues.csv");
    [2.0, 3.0].map(|n| {
        let own = modes.iter().filter(|mode| mode.number("harmonic") == n);
        let found: Vec<f64> = own.map(|mode| mode.number("frequency_hz")).collect();
        [0.5 * (found[0] + found[1]), (found[1] - found[0]) / 20.0]
    })
}

#[test]
fn bryan_1890_the_waves_of_a_turning_ring_part() {
    let meshes = [24, 48, 96].map(ring);
    for (k, n) in [2.0, 3.0].into_iter().enumerate() {
        let expected = closed_form(n);
        let errors = meshes.map(|found| [0, 1].map(|what| found[k][what] / expected[what] - 1.0));
        assert!(errors[2][0].abs() < 6e-3 && errors[2][1].abs() < 3e-3, "{errors:?}");
        for what in 0..2 {
            within(&[order(errors[1][what], errors[2][what], 2.0)], &[2.0], 0.1);
        }
    }
}
