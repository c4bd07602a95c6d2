//! A disc between two pads that cover a sector. Independent check: thin plates to first order in the stiffness of the pads.
//!
//! Source: after J. E. Mottershead, S. N. Chan, Flutter instability of circular discs with frictional follower loads, J. Vib.
//! Acoust. 117 (1995) 161. Rigid planes with weak springs `k` slide around over `|theta| <= t_0` on both faces of a plate of
//! thickness `h`. In the two waves `W(r) cos n theta`, `W(r) sin n theta` friction couples what the springs part:
//!
//! ```text
//! mu_c = 2 / (h n) (I_r / I_0) |S| / sqrt(t_0^2 - S^2),   S = sin(2 n t_0) / (2 n)
//! I_r = int W^2 r dr,  I_0 = int W^2 dr over the pad
//! ```
//!
//! whatever `k`, the material and the number of faces are. r 50 to 100 mm, bore clamped, pads from 75 mm on, +-37.5 degrees, steel:
//! bricks of 20 nodes, 4 x 48 x 1. Errors fall with the square of the thickness, as shear and rotation do.

use super::*;

const RADII: [f64; 2] = [0.05, 0.1];
const PAD: f64 = 0.075;
const HALF_ANGLE: f64 = 37.5 * PI / 180.0;

/// The critical friction, with polynomials for `W`.
fn closed_form(n: f64, thickness: f64) -> f64 {
    let (length, poisson) = (RADII[1] - RADII[0], 0.3);
    // Value, slope and curvature of ((r - r_1) / length)^(j + 2).
    let term = |j: usize, r: f64| {
        let (s, p) = ((r - RADII[0]) / length, j as i32 + 2);
        let q = f64::from(p);
        [s.powi(p), q * s.powi(p - 1) / length, q * (q - 1.0) * s.powi(p - 2) / length.powi(2)]
    };
    let bent = |j: usize, r: f64| {
        let [w, dw, ddw] = term(j, r);
        [ddw, dw / r - n * n * w / (r * r), n * (dw / r - w / (r * r))]
    };
    let matrix = |entry: &dyn Fn(usize, usize, f64) -> f64| {
        DMatrix::from_fn(7, 7, |a, b| integral(RADII[0], RADII[1], |r| r * entry(a, b, r)))
    };
    let stiffness = matrix(&|a, b, r| {
        let ([ar, at, ag], [br, bt, bg]) = (bent(a, r), bent(b, r));
        ar * br + at * bt + poisson * (ar * bt + at * br) + 2.0 * (1.0 - poisson) * ag * bg
    });
    let mass = matrix(&|a, b, r| term(a, r)[0] * term(b, r)[0]);
    let (_, shape) = ritz(&stiffness, &mass);
    let square = |r: f64| (0..7).map(|j| shape[j] * term(j, r)[0]).sum::<f64>().powi(2);
    let radius = integral(PAD, RADII[1], |r| r * square(r)) / integral(PAD, RADII[1], square);
    let s = (2.0 * n * HALF_ANGLE).sin() / (2.0 * n);
    2.0 / (thickness * n) * radius * s.abs() / (HALF_ANGLE.powi(2) - s * s).sqrt()
}

/// The plate of 4 x 48 x 1 bricks of 20 nodes: under the pads, beside them around, and within.
fn plate(thickness: f64) -> Vec<u8> {
    let half = (RADII[1] - RADII[0]) / 2.0;
    let part = |name, radius: f64, [from, to]: [f64; 2], around| {
        let size = [half, to - from, thickness];
        brick(name, [radius, from, -0.5 * thickness], size, [2, around, 1])
    };
    let parts = [
        part("hub", RADII[0], [0.0, TAU], 48),
        part("pad", PAD, [-HALF_ANGLE, HALF_ANGLE], 10),
        part("rest", PAD, [HALF_ANGLE, TAU - HALF_ANGLE], 38),
    ];
    welded_file_of(&parts, 2, polar)
}

/// Critical frictions of the waves of five and six nodal diameters, from `count` friction values.
fn found(thickness: f64, count: usize) -> [f64; 2] {
    // As weak against the plate, whatever its thickness.
    let stiffness = 1e6 * (thickness / 4e-3).powi(3);
    let last = 1.1 * closed_form(6.0, thickness);
    let set = format!(
        "contacts.pad_z0.normal_stiffness={stiffness:e} ; \
         contacts.pad_z1.normal_stiffness={stiffness:e} ; \
         cea.friction_coefficients={{ from = 0.0, to = {last:?}, count = {count} }}"
    );
    let case = include_str!("../../cases/sector-pads.toml");
    let folder = folder("sector_pads", &plate(thickness));
    let mut onsets = table(&folder, "cea", case, &set, "stability.csv");
    onsets.sort_by(|a, b| a.number("frequency_hz").total_cmp(&b.number("frequency_hz")));
    assert_eq!(onsets.len(), 2, "{onsets:?}");
    [0, 1].map(|k| onsets[k].number("critical_friction"))
}

#[test]
fn sector_pads_friction_couples_what_the_springs_part() {
    let errors = [4e-3, 2e-3].map(|thickness| {
        let expected = [5.0, 6.0].map(|n| closed_form(n, thickness));
        let found = found(thickness, 2);
        println!("{thickness}: {found:?}, expected {expected:?}");
        [0, 1].map(|k| found[k] / expected[k] - 1.0)
    });
    assert!(errors[1].iter().all(|error| error.abs() < 6e-3), "{errors:?}");
    for k in [0, 1] {
        within(&[order(errors[0][k], errors[1][k], 2.0)], &[2.0], 0.4);
    }
    // The pads part the waves by 5e-7 and 8e-7 of their frequency: round-off leaves onsets open by 1e-5, for any friction values.
    let [few, more] = [2, 9].map(|count| found(2e-3, count));
    near_each(&few, &more, 1e-5);
}
