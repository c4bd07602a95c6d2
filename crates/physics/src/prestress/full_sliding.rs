//! Steady sliding of a body of revolution whose contact is pressed all around: its normal forces do not depend on friction.

use super::PrestressError;
use super::cholesky::CholeskySolver;
use super::elimination::Elimination;
use crate::contact::{NormalLaw, Point, PressedState};
use crate::fem::{DofMap, Triplets};
use nalgebra::{DMatrix, DVector};

/// Newton steps to the approach of contact that stiffens, at most; its force is a concave function of the approach's.
const MOST_TANGENTS: usize = 100;

/// A body with the separations of its contact points prescribed.
pub(super) struct FullSliding<'a> {
    points: &'a [Point],
    /// Separations in place of normal displacements.
    basis: Elimination,
    separations: Vec<usize>,
    /// Stiffness over separations and the other dofs.
    stiffness: Triplets,
    unknowns: DofMap,
    solver: CholeskySolver,
}

impl<'a> FullSliding<'a> {
    /// Of a stiffness over all dofs, supports included, without those that `basis` holds.
    ///
    /// # Errors
    /// [`PrestressError::Overconstrained`]; [`PrestressError::Singular`] for a stiffness that is not positive definite.
    pub fn new(
        stiffness: &Triplets,
        mut basis: Elimination,
        points: &'a [Point],
    ) -> Result<Self, PrestressError> {
        let separations = points.iter().map(|point| basis.require(&point.normal, "contact"));
        let separations = separations.collect::<Result<Vec<usize>, PrestressError>>()?;
        let stiffness = basis.congruent(stiffness);
        separations.iter().for_each(|&dof| basis.drop_unknown(dof));
        let unknowns = basis.unknowns();
        let solver = CholeskySolver::new(&stiffness, &unknowns)?;
        Ok(Self { points, basis, separations, stiffness, unknowns, solver })
    }

    /// The state under a load on all dofs in which every point is pushed in by `interference`, `u(mu) = u_0 + mu u_1`; without a
    /// load with a contact that stiffens with pressure, if there is a `law`: `N_i = w_i p(delta - u_n)`.
    ///
    /// # Errors
    /// [`PrestressError::Singular`].
    pub fn state(
        &self,
        load: &[f64],
        interference: f64,
        law: Option<NormalLaw>,
    ) -> Result<PressedState, PrestressError> {
        let approaches = match law {
            Some(law) => self.approaches(interference, law)?,
            None => vec![0.0; self.points.len()],
        };
        let distances: Vec<f64> = approaches.iter().map(|g| interference - g).collect();
        let load = self.basis.transposed_forces(load);
        let pressed = self.refined(&load, self.pressed_by(&distances, &load));
        let normal_forces = self.normal_forces(&pressed, &load);

        // Friction shears it.
        let mut traction = vec![0.0; pressed.len()];
        for (point, force) in self.points.iter().zip(&normal_forces) {
            for &(dof, along) in &point.slip {
                traction[dof] += point.friction.drag * along * force;
            }
        }
        let traction = self.basis.transposed_forces(&traction);
        let sheared = self.refined(&traction, self.solve(&traction));
        let springs = law.map(|law| {
            let pairs = approaches.iter().zip(self.points);
            pairs.map(|(&g, point)| point.weight * law.stiffness(g)).collect()
        });
        Ok(PressedState {
            displacements: [&pressed, &sheared].map(|y| self.basis.displacement(y)).into(),
            stiffnesses: springs.into_iter().collect(),
            is_pressed: vec![true; normal_forces.len()],
            frozen_below: 0.0,
            normal_forces: vec![normal_forces],
        })
    }

    /// Response to a load with the separations held.
    pub fn solve(&self, load: &[f64]) -> Vec<f64> {
        self.unknowns.expand(&self.solver.solve(self.unknowns.restrict(load)))
    }

