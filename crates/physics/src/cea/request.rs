//! Request of a sweep: friction coefficients, modes, shapes.

use super::CeaError;

/// Which modes are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeLimit {
    /// The N modes of lowest frequency; members of a degenerate pair count separately, but one more is listed where the
    /// limit would part them.
    Lowest(usize),
    /// All up to this frequency, Hz.
    MaxFrequency(f64),
}

impl ModeLimit {
    /// Refuses a limit that selects no mode by itself.
    pub(super) fn check(self) -> Result<(), CeaError> {
        let not_positive = |key: &str, value: f64| {
            Err(CeaError::Asked(format!("cea.{key} = {value} must be a positive number")))
        };
        match self {
            Self::MaxFrequency(value) if !(value > 0.0 && value.is_finite()) => {
                not_positive("max_frequency_hz", value)
            }
            Self::Lowest(0) => not_positive("modes", 0.0),
            _ => Ok(()),
        }
    }
}

/// What a sweep is to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepRequest<'a> {
    /// Friction coefficients, in any order; repeated values are computed once.
    pub friction_coefficients: &'a [f64],
    /// Modes wanted at each of them.
    pub limit: ModeLimit,
    /// Those of the friction coefficients at which mode shapes are wanted.
    pub shapes_at: &'a [f64],
    /// Those at which branches are only followed: modes are known there as closely as naming them and the sign of their growth need.
    pub followed_at: &'a [f64],
    /// The one of them at which left vectors are wanted too, to three digits; with it at critical friction.
    pub lefts_at: Option<f64>,
    /// Whether modes are counted by the argument principle under friction, too.
    pub count_modes: bool,
    /// Whether it goes on from a sweep that ends at its first friction coefficient: branches begin there, not without friction, and
    /// their names are for the caller to give.
    pub is_continued: bool,
}

impl<'a> SweepRequest<'a> {
    /// Modes alone, at some friction coefficients.
    pub fn new(friction_coefficients: &'a [f64], limit: ModeLimit) -> Self {
        Self {
            friction_coefficients,
            limit,
            shapes_at: &[],
            followed_at: &[],
            lefts_at: None,
            count_modes: false,
            is_continued: false,
        }
    }

    /// The friction coefficients rising, once each.
    pub(super) fn rising_grid(&self) -> Result<Vec<f64>, CeaError> {
        let values = self.friction_coefficients;
        if values.is_empty() {
            let problem = "cea.friction_coefficients is empty: give at least one value";
            return Err(CeaError::Asked(problem.to_owned()));
        }
        if let Some(&value) = values.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
            return Err(CeaError::Asked(format!(
                "cea.friction_coefficients: {value} is not a finite number of at least 0"
            )));
        }
        let mut grid: Vec<f64> = values.iter().map(|value| value + 0.0).collect(); // -0.0 and 0.0 are one value.
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        Ok(grid)
    }
}

/// What a sweep is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepStage {
    /// Modes at a few friction coefficients, from which those at all others are made.
    Blocks,
    /// Friction coefficients.
    Values,
    /// Numbers of nodal diameters of a body with cyclic symmetry.
    Diameters,
}

/// How far a sweep has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SweepProgress {
    /// At what.
    pub stage: SweepStage,
    /// How many of it are solved.
    pub solved: usize,
    /// How many there are; 0 where that is not known before.
    pub total: usize,
}
