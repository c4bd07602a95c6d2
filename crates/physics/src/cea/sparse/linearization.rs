//! Linearization of the quadratic eigenproblem.

use crate::cea::counted::is_vibration;
use crate::cea::sparse::*;
use crate::fem::RayleighDamping;
use crate::linalg::dense::add;
use serde::{Deserialize, Serialize};

/// The point about which eigenvalues are searched for: `K + c C + c^2 M`, or `K + c^2 M`, takes the place of `K` in factors, so that
/// they exist however a body is held, and softly held bodies lose no digits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Centre {
    /// `c`, rad/s.
    pub shift: f64,
    /// Modulus of an eigenvalue up to which it belongs to a rigid motion, rad/s; 0 where there are none.
    pub rigid: f64,
}

/// How `T(lambda) x = (lambda^2 M + lambda C + K) x = 0` becomes a linear eigenproblem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Linearization {
    /// Proportional damping `C = alpha M + beta K`: `K x = kappa M x` and
    /// `lambda^2 + alpha lambda + (1 + beta lambda) kappa = 0`. Half the size.
    Reduced(RayleighDamping, Centre),
    /// Any damping: `z = (x, nu x)`, `lambda = omega nu`. The scale `omega` makes the two halves of `z`
    /// alike in size; without it the linearisation loses digits.
    Companion {
        /// Scale of the eigenvalues `omega`, rad/s.
        frequency_scale: f64,
        /// Where they are searched for: `lambda = c + omega nu`.
        centre: Centre,
    },
}

impl Linearization {
    /// The cheapest linearisation of `tangent`; `frequency_scale` (rad/s) is a typical wanted frequency.
    pub fn of(tangent: &SlidingTangent, frequency_scale: f64, centre: Centre) -> Self {
        match tangent.proportional {
            Some(damping) => Self::Reduced(damping, centre),
            None => Self::Companion { frequency_scale, centre },
        }
    }

    pub(super) fn centre(self) -> Centre {
        match self {
            Self::Reduced(_, centre) | Self::Companion { centre, .. } => centre,
        }
    }

    /// Real eigenvalue beyond which a motion grows and is no rigid one, rad/s; 0 where there are none.
    pub fn least_growth(self) -> f64 {
        10.0 * self.centre().rigid
    }

    /// Nonzero values of what takes the place of `K` about the centre at friction coefficient `mu`.
    pub fn centred_stiffness(self, tangent: &SlidingTangent, mu: f64) -> Vec<f64> {
        let c = self.centre().shift;
        let damping = match self {
            Self::Reduced(..) => 0.0, // K + c^2 M.
            Self::Companion { .. } => c,
        };
        shifted_stiffness(tangent, mu, [damping, c * c])
    }

    /// `kappa`, or `lambda`, that belongs to the eigenvalue `s` of the shift-inverted operator: `kappa = 1/s - c^2`,
    /// `lambda = c + omega/s`.
    pub fn value(self, s: c64) -> c64 {
        match self {
            Self::Reduced(_, centre) => s.inv() - centre.shift * centre.shift,
            Self::Companion { frequency_scale, centre } => s.inv() * frequency_scale + centre.shift,
        }
    }

    /// The matrices of the problem at such a value, with their factors.
    pub fn terms<P>(self, matrices: &MotionMatrices<P>, value: c64) -> Vec<(c64, &P)> {
        match self {
            Self::Reduced(..) => vec![(c64::ONE, &matrices.stiffness), (-value, &matrices.mass)], // K - kappa M.
            Self::Companion { .. } => matrices.terms(value),
        }
    }

    /// `lambda` with `Im > 0` that belongs to the eigenvalue `s` of the shift-inverted operator; `None` for a motion that decays
    /// without oscillating, for a rigid one and for the conjugate of a mode.
    pub fn eigenvalue(self, s: c64) -> Option<c64> {
        let (value, rigid) = (self.value(s), self.centre().rigid);
        match self {
            Self::Reduced(damping, _) => {
                let lambda = damping.eigenvalue(value);
                (lambda.im > 0.0 && value.norm() > rigid * rigid).then_some(lambda)
            }
            Self::Companion { .. } => {
                (is_vibration(value) && value.norm() > rigid).then_some(value)
            }
        }
    }

    /// The `kappa`, or `lambda`, that belongs to `lambda`.
    pub fn value_of(self, lambda: c64) -> c64 {
        match self {
            Self::Reduced(damping, _) => damping.kappa(lambda),
            Self::Companion { .. } => lambda,
        }
    }

    /// `|lambda|^2 + c^2`: what inertia forces are measured by, so that those of the softest motions do not vanish beside round-off.
    pub fn inertia(self, lambda: c64) -> f64 {
        lambda.norm_sqr() + self.centre().shift.powi(2)
    }
}

/// Nonzero values of `K + a C + b M` at friction coefficient `mu`.
pub(super) fn shifted_stiffness(tangent: &SlidingTangent, mu: f64, [a, b]: [f64; 2]) -> Vec<f64> {
    let mut values = tangent.stiffness.evaluate(mu);
    for (factor, matrix) in [(a, &tangent.damping), (b, &tangent.mass)] {
        if factor != 0.0 {
            add(&mut values, factor, &matrix.evaluate(mu));
        }
    }
    values
}
