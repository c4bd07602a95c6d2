//! Limit cycles of one harmonic: from birth to an operating point, and along a parameter.

use super::body::DiscModel;
use super::body::WaveBody;
use super::branch::Branch;
use super::continuation::{BranchEnd, Values, both_halves, joined};
use super::field::{field, start_of};
use super::grid::phases;
use super::limit_cycle::LimitCycle;
use super::onset::{largest_linear_wave, refined};
use super::parameter::{OperatingPoint, Parameter};
use super::wave::Wave;
use super::{CycleError, Family, Onset};
use crate::cea::Unwatched;
use std::f64::consts::TAU;

/// Most changes of contact state from birth to an operating point.
const MOST_STEPS_FROM_BIRTH: usize = 2_000;

/// Friction coefficient, over the critical one, beyond which a cycle below that is not sought.
const PASSED: f64 = 2.0;

/// Phases of the grid on which a fold must be found again, over those of its own, and how far apart the two folds may be, in
/// units of the value that a point of its own grid is worth.
const FINER: usize = 2;
const FOLD_APART: f64 = 4.0;

/// Where the wave lies on the grid of phases, in steps: where one curve closes on itself near its birth, because the
/// grid pins the wave, another leads away.
const ORIGINS: [f64; 4] = [0.0, 0.5, 0.25, 0.75];

/// Limit cycles along a parameter.
#[derive(Clone, Debug)]
pub struct CycleBranch {
    /// The parameter.
    pub parameter: Parameter,
    /// Cycles in the order of the branch; neighbours may lie on both sides of a fold.
    pub cycles: Vec<LimitCycle>,
    /// Parameter values, SI, at which the branch turns back by more than what one point of the grid is worth.
    pub folds: Vec<f64>,
    /// Why it ends, at its first and at its last cycle.
    pub ends: [BranchEnd; 2],
    /// Dense factorizations spent.
    pub factorizations: usize,
}

/// Limit cycles of one family.
pub struct CycleSolver {
    /// The family that it solves for.
    pub family: Family,
    /// Where its cycles are born.
    pub onset: Onset,
    /// Number of phases at which it is sampled.
    pub phases: usize,
    /// The body on these.
    pub(super) wave: Wave,
    /// The disc; its cycles have a damping of their own.
    pub model: DiscModel,
}

impl CycleSolver {
    /// The solver of the waves of `family`, born at `onset`, on a mesh of Quad4 elements, with `points` phases (odd; the
    /// next odd number is taken) or as many as the mesh asks for.
    ///
    /// # Errors
    /// [`CycleError`] for other elements, a mesh that cannot be built, a harmonic that it cannot carry, a wave that grows at any friction.
    pub fn born_at(
        model: &DiscModel,
        family: Family,
        onset: &Onset,
        points: Option<usize>,
    ) -> Result<Self, CycleError> {
        let (specification, material) = (&model.specification, &model.material);
        let (sectors, harmonic) = (specification.circumferential_elements, family.harmonic);
        let limit = sectors / 2;
        if !(1..=limit).contains(&harmonic) {
            return Err(CycleError::Asked(format!(
                "cycle.harmonics holds {harmonic}: a mesh of {sectors} sectors carries waves of 1 to {limit} nodal diameters"
            )));
        }
        if onset.friction_coefficient <= 0.0 {
            return Err(CycleError::Undamped(family));
        }
        // A wave with the rotor is one of `-n` in the phase that rises with time.
        let harmonic = harmonic as isize * -isize::from(onset.direction);
        let node = WaveBody::new(specification, material, [], harmonic)?.node_frequency;
        let nodes = sectors as f64 / family.harmonic as f64;
        let phases = phases(onset.frequency, node, nodes, points);
        let wave = Wave::new(model, [harmonic, 0], [onset.frequency, 0.0], [phases, 1])?;
        Ok(Self { family, onset: *onset, phases, wave, model: *model })
    }

    /// The limit cycle at an operating point.
    ///
    /// It is followed over the friction coefficient from its birth at the family's onset. Below the critical friction it must lie
    /// before the branch turns and passes twice that.
    ///
    /// # Errors
    /// [`CycleError`] for a point without limit cycle.
    pub fn find(&self, point: &OperatingPoint) -> Result<LimitCycle, CycleError> {
        check(point)?;
        let wave = &self.wave;
        let onset = refined(wave, &point.damping, &self.onset);
        let onset = onset.ok_or(CycleError::NotReached {
            family: self.family,
            key: "contact.friction_coefficient",
            value: point.contact.friction_coefficient,
            reached: self.onset.friction_coefficient,
            reason: "its onset moved away with the damping".to_owned(),
        })?;
        let target = point.contact.friction_coefficient;
        let (parameter, wanted) = (Parameter::FrictionCoefficient, Values::new(&[target]));
        let is_below = target < onset.friction_coefficient;
        let mut failure = (f64::NEG_INFINITY, BranchEnd::Lost);
        for shift in ORIGINS {
            let origin = TAU * shift / wave.points() as f64;
            let (state, event) = largest_linear_wave(wave, point, &onset, origin);
            let mut branch = Branch::new(wave, (parameter, &wanted), state, 1.0);
            (branch.pending, branch.steps) = (Some(event), MOST_STEPS_FROM_BIRTH);
            if is_below {
                branch.highest = PASSED * onset.friction_coefficient;
            }
            match branch.reach() {
                Ok(cycle) => return Ok(cycle),
                Err(end) if end.0 > failure.0 => failure = end, // The farthest tells why.
                Err(_) => {}
            }
        }
        let mut error = self.not_reached(parameter, target, failure);
        if let (true, CycleError::NotReached { reason, .. }) = (is_below, &mut error) {
            *reason = "it rises from its birth".to_owned(); // No cycle lies below such a birth.
        }
        Err(error)
    }

