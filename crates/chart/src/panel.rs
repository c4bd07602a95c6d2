//! One plot: two axes and the layers between them.

use super::frame::{TICK, draw_grid, draw_x_axis, draw_y_axis};
use super::marks::{RIM_SIZE, draw_rim_labels};
use crate::prelude::*;

/// A plot of a figure.
#[derive(Default, Serialize, Deserialize)]
pub struct Panel {
    pub(super) x: Axis,
    pub(super) y: Axis,
    layers: Vec<Drawn>,
    pub(super) caption: String,
    pub(super) headings: Vec<(String, Colour)>,
    pub(super) height: f64,
    pub(super) is_plane: bool,
    pub(super) is_bare: bool,
    has_grid: bool,
    pub(super) has_legend: bool,
    bar: Option<Side>,
    pub(super) span: usize,
}

impl Panel {
    /// A plot over two axes.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, height: 120.0, has_grid: true, span: 1, ..Self::default() }
    }

    /// A picture of the plane between two corners, as wide as high in equal units, without axes.
    pub fn plane([low, high]: [[f64; 2]; 2]) -> Self {
        let axis = |i: usize| Axis::new("", "").between(low[i], high[i]);
        let panel = Self::new(axis(0), axis(1)).plain().height(165.0);
        Self { is_plane: true, is_bare: true, ..panel }
    }

    /// The same with more layers.
    pub fn layers<L: Into<Drawn>>(self, layers: impl IntoIterator<Item = L>) -> Self {
        layers.into_iter().fold(self, Self::layer)
    }

    pub(super) fn is_whole(&self) -> bool {
        self.span > 0
            && self.height > 0.0
            && self.height.is_finite()
            && self.layers.iter().all(|layer| layer.is_whole())
    }

    /// Whether it has a point of data to show.
    pub(super) fn has_data(&self) -> bool {
        self.layers.iter().filter(|layer| layer.is_data()).any(|layer| {
            let mut found = false;
            layer.extent(&mut |x, y| found |= x.is_finite() && y.is_finite());
            found
        })
    }

    /// Ranges of the data; where the horizontal ends are given, the vertical range is that of what lies between them.
    pub(super) fn ranges(&self) -> [Option<(f64, f64)>; 2] {
        let (given, logarithmic) =
            (self.x.given(), [self.x.is_logarithmic(), self.y.is_logarithmic()]);
        let mut seen: [Option<(f64, f64)>; 2] = [None; 2];
        for layer in self.layers.iter().filter(|layer| layer.is_data()) {
            layer.extent(&mut |x, y| {
                let is_outside = given.is_some_and(|(low, high)| x < low || x > high);
                for ((value, seen), logarithmic) in
                    [x, y].into_iter().zip(&mut seen).zip(logarithmic)
                {
                    if !is_outside && value.is_finite() && (value > 0.0 || !logarithmic) {
                        let (low, high) = seen.unwrap_or((value, value));
                        *seen = Some((low.min(value), high.max(value)));
                    }
                }
            });
        }
        seen
    }

    /// Its axes over its own data.
    pub(super) fn rulers(&self) -> [Ruler; 2] {
        let [x, y] = self.ranges();
        [self.x.resolve(x), self.y.resolve(y)]
    }

    /// Leaves out of its layers what no drawing shows.
    pub(super) fn thin(&mut self) {
        let [x, _] = self.rulers();
        let fraction_of = |value: f64| x.fraction(value);
        for layer in &mut self.layers {
            match layer {
                Drawn::Line(line) => line.thin(&fraction_of),
                Drawn::Fill(fill) => fill.thin(&fraction_of),
                _ => {}
            }
        }
    }

    /// Its numbers in the units that its axes show.
    pub(super) fn data(&self) -> PanelData {
        let [x, y] = self.rulers();
        let shown = |mut series: Series| {
            for (values, ruler) in [(&mut series.xs, &x), (&mut series.ys, &y)] {
                values.iter_mut().for_each(|v| *v = ruler.shown(*v));
            }
            series
        };
        let headings = self.headings.iter().map(|heading| &heading.0);
        let title: Vec<String> = match self.caption.as_str() {
            "" => headings.map(|heading| plain(heading)).collect(),
            caption => vec![plain(caption)],
        };
        let (mut rules, mut labels) = (Vec::new(), Vec::new());
        for layer in &self.layers {
            match layer {
                Drawn::Rule(rule) => {
                    let ruler = if rule.is_horizontal { &y } else { &x };
                    rules.push((rule.is_horizontal, ruler.shown(rule.value)));
                }
                Drawn::Label(Label { place, text, .. }) => {
                    labels.push((x.shown(place.0), y.shown(place.1), plain(text)));
                }
                _ => {}
            }
        }
        let series = self.layers.iter().flat_map(|layer| layer.series()).map(shown).collect();
        PanelData { caption: title.join(", "), series, rules, labels, axes: [x, y] }
    }

    /// Legend entries of what is seen in a frame.
    pub(super) fn add_keys(&self, frame: &Frame, legend: &mut Legend) {
        for layer in &self.layers {
            let keys: Vec<(Key, String)> = layer.keys();
            let mut is_seen = false;
            if !keys.is_empty() {
                let shows =
                    |ruler: &Ruler, value: f64| value.is_infinite() || ruler.contains(value);
                layer.extent(&mut |x, y| {
                    is_seen |= !(x.is_infinite() && y.is_infinite())
                        && shows(&frame.x, x)
                        && shows(&frame.y, y);
                });
            }
            keys.into_iter().filter(|_| is_seen).for_each(|key| legend.add(key));
        }
    }

    fn colours(&self) -> Option<&Colours> {
        self.layers.iter().find_map(|layer| layer.colours())
    }

    /// Rules whose places are named beyond the frame, with these names.
    fn rim_labels(&self) -> Vec<(&Rule, &str)> {
        let labels = self.layers.iter().filter_map(|layer| match layer {
            Drawn::Rule(rule) => Some((rule, rule.rim.as_deref()?)),
            _ => None,
        });
        labels.collect()
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

    /// Room that names at the right of the frame take, points.
    pub(super) fn names_width(&self) -> f64 {
        let names = self.rim_labels().into_iter().filter(|(rule, _)| rule.is_horizontal);
        let widths = names.map(|label| text::width(label.1, RIM_SIZE, false) + 8.0);
        widths.fold(0.0, f64::max)
    }

    /// Room needed right of the data area, points; names may stand inside it.
    pub(super) fn right_need(&self, are_names_inside: bool) -> f64 {
        let names = if are_names_inside { 0.0 } else { self.names_width() };
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
            (Some(Side::Below), Some(_)) => 3.0 + FLAT_BAR_HEIGHT,
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
        let is_above = self.rim_labels().into_iter().any(|(rule, _)| !rule.is_horizontal);
        if is_above { 12.0 } else { 0.0 }
    }

    /// Draws everything but captions and legends; axis titles keep `title_distance` from the frame.
    pub(super) fn draw(
        &self,
        svg: &mut Svg,
        frame: &Frame,
        labels: [bool; 2],
        (title_distance, are_names_inside): (f64, bool),
    ) {
        let ticks = [self.x_ticks(frame), frame.y.ticks(vertical_count(frame.area.height))];
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
        for layer in &self.layers {
            layer.draw_over(svg, frame);
        }
        if !self.has_data() {
            let (area, style) = (&frame.area, TextStyle::new(TITLE_SIZE));
            let (x, y) = (area.x + 0.5 * area.width, area.y + 0.5 * area.height);
            let style = style.anchored(Anchor::Middle).coloured(MUTED);
            svg.text(x, y, "no data", &style);
        }
        draw_rim_labels(svg, frame, &self.rim_labels(), are_names_inside);
        self.draw_bar(svg, frame, are_names_inside);
    }

    fn draw_bar(&self, svg: &mut Svg, frame: &Frame, are_names_inside: bool) {
        let area = &frame.area;
        match (self.bar, self.colours()) {
            (Some(Side::Right), Some(colours)) => {
                let width =
                    self.right_need(are_names_inside) - colours.bar_width(self.height.min(150.0));
                colours.draw_bar(svg, area.right() + width.max(0.0) + 7.0, area);
            }
            (Some(_), Some(colours)) => {
                let left = area.x + 0.09 * area.width;
                colours.draw_flat_bar(svg, (left, area.bottom() + 5.0), 0.82 * area.width);
            }
            _ => {}
        }
    }

    fn x_ticks(&self, frame: &Frame) -> Vec<Tick> {
        let sample = widest(&frame.x.ticks(4), LABEL_SIZE).max(8.0);
        let count = (frame.area.width / (1.4 * sample + 8.0)) as usize;
        frame.x.ticks(count.clamp(1, 9))
    }
}

changed! { Panel:
    /// The same with one more layer over those it has.
    layer(layer: impl Into<Drawn>) => [layers: [layer.into()]]
    /// The same with a line of heading above its middle.
    heading(line: impl Into<String>) => [headings: [(line.into(), INK.into())]]
    /// The same with a line of heading in a colour.
    heading_in(colour: impl Into<Colour>, line: impl Into<String>) => [
        headings: [(line.into(), colour.into())]
    ]
    /// The same with equal units on both axes, which must have given ends.
    equal() => { is_plane: true }
    /// The same with a caption above its left corner.
    caption(caption: impl Into<String>) => { caption: caption.into() }
    /// The same with a height of the data area, points; of a plane, the largest.
    height(height: f64) => { height: height }
    /// The same without grid lines.
    plain() => { has_grid: false }
    /// The same with a legend of its own above it.
    legend() => { has_legend: true }
    /// The same with the scale of its colours at a side.
    colour_bar(side: Side) => { bar: Some(side) }
    /// The same beside so many rows of other panels.
    beside(rows: usize) => { span: rows.max(1) }
}
