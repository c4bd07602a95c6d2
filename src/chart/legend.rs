//! Legends and colour bars.

use super::colour::INK;
use super::frame::{LABEL_SIZE, TITLE_SIZE, vertical_count};
use super::image::{Colours, IndexedImage, Palette};
use super::layer::Marker;
use super::path::Path;
use super::ruler::{Ruler, widest};
use super::svg::{Rect, Stroke, Svg};
use super::text::{self, Anchor, TextStyle};

/// What stands before the name of a legend entry: any of a line, a data point, a filled patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    pub(super) stroke: Option<Stroke>,
    pub(super) marker: Option<(Marker, &'static str)>,
    pub(super) patch: Option<(&'static str, f64)>,
}

impl Key {
    /// A line.
    pub fn line(stroke: Stroke) -> Self {
        Self {
            stroke: Some(stroke),
            marker: None,
            patch: None,
        }
    }

    /// A filled patch; opacity from 0 to 1.
    pub fn patch(colour: &'static str, opacity: f64) -> Self {
        Self {
            stroke: None,
            marker: None,
            patch: Some((colour, opacity)),
        }
    }

    fn draw(&self, svg: &mut Svg, left: f64, middle: f64) {
        if let Some((colour, opacity)) = self.patch {
            let (right, top, bottom) = (left + KEY_WIDTH - 1.0, middle - 3.0, middle + 3.0);
            let corners = [
                (left + 1.0, top),
                (right, top),
                (right, bottom),
                (left + 1.0, bottom),
            ];
            let path = Path::polyline(corners, true);
            svg.fill_path(&path, colour, opacity);
            svg.path(&path, &Stroke::solid(INK, 0.3));
        }
        if let Some(stroke) = &self.stroke {
            svg.line((left, middle), (left + KEY_WIDTH, middle), stroke);
        }
        if let Some((marker, colour)) = self.marker {
            marker.draw(svg, [(left + 0.5 * KEY_WIDTH, middle)], 2.2, colour);
        }
    }
}

/// Width of a key, points.
const KEY_WIDTH: f64 = 12.0;
/// Height of a line of legend, points.
pub(super) const LINE_HEIGHT: f64 = 10.0;

/// Entries of a legend, each once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Legend(Vec<(Key, String)>);

impl Legend {
    /// Adds an entry that is not there yet.
    pub fn add(&mut self, entry: (Key, String)) {
        if !self.0.contains(&entry) {
            self.0.push(entry);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Width set into one line, points.
    pub fn width(&self) -> f64 {
        self.0.iter().map(|(_, name)| entry_width(name)).sum()
    }

    /// Height set into lines of `width`, points.
    pub fn height(&self, width: f64) -> f64 {
        self.lines(width).len() as f64 * LINE_HEIGHT
    }

    fn lines(&self, width: f64) -> Vec<Vec<&(Key, String)>> {
        let mut lines: Vec<Vec<&(Key, String)>> = Vec::new();
        let mut used = 0.0;
        for entry in &self.0 {
            let need = entry_width(&entry.1);
            match lines.last_mut() {
                Some(line) if used + need - 9.0 <= width => line.push(entry),
                _ => {
                    lines.push(vec![entry]);
                    used = 0.0;
                }
            }
            used += need;
        }
        lines
    }

    /// Draws the entries side by side from the upper left corner, wrapped to `width`.
    pub fn draw(&self, svg: &mut Svg, (x, y): (f64, f64), width: f64) {
        for (row, line) in self.lines(width).into_iter().enumerate() {
            let middle = y + (row as f64 + 0.5) * LINE_HEIGHT;
            let mut left = x;
            for (key, name) in line {
                key.draw(svg, left, middle);
                let place = (left + KEY_WIDTH + 3.0, middle + 0.36 * LABEL_SIZE);
                svg.text(place.0, place.1, name, &TextStyle::new(LABEL_SIZE));
                left += entry_width(name);
            }
        }
    }
}

fn entry_width(name: &str) -> f64 {
    KEY_WIDTH + 3.0 + text::width(name, LABEL_SIZE, false) + 9.0
}

impl Colours {
    fn ruler(&self) -> Ruler {
        let (low, high) = self.range;
        self.axis.clone().between(low, high).resolve(None)
    }

    /// Room that an upright bar needs, points.
    pub(super) fn bar_width(&self, height: f64) -> f64 {
        21.0 + widest(&self.ruler().ticks(vertical_count(height)), LABEL_SIZE) + TITLE_SIZE
    }

    /// Room that a flat bar needs below its top, points.
    pub(super) fn flat_bar_height() -> f64 {
        LABEL_SIZE + TITLE_SIZE + 14.0
    }

    /// Draws an upright bar with its left edge at `x`, over the height of an area: ticks and title at its right.
    pub(super) fn draw_bar(&self, svg: &mut Svg, x: f64, area: &Rect) {
        let ruler = self.ruler();
        let height = area.height.min(150.0);
        let bar = Rect::new(x, area.y + 0.5 * (area.height - height), 6.0, height);
        self.draw_colours(svg, &bar, true);
        let ticks = ruler.ticks(vertical_count(bar.height));
        for tick in &ticks {
            let y = bar.bottom() - bar.height * ruler.place(tick.value);
            svg.line(
                (bar.right(), y),
                (bar.right() + 2.2, y),
                &Stroke::solid(INK, 0.5),
            );
            let style = TextStyle::new(LABEL_SIZE);
            svg.text(
                bar.right() + 4.0,
                y + 0.36 * LABEL_SIZE,
                &tick.label,
                &style,
            );
        }
        let x = bar.right() + 7.0 + widest(&ticks, LABEL_SIZE) + TITLE_SIZE;
        let style = TextStyle::new(TITLE_SIZE)
            .anchored(Anchor::Middle)
            .rotated(-90.0);
        svg.text(x, bar.y + 0.5 * bar.height, &ruler.full_title(), &style);
    }

    fn draw_colours(&self, svg: &mut Svg, bar: &Rect, is_upright: bool) {
        const LEVELS: usize = 128;
        let palette = Palette::of_map(self.map, LEVELS);
        let levels = 0..LEVELS as u8;
        let (width, height, pixels) = match is_upright {
            true => (1, LEVELS, levels.rev().collect()),
            false => (LEVELS, 1, levels.collect()),
        };
        if let Some(png) = (IndexedImage {
            width,
            height,
            pixels,
        })
        .encode(&palette)
        {
            svg.image(bar, &png, false);
        }
        svg.rectangle(bar, "none", Some(&Stroke::solid(INK, 0.5)));
    }

    /// Draws a flat bar: ticks and title below it.
    pub(super) fn draw_flat_bar(&self, svg: &mut Svg, (x, y): (f64, f64), width: f64) {
        let ruler = self.ruler();
        let bar = Rect::new(x, y, width, 5.0);
        self.draw_colours(svg, &bar, false);
        let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::Middle);
        for tick in ruler.ticks((bar.width / 26.0) as usize) {
            let x = bar.x + bar.width * ruler.place(tick.value);
            svg.line(
                (x, bar.bottom()),
                (x, bar.bottom() + 2.2),
                &Stroke::solid(INK, 0.5),
            );
            svg.text(x, bar.bottom() + LABEL_SIZE + 3.0, &tick.label, &style);
        }
        let baseline = bar.bottom() + LABEL_SIZE + TITLE_SIZE + 6.0;
        let style = TextStyle::new(TITLE_SIZE).anchored(Anchor::Middle);
        svg.text(
            bar.x + 0.5 * bar.width,
            baseline,
            &ruler.full_title(),
            &style,
        );
    }
}
