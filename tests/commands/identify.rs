//! Damping identified from frequency responses whose coefficients are known.
//!
//! Independent checks: the responses come from the finite-element model or from modal sums written
//! here, never from the library's own modal model.

use crate::prelude::*;
use frictionsim::signal::*;
use rayon::prelude::*;

const ALPHA: f64 = 40.0;
const BETA: f64 = 4.5e-7;

/// A measurement with noise relative to the magnitude, as `frictionsim frf` writes it.
fn noisy(values: &[c64], relative: f64, seed: u64) -> Vec<c64> {
    let mut noise = GaussianNoise::new(seed);
    values.iter().map(|h| h + noise.draw() * (relative * h.norm())).collect()
}

/// Driving-point accelerance of the free polycarbonate disc at its rim, up to 10 kHz.
fn free_disc(step_hz: f64) -> (Vec<f64>, Vec<c64>) {
    let mesh = AnnulusMesh::generate(&annulus(Quad4, 90, 18)).unwrap().mesh;
    let damping = rayleigh_damping(ALPHA, BETA);
    let system = FrfSystem::body(&mesh, &POLYCARBONATE, Consistent, damping, false);
    let rim = Terminal { node: 18, direction: Direction::Radial };
    let port = system.port(&mesh, None, rim, "force_node").unwrap();
    let f: Vec<f64> = (1..=(1e4 / step_hz) as usize).map(|i| i as f64 * step_hz).collect();
    let found = reduced_response(&system, &port, &port, &f).unwrap();
    let accelerance = f.iter().zip(&found.receptance).map(|(f, h)| -h * (TAU * f).powi(2));
    (f.clone(), accelerance.collect())
}

fn poles(response: &FrequencyResponse) -> Result<Identification, SignalError> {
    identify(std::slice::from_ref(response), None)
}

fn measured(f: &[f64], h: Vec<c64>) -> FrequencyResponse {
    FrequencyResponse::new(f.to_vec(), h, ResponseQuantity::Accelerance).unwrap()
}

fn identified(f: &[f64], h: Vec<c64>) -> Identification {
    poles(&measured(f, h)).unwrap()
}

#[test]
fn free_disc_with_one_percent_noise_gives_back_its_coefficients_at_1_hz() {
    let (f, h) = free_disc(1.0);
    let found = identified(&f, noisy(&h, 0.01, 1));
    let (alpha, beta) = (found.rayleigh.mass_coefficient, found.rayleigh.stiffness_coefficient);
    assert!((alpha.value / ALPHA - 1.0).abs() < 0.1, "{alpha:?}");
    assert!((beta.value / BETA - 1.0).abs() < 0.03, "{beta:?}");
    // The tails of neighbours spoil the half-power factors, not those of the fit.
    for mode in found.fit.modes.iter().filter(|m| m.is_used()) {
        let omega = TAU * mode.frequency_hz.value;
        let exact = 0.5 * (ALPHA / omega + BETA * omega);
        let miss = (mode.damping_factor.value - exact).abs();
        // Five standard errors, which one mode in two million exceeds by chance.
        assert!(miss < 5.0 * mode.standard_error, "{mode:?} {exact}");
    }
    assert!((found.fit.noise[0].relative / 0.01 - 1.0).abs() < 0.05);
    assert!(found.fit.modes.len() >= 6);
    // Noise that does not depend on the response makes no modes where the response falls below it.
    let mean = h.iter().map(|h| h.norm()).sum::<f64>() / h.len() as f64;
    let mut noise = GaussianNoise::new(2);
    let flooded = h.iter().map(|h| h + noise.draw() * (3e-3 * mean)).collect();
    let [clean, flooded] = [h.clone(), flooded].map(|h| identified(&f, h).fit.modes.len());
    assert!((6..=clean).contains(&flooded), "{flooded} modes, {clean} without noise");
}

