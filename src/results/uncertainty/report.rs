//! Table, figures and report of an uncertainty analysis, in a folder that several processes may share.

use super::Sample;
use super::figures::{indices, robust, uncertainty};
use super::summary::{DesignCurve, RobustSummary, UncertaintySummary};
use crate::results::FolderError;
use crate::results::drawing::{Declaration, DrawingError, DrawingOptions, draw_all, figure_files};
use crate::results::quantity::significant;
use crate::results::report::{Report, ReportSection, ReportTable};
use crate::results::sweep::SweepFolder;
use crate::results::table::{Table, format_number};

/// Writes `samples.csv`, one row a sample.
///
/// # Errors
/// Those of the folder.
pub fn write_samples(
    folder: &SweepFolder,
    keys: &[String],
    samples: &[Sample],
    largest_friction: f64,
) -> Result<(), FolderError> {
    let mut columns = vec!["sample"];
    columns.extend(keys.iter().map(String::as_str));
    columns.extend([
        "own_friction_coefficient",
        "unstable",
        "critical_friction",
        "harmonic",
        "branch",
        "direction",
        "frequency_hz",
        "unstable_from_start",
        "error",
    ]);
    folder.write("samples.csv", |out| {
        let mut table = Table::new(out, &columns)?;
        for sample in samples {
            let lowest = sample.lowest(largest_friction);
            let text = |of: &dyn Fn(&super::Onset) -> String| lowest.map_or(String::new(), of);
            let mut row = vec![sample.number.to_string()];
            row.extend(sample.values.iter().map(|value| format_number(*value)));
            row.push(format_number(sample.friction_coefficient));
            row.push(match sample.error {
                None => sample.is_unstable(sample.friction_coefficient).to_string(),
                Some(_) => String::new(),
            });
            row.push(text(&|onset| format_number(onset.critical_friction)));
            row.push(text(&|onset| onset.harmonic.map_or(String::new(), |n| n.to_string())));
            row.push(text(&|onset| onset.branch.to_string()));
            row.push(text(&|onset| onset.direction.to_string()));
            row.push(text(&|onset| format_number(onset.frequency_hz)));
            row.push(text(&|onset| onset.unstable_from_start.to_string()));
            row.push(sample.error.clone().unwrap_or_default());
            table.row(row)?;
        }
        table.finish()
    })
}

/// Draws the figures into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the folder and of the drawing.
pub fn draw_report(
    folder: &SweepFolder,
    summary: &UncertaintySummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let mut declarations: Vec<Declaration<'_>> = vec![Box::new(|| Ok(uncertainty(summary)))];
    if !summary.sobol.is_empty() {
        declarations.push(Box::new(|| Ok(indices(summary))));
    }
    if let Some(designs) = &summary.robust {
        declarations.push(Box::new(|| Ok(robust(designs))));
    }
    let figures = draw_all(declarations, options)?;
    for file in figure_files(&figures, options)? {
        folder.write(&file.name, |out| out.write_all(&file.bytes))?;
    }
    let title = match summary.title.as_str() {
        "" => "Probability of squeal".to_owned(),
        title => title.to_owned(),
    };
    let mut paragraphs: Vec<String> = summary.notes.clone();
    paragraphs.extend(summary.robust.as_ref().and_then(cheapest));
    let report = Report {
        title,
        sections: vec![
            ReportSection::results(paragraphs, results(summary)).with_tables([
                families(summary),
                indices_table(summary),
                designs(summary),
            ]),
            ReportSection::new("Probability of squeal").with_figures(figures),
        ],
        manifest: summary.manifest.clone(),
    };
    let html = report.to_html();
    Ok(folder.write("report.html", |out| out.write_all(html.as_bytes()))?)
}

/// What decides, name and value.
fn results(summary: &UncertaintySummary) -> Vec<(String, String)> {
    let (p, c) = (summary.probability_unstable, &summary.critical_friction);
    let text =
        |value: Option<f64>| value.map_or("beyond the range".to_owned(), |v| format!("{v:.4}"));
    let rows = [
        (
            format!("probability of squeal at {}", summary.friction_text()),
            format!("{:.4} (95 % {:.4} to {:.4})", p.value, p.low, p.high),
        ),
        ("lowest critical friction, median".into(), text(c.median)),
        ("5 % of the samples below".into(), text(c.p05)),
        ("5 % of the samples above".into(), text(c.p95)),
        ("samples".into(), (summary.samples - summary.failed).to_string()),
    ];
    let decisive = summary.decisive.iter();
    let decisive = decisive.map(|key| ("decisive parameter".to_owned(), key.clone()));
    rows.into_iter().chain(decisive).collect()
}

fn indices_table(summary: &UncertaintySummary) -> ReportTable {
    let mut rows: Vec<_> = summary.sobol.iter().collect();
    rows.sort_by(|a, b| b.1.total.total_cmp(&a.1.total));
    let row = |(key, index): (&String, &super::Index)| {
        let part = |value: f64| format!("{value:.3}");
        vec![key.clone(), part(index.first), part(index.total)]
    };
    ReportTable::new(
        "Sobol's indices of the lowest critical friction: which parameter decides it",
        ["parameter", "first order", "total"],
        rows.into_iter().map(row),
    )
}

/// The changes of a design, one row for each parameter; no row where none were asked for.
fn designs(summary: &UncertaintySummary) -> ReportTable {
    let robust = summary.robust.iter();
    let rows = robust.flat_map(|robust| robust.curves.iter().map(|curve| (robust.bound, curve)));
    let row = |(_, curve): (f64, &DesignCurve)| {
        let reached = match curve.reaches_bound_at {
            Some(value) => significant(value, 4),
            None if curve.has_effect => "not reached".to_owned(),
            None => "without effect".to_owned(),
        };
        let change = curve.change_percent;
        let change = change.map_or(String::new(), |change| format!("{change:+.1}"));
        vec![curve.key.clone(), reached, change]
    };
    let bound = summary.robust.as_ref().map_or(0.0, |robust| robust.bound);
    ReportTable::new(
        format!("Designs: where the probability of squeal falls to {bound}"),
        ["parameter", "reached at", "change (%)"],
        rows.map(row),
    )
}

fn cheapest(robust: &RobustSummary) -> Option<String> {
    let key = robust.cheapest.as_ref()?;
    Some(format!(
        "The smallest relative change that brings the probability of squeal down to {} is that of {key}.",
        robust.bound
    ))
}

fn families(summary: &UncertaintySummary) -> ReportTable {
    let rows = summary.families.iter().map(|family| {
        vec![
            family.name(),
            format!("{:.4}", family.probability),
            format!("{:.4}", family.probability_in_range),
            format!("{:.4}", family.critical_friction_median),
            format!("{:.0}", family.frequency_hz),
        ]
    });
    let at_friction = match summary.friction_coefficient {
        Some(_) => "unstable at the friction of the case",
        None => "unstable at the friction of each sample",
    };
    ReportTable::new(
        "Families of modes, followed across samples by harmonic and rank",
        [
            "mode",
            at_friction,
            "turns unstable in the range",
            "median critical friction",
            "frequency (Hz)",
        ],
        rows,
    )
}
