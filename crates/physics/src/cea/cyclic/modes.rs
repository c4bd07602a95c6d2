//! The modes at one friction value, from the followed branches.

use super::branch::direction_of;
use crate::cea::cyclic::*;
use std::f64::consts::PI;

/// The modes wanted at every friction value that is asked for.
pub(super) fn points(
    tangent: &WaveTangent,
    followed: &[HarmonicPaths],
    wanted: &Wanted<'_>,
) -> Vec<FrictionPoint> {
    let frictions = wanted.request.friction_coefficients.iter();
    frictions.map(|&friction| point(tangent, followed, friction, wanted)).collect()
}

fn point(
    tangent: &WaveTangent,
    followed: &[HarmonicPaths],
    friction: f64,
    wanted: &Wanted<'_>,
) -> FrictionPoint {
    let mut modes = Vec::new();
    for paths in followed {
        for path in &paths.paths {
            for &waves in path.waves.singly() {
                modes.extend(mode(tangent, (paths, path), waves, friction, wanted));
            }
        }
    }
    let key = |mode: &ComplexMode| (mode.harmonic, mode.branch, mode.direction);
    modes.sort_by(|a, b| {
        a.eigenvalue.im.total_cmp(&b.eigenvalue.im).then_with(|| key(a).cmp(&key(b))) // Ties by name: one order everywhere.
    });
    let mut point = FrictionPoint::within(wanted.request.limit, friction, modes);
    point.above.iter_mut().for_each(|mode| (mode.shape, mode.wave) = (None, None)); // Only what is listed carries shapes.
    point
}

/// One wave of a path at one friction value, if it oscillates.
fn mode(
    tangent: &WaveTangent,
    (paths, path): (&HarmonicPaths, &Path),
    waves: Waves,
    friction: f64,
    Wanted { request, waves_at, .. }: &Wanted<'_>,
) -> Option<ComplexMode> {
    let problem = &paths.problem;
    let harmonic = problem.tangent.harmonic;
    let found = path.points.binary_search_by(|p| p.parameter.total_cmp(&friction)).ok()?; // Grid values are points of each path.
    let pair = &path.points[found];
    let eigenvalue = problem.eigenvalue(waves.own(pair.theta));
    if eigenvalue.im <= 0.0 || problem.is_ending(pair.theta) {
        return None;
    }
    let direction = direction_of(problem, waves, tangent.sliding_direction);
    let wants_shape = request.shapes_at.contains(&friction);
    let wants_wave = waves_at.contains(&friction);
    Some(ComplexMode {
        eigenvalue,
        harmonic,
        branch: path.branch,
        direction: if friction == 0.0 { 0 } else { direction }, // At rest nothing tells the two apart.
        residual: pair.residual,
        uncertainty: pair.uncertainty,
        contact_share: pair.contact_share,
        axial_share: Some(pair.axial_share).filter(|_| tangent.components == 3),
        shape: wants_shape
            .then(|| expand(tangent, harmonic, waves, &paths.unknowns(&pair.x)).into()),
        mesh_error: None,
        left: None,
        nodal_diameters: None,
        wave: wants_wave.then(|| ModeWave {
            unknowns: paths.unknowns(&pair.x),
            is_backward: waves == Waves::Backward,
        }),
    })
}

/// Displacement of all nodes in nodal frames, `U e^{i n theta}`, of `U = (u_r, -i u_theta, ...)` over the nodes of a sector:
/// largest nodal `|u|` one and real in its largest component.
fn expand(tangent: &WaveTangent, harmonic: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let is_backward = waves == Waves::Backward;
    let (components, sectors) = (tangent.components, tangent.dofs.sectors);
    let mut wave = tangent.displacement(x);
    for (dof, u) in wave.iter_mut().enumerate() {
        if dof % components == 1 {
            *u *= c64::I; // u_theta = i (-i u_theta).
        }
        if is_backward {
            *u = u.conj(); // The wave -n is the conjugate.
        }
    }
    let nodes = || wave.chunks_exact(components);
    let size = |u: &[c64]| u.iter().map(|v| v.norm_sqr()).sum::<f64>();
    let larger = |best, u| if size(u) > size(best) { u } else { best };
    let peak = nodes().fold(&wave[..components], larger);
    let larger =
        peak.iter().fold(peak[0], |best, v| if v.norm() > best.norm() { *v } else { best });
    let scale = larger.conj() / (larger.norm() * size(peak).sqrt()).max(f64::MIN_POSITIVE); // Largest |u| is 1, its largest component real.
    let sign = if is_backward { -1.0 } else { 1.0 };
    let phases = (0..2 * sectors).map(|turns| {
        let angle = sign * PI * turns as f64 / sectors as f64;
        c64::new(angle.cos(), angle.sin()) * scale
    });
    let phases: Vec<c64> = phases.collect();
    let places = (0..sectors).flat_map(|j| nodes().zip(&tangent.halves).map(move |own| (j, own)));
    let shape = places.flat_map(|(j, (own, half))| {
        let phase = phases[harmonic * (2 * j + half) % (2 * sectors)]; // e^{i n theta}, theta in halves of a sector.
        own.iter().map(move |v| v * phase)
    });
    shape.collect()
}
