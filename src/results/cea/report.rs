//! The report of an eigenvalue analysis: figures, critical frictions, eigenvalues.

use super::branches::branch_of;
use super::coupling::sentences;
use super::{CeaReport, direction_name};
use crate::cea::FrictionPoint;
use crate::results::Manifest;
use crate::results::quantity::fixed;
use crate::results::report::{NamedFigure, Report, ReportSection, ReportTable};
use std::f64::consts::TAU;

/// Modes whose sensitivities a report lists.
const SENSITIVE_MODES: usize = 4;

/// The report: figures, eigenvalues where shapes were asked for, critical frictions.
pub fn html_report(
    report: &CeaReport<'_>,
    figures: Vec<NamedFigure>,
    manifest: &Manifest,
) -> Report {
    let (fewest, most) = report.mode_counts();
    let base = &report.base;
    let mut paragraphs = vec![
        format!(
            "Complex eigenvalues ({}): {} modes at {}, {} unknowns, {} method; largest \
             relative residual {:.1e}.",
            report.selection,
            if fewest == most { most.to_string() } else { format!("{fewest} to {most}") },
            super::print::friction_values(report.friction_coefficients.len()),
            report.dofs,
            report.method,
            report.largest_residual(),
        ),
        format!(
            "Steady sliding at friction coefficient {}: contact pressure {:.4} to {:.4} MPa, {}, \
             power {}.",
            base.friction_coefficient,
            base.pressure_pa[0] * 1e-6,
            base.pressure_pa[1] * 1e-6,
            base.drive(),
            base.power()
        ),
    ];
    paragraphs.extend(base.extent.note().map(|note| format!("{note}.")));
    paragraphs.extend(report.notes.iter().cloned());
    let mut sections = vec![
        ReportSection::results(paragraphs, results(report)).with_tables([critical_table(report)]),
        ReportSection::new("Stability of steady sliding").with_figures(figures),
    ];
    sections.extend(decisive(report));
    sections.push(ReportSection::new("Eigenvalues").with_tables(eigenvalue_tables(report)));
    Report { title: report.title.to_owned(), sections, manifest: manifest.clone() }
}

/// Unstable modes that the report puts into words, at most.
const READ_MODES: usize = 6;

/// Which modes couple and which parameter decides, as far as that is known.
fn decisive(report: &CeaReport<'_>) -> Option<ReportSection> {
    let own = report.base.friction_coefficient;
    let read = report.reading.map(|reading| reading.sentences(own, READ_MODES));
    let read = read.unwrap_or_default();
    // Waves of a pair are one mode without friction: that they couple is told apart.
    let mut paragraphs = match read.is_empty() || report.has_harmonics {
        true => sentences(report),
        false => Vec::new(),
    };
    paragraphs.extend(read);
    let tables = report.sensitivities.map_or(Vec::new(), |all| all.tables(SENSITIVE_MODES));
    if !tables.is_empty() {
        paragraphs.push(
            "Sensitivities: a positive change of the growth rate brings a mode nearer to squeal or makes it grow faster, a \
             negative one holds it back. They hold for small changes; sensitivities.csv has those of every mode."
                .to_owned(),
        );
    }
    (!paragraphs.is_empty()).then(|| {
        ReportSection::new("What couples, and what decides")
            .with_paragraphs(paragraphs)
            .with_tables(tables)
    })
}

/// What decides: where stability ends, and what grows at the case's own friction.
fn results(report: &CeaReport<'_>) -> Vec<(String, String)> {
    let intervals = &report.sweep.intervals;
    let lowest =
        intervals.iter().min_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    let onset = match lowest {
        Some(interval) if interval.unstable_from_start => {
            format!("below {}", interval.critical_friction)
        }
        Some(interval) => fixed(interval.critical_friction, 5),
        None => "none: stable throughout".to_owned(),
    };
    let mut rows = vec![("lowest critical friction".to_owned(), onset)];
    rows.extend(lowest.map(|interval| {
        let frequency = fixed(interval.frequency_hz, 2);
        ("its frequency".to_owned(), format!("{frequency} Hz"))
    }));
    let own = report.base.friction_coefficient;
    let at_own = report.sweep.points.iter().find(|point| point.friction_coefficient == own);
    if let Some(point) = at_own {
        let unstable = point.modes.iter().filter(|mode| mode.is_unstable());
        let name = format!("unstable modes at friction {own}");
        rows.push((name, format!("{} of {}", unstable.clone().count(), point.modes.len())));
        let fastest = unstable.max_by(|a, b| a.real_hz().total_cmp(&b.real_hz()));
        rows.extend(fastest.map(|mode| {
            let text = format!(
                "{} 1/s at {} Hz",
                fixed(TAU * mode.real_hz(), 1),
                fixed(mode.frequency_hz(), 2)
            );
            ("fastest growth there".to_owned(), text)
        }));
    }
    rows.extend(report.base.torque_n_m.map(|torque| {
        let name = "torque of steady sliding".to_owned();
        let unit = report.base.extent.unit("N m");
        (name, format!("{} {unit}", fixed(torque, 3)))
    }));
    rows
}

