//! Branches as continuous functions of the friction coefficient, and where they grow.

use super::follow::Follower;
use super::paths::{HarmonicPaths, Path, Waves};
use super::problem::HarmonicProblem;
use crate::cea::UnstableInterval;
use faer::c64;
use std::f64::consts::TAU;

/// A branch at one friction value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchPoint {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Eigenvalue `lambda`, rad/s, `Im(lambda) >= 0`.
    pub eigenvalue: c64,
    /// `d lambda / d mu`, rad/s.
    pub rate: c64,
    /// Relative residual, see [`crate::cea::ComplexMode::residual`].
    pub residual: f64,
}

/// One eigenvalue followed continuously from rest over the friction coefficient.
///
/// Between two points the cubic through both eigenvalues and rates represents it to about `1e-6` of
/// `|lambda|`.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeBranch {
    /// Circumferential harmonic `n`.
    pub harmonic: usize,
    /// Rank of its frequency among the harmonic's modes without friction, 0 = lowest.
    pub branch: usize,
    /// Direction of travel: +1 with the rotor, -1 against it, 0 standing.
    pub direction: i8,
    /// Points of rising friction coefficient from 0: the values asked for and those in between that the
    /// shape of the branch needed.
    pub points: Vec<BranchPoint>,
    /// Where `Re(lambda) > 0`.
    pub intervals: Vec<UnstableInterval>,
}

impl ModeBranch {
    /// `lambda` at any friction coefficient of the range, by the cubic between its neighbours; `None`
    /// outside.
    pub fn interpolate(&self, friction_coefficient: f64) -> Option<c64> {
        let mu = friction_coefficient;
        if let Some(point) = self.points.iter().find(|p| p.friction_coefficient == mu) {
            return Some(point.eigenvalue);
        }
        let is_around =
            |p: &&[BranchPoint]| p[0].friction_coefficient < mu && mu < p[1].friction_coefficient;
        let pair = self.points.windows(2).find(is_around)?;
        let cubic = Cubic::between(&pair[0], &pair[1]);
        Some(cubic.value((mu - pair[0].friction_coefficient) / cubic.width))
    }
}

/// `theta` of the path that carries a wave of eigenvalue `lambda`.
pub(super) fn path_theta(problem: &HarmonicProblem, is_backward: bool, lambda: c64) -> c64 {
    let own = if problem.is_proportional() {
        problem.rayleigh.kappa(lambda)
    } else {
        lambda
    };
    if is_backward { own.conj() } else { own }
}

/// Everything needed to solve one branch again at any friction value.
struct BranchSolver<'a> {
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
    let own = if waves == Waves::Backward {
        theta.conj()
    } else {
        theta
    };
    (problem.eigenvalue(own), problem.eigenvalue_slope(own))
}

fn branch_of(
    problem: &HarmonicProblem,
    path: &Path,
    waves: Waves,
    sliding_direction: f64,
) -> ModeBranch {
    let point = |p: &super::follow::Eigenpair| {
        let (eigenvalue, slope) = eigenvalue_of(problem, waves, p.theta);
        let rate = if waves == Waves::Backward {
            p.rate.conj()
        } else {
            p.rate
        };
        BranchPoint {
            friction_coefficient: p.parameter,
            eigenvalue,
            rate: slope * rate,
            residual: p.residual,
        }
    };
    let mut branch = ModeBranch {
        harmonic: problem.harmonic,
        branch: path.branch,
        direction: direction_of(problem, waves, sliding_direction),
        points: path.points.iter().map(point).collect(),
        intervals: Vec::new(),
    };
    let mut solver = BranchSolver {
        follower: Follower::new(problem),
        waves,
        problem,
    };
    branch.intervals = solver.unstable_intervals(&branch);
    branch
}

