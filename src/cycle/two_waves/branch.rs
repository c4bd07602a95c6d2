//! Motions of two frequencies along a parameter.

use super::super::cycle_branch::BranchEnd;
use super::super::parameter::Parameter;
use super::super::system::Closure;
use super::{TwoWaveMotion, TwoWaves};
use crate::linalg::interruption;

/// Share of the amplitude at the start by which the weaker wave falls from one motion to the next, where it shrinks.
const SHRINKS: f64 = 0.7;
/// Share of it at which it has vanished.
const VANISHED: f64 = 0.15;
/// Change of the weaker wave from one motion to the next beyond which its amplitude leads the way, not the parameter.
const STEEP: f64 = 0.7;
/// Halvings of a step along the parameter.
const HALVINGS: usize = 4;

/// Motions of two frequencies along a parameter, in its order.
#[derive(Clone, Debug)]
pub struct TwoWaveBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// The motions.
    pub motions: Vec<TwoWaveMotion>,
    /// Why it ends, at the first and at the last motion.
    pub ends: [BranchEnd; 2],
    /// Values, SI, at which the weaker wave vanishes and leaves the stronger one alone.
    pub births: Vec<f64>,
}

impl TwoWaves {
    /// The branch through a motion over a parameter, with one at every value (SI) that it reaches, down to where one of its waves
    /// vanishes.
    pub fn follow(
        &self,
        motion: &TwoWaveMotion,
        parameter: Parameter,
        values: &[f64],
    ) -> TwoWaveBranch {
        let start = parameter.of(&motion.state.point);
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        let mut branch = TwoWaveBranch {
            parameter,
            motions: vec![motion.clone()],
            ends: [BranchEnd::Range; 2],
            births: Vec::new(),
        };
        for (side, is_up) in [(0, false), (1, true)] {
            let ahead = values.iter().copied();
            let mut ahead: Vec<f64> = ahead
                .filter(|&value| if is_up { value > start } else { value < start })
                .collect();
            if !is_up {
                ahead.reverse();
            }
            let mut half = Half {
                waves: self,
                parameter,
                here: motion.clone(),
                found: Vec::new(),
                birth: None,
            };
            branch.ends[side] = half.run(&ahead);
            branch.births.extend(half.birth);
            match is_up {
                true => branch.motions.extend(half.found),
                false => {
                    half.found.reverse();
                    half.found.append(&mut branch.motions);
                    branch.motions = half.found;
                }
            }
        }
        branch
    }
}

/// One half of a branch.
struct Half<'a> {
    waves: &'a TwoWaves,
    parameter: Parameter,
    here: TwoWaveMotion,
    found: Vec<TwoWaveMotion>,
    birth: Option<f64>,
}

impl Half<'_> {
    fn run(&mut self, values: &[f64]) -> BranchEnd {
        for &value in values {
            if !self.reach(value) {
                return self.shrink(values);
            }
        }
        BranchEnd::Range
    }

    fn value(&self) -> f64 {
        self.parameter.of(&self.here.state.point)
    }

    fn weaker(&self) -> usize {
        usize::from(self.here.amplitudes[1] < self.here.amplitudes[0])
    }

    /// The motion at a value, by shorter steps where one does not lead there; false where none does or the weaker wave falls
    /// steeply.
    fn reach(&mut self, value: f64) -> bool {
        let weaker = self.weaker();
        let mut step = value - self.value();
        let mut halved = 0;
        while self.value() != value {
            interruption::check();
            let rest = value - self.value();
            let next = if rest.abs() <= step.abs() {
                value
            } else {
                self.value() + step
            };
            let mut start = self.here.state.clone();
            self.parameter.set(&mut start.point, next);
            start.impose_law();
            let found = self
                .waves
                .solved(&start, self.parameter, Closure::Value(next));
            let found = found.map(|state| self.waves.motion(state));
            let share =
                |found: &TwoWaveMotion| found.amplitudes[weaker] / self.here.amplitudes[weaker];
            match found.filter(|found| (STEEP..1.0 / STEEP).contains(&share(found))) {
                Some(found) => self.here = found,
                None if halved < HALVINGS => {
                    step *= 0.5;
                    halved += 1;
                }
                None => return false,
            }
        }
        self.found.push(self.here.clone());
        true
    }

    /// On to where the weaker wave vanishes: its amplitude leads the way.
    fn shrink(&mut self, values: &[f64]) -> BranchEnd {
        let weaker = self.weaker();
        let first = self.here.amplitudes[weaker];
        let last = values[values.len() - 1];
        let sense = (last - self.value()).signum();
        while self.here.amplitudes[weaker] > VANISHED * first {
            interruption::check();
            let amplitude = SHRINKS * self.here.amplitudes[weaker];
            let closure = Closure::Amplitude(weaker, amplitude);
            let Some(state) = self.waves.solved(&self.here.state, self.parameter, closure) else {
                return BranchEnd::Lost;
            };
            let before = std::mem::replace(&mut self.here, self.waves.motion(state));
            let [from, to] = [&before, &self.here].map(|own| {
                [
                    self.parameter.of(&own.state.point),
                    own.amplitudes[weaker].powi(2),
                ]
            });
            // The square of the amplitude is linear in the parameter there.
            self.birth = Some(to[0] - to[1] * (to[0] - from[0]) / (to[1] - from[1]));
            if (self.value() - last) * sense > 0.0 {
                self.birth = None;
                return BranchEnd::Range;
            }
            self.found.push(self.here.clone());
        }
        BranchEnd::Birth
    }
}
