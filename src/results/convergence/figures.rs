//! Figures and report of a convergence study.

use super::print::significant;
use super::{ConvergenceReport, Quantity, Refinement, Series};
use crate::results::drawing::{DrawingError, write_report};
use crate::results::figures::{ConvergenceSeries, ConvergenceStudy, FigureError, draw_convergence};
use crate::results::folder::OutputFolder;
use crate::results::report::{NamedFigure, Report, ReportSection, ReportTable};

/// Curves of one figure: as many as there are colours.
const MOST_CURVES: usize = 7;

/// Draws the figures of every series and writes `report.html`.
///
/// Of each unit the quantities that converge are drawn by their estimated errors, and all of a series by the
/// differences between successive levels, which need no limit; the first seven of each.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw(
    folder: &OutputFolder,
    report: &ConvergenceReport<'_>,
    dots_per_inch: f64,
) -> Result<(), DrawingError> {
    let sections: Result<Vec<_>, FigureError> = report.series.iter().map(section).collect();
    let html = Report {
        title: report.title.to_owned(),
        sections: sections?,
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &html, dots_per_inch)
}

fn section(series: &Series) -> Result<ReportSection, FigureError> {
    let (analysis, refinement) = (series.analysis, series.refinement.name());
    let mut figures = Vec::new();
    let units = unique_units(series);
    for unit in units {
        let of_unit: Vec<&Quantity> = series
            .quantities
            .iter()
            .filter(|q| q.unit == unit)
            .collect();
        let shown = match unit {
            "" => "pure numbers".to_owned(),
            unit => format!("quantities in {unit}"),
        };
        let suffix = match unit {
            "Hz" => "hz",
            "1/s" => "growth",
            "W" => "power",
            "" => "numbers",
            other => other,
        };
        let kinds: [(
            &str,
            String,
            fn(&Series, &Quantity) -> Option<ConvergenceSeries>,
        ); 2] = [
            (
                "errors",
                format!(
                    "Estimated errors of {shown} that converge, against their Richardson limits."
                ),
                errors,
            ),
            (
                "differences",
                format!(
                    "Differences between each level and the next, of {shown}: they fall where the \
                     quantity converges."
                ),
                differences,
            ),
        ];
        for (kind, caption, make) in kinds {
            let curves = of_unit.iter().filter_map(|quantity| make(series, quantity));
            let study = ConvergenceStudy {
                size_title: match series.refinement {
                    Refinement::Mesh => "element size (m)".into(),
                    Refinement::TimeStep => "time step (s)".into(),
                },
                error_title: match unit {
                    "" => kind.to_owned(),
                    unit => format!("{kind} ({unit})"),
                },
                series: curves.take(MOST_CURVES).collect(),
            };
            match draw_convergence(&study) {
                Ok(svg) => figures.push(NamedFigure {
                    name: format!("{analysis}-{refinement}-{kind}-{suffix}"),
                    caption,
                    svg,
                }),
                Err(FigureError::Empty { .. }) => {}
                Err(error) => return Err(error),
            }
        }
    }
    Ok(ReportSection {
        heading: match series.refinement {
            Refinement::Mesh => format!("{analysis}: mesh"),
            Refinement::TimeStep => format!("{analysis}: time step"),
        },
        paragraphs: series.notes.clone(),
        tables: vec![table(series)],
        figures,
    })
}

fn unique_units(series: &Series) -> Vec<&'static str> {
    let mut units = Vec::new();
    for quantity in &series.quantities {
        if !units.contains(&quantity.unit) {
            units.push(quantity.unit);
        }
    }
    units
}

fn errors(series: &Series, quantity: &Quantity) -> Option<ConvergenceSeries> {
    quantity.verdict.limit()?;
    let errors = quantity.errors();
    curve(quantity, &series.sizes, &errors)
}

fn differences(series: &Series, quantity: &Quantity) -> Option<ConvergenceSeries> {
    let pairs = quantity.values.windows(2);
    let differences: Vec<f64> = pairs.map(|pair| pair[1] - pair[0]).collect();
    curve(quantity, &series.sizes[..differences.len()], &differences)
}

/// The points that have a place on logarithmic axes; none if fewer than two have.
fn curve(quantity: &Quantity, sizes: &[f64], errors: &[f64]) -> Option<ConvergenceSeries> {
    let points = sizes.iter().zip(errors).map(|(h, e)| (*h, e.abs()));
    let points = points.filter(|&(_, e)| e > 0.0 && e.is_finite());
    let (sizes, errors): (Vec<f64>, Vec<f64>) = points.unzip();
    (sizes.len() > 1).then(|| ConvergenceSeries {
        name: quantity.name.clone(),
        sizes,
        errors,
    })
}

fn table(series: &Series) -> ReportTable {
    let mut columns = vec!["quantity".to_owned(), "unit".to_owned()];
    columns.extend(series.levels.iter().cloned());
    columns.extend(["extrapolated", "order", "spread", "verdict"].map(str::to_owned));
    let optional = |value: Option<f64>| value.map_or_else(String::new, significant);
    let rows = series.quantities.iter().map(|quantity| {
        let mut row = vec![quantity.name.clone(), quantity.unit.to_owned()];
        row.extend(quantity.values.iter().map(|value| significant(*value)));
        row.push(optional(quantity.verdict.limit()));
        row.push(
            quantity
                .verdict
                .order()
                .map_or_else(String::new, |p| format!("{p:.2}")),
        );
        row.push(significant(quantity.spread()));
        row.push(quantity.verdict.name().to_owned());
        row
    });
    ReportTable {
        caption: "Values on each level, Richardson-extrapolated from the three finest".into(),
        rows: rows.collect(),
        columns,
    }
}
