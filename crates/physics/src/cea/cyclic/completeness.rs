//! Proofs that no mode of the range is missing.

use super::definite::{self, Region};
use crate::cea::counted::{STANDSTILL, WIDEST_GROWTH};
use crate::cea::cyclic::*;
use crate::linalg::count_zeros;
use std::convert::Infallible;

/// Share of the limit below which no modes are searched for where damping is not proportional: there motions within
/// [`WIDEST_GROWTH`] need not oscillate; a little more, so that none lies on the edge.
const SLOWEST: f64 = CHANGE_PLACES * STANDSTILL * WIDEST_GROWTH;

/// Points on each side of the range from which the extent of `kappa` is taken.
const SIDE_POINTS: usize = 16;

/// Friction values, out of a rising grid, at which modes are counted: the quarters of the range.
fn quarters(grid: &[f64]) -> Vec<f64> {
    let last = grid.len() - 1;
    let mut places: Vec<usize> = (1..=4).map(|quarter| last * quarter / 4).collect();
    places.dedup();
    places.into_iter().map(|place| grid[place]).collect()
}

/// Looks for modes below `limit` (rad/s) that no path stands for: in the followed harmonics by counting at the quarters of the friction
/// values of `grid`, in all others by proof, or by counting where the proof does not reach.
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
        let problem = HarmonicProblem::new(tangent.harmonic(n), true);
        let is_proven = problem.is_proportional()
            && definite::is_empty(&problem.tangent, &tangential, friction, region);
        (n, is_proven, is_proven || is_complete(&problem, None))
    });
    let gaps: Vec<Option<usize>> = crate::parallel::map(followed, |paths| {
        // A small space has not the determinant of the harmonic.
        let n = paths.problem.tangent.harmonic;
        let whole = paths.space.as_ref().map(|_| HarmonicProblem::new(tangent.harmonic(n), true));
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

/// `kappa` of every `lambda` with `0 <= Im <= limit` and `|Re| <= WIDEST_GROWTH limit`, from points along the edge of that rectangle.
fn region(tangent: &WaveTangent, limit: f64) -> Region {
    let rayleigh = tangent.options.damping;
    let mut region = Region { real: 0.0, imaginary: 0.0 };
    let corners = corners([0.0, limit], WIDEST_GROWTH * limit);
    for (from, to) in (0..4).map(|side| (corners[side], corners[(side + 1) % 4])) {
        for i in 0..SIDE_POINTS {
            let kappa = rayleigh.kappa(from + (to - from) * (i as f64 / SIDE_POINTS as f64));
            region.real = region.real.max(1.001 * kappa.re); // A little more, since the edge bends between the points.
            region.imaginary = region.imaginary.max(1.001 * kappa.im.abs());
        }
    }
    region
}

/// Corners of `|Re| <= half_width`, `low <= Im <= high`, counter-clockwise.
fn corners([low, high]: [f64; 2], half_width: f64) -> [c64; 4] {
    [(-half_width, low), (half_width, low), (half_width, high), (-half_width, high)]
        .map(|(re, im)| c64::new(re, im))
}

/// Eigenvalues in the range at friction `mu` that no path stands for, by the argument principle; `None` where one lies on the edge.
///
/// The determinant divided by that at rest and by the factors of the known eigenvalues has neither zeros
/// nor poles left inside unless one was missed, so it changes little along the edge. The
/// lower half of the plane has the conjugates of the wave `-n`; losses are analytic in each.
fn missed(
    problem: &HarmonicProblem,
    paths: Option<&HarmonicPaths>,
    limit: f64,
    region: Region,
    mu: f64,
) -> Option<i64> {
    let (known_at_rest, known) = paths.map_or((Vec::new(), Vec::new()), |paths| known(paths, mu));
    let (rest, now) = (problem.at_damping(0.0), problem.at(mu)); // At rest and undamped its zeros are those of the inertia count.
    let (mut lu, mut values) = (problem.workspace(), Vec::new());
    let mut ln_at = |theta: c64| -> c64 {
        let mut ln_determinant = |at: &Matrices| {
            problem.assemble(at, theta, &mut values);
            lu.factorize(&values);
            lu.ln_determinant()
        };
        let factors = |known: &[c64]| known.iter().map(|k| (theta - k).ln()).sum::<c64>();
        ln_determinant(&now) - ln_determinant(&rest) - factors(&known) + factors(&known_at_rest) // Its zeros are what was missed.
    };
    let mut missing = |corners: [c64; 4], size: f64| -> Option<i64> {
        let found = count_zeros(&corners, &|_| NEAR * size, &mut |points| {
            Ok::<_, Infallible>(points.into_iter().map(&mut ln_at).collect())
        });
        Some(found.ok()?.count)
    };
    if problem.is_proportional() {
        // Turned by a right angle: the rectangle's "height" is Re(kappa).
        let upright = corners([-BESIDE * region.real, region.real], region.imaginary);
        return missing(upright.map(|p| c64::new(p.im, -p.re)), region.real);
    }
    let upper = corners([SLOWEST * limit, limit], WIDEST_GROWTH * limit);
    let ahead = missing(upper, limit)?;
    match problem.tangent.is_standing {
        true => Some(ahead),
        false => Some(ahead + missing(upper.map(|point| -point), limit)?), // The lower half: conjugates of -n.
    }
}

/// Known eigenvalues of the problem's `theta` at rest (undamped) and at `mu`.
fn known(paths: &HarmonicPaths, mu: f64) -> (Vec<c64>, Vec<c64>) {
    let problem = &paths.problem;
    let at_rest = paths.at_rest.iter();
    let at_rest = match problem.is_proportional() {
        true => at_rest.map(|&kappa| c64::new(kappa, 0.0)).collect(),
        false => at_rest
            .flat_map(|kappa| [1.0, -1.0].map(|s| c64::I * s * kappa.max(0.0).sqrt())) // theta = +-i omega.
            .collect(),
    };
    let points = paths.paths.iter().flat_map(|path| &path.points);
    let now = points.filter(|point| point.parameter == mu).map(|point| point.theta);
    (at_rest, now.collect())
}
