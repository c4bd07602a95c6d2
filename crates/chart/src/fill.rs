//! Filled areas.

use super::colour::Colour;
use super::data::{Series, SeriesKind};
use super::decimation::{COLUMNS_PER_POINT, lasting};
use super::frame::Frame;
use super::layer::Layer;
use super::legend::Key;
use super::path::Path;
use super::svg::Svg;
use super::text::plain;
use serde::{Deserialize, Serialize};

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
        let key = Key::patch(self.colour, self.opacity);
        self.name.iter().map(|name| (key, name.clone())).collect()
    }

    fn series(&self) -> Vec<Series> {
        if self.is_range {
            return Vec::new();
        }
        // Of areas stacked on others the height is the quantity.
        let heights = self.points.iter().map(|[x, one, other]| (*x, other - one));
        vec![Series {
            name: self.name.as_deref().map(plain).unwrap_or_default(),
            ..Series::new(SeriesKind::Line, self.colour, heights)
        }]
    }
}
