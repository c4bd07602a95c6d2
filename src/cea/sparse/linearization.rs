//! Linearization of the quadratic eigenproblem.

use crate::fem::RayleighDamping;
use crate::linalg::{c64, is_vibration};
use crate::prestress::SlidingTangent;

/// How `T(lambda) x = (lambda^2 M + lambda C + K) x = 0` becomes a linear eigenproblem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Linearization {
    /// Proportional damping `C = alpha M + beta K`: `K x = kappa M x` and
    /// `lambda^2 + alpha lambda + (1 + beta lambda) kappa = 0`. Half the size.
    Reduced(RayleighDamping),
    /// Any damping: `z = (x, nu x)`, `lambda = omega nu`. The scale `omega` makes the two halves of `z`
    /// alike in size; without it the linearisation loses digits.
    Companion {
        /// Scale of the eigenvalues `omega`, rad/s.
        frequency_scale: f64,
    },
}

impl Linearization {
    /// The cheapest linearisation of `tangent`; `frequency_scale` (rad/s) is a typical wanted frequency.
    pub fn of(tangent: &SlidingTangent, frequency_scale: f64) -> Self {
        match tangent.proportional {
            Some(damping) => Self::Reduced(damping),
            None => Self::Companion { frequency_scale },
        }
    }

    /// Residual force relative to inertia force above which a point is improved.
    ///
    /// The real problem's bases aim lower anyway. Of the quadratic one an eigenvalue is wrong by the product of the
    /// errors of its right and left vectors: this keeps it below 1e-9.
    pub fn force_residual_goal(self) -> f64 {
        match self {
            Self::Reduced(_) => 1e-10,
            Self::Companion { .. } => 1e-7,
        }
    }

    /// `lambda` with `Im > 0` that belongs to the eigenvalue `s` of the shift-inverted operator,
    /// `s = 1/kappa` or `s = 1/nu`; `None` for a motion that decays without oscillating
    /// ([`is_vibration`]) and for the conjugate of a mode.
    pub fn eigenvalue(self, s: c64) -> Option<c64> {
        match self {
            Self::Reduced(damping) => {
                let lambda = damping.eigenvalue(s.inv());
                (lambda.im > 0.0).then_some(lambda)
            }
            Self::Companion { frequency_scale } => {
                let nu = s.inv();
                is_vibration(nu).then_some(nu * frequency_scale)
            }
        }
    }

    /// The `s` of [`Self::eigenvalue`] that belongs to `lambda`.
    pub fn inverse_value(self, lambda: c64) -> c64 {
        match self {
            Self::Reduced(damping) => damping.kappa(lambda).inv(),
            Self::Companion { frequency_scale } => (lambda / frequency_scale).inv(),
        }
    }
}
