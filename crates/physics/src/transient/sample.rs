//! State of the time loop as an observer sees it.

use super::{CentralDifference, LagrangeContact, SampleRow, TransientState};
use std::ops::ControlFlow;

/// The state around one sampled step `n`, for each metre of thickness.
pub struct Sample<'a> {
    /// Index of the sample, 0 at time zero.
    pub index: u64,
    /// Its time, energies, powers and statuses; who keeps it adds the harmonics.
    pub row: SampleRow,
    /// Steps since the last sample in which the forces between two bodies had not converged.
    pub unconverged_steps: u64,
    pub(super) run: &'a CentralDifference<'a>,
}

/// Gets the samples of a run.
pub trait Observer {
    /// Looks at one sample; `Break` stops the run after it.
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()>;
}

impl Sample<'_> {
    /// `u_n` at a dof, m.
    pub fn displacement_at(&self, dof: usize) -> f64 {
        self.run.displacement_before[self.run.operator().position(dof)]
    }

    /// `v_n = (v_{n+1/2} + v_{n-1/2}) / 2` at a dof, m/s.
    pub fn velocity_at(&self, dof: usize) -> f64 {
        let place = self.run.operator().position(dof);
        0.5 * (self.run.velocity_before[place] + self.run.fields().velocity[place])
    }

    /// `a_n = (v_{n+1/2} - v_{n-1/2}) / dt` at a dof, m/s2.
    pub fn acceleration_at(&self, dof: usize) -> f64 {
        let place = self.run.operator().position(dof);
        let change = self.run.fields().velocity[place] - self.run.velocity_before[place];
        change / self.run.plan().time_step
    }

    /// `u_n` over all dofs, m.
    pub fn displacement(&self) -> Vec<f64> {
        (0..self.run.operator().dof_count()).map(|dof| self.displacement_at(dof)).collect()
    }

    /// `v_n` over all dofs, m/s.
    pub fn velocity(&self) -> Vec<f64> {
        (0..self.run.operator().dof_count()).map(|dof| self.velocity_at(dof)).collect()
    }

    /// Tangential displacement of contact node `i`, m.
    pub fn contact_tangential_displacement(&self, i: usize) -> f64 {
        self.run.contact().slip(i, &self.run.displacement_before)
    }

    /// Distance of contact node `i` from the counterface at `n`, m; negative where a compliant contact is compressed.
    pub fn gap(&self, i: usize) -> f64 {
        let share = self.run.expanded_share(self.row.time);
        self.run.contact().gap(i, &self.run.displacement_before, share)
    }

    /// Forces on the contact nodes and their status at `n`.
    pub fn contact(&self) -> &LagrangeContact {
        self.run.contact()
    }

    /// The complete state after this sample, from which a run goes on bit by bit.
    pub fn state(&self) -> TransientState {
        self.run.state()
    }
}
