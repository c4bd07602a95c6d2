//! Steady sliding of a rotationally symmetric annulus, from one sector.

use super::PrestressError;
use super::elimination::Elimination;
use super::pressed_state::Pressing;
use crate::contact::{ContactInterface, NormalLaw, Point, PressedState, SlidingContact};
use crate::fem::Triplets;
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
    ) -> Result<Self, PrestressError> {
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