#[test]
fn over_noise_seeds_the_errors_are_as_large_as_stated_and_the_intervals_hold_the_truth() {
    // Ten seeds bound the mean by four of its standard errors, 0.32, and the deviation by four of 0.22.
    let (seeds, mean_bound, deviations) = sized((10, 1.3, 0.3..1.9), (100, 0.4, 0.7..1.3));
    let (covered, near) = sized((8, 9), (90, 95));
    // Four lines where the hammer test has sixteen: the intervals are wider, the claim is the same.
    let (f, h) = free_disc(4.0);
    let found: Vec<Identification> =
        (1..=seeds).into_par_iter().map(|seed| identified(&f, noisy(&h, 0.01, seed))).collect();
    let share = |holds: &dyn Fn(&Identification) -> bool| found.iter().filter(|r| holds(r)).count();
    let holds = |e: Estimate, truth: f64| e.low <= truth && truth <= e.high;
    let alpha = share(&|r| holds(r.rayleigh.mass_coefficient, ALPHA));
    let beta = share(&|r| holds(r.rayleigh.stiffness_coefficient, BETA));
    let near_alpha = share(&|r| (r.rayleigh.mass_coefficient.value / ALPHA - 1.0).abs() < 0.1);
    let near_beta = share(&|r| (r.rayleigh.stiffness_coefficient.value / BETA - 1.0).abs() < 0.03);
    assert!(alpha >= covered && beta >= covered, "{alpha} {beta}");
    assert!(near_alpha >= near && near_beta >= near, "{near_alpha} {near_beta}");
    // The same mode by mode. Of 100 independent pulls the mean is known to 0.1 and the standard deviation to 0.07: four of those.
    // Correlated noise would move the mean (the same error 100 times) and shrink the deviation.
    let modes = found[0].fit.modes.len();
    assert!(found.iter().all(|r| r.fit.modes.len() == modes));
    for k in 0..modes {
        let pulls = found.iter().map(|r| {
            let fitted = r.fit.modes[k];
            let omega = TAU * fitted.frequency_hz.value;
            let (own, exact) = (fitted.damping_factor, 0.5 * (ALPHA / omega + BETA * omega));
            // Distance from the truth in standard errors, from the 95 % interval.
            1.96 * (own.value - exact) / (0.5 * (own.high - own.low))
        });
        let (mean, deviation) = moments(&pulls.collect::<Vec<_>>());
        assert!(mean.abs() < mean_bound, "mode {k}: {mean}");
        assert!(deviations.contains(&deviation), "mode {k}: {deviation}");
    }
}

/// Accelerance of a free body: rigid motion and modes `(frequency, damping factor, residue)`.
fn modal_sum(modes: &[(f64, f64, f64)], step: f64, highest: f64) -> (Vec<f64>, Vec<c64>) {
    let f: Vec<f64> = (1..=(highest / step) as usize).map(|i| i as f64 * step).collect();
    let at = |f: &f64| {
        let s = c64::new(0.0, TAU * f);
        let elastic = modes.iter().map(|(f, zeta, r)| {
            let w = TAU * f;
            *r / (s * s + s * (2.0 * zeta * w) + w * w)
        });
        s * s * (1.0 / (s * s) + elastic.sum::<c64>())
    };
    let h = f.iter().map(at).collect();
    (f, h)
}

const SEPARATE: [(f64, f64, f64); 4] =
    [(900.0, 0.006, 1.2), (1800.0, 0.005, 0.8), (3100.0, 0.006, 1.5), (4300.0, 0.0075, 1.0)];

#[test]
fn a_close_pair_under_one_peak_is_found_as_two_and_flagged() {
    let (f, h) = modal_sum(&[&SEPARATE[..], &[(3125.0, 0.0062, 0.7)]].concat(), 1.0, 5000.0);
    let found = identified(&f, noisy(&h, 0.005, 3));
    assert_eq!(found.fit.modes.len(), 5);
    for (index, frequency, zeta) in [(2, 3100.0, 0.006), (3, 3125.0, 0.0062)] {
        let fitted = found.fit.modes[index];
        assert!((fitted.frequency_hz.value - frequency).abs() < 1.0, "{fitted:?}");
        // Two modes a bandwidth apart share their information: 5 % is three standard errors.
        assert!((fitted.damping_factor.value / zeta - 1.0).abs() < 0.05, "{fitted:?}");
        assert!(fitted.overlaps_hz.is_some());
    }
    let mut notes = found.fit.modes.iter().filter_map(|mode| mode.half_power?.note);
    assert!(notes.any(|note| matches!(note, ResonanceNote::Overlaps(_))));
}

#[test]
fn a_response_without_phase_gives_the_same_damping() {
    let (f, h) = modal_sum(&SEPARATE, 1.0, 5000.0);
    let moduli = noisy(&h, 0.005, 5).iter().map(|z| c64::new(z.norm(), 0.0)).collect();
    let response =
        FrequencyResponse::measured(f, moduli, ResponseQuantity::Accelerance, false).unwrap();
    let found = poles(&response).unwrap();
    assert_eq!(found.fit.modes.len(), 4);
    for (mode, (frequency, zeta, _)) in found.fit.modes.iter().zip(SEPARATE) {
        assert!((mode.frequency_hz.value / frequency - 1.0).abs() < 1e-3);
        // 0.5 % noise over some ten lines of each band.
        assert!((mode.damping_factor.value / zeta - 1.0).abs() < 0.02, "{mode:?}");
    }
}

#[test]
fn identification_does_not_depend_on_the_quantity_measured() {
    let (f, h) = modal_sum(&SEPARATE, 1.0, 5000.0);
    let response = measured(&f, noisy(&h, 0.01, 9));
    let want = poles(&response).unwrap();
    for quantity in [ResponseQuantity::Mobility, ResponseQuantity::Receptance] {
        let got = poles(&response.converted(quantity).unwrap()).unwrap();
        for (a, b) in got.fit.modes.iter().zip(&want.fit.modes) {
            let miss = a.damping_factor.value - b.damping_factor.value;
            // Same data, same relative noise; the additive part of the noise model may differ.
            assert!(miss.abs() < b.standard_error, "{a:?} {b:?}");
        }
    }
}

