//! The matrices of small motions, in whatever form.

use super::{LossGain, SlidingTangent};
use crate::linalg::{MatrixPolynomial, c64};

/// What `T(lambda) = K + lambda C + lambda^2 M + sum_p g_p(lambda) K_p` is made of.
#[derive(Clone, Debug)]
pub struct MotionMatrices<P> {
    /// `K`.
    pub stiffness: P,
    /// `C`.
    pub damping: P,
    /// `M`.
    pub mass: P,
    /// `K_p` of structural damping and of tables over frequency, with their factors `g_p`.
    pub losses: Vec<(LossGain, P)>,
}

impl<P> MotionMatrices<P> {
    /// What is made of each matrix of `tangent`.
    pub fn of(tangent: &SlidingTangent, make: impl Fn(&MatrixPolynomial) -> P) -> Self {
        let losses = tangent.losses.iter();
        Self {
            stiffness: make(&tangent.stiffness),
            damping: make(&tangent.damping),
            mass: make(&tangent.mass),
            losses: losses.map(|(gain, own)| (gain.clone(), make(own))).collect(),
        }
    }

    /// What becomes of each.
    pub fn map<Q>(&self, change: impl Fn(&P) -> Q) -> MotionMatrices<Q> {
        let losses = self.losses.iter();
        MotionMatrices {
            stiffness: change(&self.stiffness),
            damping: change(&self.damping),
            mass: change(&self.mass),
            losses: losses.map(|(gain, own)| (gain.clone(), change(own))).collect(),
        }
    }

    /// All of them.
    pub fn each_mut(&mut self) -> impl Iterator<Item = &mut P> {
        let viscous = [&mut self.stiffness, &mut self.damping, &mut self.mass];
        viscous.into_iter().chain(self.losses.iter_mut().map(|(_, own)| own))
    }

    /// All of them, in the same order.
    pub fn each(&self) -> impl Iterator<Item = &P> {
        let viscous = [&self.stiffness, &self.damping, &self.mass];
        viscous.into_iter().chain(self.losses.iter().map(|(_, own)| own))
    }

    /// All of them with their factors in `T(lambda)`.
    pub fn terms(&self, lambda: c64) -> Vec<(c64, &P)> {
        let mut terms = vec![
            (c64::ONE, &self.stiffness),
            (lambda, &self.damping),
            (lambda * lambda, &self.mass),
        ];
        terms.extend(self.losses.iter().map(|(gain, own)| (gain.at(lambda), own)));
        terms
    }

    /// Stiffness that depends on frequency, with the rate of its factor, `d g_p / d omega` at that of `lambda`.
    pub fn own_rates(&self, lambda: c64) -> impl Iterator<Item = (c64, &P)> {
        let tabled = self.losses.iter().filter(|(gain, _)| gain.0.is_some());
        tabled.map(move |(gain, own)| (gain.slope(lambda), own))
    }

    /// Whether any stiffness does.
    pub fn is_tabled(&self) -> bool {
        self.losses.iter().any(|(gain, _)| gain.0.is_some())
    }
}

impl MotionMatrices<Vec<f64>> {
    /// Nonzero values of `T(lambda)`.
    pub fn at(&self, lambda: c64) -> Vec<c64> {
        let mut sum = vec![c64::ZERO; self.stiffness.len()];
        for (factor, values) in self.terms(lambda) {
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * *value);
        }
        sum
    }
}
