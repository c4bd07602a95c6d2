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

mod assignment;
mod case;
mod estimate;
mod free_part;
mod levenberg_marquardt;
mod matching;

pub(crate) use assignment::least_cost;
pub use case::{fit_case, refuse_too_few};
pub use estimate::fit;
pub use frictionsim_signal::reader::MeasuredMode;

use crate::*;
use frictionsim_case::Fit;
use frictionsim_results::fit::ModeSummary;

/// A mode of the model at some values of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelMode {
    /// Eigenvalue, rad/s.
    pub eigenvalue: c64,
    /// Its name, and the same in hertz, in the words of the results.
    pub told: ModeSummary,
    /// Derivative of the eigenvalue by each parameter, where the model gives it.
    pub rates: Vec<Option<c64>>,
    /// Modal assurance criterion with each measured shape; empty without shapes.
    pub assurances: Vec<f64>,
}

impl ModelMode {
    /// A mode by its nodal diameters, where the body has the symmetry, its rank among them and its direction (+1 with
    /// the rotor, -1 against it, 0 standing), without derivatives and shapes.
    pub fn new(eigenvalue: c64, harmonic: Option<usize>, branch: usize, direction: i8) -> Self {
        let [frequency_hz, real_hz] = [eigenvalue.im / TAU, eigenvalue.re / TAU];
        let told = ModeSummary { harmonic, branch, direction, frequency_hz, real_hz };
        Self { eigenvalue, told, rates: Vec::new(), assurances: Vec::new() }
    }

    fn of(mode: &ComplexMode, has_harmonics: bool) -> Self {
        let harmonic = has_harmonics.then_some(mode.harmonic);
        Self::new(mode.eigenvalue, harmonic, mode.branch, mode.direction)
    }

    /// Whether a line of known harmonic may be this mode.
    fn may_be(&self, line: &MeasuredMode) -> bool {
        line.harmonic.zip(self.told.harmonic).is_none_or(|(measured, own)| measured == own)
    }

    fn name(&self) -> (Option<usize>, usize, i8) {
        (self.told.harmonic, self.told.branch, self.told.direction)
    }
}

/// The modes of the model at values of the parameters, with derivatives if asked for.
pub type Model<'a> = dyn Fn(&[f64], bool) -> Result<Vec<ModelMode>, String> + Sync + 'a;

/// What is fitted to what.
pub struct FitProblem<'a> {
    /// The model.
    pub model: &'a Model<'a>,
    /// Its parameters, and how they are sought.
    pub wanted: &'a Fit,
    /// The measurement.
    pub lines: &'a [MeasuredMode],
    /// The measured shape of each line, if there are some.
    pub shape_of: Vec<Option<usize>>,
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
        let pairs = self.wanted.parameters.iter().zip(places);
        pairs.map(|(parameter, place)| parameter.value(*place)).collect()
    }

    /// What the parameters have, by their keys.
    fn by_key<T>(&self, each: impl IntoIterator<Item = T>) -> BTreeMap<String, T> {
        self.wanted.parameters.iter().map(|own| own.parameter.key.clone()).zip(each).collect()
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
