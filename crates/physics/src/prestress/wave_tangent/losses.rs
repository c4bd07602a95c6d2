//! Structural damping and moduli over frequency of the waves of a body.

use super::WaveTangent;
use crate::fem::ModulusTable;
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::prestress::wave_terms::WaveTerms;
use crate::prestress::{FrictionPolynomial, LossGain, TabledGain};

impl WaveTangent {
    /// Whether the stiffness has losses, or depends on frequency.
    pub fn is_lossy(&self) -> bool {
        let WaveTerms { regions, supports, .. } = &self.terms;
        regions.iter().any(|own| own.loss_factor != 0.0 || own.table.is_some())
            || supports.iter().any(|own| own.loss_factor != 0.0)
            || self.options.contact.loss_factor != 0.0
    }

    /// Moduli over frequency of regions.
    pub fn tables(&self) -> impl Iterator<Item = &TabledGain> {
        self.terms.regions.iter().filter_map(|region| region.table.as_ref())
    }

    /// The same with the real stiffness of tables at other frequencies, Hz.
    pub fn referred_to(&self, frequency_hz: impl Fn(&ModulusTable) -> f64) -> Self {
        let mut other = self.clone();
        let tables = other.terms.regions.iter_mut().filter_map(|region| region.table.as_mut());
        tables.for_each(|own| own.reference_hz = frequency_hz(&own.table));
        other
    }

    /// `sum eta K` of regions, supports, and the normal law of the contact, which friction follows; and regions with tables.
    pub(super) fn losses(&self, n: usize) -> Vec<(LossGain, FrictionPolynomial)> {
        if !self.is_lossy() {
            return Vec::new();
        }
        let WaveTerms { regions, supports, contact, .. } = &self.terms;
        let even = |own: &SectorMatrix| self.wave(n, MirrorParity::Even, &[own]);
        let of_regions = regions.iter().map(|own| (own.loss_factor, &own.elastic));
        let of_supports = supports.iter().map(|own| (own.loss_factor, &own.terms[0]));
        let lossy: Vec<_> = of_regions.chain(of_supports).filter(|(eta, _)| *eta != 0.0).collect();
        let eta = self.options.contact.loss_factor;
        // Of a difference of tangents too, whose matrices may be zero: all terms of a quotient have the same parts.
        let is_structural = eta != 0.0 || !lossy.is_empty();
        let mut lost = [(MirrorParity::Even, 0), (MirrorParity::Odd, 1)].map(|(parity, part)| {
            let mut own = self.dofs.fold(n, parity, &[&contact.penalty[part]]);
            own.scale(eta);
            own
        });
        for (eta, own) in lossy {
            lost[0].add_scaled(eta, &even(own));
        }
        let structural = is_structural.then(|| (LossGain(None), self.project(lost.into())));
        let tabled = regions.iter().filter_map(|own| {
            Some((LossGain(Some(own.table.clone()?)), self.project(vec![even(&own.elastic)])))
        });
        structural.into_iter().chain(tabled).collect()
    }
}
