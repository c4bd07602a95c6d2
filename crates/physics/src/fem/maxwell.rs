//! A chain of Maxwell elements in place of a stiffness that depends on frequency.

use crate::linalg::c64;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Relaxation times for each decade of frequency.
const TIMES_PER_DECADE: f64 = 2.0;
/// Frequencies for each decade at which the chain is fitted.
const LINES_PER_DECADE: f64 = 12.0;
/// Least share of the stiffness at the lowest frequency that stays at rest.
const LEAST_AT_REST: f64 = 0.05;
/// Share of the largest of a chain below which an element is left out.
const SMALLEST: f64 = 1e-6;
/// Solutions of least squares at most.
const MAX_PASSES: usize = 200;

/// An element: a spring and a dashpot in series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaxwellElement {
    /// Relaxation time `tau`, s.
    pub time: f64,
    /// Its stiffness, relative to that of the material at rest.
    pub stiffness: f64,
}

/// A generalised Maxwell chain: the stiffness
///
/// ```text
/// K(omega) / K_0 = r (1 + sum_j s_j i omega tau_j / (1 + i omega tau_j))
/// ```
///
/// in place of a complex one over a band of frequencies; `K_0` is that of the material as it is given, `r K_0` what stays at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct MaxwellChain {
    /// `r`.
    pub at_rest: f64,
    /// Its elements, of rising time.
    pub elements: Vec<MaxwellElement>,
    /// The band, Hz.
    pub band_hz: [f64; 2],
    /// Largest distance from the stiffness that it stands for within the band, relative to that.
    pub largest_error: f64,
}

impl MaxwellChain {
    /// Fits a chain to a complex ratio `K / K_0` over a band of frequencies in Hz: relaxation times evenly over the logarithm of the
    /// band, their stiffnesses not below zero, at the least sum of squares of relative errors.
    pub fn fit(ratio: &dyn Fn(f64) -> c64, band_hz: [f64; 2]) -> Self {
        let lines = spread(band_hz, LINES_PER_DECADE);
        let times: Vec<f64> = spread(band_hz, TIMES_PER_DECADE)
            .into_iter()
            .rev()
            .map(|frequency| 1.0 / (TAU * frequency))
            .collect();
        // K / K_0 = r + sum_j k_j i w t_j / (1 + i w t_j), with t_j = 1 / w_j and r of at least that.
        let least = LEAST_AT_REST * ratio(band_hz[0]).re;
        // Columns: what stays at rest beyond the least, then the elements; real and imaginary parts, each over the modulus.
        let rows = 2 * lines.len();
        let (mut matrix, mut right) = (DMatrix::zeros(rows, 1 + times.len()), DVector::zeros(rows));
        for (k, line) in lines.iter().enumerate() {
            let wanted = ratio(*line);
            let size = wanted.norm();
            let parts = |value: c64| [value.re / size, value.im / size];
            let all = std::iter::once(c64::ONE);
            let all = all.chain(times.iter().map(|time| response(TAU * line, *time)));
            for (j, value) in all.enumerate() {
                let [re, im] = parts(value);
                (matrix[(2 * k, j)], matrix[(2 * k + 1, j)]) = (re, im);
            }
            let [re, im] = parts(wanted - least);
            (right[2 * k], right[2 * k + 1]) = (re, im);
        }
        let found = nonnegative_least_squares(&matrix, &right); // Elements that carry next to nothing go.
        let at_rest = least + found[0];
        let largest = found.iter().skip(1).fold(0.0_f64, |a, b| a.max(*b));
        let elements = times.iter().zip(found.iter().skip(1));
        let elements = elements.filter(|(_, stiffness)| **stiffness > SMALLEST * largest);
        let mut chain = Self {
            at_rest,
            elements: elements
                .map(|(&time, stiffness)| MaxwellElement { time, stiffness: stiffness / at_rest })
                .collect(),
            band_hz,
            largest_error: 0.0,
        };
        let errors = lines.iter().map(|line| {
            let wanted = ratio(*line);
            (chain.ratio(*line) - wanted).norm() / wanted.norm()
        });
        chain.largest_error = errors.fold(0.0, f64::max);
        chain
    }

