//! Branches over all unknowns of a harmonic, from those of its small space.
//!
//! Losses of one part excite what the small space lacks: its eigenvalues are good guesses, no more.

use crate::cea::CeaError;
use crate::cea::cyclic::follow::Follower;
use crate::cea::cyclic::path::Eigenpair;
use crate::cea::cyclic::paths::{HarmonicPaths, are_distinct, describe};
use crate::cea::cyclic::problem::HarmonicProblem;
use crate::linalg::banded::BandedMatrix;
use crate::prestress::HarmonicTangent;
use std::f64::consts::TAU;

/// Largest distance of an eigenvalue from its guess, relative to it: beyond, it is another's.
const NEAR: f64 = 1e-2;

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

/// Every point of the branches, solved in `problem`; those at the friction coefficients `kept` have vectors.
pub(super) fn refined(
    mut small: HarmonicPaths,
    problem: HarmonicProblem,
    kept: &[f64],
) -> Result<HarmonicPaths, CeaError> {
    let mut follower = Follower::new(&problem);
    let lost = |guess: &Eigenpair| CeaError::Unrefined {
        harmonic: problem.tangent.harmonic,
        friction: guess.parameter,
        frequency_hz: guess.theta.im.abs() / TAU,
    };
    for path in &mut small.paths {
        let mut points: Vec<Eigenpair> = Vec::new();
        for guess in &path.points {
            let at = problem.at(guess.parameter);
            // The vectors of the point before tell two eigenvalues apart that lie close together.
            let found = match points.last() {
                Some(last) => follower.refine(&at, guess.parameter, guess.theta, &last.x, &last.y),
                None => follower.find(&at, guess.parameter, guess.theta),
            };
            let away = |own: &Eigenpair| (own.theta - guess.theta).norm() / guess.theta.norm();
            match found.filter(|own| away(own) <= NEAR) {
                Some(found) => points.push(found),
                // Losses have no meaning for a motion that does not oscillate.
                None if problem.is_ending(guess.theta) => break,
                None => return Err(lost(guess)),
            }
            describe(&problem, &at, &mut points, kept);
        }
        path.points = points;
    }
    small.paths.retain(|path| !path.points.is_empty());
    let ends = small.paths.iter().filter_map(|path| path.points.last());
    if let (false, Some(end)) = (are_distinct(&small.paths), ends.last()) {
        return Err(lost(end));
    }
    let factorizations = small.factorizations + follower.factorizations;
    Ok(HarmonicPaths { problem, factorizations, ..small })
}
