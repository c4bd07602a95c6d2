//! A sweep over the friction coefficient.

use super::branch::{ModeBranch, branches_of, direction_of, eigenvalue_of, waves_of};
use super::paths::{HarmonicPaths, Path, Waves, follow_harmonic};
use super::problem::HarmonicProblem;
use super::{CyclicError, rest};
use crate::cea::{ComplexMode, FrictionPoint, FrictionSweep};
use crate::contact::SlidingContact;
use crate::fem::ElasticMaterial;
use crate::mesh::{AnnulusSpecification, SectorMesh};
use crate::prestress::{SectorTangent, TangentOptions};
use faer::c64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Which modes are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeLimit {
    /// So many of lowest frequency, `+n` and `-n` counted singly.
    Lowest(usize),
    /// All up to this frequency, Hz.
    MaxFrequency(f64),
}

/// What a sweep is to find.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepRequest<'a> {
    /// Friction coefficients, in any order.
    pub friction_coefficients: &'a [f64],
    /// Modes wanted at each of them.
    pub limit: ModeLimit,
    /// Those of the friction coefficients at which mode shapes are wanted.
    pub shapes_at: &'a [f64],
}

/// Which harmonics were solved, and why no other can matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Highest harmonic of the mesh, `N_theta / 2`.
    pub largest_harmonic: usize,
    /// Harmonics with modes below the margin, whose branches were followed.
    pub followed: Vec<usize>,
    /// Frequency up to which branches were followed from rest, Hz.
    pub margin_hz: f64,
    /// LU factorizations done.
    pub factorizations: usize,
}

/// A sweep with everything that the symmetry reveals.
#[derive(Clone, Debug)]
pub struct CyclicSweep {
    /// Modes at each friction value and unstable intervals of the branches that have one of them.
    pub sweep: FrictionSweep,
    /// The branches of all modes that occur in the sweep.
    pub branches: Vec<ModeBranch>,
    /// Which harmonics were solved, and why.
    pub coverage: Coverage,
    /// The linearisation, for sensitivities.
    pub tangent: SectorTangent,
}

/// Branches are followed from this much above the highest frequency wanted: friction may carry a mode
/// down into the range.
const MARGIN: f64 = 1.2;

/// Eigenvalues of steady sliding over a range of friction coefficients.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given.
///
/// # Errors
/// [`CyclicError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn sweep(
    specification: &AnnulusSpecification,
    material: &ElasticMaterial,
    options: &TangentOptions,
    contact: &SlidingContact,
    request: &SweepRequest<'_>,
) -> Result<CyclicSweep, CyclicError> {
    let grid = rising_grid(request.friction_coefficients)?;
    let sector = SectorMesh::generate(specification)?;
    let tangent = SectorTangent::linearize(&sector, material, options, contact)?;
    let rest = kappa_limit(&tangent, request.limit)?;
    let limit = rest * MARGIN * MARGIN;
    let problems: Vec<HarmonicProblem> = harmonics_below(&tangent, limit);
    let kept: Vec<f64> = request.shapes_at.to_vec();
    let followed: Result<Vec<HarmonicPaths>, CyclicError> = problems
        .into_par_iter()
        .map(|problem| follow_harmonic(problem, limit, &grid, &kept))
        .collect();
    let followed = followed?;
    let coverage = Coverage {
        largest_harmonic: tangent.largest_harmonic(),
        followed: followed
            .iter()
            .map(|paths| paths.problem.harmonic)
            .collect(),
        margin_hz: limit.sqrt() / TAU,
        factorizations: followed.iter().map(|paths| paths.factorizations).sum(),
    };
    let direction = tangent.base().sliding_direction;
    let points: Vec<FrictionPoint> = request
        .friction_coefficients
        .iter()
        .map(|&friction| point(&tangent, &followed, friction, request))
        .collect();
    let branches: Vec<Vec<ModeBranch>> = followed
        .par_iter()
        .map(|paths| branches_of(paths, direction))
        .collect();
    let branches: Vec<ModeBranch> = branches
        .into_iter()
        .flatten()
        .filter(|branch| occurs_in(branch, &points))
        .collect();
    let mut intervals: Vec<_> = branches.iter().flat_map(|b| b.intervals.clone()).collect();
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    Ok(CyclicSweep {
        sweep: FrictionSweep { points, intervals },
        branches,
        coverage,
        tangent,
    })
}

fn rising_grid(values: &[f64]) -> Result<Vec<f64>, CyclicError> {
    if values.is_empty() {
        return Err(CyclicError::NoFriction);
    }
    if let Some(&value) = values.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
        return Err(CyclicError::Friction { value });
    }
    let mut grid = values.to_vec();
    grid.sort_by(f64::total_cmp);
    grid.dedup();
    Ok(grid)
}

/// Problems of the harmonics that have a mode below `limit` without friction: all harmonics are looked at.
fn harmonics_below(tangent: &SectorTangent, limit: f64) -> Vec<HarmonicProblem> {
    (0..=tangent.largest_harmonic())
        .into_par_iter()
        .filter_map(|n| {
            let problem = HarmonicProblem::new(tangent.harmonic(n), tangent.is_standing(n));
            let (mass, stiffness) = problem.at_rest();
            (rest::count_below(mass, stiffness, limit) > 0).then_some(problem)
        })
        .collect()
}

