//! The curves of several reports over each other.

use super::ComparedRun;
use crate::common::*;
use frictionsim_chart::Series;

/// Most curves of one panel that are told apart.
const MOST_CURVES: usize = 24;

/// The curves and points of a figure of one run.
struct Curves<'a> {
    /// Place and name of the run.
    run: usize,
    title: &'a str,
    name: &'a str,
    panels: Vec<PanelData>,
}

/// Each figure that several runs have, with the curves of all of them.
pub fn overlaid(runs: &[ComparedRun]) -> Vec<Figure> {
    let is_curve = |series: &Series| series.kind != SeriesKind::Field;
    let figures = runs.iter().enumerate().flat_map(|(run, own)| {
        own.page.iter().flat_map(|page| &page.figures).map(move |figure| {
            let mut panels = figure.numbers();
            panels.iter_mut().for_each(|panel| panel.series.retain(is_curve));
            Curves { run, title: &own.name, name: &figure.name, panels }
        })
    });
    let figures: &Vec<Curves<'_>> = &figures.collect();
    let names = distinct(figures.iter().map(|own| own.name)).into_iter();
    let shared = names.filter(|name| figures.iter().filter(|own| own.name == *name).count() > 1);
    let declarations =
        shared.map(|name| -> Declaration<'_> { Box::new(move || figure_of(name, figures)) });
    declared(declarations.collect())
}

/// A figure over all runs that have it; panels go together by their place, caption and axes.
fn figure_of(name: &str, figures: &[Curves<'_>]) -> Option<Figure> {
    let own: Vec<&Curves<'_>> = figures.iter().filter(|own| own.name == name).collect();
    let panels: Vec<Panel> = own
        .first()?
        .panels
        .iter()
        .enumerate()
        .filter_map(|(at, panel)| {
            let others = own.iter().filter_map(|figure| {
                let other = figure.panels.get(at).filter(|other| is_alike(other, panel))?;
                Some((figure.run, figure.title, in_units_of(other.clone(), panel)))
            });
            let same: Vec<_> = others.collect();
            (same.len() > 1).then(|| panel_of(panel, &same))
        })
        .collect();
    let runs: Vec<&str> = own.iter().map(|figure| figure.title).collect();
    let curves = |figure: &&Curves<'_>| figure.panels.iter().filter(|own| has_curves(own)).count();
    let left_out = match own.iter().map(curves).max() {
        Some(most) if most > panels.len() => " Panels of what not all runs have are left out.",
        _ => "",
    };
    let caption = format!("{name} of {}.{left_out}", runs.join(", "));
    let columns = if panels.len() > 2 { 2 } else { 1 };
    (!panels.is_empty()).then(|| Figure::new(name, caption).columns(columns).panels(panels))
}

/// A panel with the prefixes of units that another like it has: MPa for kPa.
fn in_units_of(mut own: PanelData, other: &PanelData) -> PanelData {
    for (k, (axis, wanted)) in own.axes.iter_mut().zip(&other.axes).enumerate() {
        let ratio = wanted.shown(1.0) / axis.shown(1.0);
        (axis.low, axis.high) = (ratio * axis.low, ratio * axis.high);
        for series in &mut own.series {
            let values = if k == 0 { &mut series.xs } else { &mut series.ys };
            values.iter_mut().for_each(|value| *value *= ratio);
        }
    }
    own
}

/// Whether curves can be laid over it: of the drawing of a body outlines alone say nothing.
fn has_curves(own: &PanelData) -> bool {
    !own.series.is_empty() && own.axes.iter().any(|own| !own.declared.is_empty())
}

fn is_alike(one: &PanelData, other: &PanelData) -> bool {
    let axes = |own: &PanelData| own.axes.clone().map(|own| (own.declared, own.fixed_ticks));
    axes(one) == axes(other) && has_curves(one)
}

fn panel_of(panel: &PanelData, runs: &[(usize, &str, PanelData)]) -> Panel {
    let ends = [0, 1].map(|k| {
        let ends = runs.iter().map(|(_, _, own)| (own.axes[k].low, own.axes[k].high));
        ends.fold((f64::INFINITY, -f64::INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)))
    });
    let axis = |k: usize| {
        let (ruler, (low, high)) = (&panel.axes[k], ends[k]);
        let axis = Axis::new(&ruler.title, "");
        let axis = axis.scaled(ruler.scale).between(low, high);
        match &ruler.fixed_ticks {
            Some(ticks) => axis.ticks(ticks.iter().map(|own| (own.value, own.label.clone()))),
            None => axis,
        }
    };
    let place = (ends[0].0, ends[1].0); // Of keys, in the panel, as legends name what is seen.
    // What is said of the panels of all runs; frequencies and the like are those of one.
    let is_shared = |(i, part): &(usize, &str)| {
        runs.iter().all(|(_, _, own)| own.caption.split(", ").nth(*i) == Some(part))
    };
    let caption = panel.caption.split(", ").enumerate().take_while(is_shared);
    let caption: Vec<&str> = caption.map(|(_, part)| part).collect();
    let out = Panel::new(axis(0), axis(1)).height(150.0).legend();
    let mut out = out.caption(literal(&caption.join(", ")));
    // Colours tell the runs apart; dashes and markers the series of one run, as many of them as have a name.
    let is_line = |series: &Series| matches!(series.kind, SeriesKind::Line | SeriesKind::Dashed);
    let names = |of_lines: bool| {
        let all = runs.iter().flat_map(|(_, _, own)| &own.series);
        let own = all.filter(|series| is_line(series) == of_lines && !series.name.is_empty());
        distinct(own.map(|series| series.name.as_str()))
    };
    let (lines, points) = (names(true), names(false));
    for (run, title, own) in runs {
        let colour = look(*run).0;
        // Of many curves those with a name stand for all.
        let is_crowded = own.series.len() > MOST_CURVES;
        let curves = own.series.iter().filter(|series| !is_crowded || !series.name.is_empty());
        for series in curves {
            let places = || series.xs.iter().copied().zip(series.ys.iter().copied());
            let label = match series.name.as_str() {
                "" => literal(title),
                name => format!("{}: {}", literal(title), literal(name)),
            };
            let number = |names: &[&str]| names.iter().position(|name| *name == series.name);
            out = match series.kind {
                SeriesKind::Line | SeriesKind::Dashed => {
                    let dash = line_dash(series.kind, number(&lines).unwrap_or(0));
                    let stroke = Stroke::solid(colour, 0.8).dashes(dash);
                    out.layer(Line::through(places()).stroke(stroke).label(label))
                }
                SeriesKind::Points | SeriesKind::Field => {
                    let marker = point_marker(number(&points).unwrap_or(0));
                    out.layer(Points::new(places()).marker(marker, 1.4, colour).label(label))
                }
            };
        }
        let key = Line::through([place; 2]).solid(colour, 0.0);
        out = out.layer(key.name(literal(title)));
    }
    out.layers(series_keys(runs, place, [&lines, &points]))
}

/// Dashes of the `number`-th named line of a run.
fn line_dash(kind: SeriesKind, number: usize) -> &'static [f64] {
    const DASHES: [&[f64]; 6] =
        [&[], &[1.2, 1.2], &[5.0, 1.5], &[5.0, 1.5, 1.2, 1.5], &[9.0, 3.0], &[1.2, 3.0]];
    if kind == SeriesKind::Dashed { &[3.0, 2.0] } else { DASHES[number % DASHES.len()] }
}

