//! The shape of a mode over the whole body.

use crate::cea::cyclic::path::Waves;
use crate::linalg::c64;
use crate::prestress::SolidTangent;
use std::f64::consts::PI;

/// Displacement of all nodes in nodal frames, `U e^{i n theta}`, largest nodal `|u|` one and real in its largest component.
pub(super) fn shape(tangent: &SolidTangent, n: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let sector = tangent.sector();
    let is_backward = waves == Waves::Backward;
    let value = |dof: usize| {
        let value = tangent.unknown_of()[dof].map_or(c64::new(0.0, 0.0), |unknown| x[unknown]);
        let turned = if dof % 3 == 1 { value * c64::new(0.0, 1.0) } else { value };
        if is_backward { turned.conj() } else { turned }
    };
    let wave: Vec<[c64; 3]> =
        (0..sector.node_count()).map(|node| [0, 1, 2].map(|c| value(3 * node + c))).collect();
    let size = |u: &[c64; 3]| u.iter().map(|v| v.norm_sqr()).sum::<f64>();
    let peak = wave.iter().fold(&wave[0], |best, u| if size(u) > size(best) { u } else { best });
    let larger =
        peak.iter().fold(peak[0], |best, v| if v.norm() > best.norm() { *v } else { best });
    let scale = larger.conj() / (larger.norm() * size(peak).sqrt()).max(f64::MIN_POSITIVE);
    let sectors = sector.sector_count();
    let sign = if is_backward { -1.0 } else { 1.0 };
    let phases: Vec<c64> = (0..2 * sectors)
        .map(|turns| {
            let angle = sign * PI * turns as f64 / sectors as f64;
            c64::new(angle.cos(), angle.sin()) * scale
        })
        .collect();
    let mut shape = Vec::with_capacity(3 * wave.len() * sectors);
    for j in 0..sectors {
        for (node, u) in sector.nodes.iter().zip(&wave) {
            let phase = phases[n * (2 * j + node.half_step) % (2 * sectors)];
            shape.extend(u.map(|v| v * phase));
        }
    }
    shape
}
