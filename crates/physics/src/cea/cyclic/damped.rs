//! All eigenvalues of a harmonic whose motion across the sliding friction damps strongly.
//!
//! On the way from friction 0 such modes stop to oscillate, and others begin to. No branch need
//! lead from one end of the range to the other. So all eigenvalues of the reduced problem are
//! computed at every friction coefficient; branches are what leads from one to the next.

use super::paths::{Overdamped, Range, describe, start};
use crate::cea::counted::NEARLY_CRITICAL;
use crate::cea::cyclic::*;
use crate::linalg::dense_eigen::complex_eigenvalues;
use std::rc::Rc;

/// The shortest step of a branch over the step of friction: a branch that turns faster begins or ends there.
const SHORTEST: f64 = 5e-3;

/// Rayleigh quotients that take an eigenvalue to the stiffness of its own frequency.
const QUOTIENTS: usize = 4;

/// Branches that do not reach back to rest are numbered from here on, beyond those at rest: how many of these lie below a bound changes
/// with the model, and with it names would.
const FIRST_BORN: usize = 1000;

/// Branches of a harmonic, starting from these `(kappa, x)` at rest, complete at every friction coefficient of the range.
pub(super) fn follow_damped(
    problem: HarmonicProblem,
    pairs: &[(f64, Vec<f64>)],
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let mut course = Course {
        problem: &problem,
        follower: Follower::new(&problem),
        largest: range.margin.sqrt(), // kappa = omega^2.
        paths: Vec::new(),
        next_branch: (pairs.len() + 1).max(FIRST_BORN),
    };
    let at_rest = problem.at(0.0);
    for (branch, (kappa, shape)) in (1..).zip(pairs) {
        let started = start(&mut course.follower, &at_rest, branch, *kappa, shape);
        course.paths.extend(started.into_iter().flatten().map(Tracked::new));
    }
    let (mut before, mut overdamped) = (0.0, Vec::new());
    for &friction in range.grid {
        overdamped.push(course.step(before, friction)?);
        course.describe(friction, range.kept);
        before = friction;
    }
    let factorizations = course.follower.factorizations;
    let paths = course.paths.into_iter().map(|tracked| tracked.path).collect();
    Ok(HarmonicPaths { overdamped, ..HarmonicPaths::new(problem, paths, pairs, factorizations) })
}

/// A branch and how far it has come.
struct Tracked {
    path: Path,
    /// Points up to the last friction coefficient of the range.
    reached: usize,
    /// Whether it is still followed.
    is_open: bool,
}

impl Tracked {
    fn new(path: Path) -> Self {
        Self { reached: path.points.len(), path, is_open: true }
    }

    fn last(&self) -> &Eigenpair {
        self.path.points.last().expect("a path has a first point")
    }
}

struct Course<'a> {
    problem: &'a HarmonicProblem,
    follower: Follower<'a>,
    /// Largest modulus of the eigenvalues, rad/s.
    largest: f64,
    paths: Vec<Tracked>,
    next_branch: usize,
}