/// Marker of the `number`-th named set of points of a run: the first is hollow, so that others stand out of it.
fn point_marker(number: usize) -> Marker {
    [Marker::Circle, Marker::Diamond, Marker::Triangle, Marker::Square][number % 4]
}

/// Legend entries of the series, in ink: what dashes and markers mean in every run.
fn series_keys(
    runs: &[(usize, &str, PanelData)],
    place: (f64, f64),
    [lines, points]: [&[&str]; 2],
) -> Vec<Points> {
    let series = || runs.iter().flat_map(|(_, _, own)| &own.series);
    let key = |name: &&str| {
        let own = series().find(|series| series.name == **name)?;
        let number = |names: &[&str]| names.iter().position(|known| known == name);
        let keyed = Points::new([place]).name(literal(name));
        Some(match number(points) {
            Some(number) => keyed.marker(point_marker(number), 0.01, INK),
            None => {
                let dash = line_dash(own.kind, number(lines).unwrap_or(0));
                keyed.marker(Marker::Circle, 0.01, INK).keyed(Stroke::solid(INK, 0.8).dashes(dash))
            }
        })
    };
    // Lines of one kind need no entry of their own.
    let lines = lines.iter().filter(|_| lines.len() > 1);
    points.iter().chain(lines).filter_map(key).collect()
}
