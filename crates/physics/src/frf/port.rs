//! Where a force acts and where a motion is observed, over the unknowns of a system.

use crate::contact::Row;
use crate::linalg::c64;

/// A combination of unknowns: a force of 1 N puts these shares on them, a motion is seen as their sum.
///
/// One unknown with share 1 where the direction is one of the node's frame; several for a direction across it, and for a node
/// that follows others (a tie).
#[derive(Clone, Debug, PartialEq)]
pub struct Port(pub(super) Row);

impl Port {
    /// The force of 1 N over `count` unknowns.
    pub(super) fn force(&self, count: usize) -> Vec<f64> {
        let mut force = vec![0.0; count];
        for &(unknown, share) in &self.0 {
            force[unknown] += share;
        }
        force
    }

    /// The same, complex.
    pub(super) fn complex_force(&self, count: usize) -> Vec<c64> {
        let force = self.force(count).into_iter();
        force.map(|share| c64::new(share, 0.0)).collect()
    }

    /// What is observed of `x`.
    pub(super) fn observe(&self, x: &[c64]) -> c64 {
        self.0.iter().map(|&(unknown, share)| x[unknown] * share).sum()
    }

    /// Its row of a basis: `e^T V`.
    pub(super) fn row_of(&self, basis: crate::linalg::MatRef<'_, f64>) -> Vec<f64> {
        let entry = |j: usize| self.0.iter().map(|&(i, share)| basis[(i, j)] * share).sum();
        (0..basis.ncols()).map(entry).collect()
    }
}
