//! The points of contact of an assembly, with their rows over the dofs that they touch.

use super::{PointContact, ShownNode, TouchedDof, TouchingPoint};
use crate::contact::{ContactStatus, CoulombFriction, Row};
use crate::fem::operator::StiffnessOperator;
use crate::prestress::{Assembly, Elimination};
use crate::transient::compliance::SpringDamping;
use std::collections::BTreeMap;
use std::ops::Range;

impl PointContact {
    pub(super) fn new(
        assembly: &Assembly<'_>,
        friction_coefficient: f64,
        damped_by: &SpringDamping,
        operator: &dyn StiffnessOperator,
    ) -> Self {
        let mut contact = Self {
            dofs: Vec::new(),
            velocities: Vec::new(),
            points: Vec::new(),
            entries: Vec::new(),
            springs: Vec::new(),
            interferences: Vec::new(),
            pushed: Vec::new(),
            nodes: Vec::new(),
            across: Vec::new(),
        };
        let mut touched = BTreeMap::new();
        for (c, (surfaces, surface)) in assembly.contacts().iter().enumerate() {
            let areas: Vec<f64> = surface.points.iter().map(|point| point.weight).collect();
            let springs = damped_by.springs_of(surfaces, &areas, contact.points.len());
            contact.springs.push(springs);
            contact.interferences.push(surfaces.counter.interference());
            contact.pushed.push([0.0; 3]);
            let law = CoulombFriction {
                friction_coefficient: friction_coefficient * surfaces.friction.ratio,
                decay: surfaces.friction.decay,
            };
            let mut shown: BTreeMap<u32, Vec<(usize, f64)>> = BTreeMap::new();
            for (k, point) in surface.points.iter().enumerate() {
                for &(node, share) in &surface.shares[k] {
                    shown.entry(node).or_default().push((contact.points.len(), share));
                }
                let rows = [&point.normal, &point.slip, &point.across]
                    .map(|row| contact.touch(row, assembly.basis(), operator, &mut touched));
                let yields = |row: &Range<usize>| -> f64 {
                    let parts = contact.entries[row.clone()]
                        .iter()
                        .map(|&(k, a)| a * a * contact.dofs[k as usize].inverse_mass);
                    parts.sum()
                };
                let mobility = [yields(&rows[0]), yields(&rows[1]).max(yields(&rows[2]))];
                contact.points.push(TouchingPoint {
                    mobility,
                    rows,
                    gap: point.gap,
                    speed: point.speed,
                    dashpot: surfaces.stiffness.tangential_damping * point.weight,
                    law,
                    contact: (c, k),
                    separation: 0.0,
                    before: [0.0; 3],
                    force: [0.0; 3],
                    friction: [0.0; 2],
                    status: ContactStatus::Open,
                });
            }
            let nodes = surface.nodes.iter();
            contact.nodes.extend(
                nodes.map(|node| ShownNode { points: shown.remove(node).unwrap_or_default() }),
            );
        }
        contact.across = vec![0.0; contact.nodes.len()];
        contact.velocities = vec![0.0; contact.dofs.len()];
        contact
    }

    /// A row over the dofs that move by themselves and have mass.
    fn touch(
        &mut self,
        row: &Row,
        basis: &Elimination,
        operator: &dyn StiffnessOperator,
        touched: &mut BTreeMap<usize, u32>,
    ) -> Range<usize> {
        let first = self.entries.len();
        for (dof, along) in basis.transposed(row) {
            let place = operator.position(dof);
            let mass = operator.masses()[place];
            if mass > 0.0 && along != 0.0 {
                let next = self.dofs.len() as u32;
                let index = *touched.entry(dof).or_insert(next);
                if index == next {
                    self.dofs.push(TouchedDof {
                        place,
                        inverse_mass: mass.recip(),
                        before: [0.0; 2],
                    });
                }
                self.entries.push((index, along));
            }
        }
        first..self.entries.len()
    }
}
