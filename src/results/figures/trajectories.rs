//! Limit cycles: phase plot of a probe, trace of a contact node.

use super::axis::{Axis, extremes, prefixed};
use super::colour::{self, STATUSES};
use super::legend::{self, Key};
use super::panel::{Panel, vertical_count};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::text::TextStyle;
use super::time_stack::scaled;
use super::{FigureError, expect_length, expect_some};
use crate::contact::ContactStatus;

/// Colour of the part before the limit cycle.
const APPROACH: &str = "#9a9a9a";

/// Phase plot of one component of a probe.
#[derive(Clone, Debug)]
pub struct PhasePlot<'a> {
    /// What moves, in mark-up: `node 1641, radial`.
    pub name: String,
    /// Displacement, m.
    pub displacement: &'a [f64],
    /// Velocity, m/s.
    pub velocity: &'a [f64],
}

/// Path of a contact node.
#[derive(Clone, Debug)]
pub struct ContactTrace<'a> {
    /// Which node, in mark-up: `contact node 1621`.
    pub name: String,
    /// Tangential displacement, m.
    pub tangential: &'a [f64],
    /// Radial displacement, m.
    pub radial: &'a [f64],
    /// Status at each sample; without it the cycle is drawn in one colour.
    pub status: Option<&'a [ContactStatus]>,
}

/// Phase plot and contact trace of one run, on the same samples.
#[derive(Clone, Debug)]
pub struct Trajectories<'a> {
    /// Phase plot.
    pub phase: PhasePlot<'a>,
    /// Contact trace.
    pub trace: ContactTrace<'a>,
    /// First sample of the limit cycle, drawn strongly; what comes before is drawn lightly.
    pub cycle_start: usize,
    /// What that part is: a limit cycle, or only the end of the run.
    pub end_name: &'a str,
}

/// Draws the phase plot and the trace side by side.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_trajectories(data: &Trajectories) -> Result<String, FigureError> {
    let (phase, trace) = (&data.phase, &data.trace);
    expect_some("phase plot", phase.displacement.len())?;
    expect_some("contact trace", trace.radial.len())?;
    expect_length("velocity", phase.velocity.len(), phase.displacement.len())?;
    expect_length(
        "radial displacement",
        trace.radial.len(),
        trace.tangential.len(),
    )?;
    if let Some(status) = trace.status {
        expect_length("contact status", status.len(), trace.radial.len())?;
    }
    let height = 172.0;
    let mut svg = Svg::new("limit-cycles", DOUBLE_COLUMN, 100.0);
    draw_phase(&mut svg, height, data);
    draw_trace(&mut svg, height, data);
    let mut entries = vec![(Key::line(APPROACH), "before".to_string())];
    match trace.status {
        Some(_) => {
            entries.push((Key::line(colour::SERIES[1]), data.end_name.into()));
            for status in STATUSES {
                let name = colour::name_of_status(status).to_string();
                entries.push((Key::line(trace_colour(status)), name));
            }
        }
        None => entries.push((Key::line(colour::SERIES[1]), data.end_name.into())),
    }
    let y = 16.0 + height + Panel::bottom_margin() + 2.0;
    legend::draw_legend(&mut svg, 42.0, y, DOUBLE_COLUMN - 50.0, &entries);
    svg.set_height(y + legend::legend_height(&entries, DOUBLE_COLUMN - 50.0) + 2.0);
    Ok(svg.finish(
        "Limit cycles",
        "Phase plot of a probe, and the path of a contact node.",
    ))
}

/// Lines need a darker tone for open than areas do.
pub(super) fn trace_colour(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Open => "#000000",
        other => colour::of_status(other),
    }
}

pub(super) fn axis_for(name: &str, values: &[f64], unit: &str) -> (f64, Axis) {
    let (low, high) = extremes(values.iter().copied());
    let (factor, unit) = prefixed(low.abs().max(high.abs()), unit);
    let title = format!("{name} ({unit})");
    (factor, Axis::around(&title, [low * factor, high * factor]))
}

