//! Motions of two frequencies along a parameter.

use super::super::continuation::{BranchEnd, Values, Way, both_halves, joined};
use super::super::parameter::Parameter;
use super::super::state::WaveState;
use super::super::system::Closure;
use super::{TwoWaveMotion, TwoWaves};
use crate::cea::SweepWatch;
use crate::linalg::interruption;
use std::convert::Infallible;

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
    /// vanishes. `watch` keeps every motion, and recalls those of an interrupted search.
    pub fn follow(
        &self,
        motion: &TwoWaveMotion,
        parameter: Parameter,
        values: &[f64],
        watch: &dyn SweepWatch,
    ) -> TwoWaveBranch {
        let (start, values) = (parameter.of(&motion.state.point), Values::new(values));
        let half = |direction: f64| {
            Ok(Half {
                waves: self,
                parameter,
                ahead: values.ahead(start, direction > 0.0, 0.0),
                here: motion.clone(),
                found: Vec::new(),
                shrinking: None,
                birth: None,
            })
        };
        let Ok([(down, low_end), (up, high_end)]) = both_halves(&values, start, watch, half);
        TwoWaveBranch {
            parameter,
            births: down.birth.into_iter().chain(up.birth).collect(),
            ends: [low_end, high_end],
            motions: joined(down.found, Some(motion.clone()), up.found),
        }
    }
}

/// One half of a branch.
struct Half<'a> {
    waves: &'a TwoWaves,
    parameter: Parameter,
    /// Values asked for, in the order on the way.
    ahead: Vec<f64>,
    here: TwoWaveMotion,
    found: Vec<TwoWaveMotion>,
    /// The weaker wave and its amplitude where it began to lead the way, m.
    shrinking: Option<(usize, f64)>,
    birth: Option<f64>,
}

impl Way for Half<'_> {
    type Error = Infallible;
    /// What leads the way, where the weaker wave vanishes, and the states here and of those found.
    type Kept = (Option<(usize, f64)>, Option<f64>, Vec<WaveState>);
    const BLOCK: usize = 1;

    fn count(&self) -> usize {
        self.found.len()
    }

    /// Along the parameter from value to value, as long as that leads on, then along the amplitude of the weaker wave.
    fn advance(&mut self) -> Result<Option<BranchEnd>, Infallible> {
        let next = self.ahead.get(self.found.len()).copied();
        match (self.shrinking, next) {
            (Some(wave), _) => return Ok(self.shrink(wave)),
            (None, None) => return Ok(Some(BranchEnd::Range)),
            (None, Some(next)) if self.reach(next) => self.found.push(self.here.clone()),
            (None, Some(_)) => {
                let weaker = self.weaker();
                self.shrinking = Some((weaker, self.here.amplitudes[weaker]));
            }
        }
        Ok(None)
    }

    fn kept(&self) -> Self::Kept {
        let motions = [&self.here].into_iter().chain(&self.found);
        (self.shrinking, self.birth, motions.map(|own| own.state.clone()).collect())
    }

    fn take_up(&mut self, (shrinking, birth, states): Self::Kept) -> Option<()> {
        let waves = self.waves;
        let mut all = states.into_iter().map(|state| waves.motion(state));
        (self.here, self.found) = (all.next()?, all.collect()); // Here first, as they were kept.
        (self.shrinking, self.birth) = (shrinking, birth);
        Some(())
    }
}

impl Half<'_> {
    fn value(&self) -> f64 {
        self.parameter.of(&self.here.state.point)
    }

    fn weaker(&self) -> usize {
        usize::from(self.here.amplitudes[1] < self.here.amplitudes[0])
    }

    /// The motion at a value, by shorter steps where one does not lead there; false where none does or the weaker wave falls steeply.
    fn reach(&mut self, value: f64) -> bool {
        let weaker = self.weaker();
        let mut step = value - self.value();
        let mut halved = 0;
        while self.value() != value {
            interruption::check();
            let rest = value - self.value();
            let next = if rest.abs() <= step.abs() { value } else { self.value() + step }; // The last step ends exactly there.
            let mut start = self.here.state.clone();
            self.parameter.set(&mut start.point, next);
            start.impose_law(); // T = +-mu N goes with the friction.
            let found = self.waves.solved(&start, self.parameter, Closure::Value(next));
            let found = found.map(|state| self.waves.motion(state));
            let before = self.here.amplitudes[weaker];
            let share = |found: &TwoWaveMotion| found.amplitudes[weaker] / before;
            match found.filter(|found| (STEEP..1.0 / STEEP).contains(&share(found))) {
                Some(found) => self.here = found,
                None if halved < HALVINGS => {
                    step *= 0.5;
                    halved += 1;
                }
                None => return false,
            }
        }
        true
    }

    /// One motion on towards where the weaker wave vanishes, whose amplitude leads the way from its `first` one on; the end, if this is it.
    fn shrink(&mut self, (weaker, first): (usize, f64)) -> Option<BranchEnd> {
        let last = *self.ahead.last()?;
        if self.here.amplitudes[weaker] <= VANISHED * first {
            return Some(BranchEnd::Birth);
        }
        interruption::check();
        let amplitude = SHRINKS * self.here.amplitudes[weaker]; // It leads, and the parameter follows.
        let closure = Closure::Amplitude(weaker, amplitude);
        let Some(state) = self.waves.solved(&self.here.state, self.parameter, closure) else {
            return Some(BranchEnd::Lost);
        };
        let sense = (last - self.value()).signum();
        let before = std::mem::replace(&mut self.here, self.waves.motion(state));
        let [from, to] = [&before, &self.here]
            .map(|own| [self.parameter.of(&own.state.point), own.amplitudes[weaker].powi(2)]);
        // The square of the amplitude is linear in the parameter there.
        self.birth = Some(to[0] - to[1] * (to[0] - from[0]) / (to[1] - from[1]));
        if (self.value() - last) * sense > 0.0 {
            self.birth = None; // Beyond the range it was not reached.
            return Some(BranchEnd::Range);
        }
        self.found.push(self.here.clone());
        None
    }
}
