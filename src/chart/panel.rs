//! One plot: two axes and the layers between them.

use super::axis::{Axis, extremes};
use super::colour::{GRID, INK, MUTED};
use super::image::Colours;
use super::layer::Layer;
use super::legend::{Key, Legend};
use super::ruler::{Ruler, widest};
use super::svg::{Path, Rect, Stroke, Svg};
use super::text::{Anchor, TextStyle};

/// Size of axis titles, points.
pub const TITLE_SIZE: f64 = 7.5;
/// Size of tick labels and legends, points.
pub const LABEL_SIZE: f64 = 6.75;
/// Length of a tick, points.
const TICK: f64 = 2.6;

/// A side of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Beyond its right edge.
    Right,
    /// Above it.
    Above,
    /// Below it.
    Below,
}

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
        points
            .into_iter()
            .filter(shown)
            .map(|(x, y)| self.at(x, y))
            .collect()
    }

    /// The rectangle between two abscissae and two ordinates.
    pub fn rect(&self, x: (f64, f64), y: (f64, f64)) -> Rect {
        let (left, right, bottom, top) = (
            self.at_x(x.0),
            self.at_x(x.1),
            self.at_y(y.0),
            self.at_y(y.1),
        );
        Rect::new(left, top, right - left, bottom - top)
    }
}

/// A fraction near enough to the area to be drawn; what has no place is far off.
fn bounded(fraction: f64) -> f64 {
    if fraction.is_nan() {
        -20.0
    } else {
        fraction.clamp(-20.0, 20.0)
    }
}

