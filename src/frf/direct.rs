//! Direct solution at each frequency.

use super::system::check_frequencies;
use super::{FrfError, FrfSystem};
use crate::linalg::{ComplexSparseLu, LuAnalysis};
use faer::c64;
use rayon::prelude::*;

/// A response computed line by line.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectResponse {
    /// Receptance `u / f` for each frequency, m/N for each metre of thickness.
    pub receptance: Vec<c64>,
}

/// Receptance between two unknowns, `h = e_response^T (K + i omega C - omega^2 M)^{-1} e_force`.
///
/// One sparse complex LU factorization for each frequency, with one step of refinement; frequencies in
/// parallel, the result independent of their number of threads. For a body of thickness `b` divide by
/// `b`.
///
/// # Errors
/// [`FrfError::Frequency`]; [`FrfError::Factorization`] where an undamped system is at resonance.
pub fn direct_response(
    system: &FrfSystem,
    force: usize,
    response: usize,
    frequencies_hz: &[f64],
) -> Result<DirectResponse, FrfError> {
    check_frequencies(frequencies_hz)?;
    let fail = |frequency_hz, source| FrfError::Factorization {
        frequency_hz,
        source,
    };
    let first = frequencies_hz.first().copied().unwrap_or(0.0);
    let analysis = LuAnalysis::new(system.pattern()).map_err(|e| fail(first, e))?;
    let mut unit = vec![c64::new(0.0, 0.0); system.dimension()];
    unit[force] = c64::new(1.0, 0.0);
    let receptance = frequencies_hz
        .par_iter()
        .map(|f| {
            let values = system.dynamic_stiffness(*f);
            let lu = ComplexSparseLu::factorize(&analysis, values).map_err(|e| fail(*f, e))?;
            Ok(lu.solve_refined(&unit)[response])
        })
        .collect::<Result<Vec<c64>, FrfError>>()?;
    Ok(DirectResponse { receptance })
}
