//! The prestressed state: contact pressure and shear around the edge, von Mises stress.

use super::axis::{Axis, Tick, extremes, prefixed};
use super::colour::{ColourMap, SERIES};
use super::field::{FieldStyle, View, draw_field};
use super::legend;
use super::panel::Panel;
use super::raster;
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg, panel_letter};
use super::{FigureError, expect_length, expect_some};
use crate::mesh::Mesh2d;

/// Contact tractions and stress of steady sliding.
#[derive(Clone, Copy, Debug)]
pub struct PrestressedContact<'a> {
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// Angle of each contact node, rad, rising.
    pub angles: &'a [f64],
    /// Contact pressure at each contact node, Pa.
    pub pressure: &'a [f64],
    /// Friction traction at each contact node, Pa.
    pub shear: &'a [f64],
    /// Von Mises stress at each node of the mesh, Pa.
    pub von_mises: &'a [f64],
}

/// An axis of angles in degrees, a full turn.
pub(super) fn angle_axis(title: &str) -> Axis {
    let ticks = (0..=4)
        .map(|quarter| Tick {
            value: 90.0 * f64::from(quarter),
            label: format!("{}", 90 * quarter),
        })
        .collect();
    Axis::linear(title, 0.0, 360.0).with_ticks(ticks)
}

/// Angles in degrees, the first one again after a full turn.
pub(super) fn around_degrees(angles: &[f64]) -> Vec<f64> {
    let again = angles.first().map(|first| first.to_degrees() + 360.0);
    angles.iter().map(|a| a.to_degrees()).chain(again).collect()
}

/// Values times a factor, the first one again at the end.
pub(super) fn around(values: &[f64], factor: f64) -> Vec<f64> {
    let again = values.first();
    values.iter().chain(again).map(|v| v * factor).collect()
}

/// Draws pressure and shear over the angle, and the von Mises field.
///
/// # Errors
/// [`FigureError`] if the arrays do not fit together.
pub fn draw_prestress(data: &PrestressedContact) -> Result<String, FigureError> {
    expect_some("contact nodes", data.angles.len())?;
    expect_length("contact pressure", data.pressure.len(), data.angles.len())?;
    expect_length("contact shear", data.shear.len(), data.angles.len())?;
    let (top, height, gap, left) = (14.0, 86.0, 16.0, 42.0);
    let total = 2.0 * height + gap;
    let mut svg = Svg::new(
        "prestress",
        DOUBLE_COLUMN,
        top + total + Panel::bottom_margin(),
    );
    let reach = extremes(data.pressure.iter().chain(data.shear).map(|v| v.abs())).1;
    let (factor, unit) = prefixed(reach, "Pa");
    let degrees = around_degrees(data.angles);
    let curves = [("pressure *p*", data.pressure), ("shear *τ*", data.shear)];
    for (row, (name, values)) in curves.into_iter().enumerate() {
        let scaled = around(values, factor);
        let (low, high) = extremes(scaled.iter().copied().chain([0.0]));
        let room = 0.15 * (high - low);
        let title = format!("{name} ({unit})");
        let y = Axis::linear(
            &title,
            if low < 0.0 { low - room } else { 0.0 },
            high + room,
        );
        let area = Rect::new(left, top + row as f64 * (height + gap), 200.0, height);
        let mut panel = Panel::new(area, angle_axis("angle *θ* (°)"), y);
        panel.labels_x = row == 1;
        panel.draw_ground(&mut svg);
        let stroke = Stroke::solid(SERIES[row], 1.2);
        panel.series(&mut svg, &degrees, &scaled, &stroke);
        panel.draw_frame(&mut svg);
        panel_letter(&mut svg, left, area.y - 4.0, row);
    }
    let (low, high) = extremes(data.von_mises.iter().copied());
    let (factor, unit) = prefixed(high, "Pa");
    let rect = Rect::new(left + 222.0, top, total, total);
    let style = FieldStyle {
        range: (low, high),
        map: ColourMap::Viridis,
        pixels_per_point: 3.0,
        levels: raster::FINE,
        rays: 0,
    };
    let view = View::around(&data.mesh.nodes, 0.01);
    let (mesh, values) = (data.mesh, data.von_mises);
    draw_field(&mut svg, &rect, &view, mesh, &mesh.nodes, values, &style)?;
    panel_letter(&mut svg, rect.x, rect.y - 4.0, 2);
    let bar = Rect::new(rect.right() + 8.0, top + 24.0, 8.0, total - 48.0);
    let title = format!("von Mises stress ({unit})");
    let axis = Axis::linear(&title, low * factor, high * factor);
    legend::draw_colour_bar(&mut svg, &bar, &axis, style.map);
    Ok(svg.finish(
        "Prestressed sliding state",
        "Contact pressure and friction traction around the edge, and the von Mises stress field.",
    ))
}
