//! Following one eigenpair along a parameter.

use crate::cea::cyclic::*;
use crate::linalg::banded::BandedLu;
use crate::linalg::vectors::dot;
use std::rc::Rc;

/// Least `|x_0^H x_1|` of the unit right vectors of two successive points of a path.
const LEAST_OVERLAP: f64 = 0.8;
/// Steps of the parameter below which a branch is lost.
pub(super) const SHORTEST: f64 = 1e-6;

/// Solves and follows eigenpairs of one harmonic.
pub(super) struct Follower<'a> {
    pub problem: &'a HarmonicProblem,
    lu: BandedLu,
    values: Vec<c64>,
    /// LU factorizations so far.
    pub factorizations: usize,
}

impl<'a> Follower<'a> {
    pub fn new(problem: &'a HarmonicProblem) -> Self {
        Self { problem, lu: problem.workspace(), values: Vec::new(), factorizations: 0 }
    }

    /// Two-sided Rayleigh quotient iteration: the error is cubed each time. `None` where it does not settle.
    pub fn refine(
        &mut self,
        at: &Matrices,
        parameter: f64,
        guess: c64,
        x: &[c64],
        y: &[c64],
    ) -> Option<Eigenpair> {
        let (mut x, mut y, mut theta) = (x.to_vec(), y.to_vec(), guess);
        let mut is_moved = false;
        for _ in 0..MOST_ATTEMPTS {
            let before = [x.clone(), y.clone()];
            self.factorize(at, theta);
            // The second pair of solves costs a third of a factorization and saves most of one.
            for _ in 0..2 {
                x = self.inverse_step(at, theta, &x, false);
                normalize(&mut x);
                y = self.inverse_step(at, theta, &y, true);
                normalize(&mut y);
            }
            let (next, slope) = self.problem.rayleigh_quotient(at, theta, &x, &y);
            if !(next.re.is_finite() && next.im.is_finite()) {
                if is_moved {
                    return None;
                }
                // A shift that is an eigenvalue to the last bit makes the factor singular: a shift beside it does not.
                is_moved = true;
                theta += theta * RESIDUAL_BOUND;
                [x, y] = before; // Solutions with a singular factor are worth nothing.
                continue;
            }
            let change = (next - theta).norm(); // Newton's step of the Rayleigh functional.
            theta = next;
            // Each iteration leaves far less than the square of the change it made.
            if change <= MULTIPLE * theta.norm() {
                let residual = self.problem.residual(at, theta, &x);
                if residual > 1e-14 && change > ROUND_OFF * theta.norm() {
                    continue; // Not yet at round-off: once more.
                }
                let rate = self.problem.rate_of(at, theta, &x, &y, slope);
                return Some(Eigenpair::new(parameter, [theta, rate], [x, y], residual));
            }
        }
        None
    }

    /// Factorizes `T(theta)` for [`Self::inverse_step`].
    pub fn factorize(&mut self, at: &Matrices, theta: c64) {
        self.problem.assemble(at, theta, &mut self.values);
        self.lu.factorize(&self.values);
        self.factorizations += 1;
    }

    /// `T^-1 T' x`, or `T^-H T'^H x`, with the last factorization.
    pub fn inverse_step(&self, at: &Matrices, theta: c64, x: &[c64], adjoint: bool) -> Vec<c64> {
        let mut image = self.problem.apply_slope(at, theta, x, adjoint);
        if adjoint {
            self.lu.solve_adjoint(&mut image)
        } else {
            self.lu.solve(&mut image)
        }
        image
    }

    /// Eigenpair nearest to an accurate guess, without vectors to start from.
    pub fn find(&mut self, at: &Matrices, parameter: f64, guess: c64) -> Option<Eigenpair> {
        let start = |phase: f64| -> Vec<c64> {
            (0..self.problem.dimension)
                .map(|i| c64::new(1.0 + (1.7 * i as f64).sin(), (phase + 0.9 * i as f64).cos())) // No symmetry hides a mode from it.
                .collect()
        };
        self.refine(at, parameter, guess, &start(0.3), &start(1.1))
    }

    /// The eigenpair `(theta, x)` of matrices that are symmetric there, so that `y` is the conjugate of `x`.
    pub fn at_rest(&self, at: &Matrices, theta: c64, x: Vec<c64>) -> Eigenpair {
        let y: Vec<c64> = x.iter().map(|v| v.conj()).collect();
        let (_, slope) = self.problem.rayleigh_quotient(at, theta, &x, &y);
        let rate = self.problem.rate_of(at, theta, &x, &y, slope);
        let residual = self.problem.residual(at, theta, &x);
        Eigenpair::new(0.0, [theta, rate], [x, y], residual)
    }

    /// Follows `path` (its last point) to `target`, above or below, in steps no shorter than `shortest`, appending every accepted point;
    /// `matrices` gives the problem along the way. `false` where the eigenpair is lost or stops to oscillate.
    pub fn walk(
        &mut self,
        path: &mut Vec<Eigenpair>,
        target: f64,
        shortest: f64,
        matrices: &mut impl FnMut(f64) -> Rc<Matrices>,
    ) -> bool {
        let mut step = f64::INFINITY;
        while let Some(last) = path.last().filter(|last| last.parameter != target) {
            if self.problem.is_ending(last.theta) {
                return false;
            }
            let goal = match target > last.parameter {
                true => (last.parameter + step).min(target),
                false => (last.parameter - step).max(target),
            };
            let guess = extrapolate(path, goal);
            let at = matrices(goal);
            let found = self.refine(&at, goal, guess, &last.x, &last.y);
            match found.filter(|next| is_continuation(last, next)) {
                Some(next) => {
                    // Twice as far after a step that held, half as far after one that did not.
                    step = 2.0 * (goal - last.parameter).abs();
                    path.push(next);
                }
                None => {
                    step = 0.5 * (goal - last.parameter).abs();
                    if step < shortest {
                        return false;
                    }
                }
            }
        }
        path.last().is_some_and(|last| !self.problem.is_ending(last.theta))
    }
}

fn is_continuation(last: &Eigenpair, next: &Eigenpair) -> bool {
    let step = next.parameter - last.parameter;
    // What the trapezoid of the rates misses: a cubic through both points and slopes could hide as much.
    let defect = (next.theta - last.theta - (last.rate + next.rate) * (0.5 * step)).norm();
    dot(&last.x, &next.x).norm() >= LEAST_OVERLAP && defect <= NEAR * next.theta.norm()
}

/// Cubic through the last two points and slopes; the tangent of the last where it is alone, or the one before so close that their
/// difference is round-off, as of 0.35 and 0.35 from a sum.
fn extrapolate(path: &[Eigenpair], goal: f64) -> c64 {
    let last = &path[path.len() - 1];
    let ahead = goal - last.parameter;
    let before = &path[path.len().saturating_sub(2)];
    let h = last.parameter - before.parameter;
    if h.abs() < SAME_EIGENVALUE {
        return last.theta + last.rate * ahead;
    }
    let secant = (last.theta - before.theta) / h; // Newton's divided differences with both slopes.
    let curvature = (last.rate - secant) / h;
    let twist = (last.rate + before.rate - secant * 2.0) / (h * h);
    let square = ahead * ahead;
    last.theta + last.rate * ahead + curvature * square + twist * (square * (ahead + h))
}
