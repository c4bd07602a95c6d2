//! State of the time loop as an observer sees it.

use super::{CentralDifference, ContactPowers, StatusCounts, TransientState};
use crate::contact::ContactStatus;
use std::ops::ControlFlow;

/// The state around one sampled step `n`, for each metre of thickness.
pub struct Sample<'a> {
    /// Index of the sample, 0 at time zero.
    pub index: u64,
    /// `t_n`, s.
    pub time: f64,
    /// Kinetic energy `1/2 v^T M v` at `n + 1/2`, J/m.
    pub kinetic_energy: f64,
    /// Strain energy `1/2 u_{n+1}^T K u_n`, J/m.
    pub strain_energy: f64,
    /// Energy of the springs of a compliant contact at `n + 1/2`, J/m.
    pub contact_energy: f64,
    /// Contact powers, means over the steps since the last sample, W/m.
    pub powers: ContactPowers,
    /// Power of material damping `v_n^T C v_{n-1/2}`, mean over the steps since the last sample, W/m.
    pub material_damping: f64,
    /// Node statuses counted over the steps since the last sample.
    pub counts: StatusCounts,
    /// Steps since the last sample in which the forces between two bodies had not converged.
    pub unconverged_steps: u64,
    /// `|E_{n+1/2} - E_{-1/2} - work|` relative to the largest energy so far.
    pub balance_residual: f64,
    pub(super) run: &'a CentralDifference<'a>,
    pub(super) displacement_before: &'a [f64],
    pub(super) velocity_before: &'a [f64],
}

/// Gets the samples of a run.
pub trait Observer {
    /// Looks at one sample; `Break` stops the run after it.
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()>;
}

impl Sample<'_> {
    /// `u_n` at a dof, m.
    pub fn displacement_at(&self, dof: usize) -> f64 {
        self.displacement_before[self.run.operator().position(dof)]
    }

    /// `v_n = (v_{n+1/2} + v_{n-1/2}) / 2` at a dof, m/s.
    pub fn velocity_at(&self, dof: usize) -> f64 {
        let place = self.run.operator().position(dof);
        0.5 * (self.velocity_before[place] + self.run.fields().velocity[place])
    }

    /// `a_n = (v_{n+1/2} - v_{n-1/2}) / dt` at a dof, m/s2.
    pub fn acceleration_at(&self, dof: usize) -> f64 {
        let place = self.run.operator().position(dof);
        let change = self.run.fields().velocity[place] - self.velocity_before[place];
        change / self.run.plan().time_step
    }

    /// `u_n` over all dofs, m.
    pub fn displacement(&self) -> Vec<f64> {
        let dofs = 0..self.run.operator().dof_count();
        dofs.map(|dof| self.displacement_at(dof)).collect()
    }

    /// `v_n` over all dofs, m/s.
    pub fn velocity(&self) -> Vec<f64> {
        let dofs = 0..self.run.operator().dof_count();
        dofs.map(|dof| self.velocity_at(dof)).collect()
    }

    /// Tangential displacement of contact node `i`, m.
    pub fn contact_tangential_displacement(&self, i: usize) -> f64 {
        self.run.contact().slip(i, self.displacement_before)
    }

    /// Distance of contact node `i` from the counterface at `n`, m; negative where a compliant contact is compressed.
    pub fn gap(&self, i: usize) -> f64 {
        let share = self.run.expanded_share(self.time);
        let contact = self.run.contact();
        contact.gap(i, self.displacement_before, share)
    }

    /// Status of each contact node at `n`.
    pub fn status(&self) -> &[ContactStatus] {
        &self.run.contact().status
    }

    /// Normal force on each contact node at `n`, N/m.
    pub fn normal_force(&self) -> &[f64] {
        &self.run.contact().normal_force
    }

    /// Tangential force on each contact node at `n`, N/m.
    pub fn tangential_force(&self) -> &[f64] {
        &self.run.contact().tangential_force
    }

    /// Friction across the sliding on each contact node at `n`, N; empty for a plane body.
    pub fn across_force(&self) -> &[f64] {
        &self.run.contact().across_force
    }

    /// The complete state after this sample, from which a run goes on bit by bit.
    pub fn state(&self) -> TransientState {
        self.run.state()
    }
}
