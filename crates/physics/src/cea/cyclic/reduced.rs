//! A harmonic reduced to a small space first: of a body of revolution in three dimensions, and every one with structural damping.

use super::across::Across;
use super::damped::follow_damped;
use super::modes_below::AtRest;
use super::paths::{HarmonicPaths, Range, follow_pairs};
use super::pencil::{Modes, Pencil};
use super::problem::HarmonicProblem;
use super::reduction::Reduction;
use super::refined::{of_all_unknowns, refined};
use crate::cea::CeaError;
use crate::linalg::banded::BandedMatrix;
use crate::prestress::{HarmonicTangent, WaveTangent};

/// Modes at rest up to this much above the followed ones span the reduced space.
pub(super) const SPAN: f64 = 1.4;

/// The branches of one harmonic up to the margin of the range, from its modes at rest up to [`SPAN`] above that.
pub(super) fn follow(
    tangent: &WaveTangent,
    AtRest { harmonic: n, pencil, modes }: AtRest,
    range: &Range<'_>,
) -> Result<HarmonicPaths, CeaError> {
    let (harmonic, axial) = (tangent.harmonic(n), tangent.axial_unknowns());
    let across = Across::new(&harmonic, &tangent.sideways_unknowns());
    // Whether friction damps the motion across the sliding strongly somewhere in the range.
    let is_damped = across.are_strong(&modes, range.highest_friction());
    let held = match is_damped {
        true => across.held_modes(&pencil, range.margin * SPAN * SPAN),
        false => Vec::new(),
    };
    let reduction = space(tangent, &harmonic, &pencil, (modes, held));
    let reduction = if is_damped { reduction.turned(&across) } else { reduction };

    // Branches in the small space.
    let problem = || {
        let reduced = reduction.tangent(&harmonic, &across, &axial);
        HarmonicProblem::new(reduced, tangent.is_standing(n))
    };
    let followed = reduction.kappas.iter().take_while(|kappa| **kappa < range.margin);
    let pairs: Modes = followed.enumerate().map(|(k, &kappa)| (kappa, reduction.mode(k))).collect();
    let oscillating = match is_damped {
        true => None,
        false => follow_pairs(problem(), &pairs, range).ok().filter(HarmonicPaths::are_whole),
    };
    // Where a branch stops to oscillate, others may begin to.
    let paths = oscillating.map_or_else(|| follow_damped(problem(), &pairs, range), Ok)?;

    // Over all unknowns, or what the small space leaves out.
    if tangent.is_lossy() {
        return refined(paths, of_all_unknowns(harmonic, &axial, tangent.is_standing(n)), range);
    }
    let added = range.highest_friction() * range.margin.sqrt();
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
    // Damping of parts, other than that of the whole body.
    let damped = harmonic.damping.iter().map(|own| &own[0]);
    let damped = damped.filter(|_| tangent.has_own_damping());
    let lossy: Vec<&BandedMatrix> = lossy.chain(damped).collect();
    let columns = tangent.normal_columns(harmonic.harmonic);
    Reduction::new(pencil, columns, (&tangent.pressed_unknowns(), &lossy), modes)
}

/// The largest [`Reduction::error`] of the paths of a harmonic that end below `|lambda|^2 = wanted`.
fn largest_error(
    paths: &HarmonicPaths,
    (reduction, harmonic, pencil): (&Reduction, &HarmonicTangent, &Pencil),
    wanted: f64,
) -> f64 {
    let ends = paths.paths.iter().filter_map(|path| path.points.last());
    let errors = ends.map(|end| {
        let lambda = paths.problem.eigenvalue(end.theta);
        let is_listed = lambda.norm_sqr() <= wanted && !paths.problem.is_ending(end.theta);
        if is_listed { reduction.error(harmonic, pencil, lambda, end) } else { 0.0 }
    });
    errors.fold(0.0, f64::max)
}
