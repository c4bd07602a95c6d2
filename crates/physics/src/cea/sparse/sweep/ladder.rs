//! The ladder of remedies for modes that have not converged.

use crate::cea::sparse::*;

/// Remedies, one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rung {
    /// Corrections by the factors without friction, which all points share, or an iteration at a point that has none yet.
    AtRest,
    /// Corrections by factors of the full problem beside the modes.
    Shifted,
    /// The same without the strongly damped motions that did not converge: combinations of what the basis does not hold take no places.
    Without,
    /// All motions of a small body: its full problem, decomposed.
    Whole,
    /// Nothing more: what is open is said.
    Spent,
}

/// How far one point has come.
#[derive(Clone, Copy, Debug)]
struct Ladder {
    rung: Rung,
    /// The error before the last round on this rung.
    error: f64,
}

impl Ladder {
    /// The remedy for what is left, the `error`: another one where the last did little. What is converged is only corrected, as long as
    /// that helps: round-off does not become less; by its own factors, too, where slow modes beside stiff ones are not sharp yet. The whole
    /// problem is one of a body that `is_small`.
    fn climb(&mut self, error: f64, [is_converged, is_sharp]: [bool; 2], is_small: bool) -> Rung {
        let does_little = !(error < LITTLE * std::mem::replace(&mut self.error, error)); // Or is no number.
        if does_little {
            self.rung = match self.rung {
                _ if is_sharp => Rung::Spent,
                Rung::AtRest => Rung::Shifted,
                _ if is_converged => Rung::Spent,
                Rung::Shifted => Rung::Without,
                Rung::Without if is_small => Rung::Whole,
                Rung::Without | Rung::Whole | Rung::Spent => Rung::Spent,
            };
            self.error = f64::INFINITY; // A rung begins with a round of its own.
        }
        self.rung
    }
}

