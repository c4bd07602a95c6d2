//! The matrices of small motions, in whatever form.

use crate::linalg::{MatrixPolynomial, c64};
use crate::prestress::{SlidingTangent, TabledGain};

/// What `T(lambda) = K + lambda C + lambda^2 M + i H + sum_p g_p K_p` is made of, `g_p` at the frequency of `lambda`.
pub struct Pencil<P> {
    /// `K`.
    pub stiffness: P,
    /// `C`.
    pub damping: P,
    /// `M`.
    pub mass: P,
    /// `H` of structural damping.
    pub structural: Option<P>,
    /// `K_p` of parts whose stiffness depends on frequency.
    pub tabled: Vec<(TabledGain, P)>,
}

impl<P> Pencil<P> {
    /// What is made of each matrix of `tangent`.
    pub fn of(tangent: &SlidingTangent, make: impl Fn(&MatrixPolynomial) -> P) -> Self {
        let tabled = tangent.tabled();
        Self {
            stiffness: make(&tangent.stiffness),
            damping: make(&tangent.damping),
            mass: make(&tangent.mass),
            structural: tangent.structural().map(&make),
            tabled: tabled.map(|(gain, own)| (gain.clone(), make(own))).collect(),
        }
    }

    /// What becomes of each.
    pub fn map<Q>(&self, change: impl Fn(&P) -> Q) -> Pencil<Q> {
        let tabled = self.tabled.iter();
        Pencil {
            stiffness: change(&self.stiffness),
            damping: change(&self.damping),
            mass: change(&self.mass),
            structural: self.structural.as_ref().map(&change),
            tabled: tabled.map(|(gain, own)| (gain.clone(), change(own))).collect(),
        }
    }

    /// All of them.
    pub fn each_mut(&mut self) -> impl Iterator<Item = &mut P> {
        let viscous = [&mut self.stiffness, &mut self.damping, &mut self.mass];
        let tabled = self.tabled.iter_mut().map(|(_, own)| own);
        viscous.into_iter().chain(&mut self.structural).chain(tabled)
    }

    /// All of them with their factors in `T(lambda)`, `Im lambda > 0`.
    pub fn terms(&self, lambda: c64) -> Vec<(c64, &P)> {
        let (one, lost) = (c64::new(1.0, 0.0), c64::new(0.0, 1.0));
        let mut terms =
            vec![(one, &self.stiffness), (lambda, &self.damping), (lambda * lambda, &self.mass)];
        terms.extend(self.structural.iter().map(|own| (lost, own)));
        terms.extend(self.tabled.iter().map(|(gain, own)| (gain.at(lambda), own)));
        terms
    }
}
