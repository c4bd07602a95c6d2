//! Right and left vectors of waves, and what small changes of the model do to their eigenvalues.

use super::vectors::{ZERO, dot, normalize};
use crate::cea::ModeBranch;
use crate::linalg::banded::{BandedLu, multiply_band};
use crate::linalg::c64;
use crate::prestress::{HarmonicTangent, MovingHarmonic, WaveTangent};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Rayleigh quotient iterations of one branch at most, each with two solves of either side.
const ITERATIONS: usize = 8;

/// Change of an eigenvalue relative to it at which its vectors have settled to the square of that.
const SETTLED: f64 = 1e-8;

/// Distance relative to an eigenvalue from that of its branch above which it is another's: small spaces leave out far less.
const LOST: f64 = 1e-3;

/// Step of the friction coefficient: the matrices are quadratic in it, of which the central difference is exact.
const FRICTION_STEP: f64 = 1e-3;

/// The eigenpair of a branch at one friction coefficient, over the unknowns of its whole harmonic.
#[derive(Clone, Debug)]
pub struct WavePair {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Branch within the harmonic.
    pub branch: usize,
    /// Direction of travel of the branch.
    pub direction: i8,
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Eigenvalue `lambda`, rad/s.
    pub eigenvalue: c64,
    /// `d lambda / d mu`, rad/s.
    pub derivative: c64,
    /// Whether the branch is the wave `-n`: the complex conjugate of a root of the wave `+n`'s problem with `Im < 0`.
    is_backward: bool,
    /// The root of the wave `+n`.
    root: c64,
    right: Vec<c64>,
    left: Vec<c64>,
    /// `y^H (2 lambda M + C) x`.
    slope: c64,
}

/// The eigenpairs of branches, each at a friction coefficient: `None` where the branch does not oscillate there, and where
/// Rayleigh quotient iteration does not find its eigenvalue again.
pub fn wave_pairs(tangent: &WaveTangent, wanted: &[(&ModeBranch, f64)]) -> Vec<Option<WavePair>> {
    let numbers = wanted.iter().map(|(branch, _)| (branch.harmonic, ()));
    let numbers: BTreeMap<usize, ()> = numbers.collect();
    let harmonics: BTreeMap<usize, HarmonicTangent> =
        numbers.into_par_iter().map(|(n, ())| (n, tangent.harmonic(n))).collect();
    let direction = tangent.sliding_direction;
    let pair = |&(branch, friction): &(&ModeBranch, f64)| {
        let is_backward = f64::from(branch.direction) * direction > 0.0;
        pair_of(&harmonics[&branch.harmonic], (branch, friction), is_backward)
    };
    wanted.par_iter().map(pair).collect()
}

/// A model with a parameter beside its value, as a term of a difference quotient.
pub struct Beside {
    /// Weight in the quotient.
    pub weight: f64,
    /// Its linearisation.
    pub tangent: WaveTangent,
    /// What its friction coefficient has more than that of the eigenpairs.
    pub friction_shift: f64,
}

/// `d lambda / d p` of each pair from models with the parameter `p` beside its value,
///
/// ```text
/// d lambda = - y^H (lambda^2 dM + lambda dC + dK) x / y^H (2 lambda M + C) x
/// ```
///
/// with left and right vectors of one harmonic, so that waves `n` and `-n` that coincide at `mu = 0` do no harm. The base state
/// follows. `None` where the unknowns change with the parameter.
pub fn wave_responses(pairs: &[&WavePair], quotient: &[Beside]) -> Option<Vec<c64>> {
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    let place = |i: usize| (pairs[i].harmonic, pairs[i].friction_coefficient.to_bits());
    order.sort_by_key(|&i| place(i));
    let mut responses = vec![ZERO; pairs.len()];
    for of_harmonic in order.chunk_by(|a, b| pairs[*a].harmonic == pairs[*b].harmonic) {
        let n = pairs[of_harmonic[0]].harmonic;
        let sides: Vec<HarmonicTangent> =
            quotient.iter().map(|own| own.tangent.harmonic(n)).collect();
        for alike in of_harmonic.chunk_by(|a, b| place(*a) == place(*b)) {
            let friction = pairs[alike[0]].friction_coefficient;
            let terms = quotient.iter().zip(&sides);
            let terms =
                terms.map(|(own, side)| (own.weight, side.at(friction + own.friction_shift)));
            let change = MovingHarmonic::combined(&terms.collect::<Vec<_>>())?;
            for &i in alike {
                responses[i] = pairs[i].response(&change)?;
            }
        }
    }
    Some(responses)
}

