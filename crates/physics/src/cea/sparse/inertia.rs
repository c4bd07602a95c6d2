//! Modes below a frequency, counted by Sylvester's law of inertia.

use crate::cea::accuracy::HALF_THE_DIGITS;
use crate::linalg::{LinalgError, LuAnalysis, SparseLu, SparsityPattern};
use crate::prestress::SlidingTangent;
use std::sync::Arc;

/// Negative eigenvalues of what is factorized at an angular frequency. One beside a mode is moved by parts in 1e8 a few times.
pub(super) fn counted(
    frequency: f64,
    factorize: impl Fn(f64) -> Result<SparseLu, LinalgError>,
) -> Result<usize, LinalgError> {
    let count = |attempt: i32| {
        let moved = frequency * (1.0 + HALF_THE_DIGITS * f64::from(attempt));
        factorize(moved).map(|factors| factors.negative_count())
    };
    (1..5).fold(count(0), |outcome, attempt| outcome.or_else(|_| count(attempt)))
}

/// Number of modes without friction and damping below an angular frequency `omega`, rad/s, less the motions that `K` does not hold.
///
/// With the gyroscopic part `G = (C - C^T) / 2` the modes are where an eigenvalue of the Hermitian
///
/// ```text
/// H(omega) = K - omega^2 M + i omega G
/// ```
///
/// vanishes. At a mode `x` it falls by `omega x^H M x + x^H K x / omega`: where `K` is positive definite each mode makes one
/// eigenvalue negative, and their number is that of the modes. Each motion that `K` does not hold makes one negative at `omega = 0`,
/// and may make it positive again at a mode: with as many more the number is a bound. Counted in the real form
/// `[A -B; B A]` of `A + i B`, which has every eigenvalue twice.
pub(super) fn gyroscopic_count(tangent: &SlidingTangent, omega: f64) -> Result<usize, LinalgError> {
    let pattern = tangent.stiffness.pattern();
    let n = pattern.dimension();
    let positions = (0..n).flat_map(|j| {
        let rows = pattern.column(j).map(move |(_, i)| [i, j]);
        rows.flat_map(move |[i, j]| [[i, j], [i + n, j], [i, j + n], [i + n, j + n]])
    });
    let whole = SparsityPattern::from_positions(2 * n, positions.map(|[i, j]| (i, j)));
    let whole = Arc::new(whole);
    let analysis = LuAnalysis::new(&whole)?;
    let [stiffness, damping, mass] =
        [&tangent.stiffness, &tangent.damping, &tangent.mass].map(|own| own.evaluate(0.0));
    let negative = counted(omega, |omega| {
        let mut values = Vec::with_capacity(whole.nonzero_count());
        for column in 0..2 * n {
            for (_, row) in whole.column(column) {
                let (i, j) = (row % n, column % n);
                let own = pattern.position(i, j);
                let value = |all: &[f64], at: Option<usize>| at.map_or(0.0, |at| all[at]);
                let skew = || {
                    let other = value(&damping, pattern.position(j, i));
                    0.5 * omega * (value(&damping, own) - other) // omega (C - C^T) / 2.
                };
                values.push(match (row < n, column < n) {
                    (true, true) | (false, false) => {
                        value(&stiffness, own) - omega * omega * value(&mass, own) // A = K - omega^2 M.
                    }
                    (false, true) => skew(), // B = omega G.
                    (true, false) => -skew(),
                });
            }
        }
        SparseLu::symmetric(&analysis, values)
    })?;
    Ok(negative / 2) // Each eigenvalue is there twice.
}
