//! Results of `mac`: modal assurance of measured shapes.

mod report;

use super::summary::{Entry, Summary};
use super::table::{Column, write_rows};
use super::{FolderError, Manifest, OutputFolder};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fmt::Write as _;

pub use report::draw_mac;

/// `summary.json` of `mac`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MacSummary {
    /// Its command.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
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
    /// What it was made from.
    pub manifest: Manifest,
}

/// A measured shape.
#[derive(Clone, Debug, Serialize, Deserialize)]
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
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MacPair {
    /// Shape, from 1.
    pub shape: usize,
    /// Mode, from 1.
    pub mode: usize,
    /// Their criterion.
    pub mac: f64,
}

impl MacSummary {
    /// The shape and the mode of a pair.
    fn pair(&self, pair: &MacPair) -> (&MacShape, &MacMode) {
        (&self.shapes[pair.shape - 1], &self.modes[pair.mode - 1])
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

    /// As text.
    pub fn text(&self) -> String {
        let mut out = format!(
            "{}\n{}\n\n{:>10} {:>12} {:>6} {:>12} {:>10} {:>7}\n",
            self.title,
            self.answer(),
            "shape",
            "measured Hz",
            "mode",
            "frequency Hz",
            "growth 1/s",
            "MAC"
        );
        for pair in &self.pairs {
            let (shape, mode) = self.pair(pair);
            let measured = shape.frequency_hz.map_or("-".to_owned(), |hz| format!("{hz:.2}"));
            let _ = writeln!(
                out,
                "{:>10} {measured:>12} {:>6} {:>12.2} {:>10.2} {:>7.4}",
                shape.name,
                mode.mode,
                mode.frequency_hz,
                TAU * mode.real_hz,
                pair.mac
            );
        }
        for note in &self.notes {
            let _ = writeln!(out, "{note}");
        }
        out
    }
}

impl Summary for MacSummary {
    fn headline(&self) -> Vec<Entry> {
        let least = self.pairs.iter().map(|pair| pair.mac).fold(1.0, f64::min);
        vec![
            Entry::new("shapes", self.shapes.len()),
            Entry::new("modes", self.modes.len()),
            Entry::new("least_mac", least),
        ]
    }
}

/// Writes `mac.csv`: a row for each shape and mode.
///
/// # Errors
/// Those of the folder.
pub fn write_mac(folder: &OutputFolder, summary: &MacSummary) -> Result<(), FolderError> {
    let shapes = 0..summary.shapes.len();
    let rows = shapes.flat_map(|shape| (0..summary.modes.len()).map(move |mode| (shape, mode)));
    let is_pair = |shape: usize, mode: usize| {
        let mut pairs = summary.pairs.iter();
        pairs.any(|pair| (pair.shape, pair.mode) == (shape + 1, mode + 1))
    };
    let columns: &[Column<'_, (usize, usize)>] = &[
        ("shape", &|at| summary.shapes[at.0].name.clone().into()),
        ("measured_frequency_hz", &|at| summary.shapes[at.0].frequency_hz.into()),
        ("mode", &|at| summary.modes[at.1].mode.into()),
        ("frequency_hz", &|at| summary.modes[at.1].frequency_hz.into()),
        ("real_hz", &|at| summary.modes[at.1].real_hz.into()),
        ("harmonic", &|at| summary.modes[at.1].harmonic.into()),
        ("mac", &|at| summary.mac[at.0][at.1].into()),
        ("paired", &|at| is_pair(at.0, at.1).into()),
    ];
    folder.write("mac.csv", |out| write_rows(out, columns, rows))?;
    Ok(())
}
