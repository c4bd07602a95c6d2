//! Forward increment Lagrange multipliers of the contact points.

mod law;
mod nodes;
mod powers;
mod set_up;
mod single;
mod sums;
mod sweeps;

pub(super) use set_up::ContactPart;
pub use sums::{ContactPowers, StatusCounts};

use super::compliance::Spring;
use crate::contact::{ContactStatus, CoulombFriction};
use crate::fem::operator::{MotionFields, StepCoefficients};
use law::FreePoint;
use std::ops::Range;

/// Contact of points, each with what it meets.
///
/// A point has a row of the separation and one or two rows of the slip over the dofs. The forces at `n` enforce the constraints at `n + 1`
/// (equation (6) of Brunetti et al.). A trial step without contact gives `u*`, `v*` along the rows; then with penetration
/// `g = delta - g_0 - u_n* > 0`, `g_0` the gap of the undeformed point, and the mass `m` that a force along a row moves,
///
/// ```text
/// N = m g / dt^2,   T* = m (V - v_t*) / dt,   T = min(max(T*, -mu N), mu N),
/// ```
///
/// stick where `|T*| <= mu N` (so that `v_t = V`, `Omega a` on a shaft, at `n + 1/2`), slip elsewhere; without penetration the point is
/// open and both vanish. With two rows of slip `T` is a vector, projected on the disc of Coulomb's law. Linear kinematics: the normal does
/// not turn with the point. Friction that falls with the slip speed is implicit in it, point by point: [`CoulombFriction::resolve`]. A
/// contact with a stiffness has `N` from its spring instead; a tangential dashpot adds `- c_t w v_t` while the point is in contact.
///
/// Rows of an edge or a face on a rigid counterface are single dofs, which no other row has: each point stands alone and the
/// multipliers are in closed form. Rows between bodies share dofs, and the points are solved one after the other until no
/// force changes: Gauss-Seidel over the mobilities `J M^-1 J^T`, from no forces, so that a step depends on nothing but the
/// fields. Velocities in the powers are those along the rows, of one body over the other.
#[derive(Clone, Debug, Default)]
pub struct LagrangeContact {
    /// Rows of slip of each point: 1 in the plane, 2 in space.
    tangents: usize,
    /// Whether every row is one dof, in the order of the rows, and every node one point.
    is_single: bool,
    /// Whether two rows have a dof in common.
    is_coupled: bool,
    /// The dofs that rows touch, in the order in which they come.
    dofs: Vec<TouchedDof>,
    /// Where each row ends, point by point: separation, slip along the sliding, slip across it.
    ends: Vec<usize>,
    /// Dof and entry of all rows, one after the other.
    entries: Vec<(u32, f64)>,
    points: Vec<ContactPoint>,
    surfaces: Vec<TouchingSurfaces>,
    /// Points of each node that the record shows, with the share that it has in each.
    nodes: Vec<Vec<(usize, f64)>>,
    /// Velocity of each dof at the end of the step under the forces found so far, m/s: what a sweep reads and writes.
    velocities: Vec<f64>,
    /// Motion and forces of each point within a step; none where rows are single dofs.
    turns: Vec<PointTurn>,
    /// Normal force `N` on each node at `n`, N/m.
    pub normal_force: Vec<f64>,
    /// Tangential force `T` on each node at `n`, N/m.
    pub tangential_force: Vec<f64>,
    /// Friction across the sliding on each node at `n`, N; none in the plane.
    pub across_force: Vec<f64>,
    /// Status of each node at `n`.
    pub status: Vec<ContactStatus>,
    ambiguous: u64,
    /// Steps in which the forces had not converged when their sweeps ended.
    pub(super) unconverged_steps: u64,
}