    /// The limit cycle at `point` from the one of a neighbouring point that differs in `parameter`.
    ///
    /// # Errors
    /// [`CycleError::NotReached`] if the branch ends before, [`CycleError::NotFound`] if it leaves the motions of the disc.
    pub fn continue_to(
        &self,
        cycle: &LimitCycle,
        parameter: Parameter,
        value: f64,
    ) -> Result<LimitCycle, CycleError> {
        let direction = value - parameter.of(&cycle.state.point);
        if direction == 0.0 {
            return Ok(cycle.clone());
        }
        let over = (parameter, &Values::new(&[value]));
        let found = Branch::new(&self.wave, over, cycle.state.clone(), direction).reach();
        found.map_err(|end| self.not_reached(parameter, value, end))
    }

    /// Why a branch that ends at a value has no cycle at another.
    fn not_reached(
        &self,
        parameter: Parameter,
        value: f64,
        (reached, end): (f64, BranchEnd),
    ) -> CycleError {
        match end {
            BranchEnd::Unphysical => CycleError::NotFound(format!(
                "the wave on {} elements around is no motion of the disc: it opens inside the \
                 cylinder or draws energy from normal contact. Refine the mesh \
                 (mesh.circumferential_elements and radial_elements), or try another cycle.phases",
                self.wave.body.sector_count
            )),
            _ => CycleError::NotReached {
                family: self.family,
                key: parameter.key(),
                value,
                reached,
                reason: end.describe().to_owned(),
            },
        }
    }

    /// The whole branch through `cycle` over `parameter` between the smallest and the largest of `values` (SI), with a
    /// cycle at every crossing of a value.
    ///
    /// A fold is one that the branch on a finer grid of phases has too: where many points of a coarse grid change their contact at
    /// once it turns back for a while.
    pub fn follow(&self, cycle: &LimitCycle, parameter: Parameter, values: &[f64]) -> CycleBranch {
        let mut branch = self.both_ways(cycle, parameter, values);
        if !branch.folds.is_empty()
            && let Some(finer) = self.on_finer_grid(cycle, parameter, values)
        {
            let near = FOLD_APART / self.phases as f64; // A point of a grid of M is worth 1 / M of the value.
            let is_there = |fold: &f64| {
                finer.folds.iter().any(|other| (other - fold).abs() <= near * fold.abs())
            };
            branch.folds.retain(is_there);
            branch.factorizations += finer.factorizations;
        }
        branch
    }

    /// The branch through the same cycle on a grid of more phases; none where that has no such cycle.
    fn on_finer_grid(
        &self,
        cycle: &LimitCycle,
        parameter: Parameter,
        values: &[f64],
    ) -> Option<CycleBranch> {
        let points = FINER * self.phases;
        let finer = Self::born_at(&self.model, self.family, &self.onset, Some(points)).ok()?;
        let own = finer.find(&cycle.state.point).ok()?;
        Some(finer.both_ways(&own, parameter, values))
    }

    fn both_ways(&self, cycle: &LimitCycle, parameter: Parameter, values: &[f64]) -> CycleBranch {
        let (start, values) = (parameter.of(&cycle.state.point), Values::new(values));
        let over = (parameter, &values);
        let half = |direction| Ok(Branch::new(&self.wave, over, cycle.state.clone(), direction));
        let Ok([(down, low_end), (up, high_end)]) = both_halves(&values, start, &Unwatched, half);
        let own = values.contains(start).then(|| cycle.clone()); // Both halves begin beyond it.
        CycleBranch {
            parameter,
            cycles: joined(down.cycles, own, up.cycles),
            folds: joined(down.turning.folds, None, up.turning.folds),
            ends: [low_end, high_end],
            factorizations: down.factorizations + up.factorizations,
        }
    }

    /// Displacement (m) and velocity (m/s) over all dofs of the mesh, in nodal frames, at a time (s).
    ///
    /// The state of a contact node at angle `theta` is that of phase `n theta + omega t`.
    pub fn field(&self, cycle: &LimitCycle, time: f64) -> [Vec<f64>; 2] {
        field(&self.wave, &cycle.state, [self.wave.body.harmonic, 0], time)
    }

    /// Displacement of a limit cycle at time zero (m) and its velocity half a step earlier (m/s), over all dofs in nodal
    /// frames: what the time loop starts from.
    pub fn starting_fields(&self, cycle: &LimitCycle, time_step: f64) -> [Vec<f64>; 2] {
        start_of(|time| self.field(cycle, time), time_step)
    }
}

fn check(point: &OperatingPoint) -> Result<(), CycleError> {
    let contact = &point.contact;
    if !(contact.rotation_speed > 0.0 && contact.rotation_speed.is_finite()) {
        return Err(CycleError::NotFound(format!(
            "contact.rotation_speed_rpm = {} must be positive: limit cycles live on a turning \
             cylinder (the mirror image of a case turns the other way)",
            contact.rotation_speed * 60.0 / TAU
        )));
    }
    for (key, value) in [
        ("contact.interference", contact.interference),
        ("contact.friction_coefficient", contact.friction_coefficient),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            let message = format!("{key} = {value} must be a positive finite number");
            return Err(CycleError::NotFound(message));
        }
    }
    Ok(())
}
