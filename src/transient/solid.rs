//! Model of a transient of a body of revolution in three dimensions.

use super::boundary::{BoundaryForces, extra_damping};
use super::compliance::CompliantContact;
use super::contact::ContactPart;
use super::perturbation::Place;
use super::{
    LagrangeContact, OperatorChoice, Perturbation, StepPlan, TransientError, TransientSettings,
};
use crate::contact::{ContactInterface, ContactStiffness, Point, Row, SlidingContact};
use crate::fem::operator::{OperatorError, SimdLevel, SolidStencil, StiffnessOperator};
use crate::fem::solid::{self, SolidMatrix};
use crate::fem::{ElasticMaterial, RayleighDamping, Triplets};
use crate::mesh::{BoundaryCondition, Counterface, SolidFace, SolidSector};
use crate::prestress::{PrestressError, SolidSliding, pressure_load, supports};

/// The body, of bricks with 8 nodes, and its contact.
///
/// Dofs over the whole body are `3 (s n + k) + c`: component `c` of `(u_r, u_theta, u_z)` at node `k` of sector `s`, `n` nodes to a
/// sector. Forces are those of the whole body in N, energies in J.
#[derive(Clone, Copy, Debug)]
pub struct SolidTransientModel<'a> {
    /// One of its sectors.
    pub sector: &'a SolidSector,
    /// Its material.
    pub material: &'a ElasticMaterial,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// The rotor.
    pub contact: SlidingContact,
    /// Springs and dashpots of the contact; the default is rigid.
    pub stiffness: ContactStiffness,
}

