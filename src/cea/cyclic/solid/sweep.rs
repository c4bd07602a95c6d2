//! A sweep over the friction coefficient in three dimensions.

use super::reduction::{Reduction, moving};
use super::rest::Pencil;
use crate::cea::cyclic::Coverage;
use crate::cea::cyclic::branch::branches_of;
use crate::cea::cyclic::modes::{ShapeProducer, point};
use crate::cea::cyclic::paths::{HarmonicPaths, Waves, follow_pairs};
use crate::cea::cyclic::problem::HarmonicProblem;
use crate::cea::cyclic::sweep::occurs_in;
use crate::cea::{CeaError, FrictionPoint, FrictionSweep, ModeBranch, ModeLimit, SweepRequest};
use crate::contact::SlidingContact;
use crate::fem::ElasticMaterial;
use crate::linalg::c64;
use crate::mesh::{SolidSector, SolidSpecification};
use crate::prestress::{PrestressError, SolidHarmonic, SolidTangent, TangentOptions};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Everything that an analysis of a body of revolution is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidModel {
    /// The body and its mesh.
    pub specification: SolidSpecification,
    /// Its material.
    pub material: ElasticMaterial,
    /// Choices of the linearisation.
    pub options: TangentOptions,
    /// The rotor.
    pub contact: SlidingContact,
}

/// A sweep with everything that the symmetry reveals.
#[derive(Clone, Debug)]
pub struct SolidSweep {
    /// Modes at each friction value and unstable intervals of the branches that have one of them.
    pub sweep: FrictionSweep,
    /// Which harmonics were solved.
    pub coverage: Coverage,
    /// Unknowns of all harmonics.
    pub dofs: usize,
}

/// Branches are followed from this much above the highest frequency wanted.
const MARGIN: f64 = 1.2;

/// Modes at rest up to this much above the followed ones span the reduced space.
const SPAN: f64 = 1.4;

/// Harmonics without a mode in a row after which only some of the higher ones are counted: short waves around are stiff.
const EMPTY: usize = 3;

/// One harmonic ready to be followed.
struct Reduced {
    harmonic: usize,
    reduction: Reduction,
    problem: HarmonicProblem,
}

/// Eigenvalues of steady sliding of a body of revolution over a range of friction coefficients.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given. Without friction the modes are complete by
/// inertia counts.
///
/// # Errors
/// [`CeaError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn solid_sweep(model: &SolidModel, request: &SweepRequest<'_>) -> Result<SolidSweep, CeaError> {
    let grid = request.rising_grid()?;
    request.limit.check()?;
    let sector = SolidSector::generate(&model.specification)?;
    let tangent =
        SolidTangent::linearize(&sector, &model.material, &model.options, &model.contact)?;
    let bound = bound(&tangent, request.limit)?;
    let (reduced, empty) = reduce(&tangent, bound * (MARGIN * SPAN).powi(2))?;
    let wanted = wanted(&tangent, &reduced, request.limit, bound)?;
    let margin = wanted * MARGIN * MARGIN;
    let followed: Result<Vec<(HarmonicPaths, Reduction)>, CeaError> = reduced
        .into_par_iter()
        .map(|found| {
            let kappas = found.reduction.kappas.iter().enumerate();
            let pairs = kappas
                .take_while(|(_, kappa)| **kappa < margin)
                .map(|(k, &kappa)| {
                    let mut x = vec![0.0; found.problem.dimension];
                    x[k] = 1.0;
                    (kappa, x)
                });
            let pairs: Vec<_> = pairs.collect();
            let paths = follow_pairs(found.problem, &pairs, &grid, request.shapes_at)?;
            Ok((paths, found.reduction))
        })
        .collect();
    let (mut followed, mut reductions): (Vec<_>, Vec<_>) = followed?.into_iter().unzip();
    let has_paths: Vec<bool> = followed
        .iter()
        .map(|paths: &HarmonicPaths| !paths.paths.is_empty())
        .collect();
    let mut keep = has_paths.iter();
    followed.retain(|_| *keep.next().unwrap_or(&true));
    let mut keep = has_paths.iter();
    reductions.retain(|_| *keep.next().unwrap_or(&true));
    let direction = tangent.base().sliding_direction;
    let expand = |n: usize, waves: Waves, x: &[c64]| {
        let own = followed
            .iter()
            .position(|paths| paths.problem.harmonic == n);
        own.map_or(Vec::new(), |k| {
            shape(&tangent, n, waves, &reductions[k].expand(x))
        })
    };
    let producer = ShapeProducer {
        sliding_direction: direction,
        expand: &expand,
    };
    let points: Vec<FrictionPoint> = request
        .friction_coefficients
        .iter()
        .map(|&friction| point(&producer, &followed, friction, request))
        .collect();
    let branches: Vec<Vec<ModeBranch>> = followed
        .par_iter()
        .map(|paths| branches_of(paths, direction))
        .collect();
    let branches = branches
        .into_iter()
        .flatten()
        .filter(|branch| occurs_in(branch, &points));
    let branches: Vec<ModeBranch> = branches.collect();
    let mut intervals: Vec<_> = branches.iter().flat_map(|b| b.intervals.clone()).collect();
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    let coverage = Coverage {
        largest_harmonic: sector.sector_count() / 2,
        followed: followed
            .iter()
            .map(|paths| paths.problem.harmonic)
            .collect(),
        proven_empty: Vec::new(),
        counted_empty: empty,
        limit_hz: wanted.sqrt() / TAU,
        margin_hz: margin.sqrt() / TAU,
        factorizations: followed.iter().map(|paths| paths.factorizations).sum(),
    };
    Ok(SolidSweep {
        sweep: FrictionSweep { points, intervals },
        coverage,
        dofs: tangent.unknown_of().iter().flatten().count() * sector.sector_count(),
    })
}

