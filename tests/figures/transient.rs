//! Figures of a run.

use crate::{check, synthetic};
use frictionsim::contact::ContactStatus;
use frictionsim::results::figures::*;

fn references() -> Vec<ReferenceFrequency> {
    synthetic::modes(0.3, None)
        .iter()
        .enumerate()
        .filter(|(index, mode)| *index == 0 || mode.is_unstable())
        .map(|(index, mode)| ReferenceFrequency {
            frequency_hz: mode.frequency_hz(),
            label: format!("mode {}", index + 1),
        })
        .collect()
}

#[test]
fn overview_shows_signal_spectrograms_and_contact_status_on_one_time_axis() {
    let run = synthetic::run(25_000, 180);
    let (centres, frequencies, amplitude) = synthetic::spectrogram(&run, 35e3);
    let stages = [("A", 0.0), ("B", 0.0085), ("C", 0.0165), ("D", 0.023)]
        .map(|(name, start)| Stage {
            name: name.into(),
            start,
        })
        .to_vec();
    let data = TransientOverview {
        signal_name: "radial acceleration, node 1641".into(),
        signal_unit: "m/s²".into(),
        times: &run.times,
        signal: &run.acceleration,
        spectrogram: Some(SpectrogramMap {
            times: &centres,
            frequencies_hz: &frequencies,
            amplitude: &amplitude,
        }),
        max_frequency_hz: 32e3,
        references: references(),
        status: Some(StatusHistory {
            times: &run.times,
            node_count: run.node_count,
            status: &run.status,
        }),
        stages,
        enlarged: 4.0 / 9600.0,
    };
    let started = std::time::Instant::now();
    let svg = draw_transient_overview(&data).unwrap();
    println!("overview drawn in {:?}", started.elapsed());
    check(
        "transient-overview",
        &svg,
        &[
            "time t (ms)",
            "a (m/s²)",
            "frequency f (kHz)",
            "angle θ (°)",
            "level (dB)",
            "stick",
            "slip",
            "open",
            "mode 5",
            "D",
        ],
    );
    assert_eq!(svg, draw_transient_overview(&data).unwrap());
}

#[test]
fn overview_without_status_or_spectrogram_is_the_signal_alone() {
    let run = synthetic::run(2_000, 12);
    let svg = draw_transient_overview(&TransientOverview {
        signal_name: "measured signal".into(),
        signal_unit: "V".into(),
        times: &run.times,
        signal: &run.acceleration,
        spectrogram: None,
        max_frequency_hz: 20e3,
        references: Vec::new(),
        status: None,
        stages: Vec::new(),
        enlarged: 0.0,
    })
    .unwrap();
    check("signal-alone", &svg, &["time t (ms)", "signal (kV)"]);
}

#[test]
fn growth_of_harmonics_carries_the_predicted_rate() {
    let times: Vec<f64> = (0..25_000).map(|i| f64::from(i) * 2e-6).collect();
    let all: Vec<(usize, Vec<f64>)> = (0..=8)
        .map(|n| {
            let values = times
                .iter()
                .map(|&t| {
                    let s = synthetic::saturation(t);
                    let ripple = 1.0 + 0.1 * (1.2e5 * t).sin();
                    match n {
                        0 => 3e-6 * (-325.0 * t).exp() + 4e-7 * s * s,
                        1 => 1e-14 * (1200.0 * t).exp().min(1e5) + 1e-14 * s,
                        n if n % 2 == 0 => 1.5e-5 * s.powi(n / 2) * ripple + 1e-15,
                        n => 1e-15 * ripple * (1.0 + 40.0 * s) * f64::from(n),
                    }
                })
                .collect();
            (n as usize, values)
        })
        .collect();
    let svg = draw_harmonic_growth(&HarmonicGrowth {
        times: &times,
        amplitudes: all.iter().map(|(n, a)| (*n, a.as_slice())).collect(),
        predictions: vec![PredictedGrowth {
            harmonic: 2,
            rate_per_s: synthetic::GROWTH_RATE,
            window: (0.003, 0.014),
        }],
        first_nonlinearity: Some(0.0165),
    })
    .unwrap();
    check(
        "harmonic-growth",
        &svg,
        &[
            "time t (ms)",
            "amplitude of uθ (m)",
            "n = 8",
            "978.0 s−1",
            "first stick",
        ],
    );
}

