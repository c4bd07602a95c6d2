//! Steady sliding of a rotationally symmetric annulus, from one sector.

use super::PrestressError;
use super::wave_tangent::to_distances;
use crate::contact::{NormalLaw, SlidingContact, SteadyFriction};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::sector;
use crate::linalg::banded::{BandedLdl, BandedMatrix};
use crate::mesh::SectorMesh;
use nalgebra::{DMatrix, DVector};

/// Newton steps to the approach of contact that stiffens, at most; its force is a concave function of the approach's.
const MOST_TANGENTS: usize = 100;

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
    /// Stiffness `w dp/dg` of each contact node, N/m2, where contact stiffens with pressure.
    pub springs: Option<Vec<f64>>,
    /// Sense of the friction force `s`, +1 or -1.
    pub sliding_direction: f64,
    /// Friction at the sliding speed for each unit of friction coefficient and normal force.
    pub friction: SteadyFriction,
}

impl SectorSliding {
    /// Solves the equilibrium with the elastic stiffness of one sector; with a contact that stiffens with pressure, if there is a
    /// `law`: `N_i = w_i p(delta - u_n)`.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open, [`PrestressError::Singular`] for a
    /// stiffness that is not positive definite.
    pub fn solve(
        sector: &SectorMesh,
        elastic: &SectorMatrix,
        contact: &SlidingContact,
        law: Option<NormalLaw>,
    ) -> Result<Self, PrestressError> {
        let system = PressedSystem::new(sector, elastic)?;
        let count = sector.contact_nodes().len();
        let approaches = match law {
            Some(law) => system.approaches(contact.interference, law)?,
            None => vec![0.0; count],
        };
        let distances = approaches.iter().map(|g| contact.interference - g);
        let pressed = system.pressed_by(&distances.collect::<Vec<_>>());
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
            springs: law.map(|law| {
                let pairs = approaches.iter().zip(sector.tributary_lengths());
                pairs.map(|(&g, w)| w * law.stiffness(g)).collect()
            }),
            normal_forces,
            sliding_direction,
            friction,
        })
    }
}

/// Each contact node of the annulus with the shaft's at its place; none on a rigid cylinder.
fn pairs(sector: &SectorMesh) -> impl Iterator<Item = (usize, usize)> + '_ {
    let nodes = sector.contact_nodes();
    nodes.filter_map(|node| Some((node, sector.opposite(node)?)))
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
        let dofs = sector::wave_dofs(sector);
        let mut stiffness = dofs.fold(0, MirrorParity::Even, &[elastic]);
        to_distances(&mut stiffness, pairs(sector).map(|(node, other)| [2 * node, 2 * other]));
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
        Ok(Self { sector, stiffness, unknowns, factor })
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

    fn pressed_by(&self, distances: &[f64]) -> Vec<f64> {
        let mut prescribed = vec![0.0; self.stiffness.dimension()];
        for (node, distance) in self.sector.contact_nodes().zip(distances) {
            prescribed[2 * node] = *distance;
        }
        let force = self.stiffness.multiply(&prescribed);
        let mut pressed = self.solve(force.iter().map(|f| -f).collect());
        for (node, distance) in self.sector.contact_nodes().zip(distances) {
            pressed[2 * node] = *distance;
        }
        pressed
    }

    /// Normal forces of unit distances, column by column.
    fn responses(&self) -> DMatrix<f64> {
        let count = self.sector.contact_nodes().len();
        let columns = (0..count).map(|j| {
            let mut unit = vec![0.0; count];
            unit[j] = 1.0;
            DVector::from_vec(self.normal_forces(&self.pressed_by(&unit)))
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
        let lengths = self.sector.tributary_lengths();
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
            let found = matrix.lu().solve(&(&response * pushed));
            let found = found.ok_or(PrestressError::Singular)?;
            let moved = (&found - &forces).amax();
            forces = found;
            if moved <= 4.0 * f64::EPSILON * forces.amax() {
                break;
            }
        }
        let forces = forces.iter().zip(lengths);
        Ok(forces.map(|(force, w)| law.approach(force.max(0.0) / w)).collect())
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
}

fn check_pressed(sector: &SectorMesh, forces: &[f64]) -> Result<(), PrestressError> {
    let is_pressed = |force: f64| force > 0.0;
    let open: Vec<usize> = (0..forces.len()).filter(|&i| !is_pressed(forces[i])).collect();
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
