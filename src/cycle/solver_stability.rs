//! Stability of cycles, and where a branch changes it.

use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;
use super::perturbed::Perturbed;
use super::stability::{CycleStability, PerturbationGrowth, StabilityChange};
use super::{CycleError, CycleSolver, WaveBody};

/// Halvings of the interval in which a branch changes its stability.
const HALVINGS: usize = 5;

impl CycleSolver {
    /// Growth of small perturbations, of each class `0 <= p <= n / 2` of harmonics `+-p + k n`.
    ///
    /// # Errors
    /// [`CycleError::Stability`] where the linearized contact conditions have no finite response.
    pub fn stability(&self, cycle: &LimitCycle) -> Result<CycleStability, CycleError> {
        let (n, signed) = (self.family().harmonic, self.body().harmonic());
        let highest = (self.grid().points / 2) as isize;
        let body = |class: usize| {
            let harmonics = (-highest..=highest).map(|k| class as isize + k * signed);
            WaveBody::new(&self.specification, &self.material, harmonics, signed)
        };
        let own = body(0)?;
        let mut perturbed = Perturbed::new(&own, &self.wave(), cycle);
        perturbed.calibrate();
        let mut classes = vec![PerturbationGrowth::of(&perturbed, 0, n)?];
        for class in 1..=n / 2 {
            let other = body(class)?;
            classes.push(PerturbationGrowth::of(
                &perturbed.with_body(&other),
                class,
                n,
            )?);
        }
        Ok(CycleStability { classes })
    }

    /// Value of `parameter` (SI) at which the branch from one cycle to another, of different stability, changes it.
    ///
    /// The interval is halved five times, then the growth rate is interpolated. It ends early where the branch does not
    /// lead straight from one to the other.
    ///
    /// # Errors
    /// Those of [`Self::stability`].
    pub fn stability_change(
        &self,
        parameter: Parameter,
        stable: &LimitCycle,
        unstable: &LimitCycle,
    ) -> Result<StabilityChange, CycleError> {
        let mut ends = [stable.clone(), unstable.clone()];
        let mut leading = [self.stability(stable)?, self.stability(unstable)?];
        let at = |cycle: &LimitCycle| parameter.of(&cycle.state.point);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (at(&ends[0]) + at(&ends[1]));
            let Ok(cycle) = self.continue_to(&ends[0], parameter, middle) else {
                break;
            };
            let stability = self.stability(&cycle)?;
            let side = usize::from(!stability.is_stable());
            ends[side] = cycle;
            leading[side] = stability;
        }
        let growing = leading[1].leading();
        let rate = |side: usize| leading[side].leading().map(|found| found.exponent.re);
        // Stable cycles without a slow exponent say nothing about how far the change is.
        let share = match (rate(0), rate(1)) {
            (Some(before), Some(after)) if after > before => -before / (after - before),
            _ => 0.5,
        };
        Ok(StabilityChange {
            value: at(&ends[0]) + share * (at(&ends[1]) - at(&ends[0])),
            harmonic: growing.map_or(0, |found| found.harmonic),
            frequency_hz: growing.map_or(0.0, |found| found.frequency_hz),
        })
    }
}
