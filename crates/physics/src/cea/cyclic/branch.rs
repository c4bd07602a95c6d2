//! Branches of one harmonic as continuous functions of the friction coefficient, and where they grow.

use super::follow::Follower;
use super::path::{Eigenpair, Path, Waves};
use super::paths::HarmonicPaths;
use super::problem::HarmonicProblem;
use crate::cea::onset::{BranchSolver, instabilities};
use crate::cea::{BranchPoint, ModeBranch};
use crate::linalg::c64;
use std::convert::Infallible;

/// `theta` of the path that carries a wave of eigenvalue `lambda`.
pub(super) fn path_theta(problem: &HarmonicProblem, is_backward: bool, lambda: c64) -> c64 {
    let own =
        if problem.is_proportional() { problem.tangent.rayleigh.kappa(lambda) } else { lambda };
    if is_backward { own.conj() } else { own }
}

/// Everything needed to solve one branch again at any friction value.
struct WaveSolver<'a> {
    follower: Follower<'a>,
    waves: Waves,
    problem: &'a HarmonicProblem,
}

/// Public branches of one harmonic with their unstable intervals.
pub(super) fn branches_of(paths: &HarmonicPaths, sliding_direction: f64) -> Vec<ModeBranch> {
    let mut branches = Vec::new();
    for path in &paths.paths {
        for waves in waves_of(path.waves) {
            branches.push(branch_of(&paths.problem, path, *waves, sliding_direction));
        }
    }
    branches
}

/// The single waves that a path stands for.
pub(super) fn waves_of(waves: Waves) -> &'static [Waves] {
    match waves {
        Waves::Both => &[Waves::Forward, Waves::Backward],
        Waves::Forward => &[Waves::Forward],
        Waves::Backward => &[Waves::Backward],
    }
}

/// `U(r) e^{i n theta + lambda t}` with `Im(lambda) > 0` travels towards `-theta`: against a rotor that
/// turns counter-clockwise.
pub(super) fn direction_of(problem: &HarmonicProblem, waves: Waves, sliding_direction: f64) -> i8 {
    let with_rotor: i8 = if sliding_direction > 0.0 { 1 } else { -1 };
    match waves {
        _ if problem.is_standing => 0,
        Waves::Backward => with_rotor,
        _ => -with_rotor,
    }
}

/// `lambda` (`Im >= 0`) and `d lambda / d theta` of a wave, from the path's `theta`.
pub(super) fn eigenvalue_of(problem: &HarmonicProblem, waves: Waves, theta: c64) -> (c64, c64) {
    let own = if waves == Waves::Backward { theta.conj() } else { theta };
    (problem.eigenvalue(own), problem.eigenvalue_slope(own))
}

/// A wave of a path at one of its points.
pub(super) fn point_of(problem: &HarmonicProblem, waves: Waves, pair: &Eigenpair) -> BranchPoint {
    let (eigenvalue, slope) = eigenvalue_of(problem, waves, pair.theta);
    let rate = if waves == Waves::Backward { pair.rate.conj() } else { pair.rate };
    BranchPoint {
        friction_coefficient: pair.parameter,
        eigenvalue,
        rate: slope * rate,
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
    let mut solver = WaveSolver { follower: Follower::new(problem), waves, problem };
    let Ok(found) = instabilities(&mut solver, &branch.points);
    let name = (branch.harmonic, branch.branch, branch.direction);
    branch.intervals = found.iter().map(|i| i.interval(name, |point| *point)).collect();
    branch
}

impl BranchSolver for WaveSolver<'_> {
    type State = BranchPoint;
    type Error = Infallible;

    const ROUND_OFF: f64 = 1e-13;
    const TOLERANCE: f64 = 1e-13;

    fn point(&self, state: &BranchPoint) -> BranchPoint {
        *state
    }

    /// The branch at a friction coefficient, from a good guess of `lambda`.
    fn between(
        &mut self,
        _: &BranchPoint,
        _: &BranchPoint,
        guess: BranchPoint,
    ) -> Result<Option<BranchPoint>, Infallible> {
        let (problem, friction) = (self.problem, guess.friction_coefficient);
        let theta = path_theta(problem, self.waves == Waves::Backward, guess.eigenvalue);
        let found = self.follower.find(&problem.at(friction), friction, theta);
        Ok(found.map(|found| point_of(problem, self.waves, &found)))
    }
}
