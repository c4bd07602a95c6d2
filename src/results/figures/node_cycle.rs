//! The motion of one contact node through its limit cycle, and what it goes through in time.

use super::axis::{Axis, extremes, prefixed};
use super::colour::{INK, MUTED, SERIES, STATUSES, name_of_status};
use super::contact_status::{draw_status_ground, pale};
use super::legend::{self, Key};
use super::panel::Panel;
use super::svg::{DOUBLE_COLUMN, Stroke, Svg};
use super::time_stack::TimeStack;
use super::trajectories::axis_for;
use super::{FigureError, expect_length, expect_some};
use crate::contact::ContactStatus;

/// One period of a contact node, evenly sampled from time zero; the last sample lies one interval before the first one
/// comes again.
#[derive(Clone, Copy, Debug)]
pub struct NodeCycle<'a> {
    /// Period, s.
    pub period: f64,
    /// Status.
    pub status: &'a [ContactStatus],
    /// Displacement `u_r, u_theta`, m.
    pub displacement: [&'a [f64]; 2],
    /// Velocity `v_r, v_theta`, m/s.
    pub velocity: [&'a [f64]; 2],
    /// Contact pressure, Pa.
    pub pressure: &'a [f64],
    /// Friction traction, Pa.
    pub shear: &'a [f64],
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Peripheral speed of the cylinder, m/s.
    pub peripheral_speed: f64,
}

impl NodeCycle<'_> {
    pub(super) fn check(&self) -> Result<(), FigureError> {
        let count = self.status.len();
        expect_some("contact status", count)?;
        let [u_r, u_t] = self.displacement;
        let [v_r, v_t] = self.velocity;
        for values in [u_r, u_t, v_r, v_t, self.pressure, self.shear] {
            expect_length("history of a contact node", values.len(), count)?;
        }
        Ok(())
    }
}

/// Periods shown.
const PERIODS: usize = 2;

/// Colour and name of a curve, and its values.
type Curve<'a> = (Key, &'static str, Vec<f64>);

/// Draws displacement, velocity and tractions of the node over two periods, on a ground coloured by status.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_node_cycle(data: &NodeCycle) -> Result<String, FigureError> {
    data.check()?;
    let left = 47.0;
    let mut svg = Svg::new("node-cycle", DOUBLE_COLUMN, 100.0);
    let range = (0.0, PERIODS as f64 * data.period);
    let mut stack = TimeStack::new(left, DOUBLE_COLUMN - left - 8.0, 26.0, range);
    let keys =
        STATUSES.map(|status| (Key::patch(pale(status)), name_of_status(status).to_string()));
    legend::draw_legend(&mut svg, left, 2.0, 200.0, &keys);
    for (component, name) in [(1, "tangential displacement"), (0, "radial displacement")] {
        let values = data.displacement[component];
        let (factor, y) = axis_for(["*u*_{r}", "*u*_{θ}"][component], values, "m");
        let panel = stack.push(y, 62.0, false);
        let curve = (Key::line(INK), "", repeated(values, factor));
        draw_curves(&mut svg, &panel, data, &stack, &[curve]);
        stack.caption(&mut svg, &panel, name);
    }
    draw_velocity(&mut svg, &mut stack, data);
    draw_tractions(&mut svg, &mut stack, data);
    svg.set_height(stack.bottom() + 2.0);
    Ok(svg.finish(
        "Limit cycle of a contact node over time",
        "Displacement, velocity and contact tractions of a contact node over two periods, the ground coloured by its \
         contact status.",
    ))
}

fn draw_velocity(svg: &mut Svg, stack: &mut TimeStack, data: &NodeCycle) {
    let [radial, tangential] = data.velocity;
    let all = radial.iter().chain(tangential).copied();
    let y = Axis::around("*v* (m/s)", all.chain([data.peripheral_speed]));
    let panel = stack.push(y, 78.0, false);
    let cylinder = vec![data.peripheral_speed; PERIODS * data.status.len() + 1];
    let curves = [
        (Key::dashed(INK), "cylinder *Ωa*", cylinder),
        (
            Key::line(SERIES[2]),
            "radial *v*_{r}",
            repeated(radial, 1.0),
        ),
        (
            Key::line(SERIES[0]),
            "tangential *v*_{θ}",
            repeated(tangential, 1.0),
        ),
    ];
    draw_curves(svg, &panel, data, stack, &curves);
    stack.caption(svg, &panel, "velocity");
}

fn draw_tractions(svg: &mut Svg, stack: &mut TimeStack, data: &NodeCycle) {
    let limit: Vec<f64> = data
        .pressure
        .iter()
        .map(|p| data.friction_coefficient * p)
        .collect();
    let opposite: Vec<f64> = limit.iter().map(|t| -t).collect();
    let (low, high) = extremes(data.pressure.iter().chain(&opposite).copied());
    let (factor, unit) = prefixed(high, "Pa");
    let room = 0.06 * (high - low);
    let title = format!("traction ({unit})");
    let y = Axis::linear(&title, (low - room) * factor, (high + room) * factor);
    let panel = stack.push(y, 90.0, true);
    let curves = [
        (
            Key::dashed(MUTED),
            "Coulomb limit ±*μp*",
            repeated(&limit, factor),
        ),
        (Key::dashed(MUTED), "", repeated(&opposite, factor)),
        (
            Key::line(INK),
            "pressure *p*",
            repeated(data.pressure, factor),
        ),
        (
            Key::line(SERIES[1]),
            "friction traction *τ*",
            repeated(data.shear, factor),
        ),
    ];
    draw_curves(svg, &panel, data, stack, &curves);
    stack.caption(svg, &panel, "tractions");
}

/// Values over all periods shown, times a factor, closed by the first one.
fn repeated(values: &[f64], factor: f64) -> Vec<f64> {
    let count = PERIODS * values.len() + 1;
    let cycle = values.iter().cycle().take(count);
    cycle.map(|value| value * factor).collect()
}

/// The curves on their ground, with a legend above the panel for those that have a name.
fn draw_curves(
    svg: &mut Svg,
    panel: &Panel,
    data: &NodeCycle,
    stack: &TimeStack,
    curves: &[Curve<'_>],
) {
    let count = data.status.len();
    let interval = data.period / count as f64 * stack.factor;
    let status: Vec<ContactStatus> = data
        .status
        .iter()
        .cycle()
        .take(PERIODS * count + 1)
        .copied()
        .collect();
    // A sample stands for half an interval on either side.
    draw_status_ground(svg, panel, &status, |i| (i as f64 - 0.5) * interval);
    let times: Vec<f64> = (0..=PERIODS * count).map(|i| i as f64 * interval).collect();
    svg.begin_clip(&panel.area);
    for (key, _, values) in curves {
        if let Key::Line(colour, width, dash) = key {
            let stroke = Stroke {
                colour,
                width: *width,
                dash,
                opacity: 1.0,
            };
            panel.series(svg, &times, values, &stroke);
        }
    }
    svg.end_group();
    panel.draw_frame(svg);
    let named = curves.iter().filter(|curve| !curve.1.is_empty());
    let entries: Vec<(Key, String)> = named
        .map(|(key, name, _)| (key.clone(), (*name).to_string()))
        .collect();
    let width = legend::legend_width(&entries);
    legend::draw_legend(
        svg,
        panel.area.right() - width,
        panel.area.y - 11.5,
        width,
        &entries,
    );
}
