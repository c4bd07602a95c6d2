//! Results of `mac`: modal assurance of measured shapes.

use super::Finding;
use super::drawing::Declaration;
use frictionsim_chart::{Axis, ColourMap, Figure, Heat, INK, Marker, Panel, Points, Side};
use frictionsim_output::{Described, Document, Section, Table, columns};
use serde::Serialize;
use std::f64::consts::TAU;

/// `summary.json` of `mac`.
#[derive(Clone, Debug, Described, Serialize)]
pub struct MacSummary {
    /// The measured shapes.
    pub measurement: String,
    /// The friction coefficient of the modes.
    pub friction_coefficient: f64,
    /// The shapes.
    pub shapes: Vec<MacShape>,
    /// The modes.
    pub modes: Vec<MacMode>,
    /// The criterion, a row for each shape, a column for each mode.
    pub mac: Vec<Vec<f64>>,
    /// The mode of each shape.
    pub pairs: Vec<MacPair>,
    /// What there is to say.
    pub notes: Vec<String>,
}

/// A measured shape.
#[derive(Clone, Debug, Described, Serialize)]
pub struct MacShape {
    /// What the file calls it.
    pub name: String,
    /// Its frequency, Hz, where the file says it.
    pub frequency_hz: Option<f64>,
    /// Its points.
    pub points: usize,
    /// Those off the body, which are left out.
    pub off_body: usize,
    /// Largest distance of a point from its nearest node, m.
    pub largest_distance_m: f64,
}

/// A mode of the model.
#[derive(Clone, Copy, Debug, Described, Serialize)]
pub struct MacMode {
    /// Number by frequency, from 1.
    pub mode: usize,
    /// `Im(lambda) / 2 pi`, Hz.
    pub frequency_hz: f64,
    /// `Re(lambda) / 2 pi`, Hz.
    pub real_hz: f64,
    /// Nodal diameters; none without symmetry.
    pub harmonic: Option<usize>,
}

/// A shape and the mode that it is.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct MacPair {
    /// Shape, from 1.
    pub shape: usize,
    /// Mode, from 1.
    pub mode: usize,
    /// Their criterion.
    pub mac: f64,
}

/// A shape, a mode, their criterion, and whether they are a pair.
type Row = (MacShape, MacMode, f64, bool);

columns! {
    /// A shape beside a mode.
    pub(super) ROWS: row as Row;
    shape: "name of the measured shape" = row.0.name.clone(), Always "shape" Plain;
    measured_frequency_hz: "its frequency, where the file says it"
        = row.0.frequency_hz, IfAny "measured" Fixed(2);
    mode: "number of the mode by frequency, from 1" = row.1.mode, Always "mode" Count;
    frequency_hz: "its frequency" = row.1.frequency_hz, Always "frequency" Fixed(2);
    real_hz: "real part of its eigenvalue over 2 pi" = row.1.real_hz;
    harmonic: "its nodal diameters; none without symmetry" = row.1.harmonic, IfAny "n" Count;
    mac: "modal assurance criterion, 0 to 1" = row.2, Always "MAC" Fixed(4);
    paired: "whether the two are a pair" = row.3;
}

columns! {
    /// How the mode grows, and what is left out of a shape.
    BESIDE: row as Row;
    growth_rate_per_s = TAU * row.1.real_hz, Always "growth rate" Fixed(2);
    off_body = row.0.off_body, Always "points off the body" Count;
}

impl MacSummary {
    /// The row of a shape and a mode, both from 1.
    fn row(&self, shape: usize, mode: usize) -> Row {
        let is_pair = self.pairs.iter().any(|pair| (pair.shape, pair.mode) == (shape, mode));
        let value = self.mac[shape - 1][mode - 1];
        (self.shapes[shape - 1].clone(), self.modes[mode - 1], value, is_pair)
    }

    /// What was found, in a sentence.
    pub fn answer(&self) -> String {
        let good = self.pairs.iter().filter(|pair| pair.mac >= 0.9).count();
        let least = self.pairs.iter().map(|pair| pair.mac).fold(1.0, f64::min);
        format!(
            "{good} of {} shapes agree with a mode of their own by 0.9 or more; the least of all pairs has {least:.3}",
            self.shapes.len()
        )
    }
}

impl Finding for MacSummary {
    fn document(&self) -> Document {
        let all = (1..=self.shapes.len())
            .flat_map(|shape| (1..=self.modes.len()).map(move |mode| self.row(shape, mode)));
        let pairs: Vec<Row> =
            self.pairs.iter().map(|pair| self.row(pair.shape, pair.mode)).collect();
        let table = Table::new("", "The mode of each shape");
        let results = Section::new("Results")
            .facts([
                ("shapes", self.shapes.len().to_string()),
                ("modes", self.modes.len().to_string()),
                ("friction coefficient", self.friction_coefficient.to_string()),
            ])
            .text([self.answer()])
            .tables([table.columns(ROWS, &pairs).columns(BESIDE, &pairs)]);
        Document::new("Modal assurance")
            .section(results)
            .section(Section::new("Modal assurance").figures(["mac"]))
            .file(Table::new("mac.csv", "Each shape and each mode").columns(ROWS, all))
            .notes(&self.notes)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(matrix(self)))]
    }
}

/// The criterion over modes and shapes, pairs marked.
fn matrix(summary: &MacSummary) -> Figure {
    let (shapes, modes) = (summary.shapes.len(), summary.modes.len());
    let span = |count: usize| ((0.5, count as f64 + 0.5), count);
    let axis = Axis::new("modal assurance criterion", "").between(0.0, 1.0);
    let (colours, value) =
        ((axis, ColourMap::Viridis), |mode: usize, shape: usize| summary.mac[shape][mode]);
    let heat = Heat::of_values(span(modes), span(shapes), colours, value);
    let places = summary.pairs.iter().map(|pair| (pair.mode as f64, pair.shape as f64));
    let numbers = |name: &str, count: usize| {
        let (from, to) = span(count).0;
        Axis::new(name, "").between(from, to)
    };
    let panel = Panel::new(numbers("mode of the model", modes), numbers("measured shape", shapes))
        .height(150.0)
        .layer(heat)
        .layer(Points::new(places).marker(Marker::Circle, 2.6, INK))
        .colour_bar(Side::Right);
    Figure::new(
        "mac",
        "Modal assurance criterion of each measured shape with each mode; circles are the pairs.",
    )
    .panel(panel)
}
