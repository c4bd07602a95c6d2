//! Modes of one harmonic without friction.

use crate::linalg::Mat;
use crate::linalg::banded::{BandedFactor, BandedMatrix, CompactRows};
use crate::linalg::dense::{dot, random_columns};
use crate::linalg::dense_eigen::symmetric_eigen;

/// The pencil of one harmonic at rest over the unknowns that may move, and its stiffness factorized.
pub(super) struct Pencil {
    pub mass: CompactRows,
    bands: [BandedMatrix; 2],
    /// Below all eigenvalues: `K - shift M` is factorized. Zero but for a body that can move as a whole or gives way.
    shift: f64,
    pub factor: BandedFactor,
}

/// Modes `(kappa, x)`, `K x = kappa M x`, `x^T M x = 1`, rising.
pub(super) type Modes = Vec<(f64, Vec<f64>)>;

/// Smallest shift below zero, over the largest `K_ii / M_ii`, and how many are tried, each eight times the one before.
const LEAST_SHIFT: f64 = 1e-9;
const SHIFTS: i32 = 10;

/// Largest residual of a mode relative to its eigenvalue.
const SETTLED: f64 = 1e-11;

impl Pencil {
    /// `None` where no shift below all eigenvalues is found.
    pub fn new(mass: BandedMatrix, stiffness: BandedMatrix) -> Option<Self> {
        let rate = |k: usize| stiffness.get(k, k) / mass.get(k, k);
        let largest = (0..mass.dimension()).map(rate).fold(0.0, f64::max);
        let shifts = (0..SHIFTS).map(|k| -LEAST_SHIFT * largest * 8.0_f64.powi(k));
        let found = std::iter::once(0.0).chain(shifts).find_map(|shift| {
            let factor = BandedFactor::new(&stiffness, &mass, shift);
            let is_held = factor.negative_count() == 0 && factor.is_regular();
            is_held.then_some((shift, factor))
        });
        let (shift, factor) = found?;
        Some(Self { mass: CompactRows::new(&mass), bands: [mass, stiffness], shift, factor })
    }

    /// `K` over the unknowns that may move, N/m.
    pub fn stiffness(&self) -> &BandedMatrix {
        &self.bands[1]
    }

    /// The pencil with `factor A` as further stiffness; `None` where that is not positive definite.
    pub fn stiffened(&self, factor: f64, a: &BandedMatrix) -> Option<Self> {
        let [mass, stiffness] = &self.bands;
        let mut stiffness = stiffness.clone();
        stiffness.add_scaled(factor, a);
        Self::new(mass.clone(), stiffness)
    }

    /// Number of modes below `kappa`.
    pub fn count_below(&self, kappa: f64) -> usize {
        let [mass, stiffness] = &self.bands;
        BandedFactor::new(stiffness, mass, kappa).negative_count()
    }

    /// The `count` modes of lowest frequency, by the Lanczos method on `(K - shift M)^-1 M` with full reorthogonalization; fewer
    /// where it does not settle.
    pub fn lowest(&self, count: usize) -> Modes {
        let dimension = self.bands[0].dimension();
        let count = count.min(dimension);
        let longest = (6 * count + 60).min(dimension);
        let start = random_columns(dimension, 1, 7);
        let mut next: Vec<f64> = (0..dimension).map(|i| start[(i, 0)]).collect();
        self.factor.solve(&mut next);
        let (mut basis, mut momenta): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        let (mut diagonal, mut off) = (Vec::new(), Vec::new());
        let mut check = count + 6;
        while basis.len() < longest {
            let momentum = self.mass.multiply(&next);
            let norm = dot(&next, &momentum).sqrt();
            if !(norm > 0.0 && norm.is_finite()) {
                break;
            }
            off.push(norm);
            basis.push(next.iter().map(|v| v / norm).collect());
            momenta.push(momentum.iter().map(|v| v / norm).collect());
            let j = basis.len() - 1;
            next.clone_from(&momenta[j]);
            self.factor.solve(&mut next);
            diagonal.push(dot(&next, &momenta[j]));
            for _ in 0..2 {
                for (q, p) in basis.iter().zip(&momenta) {
                    let part = dot(p, &next);
                    next.iter_mut().zip(q).for_each(|(v, q)| *v -= part * q);
                }
            }
            if basis.len() >= check || basis.len() == longest {
                let remainder = dot(&next, &self.mass.multiply(&next)).sqrt();
                if let Some(modes) = self.ritz(&basis, &diagonal, &off, remainder, count) {
                    return modes;
                }
                check += 1 + count / 3;
            }
        }
        self.ritz(&basis, &diagonal, &off, 0.0, count).unwrap_or_default()
    }

    /// Ritz pairs of the tridiagonal matrix; `None` unless the first `count` have settled.
    fn ritz(
        &self,
        basis: &[Vec<f64>],
        diagonal: &[f64],
        off: &[f64],
        remainder: f64,
        count: usize,
    ) -> Option<Modes> {
        let size = diagonal.len();
        let mut matrix = Mat::<f64>::zeros(size, size);
        for i in 0..size {
            matrix[(i, i)] = diagonal[i];
            if i > 0 {
                matrix[(i, i - 1)] = off[i];
                matrix[(i - 1, i)] = off[i];
            }
        }
        let (values, vectors) = symmetric_eigen(&matrix);
        let wanted: Vec<usize> = (0..size).rev().take(count).collect();
        let is_settled =
            |&k: &usize| remainder * vectors[(size - 1, k)].abs() <= SETTLED * values[k].abs();
        if wanted.len() < count || !wanted.iter().all(is_settled) {
            return None;
        }
        let mode = |k: usize| {
            let mut x = vec![0.0; basis[0].len()];
            for (j, q) in basis.iter().enumerate() {
                let share = vectors[(j, k)];
                x.iter_mut().zip(q).for_each(|(v, q)| *v += share * q);
            }
            (self.shift + 1.0 / values[k], x)
        };
        Some(wanted.into_iter().map(mode).collect())
    }
}
