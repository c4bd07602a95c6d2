//! A sweep over the friction coefficient.

use super::branch::branches_of;
use super::completeness::{self, Verdict};
use super::modes::{ShapeProducer, expand, point};
use super::paths::{HarmonicPaths, follow_harmonic};
use super::problem::HarmonicProblem;
use super::rest;
use crate::cea::{
    CeaError, ComplexMode, FrictionPoint, FrictionSweep, ModeBranch, ModeLimit, SweepRequest,
};
use crate::contact::SlidingContact;
use crate::fem::MaterialField;
use crate::mesh::{AnnulusSpecification, SectorMesh};
use crate::prestress::{TangentOptions, WaveTangent};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Which harmonics were solved, and why no other can matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Highest harmonic of the mesh, `N_theta / 2`.
    pub largest_harmonic: usize,
    /// Harmonics with modes below the margin, whose branches were followed; at quarters of the friction
    /// range a count by the argument principle found no other mode below the limit.
    pub followed: Vec<usize>,
    /// Harmonics proven to hold no mode below the limit at any friction coefficient of the range.
    pub proven_empty: Vec<usize>,
    /// Harmonics without a mode below the limit by count, at rest and at quarters of the friction range.
    pub counted_empty: Vec<usize>,
    /// Frequency up to which the spectrum is complete, for `|Re(lambda)|` up to a fifth of it, Hz.
    pub limit_hz: f64,
    /// Frequency up to which branches were followed from rest, Hz.
    pub margin_hz: f64,
    /// LU factorizations done.
    pub factorizations: usize,
}

/// Motions that decay without oscillating, at one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overdamped {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Number of motions: real eigenvalues, those with a frequency below a tenth of their size, and creep of the contact.
    pub count: usize,
    /// Their slowest and fastest decay, 1/s.
    pub decay: [f64; 2],
}

/// A sweep with everything that the symmetry reveals.
#[derive(Clone, Debug)]
pub struct WaveSweep {
    /// Modes at each friction value and unstable intervals of the branches that have one of them.
    pub sweep: FrictionSweep,
    /// The branches of all modes that occur in the sweep.
    pub branches: Vec<ModeBranch>,
    /// Which harmonics were solved, and why.
    pub coverage: Coverage,
    /// Unknowns of all harmonics.
    pub dofs: usize,
    /// What the reduction of the harmonics of a body in three dimensions leaves out of an eigenvalue, relative to it: the largest
    /// estimate at the largest friction coefficient.
    pub reduction_error: f64,
    /// At each friction value, rising: motions up to the margin of the coverage that do not oscillate, where friction damps the motion
    /// across the sliding strongly; each wave of a pair counts singly. None in the plane.
    pub overdamped: Vec<Overdamped>,
    /// The linearisation, for sensitivities.
    pub tangent: WaveTangent,
}

/// Branches are followed from this much above the highest frequency wanted: friction may carry a mode
/// down into the range. Raised by the same factor where that turns out to be too little.
const MARGIN: f64 = 1.2;

/// How often the margin is raised.
const MARGIN_ATTEMPTS: usize = 4;

/// Eigenvalues of steady sliding over a range of friction coefficients.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given.
///
/// # Errors
/// [`CeaError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn sweep(
    specification: &AnnulusSpecification,
    material: &dyn MaterialField,
    options: &TangentOptions,
    contact: &SlidingContact,
    request: &SweepRequest<'_>,
) -> Result<WaveSweep, CeaError> {
    sweep_with_waves(specification, material, options, contact, (request, &[]))
}

