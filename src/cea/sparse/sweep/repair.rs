//! What makes the modes at the points of a sweep converge.

use super::{MAX_REPAIRS, SparseSweep};
use crate::cea::sparse::linearization::Linearization;
use crate::cea::sparse::mode::ReducedMode;
use crate::cea::sparse::pairs::FEW;
use crate::cea::sparse::{RESIDUAL_BOUND, TRACKING_MARGIN};
use crate::cea::{CeaError, ModeLimit};

/// Residual force, relative to the inertia force, up to which modes are corrected rather than computed anew.
const CORRECTABLE: f64 = 1e-4;
/// Ratio of errors before and after a repair above which repairs lead nowhere.
const SLOWEST: f64 = 0.9;
/// The same above which modes that are converged are left as they are: round-off does not become less.
const LITTLE: f64 = 0.5;
/// The same above which the few modes that are left at a point are found one by one.
const SLOW: f64 = 0.3;
/// Attempts to improve points, for each friction value, where a mode misses the bound of converged pairs.
const MAX_LAST_REPAIRS: usize = 6;

/// Residual force, relative to the inertia force, above which a point with other than viscous damping is improved: its basis, made of right
/// vectors alone, is too poor in left ones for errors of eigenvalues to be of second order.
const LOSSY_GOAL: f64 = 1e-9;

/// What was done to make one point converge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repairs {
    /// Error before the last correction.
    error_before: f64,
    /// Error before the last inverse iterations with factors of its own for each mode.
    error_of_iterations: f64,
}

impl Default for Repairs {
    fn default() -> Self {
        Self { error_before: f64::INFINITY, error_of_iterations: f64::INFINITY }
    }
}

/// The point of largest error in a round, and what was found there.
struct Worst {
    point: usize,
    /// Largest residual of its modes, relative to the matrices.
    residual: f64,
    /// Whether the last repair of the same point led nowhere.
    is_stuck: bool,
}

