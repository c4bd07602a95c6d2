//! A mode in coordinates of the common basis.

use crate::linalg::c64;

/// One mode of the projected problem.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedMode {
    /// Eigenvalue `lambda`, `Im > 0`, rad/s.
    pub eigenvalue: c64,
    /// The eigenvalue `s` of the shift-inverted operator that it comes from.
    pub inverse_value: c64,
    /// `dlambda/dmu`, rad/s.
    pub derivative: c64,
    /// Coordinates of the right vector `x`, of unit length.
    pub right: Vec<c64>,
    /// Coordinates of the left vector `w`, scaled to `w^T (2 lambda M + C) x = 1` (no conjugation).
    pub left: Vec<c64>,
}

impl ReducedMode {
    /// `-Re(lambda) / |lambda|`; 1 is critical.
    pub fn damping_factor(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.norm()
    }
}
