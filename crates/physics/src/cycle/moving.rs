//! Motions of a body as vectors whose square is an energy.

use crate::fem::operator::{MotionFields, StiffnessOperator};

/// The dofs of a body that move, and what weighs them.
pub(super) struct MovingDofs {
    /// Places in the fields of an operator, with the roots of the masses.
    dofs: Vec<(usize, f64)>,
    /// `omega`, rad/s, that weighs displacements.
    frequency: f64,
}

impl MovingDofs {
    pub fn of(operator: &dyn StiffnessOperator, frequency: f64) -> Self {
        let masses = operator.masses();
        let places = (0..operator.dof_count()).map(|dof| operator.position(dof));
        let moving = places.filter(|&place| masses[place] > 0.0);
        Self { dofs: moving.map(|place| (place, masses[place].sqrt())).collect(), frequency }
    }

    pub fn count(&self) -> usize {
        self.dofs.len()
    }

    /// `(omega sqrt(m) u, sqrt(m) v)` of fields in the layout of the operator.
    pub fn motion(&self, displacement: &[f64], velocity: &[f64]) -> Vec<f64> {
        let dofs = || self.dofs.iter();
        let weighed = dofs().map(|&(place, root)| self.frequency * root * displacement[place]);
        weighed.chain(dofs().map(|&(place, root)| root * velocity[place])).collect() // |motion|^2 = omega^2 u^T M u + v^T M v.
    }

    /// Puts a motion into the fields.
    pub fn place(&self, motion: &[f64], fields: &mut MotionFields) {
        let (displacement, velocity) = motion.split_at(self.count());
        for (&(place, root), (u, v)) in self.dofs.iter().zip(displacement.iter().zip(velocity)) {
            fields.displacement[place] = u / (self.frequency * root);
            fields.velocity[place] = v / root;
        }
    }

    /// Sum of the masses, of each direction by itself.
    pub fn mass(&self) -> f64 {
        self.dofs.iter().map(|(_, root)| root * root).sum()
    }

    /// `v^T M v`.
    pub fn twice_kinetic_energy(&self, velocity: &[f64]) -> f64 {
        self.dofs.iter().map(|&(place, root)| (root * velocity[place]).powi(2)).sum()
    }
}
