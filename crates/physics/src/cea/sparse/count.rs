//! Eigenvalues in a part of the upper half plane, counted by the argument principle.

use super::full_problem::{FullProblem, SharedAnalysis};
use crate::cea::{CeaError, CountedRegion, ModeCount};
use crate::linalg::{LinalgError, c64};
use crate::prestress::SlidingTangent;
use std::f64::consts::{PI, TAU};

/// Distance of the two determinants that a slope is taken from, relative to the upper end of the frequencies ...
const STEP: f64 = 1e-4;
/// ... and, near the real axis, to the frequency.
const STEP_BELOW: f64 = 0.02;
/// Steps in the shortest piece of the edge: an eigenvalue this near lies on it.
const SHORTEST: f64 = 20.0;
/// Difference of the logarithm of the determinant and of what its slopes predict that is none.
const AGREEMENT: f64 = 0.25;
/// Pieces of the edge beyond which the count is given up.
const MOST_PIECES: usize = 600;

/// Counts eigenvalues of `T(lambda; mu) = lambda^2 M + lambda C + K + i H` of a tangent.
///
/// The winding number of `f = det T / prod (lambda - lambda_k) (lambda - conj lambda_k)`, `lambda_k` all known eigenvalues, about the
/// edge of a region is the number of eigenvalues inside that are none of them,
///
/// ```text
/// N = 1 / (2 pi i) int f' / f dlambda,    sum of the missing = 1 / (2 pi i) int lambda f' / f dlambda.
/// ```
///
/// Where the list is complete, `f` has no zero nearby, and few points on the edge serve. Source: L. V. Ahlfors, Complex Analysis (1979),
/// section 4.5.2.
pub struct ModeCounter<'a> {
    tangent: &'a SlidingTangent,
    analysis: SharedAnalysis,
}

impl<'a> ModeCounter<'a> {
    /// A counter.
    ///
    /// # Errors
    /// Where stiffness depends on frequency: a table is no analytic function of `lambda`.
    pub fn new(tangent: &'a SlidingTangent) -> Result<Self, CeaError> {
        if let Some(part) = tangent.tabled.first() {
            return Err(CeaError::Failed(format!(
                "cea.count_modes needs matrices that are analytic in the eigenvalue: {} is a table \
                 over frequency",
                part.gain.table.key
            )));
        }
        Ok(Self { tangent, analysis: SharedAnalysis::default() })
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
        let problem = Reduced { problem, known };
        let mut edge =
            Edge { problem: &problem, scale: TAU * region.frequencies_hz[1], determinants: 0 };
        let mut count = ModeCount {
            friction_coefficient: mu,
            region: *region,
            known: known.iter().filter(|own| region.holds(**own)).count(),
            recovered: 0,
            missing: Ok(0),
            near: None,
            determinants: 0,
        };
        match edge.integrate(&corners(region)) {
            Ok(sums) => {
                // Of an integral over 2 pi i.
                let [winding, moment] = sums.map(|sum| c64::new(sum.im, -sum.re) / TAU);
                let missing = winding.re.round();
                count.missing = Ok(missing as i64);
                // Their mean, to some parts in a thousand of the highest frequency.
                count.near = (missing != 0.0).then(|| moment / missing);
                count.determinants = edge.determinants;
            }
            Err(error) => count.missing = Err(error.to_string()),
        }
        count
    }
}

/// Corners of a region, counter-clockwise.
fn corners(region: &CountedRegion) -> [c64; 4] {
    let [low, high] = region.frequencies_hz.map(|hz| TAU * hz);
    let [left, right] = region.growth_rates;
    [(left, low), (right, low), (right, high), (left, high)].map(|(re, im)| c64::new(re, im))
}

/// `det T` at one friction coefficient without the factors of the known eigenvalues.
struct Reduced<'a> {
    problem: FullProblem<'a>,
    known: &'a [c64],
}

impl Reduced<'_> {
    fn ln_at(&self, lambda: c64) -> Result<c64, LinalgError> {
        let known = self.known.iter();
        let factors = known.map(|own| (lambda - own).ln() + (lambda - own.conj()).ln());
        Ok(self.problem.ln_determinant(lambda)? - factors.sum::<c64>())
    }
}

/// `ln f` at a point of the edge, its imaginary part up to multiples of `2 pi`, and its slope.
#[derive(Clone, Copy)]
struct Sample {
    at: c64,
    ln: c64,
    slope: c64,
}

/// The edge of a region, on its way to the integral.
struct Edge<'a> {
    problem: &'a Reduced<'a>,
    /// Upper end of the frequencies, rad/s.
    scale: f64,
    determinants: usize,
}

