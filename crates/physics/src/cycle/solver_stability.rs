//! Stability of cycles, and where a branch changes it.

use super::floquet::leading_multipliers;
use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;
use super::stability::{FloquetMultipliers, StabilityChange, crossing};
use super::stepping::MeshStepping;
use super::{CycleError, CycleSolver};
use crate::fem::operator::SimdLevel;

/// Halvings of the interval in which a branch changes its stability.
const HALVINGS: usize = 5;

/// A limit cycle as the mesh's own time stepping has it.
#[derive(Clone, Debug)]
pub struct SteppedCycle {
    /// The cycle, its powers and fractions those of the transient.
    pub cycle: LimitCycle,
    /// Its stability.
    pub stability: FloquetMultipliers,
    /// Sum of its leading modes: where to begin with those of a neighbour.
    modes: Vec<f64>,
}

impl SteppedCycle {
    /// A cycle of the same wave, larger or smaller: its exponents are the same. Its powers are its own, since they grow
    /// partly with the amplitude and partly with its square.
    #[must_use]
    pub fn scaled_to(&self, cycle: &LimitCycle) -> Self {
        Self { cycle: cycle.clone(), ..self.clone() }
    }
}

impl CycleSolver {
    /// Growth of small perturbations of a cycle.
    pub fn stability(&self, cycle: &LimitCycle) -> Result<FloquetMultipliers, CycleError> {
        Ok(self.stepping(SimdLevel::detect())?.settle(cycle, None)?.stability)
    }
}

impl MeshStepping<'_> {
    /// Settles a cycle in the transient of its mesh, and finds its leading Floquet exponents there.
    ///
    /// `neighbour` is a cycle nearby, whose modes are a start.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] if the transient cannot start, [`CycleError::NotFound`] if the exponents do not converge.
    pub fn settle(
        &self,
        cycle: &LimitCycle,
        neighbour: Option<&SteppedCycle>,
    ) -> Result<SteppedCycle, CycleError> {
        let period = self.period(cycle)?;
        let known = neighbour.map(|own| own.modes.as_slice());
        let (stability, modes) = leading_multipliers(&period, known)?;
        Ok(SteppedCycle { cycle: period.stepped(cycle), stability, modes })
    }

    /// Value of `parameter` (SI) at which the branch from one cycle to another, of different stability, changes it.
    ///
    /// The interval is halved five times, then the growth rate is interpolated. It ends early where the branch does not
    /// lead straight from one to the other.
    ///
    /// # Errors
    /// Those of [`Self::settle`].
    pub fn stability_change(
        &self,
        parameter: Parameter,
        stable: &SteppedCycle,
        unstable: &SteppedCycle,
    ) -> Result<StabilityChange, CycleError> {
        let mut ends = [stable.clone(), unstable.clone()];
        let at = |end: &SteppedCycle| parameter.of(&end.cycle.state.point);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (at(&ends[0]) + at(&ends[1]));
            let Ok(cycle) = self.solver.continue_to(&ends[0].cycle, parameter, middle) else {
                break;
            };
            let settled = self.settle(&cycle, Some(&ends[1]))?;
            let leading = settled.stability.leading();
            let side = usize::from(leading.is_some_and(|found| found.growth_rate > 0.0));
            ends[side] = settled;
        }
        let growing = ends[1].stability.leading().and_then(|found| found.mode);
        let rate = |end: &SteppedCycle| end.stability.leading().map(|found| found.growth_rate);
        Ok(StabilityChange {
            value: crossing(ends.each_ref().map(|end| (at(end), rate(end)))),
            harmonic: growing.map_or(0, |found| found.harmonic),
            frequency_hz: growing.map_or(0.0, |found| found.frequency_hz),
        })
    }
}
