//! Every kind of figure from analytic data: the drawing is well-formed, holds its axis titles, names
//! and data, stays light, is the same each time, and its PNG shows something.
//!
//! Consistency checks: they look at the drawing, not at the physics.

mod cycles;
#[path = "../common/disc.rs"]
mod disc;
mod report;
mod run;
mod studies;
mod synthetic;
mod transient;

use frictionsim::results::figures::axis::Scale;
use frictionsim::results::figures::*;
use std::path::PathBuf;

/// Largest drawing that a mail or a report should carry.
const LARGEST_SVG: usize = 500_000;

/// Writes drawing and PNG below the target folder for a look, and checks both.
fn check(name: &str, svg: &str, expected: &[&str]) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("figures");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(format!("{name}.svg")), svg).unwrap();
    let document = resvg::usvg::roxmltree::Document::parse(svg)
        .unwrap_or_else(|error| panic!("{name} is not well-formed: {error}"));
    let text: Vec<String> = document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .map(|node| {
            node.descendants()
                .filter(|d| d.is_text())
                .filter_map(|d| d.text())
                .collect()
        })
        .collect();
    for wanted in expected {
        assert!(
            text.iter().any(|line| line.contains(wanted)),
            "{name} lacks '{wanted}': {text:?}"
        );
    }
    assert!(
        document.descendants().any(|n| n.has_tag_name("title"))
            && document.descendants().any(|n| n.has_tag_name("desc"))
    );
    let coordinates = document
        .descendants()
        .flat_map(|node| node.attributes())
        .filter(|attribute| ["d", "x", "y", "width", "height"].contains(&attribute.name()));
    for attribute in coordinates {
        assert!(!attribute.value().contains(['N', 'i']), "{name}");
    }
    assert!(svg.len() < LARGEST_SVG, "{name}: {} bytes", svg.len());
    let png = render_png(svg, 220.0).unwrap();
    std::fs::write(folder.join(format!("{name}.png")), &png).unwrap();
    assert!(ink_fraction(&png) > 0.005, "{name} is blank");
}

/// Part of the pixels that are not white.
fn ink_fraction(png: &[u8]) -> f64 {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let inked = pixels
        .chunks_exact(3)
        .filter(|pixel| pixel.iter().any(|&channel| channel < 230))
        .count();
    inked as f64 / (pixels.len() / 3) as f64
}

#[test]
fn mode_shapes_show_number_frequency_real_part_and_harmonic() {
    let mesh = synthetic::mesh(180, 35);
    let modes = synthetic::modes(0.3, Some(&mesh));
    let shapes = modes
        .iter()
        .enumerate()
        .map(|(index, mode)| ModeShape {
            number: index + 1,
            friction_coefficient: 0.3,
            mode,
        })
        .collect();
    let data = ModeShapes {
        mesh: &mesh,
        shapes,
    };
    let svg = draw_mode_shapes(&data).unwrap();
    check(
        "mode-shapes",
        &svg,
        &[
            "1: 5857 Hz",
            "Re −51",
            "n = 1 ↻ unstable",
            "displacement amplitude",
        ],
    );
    assert_eq!(svg, draw_mode_shapes(&data).unwrap());
}

#[test]
fn one_mode_over_friction_names_each_friction_value() {
    let mesh = synthetic::mesh(180, 35);
    let frictions = [0.0, 0.1, 0.3, 0.6, 0.8, 1.0];
    let all: Vec<_> = frictions
        .iter()
        .map(|&mu| synthetic::modes(mu, Some(&mesh)))
        .collect();
    let shapes = frictions
        .iter()
        .zip(&all)
        .map(|(&friction_coefficient, modes)| ModeShape {
            number: 7,
            friction_coefficient,
            mode: &modes[6],
        })
        .collect();
    let data = ModeShapes {
        mesh: &mesh,
        shapes,
    };
    let svg = draw_mode_over_friction(&data).unwrap();
    check("mode-over-friction", &svg, &["μ = 0.600", "n = 1"]);
}

