//! What stiffness that depends on frequency has beside the real one.

use super::ModulusTable;
use crate::linalg::c64;
use std::f64::consts::TAU;
use std::sync::Arc;

/// What a table of modulus over frequency makes of the stiffness `K_p` of its part: the whole has `r_0 K_p` of it, and
/// ```text
/// g(f) K_p,   g(f) = E(f) (1 + i eta(f)) / E_s - r_0,   r_0 = E(f_0) / E_s
/// ```
/// comes to it at the frequency `f`; `E_s` is the modulus of the base state, with which `K_p` is assembled.
#[derive(Clone, Debug, PartialEq)]
pub struct TabledGain {
    /// Modulus and loss factor over frequency.
    pub table: Arc<ModulusTable>,
    /// `f_0`, Hz.
    pub reference_hz: f64,
}

impl TabledGain {
    /// `r_0`.
    pub fn reference(&self) -> f64 {
        self.table.ratio(self.reference_hz).re
    }
}

/// What multiplies a stiffness beside the real one at an eigenvalue: `i` of structural damping, `g` of a table.
#[derive(Clone, Debug)]
pub struct LossGain(pub Option<TabledGain>);

impl LossGain {
    /// The factor, of a table at the frequency `Im(lambda) / 2 pi`. Motions are real: what belongs to `-f` is the conjugate of what
    /// belongs to `f`.
    pub fn at(&self, lambda: c64) -> c64 {
        let table = |own: &TabledGain| own.table.ratio(lambda.im.abs() / TAU) - own.reference();
        let gain = self.0.as_ref().map_or(c64::I, table);
        if lambda.im < 0.0 { gain.conj() } else { gain }
    }

    /// Its derivative by the angular frequency, s.
    pub fn slope(&self, lambda: c64) -> c64 {
        let table = |own: &TabledGain| own.table.slope(lambda.im.abs() / TAU);
        let slope = self.0.as_ref().map_or(c64::ZERO, table);
        if lambda.im < 0.0 { -slope.conj() } else { slope }
    }
}