/// `kappa` at rest below which the modes wanted lie.
fn kappa_limit(tangent: &SectorTangent, limit: ModeLimit) -> Result<f64, CyclicError> {
    let asked = match limit {
        ModeLimit::MaxFrequency(value) if value > 0.0 && value.is_finite() => {
            return Ok((TAU * value).powi(2));
        }
        ModeLimit::MaxFrequency(value) => {
            let key = "max_frequency_hz";
            return Err(CyclicError::Limit { key, value });
        }
        ModeLimit::Lowest(0) => {
            let key = "modes";
            return Err(CyclicError::Limit { key, value: 0.0 });
        }
        ModeLimit::Lowest(asked) => asked,
    };
    let waves = |n: usize| if tangent.is_standing(n) { 1 } else { 2 };
    let total = (0..=tangent.largest_harmonic())
        .map(|n| waves(n) * tangent.dimension())
        .sum();
    if asked > total {
        return Err(CyclicError::TooManyModes { asked, total });
    }
    // Fourfold steps in kappa, twofold in frequency, until there are enough.
    let mut limit = 1e6;
    loop {
        let problems = harmonics_below(tangent, limit);
        let mut found: Vec<f64> = problems
            .par_iter()
            .flat_map_iter(|problem| {
                let (mass, stiffness) = problem.at_rest();
                let pairs = rest::eigenpairs_below(mass, stiffness, limit);
                let repeat = waves(problem.harmonic);
                pairs
                    .into_iter()
                    .flat_map(move |(kappa, _)| vec![kappa; repeat])
            })
            .collect();
        if found.len() >= asked {
            found.sort_by(f64::total_cmp);
            return Ok(found[asked - 1] * (1.0 + 1e-9));
        }
        limit *= 4.0;
    }
}

fn occurs_in(branch: &ModeBranch, points: &[FrictionPoint]) -> bool {
    let is_same =
        |mode: &ComplexMode| (mode.harmonic, mode.branch) == (branch.harmonic, branch.branch);
    points.iter().any(|point| point.modes.iter().any(is_same))
}

/// The modes wanted at one friction value.
fn point(
    tangent: &SectorTangent,
    followed: &[HarmonicPaths],
    friction: f64,
    request: &SweepRequest<'_>,
) -> FrictionPoint {
    let mut modes = Vec::new();
    for paths in followed {
        for path in &paths.paths {
            for &waves in waves_of(path.waves) {
                modes.extend(mode(
                    tangent,
                    &paths.problem,
                    path,
                    waves,
                    friction,
                    request,
                ));
            }
        }
    }
    let key = |mode: &ComplexMode| (mode.harmonic, mode.branch, mode.direction);
    modes.sort_by(|a, b| {
        let by_frequency = a.eigenvalue.im.total_cmp(&b.eigenvalue.im);
        by_frequency.then_with(|| key(a).cmp(&key(b)))
    });
    if let ModeLimit::Lowest(count) = request.limit {
        modes.truncate(count);
    }
    FrictionPoint {
        friction_coefficient: friction,
        modes,
    }
}

/// One wave of a path at one friction value, if it oscillates below the limit.
fn mode(
    tangent: &SectorTangent,
    problem: &HarmonicProblem,
    path: &Path,
    waves: Waves,
    friction: f64,
    request: &SweepRequest<'_>,
) -> Option<ComplexMode> {
    let found = path
        .points
        .binary_search_by(|p| p.parameter.total_cmp(&friction))
        .ok()?;
    let pair = &path.points[found];
    let (eigenvalue, _) = eigenvalue_of(problem, waves, pair.theta);
    if let ModeLimit::MaxFrequency(limit) = request.limit {
        if eigenvalue.im > TAU * limit {
            return None;
        }
    }
    if eigenvalue.im <= 0.0 {
        return None;
    }
    let direction = direction_of(problem, waves, tangent.base().sliding_direction);
    let wants_shape = request.shapes_at.contains(&friction);
    Some(ComplexMode {
        eigenvalue,
        harmonic: problem.harmonic,
        branch: path.branch,
        direction: if friction == 0.0 { 0 } else { direction },
        residual: pair.residual,
        shape: wants_shape.then(|| expand(tangent, problem.harmonic, waves, &pair.x)),
    })
}

/// Displacement of all nodes in nodal frames, `U(r) e^{i n theta}`, largest nodal `|u|` one and real in
/// its larger component.
fn expand(tangent: &SectorTangent, harmonic: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let sector = tangent.sector();
    let per_sector = sector.node_count();
    let zero = c64::new(0.0, 0.0);
    let mut wave = vec![[zero; 2]; per_sector];
    for (&dof, value) in tangent.unknowns().iter().zip(x) {
        let turned = if dof % 2 == 0 {
            *value
        } else {
            value * c64::new(0.0, 1.0)
        };
        let value = if waves == Waves::Backward {
            turned.conj()
        } else {
            turned
        };
        wave[sector.numbering[dof / 2]][dof % 2] = value;
    }
    let size = |u: &[c64; 2]| u[0].norm_sqr() + u[1].norm_sqr();
    let peak = wave.iter().fold(
        [zero; 2],
        |best, u| if size(u) > size(&best) { *u } else { best },
    );
    let larger = if peak[0].norm() >= peak[1].norm() {
        peak[0]
    } else {
        peak[1]
    };
    let scale = larger.conj() / (larger.norm() * size(&peak).sqrt());
    let mut half_steps = vec![0; per_sector];
    for (node, &place) in sector.numbering.iter().enumerate() {
        half_steps[place] = sector.half_step(node);
    }
    let sectors = sector.sector_count();
    let sign = if waves == Waves::Backward { -1.0 } else { 1.0 };
    let mut shape = Vec::with_capacity(2 * per_sector * sectors);
    for j in 0..sectors {
        for (u, half) in wave.iter().zip(&half_steps) {
            let turns = harmonic * (2 * j + half) % (2 * sectors);
            let angle = sign * PI * turns as f64 / sectors as f64;
            let phase = c64::new(angle.cos(), angle.sin()) * scale;
            shape.extend([u[0] * phase, u[1] * phase]);
        }
    }
    shape
}