impl BranchSolver<'_> {
    /// The branch at `friction`, from a good guess of `lambda`.
    fn solve(&mut self, friction: f64, guess: c64) -> Option<BranchPoint> {
        let problem = self.problem;
        let is_backward = self.waves == Waves::Backward;
        let theta = path_theta(problem, is_backward, guess);
        let found = self.follower.find(&problem.at(friction), friction, theta)?;
        let (eigenvalue, slope) = eigenvalue_of(problem, self.waves, found.theta);
        let rate = if is_backward {
            found.rate.conj()
        } else {
            found.rate
        };
        Some(BranchPoint {
            friction_coefficient: friction,
            eigenvalue,
            rate: slope * rate,
            residual: found.residual,
        })
    }

    /// Growing intervals, from sign changes of `Re(lambda)` between points and turning points.
    fn unstable_intervals(&mut self, branch: &ModeBranch) -> Vec<UnstableInterval> {
        let mut intervals: Vec<UnstableInterval> = Vec::new();
        let interval = |critical: f64, at: c64, from_start: bool| UnstableInterval {
            harmonic: branch.harmonic,
            branch: branch.branch,
            direction: branch.direction,
            critical_friction: critical,
            frequency_hz: at.im / TAU,
            restabilized: None,
            unstable_from_start: from_start,
        };
        let first = branch.points[0];
        let mut was_growing = is_growing(&first) || grows_from_zero(&first);
        if was_growing {
            let (friction, at) = (first.friction_coefficient, first.eigenvalue);
            intervals.push(interval(friction, at, true));
        }
        for pair in branch.points.windows(2) {
            let mut start = pair[0];
            for end in self.with_turning_points(&pair[0], &pair[1]) {
                if is_growing(&end) != was_growing {
                    let root = self.root(&start, &end);
                    let (friction, at) = (root.friction_coefficient, root.eigenvalue);
                    match intervals.last_mut().filter(|_| was_growing) {
                        Some(open) => open.restabilized = Some((friction, at.im / TAU)),
                        None => intervals.push(interval(friction, at, false)),
                    }
                    was_growing = !was_growing;
                }
                start = end;
            }
        }
        intervals
    }

    /// The points of `(start, end]` between which `Re(lambda)` is monotonic: extrema of the cubic that come
    /// near zero are solved for, then `end`.
    fn with_turning_points(&mut self, start: &BranchPoint, end: &BranchPoint) -> Vec<BranchPoint> {
        let cubic = Cubic::between(start, end);
        // What the cubic may be wrong by, generously.
        let doubt =
            1e-4 * end.eigenvalue.norm() + 0.1 * (end.eigenvalue - start.eigenvalue).re.abs();
        let (a, b) = (start.eigenvalue.re, end.eigenvalue.re);
        let mut points = Vec::new();
        for t in cubic.turning_points() {
            let value = cubic.real_part(t);
            let changes_sign = value.signum() != a.signum() || value.signum() != b.signum();
            if value.abs() < doubt || changes_sign {
                let friction = start.friction_coefficient + t * cubic.width;
                points.extend(self.solve(friction, cubic.value(t)));
            }
        }
        points.push(*end);
        points
    }

    /// Root of `Re(lambda)` between points of opposite sign: Newton steps on the branch, kept inside the
    /// bracket, from the root of the cubic.
    fn root(&mut self, start: &BranchPoint, end: &BranchPoint) -> BranchPoint {
        let cubic = Cubic::between(start, end);
        let (mut low, mut high) = (*start, *end);
        let mut friction = start.friction_coefficient + cubic.root() * cubic.width;
        let mut best = if start.eigenvalue.re.abs() < end.eigenvalue.re.abs() {
            *start
        } else {
            *end
        };
        for _ in 0..60 {
            let t = (friction - start.friction_coefficient) / cubic.width;
            let Some(point) = self.solve(friction, cubic.value(t)) else {
                break;
            };
            best = point;
            if is_growing(&point) == is_growing(&low) {
                low = point;
            } else {
                high = point;
            }
            let newton = friction - growth(&point) / point.rate.re;
            let is_inside = newton > low.friction_coefficient && newton < high.friction_coefficient;
            let next = if is_inside {
                newton
            } else {
                0.5 * (low.friction_coefficient + high.friction_coefficient)
            };
            if (next - friction).abs() <= 1e-13 * (1.0 + friction) {
                break;
            }
            friction = next;
        }
        best
    }
}

/// Round-off of an eigenvalue, relative to `|lambda|`: less growth than this is none.
const ROUND_OFF: f64 = 1e-13;

/// Growth rate beyond round-off, 1/s.
fn growth(point: &BranchPoint) -> f64 {
    point.eigenvalue.re - ROUND_OFF * point.eigenvalue.norm()
}

fn is_growing(point: &BranchPoint) -> bool {
    growth(point) > 0.0
}

/// Whether a branch without any damping starts to grow with the first friction.
fn grows_from_zero(point: &BranchPoint) -> bool {
    let size = point.eigenvalue.norm();
    growth(point) <= 0.0 && growth(point) > -1e2 * ROUND_OFF * size && point.rate.re > 1e-9 * size
}

/// Cubic through two points and slopes, over `t` from 0 to 1.
struct Cubic {
    width: f64,
    coefficients: [c64; 4],
}

impl Cubic {
    fn between(start: &BranchPoint, end: &BranchPoint) -> Self {
        let width = end.friction_coefficient - start.friction_coefficient;
        let (a, b) = (start.eigenvalue, start.rate * width);
        let (rise, slope) = (end.eigenvalue - a, end.rate * width);
        Self {
            width,
            coefficients: [a, b, rise * 3.0 - b * 2.0 - slope, b + slope - rise * 2.0],
        }
    }

    fn value(&self, t: f64) -> c64 {
        let [a, b, c, d] = self.coefficients;
        a + (b + (c + d * t) * t) * t
    }

    fn real_part(&self, t: f64) -> f64 {
        self.value(t).re
    }

    /// Where the slope of the real part vanishes inside, rising.
    fn turning_points(&self) -> Vec<f64> {
        let [_, b, c, d] = self.coefficients.map(|value| value.re);
        let discriminant = c * c - 3.0 * b * d;
        if discriminant < 0.0 {
            return Vec::new();
        }
        // Stable roots of b + 2 c t + 3 d t^2.
        let q = -(c + discriminant.sqrt().copysign(c));
        let mut roots = vec![q / (3.0 * d), b / q];
        roots.retain(|t| *t > 0.0 && *t < 1.0);
        roots.sort_by(f64::total_cmp);
        roots.dedup();
        roots
    }

    /// A root of the real part in [0, 1], by bisection.
    fn root(&self) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let is_positive = self.real_part(low) > 0.0;
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if (self.real_part(middle) > 0.0) == is_positive {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}
