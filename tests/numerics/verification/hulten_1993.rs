//! Mode coupling of two degrees of freedom. Independent check: closed form.
//!
//! Source: J. Hulten, Drum brake squeal, a self-exciting mechanism with constant friction, SAE 932965 (1993). A mass between
//! two sliding planes with the springs `k_1`, `k_2`, whose friction couples the two directions with opposite signs:
//!
//! ```text
//! m x'' + k_1 x + mu k_2 y = 0,    m y'' - mu k_1 x + k_2 y = 0
//! mu_c = |w_1^2 - w_2^2| / (2 w_1 w_2),   f = sqrt((w_1^2 + w_2^2) / 2) / 2 pi
//! ```
//!
//! Here the mass is a block of bricks that slides on a wall and a floor at once. It turns, too, but its rotation takes no net
//! force from either plane. What is left is its elasticity: errors fall with one over Young's modulus.

use super::*;

/// Frequencies on the two springs, Hz.
const OWN: [f64; 2] = [1000.0, 750.0];

/// Critical friction, frequency there, and growth at friction 0.4 of a block of that modulus.
fn block(young_modulus: f64) -> [f64; 3] {
    let size = [0.02, 0.06, 0.01];
    let block = brick("block", [0.0; 3], size, [2, 4, 2]);
    let folder = folder("hulten_1993", &file_of(&[block], |point| point));
    let mass = 7850.0 * size[0] * size[1] * size[2];
    let [wall, floor] = [(OWN[0], size[1]), (OWN[1], size[0])]
        .map(|(own, side)| own / side / size[2] * mass * TAU * TAU * own);
    let case = include_str!("../../cases/hulten-1993.toml");
    let springs = format!(
        "material.young_modulus={young_modulus:e} ; contacts.wall.normal_stiffness={wall:?} ; \
         contacts.floor.normal_stiffness={floor:?}"
    );
    let onsets = table(&folder, "cea", case, &springs, "stability.csv");
    assert_eq!(onsets.len(), 1);
    let growth = column(&rows(&folder.join("cea/eigenvalues.csv")), "growth_rate_per_s");
    let growth = growth.into_iter().fold(0.0, f64::max);
    let [critical, frequency] = onsets[0].numbers(["critical_friction", "frequency_hz"]);
    [critical, frequency, growth]
}

#[test]
fn hulten_1993_a_block_in_a_corner_flutters_where_two_degrees_of_freedom_do() {
    let [w1, w2] = OWN.map(|frequency| TAU * frequency);
    let critical = (w1 * w1 - w2 * w2) / (2.0 * w1 * w2);
    let frequency = (0.5 * (w1 * w1 + w2 * w2)).sqrt() / TAU;
    // kappa = -lambda^2 has the imaginary part w_1 w_2 sqrt(mu^2 - mu_c^2).
    let imaginary = w1 * w2 * (0.4_f64.powi(2) - critical * critical).sqrt();
    let growth = c64::new(0.5 * (w1 * w1 + w2 * w2), imaginary).sqrt().im;
    let expected = [critical, frequency, growth];
    let errors = [2.1e11, 2.1e12].map(|modulus| {
        let found = block(modulus);
        [0, 1, 2].map(|k| found[k] / expected[k] - 1.0)
    });
    for k in 0..3 {
        assert!(errors[1][k].abs() < 3e-4, "{errors:?}");
        within(&[order(errors[0][k], errors[1][k], 10.0)], &[1.0], 0.1);
    }
}
