//! The projected problem as a solver of single branches, for the search of their onsets.

use super::branches::{TrackedBranch, followed};
use super::mode::ReducedMode;
use super::point::{PointSolver, SolvedPoint};
use super::reduced::ReducedModel;
use super::{BESIDE, CONVERGED, RESIDUAL_BOUND, SAME, SAME_EIGENVALUE};
use crate::cea::onset::{BranchSolver, Instability, instabilities};
use crate::cea::vectors::length;
use crate::cea::{BranchPoint, UnstableInterval};
use crate::linalg::LinalgError;

/// Steps over the whole range, at least, in which a branch is led back: a crossing lies between two of them.
const STEPS_BACK: usize = 8;

/// A mode and its friction coefficient.
#[derive(Clone, Debug)]
pub struct State {
    /// Friction coefficient.
    pub mu: f64,
    /// Mode there.
    pub mode: ReducedMode,
}

impl State {
    /// Whether both are one mode at one friction coefficient.
    pub fn is_same(&self, other: &Self) -> bool {
        (self.mu - other.mu).abs() <= SAME_EIGENVALUE && self.mode.is_same(&other.mode)
    }

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
    /// Whether the branch was led back from the first point that has it.
    is_led_back: bool,
}

impl FoundInterval {
    /// The mode at its critical friction; `None` where that is only bounded.
    pub fn onset(&self) -> Option<&State> {
        self.interval.is_located().then_some(&self.found.onset)
    }

    /// The mode at its onset, if that misses the bound of converged pairs. A branch that is unstable from the start may come from beyond
    /// the wanted modes, whose points are checked: nothing was located there, unless it was led back.
    pub fn missed(&self) -> Option<&State> {
        let is_found = self.is_led_back || self.interval.is_located();
        (is_found && !(self.residual <= RESIDUAL_BOUND)).then_some(&self.found.onset)
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
        let places = || branch.modes.iter().zip(self.points).filter_map(|(i, p)| Some(((*i)?, p)));
        if !places().any(|(i, point)| i < point.wanted) {
            return Ok(Vec::new());
        }
        // A branch is lost from sight above the range, at either end of its states.
        let states = places().map(|(i, point)| State {
            mu: point.friction_coefficient,
            mode: point.modes[i].clone(),
        });
        // What it was between them, as the basis has it now.
        let passed = branch.passed.iter().map(|(mu, mode)| State {
            mu: *mu,
            mode: self.model.mode_near(*mu, mode).unwrap_or_else(|| mode.clone()),
        });
        // Between the points it may be followed beyond the last that has it.
        let last = branch.end.iter().map(|end| &end.seen);
        let last = last.map(|own| State { mu: own.between[0], mode: own.mode.clone() });
        let states = states.chain(passed);
        let mut states: Vec<State> = states.filter(|state| state.mu >= self.lowest).collect();
        crate::order::sort_by_number(&mut states, |state| state.mu);
        let end = states.last().map_or(self.lowest, |state| state.mu);
        states.extend(last.filter(|state| state.mu > end));
        let begin = states.first().map_or(self.lowest, |state| state.mu);
        let mut intervals = Vec::new();
        for mut found in instabilities(self, &states)? {
            // What grows where it comes into range, or where it was lost before, turned unstable farther below.
            let mut is_led_back = false;
            if found.lost_after.is_some() || found.from_start && begin > self.lowest {
                let earlier = self.led_back(&found.onset)?;
                is_led_back = earlier.is_some();
                match earlier {
                    Some(earlier) => {
                        found = Instability { restabilized: found.restabilized, ..earlier }
                    }
                    None => {
                        let mut points = self.points.iter().map(|p| p.friction_coefficient);
                        let below = points.rfind(|mu| *mu < found.onset.mu);
                        (found.from_start, found.lost_after) = (false, found.lost_after.or(below));
                    }
                }
            }
            intervals.push(FoundInterval { is_led_back, ..self.report(branch, found) });
        }
        Ok(intervals)
    }

    /// The instability that has come to `last`, found on the way back from there to where it does not grow, or to the lowest friction;
    /// nothing where it cannot be followed so far.
    fn led_back(&mut self, last: &State) -> Result<Option<Instability<State>>, LinalgError> {
        let mut states = vec![last.clone()];
        let steps = STEPS_BACK.div_ceil(self.points.len());
        let points = self.points.iter().rev().map(|point| point.friction_coefficient);
        for place in points.filter(|mu| (self.lowest..last.mu).contains(mu)) {
            let start = states[0].mu;
            for step in 1..=steps {
                let mu = start + (place - start) * (step as f64 / steps as f64);
                let State { mu: from, mode } = &states[0];
                let Some(mode) = followed(self.model, (*from, mode), mu) else {
                    return Ok(None);
                };
                states.insert(0, State { mu, mode });
                if states[0].mode.eigenvalue.re <= 0.0 {
                    return Ok(instabilities(self, &states)?.pop());
                }
            }
        }
        Ok(instabilities(self, &states)?.pop())
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
            is_led_back: false,
        }
    }
}

impl OnsetFinder<'_> {
    /// The branch at `guess` by an iteration from the nearer end, where what it finds overlaps with both.
    fn continued(&self, from: &State, to: &State, guess: BranchPoint) -> Option<ReducedMode> {
        let mu = guess.friction_coefficient;
        let ends = [from, to];
        let nearer = usize::from((to.mu - mu).abs() < (mu - from.mu).abs());
        let start = ReducedMode { eigenvalue: guess.eigenvalue, ..ends[nearer].mode.clone() };
        let mode = self.model.mode_near(mu, &start)?;
        let others = ends.map(|end| end.mode.clone());
        let own = std::slice::from_ref(&mode);
        let [forward, backward] = self.model.overlaps_at(mu, own, &others);
        let is_same = |j| (forward[(0, j)] * backward[(j, 0)] - 1.0).norm() < 2.0 * SAME;
        [0, 1].into_iter().all(is_same).then_some(mode)
    }
}

impl BranchSolver for OnsetFinder<'_> {
    type State = State;
    type Error = LinalgError;

    const ROUND_OFF: f64 = CONVERGED;
    const TOLERANCE: f64 = RESIDUAL_BOUND;

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
        // As it grows or ceases to, step by step: of two that meet one grows.
        let growing = if from.mode.is_growing() { from } else { to };
        if let Some(mode) = followed(self.model, (growing.mu, &growing.mode), mu) {
            return Ok(Some(State { mu, mode }));
        }
        let mut modes = self.model.solve_between(mu, self.points[0].modes.len())?;
        let ends = [from, to].map(|end| end.mode.clone());
        let [overlaps, _] = self.model.overlaps_at(mu, &ends, &modes);
        let overlap = |end: usize, j: usize| {
            // Left vectors of ends near an exceptional point are long.
            overlaps[(end, j)].norm() / length(&ends[end].left)
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
            // That was in the span of samples, if there are any: the whole basis knows better.
            let coarse = modes.swap_remove(best);
            let found = self.model.mode_near(mu, &coarse);
            let change = |own: &ReducedMode| (own.eigenvalue - coarse.eigenvalue).norm();
            let found = found.filter(|own| change(own) <= BESIDE * coarse.eigenvalue.norm());
            State { mu, mode: found.unwrap_or(coarse) }
        }))
    }
}
