//! Bars, filled areas and shapes.

use crate::prelude::*;

/// Lying bars of equal thickness, each with a label inside where it fits.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bars {
    /// From, to, ordinate of the middle, label.
    bars: Vec<(f64, f64, f64, String)>,
    colour: Colour,
}

impl Bars {
    /// Bars from one abscissa to another at an ordinate, each with a label in mark-up.
    pub fn new(bars: Vec<(f64, f64, f64, String)>, colour: impl Into<Colour>) -> Self {
        Self { bars, colour: colour.into() }
    }
}

impl Layer for Bars {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        for (from, to, at, _) in &self.bars {
            see(*from, *at);
            see(*to, *at);
        }
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        for (from, to, at, _) in &self.bars {
            let (left, right, y) = (frame.at_x(*from), frame.at_x(*to), frame.at_y(*at));
            let bar = Rect::new(left, y - 5.5, (right - left).max(1.0), 11.0);
            svg.rectangle(&bar, self.colour, None);
        }
    }

    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        for (from, to, at, label) in &self.bars {
            let (left, right) = (frame.at_x(*from), frame.at_x(*to));
            let width = text::width(label, LABEL_SIZE, false) + 6.0;
            // Inside the bar where it fits, else at the side that has room.
            let (x, anchor, colour) = if right - left > width {
                (left + 3.0, Anchor::Start, "#ffffff")
            } else if left - width > frame.area.x {
                (left - 3.0, Anchor::End, INK)
            } else {
                (right + 3.0, Anchor::Start, INK)
            };
            let style = TextStyle::new(LABEL_SIZE).anchored(anchor).coloured(colour);
            svg.text(x, frame.at_y(*at) + 0.36 * LABEL_SIZE, label, &style);
        }
    }
}

/// Filled areas, one path for each style.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Shapes {
    polygons: Vec<(Vec<(f64, f64)>, Colour)>,
    bands: Vec<(f64, f64, Colour)>,
    names: Vec<(Key, String)>,
}

impl Shapes {
    /// Polygons, each in a colour.
    pub fn polygons(polygons: Vec<(Vec<(f64, f64)>, &str)>) -> Self {
        let polygons = polygons.into_iter().map(|(at, colour)| (at, colour.into())).collect();
        Self { polygons, ..Self::default() }
    }

    /// Bands over the whole height, each from one abscissa to another in a colour.
    pub fn bands(bands: Vec<(f64, f64, &str)>) -> Self {
        let bands = bands.into_iter().map(|(from, to, colour)| (from, to, colour.into())).collect();
        Self { bands, ..Self::default() }
    }
}

changed! { Shapes:
    /// The same without entries in the legend.
    unnamed() => { names: Vec::new() }
    /// The same with an entry in the legend.
    name(key: Key, name: impl Into<String>) => [names: [(key, name.into())]]
}

impl Layer for Shapes {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        for (x, y) in self.polygons.iter().flat_map(|(points, _)| points) {
            see(*x, *y);
        }
        self.bands.iter().for_each(|band| see(band.0, f64::INFINITY));
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let ends = frame.y.ends();
        for (from, to, colour) in &self.bands {
            svg.rectangle(&frame.rect((*from, *to), ends), colour, None);
        }
        let mut colours: Vec<Colour> = self.polygons.iter().map(|p| p.1).collect();
        colours.dedup();
        for colour in colours {
            let own = self.polygons.iter().filter(|polygon| polygon.1 == colour);
            let places = own.map(|(points, _)| points.iter().map(|&(x, y)| frame.at(x, y)));
            svg.fill_path(&Path::of(places, true), colour, 1.0);
        }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        self.names.clone()
    }

    fn is_data(&self) -> bool {
        !self.polygons.is_empty()
    }
}

/// A filled area between two curves over the same rising abscissae.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Fill {
    /// Abscissa, one bound, the other.
    points: Vec<[f64; 3]>,
    is_range: bool,
    colour: Colour,
    opacity: f64,
    pub(super) name: Option<String>,
}

impl Fill {
    /// The area between two curves.
    pub fn between(xs: &[f64], one: &[f64], other: &[f64], colour: impl Into<Colour>) -> Self {
        let points = xs.iter().zip(one.iter().zip(other));
        let points = points.map(|(&x, (&a, &b))| [x, a, b]).collect();
        Self { points, is_range: false, colour: colour.into(), opacity: 1.0, name: None }
    }

    /// The area between a level and a curve.
    pub fn from(level: f64, xs: &[f64], ys: &[f64], colour: impl Into<Colour>) -> Self {
        Self::between(xs, &vec![level; xs.len()], ys, colour)
    }

    /// The range that a quickly varying series covers.
    pub fn range_of(xs: &[f64], ys: &[f64], colour: impl Into<Colour>) -> Self {
        Self { is_range: true, ..Self::between(xs, ys, ys, colour) }
    }

    /// Leaves out what no drawing shows of a long area.
    pub(super) fn thin(&mut self, fraction_of: &dyn Fn(f64) -> f64) {
        let (xs, ys): (Vec<f64>, Vec<f64>) = self.points.iter().map(|p| (p[0], p[1])).unzip();
        let kept = lasting(&xs, &ys, fraction_of).into_iter();
        self.points = kept.map(|at| self.points[at]).collect();
    }
}

changed! { Fill:
    /// The same with an entry in the legend.
    name(name: impl Into<String>) => { name: Some(name.into()) }
    /// The same, transparent: 0 is invisible.
    opacity(opacity: f64) => { opacity: opacity }
}

impl Layer for Fill {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        // A range is drawn behind the line that the axis is made for.
        for &[x, a, b] in self.points.iter().filter(|_| !self.is_range) {
            see(x, a);
            see(x, b);
        }
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let per_point = if self.is_range { 1.5 } else { COLUMNS_PER_POINT };
        let mut columns: Vec<[f64; 3]> = Vec::new();
        let shown = self.points.iter().filter(|[x, a, b]| (x + a + b).is_finite());
        let last = self.points.last().map(|p| p[0]);
        for &[x, a, b] in shown {
            let place = [frame.at_x(x), frame.at_y(a), frame.at_y(b)];
            match columns.last_mut() {
                Some(column)
                    if (column[0] * per_point).floor() == (place[0] * per_point).floor() =>
                {
                    if self.is_range {
                        *column = [column[0], column[1].max(place[1]), column[2].min(place[2])];
                    } else if Some(x) == last {
                        columns.push(place);
                    }
                }
                _ => columns.push(place),
            }
        }
        let there = columns.iter().map(|c| (c[0], c[1]));
        let back = columns.iter().rev().map(|c| (c[0], c[2]));
        svg.fill_path(&Path::polyline(there.chain(back), true), self.colour, self.opacity);
    }

    fn keys(&self) -> Vec<(Key, String)> {
        self.name.iter().map(|name| (Key::patch(self.colour, self.opacity), name.clone())).collect()
    }

    fn series(&self) -> Vec<Series> {
        // A range and an area without a name are shades of other series.
        let Some(name) = self.name.as_deref().filter(|_| !self.is_range) else {
            return Vec::new();
        };
        // Of areas stacked on others the height is the quantity.
        let heights = self.points.iter().map(|[x, one, other]| (*x, other - one));
        vec![Series { name: plain(name), ..Series::new(SeriesKind::Line, self.colour, heights) }]
    }
}
