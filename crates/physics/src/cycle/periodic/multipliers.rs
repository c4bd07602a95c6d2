//! Floquet multipliers of a periodic motion.

use super::map::{PeriodMap, PeriodicState};
use crate::cycle::arnoldi::{MultiplierSearch, Ritz, unit};
use crate::cycle::{CycleError, FloquetMultiplier, FloquetMultipliers};
use crate::linalg::dense::{difference, norm};
use crate::linalg::{GaussianNoise, c64};

/// Multipliers kept, and the residual of one that is worth listing.
const LISTED: (usize, f64) = (6, 0.1);
/// The leading ones that must have converged, and the residual of a converged one, relative to it.
const CONVERGED: (usize, f64) = (2, 4e-3);
/// Smallest and largest dimension of the Krylov space, and periods between two looks at it.
const DIMENSIONS: [usize; 3] = [16, 100, 4];
/// Length of a perturbation, relative to the amplitude: so large that some nodes change their status at another step, whose kinks
/// then count as they do in the motion.
const PERTURBATION: f64 = 3e-3;
/// A multiplier whose logarithm is within this of 0 and whose direction has this share along the motion is the shift in phase. A
/// node that starts to slip where friction falls with speed, at a whole step, takes it as far from 1 as 1.5.
const NEUTRAL: [f64; 2] = [0.5, 0.7];

impl FloquetMultipliers {
    /// Arnoldi's process on differences of the period map at a periodic motion, until the leading multipliers have converged.
    ///
    /// # Errors
    /// [`CycleError::NotFound`] where they do not.
    pub fn of(map: &mut PeriodMap<'_>, state: &PeriodicState) -> Result<Self, CycleError> {
        let (first, image) = (map.periods(), map.image(state));
        let length = PERTURBATION * image.vibration;
        let mut apply = |direction: &[f64]| {
            let pairs = state.motion.iter().zip(direction);
            let moved = PeriodicState {
                motion: pairs.map(|(x, d)| x + length * d).collect(),
                period: state.period,
            };
            let mut change = difference(&map.image(&moved).motion, &image.motion);
            change.iter_mut().for_each(|value| *value /= length);
            change
        };
        let mut noise = GaussianNoise::new(1);
        let start = (0..state.motion.len()).map(|_| noise.draw().re).collect();
        let [reach, least] = NEUTRAL;
        let search = MultiplierSearch {
            dimensions: DIMENSIONS,
            converged: CONVERGED,
            listed: LISTED,
            is_shift: &|own| own.value.ln().norm() < reach && own.along > least,
        };
        let found = search.run(&unit(start), image.rate.clone(), &mut apply);
        let found = found.map_err(|dimension| {
            CycleError::NotFound(format!(
                "the stability of this limit cycle cannot be told: no multiplier has converged \
                 after {dimension} periods; let a transient tell (cycle.confirmation_periods)"
            ))
        })?;
        // A node that changes its status bends the map: it has another slope along a direction than against it, and a
        // perturbation may meet either of them. Known is the one along; the other is smaller by as much as this at most.
        let first_listed = &found.listed[0];
        let along = unit(found.vector(first_listed).iter().map(|value| value.re).collect());
        let against: Vec<f64> = along.iter().map(|value| -value).collect();
        let sums = apply(&along).into_iter().zip(apply(&against));
        let sums: Vec<f64> = sums.map(|(one, other)| one + other).collect();
        let bend = norm(&sums) / first_listed.value.norm();
        let periods = map.periods() - first;
        // What is open of every rate: how far the shift is from 1, the residual, and the bend.
        let shift = found.shift;
        let off = shift.map_or(NEUTRAL[0], |shift| shift.norm().ln().abs());
        let of = |ritz: &Ritz| {
            let open = (ritz.residual + off + bend) / state.period;
            FloquetMultiplier::new(ritz.value, state.period, open)
        };
        Ok(Self { multipliers: found.listed.iter().map(of).collect(), shift, periods })
    }
}

/// What is kept of one motion: periods, the shift, and multipliers with growth rate, uncertainty and beat; or why there are none.
pub(super) type Kept = Result<(usize, Option<[f64; 2]>, Vec<[f64; 5]>), String>;

/// What is kept of what is known.
pub(super) fn kept(known: &Result<FloquetMultipliers, String>) -> Kept {
    let found = known.as_ref().map_err(String::clone)?;
    let numbers = found.multipliers.iter().map(|own| {
        let c64 { re, im } = own.multiplier;
        [re, im, own.growth_rate, own.uncertainty, own.beat_hz]
    });
    Ok((found.periods, found.shift.map(|own| [own.re, own.im]), numbers.collect()))
}

/// The inverse of [`kept`].
pub(super) fn recalled(kept: Kept) -> Result<FloquetMultipliers, String> {
    let (periods, shift, numbers) = kept?;
    let own = |[re, im, growth_rate, uncertainty, beat_hz]: [f64; 5]| FloquetMultiplier {
        multiplier: c64::new(re, im),
        growth_rate,
        uncertainty,
        beat_hz,
        mode: None,
    };
    Ok(FloquetMultipliers {
        multipliers: numbers.into_iter().map(own).collect(),
        shift: shift.map(|[re, im]| c64::new(re, im)),
        periods,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_multiplier_tells_what_becomes_of_the_cycle() {
        let kind = |re: f64, im: f64| FloquetMultiplier::new(c64::new(re, im), 1.0, 0.1).kind();
        assert!(kind(0.6, 0.9).contains("Neimark-Sacker"));
        assert!(kind(-1.1, 0.0).contains("doubling"));
        assert!(kind(1.1, 0.0).contains("fold"));
    }

    #[test]
    fn what_is_kept_of_multipliers_comes_back_bit_by_bit() {
        let known = FloquetMultipliers {
            multipliers: vec![FloquetMultiplier {
                multiplier: c64::new(0.1, -0.7),
                growth_rate: -3.0,
                uncertainty: 0.3,
                beat_hz: 12.5,
                mode: None,
            }],
            shift: Some(c64::new(0.999, 0.0)),
            periods: 17,
        };
        let unknown = FloquetMultipliers { shift: None, ..known.clone() };
        for found in [Ok(known), Ok(unknown), Err("no multiplier".to_owned())] {
            assert_eq!(recalled(kept(&found)), found);
        }
    }
}
