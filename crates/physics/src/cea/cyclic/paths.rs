//! All branches of one harmonic, followed together over the friction coefficient.

use super::follow::SHORTEST;
use super::reduction::Reduction;
use crate::cea::cyclic::*;
use std::rc::Rc;

/// The followed branches of one harmonic.
pub(super) struct HarmonicPaths {
    pub problem: HarmonicProblem,
    pub paths: Vec<Path>,
    /// `kappa` of the modes without friction and damping that they start from.
    pub at_rest: Vec<f64>,
    pub factorizations: usize,
    /// The small space of their vectors; `None` where they are over all unknowns.
    pub space: Option<Reduction>,
    /// What that leaves out of an eigenvalue, relative to it: the largest estimate at the largest friction coefficient.
    pub reduction_error: f64,
    /// What does not oscillate, where that was looked for: at each friction coefficient.
    pub overdamped: Vec<Overdamped>,
}

/// Motions that hardly oscillate as they decay, at one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overdamped {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Number of motions: real eigenvalues, those with a frequency below a tenth of their size, creep of the contact, and
    /// those beyond half of critical damping whose vectors it hides.
    pub count: usize,
    /// Their slowest and fastest decay, 1/s.
    pub decay: [f64; 2],
}

impl Overdamped {
    /// All of these at one friction coefficient.
    pub(super) fn joined(friction_coefficient: f64, all: impl Iterator<Item = Self>) -> Self {
        let none = Self { friction_coefficient, count: 0, decay: [f64::INFINITY, 0.0] };
        all.fold(none, |sum, own| Self {
            count: sum.count + own.count,
            decay: [sum.decay[0].min(own.decay[0]), sum.decay[1].max(own.decay[1])],
            ..sum
        })
    }
}

/// What is to be found of a harmonic.
pub(super) struct Range<'a> {
    /// Rising friction coefficients.
    pub grid: &'a [f64],
    /// Those of them at which vectors are kept.
    pub kept: &'a [f64],
    /// `kappa` at rest up to which modes are wanted ...
    pub wanted: f64,
    /// ... and up to which they are followed.
    pub margin: f64,
}

impl Range<'_> {
    /// The largest friction coefficient.
    pub fn highest_friction(&self) -> f64 {
        self.grid[self.grid.len() - 1]
    }
}

impl HarmonicPaths {
    /// Paths over all unknowns of their problem, from these `(kappa, x)` at rest.
    pub fn new(
        problem: HarmonicProblem,
        paths: Vec<Path>,
        pairs: &[(f64, Vec<f64>)],
        factorizations: usize,
    ) -> Self {
        let at_rest = pairs.iter().map(|pair| pair.0).collect();
        let (space, reduction_error, overdamped) = (None, 0.0, Vec::new());
        Self { problem, paths, at_rest, factorizations, space, reduction_error, overdamped }
    }

    /// A vector of a path over all unknowns.
    pub fn unknowns(&self, x: &[c64]) -> Vec<c64> {
        self.space.as_ref().map_or_else(|| x.to_vec(), |space| space.expand(x))
    }
}

/// Follows the branches with these `(kappa, x)` at rest; an error where one meets another or stops to oscillate.
pub(super) fn follow_pairs(
    problem: HarmonicProblem,
    pairs: &[(f64, Vec<f64>)],
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let harmonic = problem.tangent.harmonic;
    let lost = |friction: f64| CeaError::LostHarmonic { harmonic, friction };
    let mut follower = Follower::new(&problem);
    let (at_rest, mut paths) = (problem.at(0.0), Vec::new());
    for (branch, (kappa, shape)) in (1..).zip(pairs) {
        let started = start(&mut follower, &at_rest, branch, *kappa, shape);
        paths.extend(started.ok_or_else(|| lost(0.0))?);
    }
    for &friction in range.grid {
        // Most branches reach the grid value in one step and share its matrices.
        let shared = Rc::new(problem.at(friction));
        let mut matrices = |value: f64| {
            if value == friction { Rc::clone(&shared) } else { Rc::new(problem.at(value)) }
        };
        for path in &mut paths {
            if !follower.walk(&mut path.points, friction, SHORTEST, &mut matrices) {
                return Err(lost(friction));
            }
            describe(&problem, &shared, &mut path.points, range.kept);
        }
        if !are_distinct(&paths) {
            return Err(lost(friction)); // Two have come to one: another is lost.
        }
    }
    let factorizations = follower.factorizations;
    Ok(HarmonicPaths::new(problem, paths, pairs, factorizations))
}

/// Shares and uncertainty of the last point, which has the matrices `at`; the vectors of earlier ones are dropped but for those kept.
pub(super) fn describe(
    problem: &HarmonicProblem,
    at: &Matrices,
    points: &mut [Eigenpair],
    kept: &[f64],
) {
    let (earlier, last) = points.split_at_mut(points.len() - 1);
    for point in last {
        [point.contact_share, point.axial_share] = problem.shares(&point.x);
        point.uncertainty = problem.uncertainty(at, point);
    }
    for point in earlier.iter_mut().rev().take_while(|point| !point.x.is_empty()) {
        if !kept.contains(&point.parameter) {
            (point.x, point.y) = (Vec::new(), Vec::new());
        }
    }
}

/// First point of each path of one mode at rest. `None` where damping cannot be switched on continuously.
pub(super) fn start(
    follower: &mut Follower<'_>,
    at_rest: &Matrices,
    branch: usize,
    kappa: f64,
    shape: &[f64],
) -> Option<Vec<Path>> {
    let problem = follower.problem;
    let mut x: Vec<c64> = shape.iter().map(|v| c64::new(*v, 0.0)).collect();
    normalize(&mut x);
    let path = |waves: Waves, point: Eigenpair| Path { branch, waves, points: vec![point] };
    if problem.is_proportional() {
        let waves = if problem.tangent.is_standing { Waves::Forward } else { Waves::Both };
        let point = follower.at_rest(at_rest, c64::new(kappa, 0.0), x);
        return Some(vec![path(waves, point)]);
    }
    // From the undamped mode, damping grows to its full value; then friction starts.
    let undamped = c64::new(0.0, kappa.max(0.0).sqrt()); // lambda = i omega.
    let mut damped = vec![follower.at_rest(&problem.at_damping(0.0), undamped, x)];
    let mut matrices = |share: f64| Rc::new(problem.at_damping(share));
    if !follower.walk(&mut damped, 1.0, SHORTEST, &mut matrices) {
        return None;
    }
    let last = damped.pop()?;
    let conjugate = |v: &[c64]| v.iter().map(|v| v.conj()).collect::<Vec<_>>();
    let (theta, x) = (last.theta, last.x);
    let mirrored = follower.at_rest(at_rest, theta.conj(), conjugate(&x)); // The other root of one real problem, Im < 0.
    let mut paths = vec![path(Waves::Forward, follower.at_rest(at_rest, theta, x))];
    if !problem.tangent.is_standing {
        paths.push(path(Waves::Backward, mirrored));
    }
    Some(paths)
}

/// Whether no two paths have come to the same eigenpair.
pub(super) fn are_distinct(paths: &[Path]) -> bool {
    let ends: Vec<&Eigenpair> = paths.iter().filter_map(|path| path.points.last()).collect();
    ends.iter().enumerate().all(|(i, a)| ends[..i].iter().all(|b| !a.is_same(b, RESIDUAL_BOUND)))
}
