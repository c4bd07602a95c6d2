//! Least squares within bounds after Levenberg and Marquardt.

use super::matching::{Weights, assign, differences};
use super::{FitProblem, ModelMode};
use crate::*;

/// Iterations at most.
const ITERATIONS: usize = 40;

/// Step of central differences, in units of the bounds.
const DIFFERENCE: f64 = 1e-4;

/// Residuals of each line: of frequency, real part and shape.
pub(super) const KINDS: usize = 3;

/// A point of the search.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    /// Places of the parameters, 0 to 1.
    pub places: Vec<f64>,
    pub modes: Vec<ModelMode>,
    /// Mode of each line.
    pub matched: Vec<Option<usize>>,
    pub chi_square: f64,
}

/// The sum of squares of a problem with weights.
pub(super) struct Squares<'a> {
    pub problem: &'a FitProblem<'a>,
    pub weights: Vec<Weights>,
}

impl Trial {
    /// The mode of each line, where one is matched.
    pub fn of_lines(&self) -> impl Iterator<Item = Option<&ModelMode>> {
        self.matched.iter().map(|mode| mode.map(|m| &self.modes[m]))
    }
}

impl Squares<'_> {
    pub fn trial(&self, places: &[f64], with_rates: bool) -> Result<Trial, String> {
        let modes = (self.problem.model)(&self.problem.values(places), with_rates)?;
        let (matched, chi_square) = assign(self.problem.lines, &self.weights, &modes);
        Ok(Trial { places: places.to_vec(), modes, matched, chi_square })
    }

    /// Weighted differences, frequency, real part and shape of each line; 0 where there is nothing to compare.
    pub fn residuals(&self, trial: &Trial) -> Vec<f64> {
        let lines = self.problem.lines.iter().zip(&self.weights);
        lines
            .zip(trial.of_lines())
            .flat_map(|((line, weights), mode)| {
                let [df, dr] = mode.map_or([0.0; 2], |mode| differences(line, mode));
                let strange = mode.map_or(0.0, |mode| weights.strangeness(mode));
                [weights.frequency * df, weights.real * dr, strange]
            })
            .collect()
    }

    /// Derivatives of [`Self::residuals`] by the places; `trial` has the rates that the model gives.
    pub fn jacobian(&self, trial: &Trial) -> Result<DMatrix<f64>, String> {
        let (lines, parameters) = (self.problem.lines, &self.problem.wanted.parameters);
        let mut jacobian = DMatrix::zeros(KINDS * lines.len(), parameters.len());
        for (column, parameter) in parameters.iter().enumerate() {
            let slope = parameter.slope(trial.places[column]);
            let is_known = |mode: &ModelMode| matches!(mode.rates.get(column), Some(Some(_)));
            // What a parameter does to shapes is known from differences alone.
            let has_shapes = self.weights.iter().any(|weights| weights.shape.is_some());
            let given = !has_shapes && trial.of_lines().flatten().all(is_known);
            let around = if given { None } else { Some(self.around(trial, column)?) };
            for (row, (line, mode)) in lines.iter().zip(trial.of_lines()).enumerate() {
                let Some(mode) = mode else { continue };
                let weights = self.weights[row];
                let sides = around.as_ref().and_then(|(low, high, width)| {
                    Some(([same(mode, &weights, low)?, same(mode, &weights, high)?], *width))
                });
                let rate = match given {
                    true => mode.rates[column].map(|rate| rate * slope),
                    false => {
                        sides.map(|([low, high], width)| (high.eigenvalue - low.eigenvalue) / width)
                    }
                };
                let rate = rate.unwrap_or(c64::ZERO);
                jacobian[(KINDS * row, column)] = -weights.frequency * rate.im / TAU;
                if line.real_hz.is_some() {
                    jacobian[(KINDS * row + 1, column)] = -weights.real * rate.re / TAU;
                }
                if let Some(([low, high], width)) = sides {
                    let change = weights.strangeness(high) - weights.strangeness(low);
                    jacobian[(KINDS * row + 2, column)] = change / width;
                }
            }
        }
        Ok(jacobian)
    }

    /// The modes on either side of a trial, and how far apart the sides are.
    fn around(
        &self,
        trial: &Trial,
        column: usize,
    ) -> Result<(Vec<ModelMode>, Vec<ModelMode>, f64), String> {
        let at = |offset: f64| {
            let mut places = trial.places.clone();
            places[column] = (places[column] + offset).clamp(0.0, 1.0);
            let modes = (self.problem.model)(&self.problem.values(&places), false)?;
            Ok::<_, String>((modes, places[column]))
        };
        let ((low, from), (high, to)) = (at(-DIFFERENCE)?, at(DIFFERENCE)?);
        Ok((low, high, to - from))
    }

    /// Goes downhill from a trial until nothing is gained.
    pub fn descend(&self, mut trial: Trial) -> Result<Trial, String> {
        let mut damping = 1e-3;
        for _ in 0..ITERATIONS {
            trial = self.trial(&trial.places, true)?;
            let jacobian = self.jacobian(&trial)?;
            let residuals = DVector::from_vec(self.residuals(&trial));
            let gradient = jacobian.transpose() * &residuals;
            // A parameter that the gradient presses onto its bound stays there.
            let is_pressed = |k: usize| match trial.places[k] {
                place if place <= 0.0 => gradient[k] > 0.0,
                place => place >= 1.0 && gradient[k] < 0.0,
            };
            let free = (0..trial.places.len()).filter(|&k| !is_pressed(k));
            let free: Vec<usize> = free.collect();
            let mut gained = None;
            while damping < 1e9 && !free.is_empty() {
                let Some(step) = damped_step(&jacobian, &gradient, &free, damping) else {
                    damping *= 10.0;
                    continue;
                };
                let mut places = trial.places.clone();
                for (&k, change) in free.iter().zip(step.iter()) {
                    places[k] = (places[k] + change).clamp(0.0, 1.0);
                }
                // Where the model has no solution the step was too long.
                match self.trial(&places, false) {
                    Ok(next) if next.chi_square < trial.chi_square => {
                        gained = Some(trial.chi_square - next.chi_square);
                        trial = next;
                        damping = (0.1 * damping).max(1e-12);
                        break;
                    }
                    _ => damping *= 10.0,
                }
            }
            if gained.is_none_or(|gain| gain <= 1e-10 * trial.chi_square) {
                break;
            }
            damping = damping.min(1.0);
        }
        self.trial(&trial.places, true)
    }
}