#[test]
fn velocity_snapshots_show_field_and_contact_status() {
    let mesh = synthetic::mesh(180, 35);
    let times = [0.005, 0.0125, 0.03];
    let fields: Vec<Vec<f64>> = times
        .iter()
        .map(|&t| {
            let n = if t < 0.01 { 0 } else { 2 };
            let size = synthetic::saturation(t) * 3.0 + 0.01;
            synthetic::shape(&mesh, n, 0, -1, 0.3)
                .chunks_exact(2)
                .map(|u| size * u[0].re.hypot(u[1].re))
                .collect()
        })
        .collect();
    let status: Vec<Vec<ContactStatus>> = times
        .iter()
        .map(|&t| {
            mesh.inner_edge
                .nodes
                .iter()
                .map(|&node| synthetic::status_at(t, mesh.frame_angles[node as usize]))
                .collect()
        })
        .collect();
    let frames = times
        .iter()
        .zip(fields.iter().zip(&status))
        .map(|(&t, (field, status))| Snapshot::at_time(t, field, Some(status)))
        .collect();
    let svg = draw_snapshots(&Snapshots {
        name: "velocity-snapshots",
        quantity: "velocity modulus |*v*| (m/s)".into(),
        signed: false,
        mesh: &mesh,
        frames,
    })
    .unwrap();
    check(
        "velocity-snapshots",
        &svg,
        &[
            "t = 12.50 ms",
            "velocity modulus |v| (m/s)",
            "contact status",
            "stick",
        ],
    );
}

#[test]
fn shear_stress_fields_use_a_symmetric_range() {
    let mesh = synthetic::mesh(180, 35);
    let field: Vec<f64> = synthetic::shape(&mesh, 3, 1, 1, 0.5)
        .chunks_exact(2)
        .map(|u| 1.4 * u[1].re)
        .collect();
    let frames = ["low damping", "identified damping", "high damping"]
        .map(|caption| Snapshot {
            caption: caption.into(),
            values: &field,
            status: None,
        })
        .to_vec();
    let svg = draw_snapshots(&Snapshots {
        name: "shear-stress",
        quantity: "shear stress *τ*_{rθ} (MPa)".into(),
        signed: true,
        mesh: &mesh,
        frames,
    })
    .unwrap();
    check(
        "shear-stress",
        &svg,
        &["low damping", "shear stress τrθ (MPa)"],
    );
}

#[test]
fn trajectories_show_phase_plot_and_contact_trace() {
    let times: Vec<f64> = (0..25_000).map(|i| f64::from(i) * 2e-6).collect();
    let omega = 9600.0 * std::f64::consts::TAU;
    let wave = |amplitude: f64, shift: f64| -> Vec<f64> {
        times
            .iter()
            .map(|&t| amplitude * synthetic::saturation(t) * (omega * t + shift).cos())
            .collect()
    };
    let displacement: Vec<f64> = wave(1.2e-5, 0.0).iter().map(|u| u + 3e-6).collect();
    let velocity = wave(1.2e-5 * omega, std::f64::consts::FRAC_PI_2);
    let tangential = wave(2.0e-5, 0.3);
    let radial: Vec<f64> = wave(8e-6, 1.2).iter().map(|u| 25e-6 + u.max(0.0)).collect();
    let status: Vec<ContactStatus> = radial
        .iter()
        .zip(&velocity)
        .map(|(&u, &v)| match () {
            () if u > 25.01e-6 => ContactStatus::Open,
            () if v > 0.3 => ContactStatus::Stick,
            () => ContactStatus::Slip,
        })
        .collect();
    let svg = draw_trajectories(&Trajectories {
        phase: PhasePlot {
            name: "node 1641, radial".into(),
            displacement: &displacement,
            velocity: &velocity,
        },
        trace: ContactTrace {
            name: "contact node 1621".into(),
            tangential: &tangential,
            radial: &radial,
            status: Some(&status),
        },
        cycle_start: 20_000,
        end_name: "limit cycle",
    })
    .unwrap();
    check(
        "trajectories",
        &svg,
        &[
            "displacement u (µm)",
            "velocity v",
            "tangential uθ (µm)",
            "radial ur (µm)",
            "limit cycle",
        ],
    );
}

