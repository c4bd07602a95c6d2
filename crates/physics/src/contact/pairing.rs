//! Contact points of two surfaces of which one slides over the other.

use super::mortar::mortar_nodes;
use super::surface::{SegmentPoint, SurfacePair, SurfacePoint};
use super::{
    ContactInterface, Counterpart, FrictionDecay, PairError, Point, RigidCounterface, Row,
    SlidingContact, SteadyFriction, Topography, row_along,
};
use crate::fem::{RotationFrame, Spin};
use crate::mesh::{Boundary, Counterface, Mesh};
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// A body that turns about an axis; meshes stay where they are, small motions are about the sliding.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Regions that turn.
    pub regions: Vec<usize>,
    /// Unit vector along the axis, right-handed.
    pub axis: [f64; 3],
    /// A point of the axis, m.
    pub center: [f64; 3],
    /// `Omega`, rad/s.
    pub rotation_speed: f64,
    /// In which frame its inertia counts: Coriolis, transport, and the stress and stiffness of the centrifugal load; `None` where
    /// it does not.
    pub inertia: Option<RotationFrame>,
}

impl Motion {
    /// `Omega x r`, m/s.
    pub fn velocity(&self, position: [f64; 3]) -> [f64; 3] {
        let arm = Vector3::from(position) - Vector3::from(self.center);
        (Vector3::from(self.axis).cross(&arm) * self.rotation_speed).into()
    }

    /// `Omega` along the axis, rad/s.
    pub fn spin_vector(&self) -> Vector3<f64> {
        Vector3::from(self.axis) * self.rotation_speed
    }

    /// How its inertia turns, where it counts.
    pub fn spin(&self) -> Option<Spin> {
        self.inertia.map(|frame| Spin { velocity: self.spin_vector(), center: self.center, frame })
    }
}

/// Friction of one contact beside the coefficient that a sweep varies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairFriction {
    /// Its coefficient over that of the sweep.
    pub ratio: f64,
    /// How it falls with the slip speed; `None` is constant.
    pub decay: Option<FrictionDecay>,
}

/// Where the points of a contact of two surfaces are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointKind {
    /// Quadrature points of the segments: for penalty contact with consistent mass.
    Segments,
    /// Nodes of the own surface with dual mortar weights, each with dofs of its own: for rigid contact, and with lumped mass.
    Nodes,
}

/// Place and directions of a contact point, and the nodes around it.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSite {
    /// Where it is on the own surface, m.
    pub position: [f64; 3],
    /// Unit normal into the own body.
    pub normal: [f64; 3],
    /// Unit vector along which the counter surface slides over it; zero where it does not.
    pub direction: [f64; 3],
    /// Nodes of the own surface that it is among, with their shares in it.
    pub shares: Vec<(u32, f64)>,
    /// Nodes of the counter surface before it, with the slopes of their shares by arc, 1/m; none on a rigid one, nor in the plane,
    /// where [`ContactInterface`] has them.
    pub slopes: Vec<(u32, Vector3<f64>)>,
}

/// The contact points of two surfaces, in the plane of an edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactSurface {
    /// The points.
    pub points: Vec<Point>,
    /// Place of each.
    pub sites: Vec<ContactSite>,
    /// Rotation of the counterpart relative to the own body, rad/s.
    pub spin: Vector3<f64>,
    /// Nodes of the own surface that have the other before them.
    pub nodes: Vec<u32>,
    /// Area of the own surface, and how much of it is covered, m2; lengths of an edge, m.
    pub area: f64,
    /// The covered part, m2.
    pub covered: f64,
}

