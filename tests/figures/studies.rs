//! Figures of sweeps, identification and convergence.

use crate::check;
use frictionsim::results::figures::*;
use frictionsim::results::sweep::PointRecord;
use frictionsim::results::sweep_figures::draw_sweep;
use serde_json::{Value, json};

fn sweep() -> SpeedSweep {
    let speeds: Vec<f64> = (0..24)
        .map(|i| 10.0 * 600f64.powf(f64::from(i) / 23.0))
        .collect();
    let series = [0.2, 0.3, 0.4]
        .iter()
        .map(|&friction| {
            let ramp = |speed: f64| ((speed / 60.0).ln() / 4.6).clamp(0.0, 1.0);
            let open: Vec<f64> = speeds.iter().map(|&v| friction * 1.3 * ramp(v)).collect();
            let stick: Vec<f64> = speeds.iter().map(|&v| 0.4 * (1.0 - ramp(v))).collect();
            SpeedSeries {
                friction_coefficient: friction,
                main_frequency_hz: speeds
                    .iter()
                    .enumerate()
                    .map(|(i, &v)| match i {
                        11 => f64::NAN,
                        _ if v < 100.0 => 10_530.0 + 600.0 * (friction - 0.3),
                        _ => 9_900.0 - 3_000.0 * friction * ramp(v),
                    })
                    .collect(),
                slip: open.iter().zip(&stick).map(|(a, b)| 1.0 - a - b).collect(),
                speeds_rpm: speeds.clone(),
                stick,
                open,
            }
        })
        .collect();
    SpeedSweep {
        series,
        references: [(9901.0, "mode 5"), (10_525.0, "mode 7")]
            .map(|(frequency_hz, label)| ReferenceFrequency {
                frequency_hz,
                label: label.into(),
            })
            .to_vec(),
    }
}

#[test]
fn sweep_draws_main_frequency_for_each_friction_value() {
    let svg = draw_speed_frequencies(&sweep()).unwrap();
    check(
        "sweep-frequencies",
        &svg,
        &[
            "rotation speed Ω (rpm)",
            "main frequency f (kHz)",
            "μ = 0.40",
            "10.53 kHz, mode 7",
        ],
    );
}

#[test]
fn sweep_draws_the_shares_of_each_contact_status() {
    let svg = draw_speed_status(&sweep()).unwrap();
    check(
        "sweep-status",
        &svg,
        &[
            "contact nodes (%)",
            "rotation speed Ω (rpm)",
            "stick",
            "slip",
            "open",
            "μ = 0.20",
        ],
    );
}

#[test]
fn identification_shows_response_and_fitted_damping() {
    let resonances: Vec<Resonance> = [1150.0, 2480.0, 3900.0, 5210.0, 6830.0, 8400.0, 9500.0]
        .iter()
        .map(|&frequency_hz: &f64| {
            let omega = std::f64::consts::TAU * frequency_hz;
            let scatter = 1.0 + 0.06 * (frequency_hz * 0.7).sin();
            let damping_factor = 0.5 * (40.0 / omega + 4.5e-7 * omega) * scatter;
            Resonance {
                frequency_hz,
                half_power_hz: (
                    frequency_hz * (1.0 - damping_factor),
                    frequency_hz * (1.0 + damping_factor),
                ),
                damping_factor,
            }
        })
        .collect();
    let frequencies: Vec<f64> = (0..4000).map(|i| 100.0 + 2.5 * f64::from(i)).collect();
    let magnitude: Vec<f64> = frequencies
        .iter()
        .map(|f| {
            let (mut re, mut im) = (0.0, 0.0);
            for r in &resonances {
                let ratio = f / r.frequency_hz;
                let (a, b) = (1.0 - ratio * ratio, 2.0 * r.damping_factor * ratio);
                re += 30.0 * ratio * ratio * a / (a * a + b * b);
                im -= 30.0 * ratio * ratio * b / (a * a + b * b);
            }
            re.hypot(im)
        })
        .collect();
    let svg = draw_damping_identification(&DampingIdentification {
        frequencies_hz: &frequencies,
        magnitude: &magnitude,
        magnitude_unit: "m/s²/N".into(),
        resonances,
        mass_coefficient: 40.3,
        stiffness_coefficient: 4.47e-7,
        mass_interval: (36.1, 44.5),
        stiffness_interval: (4.3e-7, 4.65e-7),
    })
    .unwrap();
    check(
        "identification",
        &svg,
        &[
            "|H| (m/s²/N)",
            "damping factor ζ (%)",
            "half-power points",
            "αR = 40.3",
        ],
    );
}

