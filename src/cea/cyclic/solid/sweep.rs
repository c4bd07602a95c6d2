//! A sweep over the friction coefficient in three dimensions.

use super::across::Across;
use super::damped::{Range, follow_damped};
use super::error::{ReducedPair, reduction_error};
use super::modes_below::{AtRest, bound, modes_below, wanted};
use super::reduction::Reduction;
use super::refined::{of_all_unknowns, refined};
use super::rest::Pencil;
use crate::cea::cyclic::Coverage;
use crate::cea::cyclic::modes::{ShapeProducer, expand, point};
use crate::cea::cyclic::path::Waves;
use crate::cea::cyclic::paths::{HarmonicPaths, follow_pairs};
use crate::cea::cyclic::problem::HarmonicProblem;
use crate::cea::cyclic::sweep::{Overdamped, WaveSweep, together};
use crate::cea::{CeaError, FrictionPoint, SweepRequest};
use crate::contact::SlidingContact;
use crate::fem::{ElasticMaterial, MaterialField, ModulusTable};
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::mesh::{SolidSector, SolidSpecification};
use crate::prestress::{HarmonicTangent, TangentOptions, WaveTangent};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Everything that an analysis of a body of revolution is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidModel<M = ElasticMaterial> {
    /// The body and its mesh.
    pub specification: SolidSpecification,
    /// The material of each of its regions.
    pub material: M,
    /// Choices of the linearisation.
    pub options: TangentOptions,
    /// The rotor.
    pub contact: SlidingContact,
}

/// Branches are followed from this much above the highest frequency wanted.
const MARGIN: f64 = 1.2;

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

/// What one harmonic has come to.
struct Solved {
    paths: HarmonicPaths,
    /// The space of its vectors; `None` where they are over all unknowns.
    reduction: Option<Reduction>,
    error: f64,
    overdamped: Vec<Overdamped>,
}

/// Eigenvalues of steady sliding of a body of revolution over a range of friction coefficients.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given. Without friction the modes are complete by
/// inertia counts.
///
/// # Errors
/// [`CeaError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn solid_sweep<M: MaterialField>(
    model: &SolidModel<M>,
    request: &SweepRequest<'_>,
) -> Result<WaveSweep, CeaError> {
    solid_sweep_with_waves(model, request, &[])
}

/// [`solid_sweep`] that keeps the waves of one sector at some of the friction coefficients.
pub fn solid_sweep_with_waves<M: MaterialField>(
    model: &SolidModel<M>,
    request: &SweepRequest<'_>,
    waves_at: &[f64],
) -> Result<WaveSweep, CeaError> {
    let grid = request.rising_grid()?;
    request.limit.check()?;
    let sector = SolidSector::generate(&model.specification)?;
    let mut tangent =
        WaveTangent::of_revolution(&sector, &model.material, &model.options, &model.contact)?;
    let is_tabled = tangent.tables().next().is_some();
    let (bound, known) = match is_tabled {
        true => {
            (bound(&tangent.referred_to(ModulusTable::stiffest_hz), request.limit)?.0, Vec::new())
        }
        false => bound(&tangent, request.limit)?,
    };
    // As many modes lie below a frequency as with the moduli of that frequency, as long as these rise less than its square.
    let highest = bound.sqrt() * MARGIN / TAU;
    tangent = tangent.referred_to(|_| highest);
    let (mut found, empty) = modes_below(&tangent, bound * (MARGIN * SPAN).powi(2), known)?;
    let wanted = match is_tabled {
        true => bound,
        false => wanted(&tangent, &found, request.limit, bound)?,
    };
    let margin = wanted * MARGIN * MARGIN;
    found.retain(|found| found.modes.iter().any(|mode| mode.0 < margin));
    let reduced = reduce(&tangent, found, &grid, margin);
    let kept = [request.shapes_at, waves_at].concat();
    let solved: Result<Vec<Solved>, CeaError> = reduced
        .into_par_iter()
        .map(|found| follow(&tangent, found, &kept, (&grid, wanted)))
        .collect();
    let (mut followed, mut reductions, mut overdamped) = (Vec::new(), Vec::new(), Vec::new());
    let mut error = 0.0_f64;
    for solved in solved? {
        followed.push(solved.paths);
        reductions.push(solved.reduction);
        error = error.max(solved.error);
        overdamped.extend(solved.overdamped);
    }
    let direction = tangent.sliding_direction;
    let unknowns = |n: usize, x: &[c64]| {
        let mut all = followed.iter().zip(&reductions);
        let own = all.find(|(paths, _)| paths.problem.tangent.harmonic == n);
        let own = own.and_then(|(_, reduction)| reduction.as_ref());
        own.map_or_else(|| x.to_vec(), |reduction| reduction.expand(x))
    };
    let expand = |n: usize, waves: Waves, x: &[c64]| expand(&tangent, n, waves, &unknowns(n, x));
    let producer = ShapeProducer {
        sliding_direction: direction,
        expand: &expand,
        waves_at,
        unknowns: &unknowns,
    };
    let frictions = request.friction_coefficients.iter();
    let points: Vec<FrictionPoint> =
        frictions.map(|&friction| point(&producer, &followed, friction, request)).collect();
    check_tables(&tangent, &points)?;
    let (sweep, branches) = together(points, &followed, direction);
    let coverage = Coverage {
        largest_harmonic: tangent.largest_harmonic(),
        followed: followed.iter().map(|paths| paths.problem.tangent.harmonic).collect(),
        proven_empty: Vec::new(),
        counted_empty: empty,
        limit_hz: wanted.sqrt() / TAU,
        margin_hz: margin.sqrt() / TAU,
        factorizations: followed.iter().map(|paths| paths.factorizations).sum(),
    };
    Ok(WaveSweep {
        sweep,
        coverage,
        dofs: tangent.dof_count() * tangent.sector_count(),
        reduction_error: error,
        branches,
        overdamped: overdamped_at(&grid, &overdamped),
        tangent,
    })
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
        return Ok(Solved { paths, reduction: None, error: 0.0, overdamped });
    }
    let whole = (&found.reduction, &found.harmonic, &found.pencil);
    Ok(Solved {
        error: largest_error(&paths, whole, wanted),
        reduction: Some(found.reduction),
        paths,
        overdamped,
    })
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
        if !across.are_strong(&found.modes, friction) {
            let modes = (found.modes, Vec::new());
            return Reduced {
                number: found.harmonic,
                reduction: Reduction::new(&pencil, columns, loads, modes),
                is_damped: false,
                harmonic,
                across,
                pencil,
            };
        }
        let held = across.held_modes(&pencil, margin * SPAN * SPAN);
        let reduction = Reduction::new(&pencil, columns, loads, (found.modes, held));
        let answering = across.added_to(&pencil, friction * margin.sqrt());
        Reduced {
            number: found.harmonic,
            reduction: reduction.turned(&across),
            is_damped: true,
            harmonic,
            across,
            pencil: answering.unwrap_or(pencil),
        }
    };
    found.into_par_iter().map(solve).collect()
}
