//! Where branches turn unstable and stable again, by root finding on the branch.

use super::branches::ModeBranch;
use super::packed::ComplexColumns;
use super::point::{PointSolver, SolvedPoint};
use super::reduced::{ReducedMode, ReducedModel};
use super::{CeaError, RESIDUAL_BOUND};
use crate::cea::UnstableInterval;
use crate::linalg::LinalgError;
use std::f64::consts::TAU;

/// Width of the final bracket of a critical friction coefficient.
const FRICTION_TOLERANCE: f64 = 1e-9;
/// Growth rate, relative to `|lambda|`, that is round-off of a neutral mode.
const NEUTRAL: f64 = 1e-11;
/// Subdivisions of an interval in which a branch may touch the axis and return.
const INTERIOR_SAMPLES: usize = 8;

/// A mode and its friction coefficient.
#[derive(Clone, Debug)]
struct State {
    mu: f64,
    mode: ReducedMode,
}

impl State {
    /// Growth rate, less the round-off of a neutral mode.
    fn growth(&self) -> f64 {
        self.mode.eigenvalue.re - NEUTRAL * self.mode.eigenvalue.norm()
    }

    fn is_unstable(&self) -> bool {
        self.growth() > 0.0
    }
}

/// Unstable intervals of one branch, the last one perhaps still open.
#[derive(Default)]
struct Found {
    intervals: Vec<Interval>,
}

struct Interval {
    onset: State,
    restabilized: Option<(f64, f64)>,
    from_start: bool,
    /// Whether the branch is among the wanted modes somewhere in the interval.
    is_wanted: bool,
}

impl Found {
    fn open(&mut self, onset: State, from_start: bool) {
        self.intervals.push(Interval {
            onset,
            restabilized: None,
            from_start,
            is_wanted: false,
        });
    }

    fn close(&mut self, end: &State) {
        if let Some(interval) = self.intervals.last_mut() {
            interval.restabilized = Some((end.mu, end.mode.eigenvalue.im / TAU));
        }
    }

