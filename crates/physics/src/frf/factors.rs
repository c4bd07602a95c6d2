//! Sparse factorizations of the dynamic stiffness.

use super::{FrfError, FrfSystem, Port};
use crate::linalg::{ComplexSparseLu, LdlAnalysis, LinalgError, LuAnalysis, c64};

/// Symbolic factorizations of the system's pattern.
pub(super) struct Analyses {
    pub lu: LuAnalysis,
    pub ldl: LdlAnalysis,
}

impl Analyses {
    pub(super) fn of(system: &FrfSystem) -> Result<Self, LinalgError> {
        Ok(Self { lu: LuAnalysis::new(&system.pattern)?, ldl: LdlAnalysis::new(&system.pattern)? })
    }
}

/// One line by a complex factorization of its own.
pub(super) fn factorized(
    system: &FrfSystem,
    analysis: &LuAnalysis,
    force: &Port,
    response: &Port,
    frequency_hz: f64,
) -> Result<c64, FrfError> {
    let values = system.dynamic_stiffness(frequency_hz);
    let lu = ComplexSparseLu::factorize(analysis, values)
        .map_err(|source| FrfError::Factorization { frequency_hz, source })?;
    Ok(response.observe(&lu.solve_refined(&force.complex_force(system.dimension()))))
}