fn waves(tangent: &SolidTangent, n: usize) -> usize {
    if tangent.is_standing(n) { 1 } else { 2 }
}

fn pencil(
    tangent: &SolidTangent,
    n: usize,
    rigid: &[(usize, Option<usize>, f64)],
) -> Result<Pencil, CeaError> {
    let [mass, stiffness] = tangent.at_rest(n);
    let moving = moving(mass.dimension(), rigid);
    let (mass, stiffness) = (
        mass.restricted_to(&moving),
        stiffness.restricted_to(&moving),
    );
    Pencil::new(mass, stiffness).ok_or(CeaError::Prestress(PrestressError::Singular))
}

/// A bound of `kappa` at rest of the modes wanted, from above.
fn bound(tangent: &SolidTangent, limit: ModeLimit) -> Result<f64, CeaError> {
    let asked = match limit {
        ModeLimit::MaxFrequency(value) => return Ok((TAU * value).powi(2)),
        ModeLimit::Lowest(asked) => asked,
    };
    let rigid = tangent.rigid();
    let largest = tangent.sector().sector_count() / 2;
    let few = largest.min(3);
    let found: Result<Vec<Vec<f64>>, CeaError> = (0..=few)
        .into_par_iter()
        .map(|n| {
            let modes = pencil(tangent, n, &rigid)?.lowest(asked.div_ceil(2 * few.max(1)) + 1);
            let waves = waves(tangent, n);
            Ok(modes
                .into_iter()
                .flat_map(|(kappa, _)| vec![kappa; waves])
                .collect())
        })
        .collect();
    just_above(asked, found?.into_iter().flatten().collect())
}

/// A little more than the lowest `kappa` but `asked - 1`.
fn just_above(asked: usize, mut kappas: Vec<f64>) -> Result<f64, CeaError> {
    kappas.sort_by(f64::total_cmp);
    let total = kappas.len();
    kappas
        .get(asked - 1)
        .map(|kappa| kappa * (1.0 + 1e-9))
        .ok_or(CeaError::TooManyModes { asked, total })
}

/// `kappa` at rest up to which the modes wanted lie.
fn wanted(
    tangent: &SolidTangent,
    reduced: &[Reduced],
    limit: ModeLimit,
    bound: f64,
) -> Result<f64, CeaError> {
    let ModeLimit::Lowest(asked) = limit else {
        return Ok(bound);
    };
    let all = reduced.iter().flat_map(|found| {
        let waves = waves(tangent, found.harmonic);
        found
            .reduction
            .kappas
            .iter()
            .flat_map(move |&kappa| vec![kappa; waves])
    });
    just_above(asked, all.collect())
}