/// The same mode in another spectrum: by its name where the body has harmonics, by the shape of its line if that was
/// measured, else the nearest.
fn same<'m>(mode: &ModelMode, weights: &Weights, modes: &'m [ModelMode]) -> Option<&'m ModelMode> {
    let distance = |other: &&ModelMode| {
        let away = (other.eigenvalue - mode.eigenvalue).norm() / mode.eigenvalue.norm();
        let strange = weights.shape.map_or(0.0, |(_, weight)| {
            (weights.strangeness(other) - weights.strangeness(mode)).abs() / weight
        });
        away + strange
    };
    let nearest = |a: &&ModelMode, b: &&ModelMode| distance(a).total_cmp(&distance(b));
    let named =
        modes.iter().filter(|other| mode.told.harmonic.is_some() && other.name() == mode.name());
    named.min_by(nearest).or_else(|| modes.iter().min_by(nearest))
}

/// Solves `(J^T J + damping diag) step = -gradient` over the free parameters.
fn damped_step(
    jacobian: &DMatrix<f64>,
    gradient: &DVector<f64>,
    free: &[usize],
    damping: f64,
) -> Option<DVector<f64>> {
    let own = jacobian.select_columns(free);
    let mut normal = own.transpose() * &own;
    let largest = normal.diagonal().max();
    for k in 0..free.len() {
        normal[(k, k)] += damping * normal[(k, k)] + 1e-14 * largest;
    }
    let right = DVector::from_iterator(free.len(), free.iter().map(|&k| -gradient[k]));
    normal.cholesky().map(|factor| factor.solve(&right))
}