impl Course<'_> {
    /// Takes every branch to the next friction coefficient, and adds those of the eigenvalues that none has come to.
    fn step(&mut self, before: f64, friction: f64) -> Result<Overdamped, CeaError> {
        // All eigenvalues, whatever the branches do; then the branches, whatever the eigenvalues are.
        let shared = Rc::new(self.problem.at(friction));
        let mut all = spectrum(self.problem, &shared, self.largest)?;
        let was_open: Vec<usize> =
            (0..self.paths.len()).filter(|&index| self.paths[index].is_open).collect();
        self.advance(before, friction, &shared);
        if self.problem.is_tabled() {
            all = self.settled(&all, friction, &shared);
        }
        // Every branch claims the eigenvalue that it has come to; two cannot share one.
        let mut is_claimed = vec![false; all.len()];
        for tracked in self.paths.iter_mut().filter(|tracked| tracked.is_open) {
            let theta = tracked.last().theta;
            let free = (0..all.len()).filter(|&k| !is_claimed[k]);
            let nearest =
                free.min_by(|&a, &b| (all[a] - theta).norm().total_cmp(&(all[b] - theta).norm()));
            match nearest.filter(|&k| (all[k] - theta).norm() <= SAME_EIGENVALUE * theta.norm()) {
                Some(k) => is_claimed[k] = true,
                None => {
                    tracked.path.points.truncate(tracked.reached); // Back to where it was one of all.
                    tracked.is_open = false;
                }
            }
        }
        // What none has come to is a branch of its own, or one that was lost on the way.
        let is_wanted = |value: &c64| {
            let is_own = value.im > 0.0 || !self.problem.tangent.is_standing;
            is_own && value.norm() <= self.largest && !self.is_overdamped(value)
        };
        let mut missing: Vec<c64> = all
            .iter()
            .zip(&is_claimed)
            .filter(|(value, claimed)| !**claimed && is_wanted(value))
            .map(|(value, _)| *value)
            .collect();
        // Those near the bound come last, so that no other's number depends on them.
        crate::order::sort_by_number(&mut missing, |a| a.norm());
        let mut creeping = Vec::new();
        for value in missing {
            let found = self.found(value, friction, &shared);
            match found {
                Some(found) => self.add(value, found, before, &was_open),
                None if -value.re > NEARLY_CRITICAL * value.norm() => creeping.push(value), // Creep that dashpots hide.
                None => {
                    let harmonic = self.problem.tangent.harmonic;
                    return Err(CeaError::unrefined(harmonic, friction, value));
                }
            }
        }
        let slow = all.iter().filter(|value| self.is_overdamped(value)).chain(&creeping);
        let slow = slow.filter(|value| value.norm() <= self.largest);
        let (friction_coefficient, count) = (friction, 1);
        let one = |value: &c64| Overdamped { friction_coefficient, count, decay: [-value.re; 2] };
        Ok(Overdamped::joined(friction, slow.map(one)))
    }

    /// Eigenvalues with the stiffness of their own frequencies: those that branches have come to, and what others with the
    /// stiffness of one frequency settle at.
    fn settled(&mut self, frozen: &[c64], friction: f64, shared: &Matrices) -> Vec<c64> {
        let open = self.paths.iter().filter(|tracked| tracked.is_open);
        let ends = open.map(|tracked| tracked.last().theta).collect::<Vec<c64>>();
        let (slow, others): (Vec<c64>, Vec<c64>) = frozen
            .iter()
            .partition(|value| self.is_overdamped(value) || value.norm() > self.largest);
        let halves = [1.0, -1.0].map(|sign| shared.frozen(c64::new(0.0, sign * self.largest)));
        let found = others.into_iter().filter_map(|value| {
            // Quotients of the vectors first: they keep to the mode while its frequency moves.
            let half = &halves[usize::from(value.im < 0.0)];
            let Eigenpair { mut theta, x, y, .. } = self.follower.find(half, friction, value)?;
            for _ in 0..QUOTIENTS {
                theta = self.problem.rayleigh_quotient(shared, theta, &x, &y).0;
            }
            Some(self.follower.refine(shared, friction, theta, &x, &y)?.theta)
        });
        let mut all: Vec<c64> = Vec::new();
        for own in ends.into_iter().chain(found.collect::<Vec<c64>>()) {
            if all.iter().all(|other| (other - own).norm() > SAME_EIGENVALUE * own.norm()) {
                all.push(own);
            }
        }
        all.into_iter().chain(slow).collect()
    }

    /// Takes the open branches on; those that stop to oscillate, or turn too fast, are closed where they have come to.
    fn advance(&mut self, before: f64, friction: f64, shared: &Rc<Matrices>) {
        let problem = self.problem;
        let mut matrices = |value: f64| match value == friction {
            true => Rc::clone(shared),
            false => Rc::new(problem.at(value)),
        };
        for tracked in self.paths.iter_mut().filter(|tracked| tracked.is_open) {
            tracked.reached = tracked.path.points.len();
            let points = &mut tracked.path.points;
            let shortest = SHORTEST * (friction - before);
            tracked.is_open = self.follower.walk(points, friction, shortest, &mut matrices);
        }
    }

    /// The eigenvalue with its vectors; nothing where two meet, or creep against dashpots hides them.
    fn found(&mut self, value: c64, friction: f64, shared: &Matrices) -> Option<Eigenpair> {
        [1.0, 1.0 + MULTIPLE].into_iter().find_map(|shift| {
            let found = self.follower.find(shared, friction, value * shift)?; // Beside it, if a shift on it is singular.
            let is_it = (found.theta - value).norm() <= SAME_EIGENVALUE * value.norm();
            is_it.then_some(found)
        })
    }

    /// A branch from an eigenvalue that none has come to, followed back as far as it goes: to a branch that was lost on the way,
    /// else to a beginning of its own.
    fn add(&mut self, value: c64, found: Eigenpair, before: f64, was_open: &[usize]) {
        let (problem, friction) = (self.problem, found.parameter);
        let mut back = vec![found];
        let mut matrices = |value: f64| Rc::new(problem.at(value));
        self.follower.walk(&mut back, before, SHORTEST * (friction - before), &mut matrices);
        back.reverse();
        let joined = was_open.iter().copied().find(|&index| {
            let tracked = &self.paths[index];
            let left = &tracked.path.points[tracked.reached - 1]; // Its last point before this step.
            let is_there = left.parameter == back[0].parameter;
            !tracked.is_open && is_there && left.is_same(&back[0], SAME_EIGENVALUE)
        });
        match joined {
            Some(index) => {
                let tracked = &mut self.paths[index];
                tracked.path.points.truncate(tracked.reached);
                tracked.path.points.extend(back.into_iter().skip(1));
                tracked.is_open = true;
            }
            None => {
                let path = Path {
                    branch: self.next_branch,
                    waves: if value.im > 0.0 { Waves::Forward } else { Waves::Backward }, // With Im < 0 it is the conjugate of the wave -n.
                    points: back,
                };
                self.next_branch += 1;
                self.paths.push(Tracked::new(path));
            }
        }
    }

    /// Whether a motion that no branch has come to decays without oscillating, or is creep of the contact against its dashpots,
    /// `lambda ~ - k V / (mu p)`, whatever little imaginary part friction gives that: slow modes of the body come from rest.
    fn is_overdamped(&self, value: &c64) -> bool {
        self.problem.is_ending(*value) || value.norm() < BESIDE * self.largest
    }

    /// What is listed at a friction coefficient.
    fn describe(&mut self, friction: f64, kept: &[f64]) {
        let at = self.problem.at(friction);
        for tracked in self.paths.iter_mut().filter(|tracked| tracked.is_open) {
            describe(self.problem, &at, &mut tracked.path.points, kept);
        }
    }
}

