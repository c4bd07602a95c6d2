//! Legends.

use crate::prelude::*;

/// What stands before the name of a legend entry: any of a line, a data point, a filled patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Key {
    pub(super) stroke: Option<Stroke>,
    pub(super) marker: Option<(Marker, Colour)>,
    pub(super) patch: Option<(Colour, f64)>,
}

impl Key {
    /// A line.
    pub fn line(stroke: Stroke) -> Self {
        Self { stroke: Some(stroke), ..Self::default() }
    }

    /// A filled patch; opacity from 0 to 1.
    pub fn patch(colour: impl Into<Colour>, opacity: f64) -> Self {
        Self { patch: Some((colour.into(), opacity)), ..Self::default() }
    }

    fn draw(&self, svg: &mut Svg, left: f64, middle: f64) {
        if let Some((colour, opacity)) = self.patch {
            let (right, top, bottom) = (left + KEY_WIDTH - 1.0, middle - 3.0, middle + 3.0);
            let corners = [(left + 1.0, top), (right, top), (right, bottom), (left + 1.0, bottom)];
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
/// Room behind an entry, points.
const SPACE: f64 = 9.0;
/// Height of a further line of one entry, points.
const LINE_STEP: f64 = 8.2;
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
        self.rows(width).iter().map(Row::height).sum()
    }

    /// Entries side by side in rows no wider than `width`; a name that is wider by itself is broken into lines.
    fn rows(&self, width: f64) -> Vec<Row<'_>> {
        let mut rows: Vec<Row<'_>> = Vec::new();
        let mut used = 0.0;
        for (key, name) in &self.0 {
            let most = (width - KEY_WIDTH - 3.0).max(20.0);
            let lines = text::wrapped(name, LABEL_SIZE, most);
            let need = lines.iter().map(|line| entry_width(line)).fold(0.0, f64::max);
            match rows.last_mut() {
                Some(row) if used + need - SPACE <= width => row.0.push((key, lines, need)),
                _ => {
                    rows.push(Row(vec![(key, lines, need)]));
                    used = 0.0;
                }
            }
            used += need;
        }
        rows
    }

    /// Draws the entries side by side from the upper left corner, wrapped to `width`.
    pub fn draw(&self, svg: &mut Svg, (x, y): (f64, f64), width: f64) {
        let mut top = y;
        for row in self.rows(width) {
            let mut left = x;
            for (key, lines, need) in &row.0 {
                key.draw(svg, left, top + 0.5 * LINE_HEIGHT);
                for (number, line) in lines.iter().enumerate() {
                    let middle = top + 0.5 * LINE_HEIGHT + number as f64 * LINE_STEP;
                    let place = (left + KEY_WIDTH + 3.0, middle + 0.36 * LABEL_SIZE);
                    svg.text(place.0, place.1, line, &TextStyle::new(LABEL_SIZE));
                }
                left += need;
            }
            top += row.height();
        }
    }
}

/// Entries side by side: key, lines of its name, width.
struct Row<'a>(Vec<(&'a Key, Vec<String>, f64)>);

impl Row<'_> {
    fn height(&self) -> f64 {
        let lines = self.0.iter().map(|entry| entry.1.len()).max();
        LINE_HEIGHT + LINE_STEP * lines.map_or(0.0, |lines| lines.saturating_sub(1) as f64)
    }
}

fn entry_width(name: &str) -> f64 {
    KEY_WIDTH + 3.0 + text::width(name, LABEL_SIZE, false) + SPACE
}
