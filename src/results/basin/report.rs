//! `report.html` of a search for the boundary between two basins, and its figure.

use super::{BasinSummary, RunSummary};
use crate::chart::{Axis, ChartError, Figure, INK, Marker, Panel, Points, Rule, SERIES, Stroke};
use crate::results::drawing::{DrawingError, DrawingOptions, draw_all, write_report};
use crate::results::folder::OutputFolder;
use crate::results::quantity::significant;
use crate::results::report::{Report, ReportSection, ReportTable};

/// Draws the search into `figures/` and writes `report.html`.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw_basin(
    folder: &OutputFolder,
    summary: &BasinSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let figures = draw_all(vec![Box::new(|| search(summary))], options)?;
    let report = Report {
        title: summary.title.clone(),
        sections: vec![
            ReportSection::results(vec![summary.answer()], results(summary)),
            ReportSection::new("Search").with_tables([runs_table(summary)]).with_figures(figures),
        ],
        manifest: folder.manifest().clone(),
    };
    write_report(folder, &report, options)
}

fn results(summary: &BasinSummary) -> Vec<(String, String)> {
    let [first, second] = summary.harmonics;
    let bound = |value: Option<f64>| value.map_or("-".to_owned(), |v| significant(v, 4));
    vec![
        match summary.of_modes {
            true => (
                "rivals".to_owned(),
                format!("{} and {}", summary.name(first), summary.name(second)),
            ),
            false => ("waves".to_owned(), format!("n = {first} and n = {second} nodal diameters")),
        },
        (
            format!("largest ratio at which {} wins", summary.name(first)),
            bound(summary.boundary.low),
        ),
        (
            format!("smallest ratio at which {} wins", summary.name(second)),
            bound(summary.boundary.high),
        ),
        ("transients".to_owned(), summary.transients.to_string()),
    ]
}

/// The winner of each transient over the ratio of the amplitudes at the first stick or opening.
fn search(summary: &BasinSummary) -> Result<Figure, ChartError> {
    let [first, second] = summary.harmonics;
    let place = |run: &RunSummary| {
        let at = if run.winner == first { 0.0 } else { 1.0 };
        Some((run.saturation_ratio?, at))
    };
    let shown = |rival: usize| summary.name(rival).replace("n = ", "*n* = ");
    let points = |winner: usize, is_settled: bool| {
        let own = summary.runs.iter();
        let own = own.filter(move |run| run.winner == winner && run.is_settled == is_settled);
        let (marker, colour) = match (is_settled, winner == first) {
            (false, _) => (Marker::Circle, INK),
            (true, true) => (Marker::Disc, SERIES[0]),
            (true, false) => (Marker::Square, SERIES[1]),
        };
        let name = match is_settled {
            true => format!("{} wins", shown(winner)),
            false => "not settled".to_owned(),
        };
        Points::new(own.filter_map(place)).marker(marker, 2.6, colour).name(name)
    };
    let bounds = [summary.boundary.low, summary.boundary.high];
    let bounds = bounds.into_iter().flatten().map(|ratio| {
        Rule::vertical(ratio).stroke(Stroke::dashed(INK, 0.8)).name("bounds of the boundary")
    });
    let names = [(0.0, shown(first)), (1.0, shown(second))];
    let ratio = summary.ratio().replace("n = ", "*n* = ");
    let panel = Panel::new(
        Axis::new(&ratio, "–").logarithmic().room(0.1),
        Axis::new("winner", "").between(-0.5, 1.5).ticks(names),
    )
    .height(90.0)
    .layers(bounds.collect::<Vec<_>>())
    .layer(points(first, true))
    .layer(points(second, true))
    .layer(points(first, false))
    .layer(points(second, false));
    Ok(Figure::new(
        "basin",
        match summary.of_modes {
            true => "What wins over the ratio, one point for each transient.",
            false => {
                "The wave that wins over the ratio of the amplitudes of both at the first stick or opening, one point for each transient."
            }
        },
    )
    .panel(panel))
}

fn runs_table(summary: &BasinSummary) -> ReportTable {
    let row = |(number, run): (usize, &RunSummary)| {
        vec![
            (number + 1).to_string(),
            significant(run.seed_ratio, 5),
            run.saturation_ratio.map_or(String::new(), |ratio| significant(ratio, 5)),
            match summary.of_modes {
                true => summary.name(run.winner),
                false => run.winner.to_string(),
            },
            if run.is_settled { "" } else { "not settled" }.to_owned(),
            significant(run.duration_s, 4),
        ]
    };
    ReportTable::new(
        "Transients in the order of the search",
        [
            "transient",
            "ratio of the seeds",
            "ratio at saturation",
            "winner n",
            "end",
            "simulated time (s)",
        ],
        summary.runs.iter().enumerate().map(row),
    )
}
