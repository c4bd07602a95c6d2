//! Steady sliding of a body whose contact is pressed all around: its normal forces do not depend on friction.

use super::contact_system::ContactSystem;
use super::pressed_state::{PressedBodies, Pressing};
use super::{PrestressError, Result};
use crate::contact::{ContactInterface, PressedState};
use crate::linalg::dense::difference;

impl ContactSystem<'_> {
    /// The state of pressed points whose forces friction does not alter: `u(mu) = u_0 + mu u_1`.
    pub(super) fn unaltered_state(&mut self, is_pressed: Vec<bool>) -> Result<PressedState> {
        let state = self.state_of(0.0, &is_pressed)?;
        let [pressed, sheared] = [0.0, 1.0].map(|mu| self.whole_displacement(mu, &state));
        let sheared = difference(&sheared, &pressed);
        Ok(PressedState {
            displacements: vec![pressed, sheared],
            normal_forces: vec![state.normal_forces],
            stiffnesses: state.stiffnesses.into_iter().collect(),
            is_pressed,
            ..PressedState::default()
        })
    }
}

impl Pressing<'_> {
    /// The state of the contact `edge` of an annulus, or of one of its equal `sectors`, all of whose nodes must be pressed: then
    /// `u(mu) = u_0 + mu u_1` exactly.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open, [`PrestressError::Singular`].
    pub(super) fn pressed_all_round(
        &self,
        edge: &ContactInterface,
        sectors: usize,
    ) -> Result<PressedState> {
        let all = vec![true; self.points.len()];
        let state = ContactSystem::new(self)?.unaltered_state(all)?;
        let forces = &state.normal_forces[0];
        let is_open = |i: &usize| !(forces[*i] > 0.0);
        match (0..forces.len()).find(is_open) {
            None => Ok(state),
            Some(first) => Err(PrestressError::Separation {
                count: (0..forces.len()).filter(is_open).count() * sectors,
                total: forces.len() * sectors,
                node: edge.nodes[first] as usize + 1,
                angle_degrees: edge.angles[first].to_degrees(),
                pressure: forces[first] / self.points[first].weight,
            }),
        }
    }
}