#[test]
fn energy_figure_shows_all_flows_and_the_residual() {
    let run = synthetic::run(25_000, 4);
    let size: Vec<f64> = run
        .times
        .iter()
        .map(|&t| synthetic::saturation(t))
        .collect();
    let make = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        run.times
            .iter()
            .zip(&size)
            .map(|(&t, &s)| f(t, s))
            .collect()
    };
    let ripple = |t: f64| (1.2e5 * t).sin();
    let external = make(&|t, s| 1296.0 + 75.0 * s * s + 30.0 * s * ripple(t));
    let stick = make(&|t, s| (965.0 * (s - 0.3).max(0.0) / 0.7) * (1.0 + 0.2 * ripple(t)));
    let slide = make(&|_, s| 1300.0 * s * (1.0 - 0.87 * s));
    let contact: Vec<f64> = (0..run.times.len())
        .map(|i| external[i] - stick[i] - slide[i])
        .collect();
    let damping = make(&|t, s| 1125.0 * s * s * (1.0 + 0.05 * ripple(t)));
    let normal = make(&|t, s| 4000.0 * (-t / 2e-4).exp() + 20.0 * s * ripple(t));
    let kinetic = make(&|t, s| 0.045 * s * s * (1.0 + 0.5 * ripple(t)) + 1e-4);
    let strain = make(&|t, s| 0.045 * s * s * (1.0 - 0.5 * ripple(t)) + 0.012);
    let residual = make(&|t, _| 1e-14 * (0.2 + (3e5 * t).sin().abs()));
    let fraction = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { size.iter().map(|&s| f(s)).collect() };
    let sticking = fraction(&|s| 0.36 * ((s - 0.45) / 0.55).max(0.0));
    let open = fraction(&|s| 0.41 * ((s - 0.6) / 0.4).max(0.0));
    let slipping: Vec<f64> = sticking
        .iter()
        .zip(&open)
        .map(|(a, b)| 1.0 - a - b)
        .collect();
    let svg = draw_energy_flows(&EnergyFlows {
        times: &run.times,
        external: &external,
        stick: &stick,
        slide: &slide,
        contact_dissipated: &contact,
        material_damping: &damping,
        normal_contact: &normal,
        kinetic: &kinetic,
        strain: &strain,
        balance_residual: &residual,
        status: [&sticking, &slipping, &open],
        signal_name: "radial acceleration, node 1641".into(),
        signal_times: &run.times,
        acceleration: &run.acceleration,
        averaging_time: 5e-4,
    })
    .unwrap();
    check(
        "energy",
        &svg,
        &[
            "power (kW)",
            "energy (mJ)",
            "nodes (%)",
            "residual (–)",
            "external power and its parts",
            "power balance of the body",
            "stored energy",
            "time t (ms)",
        ],
    );
}

#[test]
fn contact_state_shows_arcs_tractions_and_velocity() {
    let count = 180;
    let angles: Vec<f64> = (0..count)
        .map(|j| std::f64::consts::TAU * f64::from(j) / f64::from(count))
        .collect();
    let status: Vec<ContactStatus> = angles
        .iter()
        .map(|&a| synthetic::status_at(0.04, a))
        .collect();
    let pressure: Vec<f64> = angles
        .iter()
        .zip(&status)
        .map(|(a, s)| match s {
            ContactStatus::Open => 0.0,
            _ => 6e6 * (1.2 + (2.0 * a + 0.4).cos()),
        })
        .collect();
    let shear: Vec<f64> = pressure.iter().map(|p| 0.27 * p).collect();
    let velocity: Vec<f64> = angles
        .iter()
        .map(|a| (1.6 * (2.0 * a).cos()).min(1.31))
        .collect();
    let svg = draw_contact_state(&ContactState {
        name: "limit cycle, *t* = 40.00 ms".into(),
        angles: &angles,
        status: &status,
        pressure: &pressure,
        shear: &shear,
        tangential_velocity: &velocity,
        peripheral_speed: 1.31,
    })
    .unwrap();
    check(
        "contact-state",
        &svg,
        &[
            "traction (MPa)",
            "velocity (m/s)",
            "angle θ (°)",
            "stick",
            "cylinder Ωa",
        ],
    );
}
