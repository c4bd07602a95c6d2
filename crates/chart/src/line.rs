//! Curves and data points, their markers, and the looks by which series are told apart.

use crate::prelude::*;

/// A curve; one with rising abscissae is thinned with its extremes kept, values that are not finite break it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    xs: Vec<f64>,
    ys: Vec<f64>,
    stroke: Stroke,
    marker: Option<(Marker, f64)>,
    arrows: usize,
    pub(super) name: Option<String>,
    label: Option<String>,
    is_whole: bool,
}

impl Line {
    /// A curve through `(xs[i], ys[i])`.
    pub fn new(xs: &[f64], ys: &[f64]) -> Self {
        Self::through(xs.iter().copied().zip(ys.iter().copied()))
    }

    /// A curve through points.
    pub fn through(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (xs, ys) = points.into_iter().unzip();
        let stroke = Stroke::solid(SERIES[0], 1.1);
        Self { xs, ys, stroke, marker: None, arrows: 0, name: None, label: None, is_whole: false }
    }

    /// The same as the `index`-th of several series, with its colour; neighbours differ in their dashes, too.
    pub fn nth(mut self, index: usize) -> Self {
        let (colour, dash) = (look(index).0, look(SERIES.len() * index).2);
        self.stroke = Stroke { colour: colour.into(), ..self.stroke }.dashes(dash);
        self
    }

    /// The unbroken pieces as they are drawn.
    fn pieces(&self, frame: &Frame) -> Vec<Vec<(f64, f64)>> {
        let thinned = match self.xs.is_sorted() {
            true => keep_extremes(&self.xs, &self.ys, |x| frame.at_x(x) * COLUMNS_PER_POINT),
            false => self.points().collect(),
        };
        let pieces = thinned.split(|&(x, y)| !frame.has_place(x, y));
        let places = pieces.map(|piece| -> Vec<(f64, f64)> {
            let places = piece.iter().map(|&(x, y)| frame.at(x, y));
            simplify(&places.collect::<Vec<_>>(), INVISIBLE)
        });
        places.filter(|piece| !piece.is_empty()).collect()
    }

    /// Leaves out what no drawing shows of a long curve over rising abscissae.
    pub(super) fn thin(&mut self, fraction_of: &dyn Fn(f64) -> f64) {
        if self.xs.is_sorted() && !self.is_whole {
            let kept = lasting(&self.xs, &self.ys, fraction_of).into_iter();
            (self.xs, self.ys) = kept.map(|at| (self.xs[at], self.ys[at])).unzip();
        }
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.xs.iter().copied().zip(self.ys.iter().copied())
    }
}

changed! { Line:
    /// The same, full, in a colour and with a width in points.
    solid(colour: impl Into<Colour>, width: f64) => { stroke: Stroke::solid(colour, width) }
    /// The same with an entry in the legend.
    name(name: impl Into<String>) => { name: Some(name.into()) }
    /// The same with a stroke.
    stroke(stroke: Stroke) => { stroke: stroke }
    /// The same with a marker of this radius (points) at every point.
    marked(marker: Marker, radius: f64) => { marker: Some((marker, radius)) }
    /// The same with so many arrow heads along it.
    arrows(arrows: usize) => { arrows: arrows }
    /// The same with a name for those who take the numbers, which the legend does not show.
    label(label: impl Into<String>) => { label: Some(label.into()) }
    /// The same, with every sample kept for those who take the numbers: a signal to listen to.
    whole() => { is_whole: true }
}

