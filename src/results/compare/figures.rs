//! The curves of several reports over each other.

use super::ComparedRun;
use crate::chart::{
    Axis, ChartError, Figure, Line, Marker, Panel, PanelData, Points, Scale, SeriesKind, Stroke,
    literal, look,
};
use crate::results::drawing::{Declaration, DrawingOptions, draw_all};
use crate::results::report::{NamedFigure, ReadFigure, read_figures};

/// Most curves of one panel that are told apart.
const MOST_CURVES: usize = 24;

/// Each figure that several runs have, with the curves of all of them.
///
/// # Errors
/// That of a figure that cannot be drawn although there is something to draw.
pub fn overlaid(
    runs: &[ComparedRun],
    options: &DrawingOptions,
) -> Result<Vec<NamedFigure>, ChartError> {
    let pages: Vec<(&str, Vec<ReadFigure>)> = runs
        .iter()
        .map(|run| {
            (
                run.name.as_str(),
                run.page.as_deref().map(read_figures).unwrap_or_default(),
            )
        })
        .collect();
    let mut names: Vec<&str> = Vec::new();
    for figure in pages.iter().flat_map(|page| &page.1) {
        let count = pages
            .iter()
            .filter(|page| page.1.iter().any(|own| own.name == figure.name))
            .count();
        if count > 1 && !names.contains(&figure.name.as_str()) {
            names.push(&figure.name);
        }
    }
    let pages = &pages;
    let declarations = names.into_iter().map(|name| -> Declaration<'_> {
        Box::new(move || figure_of(name, pages).ok_or_else(|| ChartError::empty(name)))
    });
    draw_all(declarations.collect(), options)
}

/// A figure over all runs that have it; panels go together by their place, caption and axes.
fn figure_of(name: &str, pages: &[(&str, Vec<ReadFigure>)]) -> Option<Figure> {
    let own: Vec<(usize, &str, &ReadFigure)> = pages
        .iter()
        .enumerate()
        .filter_map(|(run, (title, figures))| {
            Some((run, *title, figures.iter().find(|f| f.name == name)?))
        })
        .collect();
    let first = own.first()?.2;
    let panels: Vec<Panel> = first
        .panels
        .iter()
        .enumerate()
        .filter_map(|(at, panel)| {
            let same = own.iter().filter_map(|(run, title, figure)| {
                let other = figure
                    .panels
                    .get(at)
                    .filter(|other| is_alike(other, panel))?;
                Some((*run, *title, other))
            });
            let same: Vec<_> = same.collect();
            (same.len() > 1).then(|| panel_of(panel, &same))
        })
        .collect();
    let runs: Vec<&str> = own.iter().map(|(_, title, _)| *title).collect();
    let caption = format!("{name} of {}.", runs.join(", "));
    let columns = if panels.len() > 2 { 2 } else { 1 };
    (!panels.is_empty()).then(|| Figure::new(name, caption).columns(columns).panels(panels))
}

fn is_alike(one: &PanelData, other: &PanelData) -> bool {
    let titles = |panel: &PanelData| panel.axes.clone().map(|axis| axis.title);
    titles(one) == titles(other) && !one.series.is_empty()
}

fn panel_of(panel: &PanelData, runs: &[(usize, &str, &PanelData)]) -> Panel {
    let axis = |k: usize| {
        let ends = runs.iter().map(|(_, _, own)| own.axes[k].ends);
        let ends = ends
            .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
            .unwrap_or([0.0, 1.0]);
        let scale = match panel.axes[k].is_logarithmic {
            true => Scale::Logarithmic,
            false => Scale::Linear,
        };
        Axis::new(&literal(&panel.axes[k].title), "")
            .scaled(scale)
            .between(ends[0], ends[1])
    };
    let mut out = Panel::new(axis(0), axis(1)).height(150.0).legend();
    if !panel.caption.is_empty() {
        out = out.caption(literal(&panel.caption));
    }
    for (run, title, own) in runs {
        let colour = look(*run).0;
        // Of many curves those with a name stand for all.
        let is_crowded = own.series.len() > MOST_CURVES;
        let curves = own
            .series
            .iter()
            .filter(|series| !is_crowded || !series.name.is_empty());
        for series in curves {
            let name = match series.name.as_str() {
                "" => literal(title),
                name => literal(&format!("{title}: {name}")),
            };
            let line = || Line::new(&series.xs, &series.ys).name(name.clone());
            out = match series.kind {
                SeriesKind::Line => out.layer(line().solid(colour, 0.8)),
                SeriesKind::Dashed => out.layer(line().stroke(Stroke::dashed(colour, 0.8))),
                SeriesKind::Points | SeriesKind::Field => {
                    let points = series.xs.iter().copied().zip(series.ys.iter().copied());
                    out.layer(
                        Points::new(points)
                            .marker(Marker::ALL[run % 5], 1.4, colour)
                            .name(name),
                    )
                }
            };
        }
    }
    out
}
