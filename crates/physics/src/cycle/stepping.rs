//! Limit cycles in the mesh's own time stepping. What one period of the explicit transient does to
//! a cycle, and to small perturbations that ride on it.

use super::field::start_of;
use super::limit_cycle::{CyclePowers, LimitCycle};
use super::moving::MovingDofs;
use super::state::PointState;
use super::{CycleError, CycleSolver};
use crate::contact::ContactStatus;
use crate::fem::RayleighDamping;
use crate::fem::operator::{MotionFields, SimdLevel, StepCoefficients};
use crate::fem::operator::{StiffnessOperator, largest_frequency};
use crate::linalg::interruption;
use crate::mesh::AnnulusMesh;
use crate::transient::{
    CentralDifference, OperatorChoice, Perturbation, SAFETY, TimeStep, TransientModel,
    TransientSettings, stable_step_limit,
};
use std::f64::consts::TAU;

/// Periods of the transient between a wave that satisfies the contact laws on a grid of phases and the one that is looked
/// at: what the grid and its landing time leave of a difference to the mesh's own cycle fades meanwhile.
const SETTLING: usize = 4;

/// The time stepping of a solver's mesh, shared by all its cycles.
pub struct MeshStepping<'a> {
    pub(super) solver: &'a CycleSolver,
    annulus: AnnulusMesh,
    operator: Box<dyn StiffnessOperator>,
    largest_frequency: f64,
}

/// One period of a transient on a limit cycle, and the linear map that its contact makes of perturbations.
///
/// The statuses of all nodes at all steps are those of the cycle; a perturbation then moves by the explicit step itself,
/// with `du_n = 0` in contact, `dv_t = 0` in stick and `dT = +-mu dN` in slip. What a perturbation does to the times of
/// landing and of coming to rest is in those conditions: a landing node has `du_n = dv_n = 0` afterwards, and the forces of
/// its first two steps shift its tangential motion by as much as they come earlier.
pub struct Period<'a> {
    stepping: &'a MeshStepping<'a>,
    coefficients: StepCoefficients,
    friction_coefficient: f64,
    /// Places of the normal and tangential dof of each contact node.
    places: Vec<[usize; 2]>,
    /// Contact of each node, step after step.
    contact: Vec<PointState>,
    moving: MovingDofs,
    /// Harmonic of the wave in the phase `n theta + omega t`.
    pub harmonic: isize,
    /// Its length, s.
    pub duration: f64,
    /// Mean powers, W/m.
    pub powers: CyclePowers,
    /// Fractions of nodes that `[stick, slip, open]`.
    pub fractions: [f64; 3],
    /// Displacement and velocity at its start, as a perturbation.
    start: Vec<f64>,
}

impl CycleSolver {
    /// The time stepping of its mesh.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] for a mesh that it cannot take.
    pub fn stepping(&self, simd: SimdLevel) -> Result<MeshStepping<'_>, CycleError> {
        let annulus = AnnulusMesh::generate(&self.model.specification)?;
        let undamped = RayleighDamping::default();
        let unloaded = super::onset::unloaded(&self.model.specification);
        let model = TransientModel::of_annulus(&annulus, &self.model.material, undamped, unloaded);
        let operator = model.operator(OperatorChoice::Auto, simd)?;
        let largest_frequency = largest_frequency(operator.as_ref());
        Ok(MeshStepping { solver: self, annulus, operator, largest_frequency })
    }
}

impl MeshStepping<'_> {
    /// A transient on `cycle`, seeded with a velocity (m/s) in one harmonic where one is given, and its steps to a period.
    pub(super) fn start(
        &self,
        cycle: &LimitCycle,
        seed: Option<(usize, f64)>,
    ) -> Result<(CentralDifference<'_>, usize), CycleError> {
        self.start_from(cycle, seed, |time| self.solver.field(cycle, time))
    }

    /// The same at the operating point of `cycle` from other fields: displacement (m) and velocity (m/s) at a time (s).
    pub(super) fn start_from(
        &self,
        cycle: &LimitCycle,
        seed: Option<(usize, f64)>,
        field: impl Fn(f64) -> [Vec<f64>; 2],
    ) -> Result<(CentralDifference<'_>, usize), CycleError> {
        let point = &cycle.state.point;
        let duration = TAU / cycle.state.frequency();
        let limit = stable_step_limit(self.largest_frequency, &point.damping); // 2 / omega_max (sqrt(1 + zeta^2) - zeta).
        let steps = (duration / (SAFETY * limit)).ceil() as usize; // Whole steps, so that a period ends with one.
        let time_step = duration / steps as f64;
        let (annulus, material) = (&self.annulus, &self.solver.model.material);
        let model = TransientModel::of_annulus(annulus, material, point.damping, point.contact);
        let step = TimeStep::Seconds(time_step);
        let mut settings = TransientSettings::sliding(duration, step, duration);
        if let Some((harmonic, velocity)) = seed {
            settings.perturbation = Perturbation::of(&[harmonic], velocity);
        }
        let [displacement, velocity] = start_of(field, time_step);
        let operator = self.operator.as_ref();
        let run =
            CentralDifference::start_from(model, operator, &settings, &displacement, velocity);
        Ok((run?, steps))
    }

    /// One period of the transient that starts on `cycle`, after a few others.
    ///
    /// # Errors
    /// [`CycleError::Stepping`] if the transient cannot start.
    pub fn period(&self, cycle: &LimitCycle) -> Result<Period<'_>, CycleError> {
        let (point, operator) = (&cycle.state.point, self.operator.as_ref());
        let (mut run, steps) = self.start(cycle, None)?;
        let time_step = run.plan().time_step;
        let duration = steps as f64 * time_step;
        (0..SETTLING * steps).for_each(|_| run.advance());
        run.take_sums();
        let moving = MovingDofs::of(operator, TAU / duration);
        let (law, fields) = (run.contact(), run.fields());
        let mut period = Period {
            stepping: self,
            coefficients: StepCoefficients::of(&point.damping, time_step),
            friction_coefficient: point.contact.friction_coefficient,
            places: (0..law.status.len()).map(|i| law.places(i)).collect(),
            contact: Vec::with_capacity(steps * law.status.len()),
            start: moving.motion(&fields.displacement, &fields.velocity),
            moving,
            harmonic: self.solver.wave.body.harmonic,
            duration,
            powers: CyclePowers::default(),
            fractions: [0.0; 3],
        };
        for _ in 0..steps {
            interruption::check();
            run.advance();
            let law = run.contact();
            let nodes = law.status.iter().zip(&law.tangential_force);
            period.contact.extend(nodes.map(|(status, force)| match status {
                ContactStatus::Open => PointState::Open,
                ContactStatus::Stick => PointState::Stick,
                ContactStatus::Slip if force.is_sign_negative() => PointState::SlipBackward, // T = -mu N.
                ContactStatus::Slip => PointState::SlipForward,
            }));
        }
        let (contact, material_damping, counts) = run.take_sums();
        period.powers = CyclePowers { contact, material_damping }.scaled(1.0 / steps as f64);
        period.fractions = counts.fractions();
        Ok(period)
    }
}

