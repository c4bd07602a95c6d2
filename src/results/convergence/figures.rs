//! Figures and report of a convergence study.

use super::print::significant;
use super::{ConvergenceReport, Quantity, Refinement, Series};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::figures::{ConvergenceSeries, ConvergenceStudy, FigureError, draw_convergence};
use crate::results::folder::OutputFolder;
use crate::results::report::{NamedFigure, Report, ReportSection, ReportTable};

/// Curves of one figure: as many as there are colours.
const MOST_CURVES: usize = 7;

/// Makes the curve of a quantity, where there is one.
type CurveOf = fn(&Series, &Quantity) -> Option<ConvergenceSeries>;

/// Draws the figures of every series and writes `report.html`.
///
/// Of each group the quantities that converge are drawn by their estimated errors, and all by the
/// differences between successive levels, which need no limit; the first seven of each.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw(
    folder: &OutputFolder,
    report: &ConvergenceReport,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let sections: Result<Vec<_>, FigureError> = report.series.iter().map(section).collect();
    let html = Report {
        title: report.title.clone(),
        sections: sections?,
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &html, options)
}

fn section(series: &Series) -> Result<ReportSection, FigureError> {
    let (analysis, refinement) = (&series.analysis, series.refinement.name());
    let mut figures = Vec::new();
    for group in groups(series) {
        let members = series.quantities.iter();
        let members: Vec<&Quantity> = members.filter(|q| group_of(q) == group).collect();
        let unit = members.first().map_or("", |quantity| &quantity.unit);
        let file = group.replace(' ', "-").to_lowercase();
        let kinds: [(&str, String, CurveOf); 2] = [
            (
                "errors",
                format!(
                    "Estimated errors where there is convergence, against Richardson's limit: {group}."
                ),
                errors,
            ),
            (
                "differences",
                format!(
                    "Differences between each level and the next, which fall where there is \
                     convergence: {group}."
                ),
                differences,
            ),
        ];
        for (kind, caption, make) in kinds {
            let curves = members.iter().filter_map(|quantity| make(series, quantity));
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
                    name: format!("{analysis}-{refinement}-{kind}-{file}"),
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

/// What shares a figure: the same property of several modes, else whatever has the same unit.
fn group_of(quantity: &Quantity) -> &str {
    match (quantity.name.split_once(", "), quantity.unit.as_str()) {
        (Some((property, _)), _) => property,
        (None, "Hz") => "frequency",
        (None, "W") => "power",
        (None, _) => "fractions and shares",
    }
}

fn groups(series: &Series) -> Vec<&str> {
    let mut groups = Vec::new();
    for quantity in &series.quantities {
        if !groups.contains(&group_of(quantity)) {
            groups.push(group_of(quantity));
        }
    }
    groups
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
    let label = quantity.name.split_once(", ").map(|(_, mode)| mode);
    (sizes.len() > 1).then(|| ConvergenceSeries {
        name: label.unwrap_or(&quantity.name).to_owned(),
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
        let mut row = vec![quantity.name.clone(), quantity.unit.clone()];
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
