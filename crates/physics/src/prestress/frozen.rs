//! A tangent whose stiffness depends on frequency, at one frequency.

use super::SlidingTangent;
use crate::fem::ModulusTable;
use crate::linalg::{MatrixPolynomial, c64};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::sync::Arc;

impl SlidingTangent {
    /// The tangent with all its stiffness as it is at one frequency, structural damping included, and no tables: the same where
    /// it has none.
    pub fn at_frequency(&self, frequency_hz: f64) -> Cow<'_, Self> {
        if self.tabled.is_empty() {
            return Cow::Borrowed(self);
        }
        let mut frozen = self.clone();
        for part in std::mem::take(&mut frozen.tabled) {
            let gain = part.gain.at(c64::new(0.0, TAU * frequency_hz));
            let add = |to: &MatrixPolynomial, factor: f64| {
                MatrixPolynomial::combination(1.0, to, factor, &part.stiffness)
            };
            frozen.stiffness = add(&frozen.stiffness, gain.re);
            frozen.structural = Some(match &frozen.structural {
                Some(lost) => add(lost, gain.im),
                None => {
                    MatrixPolynomial::combination(gain.im, &part.stiffness, 0.0, &part.stiffness)
                }
            });
        }
        Cow::Owned(frozen)
    }

    /// The same tangent with its real stiffness referred to another frequency, from which the parts of tables differ less there.
    pub fn referred_to(&self, frequency_hz: f64) -> Self {
        let mut other = self.clone();
        for part in &mut other.tabled {
            let before = part.gain.reference();
            part.gain.reference_hz = frequency_hz;
            let change = part.gain.reference() - before;
            other.stiffness =
                MatrixPolynomial::combination(1.0, &other.stiffness, change, &part.stiffness);
        }
        other
    }

    /// The first table that does not hold a frequency, Hz.
    pub fn table_without(&self, frequency_hz: f64) -> Option<&Arc<ModulusTable>> {
        let mut tables = self.tabled.iter().map(|part| &part.gain.table);
        tables.find(|table| !table.covers(frequency_hz))
    }
}