fn draw_phase(svg: &mut Svg, height: f64, data: &Trajectories) {
    let phase = &data.phase;
    let (scale_x, x) = axis_for("displacement *u*", phase.displacement, "m");
    // "mm/s" and "m/s" are both usual.
    let (scale_y, y) = axis_for("velocity *v*", phase.velocity, "m/s");
    let area = Rect::new(42.0, 16.0, 196.0, height);
    let mut panel = Panel::new(area, x, y);
    panel.title_distance = Some(33.0);
    panel.draw_ground(svg);
    let xs = scaled(phase.displacement, scale_x);
    let ys = scaled(phase.velocity, scale_y);
    let start = data.cycle_start.min(xs.len());
    let (thin, thick) = (
        Stroke::solid(APPROACH, 0.3),
        Stroke::solid(colour::SERIES[1], 0.8),
    );
    svg.begin_clip(&panel.area);
    panel.curve(svg, &xs[..start], &ys[..start], &thin);
    panel.curve(svg, &xs[start..], &ys[start..], &thick);
    svg.end_group();
    panel.draw_frame(svg);
    title(svg, &panel, 0, &phase.name);
}

pub(super) fn title(svg: &mut Svg, panel: &Panel, index: usize, name: &str) {
    let baseline = panel.area.y - 4.0;
    panel_letter(svg, panel.area.x, baseline, index);
    svg.text(panel.area.x + 16.0, baseline, name, &TextStyle::new(6.75));
}

fn draw_trace(svg: &mut Svg, height: f64, data: &Trajectories) {
    let trace = &data.trace;
    let (scale_x, x) = axis_for("tangential *u*_{θ}", trace.tangential, "m");
    let (scale_y, y) = axis_for("radial *u*_{r}", trace.radial, "m");
    let area = Rect::new(300.0, 16.0, 196.0, height);
    let mut panel = Panel::new(area, x, y);
    let ticks = panel.y.ticks(vertical_count(height));
    panel.title_distance = Some(super::axis::widest(&ticks, 6.75) + 9.0);
    panel.draw_ground(svg);
    let xs = scaled(trace.tangential, scale_x);
    let ys = scaled(trace.radial, scale_y);
    let start = data.cycle_start.min(xs.len());
    svg.begin_clip(&panel.area);
    let thin = Stroke::solid(APPROACH, 0.3);
    panel.curve(svg, &xs[..start], &ys[..start], &thin);
    match trace.status {
        None => {
            let stroke = Stroke::solid(colour::SERIES[1], 0.8);
            panel.curve(svg, &xs[start..], &ys[start..], &stroke);
        }
        Some(status) => draw_by_status(svg, &panel, (&xs, &ys), status, start),
    }
    svg.end_group();
    panel.draw_frame(svg);
    title(svg, &panel, 1, &trace.name);
}

/// One path for each status: the pieces of the curve that start in it.
pub(super) fn draw_by_status(
    svg: &mut Svg,
    panel: &Panel,
    (xs, ys): (&[f64], &[f64]),
    status: &[ContactStatus],
    start: usize,
) {
    for wanted in [
        ContactStatus::Slip,
        ContactStatus::Stick,
        ContactStatus::Open,
    ] {
        let mut pieces = super::svg::Path::new();
        let mut from = start;
        while from < xs.len() {
            let mut to = from + 1;
            while to < xs.len() && status[to] == status[from] {
                to += 1;
            }
            if status[from] == wanted {
                // One sample further, so that pieces join.
                let end = (to + 1).min(xs.len());
                let points: Vec<(f64, f64)> = (from..end)
                    .map(|i| (panel.at_x(xs[i]), panel.at_y(ys[i])))
                    .collect();
                pieces.extend(super::decimation::simplify(&points, 0.05));
            }
            from = to;
        }
        // On the cylinder the node sticks one way and slips back over the same line.
        let width = match wanted {
            ContactStatus::Slip => 1.8,
            ContactStatus::Stick | ContactStatus::Open => 0.8,
        };
        svg.path(&pieces, &Stroke::solid(trace_colour(wanted), width));
    }
}