impl SparseSweep<'_> {
    /// Grows the basis until the modes at all points converge, or nothing helps.
    pub(super) fn repair_all(&mut self) -> Result<(), CeaError> {
        let (mut before, mut searched) = ((usize::MAX, f64::INFINITY), Vec::new());
        self.repairs = vec![Repairs::default(); self.grid.len()];
        for round in 0..MAX_REPAIRS + MAX_LAST_REPAIRS * self.grid.len() {
            // Where too many motions were left out, modes may lie beyond those that the basis was made from.
            let is_short = |k: &usize| self.is_short(*k) && !searched.contains(k);
            let short = (self.first_asked()..self.grid.len()).find(is_short);
            if let Some(k) = short {
                searched.push(k);
                self.builder.search(self.grid[k], TRACKING_MARGIN)?;
                self.solve_repaired(&[k])?;
                continue;
            }

            let missing = self.missing_points();
            let Some(&point) = self.by_error(&missing).first() else {
                break;
            };
            // What is converged is improved for a while, what is not for longer.
            let is_converged = |&k: &usize| self.points[k].worst().0 <= RESIDUAL_BOUND;
            let (residual, error) = self.points[point].worst();
            let gains_little = before.0 == point && error > LITTLE * before.1;
            let is_spent = gains_little || round >= MAX_REPAIRS + self.grid.len();
            if is_spent && missing.iter().all(is_converged) {
                break;
            }
            let worst = Worst {
                point,
                residual,
                is_stuck: before.0 == point && error > SLOWEST * before.1,
            };
            before = (point, error);
            if !self.repair_round(&worst, &missing, &mut searched)? {
                break;
            }
            self.solve_repaired(&missing)?;
        }
        Ok(())
    }

    /// One round; whether there was anything left to do.
    fn repair_round(
        &mut self,
        worst: &Worst,
        missing: &[usize],
        searched: &mut Vec<usize>,
    ) -> Result<bool, CeaError> {
        let mu = self.grid[worst.point];
        let is_hopeless = worst.is_stuck && worst.residual > RESIDUAL_BOUND;
        if self.has_few_slow(worst.point) {
            self.repair(missing)?;
        } else if is_hopeless && !searched.contains(&worst.point) {
            // Corrections by the stiffness without friction fail a mode that friction damps strongly: an iteration finds it.
            searched.push(worst.point);
            self.builder.search(mu, TRACKING_MARGIN)?;
        } else if is_hopeless && !self.leaves_out {
            self.leaves_out = true;
            searched.clear();
        } else if !self.repair(missing)? {
            if worst.residual <= RESIDUAL_BOUND {
                return Ok(false);
            }
            self.builder.search(mu, TRACKING_MARGIN)?;
        }
        Ok(true)
    }

    /// Residual force, relative to the inertia force, above which a point is improved.
    fn goal(&self) -> f64 {
        match self.builder.is_lossy() {
            true => LOSSY_GOAL,
            false => self.linearization.force_residual_goal(),
        }
    }

    /// Points whose modes could still be improved.
    fn missing_points(&self) -> Vec<usize> {
        let first = match self.linearization {
            Linearization::Reduced(..) => 0,
            Linearization::Companion { .. } => self.first_asked(),
        };
        let goal = self.goal();
        let all = first..self.grid.len();
        all.filter(|&k| self.points[k].misses_goal(goal)).collect()
    }

    /// Whether point `k` has fewer modes than are asked for, as motions that are none were left out.
    fn is_short(&self, k: usize) -> bool {
        match self.limit {
            ModeLimit::Lowest(count) => self.leaves_out && self.points[k].wanted < count,
            ModeLimit::MaxFrequency(_) => false,
        }
    }

    /// Solves points after a repair, and lets their modes stand for the samples there.
    fn solve_repaired(&mut self, indices: &[usize]) -> Result<(), CeaError> {
        self.solve_anew(indices)?;
        for &k in indices {
            let (mu, point) = (self.grid[k], &mut self.points[k]);
            self.builder.hold_solved(mu, &point.modes);
            point.solved_in = self.builder.model.sample_width(mu);
        }
        // All points are solved in spans of modes held.
        if let Some(columns) = self.builder.restrict() {
            self.points.iter_mut().for_each(|p| p.restrict(&columns));
        }
        Ok(())
    }

    /// `points` by falling error.
    fn by_error(&self, points: &[usize]) -> Vec<usize> {
        let error = |k: usize| self.points[k].worst().1;
        let mut order = points.to_vec();
        order.sort_by(|&a, &b| error(b).total_cmp(&error(a)));
        order
    }

    /// Makes the basis hold the modes better at the `missing` points: where they are solved for anew, at the worst between two
    /// that it holds, as the others gain from it. Whether the basis grew.
    fn repair(&mut self, missing: &[usize]) -> Result<bool, CeaError> {
        let gaps: Vec<usize> = self.grid.iter().map(|&mu| self.builder.gap(mu)).collect();
        let mut repaired: Vec<usize> = Vec::new();
        let mut has_grown = false;
        for k in self.by_error(missing) {
            if repaired.contains(&gaps[k]) {
                continue;
            }
            let (mu, point) = (self.grid[k], &self.points[k]);
            // A correction serves its own point alone.
            let beside = missing.iter().filter(|&&other| gaps[other] == gaps[k]).count();
            let is_near = beside == 1 && point.worst().1 <= CORRECTABLE;
            let error = point.worst().1;
            has_grown |= if self.has_few_slow(k) {
                self.converge(k)?
            } else if is_near && self.builder.is_sampling() {
                self.builder.correct_at(mu, &point.modes)?
            } else {
                self.builder.improve_at(mu)?
            };
            self.repairs[k].error_before = error;
            repaired.push(gaps[k]);
        }
        Ok(has_grown)
    }

    /// Modes at point `k` that could still be improved.
    fn open_modes(&self, k: usize) -> impl Iterator<Item = &ReducedMode> {
        self.points[k].open_modes(self.goal())
    }

    /// Whether the last correction of point `k` won little, and only a few modes are left there, which can be found one by one.
    fn has_few_slow(&self, k: usize) -> bool {
        let (error, before) = (self.points[k].worst().1, self.repairs[k]);
        let is_slow = error > SLOW * before.error_before;
        let is_promising = error < SLOWEST * before.error_of_iterations;
        is_slow && is_promising && self.can_converge(k)
    }

    /// Whether the modes that are left at point `k` can be found one by one.
    fn can_converge(&self, k: usize) -> bool {
        self.builder.can_converge_at(self.grid[k]) && self.open_modes(k).count() <= FEW
    }

    /// Finds the modes that are left at point `k` one by one; whether the basis grew.
    pub(super) fn converge(&mut self, k: usize) -> Result<bool, CeaError> {
        self.repairs[k].error_of_iterations = self.points[k].worst().1;
        let open: Vec<ReducedMode> = self.open_modes(k).cloned().collect();
        self.builder.converge_at(self.grid[k], &open)
    }
}

