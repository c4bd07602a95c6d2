//! Right and left vectors of waves, and what small changes of the model do to their eigenvalues.

use super::branch::point_of;
use crate::cea::cyclic::*;
use crate::fem::own_frequency_step;
use crate::linalg::vectors::dot;
use crate::prestress::MovingHarmonic;
use std::collections::{BTreeMap, BTreeSet};

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
    /// Of the wave `-n` the eigenvalue is the complex conjugate of a root of the wave `+n`'s problem with `Im < 0`.
    waves: Waves,
    /// The root of the wave `+n`.
    root: c64,
    right: Vec<c64>,
    left: Vec<c64>,
    /// `y^H (2 lambda M + C) x`.
    slope: c64,
    /// `y^H (dK / d omega) x` of stiffness that depends on frequency, over that.
    own_slope: Option<c64>,
}

/// The eigenpairs of branches, each at a friction coefficient: `None` where the branch does not oscillate there, and where
/// Rayleigh quotient iteration does not find its eigenvalue again.
pub fn wave_pairs(tangent: &WaveTangent, wanted: &[(&ModeBranch, f64)]) -> Vec<Option<WavePair>> {
    let numbers: BTreeSet<usize> = wanted.iter().map(|(branch, _)| branch.harmonic).collect();
    let harmonics: BTreeMap<usize, HarmonicProblem> =
        crate::parallel::map(numbers, |n| (n, HarmonicProblem::new(tangent.harmonic(n), true)));
    let direction = tangent.sliding_direction;
    let pair = |&(branch, friction): &(&ModeBranch, f64)| {
        let is_backward = f64::from(branch.direction) * direction > 0.0;
        let waves = if is_backward { Waves::Backward } else { Waves::Forward }; // The wave -n travels with the rotor.
        pair_of(&harmonics[&branch.harmonic], (branch, friction), waves)
    };
    crate::parallel::map(wanted, pair)
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
    let mut responses = vec![c64::ZERO; pairs.len()];
    // Where matrices alone change, it is their quotient that has harmonics.
    let sides: Vec<_> = quotient.iter().map(|own| (own.weight, &own.tangent)).collect();
    let is_shifted = quotient.iter().any(|own| own.friction_shift != 0.0);
    let side = |own: &Beside| (own.weight, own.tangent.clone(), own.friction_shift);
    let sides = match WaveTangent::quotient(&sides).filter(|_| !is_shifted) {
        Some(sum) => vec![(1.0, sum, 0.0)],
        None => quotient.iter().map(side).collect(),
    };
    for of_harmonic in order.chunk_by(|a, b| pairs[*a].harmonic == pairs[*b].harmonic) {
        let n = pairs[of_harmonic[0]].harmonic;
        let harmonics: Vec<_> = sides.iter().map(|(_, side, _)| side.harmonic(n)).collect();
        for alike in of_harmonic.chunk_by(|a, b| place(*a) == place(*b)) {
            let friction = pairs[alike[0]].friction_coefficient;
            let terms = sides.iter().zip(&harmonics);
            let terms = terms.map(|((weight, _, shift), own)| (*weight, own.at(friction + shift)));
            let change = combined(&terms.collect::<Vec<_>>())?;
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
        let h = change.half_bandwidth;
        if change.matrices.mass.len() != self.right.len() * (2 * h + 1) {
            return None;
        }
        let changed = dot(&self.left, &change.apply(self.root, &self.right, false)); // y^H (lambda^2 dM + lambda dC + dK) x.
        let step = -changed / self.slope;
        let own = self.own_slope.map(|own| own_frequency_step(step, own));
        Some(self.waves.own(own.unwrap_or(step)))
    }
}

/// A sum of matrices of the same unknowns, each with its weight; `None` where the unknowns differ.
fn combined(terms: &[(f64, MovingHarmonic)]) -> Option<MovingHarmonic> {
    let MovingHarmonic { half_bandwidth, ref matrices } = terms.first()?.1;
    let sizes = |own: &MotionMatrices<Vec<c64>>| own.each().map(Vec::len).collect::<Vec<_>>();
    let is_alike = |own: &MovingHarmonic| {
        own.half_bandwidth == half_bandwidth && sizes(&own.matrices) == sizes(matrices)
    };
    let are_alike = terms.iter().all(|(_, own)| is_alike(own));
    let mut sum = are_alike.then(|| matrices.map(|own| vec![c64::ZERO; own.len()]))?;
    for (weight, own) in terms {
        for (sum, values) in sum.each_mut().zip(own.matrices.each()) {
            sum.iter_mut().zip(values).for_each(|(sum, v)| *sum += v * *weight);
        }
    }
    Some(MovingHarmonic { half_bandwidth, matrices: sum })
}

/// The pair of a branch, by two-sided Rayleigh quotient iteration from its eigenvalue.
fn pair_of(
    problem: &HarmonicProblem,
    (branch, friction): (&ModeBranch, f64),
    waves: Waves,
) -> Option<WavePair> {
    let start = branch.interpolate(friction)?;
    let guess = waves.own(problem.theta(start));
    let at = problem.at(friction);
    let found = Follower::new(problem).find(&at, friction, guess)?;
    let BranchPoint { eigenvalue, rate, .. } = point_of(problem, waves, &found);
    let is_it = (eigenvalue - start).norm() <= BESIDE * start.norm(); // Not so of what is not a number.
    let (root, right, left) = (waves.own(eigenvalue), found.x, found.y); // Back to the root of +n.
    let slope = dot(&left, &at.now.apply_slope(root, &right, false));
    let own_slope = problem.own_slope(&at, root, [&right, &left]).map(|own| own / slope);
    is_it.then_some(WavePair {
        harmonic: branch.harmonic,
        branch: branch.branch,
        direction: branch.direction,
        friction_coefficient: friction,
        eigenvalue,
        derivative: rate,
        waves,
        root,
        right,
        left,
        slope,
        own_slope,
    })
}
