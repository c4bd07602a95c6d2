//! Residuals of modes in the full matrices, and which of their corrections are worth having.

use super::CONVERGED;
use super::packed::PackedEntry;
use super::structure::StructureMatrices;
use crate::linalg::dense::{column, dot, norm, pick_columns};
use crate::linalg::{Mat, MatRef};
use std::ops::Range;

/// Energy of a correction, relative to its mode, below which the mode is left as it is: a stiff contact has large
/// forces in short displacements, so lengths do not tell.
const SMALLEST_ENERGY: f64 = 1e-24;

/// Residuals of the packed vectors that have not converged.
pub struct OpenResiduals {
    /// One column for a real vector, two for a complex one.
    pub columns: Mat<f64>,
    /// Columns of each vector, and its energy `|kappa| x^T M x`.
    vectors: Vec<(Range<usize>, f64)>,
}

impl OpenResiduals {
    /// No residuals, with memory for `count` columns.
    pub fn none(unknowns: usize, count: usize) -> Self {
        let mut columns = Mat::with_capacity(unknowns, count);
        columns.resize_with(unknowns, 0, |_, _| 0.0);
        Self { columns, vectors: Vec::new() }
    }

    /// Adds the residuals of those packed vectors `x` whose residual force is not yet small against their inertia force.
    pub fn gather(
        &mut self,
        matrices: &StructureMatrices<'_>,
        entries: &[PackedEntry],
        x: &Mat<f64>,
    ) {
        let (residuals, momenta) = matrices.residuals_and_momenta(entries, x.as_ref());
        let largest = |a: &Mat<f64>, entry: &PackedEntry| {
            entry.columns.clone().map(|j| norm(column(a.as_ref(), j))).fold(0.0, f64::max)
        };
        for entry in entries {
            let factor = matrices.inertia_factor(entry);
            if largest(&residuals, entry) <= CONVERGED * factor * largest(&momenta, entry) {
                continue;
            }
            let (first, own) = (self.columns.ncols(), entry.columns.clone());
            let end = first + own.len();
            let energy = factor * products(x.as_ref(), momenta.as_ref(), own.clone());
            self.columns.resize_with(x.nrows(), end, |i, j| residuals[(i, own.start + j - first)]);
            self.vectors.push((first..end, energy));
        }
    }

    /// Those `corrections` `t` of these residuals `r` that have an energy, `t^T r`, beside that of their mode.
    pub fn with_energy(&self, corrections: &Mat<f64>) -> Mat<f64> {
        let has_energy = |(own, whole): &&(Range<usize>, f64)| {
            let (t, r) = (corrections.as_ref(), self.columns.as_ref());
            products(t, r, own.clone()) > SMALLEST_ENERGY * whole
        };
        let kept = self.vectors.iter().filter(has_energy);
        let kept: Vec<usize> = kept.flat_map(|(own, _)| own.clone()).collect();
        pick_columns(corrections, &kept)
    }
}

/// `sum_j |a_j^T b_j|` over some columns.
fn products(a: MatRef<'_, f64>, b: MatRef<'_, f64>, columns: Range<usize>) -> f64 {
    columns.map(|j| dot(column(a, j), column(b, j)).abs()).sum()
}