#[derive(Clone, Copy, Debug)]
struct TouchedDof {
    place: usize,
    mass: f64,
    /// Zero for a held dof, which has no mass.
    inverse_mass: f64,
    /// Velocity and elastic acceleration before the step.
    before: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
struct ContactPoint {
    /// What a force moves along the normal, and along the surface where it yields most, kg.
    mass: [f64; 2],
    gap: f64,
    /// Sliding speed, m/s.
    speed: f64,
    /// Tangential dashpot, N s/m.
    dashpot: f64,
    /// Whether it is held along the sliding, not across it.
    is_led: bool,
}

/// Points of one law.
#[derive(Clone, Debug)]
struct TouchingSurfaces {
    points: Range<usize>,
    law: CoulombFriction,
    /// How far the counterface is pushed in at the end, m.
    interference: f64,
    /// One for each point; `None` is rigid.
    springs: Option<Vec<Spring>>,
    /// Whether friction is constant and there are no tangential dashpots.
    is_plain: bool,
}

/// A point within a step of the sweeps.
#[derive(Clone, Copy, Debug, Default)]
struct PointTurn {
    free: FreePoint,
    forces: PointForces,
}

/// Contact forces of a point within a step.
#[derive(Clone, Copy, Debug, Default)]
struct PointForces {
    /// Along the rows, those of dashpots included, N.
    whole: [f64; 3],
    /// Friction alone along the sliding and across it, N.
    friction: [f64; 2],
    status: ContactStatus,
    is_ambiguous: bool,
}

/// What all points of a step have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub coefficients: StepCoefficients,
    /// Shares of the interference that are reached one step ago, now and at the next step.
    pub shares: [f64; 3],
}

impl LagrangeContact {
    /// Finds the multipliers of the coming step and adds them to the elastic accelerations.
    pub(super) fn apply(&mut self, fields: &mut MotionFields, step: &Step) {
        match (self.tangents, self.is_single) {
            (1, true) => self.apply_to_single_dofs::<1>(fields, step),
            (_, true) => self.apply_to_single_dofs::<2>(fields, step),
            (1, false) => self.apply_in_sweeps::<1>(fields, step),
            (_, false) => self.apply_in_sweeps::<2>(fields, step),
        }
    }

    /// Takes the multipliers out of the elastic accelerations after the step, and returns what they did.
    pub(super) fn settle(
        &self,
        fields: &mut MotionFields,
        step: &Step,
    ) -> (ContactPowers, StatusCounts) {
        match (self.tangents, self.is_single) {
            (1, true) => self.settle_points::<1, true>(fields, step),
            (_, true) => self.settle_points::<2, true>(fields, step),
            (1, false) => self.settle_points::<1, false>(fields, step),
            (_, false) => self.settle_points::<2, false>(fields, step),
        }
    }

    /// Energy in the springs of a compliant contact at the half step before `u` and after its `shares` of the interference, J/m.
    pub fn energy(&self, fields: &MotionFields, shares: [f64; 2], dt: f64) -> f64 {
        let mut energy = 0.0;
        for surfaces in &self.surfaces {
            let Some(springs) = &surfaces.springs else { continue };
            for (k, i) in surfaces.points.clone().enumerate() {
                let pushed = shares.map(|share| surfaces.pushed(k, &self.points[i], share));
                let mean = self.along(i, 0, |dof| {
                    fields.displacement[dof.place] - 0.5 * dt * fields.velocity[dof.place]
                });
                energy += springs[k].energy(0.5 * (pushed[0] + pushed[1]) - mean);
            }
        }
        energy
    }

    /// Row `c` of point `i` of the `values` of its dofs.
    #[inline]
    fn along(&self, i: usize, c: usize, values: impl Fn(&TouchedDof) -> f64) -> f64 {
        let entries = self.entries[self.row(i, c)].iter();
        entries.map(|&(k, along)| along * values(&self.dofs[k as usize])).sum()
    }

    /// The entries of row `c` of point `i`.
    #[inline]
    fn row(&self, i: usize, c: usize) -> Range<usize> {
        let row = (self.tangents + 1) * i + c;
        let first = if row == 0 { 0 } else { self.ends[row - 1] };
        first..self.ends[row]
    }
}