impl Layer for Line {
    fn is_whole(&self) -> bool {
        self.xs.len() == self.ys.len()
    }

    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        self.points().for_each(|(x, y)| see(x, y));
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        svg.path(&Path::of(self.pieces(frame), false), &self.stroke);
    }

    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        if let Some((marker, radius)) = self.marker {
            marker.draw(svg, frame.inside(self.points()), radius, self.stroke.colour);
        }
        if self.arrows > 0 {
            let pieces = self.pieces(frame).into_iter();
            let heads = pieces.flat_map(|piece| arrow_heads(&piece, self.arrows));
            svg.fill_path(&Path::of(heads, true), INK, 1.0);
        }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        let key = Key {
            // The finest lines still show their colour in a legend.
            stroke: Some(Stroke { width: self.stroke.width.max(0.8), ..self.stroke }),
            marker: self.marker.map(|m| (m.0, self.stroke.colour)),
            ..Key::default()
        };
        self.name.iter().map(|name| (key, name.clone())).collect()
    }

    fn series(&self) -> Vec<Series> {
        // A line without width carries the arrows of others.
        if !(self.stroke.width > 0.0) || self.xs.is_empty() {
            return Vec::new();
        }
        let kind = if self.stroke.is_dashed() { SeriesKind::Dashed } else { SeriesKind::Line };
        vec![Series {
            name: exported_name(self.label.as_ref(), self.name.as_ref()),
            is_whole: self.is_whole,
            ..Series::new(kind, self.stroke.colour, self.points())
        }]
    }
}

/// What a series is called in the numbers of a figure: its label, or its name in the legend.
fn exported_name(label: Option<&String>, name: Option<&String>) -> String {
    label.or(name).map(|text| plain(text)).unwrap_or_default()
}

/// An arrow head on the longest step of each part of a curve: which way it is run through.
fn arrow_heads(points: &[(f64, f64)], count: usize) -> Vec<[(f64, f64); 3]> {
    let mut heads = Vec::new();
    let steps: Vec<_> = points.windows(2).map(|pair| (pair[0], pair[1])).collect();
    let length = |((ax, ay), (bx, by)): ((f64, f64), (f64, f64))| (bx - ax).hypot(by - ay);
    for part in steps.chunks(steps.len().div_ceil(count).max(1)) {
        // A head is never longer than the part of the curve that it stands on.
        let size = (part.iter().copied().map(length).sum::<f64>() / 14.0).min(1.0);
        if size < 0.35 {
            continue;
        }
        let longest = part.iter().copied().max_by(|&a, &b| length(a).total_cmp(&length(b)));
        let Some(step) = longest.filter(|&step| length(step) > 0.0) else { continue };
        let ((ax, ay), (bx, by)) = step;
        let (dx, dy) = ((bx - ax) / length(step), (by - ay) / length(step));
        let (x, y) = (0.5 * (ax + bx), 0.5 * (ay + by));
        let corner = |along: f64, across: f64| {
            let (along, across) = (size * along, size * across);
            (x + along * dx - across * dy, y + along * dy + across * dx)
        };
        heads.push([corner(3.2, 0.0), corner(-2.4, 2.1), corner(-2.4, -2.1)]);
    }
    heads
}

/// Data points, whole even at the ends of an axis.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Points {
    points: Vec<(f64, f64)>,
    marker: Marker,
    radius: f64,
    colour: Colour,
    pub(super) name: Option<String>,
    label: Option<String>,
    rows: Vec<usize>,
    tips: Vec<String>,
    key: Option<Stroke>,
}

impl Points {
    /// Discs at points.
    pub fn new(points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let (points, colour) = (points.into_iter().collect(), SERIES[0].into());
        Self { points, radius: 2.0, colour, ..Self::default() }
    }
}

changed! { Points:
    /// The same with an entry in the legend.
    name(name: impl Into<String>) => { name: Some(name.into()) }
    /// The same with a line in place of the marker in the legend.
    keyed(stroke: Stroke) => { key: Some(stroke) }
    /// The same with a name for those who take the numbers, which the legend does not show.
    label(label: impl Into<String>) => { label: Some(label.into()) }
    /// The same with what each point is, in plain text, for readers who point at it.
    tips(tips: Vec<String>) => { tips: tips }
    /// The same with a marker of this radius, points, and colour.
    marker(marker: Marker, radius: f64, colour: impl Into<Colour>) => {
        marker: marker, radius: radius, colour: colour.into()
    }
    /// The same, each point standing for the row of a table with this number.
    rows(rows: Vec<usize>) => { rows: rows }
}