    fn mark(&mut self, is_wanted: bool) {
        if let Some(interval) = self.intervals.last_mut() {
            interval.is_wanted |= is_wanted;
        }
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
    /// All unstable intervals of one branch.
    ///
    /// # Errors
    /// If a dense decomposition fails, or the mode at a crossing does not satisfy the full problem.
    pub fn intervals(&self, branch: &ModeBranch) -> Result<Vec<UnstableInterval>, CeaError> {
        let mut found = Found::default();
        let is_ever_wanted = (branch.modes.iter().zip(self.points))
            .any(|(index, point)| index.is_some_and(|i| i < point.wanted));
        if !is_ever_wanted {
            return Ok(Vec::new());
        }
        let mut previous: Option<(State, bool)> = None;
        for (k, point) in self.points.iter().enumerate() {
            if point.friction_coefficient < self.lowest {
                continue;
            }
            let Some(i) = branch.modes[k] else {
                previous = None;
                continue;
            };
            let is_wanted = i < point.wanted;
            let state = State {
                mu: point.friction_coefficient,
                mode: point.modes[i].clone(),
            };
            match previous.take() {
                Some((before, was_wanted)) => {
                    for (from, to) in self.crossings(&before, &state)? {
                        let root = self.root(&from, &to)?;
                        if to.is_unstable() {
                            found.open(root, false);
                        } else {
                            found.close(&root);
                        }
                        found.mark(is_wanted || was_wanted);
                    }
                }
                None if state.is_unstable() => found.open(state.clone(), true),
                None => {}
            }
            found.mark(is_wanted && state.is_unstable());
            previous = Some((state, is_wanted));
        }
        let reported = found.intervals.into_iter().filter(|f| f.is_wanted);
        reported.map(|f| self.report(branch, &f)).collect()
    }

    /// Brackets of all sign changes of the growth rate between two states.
    fn crossings(&self, from: &State, to: &State) -> Result<Vec<(State, State)>, LinalgError> {
        let mut states = vec![from.clone()];
        if from.is_unstable() == to.is_unstable() {
            let extreme = self.interior_extreme(from, to)?;
            states.extend(extreme.filter(|s| s.is_unstable() != from.is_unstable()));
        }
        states.push(to.clone());
        let pairs = states
            .windows(2)
            .filter(|w| w[0].is_unstable() != w[1].is_unstable());
        Ok(pairs.map(|w| (w[0].clone(), w[1].clone())).collect())
    }

    /// The state where the cubic through both ends has left their side of the axis furthest.
    fn interior_extreme(&self, from: &State, to: &State) -> Result<Option<State>, LinalgError> {
        let side = if from.is_unstable() { -1.0 } else { 1.0 };
        let samples = (1..INTERIOR_SAMPLES).map(|i| i as f64 / INTERIOR_SAMPLES as f64);
        let furthest = samples
            .map(|t| (t, side * hermite(from, to, t)))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match furthest {
            Some((t, excess)) if excess > 0.0 => self.between(from, to, t).map(Some),
            _ => Ok(None),
        }
    }

    fn report(&self, branch: &ModeBranch, found: &Interval) -> Result<UnstableInterval, CeaError> {
        let state = &found.onset;
        let modes = std::slice::from_ref(&state.mode);
        let check = &self.solver.check(self.model, state.mu, modes)[0];
        if check.residual.is_nan() || check.residual > RESIDUAL_BOUND {
            return Err(CeaError::NotConverged {
                friction_coefficient: state.mu,
                frequency_hz: state.mode.eigenvalue.im / TAU,
                residual: check.residual,
                bound: RESIDUAL_BOUND,
            });
        }
        Ok(UnstableInterval {
            harmonic: branch.label.harmonic,
            branch: branch.label.branch,
            direction: self
                .solver
                .edge
                .direction(&check.edge, branch.label.harmonic),
            critical_friction: state.mu,
            frequency_hz: state.mode.eigenvalue.im / TAU,
            restabilized: found.restabilized,
            unstable_from_start: found.from_start,
        })
    }

    /// Root of the growth rate in a bracket: cubic through both ends, safeguarded by bisection, until a
    /// Newton step from it would be shorter than the tolerance.
    fn root(&self, from: &State, to: &State) -> Result<State, LinalgError> {
        let (mut from, mut to) = (from.clone(), to.clone());
        let mut bisect = false;
        for _ in 0..80 {
            let width = to.mu - from.mu;
            if width <= FRICTION_TOLERANCE {
                break;
            }
            let t = if bisect { 0.5 } else { cubic_root(&from, &to) };
            let state = self.between(&from, &to, t.clamp(1e-6, 1.0 - 1e-6))?;
            let newton = (state.growth() / state.mode.derivative.re).abs();
            // Where eigenvalues meet, the derivative is not finite on the stable side: no Newton there.
            let is_smooth = state.mode.derivative.re.abs() * width < state.mode.eigenvalue.norm();
            if is_smooth && newton < FRICTION_TOLERANCE && state.growth().abs() > 0.0 && !bisect {
                return Ok(state);
            }
            if state.is_unstable() == from.is_unstable() {
                from = state;
            } else {
                to = state;
            }
            bisect = to.mu - from.mu > 0.5 * width && newton > 0.1 * width;
        }
        Ok(if to.is_unstable() { to } else { from })
    }

    /// The branch at the fraction `t` of the way from one state to another: the mode that overlaps most
    /// with both.
    fn between(&self, from: &State, to: &State, t: f64) -> Result<State, LinalgError> {
        let mu = from.mu + t * (to.mu - from.mu);
        let mut modes = self.model.solve(mu, self.points[0].modes.len())?;
        let at = self.model.at(mu);
        let columns = ComplexColumns::of(&modes, self.model.dimension());
        let (mass, damping) = (columns.mapped(&at.mass), columns.mapped(&at.damping));
        let overlap = |end: &ReducedMode, j: usize| {
            let sum = end.eigenvalue + modes[j].eigenvalue;
            let along = sum * mass.dot(&end.left, j) + damping.dot(&end.left, j);
            // Left vectors of ends near an exceptional point are long.
            let length: f64 = end.left.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
            along.norm() / length
        };
        let ends = [&from.mode, &to.mode];
        let score = |j: usize| {
            let expected = from.mode.eigenvalue * (1.0 - t) + to.mode.eigenvalue * t;
            let distance = (modes[j].eigenvalue - expected).norm() / expected.norm();
            ends.iter().map(|end| overlap(end, j)).sum::<f64>() / (1e-4 + distance)
        };
        let best = (0..modes.len())
            .max_by(|&i, &j| score(i).total_cmp(&score(j)))
            .unwrap_or(0);
        let mode = modes.swap_remove(best);
        Ok(State { mu, mode })
    }
}

/// Growth rate at the fraction `t` of an interval: cubic through values and derivatives at its ends.
fn hermite(from: &State, to: &State, t: f64) -> f64 {
    let width = to.mu - from.mu;
    let (d0, d1) = (
        width * from.mode.derivative.re,
        width * to.mode.derivative.re,
    );
    let s = 1.0 - t;
    s * s * (1.0 + 2.0 * t) * from.growth() + t * t * (3.0 - 2.0 * t) * to.growth() + s * s * t * d0
        - t * t * s * d1
}

/// Root of that cubic in a bracket, by bisection.
fn cubic_root(from: &State, to: &State) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (hermite(from, to, middle) > 0.0) == from.is_unstable() {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