/// A plot of a figure.
pub struct Panel {
    pub(super) x: Axis,
    pub(super) y: Axis,
    layers: Vec<Box<dyn Layer>>,
    pub(super) caption: String,
    pub(super) headings: Vec<(String, &'static str)>,
    pub(super) height: f64,
    pub(super) is_plane: bool,
    is_bare: bool,
    has_grid: bool,
    pub(super) has_legend: bool,
    bar: Option<Side>,
    pub(super) span: usize,
}

impl Panel {
    /// A plot over two axes.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            layers: Vec::new(),
            caption: String::new(),
            headings: Vec::new(),
            height: 120.0,
            is_plane: false,
            is_bare: false,
            has_grid: true,
            has_legend: false,
            bar: None,
            span: 1,
        }
    }

    /// A picture of the plane between two corners, as wide as high in equal units, without axes.
    pub fn plane([low, high]: [[f64; 2]; 2]) -> Self {
        let axis = |i: usize| Axis::new("", "").between(low[i], high[i]);
        let panel = Self::new(axis(0), axis(1)).plain().height(165.0);
        Self {
            is_plane: true,
            is_bare: true,
            ..panel
        }
    }

    /// The same with equal units on both axes, which must have given ends.
    pub fn equal(self) -> Self {
        Self {
            is_plane: true,
            ..self
        }
    }

    /// The same with one more layer over those it has.
    pub fn layer(mut self, layer: impl Layer + 'static) -> Self {
        self.layers.push(Box::new(layer));
        self
    }

    /// The same with more layers.
    pub fn layers<L: Layer + 'static>(mut self, layers: impl IntoIterator<Item = L>) -> Self {
        for layer in layers {
            self.layers.push(Box::new(layer));
        }
        self
    }

    /// The same with a caption above its left corner.
    pub fn caption(self, caption: impl Into<String>) -> Self {
        Self {
            caption: caption.into(),
            ..self
        }
    }

    /// The same with a line of heading above its middle.
    pub fn heading(self, line: impl Into<String>) -> Self {
        self.heading_in(INK, line)
    }

    /// The same with a line of heading in a colour.
    pub fn heading_in(mut self, colour: &'static str, line: impl Into<String>) -> Self {
        self.headings.push((line.into(), colour));
        self
    }

    /// The same with a height of the data area, points; of a plane, the largest.
    pub fn height(self, height: f64) -> Self {
        Self { height, ..self }
    }

    /// The same without grid lines.
    pub fn plain(self) -> Self {
        Self {
            has_grid: false,
            ..self
        }
    }

    /// The same with a legend of its own above it.
    pub fn legend(self) -> Self {
        Self {
            has_legend: true,
            ..self
        }
    }

    /// The same with the scale of its colours at a side.
    pub fn colour_bar(self, side: Side) -> Self {
        Self {
            bar: Some(side),
            ..self
        }
    }

    /// The same beside so many rows of other panels.
    pub fn beside(self, rows: usize) -> Self {
        Self {
            span: rows.max(1),
            ..self
        }
    }

    /// Whether it has a point of data to show.
    pub(super) fn has_data(&self) -> bool {
        let is_point = |x: f64, y: f64| {
            (x.is_finite() || y.is_finite()) && !x.is_infinite() && !y.is_infinite()
        };
        self.layers
            .iter()
            .filter(|layer| layer.is_data())
            .any(|layer| {
                let mut found = false;
                layer.extent(&mut |x, y| found |= is_point(x, y) && x.is_finite() && y.is_finite());
                found
            })
    }

    /// Ranges of the data; where the horizontal ends are given, the vertical range is that of what lies between them.
    pub(super) fn ranges(&self) -> [Option<(f64, f64)>; 2] {
        let (given, logarithmic) = (
            self.x.given(),
            [self.x.is_logarithmic(), self.y.is_logarithmic()],
        );
        let mut seen: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
        for layer in self.layers.iter().filter(|layer| layer.is_data()) {
            layer.extent(&mut |x, y| {
                let is_outside = given.is_some_and(|(low, high)| x < low || x > high);
                for ((value, seen), logarithmic) in
                    [x, y].into_iter().zip(&mut seen).zip(logarithmic)
                {
                    if !is_outside && value.is_finite() && (value > 0.0 || !logarithmic) {
                        match seen.len() {
                            0 => *seen = vec![value, value],
                            _ => *seen = vec![seen[0].min(value), seen[1].max(value)],
                        }
                    }
                }
            });
        }
        seen.map(|seen| (!seen.is_empty()).then(|| extremes(seen)))
    }

    /// Legend entries of what is seen in a frame.
    pub(super) fn add_keys(&self, frame: &Frame, legend: &mut Legend) {
        for layer in &self.layers {
            let keys: Vec<(Key, String)> = layer.keys();
            let mut is_seen = false;
            if !keys.is_empty() {
                let shows = |ruler: &Ruler, value: f64| value.is_nan() || ruler.contains(value);
                layer.extent(&mut |x, y| {
                    is_seen |=
                        !(x.is_nan() && y.is_nan()) && shows(&frame.x, x) && shows(&frame.y, y);
                });
            }
            keys.into_iter()
                .filter(|_| is_seen)
                .for_each(|key| legend.add(key));
        }
    }

    fn colours(&self) -> Option<&Colours> {
        self.layers.iter().find_map(|layer| layer.colours())
    }

    fn rim_labels(&self, frame: Option<&Frame>) -> Vec<(Side, f64, &str)> {
        let labels = self.layers.iter().filter_map(|layer| layer.rim_label());
        let shown = |label: &(Side, f64, &str)| match (frame, label.0) {
            (Some(frame), Side::Right) => frame.y.contains(label.1),
            (Some(frame), _) => frame.x.contains(label.1),
            (None, _) => true,
        };
        labels.filter(shown).collect()
    }

    /// Room needed left of the data area, points.
    pub(super) fn left_need(&self, y: &Ruler, labels: bool) -> f64 {
        match (self.is_bare, labels) {
            (true, _) => 0.0,
            (false, false) => TICK + 2.0,
            (false, true) => {
                widest(&y.ticks(vertical_count(self.height)), LABEL_SIZE) + TICK + TITLE_SIZE + 7.0
            }
        }
    }

    /// Room needed right of the data area, points.
    pub(super) fn right_need(&self) -> f64 {
        let names = self
            .rim_labels(None)
            .into_iter()
            .filter(|label| label.0 == Side::Right);
        let widths =
            names.map(|label| super::text::width(label.2, super::marks::RIM_SIZE, false) + 8.0);
        let names = widths.fold(0.0, f64::max);
        let bar = match (self.bar, self.colours()) {
            (Some(Side::Right), Some(colours)) => colours.bar_width(self.height.min(150.0)),
            _ => 0.0,
        };
        // The last label of a horizontal axis stands out by half.
        let least = if self.is_bare { 0.0 } else { 7.0 };
        (names + bar).max(least)
    }

    /// Room needed below the data area, points.
    pub(super) fn bottom_need(&self, labels: bool) -> f64 {
        let bar = match (self.bar, self.colours()) {
            (Some(Side::Below), Some(_)) => 3.0 + Colours::flat_bar_height(),
            _ => 0.0,
        };
        bar + match (self.is_bare, labels) {
            (true, _) => 2.0,
            (false, false) => TICK + 1.0,
            (false, true) => TICK + LABEL_SIZE + TITLE_SIZE + 6.5,
        }
    }

    /// Room needed above the data area for names beyond it, points.
    pub(super) fn rim_height(&self) -> f64 {
        let above = self
            .rim_labels(None)
            .into_iter()
            .any(|label| label.0 == Side::Above);
        if above { 12.0 } else { 0.0 }
    }

    /// Draws everything but captions and legends; axis titles keep `title_distance` from the frame.
    pub(super) fn draw(
        &self,
        svg: &mut Svg,
        frame: &Frame,
        labels: [bool; 2],
        title_distance: f64,
    ) {
        let ticks = [
            self.x_ticks(frame),
            frame.y.ticks(vertical_count(frame.area.height)),
        ];
        if self.has_grid && !self.is_bare {
            draw_grid(svg, frame, &ticks);
        }
        svg.begin_clip(&frame.area);
        self.layers.iter().for_each(|layer| layer.draw(svg, frame));
        svg.end_group();
        if !self.is_bare {
            svg.rectangle(&frame.area, "none", Some(&Stroke::solid(INK, 0.6)));
            draw_x_axis(svg, frame, &ticks[0], labels[0]);
            draw_y_axis(svg, frame, &ticks[1], labels[1].then_some(title_distance));
        }
        self.layers
            .iter()
            .for_each(|layer| layer.draw_over(svg, frame));
        if !self.has_data() {
            let (x, y) = (
                frame.area.x + 0.5 * frame.area.width,
                frame.area.y + 0.5 * frame.area.height,
            );
            let style = TextStyle::new(TITLE_SIZE)
                .anchored(Anchor::Middle)
                .coloured(MUTED);
            svg.text(x, y, "no data", &style);
        }
        super::marks::draw_rim_labels(svg, frame, &self.rim_labels(Some(frame)));
        self.draw_bar(svg, frame);
    }

    fn draw_bar(&self, svg: &mut Svg, frame: &Frame) {
        let area = &frame.area;
        match (self.bar, self.colours()) {
            (Some(Side::Right), Some(colours)) => {
                let width = self.right_need() - colours.bar_width(self.height.min(150.0));
                colours.draw_bar(svg, area.right() + width.max(0.0) + 7.0, area);
            }
            (Some(_), Some(colours)) => {
                let left = area.x + 0.09 * area.width;
                colours.draw_flat_bar(svg, (left, area.bottom() + 5.0), 0.82 * area.width);
            }
            _ => {}
        }
    }

    fn x_ticks(&self, frame: &Frame) -> Vec<super::ruler::Tick> {
        let sample = widest(&frame.x.ticks(4), LABEL_SIZE).max(8.0);
        let count = (frame.area.width / (1.4 * sample + 8.0)) as usize;
        frame.x.ticks(count.clamp(1, 9))
    }
}

