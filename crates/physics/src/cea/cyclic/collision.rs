//! Past the friction coefficient at which two branches of a standing harmonic meet.
//!
//! The waves of a standing harmonic (`n = 0`, or the shortest on the mesh) see real matrices. So two real `kappa` can meet and go on as a
//! conjugate pair, or the other way round. No derivative exists at that point; both are followed on the far side.

use super::follow::Follower;
use super::path::{Eigenpair, GUESSED, Path};
use super::problem::Matrices;
use crate::cea::accuracy::SAME_EIGENVALUE;
use crate::linalg::c64;
use crate::linalg::dense::add;
use crate::linalg::vectors::{dot, normalize};

/// Carries path `index`, which cannot be followed any further towards `target`, and the path that it meets
/// past their meeting; `None` where they do not meet.
///
/// `approach` follows a path as far as it can towards a parameter; `matrices` gives the problem.
pub(super) fn pass(
    follower: &mut Follower<'_>,
    paths: &mut [Path],
    index: usize,
    target: f64,
    mut approach: impl FnMut(&mut Follower<'_>, &mut Vec<Eigenpair>, f64),
) -> Option<()> {
    let stuck = paths[index].points.last()?.clone();
    let distance =
        |path: &Path| path.points.last().map_or(f64::INFINITY, |p| (p.theta - stuck.theta).norm());
    let others = (0..paths.len()).filter(|&other| other != index);
    let partner = others.min_by(|&a, &b| distance(&paths[a]).total_cmp(&distance(&paths[b])))?;
    approach(follower, &mut paths[partner].points, stuck.parameter);
    let met = paths[partner].points.last()?.clone();
    let gap = (met.theta - stuck.theta).norm();
    if gap > GUESSED * stuck.theta.norm() || met.parameter > stuck.parameter {
        return None;
    }
    let [first, second] = [1e-5, 1e-4, 1e-3, 1e-2].into_iter().find_map(|jump| {
        let beyond = (stuck.parameter + jump).min(target);
        pair_near(follower, &follower.problem.at(beyond), beyond, &stuck, &met)
    })?;
    paths[index.min(partner)].points.push(first); // By number, whichever of the two was stuck.
    paths[index.max(partner)].points.push(second);
    Some(())
}

/// The two eigenpairs that continue `a` and `b`: real ones rising, or the conjugate pair with the positive imaginary part first.
fn pair_near(
    follower: &mut Follower<'_>,
    at: &Matrices,
    parameter: f64,
    a: &Eigenpair,
    b: &Eigenpair,
) -> Option<[Eigenpair; 2]> {
    // Near the meeting both vectors are one: two guesses from the space of both.
    let middle = 0.5 * (a.theta + b.theta);
    let guesses = invariant_pair(follower, at, middle, a, b)?;
    let found = guesses.map(|guess| follower.find(at, parameter, guess));
    let [first, second] = found;
    let (first, second) = (first?, second?);
    let difference = first.theta - second.theta;
    if difference.norm() < SAME_EIGENVALUE * middle.norm() {
        return None;
    }
    // Sideways when they are a conjugate pair, along the axis when they are real.
    let is_pair = difference.im.abs() > difference.re.abs();
    let is_ordered = if is_pair { difference.im > 0.0 } else { difference.re < 0.0 };
    Some(if is_ordered { [first, second] } else { [second, first] })
}

/// Eigenvalues of the projection on the two-dimensional space that inverse iteration at `shift` finds.
fn invariant_pair(
    follower: &mut Follower<'_>,
    at: &Matrices,
    shift: c64,
    a: &Eigenpair,
    b: &Eigenpair,
) -> Option<[c64; 2]> {
    let problem = follower.problem;
    let (mut right, mut left) = ([a.x.clone(), b.x.clone()], [a.y.clone(), b.y.clone()]);
    follower.factorize(at, shift);
    for _ in 0..4 {
        for x in &mut right {
            *x = follower.inverse_step(at, shift, x, false);
        }
        for y in &mut left {
            *y = follower.inverse_step(at, shift, y, true);
        }
        orthonormalize(&mut right);
        orthonormalize(&mut left);
    }
    // T is linear in theta here: y^H T(theta) x = y^H T(shift) x + (theta - shift) y^H T' x.
    let entry = |i: usize, j: usize| {
        let slope = dot(&left[i], &problem.apply_slope(at, shift, &right[j], false));
        (dot(&left[i], &problem.apply(at, shift, &right[j])), slope)
    };
    let [[(k11, m11), (k12, m12)], [(k21, m21), (k22, m22)]] =
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
    let quadratic = m11 * m22 - m12 * m21; // det(K + t M) = 0.
    let linear = k11 * m22 + m11 * k22 - k12 * m21 - m12 * k21;
    let constant = k11 * k22 - k12 * k21;
    let root = (linear * linear - 4.0 * quadratic * constant).sqrt(); // Both roots of the quadratic.
    let roots = [(root - linear) / (2.0 * quadratic), (-root - linear) / (2.0 * quadratic)];
    roots.iter().all(|r| r.re.is_finite() && r.im.is_finite()).then(|| roots.map(|r| shift + r))
}

fn orthonormalize(pair: &mut [Vec<c64>; 2]) {
    let [first, second] = pair;
    normalize(first);
    // Twice is enough for vectors that are nearly parallel.
    for _ in 0..2 {
        let part = dot(first, second);
        add(second, -part, first);
        normalize(second);
    }
}
