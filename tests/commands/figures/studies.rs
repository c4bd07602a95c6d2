//! Figures of parameter studies, from their points.

use crate::figures::{check, texts};
use crate::prelude::*;
use frictionsim::results::charts::ModeLine;
use frictionsim::results::sweep::{PointRecord, draw_sweep};

fn point(point: usize, swept: Value, summaries: Value) -> PointRecord {
    let [swept, summaries] = [swept, summaries].map(|value| value.as_object().unwrap().clone());
    PointRecord { point, swept, summaries, ..PointRecord::default() }
}

/// A transient whose wave has one nodal diameter up to some speed and two beyond, and sticks up to another.
fn transient(value: f64, change: f64) -> Value {
    let (stick, open) = ((0.4 - 0.4 * value / 500.0).max(0.0), 2e-4 * value);
    json!({ "transient": {
        "main_frequency_hz": if value < change { 10_500.0 } else { 9_700.0 - 0.1 * value },
        "main_harmonic": if value < change { 1 } else { 2 },
        "status": { "stick": stick, "slip": 1.0 - stick - open, "open": open },
    }})
}

#[test]
fn points_over_speed_show_harmonics_selection_and_end_of_stick() {
    let speeds = [10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0];
    let grid = [0.2, 0.4].iter().flat_map(|mu| speeds.map(|rpm| (*mu, rpm)));
    let records = grid.enumerate().map(|(index, (mu, rpm))| {
        let swept =
            json!({ "contact.friction_coefficient": mu, "contact.rotation_speed_rpm": rpm });
        point(index + 1, swept, transient(rpm, 100.0))
    });
    let modes = [(9901.0, "mode 5, *n* = 2"), (7660.0, "mode 3, *n* = 1")];
    let modes = modes.map(|(frequency_hz, label)| ModeLine { frequency_hz, label: label.into() });
    let figures = draw_sweep(&records.collect::<Vec<_>>(), 0.3, &modes);
    assert!(figures.iter().map(|f| f.name.as_str()).eq(["frequencies", "status"]));
    let words = "μ = 0.2 ; n = 1 ; n = 2 ; ω*, μ = 0.4 ; 9.90 kHz, mode 5 ; at μ = 0.3 ; \
                 rotation speed Ω (rpm)";
    let [frequency, status] = [0, 1].map(|k: usize| figures[k].to_svg(None).unwrap());
    check("study-frequency", &frequency, &[words]);
    // A mode that is far from every frequency found takes no room.
    assert!(!frequency.contains("7.66 kHz"));
    check("study-status", &status, &["contact nodes (%) ; ω+: no stick ; stick ; slip ; open"]);
}

#[test]
fn points_over_any_key_have_frequencies_and_status_too() {
    let records = (1..5).map(|i| {
        let delta = 1e-5 * f64::from(i);
        point(i as usize, json!({ "contact.interference": delta }), transient(delta, 2.5e-5))
    });
    let figures = draw_sweep(&records.collect::<Vec<_>>(), 0.3, &[]);
    assert_eq!(figures.len(), 2);
    let words = "interference δ ; main frequency f (kHz)";
    check("study-interference", &figures[0].to_svg(None).unwrap(), &[words]);
    for (key, axis) in [
        ("boundaries.back.normal_stiffness", "normal stiffness kn, back (Pa/m)"),
        ("boundaries.back.loss_factor", "loss factor η, back"),
        ("contacts.pad.normal_force", "normal force N, pad (N)"),
    ] {
        let points = [1.0, 2.0].map(|value| point(1, json!({ key: value }), transient(value, 9.0)));
        check("study-names", &draw_sweep(&points, 0.3, &[])[0].to_svg(None).unwrap(), &[axis]);
    }
}

#[test]
fn eigenvalue_analyses_over_one_key_become_a_critical_friction_line_for_each_branch() {
    // Nothing is known to be stable where a branch grows from the first friction value on.
    for lowest in [0.06, 0.0] {
        let records = (0..8).map(|i| {
            let damping = 1e-7 * 1.8f64.powi(i);
            let entry = |harmonic: usize, factor: f64| {
                json!({ "harmonic": harmonic, "branch": 0, "direction": -1, "unstable_from_start": factor == 0.0,
                        "critical_friction": factor * (damping * 1e7).sqrt() })
            };
            let found = &[entry(1, lowest), entry(2, 0.1)][..if i < 5 { 2 } else { 1 }];
            let swept = json!({ "damping.stiffness_coefficient": damping });
            point(i as usize + 1, swept, json!({ "cea": { "critical_frictions": found } }))
        });
        let figures = draw_sweep(&records.collect::<Vec<_>>(), 0.3, &[]);
        assert_eq!(figures.len(), 1);
        let svg = figures[0].to_svg(None).unwrap();
        check("critical-friction", &svg, &["stiffness damping βR (µs) ; n = 2, branch 0 ; μ (–)"]);
        let has = |words: &str| texts(&svg).iter().any(|line| line.contains(words));
        assert_eq!(["n = 1, branch 0", "stable"].map(has), [lowest > 0.0; 2]);
    }
}
