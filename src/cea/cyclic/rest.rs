//! The real symmetric pencil of one harmonic without friction, complete below a limit.

use crate::linalg::banded::{BandedLdl, BandedMatrix};

/// Number of eigenvalues of `K x = kappa M x` below `limit`.
pub(super) fn count_below(mass: &BandedMatrix, stiffness: &BandedMatrix, limit: f64) -> usize {
    BandedLdl::new(stiffness, mass, limit).negative_count()
}

/// All eigenpairs of `K x = kappa M x` with `kappa < limit`, rising; `x` of unit Euclidean length.
///
/// Bisection on the inertia of `K - sigma M` isolates each eigenvalue, so that none can be missed; inverse
/// iteration and Rayleigh quotients finish it.
pub(super) fn eigenpairs_below(
    mass: &BandedMatrix,
    stiffness: &BandedMatrix,
    limit: f64,
) -> Vec<(f64, Vec<f64>)> {
    let mut search = Search {
        mass,
        stiffness,
        factor: BandedLdl::new(stiffness, mass, limit),
        found: Vec::new(),
    };
    let total = search.factor.negative_count();
    if total == 0 {
        return Vec::new();
    }
    let (mut low, mut below) = (0.0, search.count(0.0));
    let mut step = limit.abs();
    while below > 0 {
        low -= step;
        step *= 4.0;
        below = search.count(low);
    }
    search.isolate(low, below, limit, total);
    search.found
}

/// Relative width of an interval whose eigenvalues count as one: vectors are then kept apart by
/// orthogonality.
const PINNED: f64 = 1e-11;

struct Search<'a> {
    mass: &'a BandedMatrix,
    stiffness: &'a BandedMatrix,
    factor: BandedLdl,
    found: Vec<(f64, Vec<f64>)>,
}

impl Search<'_> {
    fn count(&mut self, shift: f64) -> usize {
        self.factor.refactorize(self.stiffness, self.mass, shift);
        self.factor.negative_count()
    }

    /// Finds the eigenvalues in `[low, high)`, of which `below` and `up_to` lie below the ends.
    fn isolate(&mut self, low: f64, below: usize, high: f64, up_to: usize) {
        if up_to <= below {
            return;
        }
        let width = high - low;
        let is_pinned = width <= PINNED * low.abs().max(high.abs());
        if up_to == below + 1 || is_pinned {
            let slack = PINNED * low.abs().max(high.abs());
            for _ in below..up_to {
                let Some(pair) = self.refine(low, high, slack, is_pinned) else {
                    break;
                };
                self.found.push(pair);
            }
            if self.found.len() >= up_to || is_pinned {
                return;
            }
        }
        let middle = low + 0.5 * width;
        let count = self.count(middle).clamp(below, up_to);
        self.isolate(low, below, middle, count);
        self.isolate(middle, count, high, up_to);
    }

    /// Inverse iteration from the middle of the interval, then Rayleigh quotients. `None` where they
    /// leave the interval, unless it is a point already.
    fn refine(
        &mut self,
        low: f64,
        high: f64,
        slack: f64,
        is_pinned: bool,
    ) -> Option<(f64, Vec<f64>)> {
        let mut shift = 0.5 * (low + high);
        // Any vector with a part along every mode will do; this one is not symmetric in anything.
        let mut x: Vec<f64> =
            (0..self.mass.dimension()).map(|i| 1.0 + (1.7 * i as f64).sin()).collect();
        let earlier: Vec<Vec<f64>> = match is_pinned {
            true => self.found.iter().map(|(_, x)| x.clone()).collect(),
            false => Vec::new(),
        };
        let mut change = f64::INFINITY;
        for iteration in 0..12 {
            self.factor.refactorize(self.stiffness, self.mass, shift);
            for _ in 0..if iteration == 0 { 3 } else { 1 } {
                x = self.mass.multiply(&x);
                self.factor.solve(&mut x);
                for other in &earlier {
                    self.remove(&mut x, other);
                }
                normalize(&mut x);
            }
            let quotient = dot(&x, &self.stiffness.multiply(&x)) / dot(&x, &self.mass.multiply(&x));
            if !quotient.is_finite() {
                return None;
            }
            let is_inside = quotient >= low - slack && quotient < high + slack;
            if !is_inside {
                return is_pinned.then_some((quotient, x));
            }
            let (before, step) = (change, (quotient - shift).abs());
            change = step;
            shift = quotient;
            let is_settled = step <= 1e-14 * quotient.abs();
            if is_settled || (step >= before && step < 1e-10 * quotient.abs()) {
                return Some((quotient, x));
            }
        }
        is_pinned.then_some((shift, x))
    }

    /// Removes from `x` its part along `other` in the mass product.
    fn remove(&self, x: &mut [f64], other: &[f64]) {
        let weighted = self.mass.multiply(other);
        let part = dot(x, &weighted) / dot(other, &weighted);
        for (value, o) in x.iter_mut().zip(other) {
            *value -= part * o;
        }
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn normalize(x: &mut [f64]) {
    let norm = dot(x, x).sqrt();
    x.iter_mut().for_each(|v| *v /= norm);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Two uncoupled chains whose spectra coincide, interleaved: every eigenvalue is double.
    fn twin_chains(n: usize) -> [BandedMatrix; 2] {
        let (mut mass, mut stiffness) =
            (BandedMatrix::zeros(2 * n, 3), BandedMatrix::zeros(2 * n, 3));
        for i in 0..2 * n {
            mass.add(i, i, 1.0);
            stiffness.add(i, i, 2.0);
            if i >= 2 {
                stiffness.add(i, i - 2, -1.0);
                stiffness.add(i - 2, i, -1.0);
            }
        }
        [mass, stiffness]
    }

    #[test]
    fn double_eigenvalues_are_found_twice_with_independent_vectors() {
        let n = 20;
        let [mass, stiffness] = twin_chains(n);
        let pairs = eigenpairs_below(&mass, &stiffness, 0.95);
        let exact = (1..=n)
            .map(|k| 2.0 - 2.0 * (k as f64 * PI / (n as f64 + 1.0)).cos())
            .filter(|value| *value < 0.95);
        let exact: Vec<f64> = exact.flat_map(|value| [value, value]).collect();
        assert_eq!(pairs.len(), exact.len());
        for ((value, _), exact) in pairs.iter().zip(&exact) {
            assert!((value - exact).abs() < 1e-12);
        }
        for two in pairs.chunks(2) {
            assert!(dot(&two[0].1, &two[1].1).abs() < 1e-6);
        }
    }
}