impl SparseSweep<'_> {
    /// Grows the basis until the modes at all points converge, or nothing helps.
    pub(super) fn climb_all(&mut self) -> Result<(), CeaError> {
        let first = Ladder { rung: Rung::AtRest, error: f64::INFINITY };
        let mut ladders = vec![first; self.grid.len()];
        let is_small = self.builder.is_small() && !self.builder.is_whole; // Nothing is beyond all motions.
        loop {
            let mut missing = self.missing_points();
            missing.retain(|&k| ladders[k].rung != Rung::Spent);
            if missing.is_empty() {
                return Ok(());
            }
            // The worst point between two that the basis holds: the others there gain from what it gets.
            let gaps: Vec<usize> = self.grid.iter().map(|&mu| self.builder.gap(mu)).collect();
            let mut treated: Vec<usize> = Vec::new();
            let mut order = missing.clone();
            crate::order::sort_by_number(&mut order, |&k| -self.points[k].worst().1);
            for k in order {
                if !treated.contains(&gaps[k]) {
                    treated.push(gaps[k]);
                    let (residual, error) = self.points[k].worst();
                    let is_converged = residual <= RESIDUAL_BOUND;
                    let is_sharp = is_converged && self.points[k].is_sharp();
                    let rung = ladders[k].climb(error, [is_converged, is_sharp], is_small);
                    let is_alone =
                        missing.iter().filter(|&&other| gaps[other] == gaps[k]).count() == 1;
                    self.treat(k, rung, is_alone)?;
                }
            }
            // In the span of its own modes alone a point that was given up would be solved less well than before.
            missing.retain(|&k| ladders[k].rung != Rung::Spent);
            self.solve_treated(&missing)?;
        }
    }

    /// One remedy at point `k`, `is_alone` where no other open point would gain from modes computed anew there.
    fn treat(&mut self, k: usize, rung: Rung, is_alone: bool) -> Result<(), CeaError> {
        let (mu, point) = (self.grid[k], &self.points[k]);
        match rung {
            Rung::AtRest if self.builder.is_whole => {}
            Rung::AtRest if !(self.builder.is_sampled(mu) || self.is_near(k, is_alone)) => {
                self.builder.sample(&[mu])?;
            }
            Rung::AtRest | Rung::Shifted | Rung::Without => {
                self.leaves_out[k] = rung == Rung::Without;
                let may_be_none =
                    |mode: &ReducedMode| self.leaves_out[k] && mode.is_nearly_critical();
                let open: Vec<ReducedMode> = if rung == Rung::AtRest && !point.is_followed {
                    // Factors that are there serve all that is not down to round-off.
                    let pairs = point.modes.iter().zip(&point.checks);
                    let open = pairs.filter(|(_, check)| check.force_residual > CONVERGED);
                    open.map(|(mode, _)| mode.clone()).collect()
                } else {
                    let open = point.open_modes(self.goal()).filter(|mode| !may_be_none(mode));
                    open.cloned().collect()
                };
                self.builder.take_up(mu, &point.modes);
                if !open.is_empty() {
                    self.builder.correct(&[(mu, &open)], &[false], rung == Rung::AtRest);
                }
            }
            Rung::Whole => self.builder.hold_all(mu),
            Rung::Spent => {}
        }
        Ok(())
    }

    /// Whether corrections do at point `k`, as its error is small already: of one that is only followed two rounds of them.
    fn is_near(&self, k: usize, is_alone: bool) -> bool {
        let (point, (_, error)) = (&self.points[k], self.points[k].worst());
        if point.is_followed { error <= LITTLE.powi(2) } else { is_alone && error <= NEAR }
    }

    /// Residual force, relative to the inertia force, above which a point is improved.
    ///
    /// An eigenvalue is wrong by the product of the errors of its right and left vectors: this keeps it below 1e-9. With other than viscous
    /// damping the basis, made of right vectors alone, is too poor in left ones for errors of eigenvalues to be of second order.
    pub(super) fn goal(&self) -> f64 {
        match self.linearization {
            _ if self.tangent.is_lossy() => RESIDUAL_BOUND,
            // At 1e-7 the spectra of a sector and of its whole mesh were 1e-9 apart.
            Linearization::Reduced(..) => 1e-8,
            Linearization::Companion { .. } => 1e-7,
        }
    }

    /// Points whose modes could still be improved.
    fn missing_points(&self) -> Vec<usize> {
        let first = match self.linearization {
            Linearization::Reduced(..) => 0,
            Linearization::Companion { .. } => self.first_asked(), // At rest its branches only begin.
        };
        let goal = self.goal();
        let all = first..self.grid.len();
        all.filter(|&k| self.points[k].open_modes(goal).next().is_some()).collect()
    }

    /// Solves points after a remedy, and lets their modes stand for the samples there.
    fn solve_treated(&mut self, indices: &[usize]) -> Result<(), CeaError> {
        for (&k, point) in indices.iter().zip(self.solve_points(indices)?) {
            self.builder.hold_solved(self.grid[k], &point.modes);
            self.points[k] = point;
        }
        // All points are solved in spans of modes held.
        if let Some(columns) = self.builder.restrict() {
            self.points.iter_mut().for_each(|p| p.restrict(&columns));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Ladder, Rung};
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::sweep;
    use crate::cea::{ModeLimit, SweepRequest};
    use crate::linalg::dense_eigen::real_eigenvalues;
    use crate::linalg::{DenseLu, Mat, MatrixPolynomial, c64};
    use crate::prestress::SlidingTangent;
    use std::f64::consts::TAU;
    use std::sync::Arc;

    /// An error that falls keeps its remedy; one that stays, or is no number, takes the next one until all are spent.
    #[test]
    fn the_ladder_ends_whatever_becomes_of_an_error() {
        let climbed = |errors: &[f64], is_converged: [bool; 2], is_small: bool| {
            let mut ladder = Ladder { rung: Rung::AtRest, error: f64::INFINITY };
            let rungs = errors.iter().map(|&error| ladder.climb(error, is_converged, is_small));
            rungs.collect::<Vec<Rung>>()
        };
        let falling = [1.0, 0.2, 0.05, 0.01];
        assert_eq!(climbed(&falling, [false; 2], false), [Rung::AtRest; 4]);
        assert_eq!(climbed(&[1.0, 0.9], [true; 2], false), [Rung::AtRest, Rung::Spent]);
        let vague = climbed(&[1.0, 0.9, 0.8, 0.7], [true, false], false);
        assert_eq!(vague, [Rung::AtRest, Rung::Shifted, Rung::Shifted, Rung::Spent]);
        let (no_number, small) = ([f64::NAN; 5], [true, false]);
        let ends = small.map(|is_small| climbed(&no_number, [false; 2], is_small));
        assert_eq!(ends[0][..4], [Rung::Shifted, Rung::Without, Rung::Whole, Rung::Spent]);
        assert_eq!(ends[1][..3], [Rung::Shifted, Rung::Without, Rung::Spent]);
    }

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
    /// decomposition, and of that nothing is missing that is damped by less than half the critical. Of few modes, and of so many that
    /// all motions are held: friction brings others from above the limit.
    #[test]
    fn strongly_damped_motions_neither_hide_modes_nor_count_as_modes() {
        let frictions = [0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6];
        let limits = [ModeLimit::Lowest(8), ModeLimit::MaxFrequency(0.8 / TAU)];
        for (dashpot, limit) in [0.1, 0.5, 2.0].into_iter().flat_map(|own| limits.map(|l| (own, l)))
        {
            let tangent = slowly_sliding(dashpot);
            let request = SweepRequest::new(&frictions, limit);
            let found = sweep(&tangent, &request, &|_| {}).unwrap();
            for point in &found.points {
                let exact = dense(&tangent, point.friction_coefficient);
                let listed: Vec<c64> = point.modes.iter().map(|mode| mode.eigenvalue).collect();
                let holds = |all: &[c64], own: &c64| {
                    all.iter().any(|other| (other - own).norm() < 1e-8 * own.norm())
                };
                assert!(listed.iter().all(|own| holds(&exact, own)), "{listed:?}");
                let top = match limit {
                    ModeLimit::Lowest(_) => listed.iter().fold(0.0_f64, |top, own| top.max(own.im)),
                    ModeLimit::MaxFrequency(hz) => TAU * hz,
                };
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
