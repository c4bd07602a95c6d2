//! The numbers behind a figure, for readers who can do more than look: zoom, values under the pointer, tables, motion.

use crate::prelude::*;

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

/// A body and what it shows: motions, or its parts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// 2 for a plane body, 3 for a solid one that the reader turns.
    pub dimension: usize,
    /// Places of the nodes at rest, m; the third coordinate of a plane body is zero.
    #[serde(with = "Levels::<65_534>")]
    pub positions: Vec<[f64; 3]>,
    /// Nodes around each element of a plane body, around each face of the surface of a solid one.
    #[serde(with = "lists")]
    pub cells: Vec<Vec<u32>>,
    /// Nodes of the contact edge, in order.
    pub edge: Vec<u32>,
    /// Edges of a solid body that are drawn, by their ends.
    #[serde(with = "whole")]
    pub lines: Vec<[u32; 2]>,
    /// What there is to choose from.
    pub states: Vec<MotionState>,
}

/// One motion, or one way to tell parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionState {
    /// Its name in plain text.
    pub name: String,
    /// Frequency, Hz; zero for what is at rest.
    pub frequency_hz: f64,
    /// What moves.
    pub kind: MotionKind,
}

/// How a body moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MotionKind {
    /// `Re((real + i imaginary) exp(i omega t))` of every node, along x, y and z, to any scale.
    Harmonic {
        /// Real part.
        #[serde(with = "Levels::<254>")]
        real: Vec<[f64; 3]>,
        /// Imaginary part.
        #[serde(with = "Levels::<254>")]
        imaginary: Vec<[f64; 3]>,
    },
    /// A wave that turns about the origin without changing its shape.
    Turning {
        /// Displacement at time zero of every node, along x, y and z, m.
        #[serde(with = "Levels::<65_534>")]
        displacement: Vec<[f64; 3]>,
        /// Turn in a period, rad, counter-clockwise.
        turn: f64,
        /// Contact status along the edge at time zero: 0 open, 1 stick, 2 slip.
        status: Vec<u8>,
    },
    /// No motion: cells in the colours of their parts.
    Parts {
        /// The part of each cell.
        part_of: Vec<u32>,
        /// Colour and name of each part; "" for one that is not there.
        parts: Vec<(Colour, String)>,
    },
}