/// [`sweep`] that keeps the waves of one sector at some of the friction coefficients.
pub fn sweep_with_waves(
    specification: &AnnulusSpecification,
    material: &dyn MaterialField,
    options: &TangentOptions,
    contact: &SlidingContact,
    (request, waves_at): (&SweepRequest<'_>, &[f64]),
) -> Result<WaveSweep, CeaError> {
    let grid = request.rising_grid()?;
    request.limit.check()?;
    let sector = SectorMesh::generate(specification)?;
    let tangent = WaveTangent::of_annulus(&sector, material, options, contact)?;
    let mut margin = MARGIN;
    let mut failure = None;
    for _ in 0..MARGIN_ATTEMPTS {
        match solve(&tangent, (request, waves_at), &grid, margin, None) {
            Ok(found) => {
                let checks = checks(&grid);
                let verdict = completeness::verify(&tangent, &found.followed, found.limit, &checks);
                let Some(harmonic) = verdict.missed else {
                    return Ok(finish(tangent, found, verdict));
                };
                failure = Some(CeaError::Unproven { harmonic, margin });
            }
            // The branch that it meets may lie above the margin.
            Err(error @ CeaError::LostHarmonic { .. }) => failure = Some(error),
            Err(error) => return Err(error),
        }
        margin *= MARGIN;
    }
    Err(failure.unwrap_or(CeaError::NoFriction))
}

/// [`sweep`] over some harmonics, without a proof that no mode is missed: for the many
/// samples of a model for some of which [`sweep`] has said which harmonics hold modes.
pub fn onsets(
    specification: &AnnulusSpecification,
    material: &dyn MaterialField,
    options: &TangentOptions,
    contact: &SlidingContact,
    request: &SweepRequest<'_>,
    harmonics: &[usize],
) -> Result<FrictionSweep, CeaError> {
    let grid = request.rising_grid()?;
    request.limit.check()?;
    let sector = SectorMesh::generate(specification)?;
    let tangent = WaveTangent::of_annulus(&sector, material, options, contact)?;
    let found = solve(&tangent, (request, &[]), &grid, MARGIN, Some(harmonics))?;
    let unproven = Verdict { proven: Vec::new(), counted: Vec::new(), missed: None };
    Ok(finish(tangent, found, unproven).sweep)
}

/// Friction values, out of a rising grid, at which modes are counted: the quarters of the range.
fn checks(grid: &[f64]) -> Vec<f64> {
    let last = grid.len() - 1;
    let mut places: Vec<usize> = (1..=4).map(|quarter| last * quarter / 4).collect();
    places.dedup();
    places.into_iter().map(|place| grid[place]).collect()
}

/// Followed branches and the modes selected from them.
struct Found {
    followed: Vec<HarmonicPaths>,
    points: Vec<FrictionPoint>,
    /// Frequency up to which the selection must be complete, rad/s.
    limit: f64,
    /// Frequency up to which branches were followed from rest, rad/s.
    margin: f64,
}

fn solve(
    tangent: &WaveTangent,
    (request, waves_at): (&SweepRequest<'_>, &[f64]),
    grid: &[f64],
    margin: f64,
    harmonics: Option<&[usize]>,
) -> Result<Found, CeaError> {
    let (kappa, candidates) = match (harmonics, request.limit) {
        (Some(harmonics), ModeLimit::MaxFrequency(value)) => {
            ((TAU * value).powi(2), harmonics.to_vec())
        }
        _ => select(tangent, request.limit, margin)?,
    };
    let limit = kappa * margin * margin;
    let kept = [request.shapes_at, waves_at].concat();
    let followed: Result<Vec<HarmonicPaths>, CeaError> = candidates
        .into_par_iter()
        .map(|n| {
            let problem = HarmonicProblem::new(tangent.harmonic(n), tangent.is_standing(n));
            follow_harmonic(problem, limit, grid, &kept)
        })
        .collect();
    let mut followed = followed?;
    followed.retain(|paths| !paths.paths.is_empty());
    let producer = ShapeProducer {
        sliding_direction: tangent.sliding_direction,
        expand: &|n, waves, x| expand(tangent, n, waves, x),
        waves_at,
        unknowns: &|_, x| x.to_vec(),
    };
    let frictions = request.friction_coefficients.iter();
    let points: Vec<FrictionPoint> =
        frictions.map(|&friction| point(&producer, &followed, friction, request)).collect();
    let highest = points.iter().filter_map(|point| point.modes.last());
    let highest = highest.fold(0.0_f64, |top, mode| top.max(mode.eigenvalue.im));
    Ok(Found {
        limit: match request.limit {
            ModeLimit::Lowest(_) => highest,
            ModeLimit::MaxFrequency(value) => TAU * value,
        },
        followed,
        points,
        margin: limit.sqrt(),
    })
}

fn finish(tangent: WaveTangent, found: Found, verdict: Verdict) -> WaveSweep {
    let Found { followed, points, limit, margin } = found;
    let coverage = Coverage {
        largest_harmonic: tangent.largest_harmonic(),
        followed: followed.iter().map(|paths| paths.problem.tangent.harmonic).collect(),
        proven_empty: verdict.proven,
        counted_empty: verdict.counted,
        limit_hz: limit / TAU,
        margin_hz: margin / TAU,
        factorizations: followed.iter().map(|paths| paths.factorizations).sum(),
    };
    let (sweep, branches) = together(points, &followed, tangent.sliding_direction);
    WaveSweep {
        sweep,
        branches,
        coverage,
        dofs: tangent.unknowns().len() * tangent.sector_count(),
        reduction_error: 0.0,
        overdamped: Vec::new(),
        tangent,
    }
}

/// A sweep of its points and the paths that they are of, and the branches that have one of the modes.
pub(super) fn together(
    points: Vec<FrictionPoint>,
    followed: &[HarmonicPaths],
    sliding_direction: f64,
) -> (FrictionSweep, Vec<ModeBranch>) {
    let branches: Vec<Vec<ModeBranch>> =
        followed.par_iter().map(|paths| branches_of(paths, sliding_direction)).collect();
    let occurs = |branch: &ModeBranch| {
        let is_same =
            |mode: &ComplexMode| (mode.harmonic, mode.branch) == (branch.harmonic, branch.branch);
        points.iter().any(|point| point.modes.iter().any(is_same))
    };
    let branches: Vec<ModeBranch> = branches.into_iter().flatten().filter(occurs).collect();
    let mut intervals: Vec<_> = branches.iter().flat_map(|b| b.intervals.clone()).collect();
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    let sweep = FrictionSweep {
        crossings: vec![None; intervals.len()],
        points,
        intervals,
        ..FrictionSweep::default()
    };
    (sweep, branches)
}

/// Harmonics that have a mode with `kappa < limit` without friction: all are looked at.
fn harmonics_below(tangent: &WaveTangent, limit: f64) -> Vec<usize> {
    (0..=tangent.largest_harmonic())
        .into_par_iter()
        .filter(|&n| {
            let [mass, stiffness] = tangent.at_rest(n);
            rest::count_below(&mass, &stiffness, limit) > 0
        })
        .collect()
}

/// `kappa` at rest up to which the modes wanted lie, and the harmonics with modes below the margin
/// above it (possibly a few without).
fn select(
    tangent: &WaveTangent,
    limit: ModeLimit,
    margin: f64,
) -> Result<(f64, Vec<usize>), CeaError> {
    match limit {
        ModeLimit::MaxFrequency(value) => {
            let kappa = (TAU * value).powi(2);
            Ok((kappa, harmonics_below(tangent, kappa * margin * margin)))
        }
        ModeLimit::Lowest(asked) => select_lowest(tangent, asked, margin),
    }
}

fn select_lowest(
    tangent: &WaveTangent,
    asked: usize,
    margin: f64,
) -> Result<(f64, Vec<usize>), CeaError> {
    let waves = |n: usize| if tangent.is_standing(n) { 1 } else { 2 };
    let all = 0..=tangent.largest_harmonic();
    let total = all.map(|n| waves(n) * tangent.unknowns().len()).sum();
    if asked > total {
        return Err(CeaError::TooManyModes { asked, total });
    }
    // A few low harmonics that have enough modes bound the limit from above.
    let few: Vec<_> =
        (0..=tangent.largest_harmonic().min(7)).map(|n| (n, tangent.at_rest(n))).collect();
    let enough = few.iter().map(|(n, _)| waves(*n) * tangent.unknowns().len()).sum::<usize>();
    let enough = enough.min(asked);
    let mut bound = 1e6;
    let count = |bound: f64| -> usize {
        let counts = few
            .iter()
            .map(|(n, [mass, stiffness])| waves(*n) * rest::count_below(mass, stiffness, bound));
        counts.sum()
    };
    while count(bound) < enough {
        bound *= 1.5;
    }
    loop {
        let candidates = harmonics_below(tangent, bound * margin * margin);
        let mut found: Vec<f64> = candidates
            .par_iter()
            .flat_map_iter(|&n| {
                let [mass, stiffness] = tangent.at_rest(n);
                let pairs = rest::eigenpairs_below(&mass, &stiffness, bound);
                pairs.into_iter().flat_map(move |(kappa, _)| vec![kappa; waves(n)])
            })
            .collect();
        if found.len() >= asked {
            found.sort_by(f64::total_cmp);
            return Ok((found[asked - 1] * (1.0 + 1e-9), candidates));
        }
        bound *= 1.5;
    }
}
