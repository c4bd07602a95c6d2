//! A harmonic reduced to a small space first: of a body of revolution in three dimensions, and every one with structural damping.

use super::across::Across;
use super::damped::follow_damped;
use super::modes_below::AtRest;
use super::paths::{Range, are_distinct, describe, follow_pairs};
use super::reduction::Reduction;
use crate::cea::cyclic::*;
use crate::linalg::banded::BandedMatrix;

/// Modes at rest up to this much above the followed ones span the reduced space.
pub(super) const SPAN: f64 = 1.4;

/// Relative distance up to which an eigenvalue may be the one guessed.
const GUESSED: f64 = 1e-2;

/// The branches of one harmonic up to the margin of the range, from its modes at rest up to [`SPAN`] above that.
pub(super) fn follow(
    tangent: &WaveTangent,
    AtRest { harmonic: n, pencil, modes }: AtRest,
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let harmonic = tangent.harmonic(n);
    let across = Across::new(&harmonic, &tangent.sideways_unknowns());
    // Whether friction damps the motion across the sliding strongly somewhere in the range.
    let is_damped = across.are_strong(&modes, range.highest_friction());
    let held =
        if is_damped { across.held_modes(&pencil, range.margin * SPAN * SPAN) } else { Vec::new() };
    let reduction = space(tangent, &harmonic, &pencil, (modes, held));
    let reduction = if is_damped { reduction.turned(&across) } else { reduction };

    // Branches in the small space.
    let problem = || HarmonicProblem::new(reduction.tangent(&harmonic, &across), false);
    let followed = reduction.kappas.iter().take_while(|kappa| **kappa < range.margin);
    let pairs: Modes = followed.enumerate().map(|(k, &kappa)| (kappa, reduction.mode(k))).collect();
    let oscillating = if is_damped { None } else { follow_pairs(problem(), &pairs, range).ok() };
    // Where a branch stops to oscillate, others may begin to.
    let paths = oscillating.map_or_else(|| follow_damped(problem(), &pairs, range), Ok)?;

    // Over all unknowns, or what the small space leaves out.
    if tangent.terms.is_lossy() {
        return refined(paths, HarmonicProblem::new(harmonic, false), range);
    }
    let added = range.highest_friction() * range.margin.sqrt(); // lambda mu A holds like a spring |lambda| mu A.
    let damped = is_damped.then(|| pencil.stiffened(added, &across.dashpots)).flatten();
    let answering = damped.unwrap_or(pencil);
    let reduction_error = largest_error(&paths, (&reduction, &harmonic, &answering), range.wanted);
    Ok(HarmonicPaths { space: Some(reduction), reduction_error, ..paths })
}

/// The small space of a harmonic, of its modes at rest and those with the motion across the sliding held.
fn space(
    tangent: &WaveTangent,
    harmonic: &HarmonicTangent,
    pencil: &Pencil,
    modes: (Modes, Modes),
) -> Reduction {
    let lossy = harmonic.losses.iter().map(|(_, own)| &own[0]);
    // Damping of parts, and that of the whole body where supports have none of it.
    let damped = harmonic.damping.iter().map(|own| &own[0]);
    let lossy: Vec<&BandedMatrix> = lossy.chain(damped).collect();
    let rows = tangent.normal_rows(harmonic.harmonic);
    Reduction::new(pencil, rows, (&tangent.pressed_unknowns(), &lossy), modes)
}

/// The largest [`Reduction::error`] of the paths of a harmonic that end below `|lambda|^2 = wanted`.
fn largest_error(
    paths: &HarmonicPaths,
    (reduction, harmonic, pencil): (&Reduction, &HarmonicTangent, &Pencil),
    wanted: f64,
) -> f64 {
    let errors = paths.paths.iter().filter_map(|path| path.points.last()).map(|end| {
        let lambda = paths.problem.eigenvalue(end.theta);
        let is_listed = lambda.norm_sqr() <= wanted && !paths.problem.is_ending(end.theta);
        if is_listed { reduction.error(harmonic, pencil, lambda, end) } else { 0.0 }
    });
    errors.fold(0.0, f64::max)
}

/// Every point of the branches that come below the margin of the range, solved in `problem`: losses of one part excite what the small
/// space lacks, whose eigenvalues are good guesses, no more.
fn refined(
    mut small: HarmonicPaths,
    problem: HarmonicProblem,
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let (mut follower, largest) = (Follower::new(&problem), range.margin.sqrt());
    let lost = |guess: &Eigenpair| {
        CeaError::unrefined(problem.tangent.harmonic, guess.parameter, guess.theta)
    };
    // Losses have no meaning for a motion that does not oscillate or, a hundred times slower, creeps; fast ones are not listed.
    let matters = |theta: c64| {
        let size = theta.norm();
        !problem.is_ending(theta) && size > 0.01 * largest && size <= largest
    };
    for path in &mut small.paths {
        let mut points: Vec<Eigenpair> = Vec::new();
        let guesses = path.points.iter().skip_while(|guess| guess.theta.norm() > largest);
        for guess in guesses {
            let at = problem.at(guess.parameter);
            // The vectors of the point before tell two eigenvalues apart that lie close together.
            let found = match points.last() {
                Some(last) => follower.refine(&at, guess.parameter, guess.theta, &last.x, &last.y),
                None => follower.find(&at, guess.parameter, guess.theta),
            };
            let away = |own: &Eigenpair| (own.theta - guess.theta).norm() / guess.theta.norm();
            match found.filter(|own| away(own) <= GUESSED) {
                Some(found) => points.push(found),
                None if matters(guess.theta) => return Err(lost(guess)),
                None => break,
            }
            describe(&problem, &at, &mut points, range.kept);
        }
        path.points = points;
    }
    small.paths.retain(|path| !path.points.is_empty());
    let mut ends = small.paths.iter().filter_map(|path| path.points.last());
    if let (false, Some(end)) = (are_distinct(&small.paths), ends.next_back()) {
        return Err(lost(end));
    }
    let factorizations = small.factorizations + follower.factorizations;
    Ok(HarmonicPaths { problem, factorizations, ..small })
}
