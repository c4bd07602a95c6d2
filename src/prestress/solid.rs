//! Steady sliding of a body of revolution in three dimensions, from one sector.

use super::PrestressError;
use crate::contact::{SlidingContact, SteadyFriction};
use crate::fem::sector::MirrorParity;
use crate::fem::solid::{FaceTerm, SolidMatrix, face_load, face_matrix, half_bandwidth};
use crate::linalg::banded::{BandedFactor, BandedMatrix};
use crate::mesh::{BoundaryCondition, FaceElement, SolidFace, SolidSector};

/// Choices of the set of pressed rings tried before the search is given up.
const SETS: usize = 200;

/// The state of steady sliding of a body of revolution, the same in every sector.
///
/// ```text
/// u_n = delta and N >= 0 where a ring of nodes is pressed, N = 0 and u_n >= delta where it is open,  T = s mu N along e_theta
/// ```
///
/// with `u_n` towards the body. Friction drags along `e_theta` only, which harmonic zero does not couple to the other two
/// components: pressure and pressed rings do not depend on `mu`, and `u(mu) = u_0 + mu u_1`. The contact is rigid here whatever
/// stiffness the eigenvalue analysis gives it. Vectors hold `(u_r, u_theta, u_z)` of each sector node.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSliding {
    /// Displacement without friction `u_0`, m.
    pub pressed_displacement: Vec<f64>,
    /// Displacement for each unit of friction coefficient `u_1`, m.
    pub sheared_displacement: Vec<f64>,
    /// Normal force on each contact node of the sector `(node, N)`, N; negative at corners of faces with mid-side nodes, where it
    /// is the force of a pressure that is not.
    pub normal_forces: Vec<(usize, f64)>,
    /// Whether each ring of the contact is pressed.
    pub is_pressed: Vec<bool>,
    /// Pressure at each ring, its force over its tributary area, Pa.
    pub pressures: Vec<f64>,
    /// Sense of the friction force `s`, +1 or -1.
    pub sliding_direction: f64,
    /// The rotor.
    pub contact: SlidingContact,
}

impl SolidSliding {
    /// Solves the equilibrium with the elastic stiffness of one sector, to which supports and face pressures are added.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where nothing holds the body, [`PrestressError::GapEverywhere`] where no ring is pressed,
    /// [`PrestressError::NoState`] where no set of pressed rings is found.
    pub fn solve(
        sector: &SolidSector,
        elastic: &SolidMatrix,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let [springs, _] = supports(sector);
        let system = System::new(sector, &[elastic, &springs]);
        let face = sector.specification.contact.face();
        let (inward, component) = (face.inward_sign(), face.normal_component());
        let load = pressure_load(sector);
        let rings = &sector.rings;
        let mut is_pressed = vec![true; rings.len()];
        for _ in 0..SETS {
            let mut prescribed = vec![None; system.dofs];
            for (ring, _) in rings.iter().zip(&is_pressed).filter(|(_, p)| **p) {
                for node in &ring.nodes {
                    prescribed[3 * node + component] = Some(inward * contact.interference);
                }
            }
            let pressed = system.solve(&load, &prescribed)?;
            let reaction = system.reaction(&pressed, &load);
            let force = |node: &usize| inward * reaction[3 * node + component];
            let ring_forces: Vec<f64> = rings
                .iter()
                .map(|ring| ring.nodes.iter().map(force).sum())
                .collect();
            let scale = ring_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let depth = |k: usize| {
                contact.interference - inward * pressed[3 * rings[k].nodes[0] + component]
            };
            let next: Vec<bool> = (0..rings.len())
                .map(|k| match is_pressed[k] {
                    true => ring_forces[k] > 1e-12 * scale,
                    false => depth(k) > 1e-12 * contact.interference.abs(),
                })
                .collect();
            if next != is_pressed {
                is_pressed = next;
                continue;
            }
            if !is_pressed.contains(&true) {
                let distance = (0..rings.len())
                    .map(|k| -depth(k))
                    .fold(f64::INFINITY, f64::min);
                return Err(PrestressError::GapEverywhere {
                    total: rings.len() * sector.sector_count(),
                    distance,
                    interference: contact.interference,
                });
            }
            let sliding_direction = contact.sliding_direction();
            let mut normal_forces = Vec::new();
            let mut drag = vec![0.0; system.dofs];
            for (ring, _) in rings.iter().zip(&is_pressed).filter(|(_, p)| **p) {
                for node in &ring.nodes {
                    normal_forces.push((*node, force(node)));
                    let speed = contact.rotation_speed.abs() * sector.nodes[*node].radius;
                    let friction = contact.steady_friction(sliding_direction, speed);
                    drag[3 * node + 1] = friction.drag * force(node);
                }
            }
            let held = vec![None; system.dofs];
            let pressures = rings.iter().zip(&ring_forces).zip(&is_pressed);
            let pressure = |((ring, force), pressed): (
                (&crate::mesh::ContactRing, &f64),
                &bool,
            )| match pressed {
                true => force / ring.area,
                false => 0.0,
            };
            return Ok(Self {
                sheared_displacement: system.torsion(&drag, &held)?,
                pressures: pressures.map(pressure).collect(),
                pressed_displacement: pressed,
                normal_forces,
                is_pressed,
                sliding_direction,
                contact: *contact,
            });
        }
        Err(PrestressError::NoState {
            friction_coefficient: contact.friction_coefficient,
        })
    }

