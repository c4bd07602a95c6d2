//! The dashpots of friction across the sliding, which grow without bound as the sliding slows down.

use crate::cea::counted::NEARLY_CRITICAL;
use crate::cea::cyclic::*;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::dense::dot;
use crate::prestress::FrictionPolynomial;

/// `A = int p_0 / V d d^T dA` of one harmonic: `mu A` damps the motion across the sliding.
///
/// Fast sliding leaves that motion free, slow sliding holds it: `mu p_0 / V` has no bound. A reduced space that serves both holds the
/// modes of both limits.
pub(super) struct Across {
    /// `A` over the unknowns of the harmonic, N s/m.
    pub dashpots: BandedMatrix,
    /// What friction that falls with the speed adds along the sliding, by power of `i mu`, N s/m; it stays finite.
    pub along: FrictionPolynomial,
    /// Number of unknowns that `A` acts on: a bound of its rank.
    pub rank: usize,
}

impl Across {
    /// The dashpots on these `unknowns`, out of all those of friction.
    pub fn new(harmonic: &HarmonicTangent, unknowns: &[usize]) -> Self {
        let zeros = || {
            let mass = &harmonic.mass[0];
            BandedMatrix::zeros(mass.dimension(), mass.half_bandwidth())
        };
        let mut along = harmonic.friction_dashpots.clone().unwrap_or_else(|| vec![zeros()]);
        let mut dashpots = zeros();
        for &row in unknowns {
            for &column in unknowns.iter().filter(|c| along[0].columns(row).contains(c)) {
                dashpots.add(row, column, along[0].get(row, column));
            }
        }
        along[0].add_scaled(-1.0, &dashpots); // What is left acts along the sliding.
        let damped = (0..dashpots.dimension()).filter(|&k| dashpots.get(k, k) > 0.0);
        Self { rank: damped.count(), dashpots, along }
    }

    /// Whether they damp a mode at rest strongly at a friction coefficient, `mu x^T A x / (2 sqrt(kappa)) > 1/4`.
    pub fn are_strong(&self, modes: &Modes, friction_coefficient: f64) -> bool {
        let ratio = |(kappa, x): &(f64, Vec<f64>)| {
            friction_coefficient * dot(x, &self.dashpots.multiply(x)) / (2.0 * kappa.sqrt())
        };
        modes.iter().any(|mode| ratio(mode) > 0.5 * NEARLY_CRITICAL)
    }

    /// Modes below `kappa` with the motion across the sliding held by stiff springs in place of the dashpots.
    pub fn held_modes(&self, pencil: &Pencil, kappa: f64) -> Modes {
        let stiffest = (0..self.dashpots.dimension())
            .filter(|&k| self.dashpots.get(k, k) > 0.0)
            .map(|k| pencil.stiffness.get(k, k) / self.dashpots.get(k, k))
            .fold(0.0, f64::max); // s A_ii >= K_ii for every i.
        let held = pencil.stiffened(stiffest / NEAR, &self.dashpots); // K + s A, far stiffer than the body wherever A acts.
        held.map_or_else(Vec::new, |held| held.lowest(held.count_below(kappa)))
    }
}
