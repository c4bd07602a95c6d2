//! The projected problem as a solver of single branches, for the search of their onsets.

use super::RESIDUAL_BOUND;
use super::branches::TrackedBranch;
use super::mode::ReducedMode;
use super::point::{PointSolver, SolvedPoint};
use super::reduced::ReducedModel;
use crate::cea::onset::{BranchSolver, Instability, instabilities};
use crate::cea::{BranchPoint, UnstableInterval};
use crate::linalg::LinalgError;

/// Newton's steps to a crossing that is nearly known; two or three do.
const CROSSING_STEPS: usize = 8;
/// What a crossing may move by as the basis grows.
const NEAR: f64 = 1e-4;

/// A mode and its friction coefficient.
#[derive(Clone, Debug)]
pub struct State {
    /// Friction coefficient.
    pub mu: f64,
    /// Mode there.
    pub mode: ReducedMode,
}

impl State {
    /// What round-off of its growth rate may move a crossing by: much where friction hardly feeds the mode.
    pub fn doubt(&self) -> f64 {
        OnsetFinder::ROUND_OFF * self.mode.eigenvalue.norm() / self.mode.derivative.re.abs()
    }
}

/// An unstable interval, and the modes where it begins and ends between the points of a sweep.
pub struct FoundInterval {
    /// The interval.
    pub interval: UnstableInterval,
    /// Relative residual of the mode at its onset, see [`super::ModeCheck::residual`].
    residual: f64,
    found: Instability<State>,
}

impl FoundInterval {
    /// The mode at its critical friction; `None` where it is unstable from the start.
    pub fn onset(&self) -> Option<&State> {
        (!self.found.from_start).then_some(&self.found.onset)
    }

    /// The mode at its onset, if that misses the bound of converged pairs. A branch that is unstable from the start may come from beyond
    /// the wanted modes, whose points are checked: nothing was located there.
    pub fn missed(&self) -> Option<&State> {
        self.onset().filter(|_| !(self.residual <= RESIDUAL_BOUND))
    }

    /// Modes at its ends that lie within the range.
    pub fn crossings(&self) -> impl Iterator<Item = &State> {
        self.onset().into_iter().chain(&self.found.restabilized)
    }
}

/// Follows one branch between the points of a sweep.
pub struct OnsetFinder<'a> {
    /// Point solver of the sweep.
    pub solver: &'a PointSolver<'a>,
    /// Projected problem of the sweep.
    pub model: &'a ReducedModel,
    /// Points, ascending.
    pub points: &'a [SolvedPoint],
    /// Lower end of the range studied.
    pub lowest: f64,
}

impl OnsetFinder<'_> {
    /// All unstable intervals of one branch, if it is among the wanted modes anywhere.
    pub fn intervals(&mut self, branch: &TrackedBranch) -> Result<Vec<FoundInterval>, LinalgError> {
        let places = || branch.modes.iter().zip(self.points);
        let is_wanted = |(index, point): (&Option<usize>, &SolvedPoint)| {
            index.is_some_and(|i| i < point.wanted)
        };
        if !places().any(is_wanted) {
            return Ok(Vec::new());
        }
        // A branch is lost from sight above the range, at either end of its states.
        let in_range = places().filter(|(_, point)| point.friction_coefficient >= self.lowest);
        let states: Vec<Option<State>> = in_range
            .map(|(index, point)| {
                index
                    .map(|i| State { mu: point.friction_coefficient, mode: point.modes[i].clone() })
            })
            .collect();
        let mut intervals = Vec::new();
        for run in states.split(Option::is_none) {
            let run: Vec<State> = run.iter().flatten().cloned().collect();
            for found in instabilities(self, &run)? {
                intervals.push(self.report(branch, found));
            }
        }
        Ok(intervals)
    }

    fn report(&self, branch: &TrackedBranch, found: Instability<State>) -> FoundInterval {
        let State { mu, mode } = &found.onset;
        let check = &self.solver.check(self.model, *mu, std::slice::from_ref(mode))[0];
        let label = branch.label;
        let direction = self.solver.edge.direction(&check.edge, label.harmonic);
        let name = (label.harmonic, label.branch, direction);
        FoundInterval {
            interval: found.interval(name, |state| self.point(state)),
            residual: check.residual,
            found,
        }
    }

    /// The intervals of a branch that were `known` in a smaller basis, by Newton's steps from their ends; nothing where one does
    /// not settle near where it was.
    pub fn again(
        &self,
        branch: &TrackedBranch,
        known: &[FoundInterval],
    ) -> Option<Vec<FoundInterval>> {
        let mut intervals = Vec::new();
        for FoundInterval { found, .. } in known {
            let onset = match found.from_start {
                true => Some(found.onset.clone()),
                false => self.crossing_near(&found.onset),
            };
            let end = found.restabilized.as_ref().map(|end| self.crossing_near(end));
            let (Some(onset), false) = (onset, matches!(end, Some(None))) else {
                return None;
            };
            let instability =
                Instability { onset, restabilized: end.flatten(), from_start: found.from_start };
            intervals.push(self.report(branch, instability));
        }
        Some(intervals)
    }

    /// The crossing near `known`.
    fn crossing_near(&self, known: &State) -> Option<State> {
        let mut state = known.clone();
        for _ in 0..CROSSING_STEPS {
            state.mode = self.model.mode_near(state.mu, &state.mode)?;
            let lambda = state.mode.eigenvalue;
            let growth = lambda.re - Self::ROUND_OFF * lambda.norm();
            let step = growth / state.mode.derivative.re;
            if step.abs() <= Self::TOLERANCE * (1.0 + state.mu) {
                return Some(state);
            }
            state.mu -= step;
            if (state.mu - known.mu).abs() > NEAR * (1.0 + known.mu) {
                return None;
            }
        }
        None
    }
}

