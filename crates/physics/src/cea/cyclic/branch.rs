//! Branches of one harmonic as continuous functions of the friction coefficient, and where they grow.

use crate::cea::cyclic::*;
use crate::cea::onset::{BranchSolver, instabilities};
use std::convert::Infallible;

/// Everything needed to solve one branch again at any friction value.
struct WaveSolver<'a> {
    follower: Follower<'a>,
    waves: Waves,
}

/// Public branches of one harmonic with their unstable intervals.
pub(super) fn branches_of(paths: &HarmonicPaths, sliding_direction: f64) -> Vec<ModeBranch> {
    let mut branches = Vec::new();
    for path in &paths.paths {
        for waves in path.waves.singly() {
            branches.push(branch_of(&paths.problem, path, *waves, sliding_direction));
        }
    }
    branches
}

/// `U(r) e^{i n theta + lambda t}` with `Im(lambda) > 0` travels towards `-theta`: against a rotor that turns counter-clockwise.
pub(super) fn direction_of(problem: &HarmonicProblem, waves: Waves, sliding_direction: f64) -> i8 {
    let with_rotor: i8 = if sliding_direction > 0.0 { 1 } else { -1 };
    match waves {
        _ if problem.tangent.is_standing => 0,
        Waves::Backward => with_rotor,
        _ => -with_rotor,
    }
}

/// A wave of a path at one of its points.
pub(super) fn point_of(problem: &HarmonicProblem, waves: Waves, pair: &Eigenpair) -> BranchPoint {
    let theta = waves.own(pair.theta); // lambda(theta(mu)): its rate by the chain rule.
    BranchPoint {
        friction_coefficient: pair.parameter,
        eigenvalue: problem.eigenvalue(theta),
        rate: problem.eigenvalue_slope(theta) * waves.own(pair.rate),
        residual: pair.residual,
    }
}

fn branch_of(
    problem: &HarmonicProblem,
    path: &Path,
    waves: Waves,
    sliding_direction: f64,
) -> ModeBranch {
    let mut branch = ModeBranch {
        harmonic: problem.tangent.harmonic,
        branch: path.branch,
        direction: direction_of(problem, waves, sliding_direction),
        points: path.points.iter().map(|p| point_of(problem, waves, p)).collect(),
        intervals: Vec::new(),
    };
    let mut solver = WaveSolver { follower: Follower::new(problem), waves };
    let Ok(found) = instabilities(&mut solver, &branch.points);
    let name = (branch.harmonic, branch.branch, branch.direction);
    branch.intervals = found.iter().map(|i| i.interval(name, |point| *point)).collect();
    branch
}

impl BranchSolver for WaveSolver<'_> {
    type State = BranchPoint;
    type Error = Infallible;

    const TOLERANCE: f64 = ROUND_OFF;

    fn point(&self, state: &BranchPoint) -> BranchPoint {
        *state
    }

    fn round_off(&self, _: &BranchPoint) -> f64 {
        Self::TOLERANCE
    }

    /// The branch at a friction coefficient, from a good guess of `lambda`.
    fn between(
        &mut self,
        _: &BranchPoint,
        _: &BranchPoint,
        guess: BranchPoint,
    ) -> Result<Option<BranchPoint>, Infallible> {
        let (problem, friction) = (self.follower.problem, guess.friction_coefficient);
        let theta = self.waves.own(problem.theta(guess.eigenvalue));
        let found = self.follower.find(&problem.at(friction), friction, theta);
        Ok(found.map(|found| point_of(problem, self.waves, &found)))
    }
}