/// All eigenvalues of the quadratic problem, from those of `(lambda - sigma)^-1` with `sigma > 0`:
///
/// ```text
/// [ (X - 1) / sigma   - R Y     ]
/// [ X / R             - sigma Y ],   X = T(sigma)^-1 K,  Y = T(sigma)^-1 M,   unknowns (u, lambda u / R)
/// ```
///
/// `C` enters through `T(sigma)` alone, so dashpots of any strength leave the matrix of the size of `1 / sigma`. `size` is that of
/// the eigenvalues wanted, rad/s.
///
/// Losses part the waves `+n` and `-n`: each has matrices of its own, whose other half of the plane means nothing. Stiffness that
/// depends on frequency is that of the highest: as many eigenvalues lie below it as with that of their own.
fn spectrum(problem: &HarmonicProblem, at: &Matrices, size: f64) -> Result<Vec<c64>, CeaError> {
    if !problem.is_lossy() {
        return spectrum_of(problem, at, size);
    }
    let halves = [size, -size].map(|top| at.frozen(c64::new(0.0, top)));
    let [ahead, back] = halves.map(|half| spectrum_of(problem, &half, size));
    let ahead = ahead?.into_iter().filter(|value| value.im > 0.0);
    Ok(ahead.chain(back?.into_iter().filter(|value| value.im <= 0.0)).collect())
}

/// The same of one stiffness.
fn spectrum_of(problem: &HarmonicProblem, at: &Matrices, size: f64) -> Result<Vec<c64>, CeaError> {
    let n = problem.dimension;
    let (sigma, scale) = (c64::new(0.7 * size, 0.0), c64::new(size, 0.0)); // On the positive axis: far from all that decays or vibrates.
    let [mass, damping, stiffness] = problem.dense(at);
    let shifted = Mat::from_fn(n, n, |i, j| {
        stiffness[(i, j)] + sigma * (damping[(i, j)] + sigma * mass[(i, j)]) // T(sigma) = K + sigma C + sigma^2 M.
    });
    let factors = ComplexDenseLu::factorize(shifted);
    let (mut x, mut y) = (stiffness, mass);
    factors.solve_in_place(x.as_mut());
    factors.solve_in_place(y.as_mut());
    let one = |i: usize, j: usize| c64::new(f64::from(u8::from(i == j)), 0.0);
    let inverse = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => (x[(i, j)] - one(i, j)) / sigma,
        (true, false) => -scale * y[(i, j - n)],
        (false, true) => x[(i - n, j)] / scale,
        (false, false) => -sigma * y[(i - n, j - n)],
    });
    Ok(complex_eigenvalues(inverse.as_ref())?.iter().map(|value| sigma + value.inv()).collect()) // nu = 1 / (lambda - sigma).
}
