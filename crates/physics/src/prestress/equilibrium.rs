//! Static equilibrium in steady sliding.

use super::PrestressError;
use super::SectorSliding;
use super::complementarity::PressedRange;
use super::elimination::Elimination;
use super::full_sliding::{self, FullSliding};
use super::pressed_state::Pressing;
use crate::contact::{
    ContactInterface, NormalLaw, Point, PressedState, SlidingContact, SteadyFriction,
};
use crate::fem::{Triplets, assemble_supports};
use crate::mesh::{AnnulusMesh, Mesh, SectorMesh};
use std::ops::Deref;

/// The state of steady sliding: counterface pushed in by `delta`, every pressed contact node slipping.
///
/// The state obeys `u_n = delta - g_i`, `T_i = s mu(V) N_i` at pressed contact nodes, `N_i = T_i = 0` at open ones, the
/// boundary conditions and `K u = f` elsewhere. Under one set of pressed nodes it is a smooth function of `mu`, kept
/// as a polynomial. On the annulus all nodes are pressed and `u(mu) = u_0 + mu u_1` exactly, since the normal forces
/// do not depend on `mu`. The contact is rigid here whatever constant stiffness the eigenvalue analysis gives it. Contact that
/// stiffens with pressure carries the state instead, `N_i = w_i p(delta - g_i - u_n)`.
///
/// Per metre of thickness; vectors over all dofs in nodal frames.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySliding {
    /// Displacement, normal forces and springs of the contact nodes.
    pub state: PressedState,
    /// Friction at the sliding speed for each unit of friction coefficient and normal force; its drag has the sense of sliding.
    pub friction: SteadyFriction,
    /// The contact edge.
    pub interface: ContactInterface,
    /// Its nodes as contact points.
    pub points: Vec<Point>,
}

impl Deref for SteadySliding {
    type Target = PressedState;

    fn deref(&self) -> &PressedState {
        &self.state
    }
}

impl SteadySliding {
    /// Solves the equilibrium of `mesh` at the friction coefficient of `contact`; `stiffness` is that of the body (all
    /// dofs, from [`crate::fem::assemble_stiffness`]), to which supports are added. Contact stiffens with pressure, if there is a
    /// `law`.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node of an annulus would open; see there for the rest.
    pub fn solve(
        mesh: &Mesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self, PrestressError> {
        let own = [contact.friction_coefficient];
        let range = Self::range(mesh, stiffness, contact, law, &own)?;
        let state = range.states.into_iter().next_back().expect("one state for each set");
        Ok(Self::of(mesh, contact, state))
    }

    /// One of the states of [`Self::range`] with its contact edge.
    pub fn of(mesh: &Mesh, contact: &SlidingContact, state: PressedState) -> Self {
        let interface = ContactInterface::of(mesh);
        Self {
            state,
            friction: interface.steady_friction(contact),
            points: interface.points(contact),
            interface,
        }
    }

    /// The state of a whole annulus from that of its sector: the same in the polar frames of each.
    pub fn from_sector(
        annulus: &AnnulusMesh,
        sector: &SectorMesh,
        state: &SectorSliding,
        contact: &SlidingContact,
    ) -> Self {
        let per_sector = annulus.sector_node_count();
        let repeat = |free: &[f64]| {
            let mut values = vec![0.0; 2 * annulus.mesh.node_count()];
            for (sector_node, pair) in free.chunks_exact(2).enumerate() {
                let position = sector.numbering[sector_node];
                for start in (0..annulus.sector_count()).map(|j| j * per_sector) {
                    values[2 * (start + position)..][..2].copy_from_slice(pair);
                }
            }
            values
        };
        let state = &state.state;
        let count = sector.sector_count();
        let over_nodes = |values: &Vec<f64>| values.repeat(count);
        let state = PressedState {
            displacements: state.displacements.iter().map(|free| repeat(free)).collect(),
            normal_forces: state.normal_forces.iter().map(over_nodes).collect(),
            stiffnesses: state.stiffnesses.iter().map(over_nodes).collect(),
            is_pressed: vec![true; count * sector.contact_count],
            frozen_below: 0.0,
        };
        Self::of(&annulus.mesh, contact, state)
    }

    /// Contact pressure at each contact node `p_i = N_i / w_i`, Pa.
    pub fn pressures(&self, friction_coefficient: f64) -> Vec<f64> {
        let forces = self.normal_forces(friction_coefficient);
        let pairs = forces.iter().zip(&self.interface.tributary_lengths);
        pairs.map(|(force, length)| force / length).collect()
    }

    /// What friction asks of the counterface's drive for each metre of thickness: the torque `s mu(V) a sum N_i` of a
    /// cylinder, N; the force of a plane, N/m.
    pub fn torque(&self, friction_coefficient: f64) -> f64 {
        let normal: f64 = self.normal_forces(friction_coefficient).iter().sum();
        let lever = self.interface.counterface.lever();
        self.friction.drag * friction_coefficient * lever * normal
    }

    /// States at every one of `friction_coefficients`; of a contact that stiffens with pressure, if there is a `law`, on the springs of
    /// its tangents.
    ///
    /// # Errors
    /// As [`Self::solve`]; the first friction coefficient without a state.
    pub fn range(
        mesh: &Mesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
        friction_coefficients: &[f64],
    ) -> Result<PressedRange, PrestressError> {
        let mut supported = stiffness.clone();
        let [springs, _] = assemble_supports(mesh);
        supported.entries.extend(springs.entries);
        let interface = ContactInterface::of(mesh);
        let points = interface.points(contact);
        let total = mesh.dof_count();
        let elimination = Elimination::holding(total, mesh.held_dofs());
        if mesh.is_cyclic && law.is_none() {
            // Full sliding on the annulus, whose normal forces do not depend on friction.
            let full = FullSliding::new(&supported, elimination, &points)?;
            let state = full.state(&vec![0.0; total], contact.interference, None)?;
            check_pressed(&interface, &points, &state.normal_forces[0])?;
            return Ok(PressedRange::of_one(state, friction_coefficients.len()));
        }
        let pressing = Pressing {
            stiffness: &supported,
            load: mesh.pressure_forces().unwrap_or_else(|| vec![0.0; total]),
            elimination,
            contacts: Vec::new(),
            pushed: points.iter().map(|point| contact.interference - point.gap).collect(),
            stiffnesses: points
                .iter()
                .map(|point| law.map(|law| law.stiffness(0.0) * point.weight))
                .collect(),
            laws: vec![law; points.len()],
            points: &points,
        };
        let found = pressing.states(mesh, friction_coefficients)?;
        if let Some(state) = found.states.iter().find(|_| mesh.is_cyclic) {
            check_pressed(&interface, &points, &state.normal_forces(friction_coefficients[0]))?;
        }
        Ok(found)
    }
}

fn check_pressed(
    interface: &ContactInterface,
    points: &[Point],
    forces: &[f64],
) -> Result<(), PrestressError> {
    let place = |i: usize| (interface.nodes[i] as usize + 1, interface.angles[i].to_degrees());
    full_sliding::check_pressed(points, (forces, 1), place)
}
