//! One plot: a rectangle with two axes, and what is drawn inside it.

use super::axis::{Axis, Scale, widest};
use super::colour::{GRID, INK};
use super::decimation;
use super::svg::{Path, Rect, Stroke, Svg};
use super::text::{Anchor, TextStyle};

/// Size of axis titles, points.
pub const TITLE_SIZE: f64 = 7.5;
/// Size of tick labels and legends, points.
pub const LABEL_SIZE: f64 = 6.75;
/// Length of a tick, points.
const TICK: f64 = 2.6;
/// Columns for each point of width to which series are thinned (300 dots per inch).
const COLUMNS_PER_POINT: f64 = 300.0 / 72.0;
/// Deviation that no reader sees, points.
const INVISIBLE: f64 = 0.03;

/// Shape of a data point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// Filled disc.
    Disc,
    /// Circle with a white inside.
    Circle,
    /// Filled square.
    Square,
    /// Filled triangle.
    Triangle,
    /// Filled diamond.
    Diamond,
}

/// The order in which series take markers.
pub const MARKERS: [Marker; 4] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
];

/// A plot in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Data area.
    pub area: Rect,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Whether the horizontal axis shows its labels and title (not where a panel below shares it).
    pub labels_x: bool,
    /// Whether the vertical axis shows its labels and title.
    pub labels_y: bool,
    /// Distance of the vertical axis's title from the axis, points, where stacked panels share it.
    pub title_distance: Option<f64>,
    /// Whether light lines cross the data area at the ticks.
    pub grid: bool,
}

impl Panel {
    /// A plot over `area`.
    pub fn new(area: Rect, x: Axis, y: Axis) -> Self {
        Self {
            area,
            x,
            y,
            labels_x: true,
            labels_y: true,
            title_distance: None,
            grid: true,
        }
    }

    /// The same without labels on the horizontal axis.
    pub fn without_x_labels(mut self) -> Self {
        self.labels_x = false;
        self
    }

    /// The same without labels on the vertical axis.
    pub fn without_y_labels(mut self) -> Self {
        self.labels_y = false;
        self
    }

    /// The same without grid lines.
    pub fn without_grid(mut self) -> Self {
        self.grid = false;
        self
    }

    /// Room that labels and title of a vertical axis of this height need at its left, points.
    pub fn left_margin(y: &Axis, height: f64) -> f64 {
        let ticks = y.ticks(vertical_count(height));
        widest(&ticks, LABEL_SIZE) + TICK + 4.0 + TITLE_SIZE + 3.0
    }

    /// Room that labels and title of a horizontal axis need below, points.
    pub fn bottom_margin() -> f64 {
        TICK + LABEL_SIZE + TITLE_SIZE + 9.0
    }

    /// Horizontal position of a value.
    pub fn at_x(&self, value: f64) -> f64 {
        self.area.x + self.area.width * self.x.fraction(value).clamp(-20.0, 20.0)
    }

    /// Vertical position of a value.
    pub fn at_y(&self, value: f64) -> f64 {
        self.area.bottom() - self.area.height * self.y.fraction(value).clamp(-20.0, 20.0)
    }

    fn x_count(&self) -> usize {
        let sample = widest(&self.x.ticks(4), LABEL_SIZE).max(8.0);
        ((self.area.width / (1.4 * sample + 8.0)) as usize).clamp(1, 9)
    }

    fn y_count(&self) -> usize {
        vertical_count(self.area.height)
    }

    /// White ground and grid lines; drawn before the data.
    pub fn draw_ground(&self, svg: &mut Svg) {
        if !self.grid {
            return;
        }
        let stroke = Stroke::solid(GRID, 0.4);
        for tick in self.x.ticks(self.x_count()) {
            let x = self.at_x(tick.value);
            svg.line((x, self.area.y), (x, self.area.bottom()), &stroke);
        }
        for tick in self.y.ticks(self.y_count()) {
            let y = self.at_y(tick.value);
            svg.line((self.area.x, y), (self.area.right(), y), &stroke);
        }
    }

    /// Frame, ticks, labels and titles; drawn after the data.
    pub fn draw_frame(&self, svg: &mut Svg) {
        svg.rectangle(&self.area, "none", Some(&Stroke::solid(INK, 0.6)));
        self.draw_x_axis(svg);
        self.draw_y_axis(svg);
    }

