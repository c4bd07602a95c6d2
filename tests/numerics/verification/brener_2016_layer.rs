//! An elastic layer that slides on a rigid flat. Independent check: closed form.
//!
//! Source: E. A. Brener, M. Weikamp, R. Spatschek, Y. Bar-Sinai, E. Bouchbinder, Dynamic instabilities of frictional sliding at a
//! bimaterial interface, J. Mech. Phys. Solids 89 (2016) 149; there for two bodies, here on a rigid one. A layer of thickness `H` with its
//! far side clamped and `u_y = 0`, `sigma_xy = -f sigma_yy` on its near side carries waves `e^{ikx + lambda t}`; with `alpha^2 = k^2 +
//! lambda^2 / c_p^2`, `beta^2 = k^2 + lambda^2 / c_s^2` they are sums of `cosh`, `sinh` of `alpha y` and `beta y`, and a determinant of
//! four conditions vanishes. Without damping some wave grows at every friction: an undamped disc is never stable.
//!
//! nu 0.3, f 0.3, H 50 mm, steel; as the layer of an annulus with radius `a`, `n = k a`, errors fall with `H / a`.

use super::*;

const FRICTION: f64 = 0.3;
const HEIGHT: f64 = 0.05;

/// The determinant of the four conditions at `lambda`, in units of `c_s / H`, of waves with `k H`.
fn determinant(k: f64, lambda: c64) -> c64 {
    let i = c64::new(0.0, 1.0);
    // (c_s / c_p)^2
    let ratio = (1.0 - 2.0 * POISSON) / (2.0 * (1.0 - POISSON));
    let square = lambda * lambda;
    let [alpha, beta] = [square * ratio + k * k, square + k * k].map(|square: c64| square.sqrt());
    // Value, slope and curvature of cosh and sinh at a height.
    let waves = |a: c64, y: f64| {
        let (cosh, sinh) = ((a * y).cosh(), (a * y).sinh());
        [[cosh, a * sinh, a * a * cosh], [sinh, a * cosh, a * a * sinh]]
    };
    let column = |j: usize| {
        // u = grad phi + curl psi; stresses over the shear modulus, with 1 / ratio - 2 for Lame's constant.
        let at = |y: f64| waves(if j < 2 { alpha } else { beta }, y)[j % 2];
        let ([f, df, ddf], [fh, dfh, _]) = (at(0.0), at(1.0));
        if j < 2 {
            let normal = f * square * ratio * (1.0 / ratio - 2.0) + ddf * 2.0;
            [i * k * fh, dfh, df, i * k * df * 2.0 + normal * FRICTION]
        } else {
            let normal = -(i * k * df * 2.0);
            [dfh, -(i * k * fh), -(i * k * f), ddf + f * (k * k) + normal * FRICTION]
        }
    };
    Mat::from_fn(4, 4, |row, j| column(j)[row]).determinant()
}

/// The growing wave with `k H`, from a guess, by Newton's method: growth rate (1/s) and frequency (Hz).
fn closed_form(k: f64, guess: c64) -> [f64; 2] {
    // omega = i lambda in the source's units.
    let mut lambda = c64::new(0.0, -1.0) * guess;
    for _ in 0..20 {
        let slope = (determinant(k, lambda + 1e-6) - determinant(k, lambda - 1e-6)) / 2e-6;
        lambda -= determinant(k, lambda) / slope;
    }
    assert!((lambda - c64::new(0.0, -1.0) * guess).norm() < 2e-5, "k H = {k}: {lambda}");
    let shear_speed = (YOUNG / (2.0 * (1.0 + POISSON) * DENSITY)).sqrt();
    [lambda.re * shear_speed / HEIGHT, lambda.im.abs() * shear_speed / HEIGHT / TAU]
}

/// The fastest growing waves of an annulus of inner radius `a` for `k H` of 0.5 and 1.
fn annulus(a: f64) -> [[f64; 2]; 2] {
    let case = include_str!("../../cases/brener-2016-layer.toml");
    let (outer, around) = (a + HEIGHT, 160.0 * a);
    let size = format!(
        "geometry.inner_radius={a:?} ; geometry.outer_radius={outer:?} ; \
         mesh.circumferential_elements={around}"
    );
    let folder = folder("brener_2016_layer", &[]);
    let modes = table(&folder, "cea", case, &size, "eigenvalues.csv");
    [0.5, 1.0].map(|k| {
        let n = (k * a / HEIGHT).round();
        let own = modes.iter().filter(|mode| mode.number("harmonic") == n);
        let own = own.map(|mode| mode.numbers(["growth_rate_per_s", "frequency_hz"]));
        own.max_by(|a: &[f64; 2], b| a[0].total_cmp(&b[0])).unwrap()
    })
}

#[test]
fn brener_2016_layer_an_undamped_layer_grows_at_every_friction() {
    let guesses = [(0.5, c64::new(-1.80176, 0.04028)), (1.0, c64::new(-2.35541, 0.04872))];
    let expected = guesses.map(|(k, guess)| closed_form(k, guess));
    let found = [1.0, 2.0, 4.0].map(annulus);
    for (k, expected) in expected.iter().enumerate() {
        for what in 0..2 {
            let [one, two, four] = found.map(|annulus| annulus[k][what]);
            // Curvature enters with H / a and its square.
            let limit = (8.0 * four - 6.0 * two + one) / 3.0;
            let order = order(two - limit, four - limit, 2.0);
            let error = limit / expected[what] - 1.0;
            let said = format!("{k} {what}: {one} {two} {four} -> {limit}, {error:e}, {order}");
            assert!(error.abs() < [1e-3, 3e-4][what] && (order - 1.0).abs() < 0.15, "{said}");
        }
    }
}
