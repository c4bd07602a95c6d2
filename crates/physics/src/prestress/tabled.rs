//! Stiffness that depends on frequency.

use crate::fem::TabledGain;
use crate::linalg::MatrixPolynomial;

/// A part with such a table.
#[derive(Clone, Debug)]
pub struct TabledStiffness {
    /// What the table makes of its stiffness.
    pub gain: TabledGain,
    /// `K_p(mu)`, on the pattern of the tangent.
    pub stiffness: MatrixPolynomial,
}
