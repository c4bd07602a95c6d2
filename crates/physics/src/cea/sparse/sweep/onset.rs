//! The projected problem as a solver of single branches, for the search of their onsets.

use super::points::uncertainty;
use crate::cea::onset::{BranchSolver, Instability, instabilities};
use crate::cea::sparse::links::followed;
use crate::cea::sparse::*;

/// What round-off of a mode's growth rate may move a crossing by: much where friction hardly feeds the mode.
pub fn doubt(ModeAt { mode, .. }: &ModeAt) -> f64 {
    mode.round_off() * mode.eigenvalue.norm() / mode.derivative.re.abs() // d mu = d Re(lambda) / |Re lambda'|.
}

/// An unstable interval, and the modes where it begins and ends between the points of a sweep.
pub struct FoundInterval {
    /// The interval.
    pub interval: UnstableInterval,
    /// Relative residual of the mode at its onset, see [`crate::cea::sparse::ModeCheck::residual`].
    residual: f64,
    found: Instability<ModeAt>,
    /// Whether the branch was led back from the first point that has it.
    is_led_back: bool,
}

impl FoundInterval {
    /// The mode at its critical friction; `None` where that is only bounded.
    pub fn onset(&self) -> Option<&ModeAt> {
        self.interval.is_located().then_some(&self.found.onset)
    }

    /// The mode at its onset, if that misses the bound of converged pairs. A branch that is unstable from the start may come from beyond
    /// the wanted modes, whose points are checked: nothing was located there, unless it was led back.
    pub fn missed(&self) -> Option<&ModeAt> {
        let is_found = self.is_led_back || self.interval.is_located();
        (is_found && !(self.residual <= RESIDUAL_BOUND)).then_some(&self.found.onset)
    }

    /// Modes at its ends that lie within the range.
    pub fn crossings(&self) -> impl Iterator<Item = &ModeAt> {
        self.onset().into_iter().chain(&self.found.restabilized)
    }
}

impl SparseSweep<'_> {
    /// All unstable intervals of one branch, if it is among the wanted modes anywhere.
    pub(super) fn intervals_of(
        &self,
        branch: &TrackedBranch,
    ) -> Result<Vec<FoundInterval>, LinalgError> {
        let places = || branch.modes.iter().zip(&self.points).filter_map(|(i, p)| Some(((*i)?, p)));
        if !places().any(|(i, point)| i < point.wanted) {
            return Ok(Vec::new());
        }
        // A branch is lost from sight above the range, at either end of its states.
        let states = places().map(|(i, point)| ModeAt {
            mu: point.friction_coefficient,
            mode: point.modes[i].clone(),
        });
        // What it was between them, as the basis has it now.
        let passed = branch.passed.iter().map(|ModeAt { mu, mode }| {
            let found = self.builder.model.mode_near(*mu, mode);
            ModeAt { mu: *mu, mode: found.unwrap_or_else(|| mode.clone()) }
        });
        // Between the points it may be followed beyond the last that has it.
        let last = branch.end.iter().map(|end| end.seen.clone());
        let states = states.chain(passed);
        let mut states: Vec<ModeAt> = states.filter(|state| state.mu >= self.lowest).collect();
        crate::order::sort_by_number(&mut states, |state| state.mu);
        // Growth by no more than the rounding of the matrices crosses zero anywhere: no onset is sought.
        let growing = || states.iter().map(|state| &state.mode).filter(|mode| mode.is_growing());
        let rounding = |mode: &ReducedMode| ROUNDING_ERRORS * uncertainty(self.norms, mode);
        if growing().next().is_some() && growing().all(|own| own.grows_at_most(rounding(own))) {
            return Ok(Vec::new());
        }
        let end = states.last().map_or(self.lowest, |state| state.mu);
        states.extend(last.filter(|state| state.mu > end));
        let begin = states.first().map_or(self.lowest, |state| state.mu);
        let (mut solver, mut intervals) = (self, Vec::new());
        for mut found in instabilities(&mut solver, &states)? {
            // What grows where it comes into range, or where it was lost before, turned unstable farther below.
            let mut is_led_back = false;
            if found.lost_after.is_some() || found.from_start && begin > self.lowest {
                let earlier = self.led_back(&found.onset)?;
                is_led_back = earlier.is_some();
                match earlier {
                    Some(earlier) => {
                        let crosses = found.crosses && earlier.crosses;
                        found = Instability { restabilized: found.restabilized, crosses, ..earlier }
                    }
                    None => {
                        let mut points = self.points.iter().map(|p| p.friction_coefficient);
                        let below = points.rfind(|mu| *mu < found.onset.mu);
                        (found.from_start, found.lost_after) = (false, found.lost_after.or(below));
                    }
                }
            }
            // Nor does it grow where it could by no more, at its rate, from an onset to the end.
            let ModeAt { mu, mode } = &found.onset;
            let width = found.restabilized.as_ref().map_or(f64::INFINITY, |end| end.mu - mu);
            let is_rounding =
                width * mode.derivative.re.abs() <= rounding(mode) * mode.eigenvalue.norm();
            if !is_rounding {
                intervals.push(FoundInterval { is_led_back, ..self.report(branch, found) });
            }
        }
        Ok(intervals)
    }

    /// The instability that has come to `last`, found on the way back from there to where it does not grow, or to the lowest friction;
    /// nothing where it cannot be followed so far.
    fn led_back(&self, last: &ModeAt) -> Result<Option<Instability<ModeAt>>, LinalgError> {
        let (mut solver, mut states) = (self, vec![last.clone()]);
        let steps = MOST_ATTEMPTS.div_ceil(self.points.len()); // At least as many in all: a crossing lies between two.
        let points = self.points.iter().rev().map(|point| point.friction_coefficient);
        for place in points.filter(|mu| (self.lowest..last.mu).contains(mu)) {
            let start = states[0].mu;
            for step in 1..=steps {
                let mu = start + (place - start) * (step as f64 / steps as f64);
                let ModeAt { mu: from, mode } = &states[0];
                let Some(mode) = followed(&self.builder.model, (*from, mode), mu) else {
                    return Ok(None);
                };
                states.insert(0, ModeAt { mu, mode });
                if states[0].mode.eigenvalue.re <= 0.0 {
                    return Ok(instabilities(&mut solver, &states)?.pop());
                }
            }
        }
        Ok(instabilities(&mut solver, &states)?.pop())
    }

    /// The intervals of a branch, once found, in a basis that holds more of them: its crossings by Newton's method from where they were; all
    /// anew where that does not settle, or two neutral branches meet.
    pub(super) fn intervals_again(
        &self,
        branch: &TrackedBranch,
        known: &[FoundInterval],
    ) -> Result<Vec<FoundInterval>, LinalgError> {
        let again = |own: &FoundInterval| {
            let mut found = own.found.crosses.then(|| own.found.clone())?;
            if own.interval.is_located() {
                found.onset = self.crossing_near(&found.onset)?;
            }
            if let Some(end) = &mut found.restabilized {
                *end = self.crossing_near(end)?;
            }
            Some(FoundInterval { is_led_back: own.is_led_back, ..self.report(branch, found) })
        };
        match known.iter().map(again).collect() {
            Some(found) => Ok(found),
            None => self.intervals_of(branch),
        }
    }

    /// Where the growth of a mode crosses zero, by Newton's method from nearby.
    fn crossing_near(&self, ModeAt { mu, mode }: &ModeAt) -> Option<ModeAt> {
        let (mut mu, mut guess, mut is_there) = (*mu, mode.clone(), false);
        for _ in 0..MOST_STEPS {
            let mode = self.builder.model.mode_near(mu, &guess)?;
            let at = ModeAt { mu, mode };
            if is_there {
                return Some(at);
            }
            // What the basis lacked moves a crossing by less.
            let step = at.mode.eigenvalue.re / at.mode.derivative.re;
            if !(step.abs() <= BESIDE) {
                return None;
            }
            is_there = step.abs() <= SETTLED.max(doubt(&at)); // The mode at the next place is the last.
            mu -= step;
            guess = at.mode;
            guess.eigenvalue -= guess.derivative * step;
        }
        None
    }

    fn report(&self, branch: &TrackedBranch, found: Instability<ModeAt>) -> FoundInterval {
        let ModeAt { mu, mode } = &found.onset;
        let check = &self.check(*mu, std::slice::from_ref(mode))[0];
        let label = branch.label;
        let direction = self.edge.direction(&check.edge, label.harmonic);
        let name = (label.harmonic, label.branch, direction);
        FoundInterval {
            interval: found.interval(name, |state| self.point(state)),
            residual: check.residual,
            found,
            is_led_back: false,
        }
    }
}

