//! Motions of two frequencies along a parameter.

use super::super::cycle_branch::BranchEnd;
use super::super::parameter::Parameter;
use super::super::state::{STATE_COLUMNS, WaveState};
use super::super::system::Closure;
use super::{TwoWaveMotion, TwoWaves};
use crate::cea::SweepWatch;
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
    /// vanishes. `watch` keeps every motion, and recalls those of an interrupted search.
    pub fn follow(
        &self,
        motion: &TwoWaveMotion,
        parameter: Parameter,
        values: &[f64],
        watch: &dyn SweepWatch,
    ) -> TwoWaveBranch {
        let start = parameter.of(&motion.state.point);
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        let half = |name: &str, is_up: bool| {
            let ahead = values.iter().copied();
            let mut ahead: Vec<f64> =
                ahead.filter(|&value| if is_up { value > start } else { value < start }).collect();
            if !is_up {
                ahead.reverse();
            }
            let mut half = Half {
                waves: self,
                parameter,
                here: motion.clone(),
                found: Vec::new(),
                shrinking: None,
                birth: None,
            };
            let known = watch.recall(name);
            let end = known.and_then(|columns| half.recall(&columns));
            let end = end.unwrap_or_else(|| half.run(&ahead, &|columns| watch.keep(name, columns)));
            (half, end)
        };
        let (mut down, up) = rayon::join(|| half("down", false), || half("up", true));
        down.0.found.reverse();
        let births = down.0.birth.into_iter().chain(up.0.birth);
        TwoWaveBranch {
            parameter,
            births: births.collect(),
            ends: [down.1, up.1],
            motions: [down.0.found, vec![motion.clone()], up.0.found].concat(),
        }
    }
}

/// One half of a branch.
struct Half<'a> {
    waves: &'a TwoWaves,
    parameter: Parameter,
    here: TwoWaveMotion,
    found: Vec<TwoWaveMotion>,
    /// The weaker wave and its amplitude where it began to lead the way, m.
    shrinking: Option<(usize, f64)>,
    birth: Option<f64>,
}

/// Ends of a half by their codes.
const ENDS: [BranchEnd; 3] = [BranchEnd::Range, BranchEnd::Birth, BranchEnd::Lost];

impl Half<'_> {
    /// Goes on to the end; `keep` is given what is done after every motion.
    fn run(&mut self, values: &[f64], keep: &dyn Fn(&[Vec<f64>])) -> BranchEnd {
        while let (None, Some(&next)) = (self.shrinking, values.get(self.found.len())) {
            match self.reach(next) {
                true => self.found.push(self.here.clone()),
                false => {
                    let weaker = self.weaker();
                    self.shrinking = Some((weaker, self.here.amplitudes[weaker]));
                }
            }
            keep(&self.columns(None));
        }
        let mut end = self.shrinking.is_none().then_some(BranchEnd::Range);
        while end.is_none() {
            end = self.shrink(values[values.len() - 1]);
            keep(&self.columns(end));
        }
        let end = end.unwrap_or(BranchEnd::Lost);
        keep(&self.columns(Some(end)));
        end
    }

    /// Everything that the way on depends on: where it is, and the motions that are done.
    fn columns(&self, end: Option<BranchEnd>) -> Vec<Vec<f64>> {
        let code = end.and_then(|end| ENDS.iter().position(|own| *own == end));
        let mut course = vec![code.map_or(-1.0, |code| code as f64)];
        let birth = self.birth.unwrap_or(f64::NAN);
        let shrinking = self.shrinking;
        course.extend(shrinking.map_or([-1.0, 0.0], |(wave, from)| [wave as f64, from]));
        course.push(birth);
        let mut columns = vec![course];
        for motion in [&self.here].into_iter().chain(&self.found) {
            columns.push(vec![self.parameter.of(&motion.state.point)]);
            columns.extend(motion.state.columns());
        }
        columns
    }

    /// Takes up what was kept; its end, if it has come to one.
    fn recall(&mut self, columns: &[Vec<f64>]) -> Option<BranchEnd> {
        let (course, motions) = columns.split_first()?;
        let &[end, wave, from, birth] = &course[..] else {
            return None;
        };
        let motion = |columns: &[Vec<f64>]| {
            let (value, state) = columns.split_first()?;
            let mut point = self.here.state.point;
            self.parameter.set(&mut point, *value.first()?);
            let state = WaveState::from_columns(state, point)?;
            Some(self.waves.motion(state))
        };
        let mut all = motions.chunks_exact(1 + STATE_COLUMNS).map(motion);
        let (here, found) = (all.next()??, all.collect::<Option<_>>()?);
        (self.here, self.found) = (here, found);
        self.shrinking = (wave >= 0.0).then_some((wave as usize, from));
        self.birth = (!birth.is_nan()).then_some(birth);
        (end >= 0.0).then(|| ENDS.get(end as usize).copied()).flatten()
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
            let next = if rest.abs() <= step.abs() { value } else { self.value() + step };
            let mut start = self.here.state.clone();
            self.parameter.set(&mut start.point, next);
            start.impose_law();
            let found = self.waves.solved(&start, self.parameter, Closure::Value(next));
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
        true
    }

    /// One motion on towards where the weaker wave vanishes, whose amplitude leads the way; the end, if this is it.
    fn shrink(&mut self, last: f64) -> Option<BranchEnd> {
        let (weaker, first) = self.shrinking?;
        if self.here.amplitudes[weaker] <= VANISHED * first {
            return Some(BranchEnd::Birth);
        }
        interruption::check();
        let amplitude = SHRINKS * self.here.amplitudes[weaker];
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
            self.birth = None;
            return Some(BranchEnd::Range);
        }
        self.found.push(self.here.clone());
        None
    }
}