    /// Displacement at a friction coefficient, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        let both = self
            .pressed_displacement
            .iter()
            .zip(&self.sheared_displacement);
        both.map(|(a, b)| a + friction_coefficient * b).collect()
    }

    /// Slip speed `V = |Omega| r`, m/s, and friction of steady sliding at a radius.
    pub fn friction(&self, radius: f64) -> (f64, SteadyFriction) {
        let speed = self.contact.rotation_speed.abs() * radius;
        (
            speed,
            self.contact.steady_friction(self.sliding_direction, speed),
        )
    }

    /// Friction torque of the whole body at a friction coefficient, N m.
    pub fn torque(&self, sector: &SolidSector, friction_coefficient: f64) -> f64 {
        let arms = self.normal_forces.iter().map(|(node, force)| {
            let radius = sector.nodes[*node].radius;
            self.friction(radius).1.drag * force * radius
        });
        friction_coefficient * arms.sum::<f64>() * sector.sector_count() as f64
    }

    /// Normal force of the whole contact over its area, Pa.
    pub fn mean_pressure(&self, sector: &SolidSector) -> f64 {
        let force: f64 = self.normal_forces.iter().map(|(_, force)| force).sum();
        force / sector.rings.iter().map(|ring| ring.area).sum::<f64>()
    }

    /// Pressure along the contact by the places of the rings, for the elements of the face: through the two rings at the ends of an
    /// element, and the one at its middle where there is one.
    pub fn pressure_along(&self, sector: &SolidSector, element: &FaceElement, along: f64) -> f64 {
        let at = |node: usize| {
            let rings = sector.rings.iter().zip(&self.pressures);
            let own = rings
                .into_iter()
                .find(|(ring, _)| ring.nodes.contains(&node));
            own.map_or(0.0, |(_, pressure)| *pressure)
        };
        let [from, to] = [0, 2].map(|corner| at(element.nodes[corner].0));
        let linear = 0.5 * ((1.0 - along) * from + (1.0 + along) * to);
        if !sector.is_quadratic() {
            return linear;
        }
        let middle = at(element.nodes[5].0);
        let pressure = linear + (1.0 - along * along) * (middle - 0.5 * (from + to));
        pressure.max(0.0)
    }
}

