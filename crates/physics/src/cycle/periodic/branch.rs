//! Periodic motions along a parameter, through folds.

use super::corrector::{Corrector, Point};
use super::follower::Follower;
use super::map::PeriodMap;
use super::motion::PeriodicMotion;
use super::search::Found;
use crate::cea::SweepWatch;
use crate::cycle::continuation::{Values, both_halves, joined};
use crate::cycle::stability::{crossing, differing};
use crate::cycle::{BranchEnd, FloquetMultipliers, Parameter};
use crate::transient::TransientError;

/// What is known of the stability of a motion.
type Known = Result<FloquetMultipliers, String>;

/// Motions whose stability is worked out with one map; the groups run in parallel.
const GROUP: usize = 6;
/// Share of a branch's range by which steady sliding is looked at beyond it, where it shrinks.
const BORN_BEYOND: f64 = 0.05;
/// Share of the range within which an onset is where the branch begins.
const SAME: f64 = 2e-3;

/// One motion of a branch.
#[derive(Clone, Debug)]
pub struct BranchMotion {
    /// The parameter, SI.
    pub value: f64,
    /// The motion, without its histories.
    pub motion: PeriodicMotion,
    /// Whether the branch turns back here.
    pub is_fold: bool,
    /// Its multipliers, where they were asked for, or why there are none.
    pub stability: Option<Known>,
}

impl BranchMotion {
    /// Growth rate of its leading perturbation, 1/s, where it is known.
    pub fn growth_rate(&self) -> Option<f64> {
        Some(self.stability.as_ref()?.as_ref().ok()?.leading()?.growth_rate)
    }

    /// Whether it is stable, where that is known for sure.
    pub fn is_stable(&self) -> Option<bool> {
        self.stability.as_ref()?.as_ref().ok()?.verdict().is_stable()
    }
}

/// Periodic motions along a parameter, in the order of the branch: neighbours may lie on both sides of a fold.
#[derive(Clone, Debug)]
pub struct PeriodicBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// The motions.
    pub motions: Vec<BranchMotion>,
    /// Why it ends, at its first and at its last motion.
    pub ends: [BranchEnd; 2],
    /// The points at the value that was to be kept, with their states.
    pub kept: Vec<Point>,
    /// The value that was to be kept, SI.
    pub own: f64,
    /// Where it was started from, SI.
    pub start: f64,
    /// Values at which steady sliding loses its stability, SI, where these were looked for.
    pub onsets: Vec<f64>,
}

impl PeriodicBranch {
    /// Smallest and largest value, SI.
    pub fn range(&self) -> Option<[f64; 2]> {
        let [low, high] = crate::order::range(self.motions.iter().map(|own| own.value));
        (low <= high).then_some([low, high])
    }

    /// Values below and above one at which steady sliding has lost its stability, at which it may have regained it: the
    /// farthest cycle on that side, or a little further where the branch ends as it shrinks.
    pub fn beyond(&self, growing: f64) -> [Option<f64>; 2] {
        let Some([low, high]) = self.range() else {
            return [None; 2];
        };
        let further = BORN_BEYOND * (high - low);
        let shrinks = self.ends.contains(&BranchEnd::Birth);
        let of = |farthest: f64, sense: f64| {
            let value = if shrinks { farthest + sense * further } else { farthest };
            ((value - growing) * sense > 0.0 && value >= 0.0).then_some(value)
        };
        [of(low, -1.0), of(high, 1.0)]
    }

    /// Where cycles live beside stable sliding, SI: from the farthest cycle to the onset, lower value first.
    pub fn coexistence(&self) -> Vec<[f64; 2]> {
        let Some([low, high]) = self.range() else { return Vec::new() };
        let slightly = SAME * (high - low);
        // Sliding is unstable where the search has started.
        let pairs = self.onsets.iter().filter_map(|&onset| {
            let [from, to] = if onset < self.start { [low, onset] } else { [onset, high] };
            (to - from > slightly).then_some([from, to])
        });
        pairs.collect()
    }

    /// The smallest of several cycles at the kept value, where stable sliding lies inside it: what a kick must exceed to tip sliding
    /// into the largest.
    pub fn threshold(&self) -> Option<&PeriodicMotion> {
        self.coexistence().into_iter().find(|[from, to]| (*from..=*to).contains(&self.own))?;
        let here = self.motions.iter().filter(|own| own.value == self.own);
        let mut motions: Vec<&PeriodicMotion> = here.map(|own| &own.motion).collect();
        crate::order::sort_by_number(&mut motions, |a| a.amplitude);
        motions.first().copied().filter(|_| motions.len() > 1)
    }

    /// Values at which it turns back, SI, in its order.
    pub fn folds(&self) -> Vec<f64> {
        self.motions.iter().filter(|own| own.is_fold).map(|own| own.value).collect()
    }

    /// Values at which it changes its stability between two folds, by the growth rates on both sides, SI.
    pub fn stability_changes(&self) -> Vec<f64> {
        let changes = self.motions.split(|own| own.is_fold).flat_map(|piece| {
            let known = piece.iter().filter(|own| own.growth_rate().is_some());
            differing(known.map(|own| (own.is_stable(), (own.value, own.growth_rate()))))
        });
        changes.map(crossing).collect()
    }
}

