//! Contact points with their rows over the dofs that they touch.

use super::{ContactPoint, LagrangeContact, PointTurn, TouchedDof, TouchingSurfaces};
use crate::contact::{ContactStatus, ContactStiffness, CoulombFriction, Point, Row};
use crate::fem::operator::StiffnessOperator;
use crate::transient::compliance::{PressedPoint, Spring};
use std::collections::BTreeMap;

/// Points of one law, and the nodes that the record shows of them.
#[derive(Debug)]
pub(in crate::transient) struct ContactPart {
    pub points: Vec<Point>,
    /// For each node its points with the share that it has in each.
    pub nodes: Vec<Vec<(usize, f64)>>,
    /// Steady sliding at each point.
    pub base: Vec<PressedPoint>,
    pub law: CoulombFriction,
    /// How far the counterface is pushed in at the end, m.
    pub interference: f64,
    pub stiffness: ContactStiffness,
}

/// Mass along the surface of what is held: it slides on what moves under it. Its forces per step stay finite.
const HELD: f64 = 1e200;

impl LagrangeContact {
    /// All points of `parts` open; `bound` takes what follows other dofs out of a row. Rows of slip are `tangents`: 1 in the
    /// plane, 2 in space.
    pub(in crate::transient) fn new(
        operator: &dyn StiffnessOperator,
        tangents: usize,
        parts: Vec<ContactPart>,
        bound: &dyn Fn(&Row) -> Row,
    ) -> Self {
        let mut contact = Self { tangents, ..Self::default() };
        let mut touched = BTreeMap::new();
        for part in parts {
            let first = contact.points.len();
            let pairs = part.points.iter().zip(&part.base);
            let springs =
                pairs.map(|(point, base)| Spring::of(&part.stiffness, point.weight, base));
            let springs: Option<Vec<Spring>> = springs.collect();
            let tangential_damping = part.stiffness.tangential_damping;
            for point in &part.points {
                for row in &[&point.normal, &point.slip, &point.across][..=tangents] {
                    contact.touch(&bound(row), operator, &mut touched);
                }
                let place = contact.points.len();
                let mut mass = contact.masses_of(place);
                let moves =
                    |c| contact.entries[contact.row(place, c)].iter().any(|own| own.1 != 0.0);
                // A spring pushes against what nothing moves; without one there is no force to find.
                if mass[0] == 0.0 && springs.is_some() {
                    mass[0] = f64::INFINITY;
                }
                contact.points.push(ContactPoint {
                    is_led: tangents > 1 && point.speed != 0.0 && !moves(1) && moves(2),
                    mass,
                    gap: point.gap,
                    speed: point.speed,
                    dashpot: tangential_damping * point.weight,
                });
            }
            let nodes = part.nodes.into_iter().map(|points| {
                points.into_iter().map(|(point, share)| (first + point, share)).collect()
            });
            contact.nodes.extend::<Vec<_>>(nodes.collect());
            contact.surfaces.push(TouchingSurfaces {
                points: first..contact.points.len(),
                law: part.law,
                interference: part.interference,
                springs,
                is_plain: part.law.decay.is_none() && tangential_damping == 0.0,
            });
        }
        contact.finish()
    }

    /// A row over the dofs that move by themselves and have mass, and over its first one whatever that is.
    fn touch(
        &mut self,
        row: &[(usize, f64)],
        operator: &dyn StiffnessOperator,
        touched: &mut BTreeMap<usize, u32>,
    ) {
        for (j, &(dof, along)) in row.iter().enumerate() {
            let mass = operator.masses()[operator.position(dof)];
            let along = if mass > 0.0 { along } else { 0.0 };
            if along == 0.0 && j > 0 {
                continue;
            }
            let next = self.dofs.len() as u32;
            let index = *touched.entry(dof).or_insert(next);
            if index == next {
                self.dofs.push(TouchedDof {
                    place: operator.position(dof),
                    mass,
                    inverse_mass: if mass > 0.0 { mass.recip() } else { 0.0 },
                    before: [0.0; 2],
                });
            }
            self.entries.push((index, along));
        }
        self.ends.push(self.entries.len());
    }

    /// What a force moves along the normal of point `i`, zero where nothing moves, and along its surface where that yields most.
    fn masses_of(&self, i: usize) -> [f64; 2] {
        let mass = |c: usize| match &self.entries[self.row(i, c)] {
            // As it is, without the rounding of its inverse.
            &[(k, along)] if along.abs() == 1.0 => self.dofs[k as usize].mass,
            entries => {
                let parts = entries.iter().map(|&(k, along)| {
                    let inverse_mass = self.dofs[k as usize].inverse_mass;
                    along * along * inverse_mass
                });
                let mobility: f64 = parts.sum();
                if mobility > 0.0 { mobility.recip() } else { 0.0 }
            }
        };
        let surface = (1..=self.tangents).map(mass).filter(|mass| *mass > 0.0);
        [mass(0), surface.reduce(f64::min).unwrap_or(HELD)]
    }

    /// The points are complete: how they hang together, and room for their steps.
    fn finish(mut self) -> Self {
        let mut rows_of = vec![0; self.dofs.len()];
        self.entries.iter().for_each(|&(k, _)| rows_of[k as usize] += 1);
        self.is_coupled = rows_of.iter().any(|&rows| rows > 1);
        let shows_points =
            self.nodes.iter().enumerate().all(|(i, points)| points[..] == [(i, 1.0)]);
        let rows = self.tangents + 1;
        let is_own = |(row, &(k, along)): (usize, &(u32, f64))| {
            let is_moved = along == 1.0 || along == -1.0 && rows > 2;
            let mass = self.points[row / rows].mass[(row % rows).min(1)];
            let is_held = along == 0.0 && rows > 2;
            k as usize == row && (is_moved && self.dofs[row].mass == mass || is_held)
        };
        self.is_single = shows_points
            && self.entries.len() == self.ends.len()
            && self.entries.iter().enumerate().all(is_own);
        let count = self.nodes.len();
        self.velocities = vec![0.0; self.dofs.len()];
        self.turns = vec![PointTurn::default(); self.points.len()];
        self.normal_force = vec![0.0; count];
        self.tangential_force = vec![0.0; count];
        self.across_force = vec![0.0; if self.tangents > 1 { count } else { 0 }];
        self.status = vec![ContactStatus::Open; count];
        self
    }
}
