//! Branches over all unknowns of a harmonic, from those of its small space.
//!
//! Losses of one part excite what the small space lacks: its eigenvalues are good guesses, no more.

use super::follow::Follower;
use super::path::Eigenpair;
use super::paths::{HarmonicPaths, Range, are_distinct, describe};
use super::problem::HarmonicProblem;
use crate::cea::CeaError;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::prestress::HarmonicTangent;

/// Largest distance of an eigenvalue from its guess, relative to it: beyond, it is another's.
const NEAR: f64 = 1e-2;

/// Motions slower than this share of the largest creep against dashpots.
const SLOW: f64 = 1e-2;

/// A harmonic over all its unknowns; modes have shares of the kinetic energy of the contact's and of the `axial` ones.
pub(super) fn of_all_unknowns(
    harmonic: HarmonicTangent,
    axial: &[usize],
    is_standing: bool,
) -> HarmonicProblem {
    let mass = &harmonic.mass[0];
    let rows = |unknowns: &[usize]| {
        let mut own = BandedMatrix::zeros(mass.dimension(), mass.half_bandwidth());
        for &row in unknowns {
            mass.columns(row).for_each(|column| own.add(row, column, mass.get(row, column)));
        }
        own
    };
    let shares = Some([rows(&harmonic.contact), rows(axial)]);
    HarmonicProblem::new(HarmonicTangent { shares, ..harmonic }, is_standing)
}

/// Every point of the branches that come below the margin of the range, solved in `problem`.
pub(super) fn refined(
    mut small: HarmonicPaths,
    problem: HarmonicProblem,
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let (mut follower, largest) = (Follower::new(&problem), range.margin.sqrt());
    let lost = |guess: &Eigenpair| {
        CeaError::unrefined(problem.tangent.harmonic, guess.parameter, guess.theta)
    };
    // Losses have no meaning for a motion that does not oscillate or creeps; fast ones are not listed.
    let matters = |theta: c64| {
        let size = theta.norm();
        !problem.is_ending(theta) && size > SLOW * largest && size <= largest
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
            match found.filter(|own| away(own) <= NEAR) {
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
