//! Figures of limit cycles, of their branches, and of frequency responses.

use crate::check;
use faer::c64;
use frictionsim::contact::ContactStatus;
use frictionsim::results::figures::*;
use std::f64::consts::TAU;

/// A contact node that sticks for half its period, slips, and is open.
struct Node {
    status: Vec<ContactStatus>,
    displacement: [Vec<f64>; 2],
    velocity: [Vec<f64>; 2],
    pressure: Vec<f64>,
}

fn node() -> Node {
    let phases: Vec<f64> = (0..135).map(|i| TAU * f64::from(i) / 135.0).collect();
    let of = |function: &dyn Fn(f64) -> f64| phases.iter().map(|&xi| function(xi)).collect();
    let status = phases.iter().map(|xi| match xi.sin() {
        s if s < -0.3 => ContactStatus::Open,
        s if s < 0.3 => ContactStatus::Slip,
        _ => ContactStatus::Stick,
    });
    Node {
        status: status.collect(),
        displacement: [
            of(&|xi| 25e-6 + 1e-5 * (-xi.sin() - 0.3).max(0.0)),
            of(&|xi| -2e-5 * xi.cos()),
        ],
        velocity: [of(&|xi| -0.6 * xi.cos()), of(&|xi| 1.2 * xi.sin())],
        pressure: of(&|xi| 6e6 * (xi.sin() + 0.3).max(0.0)),
    }
}

fn cycle(node: &Node) -> NodeCycle<'_> {
    let [u_r, u_t] = &node.displacement;
    let [v_r, v_t] = &node.velocity;
    NodeCycle {
        period: 1e-4,
        status: &node.status,
        displacement: [u_r, u_t],
        velocity: [v_r, v_t],
        pressure: &node.pressure,
        shear: &node.pressure,
        friction_coefficient: 0.3,
        peripheral_speed: 1.3,
    }
}

#[test]
fn history_of_a_contact_node_shows_two_periods_over_its_status() {
    let node = node();
    let svg = draw_node_cycle(&cycle(&node)).unwrap();
    let expected = [
        "time t (µs)",
        "200",
        "tangential displacement",
        "cylinder Ωa",
        "Coulomb limit ±μp",
        "traction (MPa)",
        "stick",
        "open",
    ];
    check("node-cycle", &svg, &expected);
    let mut short = cycle(&node);
    short.pressure = &node.pressure[1..];
    assert!(matches!(
        draw_node_cycle(&short),
        Err(FigureError::Shape { .. })
    ));
}

#[test]
fn orbit_of_a_contact_node_shows_phase_plots_and_path() {
    let node = node();
    let svg = draw_node_orbit(&cycle(&node)).unwrap();
    let expected = [
        "velocity vθ (m/s)",
        "velocity vr (mm/s)",
        "displacement ur (µm)",
        "path",
        "slip",
        "cylinder Ωa",
    ];
    check("node-orbit", &svg, &expected);
}

/// A branch that turns back twice, unstable in between.
fn folded(name: &str) -> BranchCurve {
    let values: Vec<f64> = [0.1, 0.2, 0.3, 0.4, 0.4, 0.3, 0.2, 0.2, 0.3, 0.5, 0.8].to_vec();
    let count = values.len();
    let along: Vec<f64> = (0..count).map(|i| i as f64 / count as f64).collect();
    let of = |function: &dyn Fn(f64) -> f64| along.iter().map(|&s| function(s)).collect();
    BranchCurve {
        name: name.into(),
        frequency_hz: of(&|s| 1e4 - 600.0 * s),
        amplitude: of(&|s| 1e-5 * s),
        status: [
            of(&|s| 0.4 - 0.3 * s),
            of(&|s| 0.6 - 0.2 * s),
            of(&|s| 0.5 * s),
        ],
        shares: [
            of(&|s| 0.4 + 0.1 * s),
            of(&|s| 0.2 * s - 0.3),
            of(&|s| 0.9 - 0.3 * s),
            of(&|s| 0.1 + 0.3 * s),
            of(&|_| -0.01),
        ],
        stability: (0..count)
            .map(|i| match i {
                0..4 => Stability::Stable,
                4..7 => Stability::Unstable,
                _ => Stability::Unknown,
            })
            .collect(),
        folds: vec![0.44, 0.17],
        marked: Some([0.3, 9700.0, 4e-6]),
        values,
    }
}

fn branches() -> BranchCurves {
    let mut second = folded("*n* = 2");
    second.frequency_hz.iter_mut().for_each(|f| *f *= 0.95);
    BranchCurves {
        parameter_title: "friction coefficient *μ* (–)".into(),
        curves: vec![folded("*n* = 1"), second],
        references: vec![ReferenceFrequency {
            frequency_hz: 10_100.0,
            label: "*n* = 1 at *μ* = 0.100".into(),
        }],
    }
}

#[test]
fn branches_show_families_folds_stability_and_onsets() {
    let svg = draw_branch_frequencies(&branches()).unwrap();
    let expected = [
        "friction coefficient μ (–)",
        "main frequency f (kHz)",
        "amplitude of uθ (µm)",
        "n = 2",
        "stable",
        "unstable",
        "fold",
        "the case's own cycle",
        "10.10 kHz, n = 1 at μ = 0.100",
    ];
    check("branch-frequencies", &svg, &expected);
}

#[test]
fn branches_of_unknown_stability_are_plain_curves_without_a_word_on_it() {
    let mut data = branches();
    for curve in &mut data.curves {
        curve.stability.fill(Stability::Unknown);
        curve.folds.clear();
    }
    let svg = draw_branch_frequencies(&data).unwrap();
    assert!(!svg.contains("stable<") && !svg.contains("fold<"));
}

#[test]
fn branches_show_status_and_power_shares_of_each_family() {
    let svg = draw_branch_shares(&branches()).unwrap();
    let expected = [
        "friction coefficient μ (–)",
        "contact nodes (%)",
        "share of external power (%)",
        "dissipated in the contact",
        "normal contact",
        "open",
        "n = 1",
        "fold",
    ];
    check("branch-shares", &svg, &expected);
}

#[test]
fn branches_of_a_single_cycle_are_no_curves() {
    let single = BranchCurves {
        curves: vec![BranchCurve {
            values: vec![1.0],
            frequency_hz: vec![1.0],
            amplitude: vec![1.0],
            status: [0; 3].map(|_| vec![0.5]),
            shares: [0; 5].map(|_| vec![0.5]),
            stability: vec![Stability::Unknown],
            ..BranchCurve::default()
        }],
        ..branches()
    };
    assert!(matches!(
        draw_branch_shares(&single),
        Err(FigureError::Empty { .. })
    ));
}

#[test]
fn frequency_response_shows_magnitude_and_phase() {
    let frequencies: Vec<f64> = (1..2000).map(|i| 5.0 * f64::from(i)).collect();
    let values: Vec<c64> = frequencies
        .iter()
        .map(|f| c64::new(-f * f, 0.0) / c64::new(5000.0 * 5000.0 - f * f, 100.0 * f))
        .collect();
    let svg = draw_response(&ResponsePlot {
        frequencies_hz: &frequencies,
        values: &values,
        unit: "m/s²/N".into(),
    })
    .unwrap();
    let expected = ["frequency f (kHz)", "|H| (m/s²/N)", "phase (°)", "−180"];
    check("response", &svg, &expected);
}