impl ContactSurface {
    /// The points of `surface` (A) that have `counter` (B) before them, over which B slides as `motions` say:
    ///
    /// ```text
    /// V = v_B - v_A without its part along n,   t = V / |V|,   d = n x t
    /// ```
    ///
    /// with `v = Omega x r` of the region that a surface belongs to, or the velocity of a rigid counterface. Gaps of a measured
    /// surface add to those of the mesh.
    ///
    /// # Errors
    /// [`PairError`] where the surfaces do not meet, nothing slides, or a measured surface leaves points out.
    pub fn of(
        mesh: &Mesh,
        (surface, counterpart): (&Boundary, &Counterpart),
        motions: &[Motion],
        friction: PairFriction,
        (kind, measured): (PointKind, Option<&Topography>),
    ) -> Result<Self, PairError> {
        // What lies before each other.
        let counter = counterpart.surface().map(|place| &mesh.boundaries[place]);
        let mut pair = match counterpart {
            Counterpart::Surface(b) => SurfacePair::of(mesh, surface, &mesh.boundaries[*b])?,
            Counterpart::Rigid(rigid) => SurfacePair::on_rigid(mesh, surface, rigid)?,
            Counterpart::Edge(contact) => return Ok(Self::of_edge(mesh, contact)),
        };
        if let Some(measured) = measured {
            measured.widen(&mut pair, &surface.name)?;
        }
        // How they move: v_B - v_A at a place, and the difference of their rotations.
        let own_motion = motion_of(mesh, surface, motions);
        let counter_motion = counter.and_then(|boundary| motion_of(mesh, boundary, motions));
        let velocity_of = |motion: Option<&Motion>, at: [f64; 3]| -> Vector3<f64> {
            motion.map_or(Vector3::zeros(), |own| own.velocity(at).into())
        };
        let sliding = |at: [f64; 3]| -> Vector3<f64> {
            let of_rigid = counterpart.rigid().map(|rigid| rigid.velocity(at).into());
            of_rigid.unwrap_or_else(|| velocity_of(counter_motion, at))
                - velocity_of(own_motion, at)
        };
        let spin = |motion: Option<&Motion>| motion.map_or(Vector3::zeros(), Motion::spin_vector);
        let mut found = Self {
            spin: counterpart.rigid().map_or_else(|| spin(counter_motion), RigidCounterface::spin)
                - spin(own_motion),
            nodes: nodes_of(pair.points.iter().map(|point| &point.at.own)),
            area: pair.area,
            covered: pair.covered,
            ..Self::default()
        };
        // Their points.
        match kind {
            PointKind::Segments => {
                for SegmentPoint { at, .. } in pair.points {
                    let (velocity, shares) = (sliding(at.position), at.own.clone());
                    let jump = |direction| at.jump(mesh, direction);
                    found.add((&at, shares), (velocity, friction), jump, Row::new());
                }
            }
            PointKind::Nodes => {
                for mut node in mortar_nodes(mesh, surface, &pair) {
                    if let Counterpart::Rigid(rigid) = counterpart {
                        node.at.normal = rigid.normal(node.at.position, node.at.normal);
                    }
                    let lift = row_along(mesh, &node.lift, node.at.normal, 1.0);
                    let (velocity, shares) = (sliding(node.at.position), vec![(node.node, 1.0)]);
                    let jump = |direction| node.jump(mesh, direction);
                    found.add((&node.at, shares), (velocity, friction), jump, lift);
                }
            }
        }
        if counter.is_none() {
            found.drop_held(mesh);
        }
        found.sliding(surface, counter)
    }

    /// The nodes of the contact edge of a plane body as points, for each metre of thickness.
    pub fn of_edge(mesh: &Mesh, contact: &SlidingContact) -> Self {
        let edge = ContactInterface::of(mesh);
        let sense = edge.sliding_direction(contact);
        let site = |&node: &u32| {
            let frame = mesh.frame(node as usize);
            ContactSite {
                position: mesh.nodes[node as usize],
                normal: frame.column(0).into_owned().into(),
                direction: (frame.column(1) * sense).into(),
                shares: vec![(node, 1.0)],
                slopes: Vec::new(),
            }
        };
        Self {
            points: edge.points(contact),
            sites: edge.nodes.iter().map(site).collect(),
            spin: match mesh.counterface {
                Counterface::Cylinder { .. } => Vector3::z() * contact.rotation_speed,
                Counterface::Plane { .. } => Vector3::zeros(),
            },
            area: mesh.contact_edge().tributary_lengths.iter().sum(),
            covered: edge.tributary_lengths.iter().sum(),
            nodes: edge.nodes,
        }
    }

