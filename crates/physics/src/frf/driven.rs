//! A system between two ports, and its sparse factorizations.

use super::{FrfError, FrfSystem, Port};
use crate::linalg::{ComplexSparseLu, LinalgError, LuAnalysis, SparseLu, c64};

/// Factors of a frequency by which a factorization evades an undamped resonance: beside it it serves as well.
pub(super) const BESIDE: [f64; 3] = [1.0, 1.000_7, 0.999_1];

/// A system that is excited at one port and observed at another, with the symbolic factorizations of its pattern.
pub(super) struct Driven<'a> {
    pub system: &'a FrfSystem,
    pub force: &'a Port,
    pub response: &'a Port,
    pub lu: LuAnalysis,
}

impl<'a> Driven<'a> {
    pub fn of(
        system: &'a FrfSystem,
        [force, response]: [&'a Port; 2],
        frequency_hz: f64,
    ) -> Result<Self, FrfError> {
        let fail = |source| FrfError::Factorization { frequency_hz, source };
        let lu = LuAnalysis::new(&system.pattern).map_err(fail)?;
        Ok(Self { system, force, response, lu })
    }

    /// One line by a complex factorization of its own.
    pub fn factorized(&self, frequency_hz: f64) -> Result<c64, FrfError> {
        let force = self.force.complex_force(self.system.dimension());
        Ok(self.response.observe(&self.factors(frequency_hz)?.solve_refined(&force)))
    }

    /// Factors of `K + i H + i omega C - omega^2 M`.
    pub fn factors(&self, frequency_hz: f64) -> Result<ComplexSparseLu, FrfError> {
        let values = self.system.dynamic_stiffness(frequency_hz);
        let factors = ComplexSparseLu::factorize(&self.lu, values);
        factors.map_err(|source| FrfError::Factorization { frequency_hz, source })
    }

    /// Real factors of `K - omega^2 M`, at or beside a frequency.
    pub fn real_factors(&self, frequency_hz: f64) -> Result<SparseLu, FrfError> {
        let factorized = |moved: f64| -> Result<SparseLu, LinalgError> {
            SparseLu::factorize(&self.lu, self.system.undamped_stiffness(frequency_hz * moved))
        };
        let [first, others @ ..] = BESIDE;
        let found = others
            .iter()
            .fold(factorized(first), |found, moved| found.or_else(|_| factorized(*moved)));
        found.map_err(|source| FrfError::Factorization { frequency_hz, source })
    }
}
