//! A beam with a free damping layer. Independent check: closed form.
//!
//! Source: H. Oberst, Ueber die Daempfung der Biegeschwingungen duenner Bleche durch fest haftende Belaege, Acustica 2 (1952)
//! 181. The complex bending stiffness of two layers without shear, `e = E_2 (1 + i eta_2) / E_1`, `h = h_2 / h_1`:
//!
//! ```text
//! B = E_1 h_1^3 / 12 (1 + 2 e (2 h + 3 h^2 + 2 h^3) + e^2 h^4) / (1 + e h),    eta = Im B / Re B
//! ```
//!
//! 1 mm of 210 GPa under 2 mm of 3 GPa with a loss factor of 0.5, 200 mm long, one end clamped: the first bending mode.

use super::*;

/// Frequency (Hz) and loss factor of the first mode on so many elements along the beam.
fn beam(elements: usize) -> [f64; 2] {
    let layer = |name, z, thickness, count| {
        brick(name, [0.0, 0.0, z], [0.2, 0.005, thickness], [elements, 1, count])
    };
    let mesh = file_of(&[layer("metal", 0.0, 1e-3, 1), layer("layer", 1e-3, 2e-3, 2)], |p| p);
    let case = include_str!("../../cases/oberst.toml");
    let modes = table(&folder("oberst", &mesh), "cea", case, "", "eigenvalues.csv");
    let [real, imaginary] = modes[0].numbers(["real_hz", "frequency_hz"]);
    let lambda = c64::new(real, imaginary);
    // lambda^2 = -omega_0^2 (1 + i eta).
    let square = lambda * lambda;
    [lambda.im, square.im / square.re]
}

#[test]
fn oberst_a_free_layer_gives_a_beam_its_loss_factor() {
    let (e, h) = (c64::new(3.0, 1.5) / 210.0, 2.0_f64);
    let bent = e * (2.0 * h + 3.0 * h * h + 2.0 * h.powi(3)) * 2.0 + e * e * h.powi(4) + 1.0;
    let stiffness = bent / (e * h + 1.0);
    let expected = stiffness.im / stiffness.re;
    assert!((expected - 0.22556).abs() < 5e-6);
    let found = [10, 20, 40].map(beam);
    // The layer's shear, which the closed form leaves out, takes 1.6e-4.
    assert!(found.iter().all(|[_, loss]| (loss / expected - 1.0).abs() < 3e-4), "{found:?}");
    let [coarse, fine] = [found[0][0] - found[1][0], found[1][0] - found[2][0]];
    within(&[order(coarse, fine, 2.0)], &[2.0], 0.1);
}
