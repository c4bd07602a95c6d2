//! Results of the transient of a body of revolution in three dimensions.

use crate::mesh::SolidSector;

/// Contact nodes in the order of the record, counted from 0.
pub(super) fn contact_nodes(sector: &SolidSector) -> Vec<u32> {
    let rings = || sector.rings.iter().flat_map(|ring| &ring.nodes);
    let sectors = 0..sector.sector_count();
    sectors.flat_map(|s| rings().map(move |node| (s * sector.node_count() + node) as u32)).collect()
}
