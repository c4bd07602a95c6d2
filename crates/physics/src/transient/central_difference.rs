//! The time loop.

mod energy;
mod start;

pub use energy::EnergyAccount;

use super::boundary::BoundaryForces;
use super::contact::Step;
use super::relaxation::Relaxation;
use super::{
    ContactPowers, LagrangeContact, Observer, Perturbation, Sample, SampleRow, StatusCounts,
    StepPlan, TransientError, TransientModel,
};
use crate::contact::ContactInterface;
use crate::fem::operator::{
    AlignedVector, MotionFields, StepCoefficients, StiffnessOperator, gather,
};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Steps between two exact evaluations of `K u`, so that the round-off of its running sum stays where it
/// is. A multiple that depends on nothing but the step number: output and restarts do not move it.
const REFRESH: u64 = 4096;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// At its last sample.
    Finished,
    /// Where its observer stopped it.
    Stopped,
}

/// Everything that a run needs to go on bit by bit, over dofs in nodal frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TransientState {
    /// Number of the next step.
    pub step: u64,
    /// `u_n`, m.
    pub displacement: Vec<f64>,
    /// `v_{n-1/2}`, m/s.
    pub velocity: Vec<f64>,
    /// `M^-1 K u_n` as summed so far, m/s2.
    pub elastic: Vec<f64>,
    /// `M^-1 K v_{n-1/2}`, m/s3.
    pub elastic_rate: Vec<f64>,
    /// Stretches of Maxwell elements after and before the last half step, m; none without.
    pub relaxation: Vec<Vec<f64>>,
    /// Its energy balance so far.
    pub account: EnergyAccount,
}

/// Contact powers, power of material damping and node statuses, summed over steps.
type StepSums = (ContactPowers, f64, StatusCounts);

/// Central differences at half steps with Lagrange multiplier contact.
///
/// ```text
/// M (v_{n+1/2} - v_{n-1/2}) / dt = G^T lambda_n - K u_n - C v_{n-1/2},   u_{n+1} = u_n + dt v_{n+1/2}
/// ```
///
/// (equation (7) of Brunetti et al. with `beta_2 = 1/2`; the damping force is that of the last half step, which keeps the scheme explicit.)
/// `K u` is carried as a running sum of `dt K v`, so that one product with `K v` serves the elastic force, the damping force and both
/// energies. With `E_{n+1/2} = 1/2 v^T M v + 1/2 u_{n+1}^T K u_n` and `v_n` the mean of the two half steps,
///
/// ```text
/// E_{n+1/2} - E_{n-1/2} = dt v_n^T (G^T lambda_n - C v_{n-1/2})
/// ```
///
/// exactly; the balance residual is what round-off leaves of it. The springs of a compliant contact add their energy to
/// `E`. Linear kinematics, no geometric stiffness.
pub struct CentralDifference<'a> {
    model: TransientModel<'a>,
    operator: &'a dyn StiffnessOperator,
    plan: StepPlan,
    /// When the cylinder is fully expanded, s.
    pub(super) expansion_time: f64,
    pub(super) perturbation: Perturbation,
    /// A velocity to come, over all dofs in nodal frames (m/s), and the step before which it is added.
    kick: Option<(u64, Vec<f64>)>,
    coefficients: StepCoefficients,
    fields: MotionFields,
    contact: LagrangeContact,
    boundary: BoundaryForces,
    relaxation: Relaxation,
    interface: ContactInterface,
    next_step: u64,
    account: EnergyAccount,
    sums: StepSums,
    /// Fields before a step that is sampled.
    pub(super) displacement_before: AlignedVector,
    pub(super) velocity_before: AlignedVector,
}

