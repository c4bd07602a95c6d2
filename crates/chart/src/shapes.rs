//! Bars and filled shapes.

use super::colour::{Colour, INK};
use super::frame::{Frame, LABEL_SIZE};
use super::layer::Layer;
use super::legend::Key;
use super::path::Path;
use super::svg::{Rect, Svg};
use super::text::{self, Anchor, TextStyle};
use serde::{Deserialize, Serialize};

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
        let place = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().map(|&(x, y)| frame.at(x, y)).collect()
        };
        let mut colours: Vec<Colour> = self.polygons.iter().map(|p| p.1).collect();
        colours.dedup();
        for colour in colours {
            let mut path = Path::new();
            for (points, _) in self.polygons.iter().filter(|polygon| polygon.1 == colour) {
                path.extend(place(points));
                path.close();
            }
            svg.fill_path(&path, colour, 1.0);
        }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        self.names.clone()
    }

    fn is_data(&self) -> bool {
        !self.polygons.is_empty()
    }
}