/// Ticks that fit a vertical axis of this height.
pub(super) fn vertical_count(height: f64) -> usize {
    ((height / 17.0) as usize).clamp(1, 8)
}

fn draw_grid(svg: &mut Svg, frame: &Frame, [x, y]: &[Vec<super::ruler::Tick>; 2]) {
    let (area, stroke) = (&frame.area, Stroke::solid(GRID, 0.4));
    for tick in x {
        let x = area.x + area.width * frame.x.place(tick.value);
        svg.line((x, area.y), (x, area.bottom()), &stroke);
    }
    for tick in y {
        let y = area.bottom() - area.height * frame.y.place(tick.value);
        svg.line((area.x, y), (area.right(), y), &stroke);
    }
}

fn draw_x_axis(svg: &mut Svg, frame: &Frame, ticks: &[super::ruler::Tick], labels: bool) {
    let (area, bottom) = (&frame.area, frame.area.bottom());
    let at = |value: f64| area.x + area.width * frame.x.place(value);
    let minor = frame.x.minor_ticks();
    let mut marks = Path::new();
    let lengths = minor.iter().map(|&v| (v, 0.6 * TICK));
    for (value, length) in lengths.chain(ticks.iter().map(|tick| (tick.value, TICK))) {
        marks.extend([(at(value), bottom), (at(value), bottom + length)]);
    }
    svg.path(&marks, &Stroke::solid(INK, 0.6));
    if !labels {
        return;
    }
    let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::Middle);
    for tick in ticks {
        svg.text(
            at(tick.value),
            bottom + TICK + LABEL_SIZE + 1.0,
            &tick.label,
            &style,
        );
    }
    let baseline = bottom + TICK + LABEL_SIZE + TITLE_SIZE + 4.0;
    let style = TextStyle::new(TITLE_SIZE).anchored(Anchor::Middle);
    svg.text(
        area.x + 0.5 * area.width,
        baseline,
        &frame.x.full_title(),
        &style,
    );
}

/// Draws the vertical axis, with labels where its title has a distance.
fn draw_y_axis(svg: &mut Svg, frame: &Frame, ticks: &[super::ruler::Tick], title: Option<f64>) {
    let (area, left) = (&frame.area, frame.area.x);
    let at = |value: f64| area.bottom() - area.height * frame.y.place(value);
    let minor = frame.y.minor_ticks();
    let mut marks = Path::new();
    let lengths = minor.iter().map(|&v| (v, 0.6 * TICK));
    for (value, length) in lengths.chain(ticks.iter().map(|tick| (tick.value, TICK))) {
        marks.extend([(left, at(value)), (left - length, at(value))]);
    }
    svg.path(&marks, &Stroke::solid(INK, 0.6));
    let Some(distance) = title else { return };
    let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::End);
    for tick in ticks {
        svg.text(
            left - TICK - 1.8,
            at(tick.value) + 0.36 * LABEL_SIZE,
            &tick.label,
            &style,
        );
    }
    let style = TextStyle::new(TITLE_SIZE)
        .anchored(Anchor::Middle)
        .rotated(-90.0);
    svg.text(
        left - distance,
        area.y + 0.5 * area.height,
        &frame.y.full_title(),
        &style,
    );
}