/// Overlap, 1 for equal modes, above which a mode found near both ends belongs to their branch.
const SAME: f64 = 0.8;

impl OnsetFinder<'_> {
    /// The branch at `guess` by an iteration from the nearer end, where what it finds overlaps with both.
    fn continued(&self, from: &State, to: &State, guess: BranchPoint) -> Option<ReducedMode> {
        let mu = guess.friction_coefficient;
        let ends = [from, to];
        let nearer = usize::from((to.mu - mu).abs() < (mu - from.mu).abs());
        let start = ReducedMode { eigenvalue: guess.eigenvalue, ..ends[nearer].mode.clone() };
        let mode = self.model.mode_near(mu, &start)?;
        self.are_same(mu, &mode, &ends.map(|end| end.mode.clone())).then_some(mode)
    }

    /// Whether `mode` at `mu` overlaps with each of `others`.
    fn are_same(&self, mu: f64, mode: &ReducedMode, others: &[ReducedMode]) -> bool {
        let (at, own) = (self.model.at(mu), std::slice::from_ref(mode));
        let [forward, backward] = [at.overlaps(own, others), at.overlaps(others, own)];
        (0..others.len()).all(|j| (forward[(0, j)] * backward[(j, 0)]).norm() > SAME)
    }
}

impl BranchSolver for OnsetFinder<'_> {
    type State = State;
    type Error = LinalgError;

    const ROUND_OFF: f64 = 1e-11;
    const TOLERANCE: f64 = 1e-9;

    fn point(&self, state: &State) -> BranchPoint {
        BranchPoint {
            friction_coefficient: state.mu,
            eigenvalue: state.mode.eigenvalue,
            rate: state.mode.derivative,
            residual: f64::NAN,
        }
    }

    /// The mode that overlaps most with both ends.
    fn between(
        &mut self,
        from: &State,
        to: &State,
        guess: BranchPoint,
    ) -> Result<Option<State>, LinalgError> {
        let mu = guess.friction_coefficient;
        if let Some(mode) = self.continued(from, to, guess) {
            return Ok(Some(State { mu, mode }));
        }
        let mut modes = self.model.solve(mu, self.points[0].modes.len())?;
        let at = self.model.at(mu);
        let ends = [from, to].map(|end| end.mode.clone());
        let overlaps = at.overlaps(&ends, &modes);
        let overlap = |end: usize, j: usize| {
            // Left vectors of ends near an exceptional point are long.
            let length: f64 = ends[end].left.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
            overlaps[(end, j)].norm() / length
        };
        // Near an exceptional point slopes are infinite, and the cubic is no guess: the straight line is.
        let t = ((mu - from.mu) / (to.mu - from.mu)).clamp(0.0, 1.0);
        let expected = from.mode.eigenvalue * (1.0 - t) + to.mode.eigenvalue * t;
        let score = |j: usize| {
            let distance = (modes[j].eigenvalue - expected).norm() / expected.norm();
            (overlap(0, j) + overlap(1, j)) / (1e-4 + distance)
        };
        let best = (0..modes.len()).max_by(|&i, &j| score(i).total_cmp(&score(j)));
        Ok(best.map(|best| {
            let coarse = modes.swap_remove(best);
            // That was in the span of samples, if there are any: the whole basis knows better.
            let is_coarse = self.model.has_samples();
            let fine = is_coarse.then(|| self.model.mode_near(mu, &coarse)).flatten();
            let fine = fine.filter(|fine| self.are_same(mu, fine, std::slice::from_ref(&coarse)));
            let mode = fine.unwrap_or(coarse);
            State { mu, mode }
        }))
    }
}
