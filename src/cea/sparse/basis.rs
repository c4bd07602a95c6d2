//! Growth of the common basis until it holds the modes of every friction coefficient.

use super::error::CeaError;
use super::packed::PackedModes;
use super::reduced::{ReducedMode, ReducedModel};
use super::structure::{Linearization, ShiftInverted, Side, StiffnessFactors, StructureMatrices};
use crate::linalg::dense::{join_columns, orthonormal_complement};
use crate::linalg::{KrylovSchurSettings, LinalgError, LuAnalysis, Wanted, krylov_schur};
use crate::prestress::SlidingTangent;
use faer::Mat;
use std::sync::OnceLock;

/// Corrections of right vectors of unit length shorter than this are not added.
const RIGHT_TOLERANCE: f64 = 5e-13;
/// The same for left vectors, which only serve overlaps and derivatives.
const LEFT_TOLERANCE: f64 = 1e-3;
/// Friction values whose modes make up the compressed basis, besides the ends.
const CHEBYSHEV_POINTS: usize = 5;
/// Refinements of one basis before the preconditioner is considered unfit.
const MAX_ROUNDS: usize = 40;

/// Block Davidson iteration over friction coefficients.
///
/// The modes at `mu` of the projected problem leave residuals `r`; `K(0)^-1 r` are the directions that
/// the basis lacks. `K(0)` is symmetric and factorized once: as a preconditioner for all `mu` it costs a
/// fifth of the LU factors of `K(mu)`, and the directions found at one `mu` serve all others. Where this
/// does not converge (strong friction), [`BasisBuilder::search`] factorizes `K(mu)`.
///
/// Source: E. R. Davidson, J. Comput. Phys. 17 (1975), here in blocks over a family of problems.
pub struct BasisBuilder<'a> {
    tangent: &'a SlidingTangent,
    linearization: Linearization,
    preconditioner: StiffnessFactors,
    analysis: OnceLock<Result<LuAnalysis, LinalgError>>,
    /// The projected problem so far.
    pub model: ReducedModel,
    /// Modes to be held at every friction coefficient.
    pub count: usize,
}

impl<'a> BasisBuilder<'a> {
    /// Starts from frictionless `modes`, one column each, and the factors of `K(0)`.
    pub fn new(
        tangent: &'a SlidingTangent,
        linearization: Linearization,
        modes: &Mat<f64>,
        factors: StiffnessFactors,
    ) -> Self {
        let mut model = ReducedModel::empty(tangent, linearization);
        model.extend(modes.clone(), 1e-8);
        Self {
            tangent,
            linearization,
            preconditioner: factors,
            analysis: OnceLock::new(),
            model,
            count: modes.ncols(),
        }
    }

    /// Refines at `values` (friction coefficients, ascending) in a spread-out order until corrections
    /// vanish.
    ///
    /// # Errors
    /// If a dense decomposition fails.
    pub fn cover(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        let order = spread(values);
        let mut needs_left = true;
        for &mu in order.iter().cycle().take(MAX_ROUNDS) {
            let before = self.model.dimension();
            let left = self.refine(mu, needs_left)?;
            needs_left = left > LEFT_TOLERANCE;
            if self.model.dimension() == before {
                break;
            }
        }
        if values.len() > CHEBYSHEV_POINTS {
            self.compress(values)?;
        }
        Ok(())
    }

    /// Drops what the modes do not need: keeps their span at some of `values` (Chebyshev points, as the
    /// modes are smooth functions of the friction coefficient) and at 0.
    ///
    /// # Errors
    /// If a dense decomposition fails.
    fn compress(&mut self, values: &[f64]) -> Result<(), LinalgError> {
        let last = values.len() - 1;
        let angles = (0..CHEBYSHEV_POINTS).map(|i| (i as f64 + 0.5) / CHEBYSHEV_POINTS as f64);
        let positions = angles.map(|t| 0.5 - 0.5 * (t * std::f64::consts::PI).cos());
        let mut picked: Vec<usize> = positions
            .map(|t| (t * last as f64).round() as usize)
            .chain([0, last])
            .collect();
        picked.sort_unstable();
        picked.dedup();
        let m = self.model.dimension();
        let (mut right, mut left) = (Mat::zeros(m, 0), Mat::zeros(m, 0));
        for (i, mu) in picked
            .into_iter()
            .map(|i| values[i])
            .chain([0.0])
            .enumerate()
        {
            // Left vectors need fewer points, as they need fewer digits.
            let with_left = i % 2 == 0;
            let modes = self.modes(mu, with_left)?;
            let coordinates = |side| PackedModes::of(&modes, side, m).coordinates;
            right = join_columns(right.as_ref(), coordinates(Side::Right).as_ref());
            if with_left {
                left = join_columns(left.as_ref(), coordinates(Side::Left).as_ref());
            }
        }
        let none = Mat::<f64>::zeros(m, 0);
        let right = orthonormal_complement(none.as_ref(), right, RIGHT_TOLERANCE);
        let left = orthonormal_complement(right.as_ref(), left, LEFT_TOLERANCE);
        self.model
            .compress(&join_columns(right.as_ref(), left.as_ref()));
        Ok(())
    }