/// Springs and dashpots of every support, N/m and N s/m.
pub fn supports(sector: &SolidSector) -> [SolidMatrix; 2] {
    let mut result = [SolidMatrix::default(), SolidMatrix::default()];
    for (face, condition) in SolidFace::ALL
        .into_iter()
        .zip(&sector.specification.conditions)
    {
        let BoundaryCondition::Support(support) = condition else {
            continue;
        };
        let elements = sector.face_elements(face);
        let (normal, across) = (face.normal_component(), face.across_component());
        // Across, a face is tangential like around; a cylinder has its own word for it.
        let is_cylinder = normal == 0;
        let axial = if is_cylinder {
            support.axial_stiffness
        } else {
            support.tangential_stiffness
        };
        let axial_damping = if is_cylinder {
            0.0
        } else {
            support.tangential_damping
        };
        let values = [
            [
                (normal, support.normal_stiffness),
                (1, support.tangential_stiffness),
                (across, axial),
            ],
            [
                (normal, support.normal_damping),
                (1, support.tangential_damping),
                (across, axial_damping),
            ],
        ];
        for (sum, terms) in result.iter_mut().zip(values) {
            for (component, value) in terms.into_iter().filter(|(_, value)| *value != 0.0) {
                let term = FaceTerm {
                    row: component,
                    column: component,
                    weight: &|_, _, _| value,
                };
                sum.extend(face_matrix(sector, &elements, &term));
            }
        }
    }
    result
}

/// Forces of the pressures on the faces, the same in every sector, N.
pub fn pressure_load(sector: &SolidSector) -> Vec<f64> {
    let mut load = vec![0.0; 3 * sector.node_count()];
    for (face, condition) in SolidFace::ALL
        .into_iter()
        .zip(&sector.specification.conditions)
    {
        if let BoundaryCondition::Pressure(pressure) = condition {
            let unit = face_load(sector, &sector.face_elements(face), face.normal_component());
            let factor = pressure * face.inward_sign();
            load.iter_mut()
                .zip(unit)
                .for_each(|(sum, value)| *sum += factor * value);
        }
    }
    load
}

/// Harmonic zero of the supported body.
struct System {
    dofs: usize,
    is_held: Vec<bool>,
    stiffness: BandedMatrix,
}

impl System {
    fn new(sector: &SolidSector, terms: &[&SolidMatrix]) -> Self {
        let dofs = 3 * sector.node_count();
        let all: Vec<Option<usize>> = (0..dofs).map(Some).collect();
        let mut stiffness = BandedMatrix::zeros(dofs, half_bandwidth(sector));
        for term in terms {
            let zero = (sector.sector_count(), 0);
            term.add_harmonic(&mut stiffness, &all, zero, (MirrorParity::Even, 1.0));
        }
        Self {
            dofs,
            is_held: (0..dofs).map(|dof| sector.is_held(dof)).collect(),
            stiffness,
        }
    }

    /// Displacement under a load with some dofs prescribed and without tangential motion.
    fn solve(&self, load: &[f64], prescribed: &[Option<f64>]) -> Result<Vec<f64>, PrestressError> {
        self.part(load, prescribed, |component| component != 1)
    }

    /// Tangential displacement under a tangential load.
    fn torsion(
        &self,
        load: &[f64],
        prescribed: &[Option<f64>],
    ) -> Result<Vec<f64>, PrestressError> {
        self.part(load, prescribed, |component| component == 1)
    }

    fn part(
        &self,
        load: &[f64],
        prescribed: &[Option<f64>],
        is_in: impl Fn(usize) -> bool,
    ) -> Result<Vec<f64>, PrestressError> {
        let mut displacement: Vec<f64> = prescribed
            .iter()
            .map(|value| value.unwrap_or(0.0))
            .collect();
        let unknowns: Vec<usize> = (0..self.dofs)
            .filter(|&dof| is_in(dof % 3) && !self.is_held[dof] && prescribed[dof].is_none())
            .collect();
        let force = self.stiffness.multiply(&displacement);
        let mut right: Vec<f64> = unknowns.iter().map(|&dof| load[dof] - force[dof]).collect();
        let reduced = self.stiffness.restricted_to(&unknowns);
        let none = BandedMatrix::zeros(reduced.dimension(), reduced.half_bandwidth());
        let factor = BandedFactor::new(&reduced, &none, 0.0);
        if factor.negative_count() > 0 || !factor.is_regular() {
            return Err(PrestressError::Singular);
        }
        factor.solve(&mut right);
        for (&dof, value) in unknowns.iter().zip(right) {
            displacement[dof] = value;
        }
        Ok(displacement)
    }

    /// Force that holds a displacement beside the load, N.
    fn reaction(&self, displacement: &[f64], load: &[f64]) -> Vec<f64> {
        let force = self.stiffness.multiply(displacement);
        force.iter().zip(load).map(|(f, l)| f - l).collect()
    }
}
