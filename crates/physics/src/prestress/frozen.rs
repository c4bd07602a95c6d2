//! A tangent whose stiffness depends on frequency, at one frequency.

use super::{LossGain, SlidingTangent};
use crate::fem::ModulusTable;
use crate::linalg::{MatrixPolynomial, c64};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::sync::Arc;

impl SlidingTangent {
    /// The tangent with all its stiffness as it is at one frequency, structural damping included, and no tables: the same where
    /// it has none.
    pub fn at_frequency(&self, frequency_hz: f64) -> Cow<'_, Self> {
        if !self.is_tabled() {
            return Cow::Borrowed(self);
        }
        let mut frozen = self.referred_to(frequency_hz); // Their factors are imaginary there.
        let lost = frozen.losses.iter().map(|(gain, part)| {
            let gain = gain.at(c64::new(0.0, TAU * frequency_hz));
            MatrixPolynomial::combination(0.0, part, gain.im, part)
        });
        let lost = lost.reduce(|sum, own| MatrixPolynomial::combination(1.0, &sum, 1.0, &own)); // H + sum_p Im g_p K_p.
        frozen.losses = lost.into_iter().map(|own| (LossGain(None), own)).collect();
        Cow::Owned(frozen)
    }

    /// The same tangent with its real stiffness referred to another frequency, from which the parts of tables differ less there.
    pub fn referred_to(&self, frequency_hz: f64) -> Self {
        let mut other = self.clone();
        for (gain, part) in &mut other.losses {
            let Some(gain) = &mut gain.0 else { continue };
            let before = gain.reference();
            gain.reference_hz = frequency_hz;
            // K + (r(f) - r(f_0)) K_p, with r what the table has at its reference.
            let change = gain.reference() - before;
            other.stiffness = MatrixPolynomial::combination(1.0, &other.stiffness, change, part);
        }
        other
    }

    /// The first table that does not hold a frequency, Hz.
    pub fn table_without(&self, frequency_hz: f64) -> Option<&Arc<ModulusTable>> {
        self.tabled().map(|(gain, _)| &gain.table).find(|table| !table.covers(frequency_hz))
    }
}
