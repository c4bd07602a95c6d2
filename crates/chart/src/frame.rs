//! Frame of a panel: the area of the data and the axes around it.

use crate::prelude::*;

/// Size of axis titles, points.
pub const TITLE_SIZE: f64 = 7.5;
/// Size of tick labels and legends, points.
pub const LABEL_SIZE: f64 = 6.75;
/// Length of a tick, points.
pub(super) const TICK: f64 = 2.6;

/// Where the data of a panel lie in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Data area.
    pub area: Rect,
    /// Horizontal axis.
    pub x: Ruler,
    /// Vertical axis.
    pub y: Ruler,
}

impl Frame {
    /// Horizontal position of a value.
    pub fn at_x(&self, value: f64) -> f64 {
        self.area.x + self.area.width * bounded(self.x.fraction(value))
    }

    /// Vertical position of a value.
    pub fn at_y(&self, value: f64) -> f64 {
        self.area.bottom() - self.area.height * bounded(self.y.fraction(value))
    }

    /// Horizontal position of a value in the unit shown.
    fn along_x(&self, value: f64) -> f64 {
        self.area.x + self.area.width * self.x.place(value)
    }

    /// Vertical position of a value in the unit shown.
    fn along_y(&self, value: f64) -> f64 {
        self.area.bottom() - self.area.height * self.y.place(value)
    }

    /// Position of a point.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.at_x(x), self.at_y(y))
    }

    /// Whether a point has a position, inside or outside.
    pub fn has_place(&self, x: f64, y: f64) -> bool {
        self.x.fraction(x).is_finite() && self.y.fraction(y).is_finite()
    }

    /// Positions of the points that lie inside.
    pub fn inside(&self, points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
        let shown = |&(x, y): &(f64, f64)| self.x.contains(x) && self.y.contains(y);
        points.into_iter().filter(shown).map(|(x, y)| self.at(x, y)).collect()
    }

    /// The rectangle between two abscissae and two ordinates.
    pub fn rect(&self, x: (f64, f64), y: (f64, f64)) -> Rect {
        let (left, right, bottom, top) =
            (self.at_x(x.0), self.at_x(x.1), self.at_y(y.0), self.at_y(y.1));
        Rect::new(left, top, right - left, bottom - top)
    }
}

/// A fraction near enough to the area to be drawn; what has no place is far off.
fn bounded(fraction: f64) -> f64 {
    if fraction.is_nan() { -20.0 } else { fraction.clamp(-20.0, 20.0) }
}

/// Ticks that fit a vertical axis of this height.
pub(super) fn vertical_count(height: f64) -> usize {
    ((height / 17.0) as usize).clamp(1, 8)
}

pub(super) fn draw_grid(svg: &mut Svg, frame: &Frame, [x, y]: &[Vec<Tick>; 2]) {
    let area = &frame.area;
    let upright = x.iter().map(|tick| frame.along_x(tick.value));
    let upright = upright.map(|x| [(x, area.y), (x, area.bottom())]);
    let flat = y.iter().map(|tick| frame.along_y(tick.value));
    let flat = flat.map(|y| [(area.x, y), (area.right(), y)]);
    svg.path(&Path::of(upright.chain(flat), false), &Stroke::solid(GRID, 0.4));
}

/// Draws small ticks and those with labels, each as `mark` has it for a value in the unit shown and a length.
fn draw_ticks(
    svg: &mut Svg,
    ruler: &Ruler,
    ticks: &[Tick],
    mark: impl Fn(f64, f64) -> [(f64, f64); 2],
) {
    let minor = ruler.minor_ticks().into_iter().map(|value| mark(value, 0.6 * TICK));
    let labelled = ticks.iter().map(|tick| mark(tick.value, TICK));
    svg.path(&Path::of(minor.chain(labelled), false), &Stroke::solid(INK, 0.6));
}

/// Most that the title of an axis may shrink to stay beside it.
const SMALLEST_TITLE: f64 = 0.7;

pub(super) fn draw_x_axis(svg: &mut Svg, frame: &Frame, ticks: &[Tick], labels: bool) {
    let (area, bottom) = (&frame.area, frame.area.bottom());
    draw_ticks(svg, &frame.x, ticks, |value, length| {
        [bottom, bottom + length].map(|y| (frame.along_x(value), y))
    });
    if !labels {
        return;
    }
    let style = TextStyle::new(LABEL_SIZE);
    for tick in ticks {
        let baseline = bottom + TICK + LABEL_SIZE + 1.0;
        svg.centred(frame.along_x(tick.value), baseline, &tick.label, &style);
    }
    let baseline = bottom + TICK + LABEL_SIZE + TITLE_SIZE + 4.0;
    let (middle, title) = (area.x + 0.5 * area.width, frame.x.full_title());
    svg.centred(middle, baseline, &title, &TextStyle::new(TITLE_SIZE));
}

/// Draws the vertical axis, with labels where its title has a distance.
pub(super) fn draw_y_axis(svg: &mut Svg, frame: &Frame, ticks: &[Tick], title: Option<f64>) {
    let (area, left) = (&frame.area, frame.area.x);
    draw_ticks(svg, &frame.y, ticks, |value, length| {
        [left, left - length].map(|x| (x, frame.along_y(value)))
    });
    let Some(distance) = title else { return };
    let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::End);
    for tick in ticks {
        let baseline = frame.along_y(tick.value) + 0.36 * LABEL_SIZE;
        svg.text(left - TICK - 1.8, baseline, &tick.label, &style);
    }
    // A title that is longer than its axis would run into that of the panel below.
    let title = frame.y.full_title();
    let room = area.height + LABEL_SIZE;
    let fitting = room / text::width(&title, TITLE_SIZE, false).max(room);
    let style = TextStyle::new(TITLE_SIZE * fitting.max(SMALLEST_TITLE))
        .anchored(Anchor::Middle)
        .rotated(-90.0);
    svg.text(left - distance, area.y + 0.5 * area.height, &title, &style);
}