    /// Refuses points that are all held, or at rest.
    fn sliding(self, surface: &Boundary, counter: Option<&Boundary>) -> Result<Self, PairError> {
        let name = &surface.name;
        let problem = match counter {
            _ if self.points.iter().any(|point| point.speed > 0.0) => return Ok(self),
            _ if self.points.is_empty() => format!(
                "all of surface \"{name}\" is held: nothing of it can give way to the rigid counterface; name another surface, or hold \
                 less"
            ),
            None => format!(
                "nothing slides over surface \"{name}\": its rigid counterface is at rest, or moves along its normal; check its speed, \
                 direction and axis"
            ),
            Some(counter) => format!(
                "nothing slides between surfaces \"{name}\" and \"{}\": the motion given leaves them at rest to each other. Check the \
                 axis, the centre and the regions of [motion]",
                counter.name
            ),
        };
        Err(PairError(problem))
    }

    /// Takes out the points that are held along their normals: they cannot give way to a rigid counterface.
    fn drop_held(&mut self, mesh: &Mesh) {
        let held: BTreeSet<usize> = mesh.held_dofs().collect();
        let gives_way = |point: &Point| point.normal.iter().any(|(dof, _)| !held.contains(dof));
        let is_kept: Vec<bool> = self.points.iter().map(gives_way).collect();
        retain(&mut self.points, &is_kept);
        retain(&mut self.sites, &is_kept);
        self.nodes = nodes_of(self.sites.iter().map(|site| &site.shares));
    }

    /// A point among nodes with `shares`, over which the counterpart goes at a velocity; `jump` is the row of the displacement of one
    /// side relative to the other along a direction.
    fn add(
        &mut self,
        (at, shares): (&SurfacePoint, Vec<(u32, f64)>),
        (velocity, friction): (Vector3<f64>, PairFriction),
        jump: impl Fn([f64; 3]) -> Row,
        lift: Row,
    ) {
        let (direction, speed) = direction_of(at.normal, velocity);
        let own = SteadyFriction::at(friction.decay, speed);
        let across = Vector3::from(at.normal).cross(&Vector3::from(direction));
        let is_sliding = speed > 0.0;
        let along = |direction: [f64; 3]| {
            if is_sliding { jump(direction) } else { Row::new() }
        };
        self.points.push(Point {
            weight: at.area,
            gap: at.gap,
            lift,
            normal: jump(at.normal),
            slip: along(direction),
            across: along(across.into()),
            speed,
            friction: SteadyFriction {
                drag: friction.ratio * own.drag,
                slope: friction.ratio * own.slope,
            },
        });
        let SurfacePoint { position, normal, slopes, .. } = at.clone();
        self.sites.push(ContactSite { position, normal, direction, shares, slopes });
    }
}

/// The motion of the region that a surface's faces belong to.
fn motion_of<'a>(mesh: &Mesh, boundary: &Boundary, motions: &'a [Motion]) -> Option<&'a Motion> {
    let region = mesh.region(boundary.faces.first()?.element as usize);
    motions.iter().find(|motion| motion.regions.contains(&region))
}

/// Direction and speed of the sliding where the counterpart has the velocity `whole` relative to the own body.
fn direction_of(normal: [f64; 3], whole: Vector3<f64>) -> ([f64; 3], f64) {
    let n = Vector3::from(normal);
    let sliding = whole - n * whole.dot(&n);
    let speed = sliding.norm();
    // What is left of a velocity along the normal is round-off.
    if speed > 1e-12 * whole.norm() { ((sliding / speed).into(), speed) } else { ([0.0; 3], 0.0) }
}

/// All nodes among those of points, ascending.
fn nodes_of<'a>(points: impl IntoIterator<Item = &'a Vec<(u32, f64)>>) -> Vec<u32> {
    let nodes: BTreeSet<u32> = points.into_iter().flatten().map(|entry| entry.0).collect();
    nodes.into_iter().collect()
}

fn retain<T>(all: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    all.retain(|_| kept.next().is_some_and(|kept| *kept));
}
