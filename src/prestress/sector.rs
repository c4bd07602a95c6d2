//! Steady sliding of a rotationally symmetric annulus, from one sector.

use super::PrestressError;
use crate::contact::{SlidingContact, SteadyFriction};
use crate::fem::sector::SectorMatrix;
use crate::linalg::banded::{BandedLdl, BandedMatrix};
use crate::mesh::SectorMesh;

/// The state of steady sliding of an annulus, the same in every sector.
///
/// It is [`super::SteadySliding`] for the annulus: harmonic zero of the stiffness, whose radial and tangential
/// parts do not mix. Per metre of thickness; vectors hold `(u_r, u_theta)` of each free sector node.
#[derive(Clone, Debug, PartialEq)]
pub struct SectorSliding {
    /// Displacement without friction `u_0`, m.
    pub pressed_displacement: Vec<f64>,
    /// Displacement for each unit of friction coefficient `u_1`, m.
    pub sheared_displacement: Vec<f64>,
    /// Normal force on each contact node of the sector, N/m.
    pub normal_forces: Vec<f64>,
    /// Sense of the friction force `s`, +1 or -1.
    pub sliding_direction: f64,
    /// Friction at the sliding speed for each unit of friction coefficient and normal force.
    pub friction: SteadyFriction,
}

impl SectorSliding {
    /// Solves the equilibrium with the elastic stiffness of one sector.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open, [`PrestressError::Singular`] for a
    /// stiffness that is not positive definite.
    pub fn solve(
        sector: &SectorMesh,
        elastic: &SectorMatrix,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let system = PressedSystem::new(sector, elastic)?;
        let pressed = system.pressed_by(contact.interference);
        let normal_forces = system.normal_forces(&pressed);
        check_pressed(sector, &normal_forces)?;
        let sliding_direction = contact.sliding_direction();
        let surface_speed = sector.specification.inner_radius * contact.rotation_speed;
        let friction = contact.steady_friction(sliding_direction, surface_speed);
        let sheared = system.sheared_by(&normal_forces, friction.drag);
        Ok(Self {
            pressed_displacement: pressed,
            sheared_displacement: sheared,
            normal_forces,
            sliding_direction,
            friction,
        })
    }

    /// Derivative of the state when the elastic stiffness changes at the rate `elastic_rate`
    /// (`u_0`, `u_1` and `N_i`, in the units of the state for each unit of the parameter).
    ///
    /// ```text
    /// K u_0' = -K' u_0 (u_0' = 0 on the contact normal),  N' = K' u_0 + K u_0',  K u_1' = s (mu(V) / mu) N' e_t - K' u_1
    /// ```
    ///
    /// # Errors
    /// [`PrestressError::Singular`] as in [`Self::solve`].
    pub fn rate(
        &self,
        sector: &SectorMesh,
        elastic: &SectorMatrix,
        elastic_rate: &SectorMatrix,
    ) -> Result<Self, PrestressError> {
        let system = PressedSystem::new(sector, elastic)?;
        let rate = elastic_rate.harmonic(0);
        let force = rate.multiply(&self.pressed_displacement);
        let pressed = system.solve(force.iter().map(|f| -f).collect());
        let normal_forces: Vec<f64> = system
            .normal_forces(&pressed)
            .iter()
            .enumerate()
            .map(|(i, reaction)| reaction + force[2 * i])
            .collect();
        let mut load: Vec<f64> = rate
            .multiply(&self.sheared_displacement)
            .iter()
            .map(|f| -f)
            .collect();
        for (i, normal) in normal_forces.iter().enumerate() {
            load[2 * i + 1] += self.friction.drag * normal;
        }
        Ok(Self {
            pressed_displacement: pressed,
            sheared_displacement: system.solve(load),
            normal_forces,
            sliding_direction: self.sliding_direction,
            friction: self.friction,
        })
    }
}

/// Harmonic zero with the contact normals prescribed.
struct PressedSystem {
    stiffness: BandedMatrix,
    unknowns: Vec<usize>,
    factor: BandedLdl,
    contact_count: usize,
}

impl PressedSystem {
    fn new(sector: &SectorMesh, elastic: &SectorMatrix) -> Result<Self, PrestressError> {
        let stiffness = elastic.harmonic(0);
        let contact_count = sector.contact_count;
        let unknowns: Vec<usize> = (0..stiffness.dimension())
            .filter(|dof| dof % 2 == 1 || dof / 2 >= contact_count)
            .collect();
        let reduced = stiffness.restricted_to(&unknowns);
        let none = BandedMatrix::zeros(reduced.dimension(), reduced.half_bandwidth());
        let factor = BandedLdl::new(&reduced, &none, 0.0);
        if factor.negative_count() > 0 || !factor.is_finite() {
            return Err(PrestressError::Singular);
        }
        Ok(Self {
            stiffness,
            unknowns,
            factor,
            contact_count,
        })
    }

    /// Response to a load on all dofs with the contact normals held.
    fn solve(&self, load: Vec<f64>) -> Vec<f64> {
        let mut reduced: Vec<f64> = self.unknowns.iter().map(|&dof| load[dof]).collect();
        self.factor.solve(&mut reduced);
        let mut full = vec![0.0; load.len()];
        for (&dof, value) in self.unknowns.iter().zip(reduced) {
            full[dof] = value;
        }
        full
    }

    fn pressed_by(&self, interference: f64) -> Vec<f64> {
        let mut prescribed = vec![0.0; self.stiffness.dimension()];
        for node in 0..self.contact_count {
            prescribed[2 * node] = interference;
        }
        let force = self.stiffness.multiply(&prescribed);
        let mut pressed = self.solve(force.iter().map(|f| -f).collect());
        for node in 0..self.contact_count {
            pressed[2 * node] = interference;
        }
        pressed
    }

    fn normal_forces(&self, displacement: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(displacement);
        (0..self.contact_count)
            .map(|node| force[2 * node])
            .collect()
    }

    fn sheared_by(&self, normal_forces: &[f64], drag: f64) -> Vec<f64> {
        let mut load = vec![0.0; self.stiffness.dimension()];
        for (node, force) in normal_forces.iter().enumerate() {
            load[2 * node + 1] = drag * force;
        }
        self.solve(load)
    }
}

fn check_pressed(sector: &SectorMesh, forces: &[f64]) -> Result<(), PrestressError> {
    let is_pressed = |force: f64| force > 0.0;
    let open: Vec<usize> = (0..forces.len())
        .filter(|&i| !is_pressed(forces[i]))
        .collect();
    let Some(&first) = open.first() else {
        return Ok(());
    };
    let step = 180.0 / sector.sector_count() as f64;
    Err(PrestressError::Separation {
        count: open.len() * sector.sector_count(),
        total: forces.len() * sector.sector_count(),
        node: sector.numbering[first] + 1,
        angle_degrees: step * sector.half_step(first) as f64,
        pressure: forces[first] / sector.tributary_lengths()[first],
    })
}
