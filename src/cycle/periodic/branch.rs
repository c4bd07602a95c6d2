//! Periodic motions along a parameter.

use super::error::PeriodicError;
use super::map::{PeriodMap, PeriodicState};
use super::motion::{MotionRequest, PeriodicMotion};
use super::multipliers::FloquetMultipliers;
use super::search::find;
use crate::cycle::{BranchEnd, Parameter, Verdict};
use crate::transient::TransientError;

/// Parts of a step that are tried where a whole one leads nowhere.
const PARTS: [f64; 3] = [1.0, 0.5, 0.25];

/// One motion of a branch.
#[derive(Clone, Debug)]
pub struct BranchMotion {
    /// The parameter, SI.
    pub value: f64,
    /// The motion, without its histories.
    pub motion: PeriodicMotion,
    /// Its multipliers, where they were asked for, or why there are none.
    pub stability: Option<Result<FloquetMultipliers, String>>,
}

impl BranchMotion {
    /// Growth rate of its leading perturbation, 1/s, where it is known.
    pub fn growth_rate(&self) -> Option<f64> {
        let known = self.stability.as_ref()?.as_ref().ok()?;
        Some(known.leading()?.growth_rate)
    }

    /// Whether it is stable, where that is known for sure.
    pub fn is_stable(&self) -> Option<bool> {
        match self.stability.as_ref()?.as_ref().ok()?.verdict() {
            Verdict::Undecided => None,
            verdict => Some(verdict == Verdict::Stable),
        }
    }
}

/// Periodic motions along a parameter, by rising value.
#[derive(Clone, Debug)]
pub struct PeriodicBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// The motions.
    pub motions: Vec<BranchMotion>,
    /// Why it ends, at its smallest and at its largest value.
    pub ends: [BranchEnd; 2],
}

impl PeriodicBranch {
    /// Values between which it changes its stability, by the growth rates on both sides, SI.
    pub fn stability_changes(&self) -> Vec<f64> {
        let known = self.motions.iter();
        let known: Vec<(f64, f64, bool)> = known
            .filter_map(|own| Some((own.value, own.growth_rate()?, own.is_stable()?)))
            .collect();
        let pairs = known.windows(2).filter(|pair| pair[0].2 != pair[1].2);
        pairs
            .map(|pair| {
                let [(a, low, _), (b, high, _)] = [pair[0], pair[1]];
                a + (b - a) * (low / (low - high)).clamp(0.0, 1.0)
            })
            .collect()
    }
}

/// What a branch is followed with.
pub struct BranchRequest<'a, 'b> {
    /// The parameter.
    pub parameter: Parameter,
    /// Its values, SI, at which motions are wanted.
    pub values: &'b [f64],
    /// Whether multipliers are wanted.
    pub with_stability: bool,
    /// The period map at a value of the parameter; all weigh displacements alike.
    pub map: &'b dyn Fn(f64) -> Result<PeriodMap<'a>, TransientError>,
}

impl BranchRequest<'_, '_> {
    /// The branch through a motion at `own`, up and down from it: each motion is sought from its neighbour.
    ///
    /// There is no way around a fold: where no motion is found a quarter of a step on, the branch ends.
    ///
    /// # Errors
    /// A body that the time loop cannot take.
    pub fn follow(
        &self,
        own: f64,
        state: &PeriodicState,
    ) -> Result<PeriodicBranch, TransientError> {
        let mut rising = self.values.to_vec();
        rising.sort_by(f64::total_cmp);
        rising.dedup();
        let above: Vec<f64> = rising.iter().copied().filter(|v| *v >= own).collect();
        let below: Vec<f64> = rising.iter().rev().copied().filter(|v| *v < own).collect();
        let (mut motions, low) = self.along(own, state, &below)?;
        motions.reverse();
        let (up, high) = self.along(own, state, &above)?;
        motions.extend(up);
        Ok(PeriodicBranch {
            parameter: self.parameter,
            motions,
            ends: [low, high],
        })
    }

    /// The motions at values that lead away from `from`, and why they end.
    fn along(
        &self,
        mut from: f64,
        state: &PeriodicState,
        values: &[f64],
    ) -> Result<(Vec<BranchMotion>, BranchEnd), TransientError> {
        let mut state = state.clone();
        let mut motions = Vec::new();
        for &value in values {
            while from != value || motions.is_empty() {
                // A whole step, or the largest part of one that leads to a motion.
                let mut end = BranchEnd::Lost;
                let found = PARTS.iter().find_map(|part| {
                    let at = if *part == 1.0 {
                        value
                    } else {
                        from + part * (value - from)
                    };
                    match self.motion(at, &state) {
                        Ok(found) => Some(Ok((at, found))),
                        Err(PeriodicError::Stepping(error)) => Some(Err(error)),
                        Err(error) => {
                            end = match error {
                                PeriodicError::Died { .. } => BranchEnd::Birth,
                                _ => BranchEnd::Lost,
                            };
                            None
                        }
                    }
                });
                let Some((at, (next, motion))) = found.transpose()? else {
                    return Ok((motions, end));
                };
                (from, state) = (at, next);
                if at == value {
                    motions.push(motion);
                    break;
                }
            }
        }
        Ok((motions, BranchEnd::Range))
    }

    fn motion(
        &self,
        value: f64,
        state: &PeriodicState,
    ) -> Result<(PeriodicState, BranchMotion), PeriodicError> {
        let mut map = (self.map)(value)?;
        let found = find(&mut map, state.clone())?;
        let none = MotionRequest {
            instants: 0,
            frames: 0,
        };
        let motion = PeriodicMotion::of(&mut map, &found, none);
        let stability = self.with_stability.then(|| {
            let multipliers = FloquetMultipliers::of(&mut map, &found.state);
            multipliers.map_err(|error| error.to_string())
        });
        let motion = BranchMotion {
            value,
            motion,
            stability,
        };
        Ok((found.state, motion))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cycle::periodic::FloquetMultiplier;
    use crate::cycle::periodic::PeriodicPowers;
    use crate::linalg::c64;

    fn motion(value: f64, growth_rate: f64) -> BranchMotion {
        let multipliers = FloquetMultipliers {
            multipliers: vec![FloquetMultiplier {
                multiplier: c64::new(1.0, 0.0),
                growth_rate,
                uncertainty: 1.0,
                beat_hz: 0.0,
            }],
            shift: None,
            periods: 0,
        };
        BranchMotion {
            value,
            motion: PeriodicMotion {
                frequency_hz: 1.0,
                steps: 1,
                residual: 0.0,
                periods: 0,
                powers: PeriodicPowers::default(),
                fractions: [0.0; 3],
                shares: Vec::new(),
                node: 0,
                amplitude: 0.0,
                instants: Vec::new(),
                harmonics: Vec::new(),
                frames: Vec::new(),
            },
            stability: Some(Ok(multipliers)),
        }
    }

    #[test]
    fn stability_changes_between_motions_of_different_verdict() {
        let branch = PeriodicBranch {
            parameter: Parameter::FrictionCoefficient,
            motions: vec![motion(0.2, -30.0), motion(0.3, 0.5), motion(0.4, 10.0)],
            ends: [BranchEnd::Range; 2],
        };
        // The one in the middle is undecided.
        let changes = branch.stability_changes();
        assert_eq!(changes.len(), 1);
        assert!((changes[0] - 0.35).abs() < 1e-12, "{changes:?}");
    }
}