    /// One refinement of the right vectors at one friction coefficient; whether it added anything.
    ///
    /// # Errors
    /// If a dense decomposition fails.
    pub fn refine_at(&mut self, mu: f64) -> Result<bool, LinalgError> {
        let before = self.model.dimension();
        self.refine(mu, false)?;
        Ok(self.model.dimension() > before)
    }

    /// Adds corrections at `mu`; returns the longest left one.
    fn refine(&mut self, mu: f64, with_left: bool) -> Result<f64, LinalgError> {
        let modes = self.modes(mu, with_left)?;
        let right = self.corrections(&modes, mu, Side::Right);
        self.model.extend(right, RIGHT_TOLERANCE);
        if !with_left {
            return Ok(0.0);
        }
        let left = self.corrections(&modes, mu, Side::Left);
        let longest = longest_column(&left);
        self.model.extend(left, LEFT_TOLERANCE);
        Ok(longest)
    }

    fn modes(&self, mu: f64, with_left: bool) -> Result<Vec<ReducedMode>, LinalgError> {
        if with_left {
            self.model.solve(mu, self.count)
        } else {
            self.model.solve_right(mu, self.count)
        }
    }

    /// `K(0)^-1 r` of the modes' vectors on one side.
    fn corrections(&self, modes: &[ReducedMode], mu: f64, side: Side) -> Mat<f64> {
        let packed = PackedModes::of(modes, side, self.model.dimension());
        let vectors = self.model.expand(packed.coordinates.as_ref());
        let matrices = StructureMatrices::at(self.tangent, self.linearization, mu);
        let mut residuals = matrices.residuals(side, &packed.entries, vectors.as_ref());
        self.preconditioner.solve_in_place(side, &mut residuals);
        residuals
    }

    /// Adds the dominant vectors at `mu` from a Krylov-Schur iteration of its own, independent of the
    /// basis so far, with the factors of `K(mu)`; `extra` modes beyond the usual count.
    ///
    /// # Errors
    /// If `K(mu)` is singular or the iteration does not converge.
    pub fn search(&mut self, mu: f64, extra: usize) -> Result<(), CeaError> {
        let unknowns = self.tangent.stiffness.dimension();
        let matrices = StructureMatrices::at(self.tangent, self.linearization, mu);
        let factors = StiffnessFactors::general(self.tangent, &self.analysis, mu)?;
        let modes = (self.count + extra).min(unknowns);
        let wanted = match self.linearization {
            Linearization::Reduced(_) => modes,
            // Each mode is a conjugate pair.
            Linearization::Companion { .. } => 2 * modes,
        };
        for (side, tolerance, drop_below) in [
            (Side::Right, 1e-11, RIGHT_TOLERANCE),
            (Side::Left, 1e-6, LEFT_TOLERANCE),
        ] {
            let operator = ShiftInverted {
                matrices: &matrices,
                factors: &factors,
                side,
            };
            let settings = KrylovSchurSettings {
                wanted: Wanted::Largest(wanted),
                tolerance,
                block: 4,
                max_applications: 100 * (wanted + 20),
            };
            let pairs = krylov_schur(&operator, None, &settings)?;
            let mut vectors = pairs.vectors;
            vectors.truncate(unknowns, wanted);
            self.model.extend(vectors, drop_below);
        }
        Ok(())
    }
}

fn longest_column(columns: &Mat<f64>) -> f64 {
    (0..columns.ncols())
        .map(|j| columns.col(j).norm_l2())
        .fold(0.0, f64::max)
}

/// The values in an order that samples their range evenly at any time: the largest first, then the
/// middle, the quarters, and so on.
fn spread(values: &[f64]) -> Vec<f64> {
    let count = values.len();
    let mut order: Vec<usize> = Vec::with_capacity(count);
    let mut denominator = 1;
    while order.len() < count {
        for numerator in (1..=denominator)
            .rev()
            .filter(|n| denominator == 1 || n % 2 == 1)
        {
            let index = (count * numerator).div_ceil(denominator) - 1;
            if !order.contains(&index) {
                order.push(index);
            }
        }
        denominator *= 2;
        if denominator > 2 * count {
            order.extend(
                (0..count)
                    .filter(|i| !order.contains(i))
                    .collect::<Vec<_>>(),
            );
        }
    }
    order.into_iter().map(|i| values[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_visits_each_value_once_and_the_ends_and_middle_first() {
        let values: Vec<f64> = (0..9).map(f64::from).collect();
        let order = spread(&values);
        assert_eq!(order[..2], [8.0, 4.0]);
        let mut sorted = order.clone();
        sorted.sort_by(f64::total_cmp);
        assert_eq!(sorted, values);
        assert_eq!(spread(&[0.3]), [0.3]);
    }
}
