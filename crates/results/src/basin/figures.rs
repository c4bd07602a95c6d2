//! The figure of a search for the boundary between two basins.

use super::BasinSummary;
use frictionsim_chart::{Axis, Figure, INK, Marker, Panel, Points, Rule, SERIES, Stroke};
use frictionsim_physics::cycle::BasinRun;

/// The winner of each transient over the ratio of the amplitudes at the first stick or opening.
pub(super) fn search(summary: &BasinSummary) -> Figure {
    let [first, second] = summary.harmonics;
    let place = |run: &BasinRun| {
        let at = if run.winner == first { 0.0 } else { 1.0 };
        Some((run.saturation_ratio?, at))
    };
    let shown = |rival: usize| summary.name(rival).replace("n = ", "*n* = ");
    let wins = |rival: usize| format!("{} wins", shown(rival));
    let kinds = [
        (first, true, Marker::Disc, SERIES[0], wins(first)),
        (second, true, Marker::Square, SERIES[1], wins(second)),
        (first, false, Marker::Circle, INK, "not settled".to_owned()),
        (second, false, Marker::Circle, INK, "not settled".to_owned()),
    ];
    let points = kinds.map(|(winner, is_settled, marker, colour, name)| {
        let own = summary.runs.iter();
        let own = own.filter(|run| run.winner == winner && run.is_settled == is_settled);
        Points::new(own.filter_map(place)).marker(marker, 2.6, colour).name(name)
    });
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
    .layers(bounds)
    .layers(points);
    Figure::new(
        "basin",
        match summary.of_modes {
            true => "What wins over the ratio, one point for each transient.",
            false => {
                "The wave that wins over the ratio of the amplitudes of both at the first stick or \
                opening, one point for each transient."
            }
        },
    )
    .panel(panel)
}
