//! Paths of a drawing, written as short as SVG allows: steps of hundredths from point to point.

use std::fmt::Write;

/// A path under construction, each point written relative to the one before to stay short.
#[derive(Clone, Debug, Default)]
pub struct Path {
    pub(super) data: String,
}

impl Path {
    /// A path through the points of each piece, which is closed or not.
    pub fn of<P: IntoIterator<Item = (f64, f64)>>(
        pieces: impl IntoIterator<Item = P>,
        closed: bool,
    ) -> Self {
        let mut path = Self::default();
        for piece in pieces {
            let before = path.data.len();
            path.extend(piece);
            if closed && path.data.len() > before {
                path.data.push('z');
            }
        }
        path
    }

    /// A path through all points, closed or not.
    pub fn polyline(points: impl IntoIterator<Item = (f64, f64)>, closed: bool) -> Self {
        Self::of([points], closed)
    }

    /// Starts a new piece through all points; the letter of lines is said once for all of them.
    fn extend(&mut self, points: impl IntoIterator<Item = (f64, f64)>) {
        let mut points = points.into_iter().map(hundredths);
        let Some(mut last) = points.next() else { return };
        self.data.push('M');
        push_hundredths(&mut self.data, last.0);
        push_next(&mut self.data, last.1);
        for (index, point) in points.enumerate() {
            let step = (point.0 - last.0, point.1 - last.1);
            if index > 0 {
                push_next(&mut self.data, step.0);
            } else {
                self.data.push('l');
                push_hundredths(&mut self.data, step.0);
            }
            push_next(&mut self.data, step.1);
            last = point;
        }
    }

    /// Single points, each as a line without length: a round end makes a disc of it.
    pub fn dots(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (mut path, mut last) = (Self::default(), (0, 0));
        for point in points.into_iter().map(hundredths) {
            let step = (point.0 - last.0, point.1 - last.1);
            if step != (0, 0) || path.is_empty() {
                path.data.push('m');
                push_hundredths(&mut path.data, step.0);
                push_next(&mut path.data, step.1);
                path.data.push_str("h0");
            }
            last = point;
        }
        path
    }

    /// Whether nothing was drawn.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }
}

fn hundredths((x, y): (f64, f64)) -> (i64, i64) {
    ((x * 100.0).round() as i64, (y * 100.0).round() as i64)
}

/// Writes a number behind another one, with a space only where both would be read as one: a sign parts them,
/// and so does a point where the number before has one.
fn push_next(out: &mut String, value: i64) {
    let before = out.len()
        - out.bytes().rev().take_while(|&byte| byte.is_ascii_digit() || byte == b'.').count();
    let has_point = out[before..].contains('.');
    if value > 99 || value == 0 || (value > 0 && !has_point) {
        out.push(' ');
    }
    push_hundredths(out, value);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_are_steps_without_length_each_place_once() {
        let path = Path::dots([(1.0, 2.5), (1.0, 2.5), (1.5, 2.25)]);
        assert_eq!(path.data, "m1 2.5h0m.5-.25h0");
    }

    #[test]
    fn a_row_of_lines_has_one_letter_and_no_more_spaces_than_needed() {
        let points = [(1.0, 2.5), (1.5, 3.25), (0.5, 3.25), (0.57, 4.0), (2.07, 4.5), (2.57, 3.5)];
        let path = Path::polyline(points, true);
        assert_eq!(path.data, "M1 2.5l.5.75-1 0 .07.75 1.5.5.5-1z");
    }
}
