//! The shape of a mode over the whole body.

use crate::cea::cyclic::modes::around;
use crate::cea::cyclic::path::Waves;
use crate::linalg::c64;
use crate::prestress::SolidTangent;

/// Displacement of all nodes of a body of revolution in nodal frames.
pub(super) fn shape(tangent: &SolidTangent, n: usize, waves: Waves, x: &[c64]) -> Vec<c64> {
    let sector = tangent.sector();
    let value = |dof: usize| tangent.unknown_of()[dof].map_or(c64::ZERO, |unknown| x[unknown]);
    let wave = (0..sector.node_count()).map(|node| [0, 1, 2].map(|c| value(3 * node + c)));
    let half_steps: Vec<usize> = sector.nodes.iter().map(|node| node.half_step).collect();
    around(wave.collect(), &half_steps, (sector.sector_count(), n), waves)
}
