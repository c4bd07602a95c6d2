//! The figure of a fit.

use super::summary::{FitSummary, ModeSummary};
use crate::chart::{Axis, Figure, INK, MUTED, Marker, Panel, Points, Rule, Stroke};
use crate::results::charts::palette::{STABLE, UNSTABLE};

/// Growth rates of the modes over their frequency, before and after, with the measured lines; differences line by line.
pub fn fit(summary: &FitSummary) -> Figure {
    let points = |modes: &[ModeSummary], unstable: bool| {
        let own = modes.iter().filter(|mode| mode.is_unstable() == unstable);
        let own: Vec<(f64, f64)> = own.map(|mode| (mode.frequency_hz, mode.real_hz)).collect();
        Points::new(own)
    };
    let heard = summary.residuals.iter().filter(|line| line.real_hz.is_none());
    let rules = heard.map(|line| {
        Rule::vertical(line.frequency_hz)
            .stroke(Stroke::dashed(INK, 0.8))
            .name("measured frequency")
    });
    let complex = summary.residuals.iter();
    let complex: Vec<(f64, f64)> =
        complex.filter_map(|line| Some((line.frequency_hz, line.real_hz?))).collect();
    let highest = summary.residuals.iter().map(|line| line.frequency_hz);
    let highest = 1.1 * highest.fold(0.0_f64, f64::max);
    let lowest = summary.residuals.iter().map(|line| line.frequency_hz);
    let lowest = 0.8 * lowest.fold(highest, f64::min);
    let frequency = || Axis::kilohertz().between(lowest, highest);
    let plane = Panel::new(frequency(), Axis::new("growth Re *λ*/2π", "Hz"))
        .height(160.0)
        .layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6)))
        .layers(rules)
        .layer(Points::new(complex).marker(Marker::Square, 2.6, INK).name("measured"))
        .layer(
            points(&summary.modes_of_case, true)
                .marker(Marker::Triangle, 1.7, MUTED)
                .name("case as written, unstable"),
        )
        .layer(
            points(&summary.modes, false).marker(Marker::Disc, 1.5, STABLE).name("fitted, stable"),
        )
        .layer(
            points(&summary.modes, true)
                .marker(Marker::Disc, 2.0, UNSTABLE)
                .name("fitted, unstable"),
        );
    let frequencies =
        summary.residuals.iter().map(|line| (line.frequency_hz, line.difference_percent));
    let reals = summary.residuals.iter().filter_map(|line| {
        Some((line.frequency_hz, 100.0 * line.real_difference_hz? / line.frequency_hz))
    });
    let differences =
        Panel::new(frequency(), Axis::new("model – measured", "% of *f*").symmetric())
            .height(80.0)
            .layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6)))
            .layer(
                Points::new(frequencies.collect::<Vec<_>>())
                    .marker(Marker::Disc, 1.8, STABLE)
                    .name("difference of frequency"),
            )
            .layer(
                Points::new(reals.collect::<Vec<_>>())
                    .marker(Marker::Diamond, 1.6, UNSTABLE)
                    .name("difference of real part"),
            );
    let measured = match summary.residuals.iter().any(|line| line.real_hz.is_some()) {
        true => "measured eigenvalues",
        false => "measured frequencies",
    };
    Figure::new(
        "fit",
        format!(
            "Modes of the fitted model and {measured}: growth rate over frequency (a), differences line by line (b)."
        ),
    )
    .panel(plane)
    .panel(differences)
}