#[test]
fn a_mode_without_shape_is_refused() {
    let mesh = synthetic::mesh(12, 2);
    let modes = synthetic::modes(0.3, None);
    let shapes = vec![ModeShape {
        number: 1,
        friction_coefficient: 0.3,
        mode: &modes[0],
    }];
    let error = draw_mode_shapes(&ModeShapes {
        mesh: &mesh,
        shapes,
    });
    assert!(matches!(error, Err(FigureError::Shape { .. })));
}

#[test]
fn eigenvalue_locus_marks_critical_friction() {
    let sweep = synthetic::sweep(51);
    let svg = draw_eigenvalue_locus(&EigenvalueLocus {
        sweep: &sweep,
        mass_coefficient: synthetic::MASS_COEFFICIENT,
        stiffness_coefficient: synthetic::STIFFNESS_COEFFICIENT,
    })
    .unwrap();
    check(
        "eigenvalue-locus",
        &svg,
        &[
            "Re(λ) / 2π (Hz)",
            "Im(λ) / 2π (kHz)",
            "friction coefficient μ (–)",
            "unstable",
            "Rayleigh",
            "10.51 kHz, n = 1",
        ],
    );
}

#[test]
fn pair_sweep_shows_frequency_and_damping_of_each_unstable_pair() {
    let sweep = synthetic::sweep(51);
    let svg = draw_pair_sweep(&PairSweep { sweep: &sweep }).unwrap();
    check(
        "pair-sweep",
        &svg,
        &[
            "frequency f (kHz)",
            "damping factor ζ (%)",
            "n = 1, branch 0",
        ],
    );
}

#[test]
fn stability_map_draws_its_boundary() {
    let x: Vec<f64> = (0..40).map(|i| f64::from(i) * 0.025).collect();
    let y: Vec<f64> = (0..30)
        .map(|i| 1e-8 * 10f64.powf(f64::from(i) * 0.1))
        .collect();
    let growth_rate = y
        .iter()
        .flat_map(|beta| {
            x.iter()
                .map(move |mu| 2500.0 * (3.0 * mu).tanh() - beta * 2e9)
        })
        .collect();
    let svg = draw_stability_map(&StabilityMap {
        x_title: "friction coefficient *μ* (–)".into(),
        x,
        x_scale: Scale::Linear,
        y_title: "damping coefficient *β*_{R} (s)".into(),
        y,
        y_scale: Scale::Logarithmic,
        growth_rate,
    })
    .unwrap();
    check(
        "stability-map",
        &svg,
        &[
            "friction coefficient μ (–)",
            "βR (s)",
            "largest growth rate (1/s)",
        ],
    );
}

#[test]
fn prestress_shows_tractions_and_von_mises_stress() {
    let mesh = synthetic::mesh(180, 35);
    let angles: Vec<f64> = mesh
        .inner_edge
        .nodes
        .iter()
        .map(|&node| mesh.frame_angles[node as usize])
        .collect();
    let pressure: Vec<f64> = angles.iter().map(|_| 2.827e6).collect();
    let shear: Vec<f64> = pressure.iter().map(|p| 0.3 * p).collect();
    let von_mises: Vec<f64> = mesh
        .nodes
        .iter()
        .map(|p| 4.6e6 * (0.0205 / p[0].hypot(p[1])).powi(2))
        .collect();
    let svg = draw_prestress(&PrestressedContact {
        mesh: &mesh,
        angles: &angles,
        pressure: &pressure,
        shear: &shear,
        von_mises: &von_mises,
    })
    .unwrap();
    check(
        "prestress",
        &svg,
        &[
            "pressure p (MPa)",
            "shear τ (MPa)",
            "angle θ (°)",
            "von Mises stress (MPa)",
        ],
    );
}
