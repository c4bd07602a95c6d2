//! Mode shapes as small multiples of the deformed disc.

use super::axis::{Axis, signed};
use super::colour::{ColourMap, INK, MUTED, UNSTABLE};
use super::field::{self, FieldStyle, View, draw_field};
use super::legend;
use super::raster;
use super::svg::{DOUBLE_COLUMN, Rect, Stroke, Svg};
use super::text::{Anchor, TextStyle};
use super::{FigureError, expect_length, expect_some};
use crate::cea::ComplexMode;
use crate::mesh::Mesh2d;
use faer::c64;

/// Largest displacement drawn, as a fraction of the half width of the mesh.
const DEFLECTION: f64 = 0.07;

/// One mode to draw; it must carry its shape.
#[derive(Clone, Copy, Debug)]
pub struct ModeShape<'a> {
    /// Number in the list of modes, 1-based, in order of frequency.
    pub number: usize,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// The mode.
    pub mode: &'a ComplexMode,
}

/// Mode shapes over one mesh.
#[derive(Clone, Debug)]
pub struct ModeShapes<'a> {
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// Modes in the order of drawing.
    pub shapes: Vec<ModeShape<'a>>,
}

/// Draws the modes of one friction value: each the deformed disc, coloured by the displacement
/// amplitude of its real part, titled with number, frequency, real part, harmonic and direction.
///
/// A travelling wave is shown at the instant that puts its crest at angle zero; every shape is
/// scaled to its own maximum, which an eigenvector leaves open.
///
/// # Errors
/// [`FigureError`] if there is no mode, or a mode has no shape over this mesh.
pub fn draw_mode_shapes(data: &ModeShapes) -> Result<String, FigureError> {
    expect_some("modes with shapes", data.shapes.len())?;
    let friction = data.shapes[0].friction_coefficient;
    let captions = data.shapes.iter().map(caption).collect();
    let mut svg = Svg::new("mode-shapes", DOUBLE_COLUMN, 100.0);
    draw_multiples(&mut svg, data, captions)?;
    let title = format!(
        "Mode shapes at friction coefficient {}",
        signed(friction, 3)
    );
    Ok(svg.finish(
        &title,
        "Deformed disc of each mode, coloured by displacement amplitude relative to its maximum.",
    ))
}

/// Draws one mode at several friction values.
///
/// # Errors
/// As [`draw_mode_shapes`].
pub fn draw_mode_over_friction(data: &ModeShapes) -> Result<String, FigureError> {
    expect_some("modes with shapes", data.shapes.len())?;
    let captions = data
        .shapes
        .iter()
        .map(|shape| {
            let mut lines = caption(shape);
            lines[0] = format!("*μ* = {}", signed(shape.friction_coefficient, 3));
            lines[1] = format!(
                "{} Hz, Re {} Hz",
                signed(shape.mode.frequency_hz(), 0),
                signed(shape.mode.real_hz(), 1)
            );
            lines
        })
        .collect();
    let first = &data.shapes[0];
    let name = format!(
        "mode-{}-n{}-over-friction",
        first.number, first.mode.harmonic
    );
    let mut svg = Svg::new(&name, DOUBLE_COLUMN, 100.0);
    draw_multiples(&mut svg, data, captions)?;
    Ok(svg.finish(
        &format!("Mode {} at several friction coefficients", first.number),
        "Deformed disc of one mode as friction rises, coloured by displacement amplitude.",
    ))
}

fn caption(shape: &ModeShape) -> Vec<String> {
    let mode = shape.mode;
    let arrow = match mode.direction {
        1 => " ↺",
        -1 => " ↻",
        _ => "",
    };
    vec![
        format!("{}: {} Hz", shape.number, signed(mode.frequency_hz(), 0)),
        format!("Re {} Hz", signed(mode.real_hz(), 1)),
        format!("*n* = {}{arrow}", mode.harmonic),
    ]
}

fn column_count(count: usize) -> usize {
    match count {
        0..=4 => count.max(2),
        5..=6 => 3,
        7..=8 | 11..=12 => 4,
        9..=15 => 5,
        16..=18 => 6,
        _ => 7,
    }
}

fn draw_multiples(
    svg: &mut Svg,
    data: &ModeShapes,
    captions: Vec<Vec<String>>,
) -> Result<(), FigureError> {
    const GAP: f64 = 4.0;
    let columns = column_count(data.shapes.len());
    let side = ((svg.width() - GAP) / columns as f64 - GAP).min(150.0);
    let size = if side > 90.0 { 7.5 } else { 6.5 };
    let text_height = 3.0 * 1.25 * size + 3.0;
    let (pitch, row_height) = (side + GAP, side + text_height + 6.0);
    let indent = 0.5 * (svg.width() - columns as f64 * pitch + GAP);
    let half_width = View::around(&data.mesh.nodes, 0.0).half_width;
    let view = View {
        half_width: half_width * 1.02,
        ..View::around(&data.mesh.nodes, 0.0)
    };
    for (index, shape) in data.shapes.iter().enumerate() {
        let x = indent + (index % columns) as f64 * pitch;
        let y = 3.0 + (index / columns) as f64 * row_height;
        draw_caption(svg, x, y, side, size, &captions[index], shape);
        let rect = Rect::new(x, y + text_height, side, side);
        draw_disc(svg, &rect, &view, data.mesh, shape.mode)?;
    }
    let rows = data.shapes.len().div_ceil(columns);
    draw_foot(svg, 3.0 + rows as f64 * row_height + 2.0);
    Ok(())
}

