//! Proofs that no mode of the range is missing.

use super::definite::{self, Region};
use super::paths::HarmonicPaths;
use super::problem::{HarmonicProblem, I, Matrices};
use crate::linalg::banded::BandedLu;
use crate::linalg::c64;
use crate::prestress::WaveTangent;
use std::f64::consts::{FRAC_PI_3, PI, TAU};

/// Largest `|Re(lambda)|` of the modes that completeness speaks of, as a share of the frequency limit
/// (rad/s).
pub(super) const WIDEST_GROWTH: f64 = 0.2;

/// Share of the limit below which no modes are searched for where damping is not proportional:
/// there motions within [`WIDEST_GROWTH`] need not oscillate, see `STANDSTILL`.
const SLOWEST: f64 = 0.0202;

/// Points on the edge of the range at which phases are taken before halving starts.
const EDGE_POINTS: usize = 8;

/// Friction values, out of a rising grid, at which modes are counted: the quarters of the range.
fn quarters(grid: &[f64]) -> Vec<f64> {
    let last = grid.len() - 1;
    let mut places: Vec<usize> = (1..=4).map(|quarter| last * quarter / 4).collect();
    places.dedup();
    places.into_iter().map(|place| grid[place]).collect()
}

/// Looks for modes below `limit` (rad/s) that no path stands for: in the followed harmonics by counting at
/// the quarters of the friction values of `grid`, in all others by proof, or by counting where the
/// proof does not reach.
///
/// Returns the harmonics, among those that were not followed, which are proven empty for every friction coefficient of the range, and
/// those counted empty at the friction coefficients checked.
///
/// # Errors
/// A harmonic with a mode in the range that no path stands for.
pub(super) fn verify(
    tangent: &WaveTangent,
    followed: &[HarmonicPaths],
    limit: f64,
    grid: &[f64],
) -> Result<[Vec<usize>; 2], usize> {
    let checks = quarters(grid);
    let region = region(tangent, limit);
    let friction = checks.iter().copied().fold(0.0, f64::max);
    let is_followed = |n: &usize| followed.iter().any(|paths| paths.problem.tangent.harmonic == *n);
    let others: Vec<usize> = (0..=tangent.largest_harmonic()).filter(|n| !is_followed(n)).collect();
    let tangential = tangent.tangential_unknowns();
    let is_complete = |problem: &HarmonicProblem, paths: Option<&HarmonicPaths>| {
        checks.iter().all(|&mu| missed(problem, paths, limit, region, mu) == Some(0))
    };
    let verdicts: Vec<(usize, bool, bool)> = crate::parallel::map(others, |n| {
        let harmonic = tangent.harmonic(n);
        let is_proven = tangent.is_proportional()
            && definite::is_empty(&harmonic, &tangential, friction, region);
        let problem = HarmonicProblem::new(harmonic);
        (n, is_proven, is_proven || is_complete(&problem, None))
    });
    let gaps: Vec<Option<usize>> = crate::parallel::map(followed, |paths| {
        // A small space has not the determinant of the harmonic.
        let n = paths.problem.tangent.harmonic;
        let whole = paths.space.as_ref().map(|_| HarmonicProblem::new(tangent.harmonic(n)));
        let problem = whole.as_ref().unwrap_or(&paths.problem);
        (!is_complete(problem, Some(paths))).then_some(n)
    });
    let pick = |proven: bool| {
        let chosen = verdicts.iter().filter(|v| v.1 == proven && v.2);
        chosen.map(|v| v.0).collect()
    };
    let empty_handed = verdicts.iter().find(|v| !v.2).map(|v| v.0);
    match gaps.into_iter().flatten().next().or(empty_handed) {
        Some(missed) => Err(missed),
        None => Ok([true, false].map(pick)),
    }
}

/// `kappa` of every `lambda` with `0 <= Im <= limit` and `|Re| <= WIDEST_GROWTH limit`, from points along
/// the edge of that rectangle.
fn region(tangent: &WaveTangent, limit: f64) -> Region {
    let rayleigh = tangent.options.damping;
    let mut region = Region { real: 0.0, imaginary: 0.0 };
    for lambda in rectangle(0.0, limit, WIDEST_GROWTH * limit, 64) {
        let kappa = rayleigh.kappa(lambda);
        region.real = region.real.max(1.001 * kappa.re);
        region.imaginary = region.imaginary.max(1.001 * kappa.im.abs());
    }
    region
}

/// Points on the edge of `|Re| <= half_width`, `low <= Im <= high`, counter-clockwise.
fn rectangle(low: f64, high: f64, half_width: f64, count: usize) -> Vec<c64> {
    let corners = [(-half_width, low), (half_width, low), (half_width, high), (-half_width, high)]
        .map(|(re, im)| c64::new(re, im));
    let per_side = count / 4;
    (0..4)
        .flat_map(|side| {
            let (from, to) = (corners[side], corners[(side + 1) % 4]);
            (0..per_side).map(move |i| from + (to - from) * (i as f64 / per_side as f64))
        })
        .collect()
}

