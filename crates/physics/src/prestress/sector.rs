//! Steady sliding whose normal forces do not depend on friction, as of a rotationally symmetric body: of an annulus, from one sector.

use super::contact_system::ContactSystem;
use super::elimination::Elimination;
use super::pressed_state::{PressedBodies, Pressing};
use super::{PrestressError, Result};
use crate::contact::{ContactInterface, NormalLaw, Point, PressedState, SlidingContact};
use crate::fem::Triplets;
use crate::linalg::dense::difference;
use crate::mesh::Strip;

/// The state of steady sliding of a body of equal sectors, the same in each.
///
/// It is the state of [`super::Assembly::of_edge`] for the annulus: harmonic zero of the stiffness, whose radial and tangential
/// parts do not mix. Per metre of thickness in the plane; vectors are over the dofs of the sector.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorSliding {
    /// Displacement, normal forces and springs of the contact nodes of the sector.
    pub state: PressedState,
    /// The contact nodes of the sector as contact points.
    pub points: Vec<Point>,
}

impl SectorSliding {
    /// Solves the equilibrium of one sector of an annulus with its [`Strip::stiffness_alike`], on contact that stiffens with
    /// pressure, if there is a `law`.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open, [`PrestressError::Singular`] for a stiffness that is not positive definite.
    pub fn solve(
        strip: &Strip,
        stiffness: &Triplets,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self> {
        let edge = ContactInterface::of_sector(strip);
        let points = edge.points(contact);
        let pressing = Pressing {
            stiffness,
            load: vec![0.0; strip.dof_count()],
            elimination: Elimination::holding(strip.dof_count(), strip.held_dofs()),
            points: &points,
            contacts: Vec::new(),
            pushed: vec![contact.interference; points.len()],
            stiffnesses: points.iter().map(|own| Some(own.weight * law?.stiffness(0.0))).collect(), // w k(0); none of rigid contact.
            laws: vec![law; points.len()],
            known: None,
        };
        Ok(Self { state: pressing.pressed_all_round(&edge, strip.count)?, points })
    }

    /// The state of the whole body of `count` sectors: the same in the polar frames of each.
    pub fn repeated(&self, count: usize) -> PressedState {
        let points: Vec<usize> = (0..self.points.len()).collect();
        self.state.repeated(count, &points.repeat(count))
    }
}

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