/// The harmonics that have modes below `kappa` at rest, reduced, and those counted empty.
fn reduce(tangent: &SolidTangent, kappa: f64) -> Result<(Vec<Reduced>, Vec<usize>), CeaError> {
    let largest = tangent.sector().sector_count() / 2;
    let groups = groups(tangent);
    let [contact, axial, touched] = &groups;
    let solve = |n: usize| -> Result<Option<Reduced>, CeaError> {
        let harmonic: SolidHarmonic = tangent.harmonic(n);
        let pencil = pencil(tangent, n, &harmonic.rigid)?;
        let counted = pencil.count_below(kappa);
        if counted == 0 {
            return Ok(None);
        }
        let modes = pencil.lowest(counted);
        let found = modes.iter().filter(|mode| mode.0 < kappa).count();
        if found != counted {
            return Err(CeaError::Incomplete {
                harmonic: n,
                counted,
                found,
            });
        }
        let reduction = Reduction::new(&pencil, &harmonic, touched, modes);
        let reduced = reduction.tangent(n, &harmonic, [contact, axial], tangent.rayleigh());
        Ok(Some(Reduced {
            harmonic: n,
            problem: HarmonicProblem::new(reduced, tangent.is_standing(n)),
            reduction,
        }))
    };
    let (mut reduced, mut empty) = (Vec::new(), Vec::new());
    let (mut n, mut in_a_row, mut step) = (0, 0, 1);
    while n <= largest {
        // Several harmonics side by side.
        let batch: Vec<usize> = (0..if step == 1 { 4 } else { 1 })
            .map(|k| n + k)
            .filter(|n| *n <= largest)
            .collect();
        let found: Result<Vec<Option<Reduced>>, CeaError> =
            batch.par_iter().map(|&n| solve(n)).collect();
        for (&n, found) in batch.iter().zip(found?) {
            in_a_row = if found.is_some() { 0 } else { in_a_row + 1 };
            if found.is_none() {
                empty.push(n);
            }
            reduced.extend(found);
        }
        n = batch[batch.len() - 1];
        step = if in_a_row >= EMPTY { 1 + n / 2 } else { 1 };
        n = if n < largest {
            (n + step).min(largest)
        } else {
            n + 1
        };
    }
    Ok((reduced, empty))
}

/// Unknowns of the contact's nodes, of axial motion, and along and across the sliding of pressed nodes.
fn groups(tangent: &SolidTangent) -> [Vec<usize>; 3] {
    let (sector, unknown_of) = (tangent.sector(), tangent.unknown_of());
    let face = sector.specification.contact.face();
    let nodes = || sector.rings.iter().flat_map(|ring| &ring.nodes);
    let of =
        |dofs: &mut dyn Iterator<Item = usize>| dofs.filter_map(|dof| unknown_of[dof]).collect();
    let normal = face.normal_component();
    let has_penalty = tangent.rigid().is_empty();
    let pressed = tangent.base().normal_forces.iter().map(|(node, _)| node);
    [
        of(&mut nodes().flat_map(|node| [0, 1, 2].map(|c| 3 * node + c))),
        of(&mut (0..sector.node_count()).map(|node| 3 * node + 2)),
        of(&mut pressed.flat_map(|node| {
            let components = [Some(1), Some(2 - normal), has_penalty.then_some(normal)];
            components.into_iter().flatten().map(move |c| 3 * node + c)
        })),
    ]
}

/// Displacement of all nodes in nodal frames, `U e^{i n theta}`, largest nodal `|u|` one and real in its largest component.
fn shape(tangent: &SolidTangent, n: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let sector = tangent.sector();
    let is_backward = waves == Waves::Backward;
    let value = |dof: usize| {
        let value = tangent.unknown_of()[dof].map_or(c64::new(0.0, 0.0), |unknown| x[unknown]);
        let turned = if dof % 3 == 1 {
            value * c64::new(0.0, 1.0)
        } else {
            value
        };
        if is_backward { turned.conj() } else { turned }
    };
    let wave: Vec<[c64; 3]> = (0..sector.node_count())
        .map(|node| [0, 1, 2].map(|c| value(3 * node + c)))
        .collect();
    let size = |u: &[c64; 3]| u.iter().map(|v| v.norm_sqr()).sum::<f64>();
    let peak = wave.iter().fold(
        &wave[0],
        |best, u| if size(u) > size(best) { u } else { best },
    );
    let larger = peak.iter().fold(
        peak[0],
        |best, v| if v.norm() > best.norm() { *v } else { best },
    );
    let scale = larger.conj() / (larger.norm() * size(peak).sqrt()).max(f64::MIN_POSITIVE);
    let sectors = sector.sector_count();
    let sign = if is_backward { -1.0 } else { 1.0 };
    let mut shape = Vec::with_capacity(3 * wave.len() * sectors);
    for j in 0..sectors {
        for (node, u) in sector.nodes.iter().zip(&wave) {
            let turns = n * (2 * j + node.half_step) % (2 * sectors);
            let angle = sign * PI * turns as f64 / sectors as f64;
            let phase = c64::new(angle.cos(), angle.sin()) * scale;
            shape.extend(u.map(|v| v * phase));
        }
    }
    shape
}
