//! Figures and report of a complex eigenvalue analysis.

use super::{CeaReport, direction_name};
use crate::cea::{ComplexMode, FrictionPoint, UnstableInterval};
use crate::results::Manifest;
use crate::results::figures::{
    EigenvalueLocus, FigureError, ModeShape, ModeShapes, PairSweep, PrestressedContact,
    StabilityMap, draw_eigenvalue_locus, draw_mode_over_friction, draw_mode_shapes,
    draw_pair_sweep, draw_prestress, draw_stability_map,
};
use crate::results::report::{NamedFigure, Report, ReportSection, ReportTable};

/// Branches whose shape is followed over friction, at most.
const FOLLOWED_BRANCHES: usize = 4;

/// What the figures show beyond the modes.
#[derive(Clone, Debug)]
pub struct CeaFigures<'a> {
    /// The analysis.
    pub report: &'a CeaReport<'a>,
    /// Rayleigh coefficient `alpha_R`, 1/s.
    pub mass_coefficient: f64,
    /// Rayleigh coefficient `beta_R`, s.
    pub stiffness_coefficient: f64,
    /// The prestressed state at the case's friction coefficient.
    pub prestress: Option<PrestressedContact<'a>>,
    /// Stability over friction and a second parameter.
    pub map: Option<StabilityMap>,
}

/// Draws every figure that the analysis has data for.
///
/// # Errors
/// Those of the drawing.
pub fn draw(data: &CeaFigures<'_>) -> Result<Vec<NamedFigure>, FigureError> {
    let sweep = data.report.sweep;
    let mut figures = Vec::new();
    if let Some(prestress) = &data.prestress {
        let caption = "Steady sliding: contact pressure (a) and friction traction (b) around the \
                       contact edge, von Mises stress (c).";
        figures.push(figure("prestress", caption, draw_prestress(prestress)?));
    }
    if sweep.points.iter().any(|point| !point.modes.is_empty()) {
        let svg = draw_eigenvalue_locus(&EigenvalueLocus {
            sweep,
            mass_coefficient: data.mass_coefficient,
            stiffness_coefficient: data.stiffness_coefficient,
        })?;
        let caption = "Eigenvalues in the complex plane as friction rises (a), and the friction \
                       interval in which each branch is unstable, with its critical friction (b).";
        figures.push(figure("eigenvalue-locus", caption, svg));
    }
    if !sweep.intervals.is_empty() && sweep.points.len() > 1 {
        let caption = "Frequency and damping factor over friction of the pairs of waves that turn \
                       unstable.";
        let svg = draw_pair_sweep(&PairSweep { sweep })?;
        figures.push(figure("pair-sweep", caption, svg));
    }
    draw_shapes(data, &mut figures)?;
    draw_branches(data, &mut figures)?;
    if let Some(map) = &data.map {
        let caption =
            "Largest growth rate over two parameters; the line is the stability boundary.";
        figures.push(figure("stability-map", caption, draw_stability_map(map)?));
    }
    Ok(figures)
}

fn figure(name: &str, caption: &str, svg: String) -> NamedFigure {
    NamedFigure {
        name: name.to_owned(),
        caption: caption.to_owned(),
        svg,
    }
}

/// Modes of one friction value that carry shapes.
fn shapes_of(point: &FrictionPoint) -> Vec<ModeShape<'_>> {
    let numbered = point.modes.iter().enumerate();
    numbered
        .filter(|(_, mode)| mode.shape.is_some())
        .map(|(index, mode)| ModeShape {
            number: index + 1,
            friction_coefficient: point.friction_coefficient,
            mode,
        })
        .collect()
}

/// One figure of all modes for each friction value that has shapes.
fn draw_shapes(data: &CeaFigures<'_>, figures: &mut Vec<NamedFigure>) -> Result<(), FigureError> {
    for point in &data.report.sweep.points {
        let shapes = shapes_of(point);
        if shapes.is_empty() {
            continue;
        }
        let friction = point.friction_coefficient;
        let mesh = data.report.mesh;
        let svg = draw_mode_shapes(&ModeShapes { mesh, shapes })?;
        let caption = format!(
            "Mode shapes at friction coefficient {friction}: the deformed disc, coloured by \
             displacement amplitude; unstable modes in red."
        );
        figures.push(figure(&format!("mode-shapes-mu-{friction}"), &caption, svg));
    }
    Ok(())
}