#[test]
fn convergence_names_the_observed_slope() {
    let sizes = vec![2.0, 1.0, 0.5, 0.25];
    let series = [
        ("frequency, mode 1", 2.0, 3e-3),
        ("contact pressure", 1.0, 2e-2),
    ]
    .iter()
    .map(|&(name, order, factor)| ConvergenceSeries {
        name: name.into(),
        sizes: sizes.clone(),
        errors: sizes.iter().map(|h: &f64| factor * h.powf(order)).collect(),
    })
    .collect();
    let svg = draw_convergence(&ConvergenceStudy {
        size_title: "element size *h* (mm)".into(),
        error_title: "relative error (–)".into(),
        series,
    })
    .unwrap();
    check(
        "convergence",
        &svg,
        &[
            "element size h (mm)",
            "relative error (–)",
            "frequency, mode 1, slope 2.00",
        ],
    );
}

#[test]
fn spectrum_names_the_modes_above_its_peaks() {
    let frequencies: Vec<f64> = (0..2000).map(|i| 20.0 * f64::from(i)).collect();
    let amplitude: Vec<f64> = frequencies
        .iter()
        .map(|f| {
            (1..=3)
                .map(|k| {
                    3e4 / f64::from(k * k) / (1.0 + ((f - 9600.0 * f64::from(k)) / 40.0).powi(2))
                })
                .sum()
        })
        .collect();
    let references = [(7660.0, "mode 3"), (9901.0, "mode 5"), (10_525.0, "mode 7")]
        .map(|(frequency_hz, label)| ReferenceFrequency {
            frequency_hz,
            label: label.into(),
        })
        .to_vec();
    let svg = draw_spectrum(&SpectrumPlot {
        signal_name: "radial acceleration, node 1641".into(),
        unit: "m/s²".into(),
        frequencies_hz: &frequencies,
        amplitude: &amplitude,
        max_frequency_hz: 32e3,
        references,
    })
    .unwrap();
    check(
        "spectrum",
        &svg,
        &[
            "frequency f (kHz)",
            "amplitude (m/s²)",
            "mode 5",
            "node 1641",
        ],
    );
}

fn point(number: usize, swept: Value, summaries: Value) -> PointRecord {
    let object = |value: Value| value.as_object().cloned().unwrap_or_default();
    PointRecord {
        point: number,
        swept: object(swept),
        error: None,
        summaries: object(summaries),
        case_hash: String::new(),
        sweep_hash: String::new(),
        version: String::new(),
        simd: String::new(),
    }
}

#[test]
fn points_of_a_study_become_frequency_and_status_over_speed() {
    let grid = [0.2, 0.4]
        .iter()
        .flat_map(|mu| [10.0, 100.0, 1000.0].map(|rpm| (*mu, rpm)));
    let records: Vec<PointRecord> = grid
        .enumerate()
        .map(|(index, (mu, rpm))| {
            point(
                index + 1,
                json!({ "contact.friction_coefficient": mu, "contact.rotation_speed_rpm": rpm }),
                json!({ "transient": {
                    "main_frequency_hz": 10_000.0 - rpm * mu,
                    "status": { "stick": 0.4, "slip": 0.6 - 2e-4 * rpm, "open": 2e-4 * rpm },
                }}),
            )
        })
        .collect();
    let figures = draw_sweep(&records, 0.3, 1.0, &[]).unwrap();
    let names: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["frequencies", "status"]);
    check(
        "study-frequency",
        &figures[0].svg,
        &["μ = 0.20", "μ = 0.40"],
    );
    check("study-status", &figures[1].svg, &["contact nodes (%)"]);
}

#[test]
fn eigenvalue_analyses_over_one_key_become_a_critical_friction_line_for_each_branch() {
    let records: Vec<PointRecord> = (0..8)
        .map(|i| {
            let damping = 1e-7 * 1.8f64.powi(i);
            let entry = |harmonic: usize, factor: f64| {
                json!({ "harmonic": harmonic, "branch": 0, "direction": -1,
                        "critical_friction": factor * (damping * 1e7).sqrt() })
            };
            let mut found = vec![entry(1, 0.06)];
            if i < 5 {
                found.push(entry(2, 0.1));
            }
            point(
                i as usize + 1,
                json!({ "damping.stiffness_coefficient": damping }),
                json!({ "cea": { "critical_frictions": found } }),
            )
        })
        .collect();
    let figures = draw_sweep(&records, 0.3, 1.0, &[]).unwrap();
    assert_eq!(figures.len(), 1);
    check(
        "critical-friction",
        &figures[0].svg,
        &[
            "stiffness damping βR (s)",
            "n = 2, branch 0",
            "stable",
            "μ (–)",
        ],
    );
}
