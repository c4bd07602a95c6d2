//! The contact at one instant of a limit cycle: status around the circle, tractions, velocity.

use super::axis::{Axis, extremes, prefixed};
use super::colour::{self, INK, SERIES};
use super::contact_status::{draw_status_ground, draw_status_ring, status_keys};
use super::legend::{self, Key};
use super::panel::Panel;
use super::prestress::{angle_axis, around, around_degrees};
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::text::{Anchor, TextStyle};
use super::{FigureError, expect_length, expect_some};
use crate::contact::ContactStatus;

/// State of every contact node at one instant.
#[derive(Clone, Debug)]
pub struct ContactState<'a> {
    /// Which instant or cycle, in mark-up.
    pub name: String,
    /// Angles, rad, rising and evenly spaced.
    pub angles: &'a [f64],
    /// Status.
    pub status: &'a [ContactStatus],
    /// Contact pressure, Pa.
    pub pressure: &'a [f64],
    /// Friction traction, Pa.
    pub shear: &'a [f64],
    /// Tangential velocity of the edge, m/s.
    pub tangential_velocity: &'a [f64],
    /// Peripheral speed of the cylinder, m/s.
    pub peripheral_speed: f64,
}

/// Draws the arcs of stick, slip and separation around the circle, and over the angle the tractions
/// and the velocity, on a ground coloured by status.
///
/// # Errors
/// [`FigureError`] if arrays do not fit together or are empty.
pub fn draw_contact_state(data: &ContactState) -> Result<String, FigureError> {
    let count = data.angles.len();
    expect_some("contact nodes", count)?;
    expect_length("contact status", data.status.len(), count)?;
    expect_length("contact pressure", data.pressure.len(), count)?;
    expect_length("contact shear", data.shear.len(), count)?;
    expect_length("tangential velocity", data.tangential_velocity.len(), count)?;
    let (top, height, gap) = (18.0, 78.0, 20.0);
    let mut svg = Svg::new("contact-state", DOUBLE_COLUMN, 100.0);
    let total = 2.0 * height + gap;
    draw_circle(&mut svg, top, total, data);
    draw_tractions(&mut svg, (top, height), data);
    draw_velocity(&mut svg, (top + height + gap, height), data);
    svg.set_height(top + total + Panel::bottom_margin());
    Ok(svg.finish(
        "State of the contact",
        "Arcs of stick, slip and separation around the circle; pressure, friction traction and \
         tangential velocity over the angle.",
    ))
}

fn draw_circle(svg: &mut Svg, top: f64, total: f64, data: &ContactState) {
    let radius = 70.0;
    let centre = (88.0, top + 0.5 * total);
    panel_letter(svg, 4.0, top - 4.0, 0);
    svg.text(20.0, top - 4.0, &data.name, &TextStyle::new(6.75));
    draw_status_ring(
        svg,
        centre,
        (0.74 * radius, radius),
        data.angles,
        data.status,
    );
    for degrees in [0.0f64, 90.0, 180.0, 270.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let place = (centre.0 + 0.6 * radius * cos, centre.1 - 0.6 * radius * sin);
        let style = TextStyle::new(6.75).anchored(Anchor::Middle);
        svg.text(place.0, place.1 + 2.4, &format!("{degrees}°"), &style);
    }
    let style = TextStyle::new(13.0).anchored(Anchor::Middle);
    svg.text(centre.0, centre.1 + 2.0, "↺", &style);
    let style = TextStyle::new(6.75).anchored(Anchor::Middle);
    svg.text(centre.0, centre.1 + 13.0, "rotor", &style);
    legend::draw_legend(svg, 26.0, top + total + 4.0, 200.0, &status_keys());
}

/// Each node colours half the way to its neighbours; the first one's part begins before angle zero.
fn ground(svg: &mut Svg, panel: &Panel, data: &ContactState) {
    let width = 360.0 / data.angles.len() as f64;
    let first = data.angles[0].to_degrees() - 0.5 * width;
    let around: Vec<ContactStatus> = data
        .status
        .iter()
        .chain(&data.status[..1])
        .copied()
        .collect();
    draw_status_ground(svg, panel, &around, |i| first + i as f64 * width);
}

fn right_panel((top, height): (f64, f64), y: Axis, last: bool) -> Panel {
    let area = Rect::new(220.0, top, DOUBLE_COLUMN - 232.0, height);
    let mut panel = Panel::new(area, angle_axis("angle *θ* (°)"), y).without_grid();
    panel.labels_x = last;
    panel.title_distance = Some(30.0);
    panel
}

fn draw_tractions(svg: &mut Svg, place: (f64, f64), data: &ContactState) {
    let (low, high) = extremes(data.pressure.iter().chain(data.shear).copied().chain([0.0]));
    let (factor, unit) = prefixed(high.max(-low), "Pa");
    let room = 0.08 * (high - low);
    let title = format!("traction ({unit})");
    let y = Axis::linear(&title, (low - room) * factor, (high + room) * factor);
    let panel = right_panel(place, y, false);
    ground(svg, &panel, data);
    let degrees = around_degrees(data.angles);
    for (values, colour) in [(data.pressure, INK), (data.shear, SERIES[1])] {
        let values = around(values, factor);
        panel.series(svg, &degrees, &values, &Stroke::solid(colour, 1.1));
    }
    panel.draw_frame(svg);
    panel_letter(svg, panel.area.x, panel.area.y - 4.0, 1);
    let keys = [
        (Key::line(INK), "pressure *p*".to_string()),
        (Key::line(SERIES[1]), "friction traction *τ*".into()),
    ];
    legend::draw_legend(svg, panel.area.x + 60.0, panel.area.y - 12.0, 220.0, &keys);
}

fn draw_velocity(svg: &mut Svg, place: (f64, f64), data: &ContactState) {
    let values = data.tangential_velocity.iter().copied();
    let y = Axis::around("velocity (m/s)", values.chain([data.peripheral_speed, 0.0]));
    let panel = right_panel(place, y, true);
    ground(svg, &panel, data);
    let stroke = Stroke::dashed(INK, 0.8);
    panel.horizontal(svg, data.peripheral_speed, &stroke);
    let degrees = around_degrees(data.angles);
    let stroke = Stroke::solid(colour::STICK, 1.1);
    let velocity = around(data.tangential_velocity, 1.0);
    panel.series(svg, &degrees, &velocity, &stroke);
    panel.draw_frame(svg);
    panel_letter(svg, panel.area.x, panel.area.y - 4.0, 2);
    let keys = [
        (Key::line(colour::STICK), "tangential *v*_{θ}".to_string()),
        (Key::dashed(INK), "cylinder *Ωa*".into()),
    ];
    legend::draw_legend(svg, panel.area.x + 60.0, panel.area.y - 12.0, 220.0, &keys);
}
