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
        let mut traction = vec![0.0; pressed.len()];
        system.add_traction(&mut traction, &normal_forces, friction.drag);
        Ok(Self {
            sheared_displacement: system.displacement(system.solve(traction)),
            pressed_displacement: system.displacement(pressed),
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
        let force = system.distance_forces(rate.multiply(&self.pressed_displacement));
        let pressed = system.solve(force.iter().map(|f| -f).collect());
        let normal_forces: Vec<f64> = system
            .normal_forces(&pressed)
            .iter()
            .zip(sector.contact_nodes())
            .map(|(reaction, node)| reaction + force[2 * node])
            .collect();
        let mut load = system.distance_forces(rate.multiply(&self.sheared_displacement));
        load.iter_mut().for_each(|force| *force = -*force);
        system.add_traction(&mut load, &normal_forces, self.friction.drag);
        Ok(Self {
            pressed_displacement: system.displacement(pressed),
            sheared_displacement: system.displacement(system.solve(load)),
            normal_forces,
            sliding_direction: self.sliding_direction,
            friction: self.friction,
        })
    }
}

/// Each contact node of the annulus with the shaft's at its place; none on a rigid cylinder.
pub(super) fn pairs(sector: &SectorMesh) -> impl Iterator<Item = (usize, usize)> + '_ {
    let nodes = sector.contact_nodes();
    nodes.filter_map(|node| Some((node, sector.opposite(node)?)))
}

/// `T^T A T` of a matrix over the dofs of a sector, with how far each pair of nodes moves apart in place of the annulus's
/// normal displacement; see [`crate::contact::ContactInterface::to_distances`].
pub(super) fn to_distances(matrix: &mut BandedMatrix, sector: &SectorMesh) {
    for (node, opposite) in pairs(sector) {
        let (from, to) = (2 * node, 2 * opposite);
        for other in matrix.columns(from) {
            let value = matrix.get(from, other);
            if value != 0.0 {
                matrix.add(to, other, value);
            }
        }
        // The row of the shaft's node as well, which has just got what couples to the pair.
        for other in matrix.columns(from) {
            let value = matrix.get(other, from);
            if value != 0.0 {
                matrix.add(other, to, value);
            }
        }
    }
}

/// Harmonic zero with the distances across the contact prescribed.
struct PressedSystem<'a> {
    sector: &'a SectorMesh,
    stiffness: BandedMatrix,
    unknowns: Vec<usize>,
    factor: BandedLdl,
}

impl<'a> PressedSystem<'a> {
    fn new(sector: &'a SectorMesh, elastic: &SectorMatrix) -> Result<Self, PrestressError> {
        let mut stiffness = elastic.harmonic(0);
        to_distances(&mut stiffness, sector);
        let contact = sector.contact_nodes();
        let unknowns: Vec<usize> = (0..stiffness.dimension())
            .filter(|dof| dof % 2 == 1 || !contact.contains(&(dof / 2)))
            .collect();
        let reduced = stiffness.restricted_to(&unknowns);
        let none = BandedMatrix::zeros(reduced.dimension(), reduced.half_bandwidth());
        let factor = BandedLdl::new(&reduced, &none, 0.0);
        if factor.negative_count() > 0 || !factor.is_finite() {
            return Err(PrestressError::Singular);
        }
        Ok(Self {
            sector,
            stiffness,
            unknowns,
            factor,
        })
    }

    /// Response to a load on all dofs with the distances held.
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
        for node in self.sector.contact_nodes() {
            prescribed[2 * node] = interference;
        }
        let force = self.stiffness.multiply(&prescribed);
        let mut pressed = self.solve(force.iter().map(|f| -f).collect());
        for node in self.sector.contact_nodes() {
            pressed[2 * node] = interference;
        }
        pressed
    }

    fn normal_forces(&self, distances: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(distances);
        let nodes = self.sector.contact_nodes();
        nodes.map(|node| force[2 * node]).collect()
    }

    /// Adds what drags the annulus along and holds the shaft back.
    fn add_traction(&self, load: &mut [f64], normal_forces: &[f64], drag: f64) {
        for (node, force) in self.sector.contact_nodes().zip(normal_forces) {
            load[2 * node + 1] += drag * force;
            if let Some(opposite) = self.sector.opposite(node) {
                load[2 * opposite + 1] -= drag * force;
            }
        }
    }

    fn displacement(&self, mut distances: Vec<f64>) -> Vec<f64> {
        for (node, opposite) in pairs(self.sector) {
            distances[2 * node] += distances[2 * opposite];
        }
        distances
    }

    fn distance_forces(&self, mut forces: Vec<f64>) -> Vec<f64> {
        for (node, opposite) in pairs(self.sector) {
            forces[2 * opposite] += forces[2 * node];
        }
        forces
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
        node: sector.numbering[sector.contact_start + first] + 1,
        angle_degrees: step * sector.half_step(sector.contact_start + first) as f64,
        pressure: forces[first] / sector.tributary_lengths()[first],
    })
}
