//! Harmonics reduced to small spaces first: a body of revolution in three dimensions, and every one with structural damping.

use super::across::Across;
use super::completeness::{self, Verdict};
use super::damped::{Range, follow_damped};
use super::found::{Found, MARGIN, Overdamped, Wanted, WaveSweep};
use super::modes::points;
use super::modes_below::{AtRest, bound, modes_below, wanted};
use super::paths::{HarmonicPaths, follow_pairs};
use super::pencil::Pencil;
use super::problem::HarmonicProblem;
use super::reduction::Reduction;
use super::reduction_error::{ReducedPair, reduction_error};
use super::refined::{of_all_unknowns, refined};
use crate::cea::{CeaError, FrictionPoint};
use crate::fem::ModulusTable;
use crate::linalg::banded::BandedMatrix;
use crate::prestress::{HarmonicTangent, WaveTangent};
use std::f64::consts::TAU;

/// Modes at rest up to this much above the followed ones span the reduced space.
const SPAN: f64 = 1.4;

/// One harmonic ready to be followed.
struct Reduced {
    number: usize,
    reduction: Reduction,
    harmonic: HarmonicTangent,
    across: Across,
    /// Whether friction damps the motion across the sliding strongly somewhere in the range.
    is_damped: bool,
    /// Answers to what the reduction leaves out.
    pencil: Pencil,
}

/// What one harmonic has come to: its branches, the largest error of its reduction, and what does not oscillate.
type Solved = (HarmonicPaths, f64, Vec<Overdamped>);

/// The sweep of a body, for `|lambda|` up to a margin above what is wanted.
pub(super) fn solve(mut tangent: WaveTangent, asked: &Wanted<'_>) -> Result<WaveSweep, CeaError> {
    let (found, counted) = follow_all(&mut tangent, asked)?;
    // What depends on frequency by a table is no analytic function of the eigenvalue.
    let is_verified = asked.request.count_modes && tangent.tables().next().is_none();
    let verdict = match is_verified {
        true => completeness::verify(&tangent, &found.followed, found.limit, asked.grid),
        false => Verdict { counted, ..Verdict::default() },
    };
    match verdict.missed {
        Some(harmonic) => Err(CeaError::Unproven { harmonic, margin: MARGIN }),
        None => Ok(found.sweep(tangent, verdict, is_verified)),
    }
}

/// The branches of all harmonics, and those harmonics that are counted empty at rest.
pub(super) fn follow_all(
    tangent: &mut WaveTangent,
    asked: &Wanted<'_>,
) -> Result<(Found, Vec<usize>), CeaError> {
    let (limit, grid) = (asked.request.limit, asked.grid);
    let is_tabled = tangent.tables().next().is_some();
    let (bound, known) = match is_tabled {
        true => (bound(&tangent.referred_to(ModulusTable::stiffest_hz), limit)?.0, Vec::new()),
        false => bound(tangent, limit)?,
    };
    // As many modes lie below a frequency as with the moduli of that frequency, as long as these rise less than its square.
    let highest = bound.sqrt() * MARGIN / TAU;
    *tangent = tangent.referred_to(|_| highest);
    let (mut found, counted) = modes_below(tangent, bound * (MARGIN * SPAN).powi(2), known)?;
    let wanted = match is_tabled {
        true => bound,
        false => wanted(tangent, &found, limit, bound)?,
    };
    let margin = wanted * MARGIN * MARGIN;
    found.retain(|found| found.modes.iter().any(|mode| mode.0 < margin));

    // Each harmonic by itself.
    let kept = asked.kept();
    let solved: Result<Vec<Solved>, CeaError> =
        crate::parallel::map(reduce(tangent, found, grid, margin), |found| {
            follow(tangent, found, &kept, (grid, wanted))
        });
    let (mut followed, mut overdamped, mut error) = (Vec::new(), Vec::new(), 0.0_f64);
    for (paths, own_error, slow) in solved? {
        followed.push(paths);
        overdamped.extend(slow);
        error = error.max(own_error);
    }
    let found = Found {
        points: points(tangent, &followed, asked),
        followed,
        limit: wanted.sqrt(),
        margin: margin.sqrt(),
        reduction_error: error,
        overdamped: match tangent.components {
            2 => Vec::new(),
            _ => overdamped_at(grid, &overdamped),
        },
    };
    check_tables(tangent, &found.points)?;
    Ok((found, counted))
}

