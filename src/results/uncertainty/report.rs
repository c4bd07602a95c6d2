//! Table, figures and report of an uncertainty analysis, in a folder that several processes may share.

use super::Sample;
use super::figures::{indices, robust, uncertainty};
use super::summary::UncertaintySummary;
use crate::results::FolderError;
use crate::results::drawing::{Declaration, DrawingError, DrawingOptions, draw_all, figure_files};
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
                None => u8::from(sample.is_unstable(sample.friction_coefficient)).to_string(),
                Some(_) => String::new(),
            });
            row.push(text(&|onset| format_number(onset.critical_friction)));
            row.push(text(&|onset| {
                onset.harmonic.map_or(String::new(), |n| n.to_string())
            }));
            row.push(text(&|onset| onset.branch.to_string()));
            row.push(text(&|onset| onset.direction.to_string()));
            row.push(text(&|onset| format_number(onset.frequency_hz)));
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
    let lines = summary.text();
    let report = Report {
        title,
        sections: vec![
            ReportSection {
                heading: "Probability of squeal".into(),
                paragraphs: lines
                    .lines()
                    .skip(1)
                    .map(|line| line.trim().to_owned())
                    .collect(),
                figures,
                ..ReportSection::default()
            },
            ReportSection {
                heading: "Modes that turn unstable".into(),
                tables: vec![families(summary)],
                ..ReportSection::default()
            },
        ],
        manifest: summary.manifest.clone(),
    };
    let html = report.to_html();
    Ok(folder.write("report.html", |out| out.write_all(html.as_bytes()))?)
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
    ReportTable {
        caption: "Families of modes, followed across samples by harmonic and rank".into(),
        columns: [
            "mode",
            "unstable at the friction of the case",
            "turns unstable in the range",
            "median critical friction",
            "frequency (Hz)",
        ]
        .map(String::from)
        .to_vec(),
        rows: rows.collect(),
    }
}
