//! Structural damping and moduli over frequency of the waves of a body.

use super::WaveTangent;
use crate::fem::ModulusTable;
use crate::prestress::terms::{Kind, Part, Term};
use crate::prestress::{FrictionPolynomial, LossGain, TabledGain};

impl WaveTangent {
    /// Whether the stiffness has losses, or depends on frequency.
    pub fn is_lossy(&self) -> bool {
        self.terms.is_lossy()
    }

    /// Moduli over frequency of regions.
    pub fn tables(&self) -> impl Iterator<Item = &TabledGain> {
        self.terms.bodies.iter().filter_map(|region| region.table.as_ref())
    }

    /// The same with the real stiffness of tables at other frequencies, Hz.
    pub fn referred_to(&self, frequency_hz: impl Fn(&ModulusTable) -> f64) -> Self {
        let mut other = self.clone();
        let tables = other.terms.bodies.iter_mut().filter_map(|region| region.table.as_mut());
        tables.for_each(|own| own.reference_hz = frequency_hz(&own.table));
        other
    }

    /// `sum eta K` of regions, supports, and the normal law of the contact, which friction follows; and regions with tables.
    pub(super) fn losses(&self, n: usize) -> Vec<(LossGain, FrictionPolynomial)> {
        // Of a difference of tangents too, whose matrices may be zero: all terms of a quotient have the same parts.
        let structural = self
            .terms
            .laws()
            .any(|law| law.loss_factor != 0.0)
            .then(|| (LossGain(None), self.polynomial(n, |term| self.terms.factors(term)[2])));
        let tabled = self.terms.bodies.iter().enumerate().filter_map(|(body, law)| {
            let table = LossGain(Some(law.table.clone()?));
            let own = |term: &Term<_>| term.is(Part::Body(body), Kind::Stiffness);
            Some((table, self.polynomial(n, |term| f64::from(u8::from(own(term))))))
        });
        structural.into_iter().chain(tabled).collect()
    }
}