/// The branches of one harmonic with `|lambda|^2` up to a margin above `wanted`.
fn follow(
    tangent: &WaveTangent,
    found: Reduced,
    kept: &[f64],
    (grid, wanted): (&[f64], f64),
) -> Result<Solved, CeaError> {
    let margin = wanted * MARGIN * MARGIN;
    let n = found.number;
    let axial = tangent.axial_unknowns();
    let problem = || {
        let reduced = found.reduction.tangent(&found.harmonic, &found.across, &axial);
        HarmonicProblem::new(reduced, tangent.is_standing(n))
    };
    let kappas = found.reduction.kappas.iter().enumerate();
    let pairs: Vec<(f64, Vec<f64>)> = kappas
        .take_while(|(_, kappa)| **kappa < margin)
        .map(|(k, &kappa)| (kappa, found.reduction.mode(k)))
        .collect();
    let damped = || {
        let range = Range { grid, kept, largest: margin.sqrt() };
        follow_damped(problem(), &pairs, &range)
    };
    let (paths, overdamped) = match found.is_damped {
        true => damped()?,
        // Where a branch stops to oscillate nevertheless, others may begin to.
        false => match follow_pairs(problem(), &pairs, grid, kept) {
            Ok(paths) if paths.are_whole() => (paths, Vec::new()),
            _ => damped()?,
        },
    };
    if tangent.is_lossy() {
        let problem = of_all_unknowns(found.harmonic, &axial, tangent.is_standing(n));
        let paths = refined(paths, problem, (kept, margin.sqrt()))?;
        return Ok((paths, 0.0, overdamped));
    }
    let error = largest_error(&paths, (&found.reduction, &found.harmonic, &found.pencil), wanted);
    Ok((HarmonicPaths { space: Some(found.reduction), ..paths }, error, overdamped))
}

/// Refuses modes whose stiffness follows from a table that does not reach them.
fn check_tables(tangent: &WaveTangent, points: &[FrictionPoint]) -> Result<(), CeaError> {
    for (point, mode) in points.iter().flat_map(|p| p.modes.iter().map(move |mode| (p, mode))) {
        let frequency_hz = mode.frequency_hz();
        if let Some(own) = tangent.tables().find(|own| !own.table.covers(frequency_hz)) {
            let mu = point.friction_coefficient;
            return Err(CeaError::beyond_table(&own.table, mu, frequency_hz));
        }
    }
    Ok(())
}

/// The overdamped motions of all harmonics at each friction value.
fn overdamped_at(grid: &[f64], overdamped: &[Overdamped]) -> Vec<Overdamped> {
    let at = |&friction: &f64| {
        let own = overdamped.iter().filter(|own| own.friction_coefficient == friction);
        let none =
            Overdamped { friction_coefficient: friction, count: 0, decay: [f64::INFINITY, 0.0] };
        own.fold(none, |sum, own| Overdamped {
            count: sum.count + own.count,
            decay: [sum.decay[0].min(own.decay[0]), sum.decay[1].max(own.decay[1])],
            ..sum
        })
    };
    grid.iter().map(at).collect()
}

/// The largest [`reduction_error`] of the paths of a harmonic that end below `|lambda|^2 = wanted`.
fn largest_error(
    paths: &HarmonicPaths,
    (reduction, harmonic, pencil): (&Reduction, &HarmonicTangent, &Pencil),
    wanted: f64,
) -> f64 {
    let ends = paths.paths.iter().filter_map(|path| path.points.last());
    let errors = ends.map(|end| {
        let pair = ReducedPair {
            friction_coefficient: end.parameter,
            eigenvalue: paths.problem.eigenvalue(end.theta),
            right: &end.x,
            left: &end.y,
        };
        let is_listed = pair.eigenvalue.norm_sqr() <= wanted && !paths.problem.is_ending(end.theta);
        if is_listed { reduction_error(reduction, harmonic, pencil, &pair) } else { 0.0 }
    });
    errors.fold(0.0, f64::max)
}

/// The harmonics on small spaces, for friction coefficients up to the last of `grid` and `|lambda|^2` up to `margin`.
fn reduce(tangent: &WaveTangent, found: Vec<AtRest>, grid: &[f64], margin: f64) -> Vec<Reduced> {
    let (touched, sideways) = (tangent.pressed_unknowns(), tangent.sideways_unknowns());
    let friction = grid[grid.len() - 1];
    let solve = |found: AtRest| {
        let harmonic = tangent.harmonic(found.harmonic);
        let columns = tangent.normal_columns(found.harmonic);
        let lossy = harmonic.losses.iter().map(|(_, own)| &own[0]);
        // Damping of parts, other than that of the whole body.
        let damped =
            harmonic.damping.iter().map(|own| &own[0]).filter(|_| tangent.has_own_damping());
        let lossy: Vec<&BandedMatrix> = lossy.chain(damped).collect();
        let loads = (&touched[..], &lossy[..]);
        let (pencil, across) = (found.pencil, Across::new(&harmonic, &sideways));
        let is_damped = across.are_strong(&found.modes, friction);
        let held = match is_damped {
            true => across.held_modes(&pencil, margin * SPAN * SPAN),
            false => Vec::new(),
        };
        let reduction = Reduction::new(&pencil, columns, loads, (found.modes, held));
        let answering = is_damped.then(|| across.added_to(&pencil, friction * margin.sqrt()));
        Reduced {
            number: found.harmonic,
            reduction: if is_damped { reduction.turned(&across) } else { reduction },
            is_damped,
            harmonic,
            across,
            pencil: answering.flatten().unwrap_or(pencil),
        }
    };
    crate::parallel::map(found, solve)
}
