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

use super::{folder, integral, order, ritz, table};
use crate::bricks::EDGES;
use crate::prelude::*;

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

/// The plate of 4 x 48 x 1 bricks of 20 nodes: region `disc`, surfaces `bore`, `below` and `above` under the pads.
fn plate(thickness: f64) -> Vec<u8> {
    const RADIAL: usize = 4;
    const AROUND: usize = 48;
    let mut numbers: BTreeMap<[usize; 3], usize> = BTreeMap::new();
    let mut points = Vec::new();
    let mut node = |[i, j, k]: [usize; 3]| {
        let j = j % (2 * AROUND);
        *numbers.entry([i, j, k]).or_insert_with(|| {
            let r = RADII[0] + (RADII[1] - RADII[0]) * i as f64 / (2 * RADIAL) as f64;
            let (sin, cos) = (TAU * j as f64 / (2 * AROUND) as f64).sin_cos();
            points.push([r * cos, r * sin, thickness * (k as f64 / 2.0 - 0.5)]);
            points.len() - 1
        })
    };
    let mut elements = Vec::new();
    // Corners in units of half an element, then the middles of edges.
    let low = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]];
    let high = low.map(|[i, j, _]| [i, j, 2]);
    let ring = [[0, 1], [1, 2], [2, 3], [3, 0]];
    for i in 0..RADIAL {
        for j in 0..AROUND {
            let mut add =
                |kind: u32, group: usize, corners: &[[usize; 3]], edges: &[[usize; 2]]| {
                    let middle = |&[a, b]: &[usize; 2]| {
                        [0, 1, 2].map(|axis| (corners[a][axis] + corners[b][axis]) / 2)
                    };
                    let all = corners.iter().copied().chain(edges.iter().map(middle));
                    let list = all.map(|[a, b, c]| node([2 * i + a, 2 * j + b, c])).collect();
                    elements.push((kind, group, list));
                };
            add(17, 3, &[low, high].concat(), EDGES.as_chunks().0);
            if i == 0 {
                add(16, 0, &[low[0], high[0], high[3], low[3]], &ring);
            }
            let angle = TAU * (j as f64 + 0.5) / AROUND as f64;
            let angle = angle.min(TAU - angle);
            let radius = RADII[0] + (RADII[1] - RADII[0]) * (i as f64 + 0.5) / RADIAL as f64;
            if angle < HALF_ANGLE && radius > PAD {
                add(16, 1, &[low[0], low[3], low[2], low[1]], &ring);
                add(16, 2, &high, &ring);
            }
        }
    }
    mesh_text(&points, &[(2, "bore"), (2, "below"), (2, "above"), (3, "disc")], &elements)
}

/// Critical frictions of the waves of five and six nodal diameters.
fn found(thickness: f64) -> [f64; 2] {
    let pad = |surface: &str| {
        format!(
            "[contacts.{surface}]\nsurface = \"{surface}\"\ncounterface = \"plane\"\naxis = [0.0, 0.0, 1.0]\n\
             rotation_speed_rpm = 60.0\nfriction_coefficient = 0.3\nnormal_stiffness = {:e}\n\
             state = \"closed\"\n",
            // As weak against the plate, whatever its thickness.
            1e6 * (thickness / 4e-3).powi(3)
        )
    };
    let case = format!(
        "[mesh]\nfile = \"body.msh\"\n[material]\nyoung_modulus = 2.1e11\npoisson_ratio = 0.3\n\
         density = 7850.0\n[boundaries.bore]\ncondition = \"clamped\"\n{}{}[cea]\nmodes = 13\n\
         friction_coefficients = [0.0, {:?}]\ngeometric_stiffness = false\n",
        pad("above"),
        pad("below"),
        1.1 * closed_form(6.0, thickness),
    );
    let mut onsets =
        table(&folder("sector_pads", &plate(thickness)), "cea", &case, "stability.csv");
    onsets.sort_by(|a, b| a["frequency_hz"].total_cmp(&b["frequency_hz"]));
    assert_eq!(onsets.len(), 2, "{onsets:?}");
    [0, 1].map(|k| onsets[k]["critical_friction"])
}

#[test]
fn sector_pads_friction_couples_what_the_springs_part() {
    let errors = [4e-3, 2e-3].map(|thickness| {
        let expected = [5.0, 6.0].map(|n| closed_form(n, thickness));
        let found = found(thickness);
        println!("{thickness}: {found:?}, expected {expected:?}");
        [0, 1].map(|k| found[k] / expected[k] - 1.0)
    });
    println!("{errors:?}");
    for k in 0..2 {
        assert!(errors[1][k].abs() < 6e-3, "{errors:?}");
        let order = order(errors[0][k], errors[1][k], 2.0);
        assert!((order - 2.0).abs() < 0.4, "{order}");
    }
}
