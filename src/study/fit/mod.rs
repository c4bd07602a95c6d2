//! Parameters of a model from measured modes: weighted least squares within bounds.
//!
//! ```text
//! min over theta  sum_i [w_i (f_i - Im lambda_m(i)(theta) / 2 pi)]^2 + [v_i (r_i - Re lambda_m(i)(theta) / 2 pi)]^2
//!                     + [s w_i f_i (1 - MAC_i,m(i)(theta))]^2
//! ```
//!
//! The last is of lines with a measured shape: with the modal assurance criterion of that shape and
//! the mode, and `s` the weight of shapes. It tells modes apart whose frequencies do not.
//!
//! `m(i)` is the mode of line `i`, assigned anew at every `theta` at the least sum. Parameters are
//! sought on the scale of their bounds, 0 to 1, linear or logarithmic. The method of Levenberg and
//! Marquardt starts from the best of several points. Eigenvalues are differentiated by the model
//! where it can, and by central differences elsewhere.

mod case;
mod estimate;
mod free_part;
mod interval;
mod levenberg_marquardt;
mod matching;
mod shapes;
mod summary;

pub use crate::signal::reader::MeasuredMode;
pub use case::{fit_case, fit_case_with_shapes, refuse_too_few, summarize};
pub use estimate::{Fitted, LineFit, fit};
pub use interval::{Estimate, Side};
pub(in crate::study) use matching::least_cost;
pub use shapes::MeasuredShapes;

use crate::linalg::c64;
use std::f64::consts::TAU;

/// A mode of the model at some values of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelMode {
    /// Eigenvalue, rad/s.
    pub eigenvalue: c64,
    /// Nodal diameters, where the body has the symmetry.
    pub harmonic: Option<usize>,
    /// Rank within the harmonic.
    pub branch: usize,
    /// +1 with the rotor, -1 against it, 0 standing.
    pub direction: i8,
    /// Derivative of the eigenvalue by each parameter, where the model gives it.
    pub rates: Vec<Option<c64>>,
    /// Modal assurance criterion with each measured shape; empty without shapes.
    pub assurances: Vec<f64>,
}

impl ModelMode {
    /// `Im(lambda) / 2 pi`, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im / TAU
    }

    /// `Re(lambda) / 2 pi`, Hz.
    pub fn real_hz(&self) -> f64 {
        self.eigenvalue.re / TAU
    }

    fn name(&self) -> (Option<usize>, usize, i8) {
        (self.harmonic, self.branch, self.direction)
    }
}

/// A parameter between its bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundedParameter {
    /// What messages call it.
    pub name: String,
    /// Lower bound.
    pub from: f64,
    /// Upper bound.
    pub to: f64,
    /// Whether its logarithm is sought.
    pub is_logarithmic: bool,
}

impl BoundedParameter {
    /// The value at a place, 0 at the lower and 1 at the upper bound.
    pub fn value(&self, place: f64) -> f64 {
        match place {
            0.0 => self.from,
            1.0 => self.to,
            _ if self.is_logarithmic => self.from * (self.to / self.from).powf(place),
            _ => self.from + (self.to - self.from) * place,
        }
    }

    /// The place of a value.
    pub fn place(&self, value: f64) -> f64 {
        match self.is_logarithmic {
            true => (value / self.from).ln() / (self.to / self.from).ln(),
            false => (value - self.from) / (self.to - self.from),
        }
    }

    /// `d value / d place`.
    fn slope(&self, place: f64) -> f64 {
        match self.is_logarithmic {
            true => self.value(place) * (self.to / self.from).ln(),
            false => self.to - self.from,
        }
    }
}

/// The modes of the model at values of the parameters, with derivatives if asked for.
pub type Model<'a> = dyn Fn(&[f64], bool) -> Result<Vec<ModelMode>, String> + Sync + 'a;

/// What is fitted to what.
pub struct FitProblem<'a> {
    /// The model.
    pub model: &'a Model<'a>,
    /// Its parameters.
    pub parameters: &'a [BoundedParameter],
    /// The measurement.
    pub lines: &'a [MeasuredMode],
    /// The measured shape of each line, if there are some.
    pub shape_of: Vec<Option<usize>>,
    /// What a shape without anything of its line's mode counts, as a share of the frequency.
    pub shape_weight: f64,
    /// Points looked at first.
    pub starts: usize,
    /// A point to begin with, where it lies within the bounds.
    pub own: Option<Vec<f64>>,
}

impl FitError {
    /// Whether the table is to blame rather than the run.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::TooManyLines { .. } | Self::Frequency { .. } | Self::Shape { .. })
    }
}

impl FitProblem<'_> {
    /// Real numbers measured.
    pub fn data_count(&self) -> usize {
        let of = |line: &MeasuredMode| 1 + usize::from(line.real_hz.is_some());
        let numbers: usize = self.lines.iter().map(of).sum();
        numbers + self.shape_of.iter().flatten().count()
    }
}

/// A fit that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// More parameters than data.
    #[error(
        "{parameters} parameters cannot be fitted to {data} measured numbers. Fit fewer, or \
         measure more (a real part or a damping factor counts as much as a frequency)"
    )]
    TooFewData {
        /// Parameters.
        parameters: usize,
        /// Numbers measured.
        data: usize,
    },
    /// More lines than modes that anybody measures.
    #[error(
        "the table has {lines} lines, at most {most} modes can be fitted: give the modes alone, \
        not a frequency response"
    )]
    TooManyLines {
        /// Lines.
        lines: usize,
        /// The limit.
        most: usize,
    },
    /// A frequency that no mode has.
    #[error(
        "line {line} of the table: {frequency_hz:e} Hz is no frequency of a mode, which lies \
        between {least:e} and {most:e} Hz"
    )]
    Frequency {
        /// Its line.
        line: usize,
        /// What it says, Hz.
        frequency_hz: f64,
        /// Lower end, Hz.
        least: f64,
        /// Upper end, Hz.
        most: f64,
    },
    /// A shape that belongs to no line.
    #[error(
        "shape {name} belongs to no line of the table: {reason}; give its frequency, within \
        {within} % of that of its line"
    )]
    Shape {
        /// Its name.
        name: String,
        /// Why.
        reason: String,
        /// How near its frequency must be, per cent.
        within: f64,
    },
    /// The model fails at every point looked at.
    #[error(
        "the model has no modes to compare at any of {points} points within the bounds: {reason}"
    )]
    NoModel {
        /// Points.
        points: usize,
        /// Why it fails at the last of them.
        reason: String,
    },
    /// A line that the best fit leaves alone.
    #[error(
        "line {line} of the table ({frequency_hz} Hz{wanted}) is matched by no mode within the \
         bounds: {nearest}. Widen the bounds of fit.parameters, or take the line out"
    )]
    Unmatched {
        /// Its line.
        line: usize,
        /// Its frequency, Hz.
        frequency_hz: f64,
        /// What it asks for besides.
        wanted: String,
        /// What comes nearest.
        nearest: String,
    },
    /// The data do not change along a direction of the parameters.
    #[error(
        "the data cannot tell these parameters apart: no measured number changes with {0} \
        together; fix one of them, or measure what depends on it"
    )]
    Blind(String),
}
