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
mod notes;
mod shapes;

pub use case::{fit_case, refuse_too_few};
pub use estimate::fit;
pub use frictionsim_signal::reader::MeasuredMode;
pub(crate) use matching::least_cost;

use frictionsim_physics::cea::ComplexMode;
use frictionsim_physics::linalg::c64;
use frictionsim_results::fit::ModeSummary;
use std::collections::BTreeMap;
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
    /// A mode, without derivatives and shapes.
    fn of(mode: &ComplexMode, has_harmonics: bool) -> Self {
        Self {
            eigenvalue: mode.eigenvalue,
            harmonic: has_harmonics.then_some(mode.harmonic),
            branch: mode.branch,
            direction: mode.direction,
            rates: Vec::new(),
            assurances: Vec::new(),
        }
    }

    /// `Im(lambda) / 2 pi`, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im / TAU
    }

    /// `Re(lambda) / 2 pi`, Hz.
    pub fn real_hz(&self) -> f64 {
        self.eigenvalue.re / TAU
    }

    /// The mode in the words of the results.
    fn told(&self) -> ModeSummary {
        ModeSummary {
            harmonic: self.harmonic,
            branch: self.branch,
            direction: self.direction,
            frequency_hz: self.frequency_hz(),
            real_hz: self.real_hz(),
        }
    }

    fn name(&self) -> (Option<usize>, usize, i8) {
        (self.harmonic, self.branch, self.direction)
    }
}

/// A parameter between its bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundedParameter {
    /// Its key, in results and messages.
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
    /// More parameters than data.
    fn too_few_data(parameters: usize, data: usize) -> Self {
        Self::Model(format!(
            "{parameters} parameters cannot be fitted to {data} measured numbers. Fit fewer, or \
             measure more (a real part or a damping factor counts as much as a frequency)"
        ))
    }

    /// Whether the table is to blame rather than the run.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::Table(_))
    }
}

impl FitProblem<'_> {
    /// Values of the parameters at their places.
    fn values(&self, places: &[f64]) -> Vec<f64> {
        let pairs = self.parameters.iter().zip(places);
        pairs.map(|(parameter, place)| parameter.value(*place)).collect()
    }

    /// What the parameters have, by their keys.
    fn by_key<T>(&self, each: impl IntoIterator<Item = T>) -> BTreeMap<String, T> {
        self.parameters.iter().map(|parameter| parameter.name.clone()).zip(each).collect()
    }

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
    /// The table of measured modes, or that of their shapes, is to blame: what is wrong, and the remedy.
    #[error("{0}")]
    Table(String),
    /// The model, its bounds or the number of its parameters are: what is wrong, and the remedy.
    #[error("{0}")]
    Model(String),
    /// The data do not change along a direction of the parameters.
    #[error(
        "the data cannot tell these parameters apart: no measured number changes with {0} \
        together; fix one of them, or measure what depends on it"
    )]
    Blind(String),
}
