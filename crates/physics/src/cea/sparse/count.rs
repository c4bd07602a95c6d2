//! Eigenvalues in a part of the upper half plane, counted by the argument principle.

use crate::cea::sparse::*;
use crate::linalg::{Uncounted, ZeroCount, count_zeros};

/// Counts eigenvalues of `T(lambda; mu) = lambda^2 M + lambda C + K + i H` of a tangent.
///
/// Zeros of `det T / prod (lambda - lambda_k) (lambda - conj lambda_k)`, `lambda_k` all known eigenvalues, inside the edge of a region
/// are eigenvalues that are none of them; where the list is complete there are none, and few points on the edge serve.
pub struct ModeCounter<'a> {
    tangent: &'a SlidingTangent,
    analysis: LuAnalysis,
}

impl<'a> ModeCounter<'a> {
    /// A counter.
    ///
    /// # Errors
    /// Where stiffness depends on frequency: a table is no analytic function of `lambda`.
    pub fn new(tangent: &'a SlidingTangent) -> Result<Self, CeaError> {
        if let Some((gain, _)) = tangent.tabled().next() {
            return Err(CeaError::Failed(format!(
                "cea.count_modes needs matrices that are analytic in the eigenvalue: {} is a table \
                 over frequency",
                gain.table.key
            )));
        }
        Ok(Self { tangent, analysis: LuAnalysis::new(tangent.stiffness.pattern())? })
    }

    /// `ln det T(lambda; mu)`, up to multiples of `2 pi i`.
    ///
    /// # Errors
    /// At an eigenvalue.
    pub fn ln_determinant(&self, mu: f64, lambda: c64) -> Result<c64, LinalgError> {
        FullProblem::at(self.tangent, mu).sharing(&self.analysis).ln_determinant(lambda)
    }

    /// Eigenvalues of `region` at friction `mu` that are none of the `known`, of which those outside only smooth the way: none are
    /// counted where one lies on the edge.
    pub fn count(&self, mu: f64, known: &[c64], region: &CountedRegion) -> ModeCount {
        let problem = FullProblem::at(self.tangent, mu).sharing(&self.analysis);
        let ln_at = |lambda: c64| -> Result<c64, LinalgError> {
            let factors = known.iter().map(|own| (lambda - own).ln() + (lambda - own.conj()).ln());
            Ok(problem.ln_determinant(lambda)? - factors.sum::<c64>())
        };
        let scale = TAU * region.frequencies_hz[1];
        // Of the two determinants that a slope is taken from, near the real axis, too.
        let step = |at: c64| (NEAR * scale).min(0.02 * at.im);
        let mut count = ModeCount {
            friction_coefficient: mu,
            region: *region,
            known: known.iter().filter(|own| region.holds(**own)).count(), // Those outside only smooth the way.
            recovered: 0,
            missing: Ok(0),
            near: None,
            determinants: 0,
        };
        let mut determinants = 0;
        let found = count_zeros(&region.corners(), &step, &mut |points| {
            determinants += points.len();
            crate::parallel::map(points, ln_at)
        });
        match found {
            Ok(ZeroCount { count: missing, sum }) => {
                count.missing = Ok(missing); // Zeros that no known eigenvalue takes out.
                // Their mean, to some parts in a thousand of the highest frequency.
                count.near = (missing != 0).then(|| sum / missing as f64);
                count.determinants = determinants;
            }
            Err(Uncounted::Failed(error)) => {
                count.missing = Err(CeaError::from(error).to_string());
            }
            Err(Uncounted::OnEdge(at)) => {
                let (frequency_hz, growth_rate) = (at.im / TAU, at.re);
                count.missing = Err(format!(
                    "not counted: an eigenvalue lies at or near {frequency_hz:.1} Hz with a \
                     growth rate of about {growth_rate:.1} 1/s, on the edge of the count. Move \
                     cea.max_frequency_hz or cea.modes"
                ));
            }
        }
        count
    }
}