/// A count in a table; nothing where there is none.
fn cell(count: Option<usize>) -> String {
    count.map_or(String::new(), |count| count.to_string())
}

fn critical_table(report: &CeaReport<'_>) -> ReportTable {
    let numbers = report.mode_numbers();
    let has_diameters = report.is_by_diameters();
    let rows = report.sweep.intervals.iter().map(|interval| {
        let branch = branch_of(interval);
        let mut row = match report.has_harmonics {
            true => vec![
                branch.0.to_string(),
                branch.1.to_string(),
                direction_name(branch.2).to_owned(),
            ],
            false => {
                let number = numbers.get(&branch).map_or(String::new(), usize::to_string);
                let diameters = has_diameters.then(|| cell(interval.nodal_diameters));
                let both = std::iter::once(number).chain(diameters);
                both.chain([branch.1.to_string()]).collect()
            }
        };
        row.push(if interval.unstable_from_start {
            format!("below {}", interval.critical_friction)
        } else {
            format!("{:.5}", interval.critical_friction)
        });
        row.push(format!("{:.2}", interval.frequency_hz));
        let again = interval.restabilized;
        row.push(again.map_or(String::new(), |(friction, _)| format!("{friction:.5}")));
        row
    });
    let own = report.base.friction_coefficient;
    let names: Vec<String> = match report.has_harmonics {
        true => ["harmonic n", "branch", "travels"].map(String::from).to_vec(),
        false => {
            let number = Some(format!("mode at friction {own}"));
            let diameters = has_diameters.then(|| "harmonic n".to_owned());
            number.into_iter().chain(diameters).chain(["branch".to_owned()]).collect()
        }
    };
    let values = ["critical friction", "frequency (Hz)", "stable again at"];
    ReportTable::new(
        "Critical friction of each branch that turns unstable",
        names.into_iter().chain(values.map(String::from)),
        rows,
    )
}

/// All modes at the friction values that have shapes, or at the last value of the sweep.
fn eigenvalue_tables(report: &CeaReport<'_>) -> Vec<ReportTable> {
    let points = &report.sweep.points;
    let with_shapes = |point: &&FrictionPoint| point.modes.iter().any(|m| m.shape.is_some());
    let mut chosen: Vec<&FrictionPoint> = points.iter().filter(with_shapes).collect();
    if chosen.is_empty() {
        chosen.extend(points.last());
    }
    chosen.into_iter().map(|point| eigenvalue_table(report, point)).collect()
}

fn eigenvalue_table(report: &CeaReport<'_>, point: &FrictionPoint) -> ReportTable {
    let is_by_diameters = report.has_harmonics || report.is_by_diameters();
    let rows = point.modes.iter().enumerate().map(|(index, mode)| {
        let mut row = vec![
            (index + 1).to_string(),
            format!("{:.2}", mode.real_hz()),
            format!("{:.2}", mode.frequency_hz()),
            format!("{:.5}", mode.damping_factor()),
        ];
        if is_by_diameters {
            row.push(cell(mode.diameters(report.has_harmonics)));
        }
        row.push(mode.branch.to_string());
        if report.has_harmonics {
            row.push(direction_name(mode.direction).to_owned());
        }
        row.push(if mode.is_unstable() { "unstable" } else { "" }.to_owned());
        row
    });
    let mut columns = vec!["mode", "Re λ / 2π (Hz)", "Im λ / 2π (Hz)", "damping factor"];
    columns.extend(is_by_diameters.then_some("harmonic n"));
    columns.push("branch");
    columns.extend(report.has_harmonics.then_some("travels"));
    columns.push("stability");
    ReportTable::new(
        format!("Eigenvalues at friction coefficient {}", point.friction_coefficient),
        columns,
        rows,
    )
}
