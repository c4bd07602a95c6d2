//! What a complex eigenvalue analysis returns, whichever solver made it.

use faer::c64;
use std::f64::consts::TAU;

/// One eigenpair of `(lambda^2 M + lambda C + K_t) phi = 0` with `Im(lambda) >= 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexMode {
    /// Eigenvalue `lambda`, rad/s.
    pub eigenvalue: c64,
    /// Circumferential harmonic `n` (nodal diameters).
    pub harmonic: usize,
    /// Branch among the modes of that harmonic, 0 = lowest frequency.
    pub branch: usize,
    /// +1 travels with the rotor, -1 against it, 0 stands (`n = 0`, or degenerate at `mu = 0`).
    pub direction: i8,
    /// Relative residual of the quadratic problem,
    /// `|(lambda^2 M + lambda C + K) phi| / ((|lambda|^2 |M| + |lambda| |C| + |K|) |phi|)`.
    pub residual: f64,
    /// Displacement shape over all nodes in nodal frames, `2 * node_count` values with
    /// `max |u| = 1`, where it was asked for.
    pub shape: Option<Vec<c64>>,
}

impl ComplexMode {
    /// `Re(lambda) / 2 pi`, Hz.
    pub fn real_hz(&self) -> f64 {
        self.eigenvalue.re / TAU
    }

    /// `Im(lambda) / 2 pi`, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im / TAU
    }

    /// Damping factor `zeta = -Re(lambda) / |lambda|` (equation 4).
    pub fn damping_factor(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.re.hypot(self.eigenvalue.im)
    }

    /// Growth rate `Re(lambda)`, 1/s.
    pub fn growth_rate(&self) -> f64 {
        self.eigenvalue.re
    }

    /// Whether the mode grows.
    pub fn is_unstable(&self) -> bool {
        self.eigenvalue.re > 0.0
    }
}

/// All modes found at one friction value, sorted by frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionPoint {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Modes in order of rising frequency.
    pub modes: Vec<ComplexMode>,
}

/// A range of friction coefficients over which one branch grows, located by root finding.
#[derive(Clone, Debug, PartialEq)]
pub struct UnstableInterval {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Branch within the harmonic.
    pub branch: usize,
    /// Travelling direction (see [`ComplexMode::direction`]).
    pub direction: i8,
    /// Critical friction: where the branch turns unstable. The lower end of the range studied where
    /// it is unstable from there on.
    pub critical_friction: f64,
    /// Frequency there, Hz.
    pub frequency_hz: f64,
    /// Where it turns stable again, and its frequency there, Hz; `None` if not within the range.
    pub restabilized: Option<(f64, f64)>,
    /// Whether the branch is already unstable at the lower end of the range.
    pub unstable_from_start: bool,
}

/// A sweep over the friction coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionSweep {
    /// One entry for each friction value, in the order given.
    pub points: Vec<FrictionPoint>,
    /// Every unstable interval, sorted by critical friction.
    pub intervals: Vec<UnstableInterval>,
}
