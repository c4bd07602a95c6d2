//! The contact of a body: its nodes, its points, and the steady sliding that its springs start from.

use super::{SteppedBody, TransientModel};
use crate::contact::{ContactInterface, ContactSurface, CoulombFriction, Point, Row};
use crate::fem::MassKind;
use crate::fem::operator::StiffnessOperator;
use crate::mesh::{Counterface, SolidSector};
use crate::prestress::{Assembly, PressedState, PrestressError, SolidSliding, node_point};
use crate::transient::compliance::PressedPoint;
use crate::transient::contact::ContactPart;
use crate::transient::{LagrangeContact, TransientError};
use std::collections::BTreeMap;

impl TransientModel<'_> {
    /// The contact nodes with their angles about the axis; in three dimensions each has an area for a length.
    ///
    /// On a body of revolution they go by rising angle, at each angle by rising radius or height; on an assembly contact by contact.
    pub fn interface(&self) -> ContactInterface {
        let mut nodes = Vec::new();
        let mut areas = Vec::new();
        let mut counterface = Counterface::Plane { point: [0.0; 2], direction: [1.0, 0.0] };
        match self.body {
            SteppedBody::Plane { mesh, .. } => return ContactInterface::of(mesh),
            SteppedBody::Revolution { sector, .. } => {
                let area: f64 = sector.rings.iter().map(|ring| ring.area).sum();
                let moment: f64 = sector.rings.iter().map(|ring| ring.area * ring.radius).sum();
                let radius = moment / area;
                counterface = Counterface::Cylinder { center: [0.0; 2], radius, is_inside: true };
                for s in 0..sector.sector_count() {
                    for ring in &sector.rings {
                        let first = s * sector.node_count();
                        nodes.extend(ring.nodes.iter().map(|&node| (first + node) as u32));
                        areas.resize(nodes.len(), ring.area / ring.nodes.len() as f64);
                    }
                }
            }
            SteppedBody::Assembly { assembly, .. } => {
                for (_, surface) in assembly.contacts() {
                    for (node, points) in points_of_nodes(surface) {
                        nodes.push(node);
                        let shares =
                            points.iter().map(|&(k, share)| share * surface.points[k].weight);
                        areas.push(shares.fold(0.0, |sum, area| sum + area));
                    }
                }
            }
        }
        ContactInterface {
            angles: nodes.iter().map(|&node| self.place(node as usize)[1]).collect(),
            gaps: vec![0.0; nodes.len()],
            tributary_lengths: areas,
            counterface,
            opposite: Vec::new(),
            nodes,
        }
    }

    /// Displacement of steady sliding over all dofs, m.
    ///
    /// # Errors
    /// Where there is none.
    pub fn sliding_displacement(&self) -> Result<Vec<f64>, TransientError> {
        let (state, copies) = match self.body {
            SteppedBody::Revolution { sector, .. } => {
                (self.sliding_face(sector)?.sliding.state, sector.sector_count())
            }
            SteppedBody::Plane { .. } | SteppedBody::Assembly { .. } => (self.sliding_state()?, 1),
        };
        Ok(state.displacement(self.contact.friction_coefficient).repeat(copies))
    }

    /// Steady sliding of a body that has a mesh.
    fn sliding_state(&self) -> Result<PressedState, PrestressError> {
        let friction = self.contact.friction_coefficient;
        match self.body {
            SteppedBody::Assembly { assembly, .. } => assembly.state(friction),
            _ => {
                let mesh = self.mesh();
                let body = Assembly::of_edge(mesh, self.material, &self.contact, self.stiffness)?;
                body.state(friction)
            }
        }
    }

    fn sliding_face(&self, sector: &SolidSector) -> Result<SolidSliding, PrestressError> {
        let (elastic, mass) = (sector.strip.stiffness_alike(self.material), MassKind::Lumped);
        SolidSliding::solve(sector, &elastic, &self.contact, &self.stiffness, mass)
    }

    /// The contact points, all open; `interface` are their nodes.
    pub(in crate::transient) fn lagrange_contact(
        &self,
        operator: &dyn StiffnessOperator,
        interface: &ContactInterface,
    ) -> Result<LagrangeContact, TransientError> {
        let mut parts = match self.body {
            SteppedBody::Plane { .. } => vec![self.single_part(self.edge_points(interface))],
            SteppedBody::Revolution { sector, .. } => {
                vec![self.single_part(self.face_points(sector, interface))]
            }
            SteppedBody::Assembly { assembly, .. } => self.paired_parts(assembly),
        };
        // Linear springs of an assembly have given way in its base state by all their force.
        let is_assembly = matches!(self.body, SteppedBody::Assembly { .. });
        let needs_base = |part: &ContactPart| match part.stiffness.law {
            Some(_) => part.stiffness.law_damping > 0.0,
            None => part.stiffness.normal_stiffness.is_some() && !is_assembly,
        };
        if parts.iter().any(needs_base) {
            let mut base = self.pressed_points(interface)?.into_iter();
            parts.iter_mut().for_each(|part| {
                part.base.iter_mut().zip(&mut base).for_each(|(own, found)| *own = found);
            });
        }
        let bound = |row: &Row| match self.body {
            SteppedBody::Assembly { assembly, .. } => assembly.joined.basis.transposed(row),
            _ => row.clone(),
        };
        Ok(LagrangeContact::new(operator, self.components() - 1, parts, &bound))
    }

    /// The contact of one body, whose nodes are its points.
    fn single_part(&self, points: Vec<Point>) -> ContactPart {
        ContactPart {
            nodes: (0..points.len()).map(|point| vec![(point, 1.0)]).collect(),
            base: vec![PressedPoint::default(); points.len()],
            points,
            law: self.contact.law(),
            interference: self.contact.interference,
            stiffness: self.stiffness.damped_by(self.contact_damping),
        }
    }

    fn edge_points(&self, interface: &ContactInterface) -> Vec<Point> {
        let mut points = interface.points(&self.contact);
        // Along the second axes of the nodes, with its sign.
        let speed = interface.surface_speed(self.contact.rotation_speed);
        points.iter_mut().for_each(|point| point.speed = speed);
        points
    }

    fn face_points(&self, sector: &SolidSector, interface: &ContactInterface) -> Vec<Point> {
        let pairs = interface.nodes.iter().zip(&interface.tributary_lengths);
        let points = pairs.map(|(&node, &weight)| {
            let [radius, _] = self.place(node as usize);
            let speed = self.contact.rotation_speed * radius;
            Point { weight, speed, ..node_point(sector, node as usize, &self.contact) }
        });
        points.collect()
    }

    fn paired_parts(&self, assembly: &Assembly<'_>) -> Vec<ContactPart> {
        let friction = self.contact.friction_coefficient;
        let parts = assembly.contacts().iter().map(|(surfaces, surface)| ContactPart {
            points: surface.points.clone(),
            nodes: points_of_nodes(surface).into_values().collect(),
            base: vec![PressedPoint::default(); surface.points.len()],
            law: CoulombFriction {
                friction_coefficient: friction * surfaces.friction.ratio,
                decay: surfaces.friction.decay,
            },
            interference: surfaces.counter.interference(),
            stiffness: surfaces.stiffness.damped_by(self.contact_damping),
        });
        parts.collect()
    }

    /// The state of steady sliding at all contact points.
    fn pressed_points(
        &self,
        interface: &ContactInterface,
    ) -> Result<Vec<PressedPoint>, PrestressError> {
        let friction = self.contact.friction_coefficient;
        let spring = |spring: f64| PressedPoint { spring, ..PressedPoint::default() };
        let force = |force: f64| PressedPoint { force, ..PressedPoint::default() };
        match self.body {
            SteppedBody::Revolution { sector, .. } => {
                let base = self.sliding_face(sector)?;
                let nodes = interface.nodes.iter().zip(&interface.tributary_lengths);
                let point = nodes.map(|(&node, area)| {
                    self.pressed_on_face(sector, &base, node as usize % sector.node_count(), *area)
                });
                Ok(point.collect())
            }
            SteppedBody::Plane { .. } | SteppedBody::Assembly { .. } => {
                let base = self.sliding_state()?;
                let springs = base.springs(friction).into_iter().map(spring);
                let forces = base.normal_forces(friction).into_iter().map(force);
                Ok(if base.stiffnesses.is_empty() { forces.collect() } else { springs.collect() })
            }
        }
    }

    /// Steady sliding at a node of a sector with the `area` that belongs to it.
    fn pressed_on_face(
        &self,
        sector: &SolidSector,
        base: &SolidSliding,
        node: usize,
        area: f64,
    ) -> PressedPoint {
        let face = sector.specification.contact.face();
        let normal = base.sliding.state.displacements[0][3 * node + face.normal_component()];
        // What the springs of a compliant base state have given way already is in its displacement.
        let given_way = match base.law {
            Some(_) => self.contact.interference - face.inward_sign() * normal,
            None => 0.0,
        };
        let spring = self.stiffness.law.map_or(0.0, |law| law.stiffness(given_way.max(0.0)));
        let force = base.normal_forces().find(|(own, _)| *own == node);
        PressedPoint { force: force.map_or(0.0, |own| own.1), spring: area * spring, given_way }
    }
}

/// Points that each node of a surface has a part in, with its shares.
fn points_of_nodes(surface: &ContactSurface) -> BTreeMap<u32, Vec<(usize, f64)>> {
    let mut nodes: BTreeMap<u32, Vec<(usize, f64)>> =
        surface.nodes.iter().map(|&node| (node, Vec::new())).collect();
    for (k, site) in surface.sites.iter().enumerate() {
        for (node, share) in &site.shares {
            if let Some(points) = nodes.get_mut(node) {
                points.push((k, *share));
            }
        }
    }
    nodes
}
