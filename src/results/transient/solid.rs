//! Results of the transient of a body of revolution in three dimensions.

use crate::mesh::{SolidFace, SolidSector};

/// Contact nodes in the order of the record, counted from 0.
pub(super) fn contact_nodes(sector: &SolidSector) -> Vec<u32> {
    let rings = || sector.rings.iter().flat_map(|ring| &ring.nodes);
    let sectors = 0..sector.sector_count();
    sectors
        .flat_map(|s| rings().map(move |node| (s * sector.node_count() + node) as u32))
        .collect()
}

/// Speed of the nodes of the top face, m/s, in the order of the plane section: outwards first.
pub(super) fn speeds_on_top(sector: &SolidSector, velocity: &[f64]) -> Vec<f64> {
    let mut top: Vec<usize> = (0..sector.node_count())
        .filter(|&k| sector.is_on(k, SolidFace::Top))
        .collect();
    top.sort_by_key(|&k| sector.nodes[k].place[0]);
    let sheets = velocity.chunks_exact(3 * sector.node_count());
    let speed =
        |sheet: &[f64], k: usize| sheet[3 * k].hypot(sheet[3 * k + 1]).hypot(sheet[3 * k + 2]);
    sheets
        .flat_map(|sheet| top.iter().map(move |&k| speed(sheet, k)))
        .collect()
}