    fn draw_x_axis(&self, svg: &mut Svg) {
        let bottom = self.area.bottom();
        let mut marks = Path::new();
        for value in self.x.minor_ticks() {
            let x = self.at_x(value);
            marks.move_to(x, bottom);
            marks.line_to(x, bottom + 0.6 * TICK);
        }
        let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::Middle);
        for tick in self.x.ticks(self.x_count()) {
            let x = self.at_x(tick.value);
            marks.move_to(x, bottom);
            marks.line_to(x, bottom + TICK);
            if self.labels_x {
                svg.text(x, bottom + TICK + LABEL_SIZE + 1.0, &tick.label, &style);
            }
        }
        svg.path(&marks, &Stroke::solid(INK, 0.6));
        if self.labels_x {
            let title = with_exponent(&self.x);
            svg.text(
                self.area.x + 0.5 * self.area.width,
                bottom + TICK + LABEL_SIZE + TITLE_SIZE + 4.0,
                &title,
                &TextStyle::new(TITLE_SIZE).anchored(Anchor::Middle),
            );
        }
    }

    fn draw_y_axis(&self, svg: &mut Svg) {
        let left = self.area.x;
        let ticks = self.y.ticks(self.y_count());
        let mut marks = Path::new();
        for value in self.y.minor_ticks() {
            let y = self.at_y(value);
            marks.move_to(left, y);
            marks.line_to(left - 0.6 * TICK, y);
        }
        let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::End);
        for tick in &ticks {
            let y = self.at_y(tick.value);
            marks.move_to(left, y);
            marks.line_to(left - TICK, y);
            if self.labels_y {
                let baseline = y + 0.36 * LABEL_SIZE;
                svg.text(left - TICK - 1.8, baseline, &tick.label, &style);
            }
        }
        svg.path(&marks, &Stroke::solid(INK, 0.6));
        if self.labels_y {
            let distance = self
                .title_distance
                .unwrap_or(TICK + widest(&ticks, LABEL_SIZE) + 5.5);
            self.draw_y_title(svg, left - distance);
        }
    }

    fn draw_y_title(&self, svg: &mut Svg, x: f64) {
        svg.text(
            x,
            self.area.y + 0.5 * self.area.height,
            &with_exponent(&self.y),
            &TextStyle::new(TITLE_SIZE)
                .anchored(Anchor::Middle)
                .rotated(-90.0),
        );
    }

    /// A line through a series with rising abscissae, thinned with its extremes kept.
    pub fn series(&self, svg: &mut Svg, xs: &[f64], ys: &[f64], stroke: &Stroke) {
        let kept = decimation::keep_extremes(xs, ys, |x| self.at_x(x) * COLUMNS_PER_POINT);
        let mut path = Path::new();
        let shown =
            |&(_, y): &(f64, f64)| y.is_finite() && (self.y.scale == Scale::Linear || y > 0.0);
        for piece in kept.split(|point| !shown(point)) {
            let points: Vec<(f64, f64)> = piece
                .iter()
                .map(|&(x, y)| (self.at_x(x), self.at_y(y)))
                .collect();
            path.extend(decimation::simplify(&points, INVISIBLE));
        }
        svg.path(&path, stroke);
    }

    /// The range that a quickly varying series covers, as a tinted band.
    pub fn envelope(&self, svg: &mut Svg, xs: &[f64], ys: &[f64], colour: &str, opacity: f64) {
        let kept = decimation::keep_extremes(xs, ys, |x| self.at_x(x) * 1.5);
        let mut columns: Vec<(f64, f64, f64)> = Vec::new();
        for (x, y) in kept.into_iter().filter(|p| p.1.is_finite()) {
            let (x, y) = (self.at_x(x), self.at_y(y));
            match columns.last_mut() {
                Some(last) if (last.0 * 1.5).floor() == (x * 1.5).floor() => {
                    last.1 = last.1.min(y);
                    last.2 = last.2.max(y);
                }
                _ => columns.push((x, y, y)),
            }
        }
        let upper = columns.iter().map(|c| (c.0, c.1));
        let lower = columns.iter().rev().map(|c| (c.0, c.2));
        svg.fill_path(&Path::polyline(upper.chain(lower), true), colour, opacity);
    }

    /// A free curve (its abscissae may turn back), simplified to a hundredth of a millimetre.
    pub fn curve(&self, svg: &mut Svg, xs: &[f64], ys: &[f64], stroke: &Stroke) {
        let points: Vec<(f64, f64)> = xs
            .iter()
            .zip(ys)
            .filter(|(x, y)| x.is_finite() && y.is_finite())
            .map(|(&x, &y)| (self.at_x(x), self.at_y(y)))
            .collect();
        let path = Path::polyline(decimation::simplify(&points, INVISIBLE), false);
        svg.path(&path, stroke);
    }

    /// The area between a series and a level.
    pub fn fill_to(
        &self,
        svg: &mut Svg,
        xs: &[f64],
        ys: &[f64],
        level: f64,
        colour: &str,
        opacity: f64,
    ) {
        let kept = decimation::keep_extremes(xs, ys, |x| self.at_x(x) * COLUMNS_PER_POINT);
        let inside: Vec<(f64, f64)> = kept.into_iter().filter(|p| p.1.is_finite()).collect();
        let (Some(first), Some(last)) = (inside.first(), inside.last()) else {
            return;
        };
        let base = self.at_y(level);
        let mut path = Path::new();
        path.move_to(self.at_x(first.0), base);
        for &(x, y) in &inside {
            path.line_to(self.at_x(x), self.at_y(y));
        }
        path.line_to(self.at_x(last.0), base);
        path.close();
        svg.fill_path(&path, colour, opacity);
    }

    /// Data points; one path for all of them.
    pub fn points(
        &self,
        svg: &mut Svg,
        points: impl IntoIterator<Item = (f64, f64)>,
        marker: Marker,
        radius: f64,
        colour: &str,
    ) {
        let mut path = Path::new();
        for (x, y) in points {
            if x.is_finite() && y.is_finite() {
                outline_marker(&mut path, marker, self.at_x(x), self.at_y(y), radius);
            }
        }
        if marker == Marker::Circle {
            svg.fill_path(&path, "#ffffff", 1.0);
            svg.path(&path, &Stroke::solid(colour, 0.7));
        } else {
            svg.fill_path(&path, colour, 1.0);
        }
    }

    /// A line across the panel at an ordinate.
    pub fn horizontal(&self, svg: &mut Svg, value: f64, stroke: &Stroke) {
        if (0.0..=1.0).contains(&self.y.fraction(value)) {
            let y = self.at_y(value);
            svg.line((self.area.x, y), (self.area.right(), y), stroke);
        }
    }

    /// A line across the panel at an abscissa.
    pub fn vertical(&self, svg: &mut Svg, value: f64, stroke: &Stroke) {
        if (0.0..=1.0).contains(&self.x.fraction(value)) {
            let x = self.at_x(value);
            svg.line((x, self.area.y), (x, self.area.bottom()), stroke);
        }
    }

    /// The rectangle between two abscissae and two ordinates, cut to the data area.
    pub fn cell(&self, x: (f64, f64), y: (f64, f64)) -> Rect {
        let area = &self.area;
        let [left, right] = [x.0, x.1].map(|v| self.at_x(v).clamp(area.x, area.right()));
        let [low, high] = [y.0, y.1].map(|v| self.at_y(v).clamp(area.y, area.bottom()));
        Rect::new(left, high, right - left, low - high)
    }
}

