//! A mode in coordinates of the common basis.

use crate::cea::counted::NEARLY_CRITICAL;
use crate::linalg::c64;

/// Damping factor, of decay or of growth, from which on a motion may as well be one of those that do not oscillate.
const HARDLY_OSCILLATING: f64 = 0.95;

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
    /// The same with other coordinates of its vectors.
    pub fn map(&self, change: impl Fn(&[c64]) -> Vec<c64>) -> Self {
        let [right, left] = [&self.right, &self.left].map(|own| change(own));
        Self { right, left, ..*self }
    }

    /// `-Re(lambda) / |lambda|`; 1 is critical.
    pub fn damping_factor(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.norm()
    }

    /// Whether it may cease to oscillate at the next friction coefficient.
    pub fn is_nearly_critical(&self) -> bool {
        self.damping_factor() > NEARLY_CRITICAL
    }

    /// Whether it may as well be one of the motions that do not oscillate.
    pub fn hardly_oscillates(&self) -> bool {
        self.damping_factor().abs() > HARDLY_OSCILLATING
    }
}
