//! The modes at one friction value, from the followed branches.

use super::branch::{direction_of, eigenvalue_of, waves_of};
use super::path::{Path, Waves};
use super::paths::HarmonicPaths;
use super::problem::HarmonicProblem;
use crate::cea::{ComplexMode, FrictionPoint, ModeLimit, ModeWave, SweepRequest, keeping_ties};
use crate::linalg::c64;
use crate::prestress::SectorTangent;
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
    FrictionPoint { friction_coefficient: friction, modes }
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
        harmonic: problem.harmonic,
        branch: path.branch,
        direction: if friction == 0.0 { 0 } else { direction },
        residual: pair.residual,
        uncertainty: pair.uncertainty,
        contact_share: pair.contact_share,
        axial_share: Some(pair.axial_share).filter(|share| !share.is_nan()),
        shape: wants_shape.then(|| (producer.expand)(problem.harmonic, waves, &pair.x)),
        left: None,
        nodal_diameters: None,
        wave: wants_wave.then(|| ModeWave {
            unknowns: (producer.unknowns)(problem.harmonic, &pair.x),
            is_backward: waves == Waves::Backward,
        }),
    })
}

/// Displacement of all nodes in nodal frames, `U(r) e^{i n theta}`, largest nodal `|u|` one and real in
/// its larger component.
pub(super) fn expand(
    tangent: &SectorTangent,
    harmonic: usize,
    waves: Waves,
    x: &[c64],
) -> Vec<c64> {
    let sector = tangent.sector();
    let per_sector = sector.node_count();
    let zero = c64::new(0.0, 0.0);
    let mut wave = vec![[zero; 2]; per_sector];
    for (&dof, value) in tangent.unknowns().iter().zip(x) {
        let turned = if dof % 2 == 0 { *value } else { value * c64::new(0.0, 1.0) };
        let value = if waves == Waves::Backward { turned.conj() } else { turned };
        wave[sector.numbering[dof / 2]][dof % 2] = value;
    }
    // Of a pair the unknown is the distance between the two bodies.
    for node in sector.contact_nodes() {
        if let Some(opposite) = sector.opposite(node) {
            let moved = wave[sector.numbering[opposite]][0];
            wave[sector.numbering[node]][0] += moved;
        }
    }
    let size = |u: &[c64; 2]| u[0].norm_sqr() + u[1].norm_sqr();
    let peak = wave.iter().fold([zero; 2], |best, u| if size(u) > size(&best) { *u } else { best });
    let larger = if peak[0].norm() >= peak[1].norm() { peak[0] } else { peak[1] };
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
