//! The numbers behind a figure, for readers who can do more than look: zoom, values under the pointer, tables, motion.

use super::colour::Colour;
use super::motion::Motion;
use super::ruler::Ruler;
use super::text::plain;
use serde::{Deserialize, Serialize};

/// Everything of a figure that a page with scripts can show besides the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FigureData {
    /// Its panels, in reading order.
    pub panels: Vec<PanelData>,
    /// A body that moves.
    pub motion: Option<Motion>,
    /// A parameter that moves points of the first panel.
    pub steps: Option<Steps>,
}

/// The numbers of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelData {
    /// What it shows, in plain text.
    pub caption: String,
    /// Horizontal and vertical axis.
    pub axes: [AxisData; 2],
    /// Curves, points, fields in the order of their layers.
    pub series: Vec<Series>,
    /// Lines across the panel: whether each lies at an ordinate, else at an abscissa, and where.
    pub rules: Vec<(bool, f64)>,
    /// Texts at places, plain.
    pub labels: Vec<(f64, f64, String)>,
}

/// An axis as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisData {
    /// Quantity and unit, in plain text.
    pub title: String,
    /// Whether it is logarithmic.
    pub is_logarithmic: bool,
    /// Its ends in the unit shown.
    pub ends: [f64; 2],
}

impl AxisData {
    pub(super) fn of(ruler: &Ruler) -> Self {
        Self {
            title: plain(&ruler.title),
            is_logarithmic: ruler.is_logarithmic(),
            ends: [ruler.low, ruler.high],
        }
    }
}

/// How a series is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeriesKind {
    /// A curve.
    Line,
    /// A dashed curve.
    Dashed,
    /// Single points.
    Points,
    /// Values over places of the plane, not drawn again.
    Field,
}

/// One curve, set of points or field; in the units of the program until its panel brings it to those of its axes.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in plain text; empty where the figure names none.
    pub name: String,
    /// How it is shown.
    pub kind: SeriesKind,
    /// Colour, `#rrggbb`.
    pub colour: Colour,
    /// Abscissae.
    pub xs: Vec<f64>,
    /// Ordinates.
    pub ys: Vec<f64>,
    /// Value at each place and its name, of a field.
    pub values: Option<(String, Vec<f64>)>,
    /// Number of the row of a table that each point stands for.
    pub rows: Vec<usize>,
    /// What each point is, in plain text; empty where its coordinates say all.
    pub tips: Vec<String>,
    /// Whether no sample may be left out, as of a signal that is listened to.
    pub is_whole: bool,
}

impl Series {
    /// Points without names or values, of which some may be left out.
    pub(super) fn new(
        kind: SeriesKind,
        colour: Colour,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (xs, ys) = points.into_iter().unzip();
        let (name, rows, tips) = (String::new(), Vec::new(), Vec::new());
        Self { name, kind, colour, xs, ys, values: None, rows, tips, is_whole: false }
    }
}

/// By what its numbers say: gaps, which are not numbers, equal each other.
impl PartialEq for Series {
    fn eq(&self, other: &Self) -> bool {
        format!("{self:?}") == format!("{other:?}")
    }
}

/// Points that move with a parameter: eigenvalues over friction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// The parameter, in plain text.
    pub quantity: String,
    /// Its values, rising.
    pub values: Vec<f64>,
    /// The points at each value.
    pub marks: Vec<Vec<Mark>>,
}

/// A point that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Place, in the units of the program.
    pub place: (f64, f64),
    /// What it is, in plain text.
    pub name: String,
    /// Whether it is one of those that are listed: an unstable mode.
    pub is_listed: bool,
}