    /// `K / K_0` at a frequency in Hz.
    pub fn ratio(&self, frequency_hz: f64) -> c64 {
        let elements = self.elements.iter();
        let sum: c64 =
            elements.map(|own| response(TAU * frequency_hz, own.time) * own.stiffness).sum();
        (sum + 1.0) * self.at_rest
    }

    /// Stiffness at once over that at rest, `1 + sum_j s_j`.
    pub fn glassy(&self) -> f64 {
        1.0 + self.elements.iter().map(|own| own.stiffness).sum::<f64>()
    }
}

/// `i omega tau / (1 + i omega tau)`.
fn response(omega: f64, time: f64) -> c64 {
    let turned = c64::new(0.0, omega * time);
    turned / (turned + 1.0)
}

/// Frequencies from one end of a band to the other, so many for each decade.
fn spread([low, high]: [f64; 2], per_decade: f64) -> Vec<f64> {
    let steps = ((high / low).log10() * per_decade).ceil().max(1.0);
    (0..=steps as usize).map(|i| low * (high / low).powf(i as f64 / steps)).collect()
}

/// `x >= 0` with the least `|A x - b|`.
///
/// Source: C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, Prentice-Hall (1974), chapter 23.
fn nonnegative_least_squares(matrix: &DMatrix<f64>, right: &DVector<f64>) -> Vec<f64> {
    let count = matrix.ncols();
    let mut x = vec![0.0; count];
    let mut is_free = vec![false; count];
    for _ in 0..MAX_PASSES {
        // The variable on its bound that gains most.
        let residual = right - matrix * DVector::from_column_slice(&x);
        let gradient = matrix.transpose() * &residual;
        let bound = (0..count).filter(|&j| !is_free[j]);
        let best = bound.max_by(|&a, &b| gradient[a].total_cmp(&gradient[b]));
        let Some(best) = best.filter(|&j| gradient[j] > 1e-12 * right.norm()) else { break };
        is_free[best] = true;
        // Free variables that would fall below zero go back to their bound.
        loop {
            let free: Vec<usize> = (0..count).filter(|&j| is_free[j]).collect();
            let columns = matrix.select_columns(&free);
            let Ok(solved) = columns.svd(true, true).solve(right, 1e-12) else { return x };
            if solved.iter().all(|value| *value > 0.0) {
                free.iter().zip(solved.iter()).for_each(|(&j, value)| x[j] = *value);
                break;
            }
            let pairs = free.iter().zip(solved.iter());
            let reach = pairs
                .clone()
                .filter(|(_, value)| **value <= 0.0)
                .map(|(&j, value)| x[j] / (x[j] - value))
                .fold(1.0, f64::min);
            for (&j, value) in pairs {
                x[j] += reach * (value - x[j]);
                if x[j] <= 1e-14 {
                    (x[j], is_free[j]) = (0.0, false);
                }
            }
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Theory: a chain is found again from its own stiffness.
    #[test]
    fn the_stiffness_of_a_chain_gives_that_chain() {
        let band = [10.0, 10_000.0];
        let times = [1.0 / (TAU * 10_000.0), 1.0 / (TAU * 100.0)];
        let exact = |frequency: f64| {
            let parts = times.map(|time| response(TAU * frequency, time));
            c64::new(2.0, 0.0) + parts[0] * 0.8 + parts[1] * 1.4
        };
        let chain = MaxwellChain::fit(&exact, band);
        println!("{chain:?}");
        assert!(chain.largest_error < 1e-9, "{:e}", chain.largest_error);
        assert!((chain.at_rest - 2.0).abs() < 1e-8);
        assert!((chain.glassy() - (1.0 + 0.4 + 0.7)).abs() < 1e-8);
    }

    #[test]
    fn a_constant_loss_factor_is_kept_over_its_band() {
        for eta in [0.01, 0.1, 0.5] {
            let chain = MaxwellChain::fit(&|_| c64::new(1.0, eta), [100.0, 10_000.0]);
            println!("{eta}: {:e} {}", chain.largest_error, chain.at_rest);
            // Two times a decade ripple by a few per cent of the loss; the real part rises by about 2 eta / pi a decade and factor e.
            assert!(chain.largest_error < 1.6 * eta, "{eta} {:e}", chain.largest_error);
            assert!(chain.elements.iter().all(|own| own.stiffness > 0.0));
        }
    }
}
