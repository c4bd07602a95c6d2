//! The numbers behind a figure, for readers who can do more than look: zoom, values under the pointer, tables, motion.

use super::colour::Colour;
use super::ruler::Ruler;
use serde::{Deserialize, Serialize};

/// The numbers of a panel.
#[derive(Clone, Debug)]
pub struct PanelData {
    /// What it shows, in plain text.
    pub caption: String,
    /// Horizontal and vertical axis.
    pub axes: [Ruler; 2],
    /// Curves, points, fields in the order of their layers.
    pub series: Vec<Series>,
    /// Lines across the panel: whether each lies at an ordinate, else at an abscissa, and where.
    pub rules: Vec<(bool, f64)>,
    /// Texts at places, plain.
    pub labels: Vec<(f64, f64, String)>,
}

/// How a series is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
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
