//! Legends and colour bars.

use super::axis::Axis;
use super::colour::{ColourMap, INK};
use super::panel::{LABEL_SIZE, Marker, TITLE_SIZE, outline_marker, with_exponent};
use super::svg::{Path, Rect, Stroke, Svg};
use super::text::{self, Anchor, TextStyle};

/// What stands before the name of a legend entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Key {
    /// A line: colour, width, dash pattern.
    Line(String, f64, Vec<f64>),
    /// A data point.
    Point(Marker, String),
    /// A filled patch: colour, opacity.
    Patch(String, f64),
}

impl Key {
    /// A full line.
    pub fn line(colour: &str) -> Self {
        Self::Line(colour.into(), 1.1, Vec::new())
    }

    /// A dashed line.
    pub fn dashed(colour: &str) -> Self {
        Self::Line(colour.into(), 0.9, vec![3.0, 2.0])
    }

    /// A filled patch.
    pub fn patch(colour: &str) -> Self {
        Self::Patch(colour.into(), 1.0)
    }
}

/// Width of a key, points.
const KEY_WIDTH: f64 = 12.0;
/// Height of a line of legend, points.
const LINE_HEIGHT: f64 = 10.0;

fn entry_width(name: &str) -> f64 {
    KEY_WIDTH + 3.0 + text::width(name, LABEL_SIZE, false) + 9.0
}

/// Lines that a legend of this width takes.
fn wrap(entries: &[(Key, String)], width: f64) -> Vec<Vec<usize>> {
    let mut lines: Vec<Vec<usize>> = vec![Vec::new()];
    let mut used = 0.0;
    for (index, (_, name)) in entries.iter().enumerate() {
        let need = entry_width(name);
        if used > 0.0 && used + need - 9.0 > width {
            lines.push(Vec::new());
            used = 0.0;
        }
        used += need;
        if let Some(line) = lines.last_mut() {
            line.push(index);
        }
    }
    lines
}

/// Width of a legend set into one line, points.
pub fn legend_width(entries: &[(Key, String)]) -> f64 {
    entries.iter().map(|(_, name)| entry_width(name)).sum()
}

/// Height of a legend set into lines of `width`, points.
pub fn legend_height(entries: &[(Key, String)], width: f64) -> f64 {
    if entries.is_empty() {
        0.0
    } else {
        wrap(entries, width).len() as f64 * LINE_HEIGHT
    }
}

/// A legend outside the data: entries side by side from the upper left corner, wrapped to `width`.
pub fn draw_legend(svg: &mut Svg, x: f64, y: f64, width: f64, entries: &[(Key, String)]) {
    for (row, line) in wrap(entries, width).iter().enumerate() {
        let middle = y + (row as f64 + 0.5) * LINE_HEIGHT;
        let mut left = x;
        for &index in line {
            let (key, name) = &entries[index];
            draw_key(svg, key, left, middle);
            svg.text(
                left + KEY_WIDTH + 3.0,
                middle + 0.36 * LABEL_SIZE,
                name,
                &TextStyle::new(LABEL_SIZE),
            );
            left += entry_width(name);
        }
    }
}

fn draw_key(svg: &mut Svg, key: &Key, left: f64, middle: f64) {
    match key {
        Key::Line(colour, width, dash) => {
            let stroke = Stroke {
                colour,
                width: *width,
                dash,
                opacity: 1.0,
            };
            svg.line((left, middle), (left + KEY_WIDTH, middle), &stroke);
        }
        Key::Point(marker, colour) => {
            let mut path = Path::new();
            outline_marker(&mut path, *marker, left + 0.5 * KEY_WIDTH, middle, 2.2);
            if *marker == Marker::Circle {
                svg.fill_path(&path, "#ffffff", 1.0);
                svg.path(&path, &Stroke::solid(colour, 0.7));
            } else {
                svg.fill_path(&path, colour, 1.0);
            }
        }
        Key::Patch(colour, opacity) => {
            let (top, bottom) = (middle - 3.0, middle + 3.0);
            let corners = [
                (left + 1.0, top),
                (left + KEY_WIDTH - 1.0, top),
                (left + KEY_WIDTH - 1.0, bottom),
                (left + 1.0, bottom),
            ];
            let path = Path::polyline(corners, true);
            svg.fill_path(&path, colour, *opacity);
            svg.path(&path, &Stroke::solid(INK, 0.3));
        }
    }
}

/// A colour bar standing upright: ticks at its right, title above it or along it.
pub fn draw_colour_bar(svg: &mut Svg, bar: &Rect, axis: &Axis, map: ColourMap) {
    svg.gradient(bar, &map.samples(17), true);
    let ticks = axis.ticks(super::panel::vertical_count(bar.height));
    let style = TextStyle::new(LABEL_SIZE);
    for tick in &ticks {
        let y = bar.bottom() - bar.height * axis.fraction(tick.value);
        let stroke = Stroke::solid(INK, 0.5);
        svg.line((bar.right(), y), (bar.right() + 2.2, y), &stroke);
        svg.text(
            bar.right() + 4.0,
            y + 0.36 * LABEL_SIZE,
            &tick.label,
            &style,
        );
    }
    svg.text(
        bar.right() + 7.0 + super::axis::widest(&ticks, LABEL_SIZE) + TITLE_SIZE,
        bar.y + 0.5 * bar.height,
        &with_exponent(axis),
        &TextStyle::new(TITLE_SIZE)
            .anchored(Anchor::Middle)
            .rotated(-90.0),
    );
}

/// Room that an upright colour bar needs at the right of its left edge, points.
pub fn colour_bar_width(axis: &Axis, bar: &Rect) -> f64 {
    let ticks = axis.ticks(super::panel::vertical_count(bar.height));
    bar.width + 7.0 + super::axis::widest(&ticks, LABEL_SIZE) + TITLE_SIZE + 3.0
}

/// A colour bar lying flat: ticks below it, title below them.
pub fn draw_flat_colour_bar(svg: &mut Svg, bar: &Rect, axis: &Axis, map: ColourMap) {
    svg.gradient(bar, &map.samples(17), false);
    let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::Middle);
    for tick in axis.ticks((bar.width / 26.0) as usize) {
        let x = bar.x + bar.width * axis.fraction(tick.value);
        let stroke = Stroke::solid(INK, 0.5);
        svg.line((x, bar.bottom()), (x, bar.bottom() + 2.2), &stroke);
        svg.text(x, bar.bottom() + LABEL_SIZE + 3.0, &tick.label, &style);
    }
    svg.text(
        bar.x + 0.5 * bar.width,
        bar.bottom() + LABEL_SIZE + TITLE_SIZE + 6.0,
        &with_exponent(axis),
        &TextStyle::new(TITLE_SIZE).anchored(Anchor::Middle),
    );
}

/// Room below the top of a flat colour bar of height `bar`, points.
pub fn flat_colour_bar_height(bar: f64) -> f64 {
    bar + LABEL_SIZE + TITLE_SIZE + 9.0
}