/// What a branch is followed with.
pub struct BranchRequest<'a, 'b> {
    /// The parameter.
    pub parameter: Parameter,
    /// Its values, SI, at which motions are wanted.
    pub values: &'b [f64],
    /// A further one, within their range, whose motions are kept with their states.
    pub kept: f64,
    /// Whether multipliers are wanted.
    pub with_stability: bool,
    /// The period map of the body; all weigh displacements alike.
    pub map: &'b (dyn Fn() -> Result<PeriodMap<'a>, TransientError> + Sync),
    /// Keeps what is done, and recalls what an interrupted search has done.
    pub watch: &'b dyn SweepWatch,
    /// Gives a map another value of the parameter, SI.
    pub tune: &'b (dyn Fn(&mut PeriodMap<'a>, f64) -> Result<(), TransientError> + Sync),
}

impl BranchRequest<'_, '_> {
    /// The branch through a motion at `start`, both ways from it, by pseudo-arclength in the plane of parameter and amplitude.
    ///
    /// The way goes on through folds, which are found to a millionth of the range; it ends where the range does, where the
    /// cycle shrinks into steady sliding, and where it cannot be followed.
    ///
    /// # Errors
    /// A body that the time loop cannot take.
    pub fn follow(&self, start: f64, found: &Found) -> Result<PeriodicBranch, TransientError> {
        let mut values = Values::new(self.values);
        let [least, most] = values.range();
        if self.kept > least && self.kept < most {
            values = Values::new(&[self.values, &[self.kept]].concat()); // Only one inside: the range must not grow.
        }
        let scales = [most - least, found.image.amplitude]; // Both parts of a place are of the size of one.
        let half = |direction: f64| {
            let mut corrector = Corrector::new((self.map)()?, self.tune, scales);
            corrector.map.step_in(found.steps);
            let first = Point { value: start, found: found.clone(), is_fold: false };
            Ok(Follower::new(corrector, &values, first, direction))
        };
        let [(down, low_end), (mut up, high_end)] = both_halves(&values, start, self.watch, half)?;
        let mut points = joined(down.points, None, up.points.split_off(1)); // Both begin with the start: once is enough.
        let slightly = 1e-9 * scales[0];
        points.retain(|own| (least - slightly..=most + slightly).contains(&own.value)); // A start may lie outside, and the steps from it.
        Ok(PeriodicBranch {
            parameter: self.parameter,
            kept: points.iter().filter(|own| own.value == self.kept).cloned().collect(),
            motions: self.motions(&points)?,
            ends: [low_end, high_end],
            own: self.kept,
            start,
            onsets: Vec::new(),
        })
    }

    /// The motions of points, with their stability where it is wanted.
    fn motions(&self, points: &[Point]) -> Result<Vec<BranchMotion>, TransientError> {
        let groups = points.chunks(GROUP).enumerate();
        let groups: Result<Vec<_>, TransientError> =
            crate::parallel::map(groups, |(number, group)| {
                let name = format!("stability-{number}");
                let known = self.watch.recalled::<Vec<Known>>(&name).unwrap_or_default();
                let mut map = (self.map)()?;
                let motions = group.iter().enumerate().map(|(i, point)| {
                    (self.tune)(&mut map, point.value)?;
                    map.step_in(point.found.steps); // A motion repeats itself in its own number of steps alone.
                    let motion = PeriodicMotion::brief(&mut map, &point.found).0;
                    let stability = self.with_stability.then(|| match known.get(i) {
                        Some(known) => known.clone(),
                        None => {
                            let multipliers = FloquetMultipliers::of(&mut map, &point.found.state);
                            multipliers.map_err(|error| error.to_string())
                        }
                    });
                    let &Point { value, is_fold, .. } = point;
                    Ok(BranchMotion { value, motion, is_fold, stability })
                });
                let motions = motions.collect::<Result<Vec<_>, TransientError>>()?;
                if self.with_stability && known.len() < motions.len() {
                    let found = motions.iter().filter_map(|own| own.stability.as_ref());
                    self.watch.keep_value(&name, &found.collect::<Vec<&Known>>());
                }
                Ok(motions)
            });
        Ok(groups?.into_iter().flatten().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cycle::FloquetMultiplier;
    use crate::linalg::c64;

    fn motion(value: f64, growth_rate: f64) -> BranchMotion {
        let multipliers = FloquetMultipliers {
            multipliers: vec![FloquetMultiplier {
                multiplier: c64::ONE,
                growth_rate,
                uncertainty: 1.0,
                beat_hz: 0.0,
                mode: None,
            }],
            shift: None,
            periods: 0,
        };
        BranchMotion {
            value,
            is_fold: false,
            motion: PeriodicMotion::default(),
            stability: Some(Ok(multipliers)),
        }
    }

    #[test]
    fn stability_changes_between_motions_of_different_verdict() {
        let branch = PeriodicBranch {
            parameter: Parameter::FrictionCoefficient,
            motions: vec![motion(0.2, -30.0), motion(0.3, 0.5), motion(0.4, 10.0)],
            ends: [BranchEnd::Range; 2],
            kept: Vec::new(),
            own: 0.3,
            start: 0.3,
            onsets: Vec::new(),
        };
        // The one in the middle is undecided.
        let changes = branch.stability_changes();
        assert_eq!(changes.len(), 1);
        assert!((changes[0] - 0.35).abs() < 1e-12, "{changes:?}");
    }
}