fn draw_caption(
    svg: &mut Svg,
    x: f64,
    y: f64,
    side: f64,
    size: f64,
    lines: &[String],
    shape: &ModeShape,
) {
    let unstable = shape.mode.is_unstable();
    let colour = if unstable { UNSTABLE } else { INK };
    for (row, line) in lines.iter().enumerate() {
        let style = TextStyle::new(size)
            .anchored(Anchor::Middle)
            .coloured(colour);
        // Bold has no oblique face; the line with a symbol stays regular.
        let style = if row == 0 && !line.contains('*') {
            style.bold()
        } else {
            style
        };
        let line = if unstable && row == lines.len() - 1 {
            format!("{line} unstable")
        } else {
            line.clone()
        };
        let baseline = y + size + row as f64 * 1.25 * size;
        svg.text(x + 0.5 * side, baseline, &line, &style);
    }
}

fn draw_disc(
    svg: &mut Svg,
    rect: &Rect,
    view: &View,
    mesh: &Mesh2d,
    mode: &ComplexMode,
) -> Result<(), FigureError> {
    let shape = mode.shape.as_deref().unwrap_or(&[]);
    expect_length("mode shape", shape.len(), 2 * mesh.node_count())?;
    let turn = crest_phase(mesh, shape, mode.harmonic);
    let real: Vec<f64> = shape.iter().map(|u| (u * turn).re).collect();
    let amplitude: Vec<f64> = real.chunks_exact(2).map(|u| u[0].hypot(u[1])).collect();
    let largest = amplitude.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let magnification = DEFLECTION * view.half_width / largest;
    let positions = field::deformed(mesh, &real, magnification);
    let style = FieldStyle {
        range: (0.0, largest),
        map: ColourMap::Viridis,
        pixels_per_point: 3.0,
        levels: raster::COARSE,
        rays: if rect.width > 90.0 { 24 } else { 12 },
    };
    draw_field(svg, rect, view, mesh, &positions, &amplitude, &style)?;
    let undeformed = field::outline(&mesh.inner_edge, &mesh.nodes, rect, view);
    let stroke = Stroke {
        dash: &[1.5, 1.2],
        ..Stroke::solid(MUTED, 0.45)
    };
    svg.path(&undeformed, &stroke);
    Ok(())
}

/// Unit factor that turns a shape to the instant drawn.
///
/// A standing wave (`|sum u^2|` near `sum |u|^2`) is turned to its largest real part; a travelling
/// one so that the wave that carries most of it has its tangential crest at angle zero. Both depend on
/// the shape alone, not on the arbitrary phase a solver gave it.
fn crest_phase(mesh: &Mesh2d, shape: &[c64], harmonic: usize) -> c64 {
    let zero = c64::new(0.0, 0.0);
    let square = shape.iter().fold(zero, |sum, u| sum + u * u);
    let total: f64 = shape.iter().map(|u| u.norm_sqr()).sum();
    let unit = |z: c64| {
        if z.norm() > 0.0 {
            z.conj() / z.norm()
        } else {
            c64::new(1.0, 0.0)
        }
    };
    if square.norm() > 0.5 * total {
        return unit(square.sqrt());
    }
    let wave = |sign: f64| {
        shape
            .chunks_exact(2)
            .zip(&mesh.frame_angles)
            .fold(zero, |sum, (u, &angle)| {
                let phase = sign * harmonic as f64 * angle;
                sum + u[1] * c64::new(phase.cos(), phase.sin())
            })
    };
    let (forward, backward) = (wave(-1.0), wave(1.0));
    if forward.norm() >= backward.norm() {
        unit(forward)
    } else {
        unit(backward)
    }
}

fn draw_foot(svg: &mut Svg, top: f64) {
    let bar = Rect::new(svg.width() - 176.0, top, 160.0, 7.0);
    let axis = Axis::linear("displacement amplitude |*u*| / max |*u*| (–)", 0.0, 1.0);
    legend::draw_flat_colour_bar(svg, &bar, &axis, ColourMap::Viridis);
    let style = TextStyle::new(6.75);
    svg.text(
        6.0,
        top + 7.0,
        "↺ travels with the rotor, ↻ against it",
        &style,
    );
    svg.text(
        6.0,
        top + 17.0,
        "Re: real part of the eigenvalue / 2π; *n*: harmonic (nodal diameters)",
        &style,
    );
    svg.set_height(top + legend::flat_colour_bar_height(7.0) + 2.0);
}