#[test]
fn two_responses_of_one_body_have_common_poles_with_smaller_errors() {
    let (f, first) = modal_sum(&SEPARATE, 1.0, 5000.0);
    let others = SEPARATE.map(|(f, zeta, r)| (f, zeta, if f < 2000.0 { -r } else { r }));
    let (_, second) = modal_sum(&others, 1.0, 5000.0);
    let response = |h: &[c64], seed| measured(&f, noisy(h, 0.01, seed));
    let both = [response(&first, 11), response(&second, 12)];
    let alone = identify(&both[..1], None).unwrap();
    let joint = identify(&both, None).unwrap();
    assert_eq!(joint.fit.modes.len(), 4);
    let pairs = joint.fit.modes.iter().zip(&alone.fit.modes);
    for ((a, b), (frequency, zeta, _)) in pairs.zip(SEPARATE) {
        assert!((a.damping_factor.value - zeta).abs() < 5.0 * a.standard_error, "{a:?}");
        assert!((a.frequency_hz.value / frequency - 1.0).abs() < 1e-4);
        // Twice the data: 0.707 of the error; the noise of each is known to a few per cent.
        let ratio = a.standard_error / b.standard_error;
        assert!((0.65..0.77).contains(&ratio), "{ratio}");
    }
}

#[test]
fn coarse_lines_and_flat_noise_are_refused_with_the_reason() {
    let (f, h) = modal_sum(&SEPARATE, 24.0, 5000.0);
    let error = poles(&measured(&f, h)).unwrap_err();
    assert!(matches!(error, SignalError::Unresolved { .. }), "{error}");
    let f: Vec<f64> = (1..2000).map(f64::from).collect();
    let flat = noisy(&vec![c64::new(1.0, 0.0); f.len()], 0.02, 1);
    let error = poles(&measured(&f, flat)).unwrap_err();
    assert!(matches!(error, SignalError::NoResonance { .. }), "{error}");
}

#[test]
fn the_command_prints_both_estimators_and_a_block_that_parses() {
    let folder = folder();
    let table = folder.path().join("hammer.csv");
    let (f, h) = modal_sum(&SEPARATE, 1.0, 5000.0);
    let row = |(f, h): (&f64, c64)| format!("{f};{};{}\r\n", h.re, h.im).replace('.', ",");
    let rows: String = f.iter().zip(noisy(&h, 0.01, 2)).map(row).collect();
    fs::write(&table, format!("Frequency [Hz];Real;Imag\r\n{rows}")).unwrap();
    let run = |own: &[&str]| Run::new(&["identify", "hammer.csv"]).within(&folder).args(own).done();
    let summary = run(&["--json", "--quiet"]).value();
    for key in ["mass_coefficient", "stiffness_coefficient"] {
        let part = |name: &str| summary[key][name].as_f64().unwrap();
        assert!(part("low") <= part("value") && part("value") <= part("high"));
    }
    assert_eq!(summary["modes"].as_array().unwrap().len(), 4);
    assert!(summary["modes"][0]["frequency_hz"].is_f64());
    assert!(summary["modes"][0]["damping_factor"].is_f64());
    let results = folder.path().join("results/hammer/identify");
    let block = fs::read_to_string(results.join("damping.toml")).unwrap();
    let parsed: toml::Table = block.parse().unwrap();
    assert!(parsed["damping"]["mass_coefficient"].is_float());
    assert!(results.join("figures/identification.png").exists());
    run(&[]).says(&["half-power", "[damping]"]);
    // Two modes half a bandwidth apart: by magnitudes they are one, of another damping than Rayleigh's.
    let pair = [(2000.0, 0.005, 1.0), (2005.0, 0.006, 1.3)];
    let (f, h) = modal_sum(&[&SEPARATE[..1], &pair, &SEPARATE[3..]].concat(), 1.0, 5000.0);
    let row = |(f, h): (&f64, c64)| format!("{f},{}\n", h.norm());
    let rows: String = f.iter().zip(noisy(&h, 0.005, 2)).map(row).collect();
    fs::write(&table, format!("f,mag\n{rows}")).unwrap();
    run(&["--force"]).says(&["two modes under one peak, too, which magnitudes alone do not part"]);
}

#[test]
fn a_bad_table_ends_the_command_with_code_2_and_the_place() {
    let folder = folder_with(&[("bad.csv", b"frequency_hz,real,imag\n1,2,3\n2,nan,3\n")]);
    Run::new(&["identify", "bad.csv"]).within(&folder).refused(&["bad.csv:3:3: `nan`"]);
}
