//! Steady sliding of a body whose contact is pressed all around: its normal forces do not depend on friction.

use super::contact_system::ContactSystem;
use super::elimination::{Elimination, factorized};
use super::pressed_state::{PressedBodies, Pressing};
use super::{PrestressError, Result};
use crate::contact::{ContactInterface, Point, PressedState};
use crate::fem::{DofMap, Triplets};
use crate::linalg::SparseLu;
use crate::linalg::dense::{add, difference};

/// A body with the separations of its contact points prescribed.
pub(super) struct FullSliding<'a> {
    points: &'a [Point],
    /// Separations in place of normal displacements.
    basis: Elimination,
    separations: Vec<usize>,
    /// Stiffness over separations and the other dofs.
    stiffness: Triplets,
    unknowns: DofMap,
    solver: SparseLu,
}

impl<'a> FullSliding<'a> {
    /// Of a stiffness over all dofs, supports included, without those that `basis` holds.
    ///
    /// # Errors
    /// [`PrestressError::Asked`] for points that are held; [`PrestressError::Singular`] for a stiffness that is not positive definite.
    pub fn new(stiffness: &Triplets, mut basis: Elimination, points: &'a [Point]) -> Result<Self> {
        let separations = points.iter().map(|point| basis.require(&point.normal));
        let separations = separations.collect::<Result<Vec<usize>>>()?;
        let stiffness = basis.congruent(stiffness).into_owned();
        separations.iter().for_each(|&dof| basis.drop_unknown(dof)); // Prescribed, no unknowns.
        let unknowns = basis.unknowns();
        let solver = factorized(&stiffness, &unknowns)?;
        Ok(Self { points, basis, separations, stiffness, unknowns, solver })
    }

    /// The state under a load on all dofs in which the points have these separations, `u(mu) = u_0 + mu u_1`.
    pub fn state(&self, load: &[f64], separations: &[f64]) -> PressedState {
        let load = self.basis.transposed_forces(load);
        let pressed = self.refined(&load, self.pressed_by(separations, &load));
        let normal_forces = self.normal_forces(&pressed, &load);

        let sheared = self.sheared(self.points, &normal_forces); // u_1: that of unit friction.
        PressedState {
            displacements: vec![self.basis.displacement(&pressed), sheared],
            is_pressed: vec![true; normal_forces.len()],
            normal_forces: vec![normal_forces],
            ..PressedState::default()
        }
    }

    /// What the friction of normal forces on some points does for each unit of its coefficient, over all dofs.
    pub fn sheared(&self, points: &[Point], normal_forces: &[f64]) -> Vec<f64> {
        let mut traction = vec![0.0; self.unknowns.unknown_of.len()];
        for (point, force) in points.iter().zip(normal_forces) {
            for &(dof, along) in &point.slip {
                traction[dof] += point.friction.drag * along * force; // f_1 = sum_i N_i drag_i t_i.
            }
        }
        let traction = self.basis.transposed_forces(&traction);
        self.basis.displacement(&self.refined(&traction, self.solve(&traction)))
    }

    /// Response to a load with the separations held.
    pub fn solve(&self, load: &[f64]) -> Vec<f64> {
        self.unknowns.expand(&self.solver.solve(self.unknowns.restrict(load)))
    }

    /// A response to a load with the load that round-off left solved for, too: slender bodies multiply it.
    pub fn refined(&self, load: &[f64], mut first: Vec<f64>) -> Vec<f64> {
        let more = self.solve(&self.stiffness.residual(load, &first)); // K^-1 (f - K u).
        add(&mut first, 1.0, &more);
        first
    }

    /// Response to a load with these separations.
    fn pressed_by(&self, distances: &[f64], load: &[f64]) -> Vec<f64> {
        let total = load.len();
        let mut prescribed = vec![0.0; total];
        let both = || self.separations.iter().zip(distances);
        both().for_each(|(&dof, distance)| prescribed[dof] = *distance);
        let force = self.stiffness.multiply(total, &prescribed); // K_ff u_f = f_f - K_fc c.
        let mut pressed = self.solve(&difference(load, &force));
        both().for_each(|(&dof, distance)| pressed[dof] = *distance);
        pressed
    }

    /// What holds the separations beside the load.
    fn normal_forces(&self, pressed: &[f64], load: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(pressed.len(), pressed); // N = K_c u - f_c.
        self.separations.iter().map(|&dof| force[dof] - load[dof]).collect()
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
        // Without friction, on which the normal forces do not depend.
        let all = vec![true; self.points.len()];
        let (separations, springs) = match self.stiffnesses.contains(&None) {
            true => (self.pushed.clone(), None),
            false => {
                let own = ContactSystem::new(self)?.state_of(0.0, &all)?;
                (own.separations, own.stiffnesses)
            }
        };
        let full = FullSliding::new(self.stiffness, self.elimination.clone(), self.points)?;
        let state = full.state(&self.load, &separations);
        let forces = &state.normal_forces[0];
        let is_open = |i: &usize| !(forces[*i] > 0.0);
        match (0..forces.len()).find(is_open) {
            None => Ok(PressedState { stiffnesses: springs.into_iter().collect(), ..state }),
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