/// Eigenvalues in the range at friction `mu` that no path stands for, by the argument principle; `None`
/// where the phase cannot be followed.
///
/// The determinant divided by that at rest and by the factors of the known eigenvalues has neither zeros
/// nor poles left inside unless one was missed, so its phase changes little along the edge. The
/// lower half of the plane has the conjugates of the wave `-n`; losses are analytic in each.
fn missed(
    problem: &HarmonicProblem,
    paths: Option<&HarmonicPaths>,
    limit: f64,
    region: Region,
    mu: f64,
) -> Option<i64> {
    let (known_at_rest, known) = paths.map_or((Vec::new(), Vec::new()), |paths| known(paths, mu));
    let mut search = Search {
        problem,
        at_rest: problem.at_damping(0.0),
        now: problem.at(mu),
        known_at_rest,
        known,
        lu: problem.workspace(),
        values: Vec::new(),
    };
    if problem.is_proportional() {
        // Turned by a right angle: the rectangle's "height" is Re(kappa).
        let edge = rectangle(-1e-3 * region.real, region.real, region.imaginary, EDGE_POINTS);
        return search.winding(edge.into_iter().map(|p| c64::new(p.im, -p.re)).collect());
    }
    let upper = rectangle(SLOWEST * limit, limit, WIDEST_GROWTH * limit, 2 * EDGE_POINTS);
    let lower = upper.iter().map(|point| -point).collect();
    let ahead = search.winding(upper)?;
    if problem.tangent.is_standing { Some(ahead) } else { Some(ahead + search.winding(lower)?) }
}

/// Known eigenvalues of the problem's `theta` at rest (undamped) and at `mu`.
fn known(paths: &HarmonicPaths, mu: f64) -> (Vec<c64>, Vec<c64>) {
    let problem = &paths.problem;
    let at_rest = paths.at_rest.iter();
    let at_rest = match problem.is_proportional() {
        true => at_rest.map(|&kappa| c64::new(kappa, 0.0)).collect(),
        false => {
            at_rest.flat_map(|kappa| [1.0, -1.0].map(|s| I * s * kappa.max(0.0).sqrt())).collect()
        }
    };
    let points = paths.paths.iter().flat_map(|path| &path.points);
    let now = points.filter(|point| point.parameter == mu).map(|point| point.theta);
    (at_rest, now.collect())
}

struct Search<'a> {
    problem: &'a HarmonicProblem,
    at_rest: Matrices,
    now: Matrices,
    known_at_rest: Vec<c64>,
    known: Vec<c64>,
    lu: BandedLu,
    values: Vec<c64>,
}

impl Search<'_> {
    /// Phase of the reduced determinant at `theta`, up to full turns.
    fn phase(&mut self, theta: c64) -> f64 {
        self.problem.assemble(&self.now, theta, &mut self.values);
        self.lu.factorize(&self.values);
        let mut phase = self.lu.determinant_argument();
        self.problem.assemble(&self.at_rest, theta, &mut self.values);
        self.lu.factorize(&self.values);
        phase -= self.lu.determinant_argument();
        phase -= self.known.iter().map(|k| (theta - k).arg()).sum::<f64>();
        phase + self.known_at_rest.iter().map(|k| (theta - k).arg()).sum::<f64>()
    }

    fn winding(&mut self, edge: Vec<c64>) -> Option<i64> {
        let phases: Vec<f64> = edge.iter().map(|&theta| self.phase(theta)).collect();
        let mut total = 0.0;
        for i in 0..edge.len() {
            let j = (i + 1) % edge.len();
            total += self.turn((edge[i], phases[i]), (edge[j], phases[j]), 12)?;
        }
        Some((total / TAU).round() as i64)
    }

    /// Change of phase along a straight line, halved until each half turns little and both agree with the
    /// whole.
    fn turn(&mut self, from: (c64, f64), to: (c64, f64), depth: usize) -> Option<f64> {
        let change = |a: f64, b: f64| (b - a + PI).rem_euclid(TAU) - PI;
        let middle = 0.5 * (from.0 + to.0);
        let middle = (middle, self.phase(middle));
        let halves = [change(from.1, middle.1), change(middle.1, to.1)];
        let whole = change(from.1, to.1);
        let is_smooth = halves.iter().all(|half| half.abs() < FRAC_PI_3);
        if is_smooth && (halves[0] + halves[1] - whole).abs() < FRAC_PI_3 {
            return Some(whole);
        }
        if depth == 0 {
            return None;
        }
        Some(self.turn(from, middle, depth - 1)? + self.turn(middle, to, depth - 1)?)
    }
}
