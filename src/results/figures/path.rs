//! Paths of straight pieces.

use std::fmt::Write;

/// A path under construction, written relative to its last point to stay short.
#[derive(Clone, Debug, Default)]
pub struct Path {
    pub(super) data: String,
    last: (i64, i64),
}

impl Path {
    /// An empty path.
    pub fn new() -> Self {
        Self::default()
    }

    /// Starts a new piece at a point.
    pub fn move_to(&mut self, x: f64, y: f64) {
        let point = hundredths(x, y);
        self.data.push('M');
        push_pair(&mut self.data, point);
        self.last = point;
    }

    /// Draws a straight line to a point.
    pub fn line_to(&mut self, x: f64, y: f64) {
        let point = hundredths(x, y);
        self.data.push('l');
        push_pair(
            &mut self.data,
            (point.0 - self.last.0, point.1 - self.last.1),
        );
        self.last = point;
    }

    /// Starts a new piece through all points.
    pub fn extend(&mut self, points: impl IntoIterator<Item = (f64, f64)>) {
        for (index, (x, y)) in points.into_iter().enumerate() {
            if index == 0 {
                self.move_to(x, y);
            } else {
                self.line_to(x, y);
            }
        }
    }

    /// Closes the current piece.
    pub fn close(&mut self) {
        self.data.push('z');
    }

    /// Whether nothing was drawn.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// A path through all points, closed or not.
    pub fn polyline(points: impl IntoIterator<Item = (f64, f64)>, closed: bool) -> Self {
        let mut path = Self::new();
        path.extend(points);
        if closed && !path.is_empty() {
            path.close();
        }
        path
    }
}

fn hundredths(x: f64, y: f64) -> (i64, i64) {
    ((x * 100.0).round() as i64, (y * 100.0).round() as i64)
}

fn push_pair(out: &mut String, (x, y): (i64, i64)) {
    push_hundredths(out, x);
    if y >= 0 {
        out.push(' ');
    }
    push_hundredths(out, y);
}

fn push_hundredths(out: &mut String, value: i64) {
    let magnitude = value.unsigned_abs();
    if value < 0 {
        out.push('-');
    }
    let (whole, rest) = (magnitude / 100, magnitude % 100);
    if whole > 0 || rest == 0 {
        let _ = write!(out, "{whole}");
    }
    if rest > 0 {
        if rest % 10 == 0 {
            let _ = write!(out, ".{}", rest / 10);
        } else {
            let _ = write!(out, ".{rest:02}");
        }
    }
}