impl<'a> CentralDifference<'a> {
    /// Steps to the last sample, or until the observer stops it.
    ///
    /// # Errors
    /// [`TransientError::Unstable`] says when and where the numbers stopped making sense.
    pub fn run(&mut self, observer: &mut dyn Observer) -> Result<RunEnd, TransientError> {
        let last = self.plan.total_steps();
        while self.next_step < last {
            if let Some((_, velocity)) = self.kick.take_if(|(step, _)| *step == self.next_step) {
                self.kick(&velocity);
            }
            let is_sampled = self.next_step.is_multiple_of(self.plan.steps_per_sample);
            if is_sampled {
                self.displacement_before.copy_from_slice(&self.fields.displacement);
                self.velocity_before.copy_from_slice(&self.fields.velocity);
            }
            self.advance();
            if is_sampled && self.sample(observer)?.is_break() && self.next_step < last {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Finished)
    }

    /// One step, without looking at it.
    pub fn advance(&mut self) {
        let shares = self.shares(self.next_step);
        let (share, step) = (shares[2], Step { coefficients: self.coefficients, shares });
        // Supports, pressures, regions with damping of their own.
        self.boundary.apply(&mut self.fields, share);
        self.relaxation.apply(&mut self.fields);
        // (6): multipliers of this step, which hold the constraints at its end.
        self.contact.apply(&mut self.fields, &step);
        // (7) with beta_2 = 1/2; the power of material damping is (11), with one of its velocities half a step old.
        let damping = self.operator.advance(&mut self.fields, &self.coefficients);
        // (9), (10): powers at the contact.
        let (mut powers, counts) = self.contact.settle(&mut self.fields, &step);
        let (fields, time_step) = (&mut self.fields, self.plan.time_step);
        let relaxed = self.relaxation.settle(fields, time_step);
        let [own_damping, pressure] = self.boundary.settle(fields, time_step, share);
        powers.pressure = pressure;
        let damping = damping + own_damping + relaxed;
        // (12), with the work of the normal forces and of boundary pressures, which the paper leaves out.
        let net = powers.stick + powers.slide + powers.normal + pressure - damping - powers.damping;
        self.account.net_work += self.plan.time_step * net;
        self.sums.0 += powers;
        self.sums.1 += damping;
        self.sums.2 += counts;
        self.next_step += 1;
        // Round-off of the running sum of dt K v goes.
        if self.next_step.is_multiple_of(REFRESH) {
            let fields = &mut self.fields;
            self.operator.multiply(&mut fields.displacement, &mut fields.elastic);
        }
    }

    /// Share of the interference and of the boundary pressures that acts at `time`: a linear ramp.
    pub(super) fn expanded_share(&self, time: f64) -> f64 {
        if time.max(0.0) < self.expansion_time { time.max(0.0) / self.expansion_time } else { 1.0 }
    }

    /// These shares one step before `step`, at it and one step after.
    fn shares(&self, step: u64) -> [f64; 3] {
        let dt = self.plan.time_step;
        let at = |step: f64| self.expanded_share(step * dt);
        [at(step as f64 - 1.0), at(step as f64), at((step + 1) as f64)]
    }

    fn sample(&mut self, observer: &mut dyn Observer) -> Result<ControlFlow<()>, TransientError> {
        let [kinetic_energy, strain_energy] = self.energies();
        let contact_energy = self.contact_energy();
        let energy = kinetic_energy + strain_energy + contact_energy;
        self.account.largest = self.account.largest.max(energy);
        let imbalance = (energy - self.account.initial - self.account.net_work).abs();
        // A body at rest has no energy to be relative to.
        let balance_residual =
            if imbalance == 0.0 { 0.0 } else { imbalance / self.account.largest };
        self.check(energy, balance_residual)?;
        self.account.largest_residual = self.account.largest_residual.max(balance_residual);
        let step = self.next_step - 1;
        let steps = if step == 0 { 1 } else { self.plan.steps_per_sample };
        let index = step / self.plan.steps_per_sample;
        let (powers, damping, counts) = self.take_sums();
        let unconverged_steps = std::mem::take(&mut self.contact.unconverged_steps);
        let sample = Sample {
            index,
            row: SampleRow {
                time: self.plan.sample_time(index),
                kinetic_energy,
                strain_energy,
                contact_energy,
                powers: powers.scaled(1.0 / steps as f64),
                material_damping: damping / steps as f64,
                counts,
                balance_residual,
                ..SampleRow::default()
            },
            unconverged_steps,
            run: self,
        };
        Ok(observer.observe(&sample))
    }

    /// Contact powers, power of material damping and node statuses, summed over the steps since the last sample or the last call of this.
    pub fn take_sums(&mut self) -> (ContactPowers, f64, StatusCounts) {
        std::mem::take(&mut self.sums)
    }

    /// The complete state; exact for a restart when taken at a sample.
    pub fn state(&self) -> TransientState {
        let dofs = |field: &[f64]| gather(self.operator, field);
        TransientState {
            step: self.next_step,
            displacement: dofs(&self.fields.displacement),
            velocity: dofs(&self.fields.velocity),
            elastic: dofs(&self.fields.elastic),
            elastic_rate: dofs(&self.fields.elastic_rate),
            relaxation: self.relaxation.state(),
            account: self.account,
        }
    }

    /// The body and its contact.
    pub fn model(&self) -> &TransientModel<'a> {
        &self.model
    }

    /// The stiffness operator.
    pub fn operator(&self) -> &dyn StiffnessOperator {
        self.operator
    }

    /// Time step and samples.
    pub fn plan(&self) -> &StepPlan {
        &self.plan
    }

    /// Displacement, velocity and accelerations after the last step.
    pub fn fields(&self) -> &MotionFields {
        &self.fields
    }

    /// Multipliers and status of the last step.
    pub fn contact(&self) -> &LagrangeContact {
        &self.contact
    }

    /// The contact edge.
    pub fn interface(&self) -> &ContactInterface {
        &self.interface
    }

    /// Steps done.
    pub fn steps_done(&self) -> u64 {
        self.next_step
    }
}
