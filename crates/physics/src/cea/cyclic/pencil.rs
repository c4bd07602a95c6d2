//! Modes of one harmonic without friction.

use crate::cea::cyclic::*;
use crate::linalg::banded::{BandedFactor, BandedMatrix};
use crate::linalg::{SymmetricPairs, SymmetricPencil, symmetric_pairs};

/// The pencil of one harmonic at rest over the unknowns that may move, and its stiffness factorized.
pub(super) struct Pencil {
    pub mass: BandedMatrix,
    /// `K` over the unknowns that may move, N/m.
    pub stiffness: BandedMatrix,
    /// Below all eigenvalues: `K - shift M` is factorized. Zero but for a body that can move as a whole or gives way.
    shift: f64,
    pub factor: BandedFactor,
}

/// Modes `(kappa, x)`, `K x = kappa M x`, `x^T M x = 1`, rising.
pub(super) type Modes = Vec<(f64, Vec<f64>)>;

impl Pencil {
    /// `None` where no shift below all eigenvalues is found.
    pub fn new(mass: BandedMatrix, stiffness: BandedMatrix) -> Option<Self> {
        let rate = |k: usize| stiffness.get(k, k) / mass.get(k, k);
        let largest = (0..mass.dimension()).map(rate).fold(0.0, f64::max);
        let shifts =
            (0..MOST_ATTEMPTS as i32).map(|k| -RESIDUAL_BOUND * largest * 16.0_f64.powi(k));
        let found = std::iter::once(0.0).chain(shifts).find_map(|shift| {
            let factor = BandedFactor::new(&stiffness, &mass, shift);
            let is_held = factor.negative_count() == 0 && factor.is_regular(); // By Sylvester's law no eigenvalue lies below.
            is_held.then_some((shift, factor))
        });
        let (shift, factor) = found?;
        Some(Self { mass, stiffness, shift, factor })
    }

    /// The pencil with `factor A` as further stiffness; `None` where that is not positive definite.
    pub fn stiffened(&self, factor: f64, a: &BandedMatrix) -> Option<Self> {
        let mut stiffness = self.stiffness.clone();
        stiffness.add_scaled(factor, a); // K + factor A.
        Self::new(self.mass.clone(), stiffness)
    }

    /// Number of modes below `kappa`.
    pub fn count_below(&self, kappa: f64) -> usize {
        // Sylvester: as many negative pivots of K - kappa M.
        BandedFactor::new(&self.stiffness, &self.mass, kappa).negative_count()
    }

    /// The `count` modes of lowest frequency; fewer where the iteration does not settle.
    pub fn lowest(&self, count: usize) -> Modes {
        let pairs = symmetric_pairs(self, count, 1, CONVERGED);
        let settled = pairs.ok().filter(|pairs| pairs.converged == pairs.values.len());
        let modes = |pairs: SymmetricPairs| {
            let mode = |(j, theta): (usize, &f64)| {
                (self.shift + theta.recip(), column(pairs.vectors.as_ref(), j).to_vec()) // theta = 1 / (kappa - shift).
            };
            pairs.values.iter().enumerate().map(mode).collect()
        };
        settled.map_or_else(Vec::new, modes)
    }
}

impl BlockOperator for Pencil {
    fn dimension(&self) -> usize {
        self.mass.dimension()
    }

    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut images = self.mass_times(x);
        (0..x.ncols()).for_each(|j| self.factor.solve(images.col_as_slice_mut(j))); // (K - shift M)^-1 M x.
        images
    }
}

impl SymmetricPencil for Pencil {
    fn mass_times(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        self.mass.multiply_columns(x)
    }
}
