//! The figures of an uncertainty analysis.

use super::{DesignCurve, Index, RobustSummary, UncertaintySummary};
use crate::common::*;

/// Distribution of critical friction, probability of squeal over friction, indices.
pub fn uncertainty(summary: &UncertaintySummary) -> Figure {
    let largest = shown_friction(summary);
    let friction = || Axis::friction().between(0.0, largest);
    let share = |name: &str| Axis::new(name, "–").between(0.0, 1.0);
    let families = summary.families.iter().take(5).enumerate().map(|(index, family)| {
        let quantiles = family.critical_friction_percentiles.iter().enumerate();
        let points = quantiles.filter_map(|(k, value)| Some(((*value)?, 0.01 * (k + 1) as f64)));
        Line::through(points.collect::<Vec<_>>())
            .stroke(Stroke::solid(look(index + 1).0, 0.9))
            .name(family.name().replace("n =", "*n* ="))
    });
    let own = || {
        summary.friction_coefficient.map(|friction| {
            Rule::vertical(friction).stroke(Stroke::dashed(INK, 0.8)).name("friction of the case")
        })
    };
    let (value, bounds, interval) = probability(&summary.probability_over_friction);
    let panel = |name: &str| Panel::new(friction(), share(name)).height(150.0).legend();
    let distribution = panel("share unstable below *μ*").layers(own()).layers(families);
    let probability = panel("probability of squeal").layer(interval).layers(bounds);
    let probability = probability.layers(own()).layer(value.name("some mode unstable"));
    let caption = "Distribution of the critical friction of each family of modes (a), probability of squeal \
                   over the friction coefficient (b).";
    Figure::new("uncertainty", caption).columns(2).panel(distribution).panel(probability)
}

/// A probability over its abscissa, and its interval between its bounds.
fn probability(points: &[[f64; 4]]) -> (Line, [Line; 2], Fill) {
    let [at, value, low, high] =
        [0, 1, 2, 3].map(|k| points.iter().map(|row| row[k]).collect::<Vec<f64>>());
    let interval = Fill::between(&at, &low, &high, SERIES[0]).opacity(0.25);
    let bounds =
        [low, high].map(|y| Line::new(&at, &y).solid(SERIES[0], 0.3).name("95 % interval"));
    (Line::new(&at, &value).solid(SERIES[0], 1.2), bounds, interval)
}

/// The friction coefficient up to which something happens, with a little room: onsets of families, changes of the
/// probability, the case's own friction.
fn shown_friction(summary: &UncertaintySummary) -> f64 {
    let onsets = summary.families.iter().flat_map(|family| &family.critical_friction_percentiles);
    let over = &summary.probability_over_friction;
    let last = over.last().map_or(0.0, |row| row[1]);
    let changes = over.iter().filter(|row| row[1] != last).map(|row| row[0]);
    let happens = onsets.filter_map(|onset| *onset).chain(changes);
    let reach = happens.fold(summary.friction_coefficient.unwrap_or(0.0), f64::max);
    (1.15 * reach).min(summary.largest_friction)
}

/// Sobol's indices of the lowest critical friction.
pub fn indices(summary: &UncertaintySummary) -> Figure {
    // The largest above.
    let rows = sorted(&summary.sobol, |a| a.1.total);
    let bars = |of: fn(&Index) -> f64, shift: f64, colour: &str| {
        let bar = |(k, row): (usize, &(&String, &Index))| {
            (0.0, of(row.1).max(0.0), k as f64 + shift, String::new())
        };
        Bars::new(rows.iter().enumerate().map(bar).collect(), colour)
    };
    let whiskers = rows.iter().enumerate().flat_map(|(k, (_, index))| {
        let ends = [(index.first_interval, -0.17), (index.total_interval, 0.17)];
        ends.into_iter().filter_map(move |(interval, shift)| {
            let [low, high] = interval?.map(|end| end.max(0.0));
            let at = k as f64 + shift;
            Some(Line::through([(low, at), (high, at)]).solid(INK, 0.7))
        })
    });
    let names = rows.iter().enumerate().map(|(k, (key, _))| (k as f64, parameter_name(key)));
    let largest = rows.iter().flat_map(|(_, own)| {
        let ends = [own.first_interval, own.total_interval].into_iter().flatten();
        ends.map(|[_, high]| high).chain([own.total, own.first])
    });
    let largest = largest.fold(1.0, f64::max);
    let y = Axis::new("", "").between(-0.6, rows.len() as f64 - 0.4).ticks(names);
    let panel = Panel::new(Axis::new("Sobol index", "–").between(0.0, largest), y)
        .height(34.0 * rows.len() as f64 + 12.0)
        .layer(bars(|index| index.total, 0.17, SERIES[5]))
        .layer(bars(|index| index.first, -0.17, SERIES[0]))
        .layers(whiskers);
    let caption = "Sobol's indices of the lowest critical friction. Dark: the share of its variance that goes if the \
                   parameter is known (first order). Light: the share that stays if all others are known (total).";
    let note = "dark: first order; light: total; lines: 95 % intervals";
    Figure::new("indices", caption).note(note).panel(panel)
}

/// Probability of squeal over each design parameter.
pub fn robust(summary: &RobustSummary) -> Figure {
    let panel = |curve: &DesignCurve| {
        let (value, bounds, interval) = probability(&curve.points);
        let bound = Rule::horizontal(summary.bound).stroke(Stroke::dashed(INK, 0.8));
        let share = Axis::new("probability of squeal", "–").between(0.0, 1.0);
        let panel = Panel::new(parameter_axis(&curve.key), share)
            .height(130.0)
            .layer(interval)
            .layers(bounds)
            .layer(value.marked(Marker::Disc, 1.5))
            .layer(bound.name("bound"));
        let own = curve.own.map(|own| {
            Rule::vertical(own).stroke(Stroke::dotted(INK, 0.8)).name("case as written")
        });
        let reached = curve.reaches_bound_at.map(|value| (value, summary.bound));
        let reached = reached.map(|place| Label::new(place, "reached").moved(3.0, -4.0));
        panel.layers(own).layers(reached)
    };
    let caption = "Probability of squeal at the friction coefficient of the case over each design parameter, \
                   the uncertain parameters scattering as stated.";
    let columns = summary.curves.len().min(2);
    Figure::new("robust", caption).columns(columns).panels(summary.curves.iter().map(panel))
}