impl SolidTransientModel<'_> {
    /// Its operator: the stencil of a sector.
    ///
    /// # Errors
    /// [`TransientError::Operator`] for bricks of 20 nodes, and for [`OperatorChoice::Sparse`].
    pub fn operator(
        &self,
        choice: OperatorChoice,
        simd: SimdLevel,
    ) -> Result<Box<dyn StiffnessOperator>, TransientError> {
        if choice == OperatorChoice::Sparse {
            return Err(OperatorError::NotPlane.into());
        }
        let [springs, _] = supports(self.sector);
        let stencil = SolidStencil::assemble(self.sector, self.material, &springs, simd)?;
        Ok(Box::new(stencil))
    }

    /// Contact nodes by rising angle, at each angle by rising radius or height; each has an area for a length.
    pub fn interface(&self) -> ContactInterface {
        let (sector, rings) = (self.sector, &self.sector.rings);
        let per_sector = sector.node_count();
        let mut nodes = Vec::new();
        let (mut angles, mut areas) = (Vec::new(), Vec::new());
        for s in 0..sector.sector_count() {
            for ring in rings {
                for &node in &ring.nodes {
                    nodes.push((s * per_sector + node) as u32);
                    angles.push(sector.angle(node, s));
                    areas.push(ring.area / ring.nodes.len() as f64);
                }
            }
        }
        let area: f64 = rings.iter().map(|ring| ring.area).sum();
        let moment: f64 = rings.iter().map(|ring| ring.area * ring.radius).sum();
        ContactInterface {
            gaps: vec![0.0; nodes.len()],
            nodes,
            angles,
            tributary_lengths: areas,
            counterface: Counterface::Cylinder {
                center: [0.0; 2],
                radius: moment / area,
                is_inside: true,
            },
            opposite: Vec::new(),
        }
    }

    /// The state of steady sliding.
    ///
    /// # Errors
    /// Where there is none.
    pub fn base(&self) -> Result<SolidSliding, PrestressError> {
        let elastic = solid::stiffness(self.sector, self.material);
        let law = self.stiffness.base_law();
        SolidSliding::solve_with(self.sector, &elastic, &self.contact, law)
    }

    /// Displacement of steady sliding over all dofs, m.
    pub(super) fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        let base = self.base()?;
        let sector = base.displacement(self.contact.friction_coefficient);
        Ok(sector.repeat(self.sector.sector_count()))
    }

    pub(super) fn plan(
        &self,
        operator: &dyn StiffnessOperator,
        settings: &TransientSettings,
    ) -> Result<StepPlan, TransientError> {
        let mut damping = self.damping;
        let [_, dashpots] = supports(self.sector);
        let rates = self.everywhere(&dashpots);
        let rates = rates.entries.iter().filter_map(|&(row, _, value)| {
            let mass = operator.masses()[operator.position(row)];
            (mass > 0.0 && value > 0.0).then(|| value / mass)
        });
        damping.mass_coefficient += rates.fold(0.0, f64::max);
        StepPlan::new(operator, &damping, settings)
    }

    /// A matrix that couples no two nodes, in all sectors.
    fn everywhere(&self, matrix: &SolidMatrix) -> Triplets {
        let own = matrix.nodal_blocks(self.sector.node_count());
        let mut all = Triplets::default();
        for s in 0..self.sector.sector_count() {
            let offset = 3 * s * self.sector.node_count();
            let moved = own.iter().map(|&(i, j, value)| (offset + i, offset + j, value));
            all.entries.extend(moved);
        }
        all
    }

    pub(super) fn boundary_forces(&self, operator: &dyn StiffnessOperator) -> BoundaryForces {
        let supports = supports(self.sector).map(|matrix| self.everywhere(&matrix));
        let damping = extra_damping(&supports, None, self.damping);
        let pressure = pressure_load(self.sector).repeat(self.sector.sector_count());
        BoundaryForces::of(&damping, &pressure, operator)
    }

    /// Distance of a node from the axis (m) and its angle about it (rad).
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        let (local, s) = (node % self.sector.node_count(), node / self.sector.node_count());
        [self.sector.nodes[local].radius, self.sector.angle(local, s)]
    }

    /// The contact nodes of `interface`, all open.
    pub(super) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        let base = match self.stiffness.normal_stiffness {
            Some(_) => Some(self.base()?),
            None => None,
        };
        let sector = self.sector;
        let face = sector.specification.contact.face();
        let pairs = interface.nodes.iter().zip(&interface.tributary_lengths);
        let points = pairs.map(|(&node, &weight)| {
            let (first, local) = (3 * node as usize, node as usize % sector.node_count());
            Point {
                weight,
                normal: vec![(first + face.normal_component(), face.inward_sign())],
                slip: vec![(first + 1, 1.0)],
                across: vec![(first + face.across_component(), 1.0)],
                speed: self.contact.rotation_speed * sector.nodes[local].radius,
                ..Point::default()
            }
        });
        let part = ContactPart {
            nodes: ContactPart::nodes_as_points(interface.len()),
            points: &points.collect::<Vec<Point>>(),
            law: self.contact.law(),
            interference: self.contact.interference,
            springs: base.map(|base| self.springs(interface, &base)),
            tangential_damping: self.stiffness.tangential_damping,
        };
        Ok(LagrangeContact::new(operator, 2, vec![part], &Row::clone))
    }

    /// The springs of the contact nodes over the state of steady sliding.
    fn springs(&self, interface: &ContactInterface, base: &SolidSliding) -> CompliantContact {
        let (stiffness, areas) = (&self.stiffness, &interface.tributary_lengths);
        let face = self.sector.specification.contact.face();
        let local = |node: &u32| *node as usize % self.sector.node_count();
        // What the springs of a compliant base state have given way already is in its displacement.
        let approach = |node: &u32| {
            let normal = base.pressed_displacement[3 * local(node) + face.normal_component()];
            match base.law {
                Some(_) => self.contact.interference - face.inward_sign() * normal,
                None => 0.0,
            }
        };
        let given_way: Vec<f64> = interface.nodes.iter().map(approach).collect();
        if let Some(law) = stiffness.law {
            let damping = given_way.iter().zip(areas).map(|(g, area)| {
                let spring = law.stiffness(g.max(0.0));
                area * (stiffness.normal_damping + stiffness.law_damping * spring)
            });
            return CompliantContact::stiffening(law, areas, damping.collect());
        }
        let force = |node: &u32| {
            let mut own = base.normal_forces.iter().filter(|(own, _)| *own == local(node));
            own.next().map_or(0.0, |(_, force)| *force)
        };
        let forces: Vec<f64> = interface.nodes.iter().map(force).collect();
        let law = [stiffness.normal_stiffness.unwrap_or(0.0), stiffness.normal_damping];
        CompliantContact::of(law, areas, &forces).beyond(&given_way)
    }

    /// The velocity of a perturbation over all dofs, m/s: waves along `e_theta`, uniform over the thickness, which fade towards the
    /// cylinder that is clamped, the outer one where neither is.
    pub(super) fn perturbed(
        &self,
        perturbation: &Perturbation,
    ) -> Result<Vec<f64>, TransientError> {
        let sector = self.sector;
        perturbation.check_harmonics(sector.sector_count())?;
        let specification = &sector.specification;
        let (inner, outer) =
            (specification.annulus.inner_radius, specification.annulus.outer_radius);
        let fades_inwards =
            specification.conditions[SolidFace::Inner as usize] == BoundaryCondition::Clamped;
        let per_sector = sector.node_count();
        let nodes = per_sector * sector.sector_count();
        let mut velocity = vec![0.0; 3 * nodes];
        for node in 0..nodes {
            let radius = sector.nodes[node % per_sector].radius;
            let share = (radius - inner) / (outer - inner);
            let place = Place {
                depth: if fades_inwards { 1.0 - share } else { share },
                angle: sector.angle(node % per_sector, node / per_sector),
                tangent: 0.0,
            };
            velocity[3 * node + 1] = perturbation.along(&place);
        }
        perturbation.add_noise(&mut velocity, 3);
        for (dof, v) in velocity.iter_mut().enumerate() {
            if sector.is_held(dof % (3 * per_sector)) {
                *v = 0.0;
            }
        }
        Ok(velocity)
    }
}