#[cfg(test)]
mod tests {
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::sweep;
    use crate::cea::{ModeLimit, SweepRequest};
    use crate::linalg::dense_eigen::real_eigenvalues;
    use crate::linalg::{DenseLu, Mat, MatrixPolynomial, c64};
    use crate::prestress::SlidingTangent;
    use std::sync::Arc;

    /// The string with dashpots `mu dashpot` on every third mass, as friction across slow sliding is.
    fn slowly_sliding(dashpot: f64) -> SlidingTangent {
        let mut tangent = string_on_belt(60, 0.4, false);
        let pattern = Arc::clone(tangent.stiffness.pattern());
        let dashpots = (0..20).map(|i| (3 * i, 3 * i, dashpot)).collect();
        let added = MatrixPolynomial::on_pattern(&pattern, &[Vec::new(), dashpots]);
        tangent.damping = MatrixPolynomial::combination(1.0, &tangent.damping, 1.0, &added);
        tangent
    }

    /// All eigenvalues that oscillate, of the linearized problem.
    fn dense(tangent: &SlidingTangent, mu: f64) -> Vec<c64> {
        let pattern = tangent.stiffness.pattern();
        let n = pattern.dimension();
        let full = |polynomial: &MatrixPolynomial| {
            pattern.multiply(&polynomial.evaluate(mu), Mat::identity(n, n).as_ref())
        };
        let [mut stiffness, mut damping] = [&tangent.stiffness, &tangent.damping].map(full);
        let lu = DenseLu::factorize(full(&tangent.mass));
        lu.solve_in_place(stiffness.as_mut());
        lu.solve_in_place(damping.as_mut());
        let companion = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, _) => f64::from(u8::from(j == i + n)),
            (false, true) => -stiffness[(i - n, j)],
            (false, false) => -damping[(i - n, j - n)],
        });
        let all = real_eigenvalues(companion.as_ref()).unwrap();
        all.into_iter().filter(|own| own.im > 1e-9).collect()
    }

    /// Independent check: dashpots that grow with friction to beyond critical damping. What is listed is in the spectrum of a dense
    /// decomposition, and of that nothing is missing that is damped by less than half the critical.
    #[test]
    fn strongly_damped_motions_neither_hide_modes_nor_count_as_modes() {
        let frictions = [0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6];
        for dashpot in [0.1, 0.5, 2.0] {
            let tangent = slowly_sliding(dashpot);
            let request = SweepRequest {
                friction_coefficients: &frictions,
                limit: ModeLimit::Lowest(8),
                shapes_at: &[],
                count_modes: false,
            };
            let found = sweep(&tangent, &request, &|_| {}).unwrap();
            for point in &found.points {
                let exact = dense(&tangent, point.friction_coefficient);
                let listed: Vec<c64> = point.modes.iter().map(|mode| mode.eigenvalue).collect();
                let holds = |all: &[c64], own: &c64| {
                    all.iter().any(|other| (other - own).norm() < 1e-8 * own.norm())
                };
                assert!(listed.iter().all(|own| holds(&exact, own)), "{listed:?}");
                let top = listed.iter().fold(0.0_f64, |top, own| top.max(own.im));
                let lightly_damped =
                    exact.iter().filter(|own| own.im < top && -own.re < 0.5 * own.norm());
                for own in lightly_damped {
                    let mu = point.friction_coefficient;
                    assert!(holds(&listed, own), "{dashpot} {mu}: {own} not in {listed:?}");
                }
            }
        }
    }
}
