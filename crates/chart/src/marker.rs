//! Shapes of data points, and the looks by which series are told apart.

use super::colour::{Colour, SERIES};
use super::path::Path;
use super::svg::{Stroke, Svg};
use serde::{Deserialize, Serialize};

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

    /// Adds the outline to a path.
    fn outline(self, path: &mut Path, (x, y): (f64, f64), radius: f64) {
        let corners = match self {
            Self::Disc | Self::Circle => {
                let angle = |i: u8| f64::from(i) * std::f64::consts::TAU / 16.0;
                (0..16).map(|i| angle(i).sin_cos()).collect()
            }
            Self::Square => vec![(0.88, 0.88), (-0.88, 0.88), (-0.88, -0.88), (0.88, -0.88)],
            Self::Triangle => vec![(0.0, -1.2), (1.05, 0.75), (-1.05, 0.75)],
            Self::Diamond => vec![(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
        };
        path.extend(corners.iter().map(|(dx, dy)| (x + radius * dx, y + radius * dy)));
        path.close();
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
        let mut path = Path::new();
        for place in places {
            self.outline(&mut path, place, radius);
        }
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
    let colour = SERIES[index % SERIES.len()];
    let dashes = DASHES[index / SERIES.len() % DASHES.len()];
    (colour, Marker::ALL[index % Marker::ALL.len()], dashes)
}