impl WavePair {
    /// Change of the eigenvalue where the matrices change; `None` of matrices of other unknowns.
    fn response(&self, change: &MovingHarmonic) -> Option<c64> {
        let MovingHarmonic { half_bandwidth: h, mass, damping, stiffness } = change;
        if mass.len() != self.right.len() * (2 * h + 1) {
            return None;
        }
        let form = |band: &[c64]| form(band, *h, &self.left, &self.right);
        let changed = self.root * (self.root * form(mass) + form(damping)) + form(stiffness);
        Some(of_wave(-changed / self.slope, self.is_backward))
    }
}

/// What belongs to a branch of what belongs to the wave `+n`, and the other way round.
fn of_wave(value: c64, is_backward: bool) -> c64 {
    if is_backward { value.conj() } else { value }
}

/// `y^H A x` of a band; changes are zero in most of it.
fn form(band: &[c64], h: usize, y: &[c64], x: &[c64]) -> c64 {
    let rows = band.chunks_exact(2 * h + 1).enumerate().zip(y);
    let images = rows.map(|((row, band), y)| {
        let entries = band.iter().enumerate().filter(|(_, value)| **value != ZERO);
        y.conj() * entries.map(|(k, value)| value * x[row + k - h]).sum::<c64>()
    });
    images.sum()
}

/// The pair of a branch, by two-sided Rayleigh quotient iteration from its eigenvalue.
fn pair_of(
    harmonic: &HarmonicTangent,
    (branch, friction): (&ModeBranch, f64),
    is_backward: bool,
) -> Option<WavePair> {
    let start = of_wave(branch.interpolate(friction)?, is_backward);
    let at = harmonic.at(friction);
    let count = at.dimension();
    let (mut right, mut left) = (any_vector(count, 0.3), any_vector(count, 1.1));
    let mut root = start;
    for _ in 0..ITERATIONS {
        let lu = factorized(&at, root);
        for _ in 0..2 {
            right = at.apply_slope(root, &right, false);
            lu.solve(&mut right);
            normalize(&mut right);
            left = at.apply_slope(root, &left, true);
            lu.solve_adjoint(&mut left);
            normalize(&mut left);
        }
        let last = root;
        root = rayleigh_quotient(&at, last, &right, &left);
        if (root - last).norm() <= SETTLED * root.norm() {
            break;
        }
    }
    // Not so of what is not a number.
    let is_it = (root - start).norm() <= LOST * start.norm();
    let mut pair = WavePair {
        harmonic: branch.harmonic,
        branch: branch.branch,
        direction: branch.direction,
        friction_coefficient: friction,
        eigenvalue: of_wave(root, is_backward),
        derivative: ZERO,
        is_backward,
        root,
        slope: dot(&left, &at.apply_slope(root, &right, false)),
        right,
        left,
    };
    let sides = [1.0, -1.0]
        .map(|sign| (0.5 * sign / FRICTION_STEP, harmonic.at(friction + sign * FRICTION_STEP)));
    pair.derivative = pair.response(&MovingHarmonic::combined(&sides)?)?;
    is_it.then_some(pair)
}

/// A vector with a part of every mode.
fn any_vector(count: usize, phase: f64) -> Vec<c64> {
    let entry = |i: usize| c64::new(1.0 + (1.7 * i as f64).sin(), (phase + 0.9 * i as f64).cos());
    (0..count).map(entry).collect()
}

/// `T(root)`, factorized.
fn factorized(at: &MovingHarmonic, root: c64) -> BandedLu {
    let entries = at.mass.iter().zip(&at.damping).zip(&at.stiffness);
    let band: Vec<c64> = entries.map(|((m, c), k)| k + root * (c + root * m)).collect();
    let mut lu = BandedLu::new(at.dimension(), at.half_bandwidth);
    lu.factorize(&band);
    lu
}

/// The root of `y^H T(.) x = 0` nearest to `near`.
fn rayleigh_quotient(at: &MovingHarmonic, near: c64, x: &[c64], y: &[c64]) -> c64 {
    let [m, c, k] = [&at.mass, &at.damping, &at.stiffness]
        .map(|band| dot(y, &multiply_band(band, at.half_bandwidth, x, false)));
    let root = (c * c - m * k * 4.0).sqrt();
    let [one, other] = [(root - c) / (m * 2.0), (-root - c) / (m * 2.0)];
    if (one - near).norm() <= (other - near).norm() { one } else { other }
}