    /// A response to a load with the load that round-off left solved for, too: slender bodies multiply it.
    pub fn refined(&self, load: &[f64], first: Vec<f64>) -> Vec<f64> {
        let more = self.solve(&self.stiffness.residual(load, &first));
        first.iter().zip(more).map(|(first, more)| first + more).collect()
    }

    /// Response to a load with these separations.
    fn pressed_by(&self, distances: &[f64], load: &[f64]) -> Vec<f64> {
        let total = load.len();
        let mut prescribed = vec![0.0; total];
        let both = || self.separations.iter().zip(distances);
        both().for_each(|(&dof, distance)| prescribed[dof] = *distance);
        let force = self.stiffness.multiply(total, &prescribed);
        let left: Vec<f64> = load.iter().zip(force).map(|(load, force)| load - force).collect();
        let mut pressed = self.solve(&left);
        both().for_each(|(&dof, distance)| pressed[dof] = *distance);
        pressed
    }

    /// What holds the separations beside the load.
    fn normal_forces(&self, pressed: &[f64], load: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(pressed.len(), pressed);
        self.separations.iter().map(|&dof| force[dof] - load[dof]).collect()
    }

    /// Normal forces of unit distances, column by column.
    fn responses(&self) -> DMatrix<f64> {
        let count = self.points.len();
        let none = vec![0.0; self.unknowns.unknown_of.len()];
        let columns = (0..count).map(|j| {
            let mut unit = vec![0.0; count];
            unit[j] = 1.0;
            DVector::from_vec(self.normal_forces(&self.pressed_by(&unit, &none), &none))
        });
        DMatrix::from_columns(&columns.collect::<Vec<_>>())
    }

    /// What springs of a law give way by under the interference: Newton's method in the forces, of which the approach is a
    /// concave function,
    ///
    /// ```text
    /// (1 + S / k) N = S (delta - g + N_0 / k),   N_0 = w p(g) the forces found last, k = w dp/dg
    /// ```
    fn approaches(&self, interference: f64, law: NormalLaw) -> Result<Vec<f64>, PrestressError> {
        let lengths: Vec<f64> = self.points.iter().map(|point| point.weight).collect();
        let response = self.responses();
        let count = lengths.len();
        let mut forces = DVector::zeros(count);
        for _ in 0..MOST_TANGENTS {
            let approach = |i: usize| law.approach(f64::max(forces[i], 0.0) / lengths[i]);
            let softness = |i: usize| 1.0 / (lengths[i] * law.stiffness(approach(i)));
            let pushed = DVector::from_fn(count, |i, _| {
                interference - approach(i) + f64::max(forces[i], 0.0) * softness(i)
            });
            let mut matrix = DMatrix::from_fn(count, count, |i, j| response[(i, j)] * softness(j));
            (0..count).for_each(|i| matrix[(i, i)] += 1.0);
            let found = matrix.lu().solve(&(&response * pushed)).ok_or(PrestressError::Singular)?;
            let moved = (&found - &forces).amax();
            forces = found;
            if moved <= 4.0 * f64::EPSILON * forces.amax() {
                break;
            }
        }
        Ok(forces.iter().zip(&lengths).map(|(force, w)| law.approach(force.max(0.0) / w)).collect())
    }
}

/// Refuses a ring of `copies` sectors of which a point is not pressed; `place` is number and angle of its node, degrees.
pub(super) fn check_pressed(
    points: &[Point],
    (forces, copies): (&[f64], usize),
    place: impl Fn(usize) -> (usize, f64),
) -> Result<(), PrestressError> {
    let open: Vec<usize> = (0..forces.len()).filter(|i: &usize| !(forces[*i] > 0.0)).collect();
    let Some(&first) = open.first() else {
        return Ok(());
    };
    let (node, angle_degrees) = place(first);
    Err(PrestressError::Separation {
        count: open.len() * copies,
        total: forces.len() * copies,
        node,
        angle_degrees,
        pressure: forces[first] / points[first].weight,
    })
}
