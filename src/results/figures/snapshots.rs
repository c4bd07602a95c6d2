//! Fields at several times (or of several runs), with the contact status around the hole.

use super::axis::{Axis, extremes, signed};
use super::colour::ColourMap;
use super::contact_status::{draw_status_ring, status_keys};
use super::field::{FieldStyle, View, draw_field};
use super::legend;
use super::raster;
use super::svg::{DOUBLE_COLUMN, Rect, Svg, panel_letter};
use super::text::{Anchor, TextStyle};
use super::{FigureError, expect_length, expect_some};
use crate::contact::ContactStatus;
use crate::mesh::Mesh2d;

/// One field.
#[derive(Clone, Debug)]
pub struct Snapshot<'a> {
    /// Caption in mark-up, such as [`Snapshot::at_time`] makes.
    pub caption: String,
    /// Value at each node, in the unit of the figure.
    pub values: &'a [f64],
    /// Status of each node of the contact edge.
    pub status: Option<&'a [ContactStatus]>,
}

impl<'a> Snapshot<'a> {
    /// A field at a time (s).
    pub fn at_time(time: f64, values: &'a [f64], status: Option<&'a [ContactStatus]>) -> Self {
        Self {
            caption: format!("*t* = {} ms", signed(time * 1e3, 2)),
            values,
            status,
        }
    }
}

/// Fields of one quantity over one mesh.
#[derive(Clone, Debug)]
pub struct Snapshots<'a> {
    /// Short ASCII name of the drawing, such as `velocity-snapshots`.
    pub name: &'a str,
    /// Quantity and unit in mark-up.
    pub quantity: String,
    /// Whether values are signed: a diverging map, symmetric about zero.
    pub signed: bool,
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// The fields in order.
    pub frames: Vec<Snapshot<'a>>,
}

/// Draws the fields side by side, each with its own colour bar, as amplitudes may differ by decades.
///
/// # Errors
/// [`FigureError`] if there is no field or arrays do not fit the mesh.
pub fn draw_snapshots(data: &Snapshots) -> Result<String, FigureError> {
    expect_some("snapshots", data.frames.len())?;
    const GAP: f64 = 10.0;
    let columns = data.frames.len().clamp(2, 4);
    let columns = if data.frames.len() == 5 || data.frames.len() == 6 {
        3
    } else {
        columns
    };
    let side = ((DOUBLE_COLUMN - GAP) / columns as f64 - GAP).min(165.0);
    let row_height = 14.0 + side + 6.0 + legend::flat_colour_bar_height(5.0) + 6.0;
    let indent = 0.5 * (DOUBLE_COLUMN - columns as f64 * (side + GAP) + GAP);
    let rows = data.frames.len().div_ceil(columns);
    let with_status = data.frames.iter().any(|frame| frame.status.is_some());
    let mut svg = Svg::new(data.name, DOUBLE_COLUMN, 100.0);
    for (index, frame) in data.frames.iter().enumerate() {
        let x = indent + (index % columns) as f64 * (side + GAP);
        let y = 4.0 + (index / columns) as f64 * row_height;
        panel_letter(&mut svg, x, y + 7.0, index);
        let style = TextStyle::new(7.5).anchored(Anchor::Middle);
        svg.text(x + 0.5 * side, y + 7.0, &frame.caption, &style);
        let rect = Rect::new(x, y + 13.0, side, side);
        draw_frame(&mut svg, &rect, data, frame)?;
    }
    let mut bottom = 4.0 + rows as f64 * row_height;
    if with_status {
        let style = TextStyle::new(6.75);
        svg.text(
            indent,
            bottom + 7.4,
            "contact status, ring at the inner edge:",
            &style,
        );
        let keys = status_keys();
        legend::draw_legend(&mut svg, indent + 146.0, bottom, 200.0, &keys);
        bottom += 13.0;
    }
    svg.set_height(bottom);
    Ok(svg.finish(
        &format!("Fields of {}", data.quantity),
        "One disc for each time or run, coloured by the field, each with its own colour bar.",
    ))
}

fn draw_frame(
    svg: &mut Svg,
    rect: &Rect,
    data: &Snapshots,
    frame: &Snapshot,
) -> Result<(), FigureError> {
    let (low, high) = extremes(frame.values.iter().copied());
    let (range, map) = if data.signed {
        let reach = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
        ((-reach, reach), ColourMap::Diverging)
    } else {
        // A body at rest has a scale all the same.
        let top = if high > low.min(0.0) { high } else { 1.0 };
        ((low.min(0.0), top), ColourMap::Viridis)
    };
    let style = FieldStyle {
        range,
        map,
        pixels_per_point: 3.0,
        levels: raster::FINE,
        rays: 0,
    };
    let view = View::around(&data.mesh.nodes, 0.01);
    let mesh = data.mesh;
    draw_field(svg, rect, &view, mesh, &mesh.nodes, frame.values, &style)?;
    if let Some(status) = frame.status {
        let edge = &mesh.inner_edge.nodes;
        expect_length("contact status", status.len(), edge.len())?;
        let angles: Vec<f64> = edge
            .iter()
            .map(|&node| mesh.frame_angles[node as usize])
            .collect();
        let inner = extremes(edge.iter().map(|&node| {
            let [x, y] = mesh.nodes[node as usize];
            x.hypot(y)
        }))
        .0;
        let radius = 0.5 * rect.width * inner / view.half_width;
        let centre = view.to_drawing(rect, [0.0, 0.0]);
        let radii = (0.58 * radius, 0.94 * radius);
        draw_status_ring(svg, centre, radii, &angles, status);
    }
    let width = 0.82 * rect.width;
    let left = rect.x + 0.5 * (rect.width - width);
    let bar = Rect::new(left, rect.bottom() + 5.0, width, 5.0);
    let axis = Axis::linear(&data.quantity, range.0, range.1);
    legend::draw_flat_colour_bar(svg, &bar, &axis, map);
    Ok(())
}