impl Layer for Points {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        self.points.iter().for_each(|&(x, y)| see(x, y));
    }

    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        let places = frame.inside(self.points.iter().copied());
        self.marker.draw(svg, places, self.radius, self.colour);
    }

    fn keys(&self) -> Vec<(Key, String)> {
        let key = match self.key {
            Some(stroke) => Key::line(stroke),
            None => Key { marker: Some((self.marker, self.colour)), ..Key::default() },
        };
        self.name.iter().map(|name| (key, name.clone())).collect()
    }

    fn series(&self) -> Vec<Series> {
        // Points too small to see stand in legends only.
        if !(self.radius > 0.1) || self.points.is_empty() {
            return Vec::new();
        }
        vec![Series {
            name: exported_name(self.label.as_ref(), self.name.as_ref()),
            rows: self.rows.clone(),
            tips: self.tips.clone(),
            is_whole: true,
            ..Series::new(SeriesKind::Points, self.colour, self.points.iter().copied())
        }]
    }
}

/// Shape of a data point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Marker {
    /// Filled disc.
    #[default]
    Disc,
    /// Filled square.
    Square,
    /// Filled triangle.
    Triangle,
    /// Filled diamond.
    Diamond,
    /// Circle with a white inside.
    Circle,
}

impl Marker {
    /// The order in which series take markers.
    pub const ALL: [Self; 5] =
        [Self::Disc, Self::Square, Self::Triangle, Self::Diamond, Self::Circle];

    /// The corners of its outline, for the radius 1.
    fn outline(self) -> Vec<(f64, f64)> {
        match self {
            Self::Disc | Self::Circle => {
                let angle = |i: u8| f64::from(i) * std::f64::consts::TAU / 16.0;
                (0..16).map(|i| angle(i).sin_cos()).collect()
            }
            Self::Square => vec![(0.88, 0.88), (-0.88, 0.88), (-0.88, -0.88), (0.88, -0.88)],
            Self::Triangle => vec![(0.0, -1.2), (1.05, 0.75), (-1.05, 0.75)],
            Self::Diamond => vec![(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
        }
    }

    /// Draws markers at points of the drawing; one path for all of them.
    pub(super) fn draw(
        self,
        svg: &mut Svg,
        places: impl IntoIterator<Item = (f64, f64)>,
        radius: f64,
        colour: Colour,
    ) {
        if self == Self::Disc {
            svg.discs(&Path::dots(places), 2.0 * radius, colour);
            return;
        }
        let corners = self.outline();
        let around =
            |(x, y)| corners.iter().map(move |(dx, dy)| (x + radius * dx, y + radius * dy));
        let path = Path::of(places.into_iter().map(around), true);
        if self == Self::Circle {
            svg.fill_path(&path, "#ffffff", 1.0);
            svg.path(&path, &Stroke::solid(colour, 0.7));
        } else {
            svg.fill_path(&path, colour, 1.0);
        }
    }
}

/// Look of the `index`-th of several series: its colour, marker and dashes, which together do not repeat before the
/// 35th.
pub fn look(index: usize) -> (&'static str, Marker, &'static [f64]) {
    const DASHES: [&[f64]; 3] = [&[], &[4.0, 1.6], &[1.2, 1.2]];
    let dashes = DASHES[index / SERIES.len() % DASHES.len()];
    (SERIES[index % SERIES.len()], Marker::ALL[index % Marker::ALL.len()], dashes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whoever sees no colours tells neighbours, and any two of the first three, by their dashes.
    #[test]
    fn several_series_are_told_by_more_than_colour() {
        let strokes: Vec<Stroke> = (0..21).map(|at| Line::through([]).nth(at).stroke).collect();
        for (at, one) in strokes.iter().enumerate() {
            assert_ne!(one.dash, strokes[(at + 1) % 21].dash, "{at}");
            assert_ne!(one.dash, strokes[(at + 2) % 21].dash, "{at}");
            let is_same = |other: &&Stroke| (other.dash, other.colour) == (one.dash, one.colour);
            assert_eq!(strokes.iter().filter(is_same).count(), 1, "{at}");
        }
    }
}