/// The first branches that turn unstable, each at every friction value that has shapes.
fn draw_branches(data: &CeaFigures<'_>, figures: &mut Vec<NamedFigure>) -> Result<(), FigureError> {
    let sweep = data.report.sweep;
    let mut drawn: Vec<(usize, usize, i8)> = Vec::new();
    for interval in &sweep.intervals {
        let branch = (interval.harmonic, interval.branch, interval.direction);
        let shapes: Vec<ModeShape<'_>> = sweep
            .points
            .iter()
            .filter_map(|point| {
                shapes_of(point)
                    .into_iter()
                    .find(|shape| is_branch(shape.mode, branch))
            })
            .collect();
        if shapes.len() < 2 || drawn.contains(&branch) || drawn.len() == FOLLOWED_BRANCHES {
            continue;
        }
        drawn.push(branch);
        let mesh = data.report.mesh;
        let svg = draw_mode_over_friction(&ModeShapes { mesh, shapes })?;
        let name = format!("branch-n{}-{}-over-friction", branch.0, branch.1);
        let caption = format!(
            "Harmonic {}, branch {}, travelling {} the rotor, at several friction coefficients.",
            branch.0,
            branch.1,
            direction_name(branch.2)
        );
        figures.push(figure(&name, &caption, svg));
    }
    Ok(())
}

/// Whether a mode belongs to a branch; a degenerate pair stands at the start of both its waves.
fn is_branch(mode: &ComplexMode, (harmonic, branch, direction): (usize, usize, i8)) -> bool {
    mode.harmonic == harmonic
        && mode.branch == branch
        && (mode.direction == direction || mode.direction == 0)
}

/// The report: figures, eigenvalues where shapes were asked for, critical frictions.
pub fn html_report(
    data: &CeaFigures<'_>,
    figures: Vec<NamedFigure>,
    manifest: &Manifest,
) -> Report {
    let report = data.report;
    let (fewest, most) = report.mode_counts();
    let base = &report.base;
    let mut paragraphs = vec![
        format!(
            "Complex eigenvalues {}: {} modes at {} friction values, {} unknowns, {} method; largest \
             relative residual {:.1e}; {:.2} s.",
            report.selection,
            if fewest == most {
                most.to_string()
            } else {
                format!("{fewest} to {most}")
            },
            report.friction_coefficients.len(),
            report.dofs,
            report.method,
            report.largest_residual(),
            report.wall_s
        ),
        format!(
            "Steady sliding at friction coefficient {}: contact pressure {:.4} to {:.4} MPa, torque \
             {:.4} N m, power {:.1} W.",
            base.friction_coefficient,
            base.pressure_pa[0] * 1e-6,
            base.pressure_pa[1] * 1e-6,
            base.torque_n_m,
            base.power_w
        ),
    ];
    paragraphs.extend(report.notes.iter().cloned());
    let mut tables = vec![critical_table(&report.sweep.intervals)];
    tables.extend(eigenvalue_tables(report));
    Report {
        title: report.title.to_owned(),
        sections: vec![
            ReportSection {
                heading: "Stability of steady sliding".into(),
                paragraphs,
                tables: vec![tables.remove(0)],
                figures,
            },
            ReportSection {
                heading: "Eigenvalues".into(),
                tables,
                ..ReportSection::default()
            },
        ],
        manifest: manifest.clone(),
    }
}

fn critical_table(intervals: &[UnstableInterval]) -> ReportTable {
    let rows = intervals.iter().map(|interval| {
        vec![
            interval.harmonic.to_string(),
            interval.branch.to_string(),
            direction_name(interval.direction).to_owned(),
            if interval.unstable_from_start {
                format!("below {}", interval.critical_friction)
            } else {
                format!("{:.5}", interval.critical_friction)
            },
            format!("{:.1}", interval.frequency_hz),
            interval
                .restabilized
                .map_or(String::new(), |(friction, _)| format!("{friction:.5}")),
        ]
    });
    ReportTable {
        caption: "Critical friction of each branch that turns unstable".into(),
        columns: [
            "harmonic n",
            "branch",
            "travels",
            "critical friction",
            "frequency (Hz)",
            "stable again at",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}

/// All modes at the friction values that have shapes, or at the last value of the sweep.
fn eigenvalue_tables(report: &CeaReport<'_>) -> Vec<ReportTable> {
    let points = &report.sweep.points;
    let with_shapes = |point: &&FrictionPoint| point.modes.iter().any(|m| m.shape.is_some());
    let mut chosen: Vec<&FrictionPoint> = points.iter().filter(with_shapes).collect();
    if chosen.is_empty() {
        chosen.extend(points.last());
    }
    chosen.into_iter().map(eigenvalue_table).collect()
}

fn eigenvalue_table(point: &FrictionPoint) -> ReportTable {
    let rows = point.modes.iter().enumerate().map(|(index, mode)| {
        vec![
            (index + 1).to_string(),
            format!("{:.2}", mode.real_hz()),
            format!("{:.2}", mode.frequency_hz()),
            format!("{:.5}", mode.damping_factor()),
            mode.harmonic.to_string(),
            mode.branch.to_string(),
            direction_name(mode.direction).to_owned(),
            if mode.is_unstable() { "unstable" } else { "" }.to_owned(),
        ]
    });
    ReportTable {
        caption: format!(
            "Eigenvalues at friction coefficient {}",
            point.friction_coefficient
        ),
        columns: [
            "mode",
            "Re λ / 2π (Hz)",
            "Im λ / 2π (Hz)",
            "damping factor",
            "harmonic n",
            "branch",
            "travels",
            "stability",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}
