//! The figure of a convergence study.

use super::{Quantity, Refinement, Series};
use crate::distinct;
use frictionsim_chart::{Axis, Figure, Line, MUTED, Panel, Points, Rule, Stroke, look};

/// For each series the change of every quantity from level to level, relative to its size, over the resolution; and the
/// orders that the three finest levels show.
pub(super) fn convergence(series: &[Series]) -> Figure {
    let panels = series.iter().flat_map(|series| [changes(series), orders(series)]);
    Figure::new(
        "convergence",
        "Relative change of every quantity from each level to the next (left). Observed orders of \
         convergence from the three finest levels (right), for each study.",
    )
    .columns(2)
    .panels(panels)
    .note("dotted: whole orders; a quantity whose changes do not fall has no order, and none is shown")
}

fn changes(series: &Series) -> Panel {
    let groups = groups(series);
    let size = match series.refinement {
        Refinement::Mesh => Axis::new("element size", "m"),
        Refinement::TimeStep => Axis::new("time step", "s"),
    };
    let lines = series.quantities.iter().filter_map(|quantity| {
        let values = quantity.values.iter().map(|value| value.unwrap_or(f64::NAN));
        let values: Vec<f64> = values.collect();
        let largest = values.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let index = groups.iter().position(|group| *group == group_of(quantity))?;
        let pairs = series.sizes.iter().zip(values.windows(2));
        let changes = pairs.map(|(&size, pair)| (size, (pair[1] - pair[0]).abs() / largest));
        let line = Line::through(changes.filter(|(_, change)| *change > 0.0));
        Some(line.solid(look(index).0, 0.6).marked(look(index).1, 1.2).name(groups[index]))
    });
    Panel::new(size.prefixed().logarithmic(), Axis::new("relative change", "–").decades(10.0))
        .height(130.0)
        .caption(series.heading())
        .legend()
        .layers(lines)
}

fn orders(series: &Series) -> Panel {
    let groups = groups(series);
    let count = groups.len();
    let row = |index: usize| (count - index) as f64 - 0.5;
    let names = groups.iter().enumerate().map(|(index, group)| (row(index), (*group).to_owned()));
    let y = Axis::new("", "").between(0.0, count.max(1) as f64).ticks(names);
    let points = groups.iter().enumerate().map(|(index, group)| {
        let all = series.quantities.iter().filter(|q| group_of(q) == *group);
        let own: Vec<f64> = all.filter_map(|q| q.order).collect();
        // Side by side within the row, in the order of the list.
        let place = |k: usize| row(index) + 0.6 * (0.5 - (k as f64 + 0.5) / own.len() as f64);
        let points: Vec<(f64, f64)> =
            own.iter().enumerate().map(|(k, &order)| (order, place(k))).collect();
        Points::new(points).marker(look(index).1, 1.6, look(index).0)
    });
    let rules =
        [1.0, 2.0, 3.0, 4.0].map(|order| Rule::vertical(order).stroke(Stroke::dotted(MUTED, 0.6)));
    Panel::new(Axis::new("observed order", "–").including(0.0).including(2.5), y)
        .height(130.0)
        .layers(rules)
        .layers(points)
}

/// What quantities have in common: the same property of several modes, else the same unit.
fn group_of(quantity: &Quantity) -> &str {
    match (quantity.name.split_once(", "), quantity.unit.as_str()) {
        (Some((property, _)), _) => property,
        (None, "Hz") => "frequency",
        (None, "W") => "power",
        (None, _) => "fractions and shares",
    }
}

fn groups(series: &Series) -> Vec<&str> {
    distinct(series.quantities.iter().map(group_of))
}
