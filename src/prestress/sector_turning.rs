//! Contact forces of steady sliding that turn with the edge, in the harmonics of an annulus.

use super::sector_tangent::SectorTangent;
use crate::linalg::banded::BandedMatrix;
use std::f64::consts::PI;

impl SectorTangent {
    /// What the normal forces of the base state add to the stiffness as they turn and move with the edge.
    ///
    /// On a rigid cylinder `N` turns with the angle `u_t / a`. Of two bodies it stays normal to the common surface, at the
    /// place of the annulus's node: with `'` the derivative along the angle, `s` the annulus and `m` the shaft,
    ///
    /// ```text
    /// dF_t,s = (N / a) (u_s - u_n'),   dF_t,m = -(N / a) (u_m - u_n'),   dF_n,m = -(N / a) D^T (u_s - u_m)
    /// ```
    ///
    /// which is symmetric, and zero under a rigid motion but for what the turned stress balances.
    pub(super) fn turning_pressure(&self, n: usize, stiffness: &mut BandedMatrix) {
        let nodes = self.sector.contact_nodes();
        for (node, turning) in nodes.clone().zip(&self.terms.turning) {
            let tangential = 2 * node + 1;
            stiffness.add(tangential, tangential, -turning);
            if let Some(opposite) = self.sector.opposite(node) {
                stiffness.add(2 * opposite + 1, 2 * opposite + 1, *turning);
            }
        }
        for (i, node, j, slope) in self.slopes(n) {
            let value = self.terms.turning[i] * slope;
            let Some([opposite, normal]) = self.opposites(node, nodes.start + j) else {
                return;
            };
            for (tangential, value) in [(2 * node + 1, value), (2 * opposite + 1, -value)] {
                stiffness.add(tangential, normal, value);
                stiffness.add(normal, tangential, value);
            }
        }
    }

    /// The same of the friction forces `T = s mu N`, as the coefficient of `i mu`.
    ///
    /// ```text
    /// dF_n,s = -(T / a) (u_s - u_n'),   dF_n,m = (T / a) (u_m - u_n'),   dF_t,m = -(T / a) D^T (u_s - u_m)
    /// ```
    pub(super) fn turning_friction(&self, n: usize, friction: &mut BandedMatrix) {
        let nodes = self.sector.contact_nodes();
        for (node, turning) in nodes.clone().zip(&self.terms.turning) {
            let turning = self.base.friction.drag * turning;
            friction.add(2 * node, 2 * node + 1, turning);
            if let Some(opposite) = self.sector.opposite(node) {
                friction.add(2 * opposite, 2 * opposite + 1, -turning);
            }
        }
        for (i, node, j, slope) in self.slopes(n) {
            let value = self.base.friction.drag * self.terms.turning[i] * slope;
            let Some([opposite, normal]) = self.opposites(node, nodes.start + j) else {
                return;
            };
            friction.add(2 * node, normal, -value);
            friction.add(2 * opposite, normal, value);
            friction.add(normal + 1, 2 * node + 1, -value);
            friction.add(normal + 1, 2 * opposite + 1, value);
        }
    }

    /// The shaft's node at the place of one contact node, and the normal dof of that at the place of another.
    fn opposites(&self, node: usize, other: usize) -> Option<[usize; 2]> {
        Some([self.sector.opposite(node)?, 2 * self.sector.opposite(other)?])
    }

    /// Derivative along the angle of the wave `e^{i n theta}` at the contact nodes, `u'_i = i sum_j d_ij u_j`, the mean of both
    /// elements' at a corner: `(i, node i, j, d_ij)`.
    fn slopes(&self, n: usize) -> Vec<(usize, usize, usize, f64)> {
        let start = self.sector.contact_start;
        let step = 2.0 * PI / self.sector.sector_count() as f64;
        let half = (0.5 * n as f64 * step).sin() / step;
        let whole = (n as f64 * step).sin() / step;
        if self.sector.contact_count == 1 {
            return vec![(0, start, 0, whole)];
        }
        vec![(0, start, 0, -whole), (0, start, 1, 4.0 * half), (1, start + 1, 0, 2.0 * half)]
    }
}