impl Edge<'_> {
    /// `int d ln f` and `int lambda d ln f` around the corners: pieces are halved until the phase of each half is that which the slopes
    /// predict.
    fn integrate(&mut self, corners: &[c64; 4]) -> Result<[c64; 2], CeaError> {
        let middles = [0, 1, 2, 3].map(|i| 0.5 * (corners[i] + corners[(i + 1) % 4]));
        let samples = self.samples(&[corners.as_slice(), &middles].concat())?;
        let mut open: Vec<[Sample; 3]> =
            (0..4).map(|i| [samples[i], samples[4 + i], samples[(i + 1) % 4]]).collect();
        let (mut sums, mut pieces) = ([c64::new(0.0, 0.0); 2], open.len());
        while !open.is_empty() {
            let mut rough = Vec::new();
            for piece in open {
                let Some(own) = integral(&piece) else {
                    rough.push(piece);
                    continue;
                };
                sums[0] += own[0];
                sums[1] += own[1];
            }

            // Halves of the rest, all new points at once.
            pieces += rough.len();
            for piece in &rough {
                let [from, middle, to] = piece.map(|sample| sample.at);
                if pieces > MOST_PIECES || (to - from).norm() < SHORTEST * self.step(middle) {
                    let (frequency_hz, growth_rate) = (middle.im / TAU, middle.re);
                    return Err(CeaError::Failed(format!(
                        "not counted: an eigenvalue lies at or near {frequency_hz:.1} Hz with a \
                         growth rate of about {growth_rate:.1} 1/s, on the edge of the count. Move \
                         cea.max_frequency_hz or cea.modes"
                    )));
                }
            }
            let quarters = rough.iter().flat_map(|piece| {
                let at = piece.map(|sample| sample.at);
                [0.5 * (at[0] + at[1]), 0.5 * (at[1] + at[2])]
            });
            let new = self.samples(&quarters.collect::<Vec<c64>>())?;
            let halves = rough.iter().zip(new.chunks(2));
            open = halves
                .flat_map(|(piece, new)| {
                    let [from, middle, to] = *piece;
                    [[from, new[0], middle], [middle, new[1], to]]
                })
                .collect();
        }
        Ok(sums)
    }

    fn step(&self, at: c64) -> f64 {
        (STEP * self.scale).min(STEP_BELOW * at.im)
    }

    /// `ln f` half a step to either side of each point, their mean and their slope.
    fn samples(&mut self, points: &[c64]) -> Result<Vec<Sample>, CeaError> {
        self.determinants += 2 * points.len();
        let sides = points.iter().flat_map(|&at| {
            let half = 0.5 * self.step(at);
            [at - half, at + half]
        });
        let found: Result<Vec<c64>, LinalgError> =
            crate::parallel::map(sides, |lambda| self.problem.ln_at(lambda));
        let found = found?;
        let pairs = points.iter().zip(found.chunks(2));
        Ok(pairs
            .map(|(&at, ends)| {
                let change = least(ends[1] - ends[0]);
                Sample { at, ln: ends[0] + 0.5 * change, slope: change / self.step(at) }
            })
            .collect())
    }
}

/// A difference of logarithms without full turns.
fn least(change: c64) -> c64 {
    c64::new(change.re, (change.im + PI).rem_euclid(TAU) - PI)
}

/// `int d ln f` and `int lambda d ln f` over a piece of the edge with its middle; `None` where slopes and phases disagree.
///
/// With `d` the whole length, the parabola through the slopes predicts `d (5 s_0 + 8 s_1 - s_2) / 24` of the first half; the phases then
/// say which full turns it lacks, and by how much it errs. The moment is integrated by parts.
fn integral(piece: &[Sample; 3]) -> Option<[c64; 2]> {
    let [from, middle, to] = piece;
    let whole = to.at - from.at;
    let mut sums = [c64::new(0.0, 0.0); 2];
    let halves = [([from, middle, to], [5.0, 8.0, -1.0]), ([middle, to, from], [8.0, 5.0, -1.0])];
    for ([near, far, other], weights) in halves {
        let slopes = near.slope * weights[0] + far.slope * weights[1] + other.slope * weights[2];
        let predicted = whole * slopes / 24.0;
        let error = least(far.ln - near.ln - predicted);
        if error.norm().is_nan() || error.norm() > AGREEMENT {
            return None;
        }
        let change = predicted + error;
        let length = far.at - near.at;
        sums[0] += change;
        sums[1] +=
            0.5 * (near.at + far.at) * change - length * length * (near.slope - far.slope) / 12.0;
    }
    Some(sums)
}
