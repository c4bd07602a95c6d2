//! The modes at one friction value, from the followed branches.

use super::branch::{direction_of, eigenvalue_of, waves_of};
use super::path::{Path, Waves};
use super::paths::HarmonicPaths;
use super::problem::HarmonicProblem;
use crate::cea::{ComplexMode, FrictionPoint, ModeLimit, ModeWave, SweepRequest, keeping_ties};
use crate::linalg::c64;
use crate::prestress::WaveTangent;
use std::f64::consts::{PI, TAU};

/// Displacement of all nodes of a wave of a harmonic from its unknowns.
pub(super) type Expand<'a> = dyn Fn(usize, Waves, &[c64]) -> Vec<c64> + Sync + 'a;

/// All unknowns of a harmonic from those that it is solved in.
pub(super) type Unknowns<'a> = dyn Fn(usize, &[c64]) -> Vec<c64> + Sync + 'a;

/// What turns paths into modes.
pub(super) struct ShapeProducer<'a> {
    /// Sense of the friction force.
    pub sliding_direction: f64,
    /// Displacement of all nodes of a wave of a harmonic.
    pub expand: &'a Expand<'a>,
    /// Friction coefficients at which the waves of one sector are wanted.
    pub waves_at: &'a [f64],
    /// All unknowns of a harmonic from those that it is solved in.
    pub unknowns: &'a Unknowns<'a>,
}

/// The modes wanted at one friction value.
pub(super) fn point(
    producer: &ShapeProducer<'_>,
    followed: &[HarmonicPaths],
    friction: f64,
    request: &SweepRequest<'_>,
) -> FrictionPoint {
    let mut modes = Vec::new();
    for paths in followed {
        for path in &paths.paths {
            for &waves in waves_of(path.waves) {
                modes.extend(mode(producer, &paths.problem, path, waves, friction, request));
            }
        }
    }
    let key = |mode: &ComplexMode| (mode.harmonic, mode.branch, mode.direction);
    modes.sort_by(|a, b| {
        let by_frequency = a.eigenvalue.im.total_cmp(&b.eigenvalue.im);
        by_frequency.then_with(|| key(a).cmp(&key(b)))
    });
    if let ModeLimit::Lowest(count) = request.limit {
        modes.truncate(keeping_ties(modes.iter().map(|mode| mode.eigenvalue.im), count));
    }
    FrictionPoint { friction_coefficient: friction, modes, above: Vec::new() }
}

/// One wave of a path at one friction value, if it oscillates below the limit.
fn mode(
    producer: &ShapeProducer<'_>,
    problem: &HarmonicProblem,
    path: &Path,
    waves: Waves,
    friction: f64,
    request: &SweepRequest<'_>,
) -> Option<ComplexMode> {
    let found = path.points.binary_search_by(|p| p.parameter.total_cmp(&friction)).ok()?;
    let pair = &path.points[found];
    let (eigenvalue, _) = eigenvalue_of(problem, waves, pair.theta);
    if let ModeLimit::MaxFrequency(limit) = request.limit
        && eigenvalue.im > TAU * limit
    {
        return None;
    }
    if eigenvalue.im <= 0.0 || problem.is_ending(pair.theta) {
        return None;
    }
    let direction = direction_of(problem, waves, producer.sliding_direction);
    let wants_shape = request.shapes_at.contains(&friction);
    let wants_wave = producer.waves_at.contains(&friction);
    Some(ComplexMode {
        eigenvalue,
        harmonic: problem.tangent.harmonic,
        branch: path.branch,
        direction: if friction == 0.0 { 0 } else { direction },
        residual: pair.residual,
        uncertainty: pair.uncertainty,
        contact_share: pair.contact_share,
        axial_share: Some(pair.axial_share).filter(|share| !share.is_nan()),
        shape: wants_shape.then(|| (producer.expand)(problem.tangent.harmonic, waves, &pair.x)),
        left: None,
        nodal_diameters: None,
        wave: wants_wave.then(|| ModeWave {
            unknowns: (producer.unknowns)(problem.tangent.harmonic, &pair.x),
            is_backward: waves == Waves::Backward,
        }),
    })
}

/// Displacement of all nodes in nodal frames, `U e^{i n theta}`, of `U = (u_r, -i u_theta, ...)` over the nodes of a sector:
/// largest nodal `|u|` one and real in its largest component.
pub(super) fn expand(tangent: &WaveTangent, harmonic: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let is_backward = waves == Waves::Backward;
    let (components, sectors) = (tangent.components, tangent.sector_count());
    let mut wave = tangent.displacement(x);
    for (dof, u) in wave.iter_mut().enumerate() {
        if dof % components == 1 {
            *u *= c64::new(0.0, 1.0);
        }
        if is_backward {
            *u = u.conj();
        }
    }
    let own = |node: usize| &wave[components * node..components * (node + 1)];
    let size = |u: &[c64]| u.iter().map(|v| v.norm_sqr()).sum::<f64>();
    let nodes = tangent.nodes.iter().map(|(node, _)| own(*node));
    let peak = nodes.fold(own(tangent.nodes[0].0), |best, u| match size(u) > size(best) {
        true => u,
        false => best,
    });
    let larger =
        peak.iter().fold(peak[0], |best, v| if v.norm() > best.norm() { *v } else { best });
    let scale = larger.conj() / (larger.norm() * size(peak).sqrt()).max(f64::MIN_POSITIVE);
    let sign = if is_backward { -1.0 } else { 1.0 };
    let phases = (0..2 * sectors).map(|turns| {
        let angle = sign * PI * turns as f64 / sectors as f64;
        c64::new(angle.cos(), angle.sin()) * scale
    });
    let phases: Vec<c64> = phases.collect();
    let nodes = (0..sectors).flat_map(|j| tangent.nodes.iter().map(move |place| (j, place)));
    let shape = nodes.flat_map(|(j, (node, half))| {
        let phase = phases[harmonic * (2 * j + half) % (2 * sectors)];
        own(*node).iter().map(move |v| v * phase)
    });
    shape.collect()
}
