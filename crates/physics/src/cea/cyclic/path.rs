//! Known points of one branch.

use crate::linalg::c64;
use crate::linalg::vectors::dot;

/// An eigenpair of `T(theta)` at one parameter value.
#[derive(Clone, Debug)]
pub(super) struct Eigenpair {
    /// Friction coefficient (or share of the damping, on the way to the first point).
    pub parameter: f64,
    pub theta: c64,
    /// `d theta / d parameter`.
    pub rate: c64,
    /// Right vector, unit Euclidean length.
    pub x: Vec<c64>,
    /// Left vector, unit Euclidean length.
    pub y: Vec<c64>,
    pub residual: f64,
    /// See [`crate::cea::ComplexMode::contact_share`]; known at the friction values asked for.
    pub contact_share: f64,
    /// See [`crate::cea::ComplexMode::axial_share`]; known at the same values.
    pub axial_share: f64,
    /// See [`crate::cea::ComplexMode::uncertainty`]; known at the same values.
    pub uncertainty: f64,
}

impl Eigenpair {
    /// One of which the rest is not known yet, from `theta` and its rate, right and left vector.
    pub fn new(
        parameter: f64,
        [theta, rate]: [c64; 2],
        [x, y]: [Vec<c64>; 2],
        residual: f64,
    ) -> Self {
        let [contact_share, axial_share, uncertainty] = [f64::NAN; 3];
        Self { parameter, theta, rate, x, y, residual, contact_share, axial_share, uncertainty }
    }

    /// Whether another is the same: their distance relative to it is within `near`, and their vectors are parallel.
    pub fn is_same(&self, other: &Self, near: f64) -> bool {
        let is_close = (self.theta - other.theta).norm() <= near * self.theta.norm();
        is_close && dot(&self.x, &other.x).norm() > 0.99 // |x^H x'| of unit vectors.
    }
}

/// Which waves a path stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Waves {
    /// `+n` from `theta` and `-n` from its conjugate (proportional damping).
    Both,
    /// `+n` alone, or a standing wave.
    Forward,
    /// `-n` alone: `lambda` is the conjugate of `theta`.
    Backward,
}

impl Waves {
    /// The single waves that a path stands for.
    pub fn singly(self) -> &'static [Self] {
        match self {
            Self::Both => &[Self::Forward, Self::Backward],
            Self::Forward => &[Self::Forward],
            Self::Backward => &[Self::Backward],
        }
    }

    /// What belongs to this wave of what belongs to the wave `+n`, and the other way round.
    pub fn own(self, value: c64) -> c64 {
        if self == Self::Backward { value.conj() } else { value }
    }
}

/// One branch of one harmonic.
pub(super) struct Path {
    /// Rank among the harmonic's modes without friction; those that do not reach back there are numbered from 1000 on.
    pub branch: usize,
    pub waves: Waves,
    /// Accepted points, rising; vectors are dropped but for the last and those kept on purpose.
    pub points: Vec<Eigenpair>,
}
