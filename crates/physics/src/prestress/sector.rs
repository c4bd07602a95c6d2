//! Steady sliding of a rotationally symmetric annulus, from one sector.

use super::PrestressError;
use super::elimination::Elimination;
use super::full_sliding::{FullSliding, check_pressed};
use super::penalty::PenaltyContact;
use super::pressed_state::{PressedBodies, Pressing};
use crate::contact::{NormalLaw, Point, PressedState, Row, SlidingContact, SteadyFriction};
use crate::fem::{MaterialField, Triplets};
use crate::mesh::SectorMesh;

/// The state of steady sliding of an annulus, the same in every sector.
///
/// It is the state of [`super::Assembly::of_edge`] for the annulus: harmonic zero of the stiffness, whose radial and tangential
/// parts do not mix. Per metre of thickness; vectors hold `(u_r, u_theta)` of each sector node.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorSliding {
    /// Displacement, normal forces and springs of the contact nodes of the sector.
    pub state: PressedState,
    /// The contact nodes of the sector as contact points.
    pub points: Vec<Point>,
}

impl SectorSliding {
    /// Solves the equilibrium of one sector, on contact that stiffens with pressure, if there is a `law`.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open, [`PrestressError::Singular`] for a
    /// stiffness that is not positive definite.
    pub fn solve(
        sector: &SectorMesh,
        material: &dyn MaterialField,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self, PrestressError> {
        Self::of(sector, &sector.strip.stiffness_alike(material), contact, law)
    }

    /// [`Self::solve`] with the stiffness of a sector that moves like all others.
    pub(super) fn of(
        sector: &SectorMesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self, PrestressError> {
        let surface_speed = sector.specification.inner_radius * contact.rotation_speed;
        let friction = contact.steady_friction(contact.sliding_direction(), surface_speed);
        let points = points(sector, friction);
        let (strip, first) = (&sector.strip, sector.contact_nodes().start);
        let pressing = Pressing {
            stiffness,
            load: vec![0.0; strip.dof_count()],
            elimination: Elimination::holding(strip.dof_count(), strip.held_dofs()),
            points: &points,
            contacts: Vec::new(),
            pushed: vec![contact.interference; points.len()],
            stiffnesses: points.iter().map(|own| Some(own.weight * law?.stiffness(0.0))).collect(),
            laws: vec![law; points.len()],
            known: None,
        };
        // Without friction, on which the normal forces do not depend.
        let all = vec![true; points.len()];
        let (separations, springs) = match PenaltyContact::new(&pressing)? {
            Some(mut bodies) => {
                let own = bodies.state_of(0.0, &all)?;
                (own.separations, own.stiffnesses)
            }
            None => (pressing.pushed.clone(), None),
        };
        let full = FullSliding::new(stiffness, pressing.elimination.clone(), &points)?;
        let state = PressedState {
            stiffnesses: springs.into_iter().collect(),
            ..full.state(&pressing.load, &separations)
        };
        let step = 180.0 / strip.count as f64;
        let place = |i: usize| {
            let node = sector.numbering[first + i];
            (node + 1, step * strip.places[node].1 as f64)
        };
        check_pressed(&points, (&state.normal_forces[0], strip.count), place)?;
        Ok(Self { state, points })
    }

    /// The state of the whole annulus: the same in the polar frames of each sector.
    pub fn repeated(&self, sector: &SectorMesh) -> PressedState {
        let (strip, count) = (&sector.strip, sector.strip.count);
        let repeat = |own: &Vec<f64>| strip.spread(own)[..strip.dof_count()].repeat(count);
        let over_nodes = |values: &Vec<f64>| values.repeat(count);
        PressedState {
            displacements: self.state.displacements.iter().map(repeat).collect(),
            normal_forces: self.state.normal_forces.iter().map(over_nodes).collect(),
            stiffnesses: self.state.stiffnesses.iter().map(over_nodes).collect(),
            is_pressed: self.state.is_pressed.repeat(count),
            frozen_below: 0.0,
        }
    }
}

/// The contact nodes of a sector, each against the shaft's at its place or a rigid cylinder.
fn points(sector: &SectorMesh, friction: SteadyFriction) -> Vec<Point> {
    let relative = |node: usize, component: usize| -> Row {
        let opposite = sector.opposite(node).map(|other| (2 * other + component, -1.0));
        [(2 * node + component, 1.0)].into_iter().chain(opposite).collect()
    };
    let nodes = sector.contact_nodes().zip(sector.tributary_lengths());
    nodes
        .map(|(node, &weight)| Point {
            weight,
            normal: relative(node, 0),
            slip: relative(node, 1),
            friction,
            ..Point::default()
        })
        .collect()
}
