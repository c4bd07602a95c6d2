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

    /// `g` at the frequency `Im(lambda) / 2 pi` of an eigenvalue.
    pub fn at(&self, lambda: c64) -> c64 {
        self.table.ratio(lambda.im / TAU) - self.reference()
    }

    /// `dg / d omega` there.
    pub fn slope(&self, lambda: c64) -> c64 {
        self.table.slope(lambda.im / TAU)
    }
}

/// What multiplies a stiffness beside the real one at an eigenvalue: `i` of structural damping, `g` of a table.
#[derive(Clone, Debug)]
pub struct LossGain(pub Option<TabledGain>);

impl LossGain {
    /// The factor. Motions are real: what belongs to `-f` is the conjugate of what belongs to `f`.
    pub fn at(&self, lambda: c64) -> c64 {
        let at = |own| self.0.as_ref().map_or(c64::I, |gain| gain.at(own));
        if lambda.im < 0.0 { at(lambda.conj()).conj() } else { at(lambda) }
    }

    /// Its derivative by the angular frequency, s.
    pub fn slope(&self, lambda: c64) -> c64 {
        let at = |own| self.0.as_ref().map_or(c64::ZERO, |gain| gain.slope(own));
        if lambda.im < 0.0 { -at(lambda.conj()).conj() } else { at(lambda) }
    }
}
