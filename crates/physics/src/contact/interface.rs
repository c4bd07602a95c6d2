//! The contact edge of a mesh.

use super::opposite::{Meeting, OppositeMotion, meetings, pairs};
use super::{Point, Row, SlidingContact, SteadyFriction, scaled};
use crate::mesh::{Boundary, BoundaryCondition, Counterface, Mesh, Strip};
use std::collections::BTreeSet;

/// Contact nodes with their geometry, in order along the edge (of rising angle on the annulus).
#[derive(Clone, Debug, PartialEq)]
pub struct ContactInterface {
    /// 0-based node indices.
    pub nodes: Vec<u32>,
    /// Angle of each node about the cylinder's axis, rad; along a plane `2 pi` times its share of the edge.
    pub angles: Vec<f64>,
    /// Edge length that belongs to each node, `w_i = ∫ N_i |n . e_i| ds`, m.
    pub tributary_lengths: Vec<f64>,
    /// Distance of each undeformed node from the counterface before it is pushed in, m.
    pub gaps: Vec<f64>,
    /// The counterface.
    pub counterface: Counterface,
    /// For each node how the opposite body moves there; empty on a rigid counterface.
    pub opposite: Vec<OppositeMotion>,
}

impl ContactInterface {
    /// The contact edge of `mesh`; nodes that a boundary condition clamps, or that have no other body before them, have no part in it.
    pub fn of(mesh: &Mesh) -> Self {
        Self::meeting(mesh, meetings(mesh))
    }

    /// That of one sector of an annulus; slopes of the opposite body reach into the sectors beside it.
    pub fn of_sector(strip: &Strip) -> Self {
        let mesh = &strip.mesh;
        let ahead = |node: u32, sectors| strip.node_ahead(node as usize, sectors);
        Self::meeting(mesh, pairs(mesh, (strip.count, &ahead)))
    }

    /// With what its nodes meet, unless that is a rigid counterface.
    fn meeting(mesh: &Mesh, mut meetings: Option<Vec<Meeting>>) -> Self {
        let edge = mesh.contact_edge();
        let is_clamped = |own: &&Boundary| own.condition == BoundaryCondition::Clamped;
        let clamped = mesh.boundaries.iter().filter(is_clamped);
        let clamped: BTreeSet<u32> = clamped.flat_map(|own| &own.nodes).copied().collect();
        let meets = |i: usize| meetings.as_ref().is_none_or(|all| all[i].covered > 0.0);
        let kept: Vec<usize> = (0..edge.nodes.len())
            .filter(|&i| !clamped.contains(&edge.nodes[i]) && meets(i))
            .collect();
        let nodes: Vec<u32> = kept.iter().map(|&i| edge.nodes[i]).collect();
        let counterface = mesh.counterface;
        let (angles, mut gaps) = if mesh.is_cyclic {
            // Exact as generated: a contact circle without gaps.
            let frames = nodes.iter().map(|&node| mesh.frame_angles()[node as usize]);
            (frames.collect(), vec![0.0; nodes.len()])
        } else {
            let places = nodes.iter().map(|&own| counterface.place(mesh.plane_node(own as usize)));
            let distances = mesh.distances_from_counterface(edge);
            let gaps = nodes.iter().map(|node| distances[node]);
            (phases(&counterface, places.collect()), gaps.collect())
        };
        let mut lengths: Vec<f64> = kept.iter().map(|&i| edge.tributary_lengths[i]).collect();
        let mut opposite = Vec::new();
        for (k, &i) in kept.iter().enumerate() {
            if let Some(meeting) = meetings.as_mut().map(|all| std::mem::take(&mut all[i])) {
                lengths[k] *= meeting.covered;
                gaps[k] -= meeting.height;
                opposite.push(meeting.motion);
            }
        }
        Self { opposite, angles, tributary_lengths: lengths, gaps, counterface, nodes }
    }

    /// The contact nodes as points, in order.
    pub fn points(&self, contact: &SlidingContact) -> Vec<Point> {
        let friction = self.steady_friction(contact);
        let speed = self.surface_speed(contact.rotation_speed).abs();
        let point = |i: usize| {
            // Displacements along the node's axes, and those of what it meets.
            let own = |axis: usize| (2 * self.nodes[i] as usize + axis, 1.0);
            let over = |axis: usize| -> Row {
                let opposite = self.opposite.get(i).map_or(&[][..], |own| &own.moves[axis]);
                std::iter::once(own(axis)).chain(scaled(opposite, -1.0)).collect()
            };
            Point {
                weight: self.tributary_lengths[i],
                gap: self.gaps[i],
                normal: over(0),
                lift: vec![own(0)],
                slip: over(1),
                across: Row::new(),
                speed,
                friction,
            }
        };
        (0..self.len()).map(point).collect()
    }

    /// Number of contact nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Velocity of the counterface along the nodes' second axes at its speed `speed` (rad/s of a cylinder, m/s of a plane), m/s.
    pub fn surface_speed(&self, speed: f64) -> f64 {
        speed * self.counterface.lever()
    }

    /// [`SlidingContact::sliding_direction`] along the nodes' second axes.
    pub fn sliding_direction(&self, contact: &SlidingContact) -> f64 {
        contact.sliding_direction() * self.counterface.lever().signum()
    }

    /// Friction of the steady sliding of `contact` over this edge.
    pub fn steady_friction(&self, contact: &SlidingContact) -> SteadyFriction {
        let speed = self.surface_speed(contact.rotation_speed);
        contact.steady_friction(self.sliding_direction(contact), speed)
    }

    /// What friction asks of the counterface's drive for each metre of thickness, under the normal forces of the nodes: the
    /// torque `s mu(V) a sum N_i` of a cylinder, N; the force of a plane, N/m.
    pub fn torque(
        &self,
        contact: &SlidingContact,
        friction_coefficient: f64,
        normal_forces: &[f64],
    ) -> f64 {
        let drag = self.steady_friction(contact).drag * friction_coefficient;
        drag * self.counterface.lever() * normal_forces.iter().sum::<f64>()
    }
}

/// Angles about a cylinder as they are; distances along a plane as shares of the edge's extent.
fn phases(counterface: &Counterface, places: Vec<f64>) -> Vec<f64> {
    if let Counterface::Cylinder { .. } = counterface {
        return places;
    }
    let [low, high] = crate::order::range(places.iter().copied());
    let scale = std::f64::consts::TAU / (high - low).max(f64::MIN_POSITIVE);
    places.iter().map(|place| scale * (place - low)).collect()
}
