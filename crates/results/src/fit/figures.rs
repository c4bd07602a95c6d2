//! The figure of a fit.

use super::summary::{FitSummary, ModeSummary};
use crate::charts::palette::{STABLE, UNSTABLE};
use frictionsim_chart::{Axis, Figure, INK, MUTED, Marker, Panel, Points, Rule, SERIES, Stroke};

/// Growth rates of the modes over their frequency, before and after, with the measured lines; differences line by line.
pub fn fit(summary: &FitSummary) -> Figure {
    let lines = || summary.residuals.iter();
    let points = |modes: &[ModeSummary], unstable: bool| {
        let own = modes.iter().filter(|mode| mode.is_unstable() == unstable);
        Points::new(own.map(|mode| (mode.frequency_hz, mode.real_hz)))
    };
    let heard = lines().filter(|line| line.real_hz.is_none());
    let rules = heard.map(|line| {
        let rule = Rule::vertical(line.frequency_hz).stroke(Stroke::dashed(INK, 0.8));
        rule.name("measured frequency")
    });
    let complex = Points::new(lines().filter_map(|line| Some((line.frequency_hz, line.real_hz?))));
    let highest = 1.1 * lines().map(|line| line.frequency_hz).fold(0.0_f64, f64::max);
    let lowest = 0.8 * lines().map(|line| line.frequency_hz).fold(highest, f64::min);
    let over_frequency = |y: Axis, height: f64| {
        let zero = Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6));
        Panel::new(Axis::kilohertz().between(lowest, highest), y)
            .height(height)
            .layer(zero)
            .legend()
    };
    let as_written = points(&summary.modes_of_case, true).marker(Marker::Triangle, 1.7, MUTED);
    let stable = points(&summary.modes, false).marker(Marker::Disc, 1.5, STABLE);
    let unstable = points(&summary.modes, true).marker(Marker::Disc, 2.0, UNSTABLE);
    let plane = over_frequency(Axis::new("growth Re *λ*/2π", "Hz"), 160.0)
        .layers(rules)
        .layer(complex.marker(Marker::Square, 2.6, INK).name("measured"))
        .layer(as_written.name("case as written, unstable"))
        .layer(stable.name("fitted model, stable"))
        .layer(unstable.name("fitted model, unstable"));
    let frequencies = Points::new(lines().map(|line| (line.frequency_hz, line.difference_percent)));
    let frequencies = frequencies.marker(Marker::Disc, 1.8, SERIES[2]);
    let reals = Points::new(lines().filter_map(|line| {
        Some((line.frequency_hz, 100.0 * line.real_difference_hz? / line.frequency_hz))
    }));
    let reals = reals.marker(Marker::Diamond, 1.6, SERIES[3]);
    let differences = over_frequency(Axis::new("model – measured", "% of *f*").symmetric(), 80.0)
        .layer(frequencies.name("frequency"))
        .layer(reals.name("real part"));
    let measured = match lines().any(|line| line.real_hz.is_some()) {
        true => "measured eigenvalues",
        false => "measured frequencies",
    };
    let caption = format!(
        "Modes of the fitted model and {measured}: growth rate over frequency (a), differences \
         line by line (b)."
    );
    Figure::new("fit", caption).panel(plane).panel(differences)
}
