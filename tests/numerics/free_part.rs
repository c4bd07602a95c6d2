//! Parts by themselves: free modes, and the constants of a material from them.

use crate::prelude::*;
use frictionsim::study::StudyError;
use frictionsim::study::fit::{FitError, fit_case};

/// The nine constants of a lining, by key.
const CONSTANTS: [(&str, f64); 9] = [
    ("material.young_moduli[1]", 8e9),
    ("material.young_moduli[2]", 7e9),
    ("material.young_moduli[3]", 1.5e9),
    ("material.poisson_ratios[1]", 0.25),
    ("material.poisson_ratios[2]", 0.15),
    ("material.poisson_ratios[3]", 0.2),
    ("material.shear_moduli[1]", 3e9),
    ("material.shear_moduli[2]", 1.2e9),
    ("material.shear_moduli[3]", 1e9),
];

/// A block of lining of 50 x 40 x 20 mm that nothing holds.
fn lining(name: &str, sections: &str, overrides: &[String]) -> Case {
    let block = brick("part", [0.0; 3], [0.05, 0.04, 0.02], [4, 3, 2]);
    let mesh = file_of(&[block], |point| point);
    let text = format!("{}{sections}", include_str!("../cases/free-lining.toml"));
    case_beside(&format!("free-part-{name}"), &[("part.msh", &mesh)], &text, overrides)
}

fn dense(case: &Case) -> Vec<f64> {
    let squares = crate::supported_bodies::dense(case);
    // Six rigid motions of round-off.
    assert!(squares[5].abs() < 1e-6 * squares[6]);
    squares[6..].iter().map(|square| square.sqrt()).collect()
}

/// Independent check: a dense decomposition of the same matrices; with a loss factor `lambda = lambda_0 sqrt(1 + i eta)`; with
/// damping of the mass and the stiffness `lambda^2 + (alpha + beta omega^2) lambda + omega^2 = 0`.
#[test]
fn free_modes_are_those_of_the_dense_pencil_above_its_rigid_motions() {
    let damped =
        "[damping]\nmass_coefficient = 50.0\nstiffness_coefficient = 1e-7\n[cea]\nmodes = 8\n";
    let all = [
        ("[cea]\nmodes = 12\n", [0.0, 0.0, 0.0]),
        ("[cea]\nmax_frequency_hz = 16000.0\n", [0.0, 0.0, 0.0]),
        ("loss_factor = 0.1\n[cea]\nmodes = 8\n", [0.1, 0.0, 0.0]),
        (damped, [0.0, 50.0, 1e-7]),
    ];
    for (k, (sections, damping)) in all.into_iter().enumerate() {
        let case = lining(&format!("modes-{k}"), sections, &[]);
        let expected = dense(&case);
        let found = modes_and_onsets(&case).unwrap();
        let modes = &found.points[0].modes;
        let [eta, alpha, beta] = damping;
        for (mode, omega) in modes.iter().zip(&expected) {
            let half = 0.5 * (alpha + beta * omega * omega);
            let lambda = match eta {
                0.0 => c64::new(-half, (omega * omega - half * half).sqrt()),
                eta => c64::new(0.0, *omega) * c64::new(1.0, eta).sqrt(),
            };
            below((mode.eigenvalue - lambda).norm() / omega, 1e-8, format_args!("{k}: {lambda}"));
        }
        let below = expected.iter().filter(|omega| **omega < TAU * 16000.0).count();
        assert_eq!(modes.len(), [12, below, 8, 8][k]);
    }
}

/// `[fit]` for some keys, each between 0.6 and 1.6 times its value.
fn fitted(constants: &[(&str, f64)]) -> String {
    let bound = |(key, value): &(&str, f64)| {
        format!("\"{key}\" = [{:e}, {:e}]\n", 0.6 * value, 1.6 * value)
    };
    let bounds: String = constants.iter().map(bound).collect();
    format!("[cea]\nmodes = 30\n[fit]\nstarts = 1\n[fit.parameters]\n{bounds}")
}

/// Free modes of the lining, each off by a relative normal error.
fn measured(case: &Case, modes: usize, noise: f64, seed: u64) -> Vec<MeasuredMode> {
    let mut draw = GaussianNoise::new(seed);
    let lines = dense(case).into_iter().take(modes).enumerate();
    let mut off = || 1.0 + noise * draw.draw().re;
    lines.map(|(i, omega)| measured_mode(i + 2, omega / TAU * off(), None)).collect()
}

/// Statistics: of nine constants fitted to thirty free modes with errors of 0.1 % nine in ten lie inside their 95 % intervals.
#[test]
fn nine_constants_of_a_lining_come_out_of_its_free_modes() {
    let case = lining("nine", &fitted(&CONSTANTS), &[]);
    let seeds: u64 = sized(3, 12);
    let mut inside = [0; 9];
    for seed in 1..=seeds {
        let found = fit_case(&case, &measured(&case, 30, 1e-3, seed), None).unwrap();
        // Parameters come in the order of their keys.
        let mut keys: Vec<(&str, f64)> = CONSTANTS.to_vec();
        keys.sort_by_key(|(key, _)| *key);
        for (k, (estimate, (key, exact))) in found.parameters.values().zip(&keys).enumerate() {
            let interval = estimate.low.zip(estimate.high);
            let (low, high) = interval.unwrap_or_else(|| panic!("{key}"));
            inside[k] += u32::from(low <= *exact && *exact <= high);
            // At its bounds it would have no interval of its own.
            let ratio = estimate.value / exact;
            assert!((0.62..1.58).contains(&ratio), "{key} {ratio}");
        }
    }
    let share = f64::from(inside.iter().sum::<u32>()) / (9.0 * seeds as f64);
    // 95 % of 27 or 108 draws, less three standard deviations and their dependence within a seed.
    assert!((sized(0.8, 0.86)..=1.0).contains(&share), "{inside:?}");
}

/// Theory: density and all moduli together leave every frequency as it is; the message names them.
#[test]
fn what_free_modes_cannot_tell_apart_is_named() {
    let mut constants = CONSTANTS.to_vec();
    constants.retain(|(key, _)| !key.contains("poisson"));
    constants.push(("material.density", 2500.0));
    let case = lining("blind", &fitted(&constants), &[]);
    let error = fit_case(&case, &measured(&case, 30, 0.0, 1), None).unwrap_err();
    let StudyError::Fit(FitError::Blind(direction)) = &error else { panic!("{error}") };
    constants.iter().for_each(|(key, _)| has(direction, &[key]));
}

#[test]
fn pressure_on_a_part_that_nothing_holds_is_refused() {
    let load = "[boundaries.part_z1]\ncondition = \"pressure\"\npressure = 1e5\n[cea]\nmodes = 4\n";
    let error = modes_and_onsets(&lining("pressed", load, &[])).unwrap_err().to_string();
    has(&error, &["nothing holds the bodies"]);
}
