//! Figures of parameter studies, from their points.

use crate::figures::check;
use crate::prelude::*;
use frictionsim::results::charts::ModeLine;
use frictionsim::results::sweep::{PointRecord, draw_sweep};

fn point(point: usize, swept: Value, summaries: Value) -> PointRecord {
    let objects = [swept, summaries].map(|value| value.as_object().cloned().unwrap_or_default());
    let [swept, summaries] = objects;
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
    let figures = draw_sweep(&records.collect::<Vec<_>>(), (0.3, 1.0), &modes);
    let names: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(names, ["frequencies", "status"]);
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
        let interference = 1e-5 * f64::from(i);
        let swept = json!({ "contact.interference": interference });
        point(i as usize, swept, transient(interference, 2.5e-5))
    });
    let figures = draw_sweep(&records.collect::<Vec<_>>(), (0.3, 1.0), &[]);
    assert_eq!(figures.len(), 2);
    let svg = figures[0].to_svg(None).unwrap();
    check("study-interference", &svg, &["interference δ ; main frequency f (kHz)"]);
}

#[test]
fn eigenvalue_analyses_over_one_key_become_a_critical_friction_line_for_each_branch() {
    let records = (0..8).map(|i| {
        let damping = 1e-7 * 1.8f64.powi(i);
        let entry = |harmonic: usize, factor: f64| {
            json!({ "harmonic": harmonic, "branch": 0, "direction": -1, "unstable_from_start": false,
                    "critical_friction": factor * (damping * 1e7).sqrt() })
        };
        let mut found = vec![entry(1, 0.06), entry(2, 0.1)];
        found.truncate(if i < 5 { 2 } else { 1 });
        let swept = json!({ "damping.stiffness_coefficient": damping });
        point(i as usize + 1, swept, json!({ "cea": { "critical_frictions": found } }))
    });
    let figures = draw_sweep(&records.collect::<Vec<_>>(), (0.3, 1.0), &[]);
    assert_eq!(figures.len(), 1);
    let words = "stiffness damping βR (µs) ; n = 2, branch 0 ; stable ; μ (–)";
    check("critical-friction", &figures[0].to_svg(None).unwrap(), &[words]);
}