impl BranchSolver for &SparseSweep<'_> {
    type State = ModeAt;
    type Error = LinalgError;

    const TOLERANCE: f64 = RESIDUAL_BOUND;

    fn point(&self, state: &ModeAt) -> BranchPoint {
        BranchPoint {
            friction_coefficient: state.mu,
            eigenvalue: state.mode.eigenvalue,
            rate: state.mode.derivative,
            residual: f64::NAN,
        }
    }

    fn round_off(&self, state: &ModeAt) -> f64 {
        state.mode.round_off()
    }

    /// The branch step by step, as it grows or ceases to: of two that meet one grows. Else the mode that overlaps most with both ends.
    fn between(
        &mut self,
        from: &ModeAt,
        to: &ModeAt,
        guess: BranchPoint,
    ) -> Result<Option<ModeAt>, LinalgError> {
        let mu = guess.friction_coefficient;
        let growing = if from.mode.is_growing() { from } else { to };
        if let Some(mode) = followed(&self.builder.model, (growing.mu, &growing.mode), mu) {
            return Ok(Some(ModeAt { mu, mode }));
        }
        let next = self.points.partition_point(|point| point.friction_coefficient < mu);
        let around = [next.saturating_sub(1), next.min(self.points.len() - 1)];
        let around = around.map(|k| &self.points[k].modes[..]);
        let mut modes = self.builder.model.solve_between(mu, around)?;
        let ends = [from, to].map(|end| end.mode.clone());
        let [overlaps, _] = self.builder.model.overlaps_at(mu, &ends, &modes);
        let overlap = |end: usize, j: usize| {
            // Left vectors of ends near an exceptional point are long.
            overlaps[(end, j)].norm() / length(&ends[end].left)
        };
        // Near an exceptional point slopes are infinite, and the cubic is no guess: the straight line is.
        let t = ((mu - from.mu) / (to.mu - from.mu)).clamp(0.0, 1.0);
        let expected = from.mode.eigenvalue * (1.0 - t) + to.mode.eigenvalue * t;
        let score = |j: usize| {
            let distance = (modes[j].eigenvalue - expected).norm() / expected.norm();
            (overlap(0, j) + overlap(1, j)) / (NEAR + distance)
        };
        let best = (0..modes.len()).max_by(|&i, &j| score(i).total_cmp(&score(j)));
        Ok(best.map(|best| {
            // That was in the span of samples, if there are any: the whole basis knows better.
            let coarse = modes.swap_remove(best);
            ModeAt { mu, mode: self.builder.model.mode_near(mu, &coarse).unwrap_or(coarse) }
        }))
    }
}
