//! The closed curves of a contact node in its limit cycle: phase plots and path.

use super::colour::{INK, STATUSES, name_of_status};
use super::legend::{self, Key};
use super::node_cycle::NodeCycle;
use super::panel::{LABEL_SIZE, Panel, vertical_count};
use super::svg::{DOUBLE_COLUMN, Path, Rect, Stroke, Svg};
use super::time_stack::scaled;
use super::trajectories::{axis_for, draw_by_status, title, trace_colour};
use super::{FigureError, axis};
use crate::contact::ContactStatus;

/// Height of the panels, points.
const HEIGHT: f64 = 128.0;
/// Arrow heads along each curve.
const ARROWS: usize = 3;

/// Draws velocity over displacement, tangential and radial, and the node's path, coloured by status.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_node_orbit(data: &NodeCycle) -> Result<String, FigureError> {
    data.check()?;
    let [u_r, u_t] = data.displacement;
    let [v_r, v_t] = data.velocity;
    let mut svg = Svg::new("node-orbit", DOUBLE_COLUMN, 100.0);
    let tangential = ("displacement *u*_{θ}", u_t, "m");
    let radial = ("displacement *u*_{r}", u_r, "m");
    let speed = [data.peripheral_speed];
    let panels = [
        (
            "tangential",
            tangential,
            ("velocity *v*_{θ}", v_t, "m/s"),
            &speed[..],
        ),
        ("radial", radial, ("velocity *v*_{r}", v_r, "m/s"), &[]),
        ("path", tangential, ("displacement *u*_{r}", u_r, "m"), &[]),
    ];
    for (index, (name, x, y, levels)) in panels.into_iter().enumerate() {
        draw_loop(&mut svg, (index, name), x, y, levels, data.status);
    }
    let mut entries: Vec<(Key, String)> = STATUSES
        .iter()
        .map(|&status| {
            let key = Key::line(trace_colour(status));
            (key, name_of_status(status).to_string())
        })
        .collect();
    entries.push((Key::dashed(INK), "cylinder *Ωa*".into()));
    let y = 16.0 + HEIGHT + Panel::bottom_margin() + 2.0;
    legend::draw_legend(&mut svg, 42.0, y, DOUBLE_COLUMN - 50.0, &entries);
    svg.set_height(y + legend::legend_height(&entries, DOUBLE_COLUMN - 50.0) + 2.0);
    Ok(svg.finish(
        "Limit cycle of a contact node",
        "Velocity over displacement of a contact node, tangential and radial, and its path, coloured by contact status.",
    ))
}

/// Axis name, values, unit.
type Quantity<'a> = (&'a str, &'a [f64], &'a str);

fn draw_loop(
    svg: &mut Svg,
    (index, name): (usize, &str),
    x: Quantity<'_>,
    y: Quantity<'_>,
    levels: &[f64],
    status: &[ContactStatus],
) {
    let (scale_x, axis_x) = axis_for(x.0, x.1, x.2);
    let reach: Vec<f64> = y.1.iter().chain(levels).copied().collect();
    let (scale_y, axis_y) = axis_for(y.0, &reach, y.2);
    let area = Rect::new(42.0 + 169.0 * index as f64, 16.0, 119.0, HEIGHT);
    let mut panel = Panel::new(area, axis_x, axis_y);
    let ticks = panel.y.ticks(vertical_count(HEIGHT));
    panel.title_distance = Some(axis::widest(&ticks, LABEL_SIZE) + 9.0);
    panel.draw_ground(svg);
    for level in levels {
        panel.horizontal(svg, level * scale_y, &Stroke::dashed(INK, 0.8));
    }
    let closed = |values: &[f64], scale: f64| {
        let mut values = scaled(values, scale);
        values.push(values[0]);
        values
    };
    let (xs, ys) = (closed(x.1, scale_x), closed(y.1, scale_y));
    let status: Vec<ContactStatus> = status.iter().chain(&status[..1]).copied().collect();
    svg.begin_clip(&panel.area);
    draw_by_status(svg, &panel, (&xs, &ys), &status, 0);
    let points: Vec<(f64, f64)> = xs
        .iter()
        .zip(&ys)
        .map(|(&x, &y)| (panel.at_x(x), panel.at_y(y)))
        .collect();
    svg.fill_path(&arrow_heads(&points), INK, 1.0);
    svg.end_group();
    panel.draw_frame(svg);
    title(svg, &panel, index, name);
}

/// An arrow head on the longest step of each part of a closed curve: which way it is run through.
fn arrow_heads(points: &[(f64, f64)]) -> Path {
    let mut path = Path::new();
    let steps: Vec<[(f64, f64); 2]> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let length = |step: &[(f64, f64); 2]| (step[1].0 - step[0].0).hypot(step[1].1 - step[0].1);
    for part in steps.chunks(steps.len().div_ceil(ARROWS).max(1)) {
        let longest = part.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(step) = longest.filter(|step| length(step) > 0.0) else {
            continue;
        };
        let (dx, dy) = (
            (step[1].0 - step[0].0) / length(step),
            (step[1].1 - step[0].1) / length(step),
        );
        let (x, y) = (0.5 * (step[0].0 + step[1].0), 0.5 * (step[0].1 + step[1].1));
        let corner =
            |along: f64, across: f64| (x + along * dx - across * dy, y + along * dy + across * dx);
        path.extend([corner(3.2, 0.0), corner(-2.4, 2.1), corner(-2.4, -2.1)]);
        path.close();
    }
    path
}