/// Ticks that fit a vertical axis of this height.
pub fn vertical_count(height: f64) -> usize {
    ((height / 17.0) as usize).clamp(1, 8)
}

/// Title of an axis with the power of ten taken out of its labels.
pub fn with_exponent(axis: &Axis) -> String {
    match axis.exponent() {
        0 => axis.title.clone(),
        power => {
            let factor = format!("10^{{{}}}", super::axis::signed(f64::from(power), 0));
            // "torque (N m)" becomes "torque (10^6 N m)".
            match axis.title.rsplit_once('(') {
                Some((quantity, unit)) => format!("{quantity}({factor} {unit}"),
                None => format!("{} ({factor})", axis.title),
            }
        }
    }
}

/// Adds the outline of a marker to a path.
pub fn outline_marker(path: &mut Path, marker: Marker, x: f64, y: f64, radius: f64) {
    let corners: &[(f64, f64)] = match marker {
        Marker::Disc if radius < 1.2 => &[
            (1.0, 0.4),
            (0.4, 1.0),
            (-0.4, 1.0),
            (-1.0, 0.4),
            (-1.0, -0.4),
            (-0.4, -1.0),
            (0.4, -1.0),
            (1.0, -0.4),
        ],
        Marker::Disc | Marker::Circle => &[
            (1.0, 0.0),
            (0.92, 0.38),
            (0.71, 0.71),
            (0.38, 0.92),
            (0.0, 1.0),
            (-0.38, 0.92),
            (-0.71, 0.71),
            (-0.92, 0.38),
            (-1.0, 0.0),
            (-0.92, -0.38),
            (-0.71, -0.71),
            (-0.38, -0.92),
            (0.0, -1.0),
            (0.38, -0.92),
            (0.71, -0.71),
            (0.92, -0.38),
        ],
        Marker::Square => &[(0.88, 0.88), (-0.88, 0.88), (-0.88, -0.88), (0.88, -0.88)],
        Marker::Triangle => &[(0.0, -1.2), (1.05, 0.75), (-1.05, 0.75)],
        Marker::Diamond => &[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
    };
    for (index, (dx, dy)) in corners.iter().enumerate() {
        let (px, py) = (x + radius * dx, y + radius * dy);
        if index == 0 {
            path.move_to(px, py);
        } else {
            path.line_to(px, py);
        }
    }
    path.close();
}