impl Period<'_> {
    /// Length of a perturbation: twice the moving dofs, sector after sector.
    pub fn dimension(&self) -> usize {
        2 * self.moving.count()
    }

    /// Moving dofs of one sector, those of its contact node first.
    pub fn sector_dofs(&self) -> usize {
        self.moving.count() / self.places.len()
    }

    /// Contact nodes, one for each sector.
    pub fn sectors(&self) -> usize {
        self.places.len()
    }

    /// The direction in which the wave shifts in phase: differences of neighbouring sectors.
    pub fn shift(&self) -> Vec<f64> {
        let (per, count) = (self.sector_dofs(), self.sectors());
        let half = self.moving.count();
        (0..self.dimension())
            .map(|i| {
                let (part, at) = (i / half * half, i % half); // All displacements come before all velocities.
                let (sector, dof) = (at / per, at % per);
                let value = |s: usize| self.start[part + (s % count) * per + dof];
                value(sector + 1) - value(sector + count - 1) // Central difference along the circumference: a multiple of d / dxi.
            })
            .collect()
    }

    /// A perturbation one period later.
    pub fn map(&self, perturbation: &[f64]) -> Vec<f64> {
        let operator = self.stepping.operator.as_ref();
        let mut fields = MotionFields::zeros(operator.field_length());
        self.moving.place(perturbation, &mut fields);
        operator.multiply(&mut fields.displacement, &mut fields.elastic); // q = M^-1 K du.
        operator.multiply(&mut fields.velocity, &mut fields.elastic_rate); // z = M^-1 K dv.
        let mut before = vec![[0.0; 2]; self.places.len()];
        for contact in self.contact.chunks(self.places.len()) {
            self.push(&mut fields, contact, &mut before);
            operator.advance(&mut fields, &self.coefficients);
            self.release(&mut fields, contact, &before);
        }
        self.moving.motion(&fields.displacement, &fields.velocity)
    }

    /// Adds the change of the contact forces to the elastic accelerations of the coming step.
    fn push(&self, fields: &mut MotionFields, contact: &[PointState], before: &mut [[f64; 2]]) {
        let dt = self.coefficients.time_step;
        for (i, &state) in contact.iter().enumerate() {
            let [n, t] = self.places[i];
            let [q_n, q_t] = [fields.elastic[n], fields.elastic[t]];
            before[i] = [q_n, q_t];
            if state == PointState::Open {
                continue;
            }
            let trial = |place: usize| {
                let (v, q) = (fields.velocity[place], fields.elastic[place]);
                self.coefficients.moved(v, q, fields.elastic_rate[place])
            };
            // dN / m so that du_n = 0 after the step.
            let normal = -(fields.displacement[n] + dt * trial(n)) / (dt * dt); // u + dt (v + dt dN / m) = 0.
            let tangential = match state {
                PointState::Stick => -trial(t) / dt, // dT / m so that dv_t = 0 after the step.
                slip => slip.drag() * self.friction_coefficient * normal, // dT = +-mu dN.
            };
            fields.elastic[n] = q_n - normal; // The step subtracts q: forces count negative.
            fields.elastic[t] = q_t - tangential;
        }
    }

    /// Takes them out again after the step.
    fn release(&self, fields: &mut MotionFields, contact: &[PointState], before: &[[f64; 2]]) {
        let dt = self.coefficients.time_step;
        for (i, &state) in contact.iter().enumerate() {
            if state != PointState::Open {
                for (&place, elastic) in self.places[i].iter().zip(before[i]) {
                    fields.elastic[place] = elastic + dt * fields.elastic_rate[place]; // q_{n+1} = q_n + dt q'_{n+1/2}, without dN / m.
                }
            }
        }
    }
}
