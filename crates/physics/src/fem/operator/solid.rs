//! `M^-1 K` of a body of revolution in three dimensions, one stencil for each node of a sector.

use super::kernel::{LineLayout, solid::SheetCoupling};
use super::sparse::free_masses;
use super::stencil::{Blocks, StencilRows, sector_blocks};
use super::{OperatorError, SectorStencil, SimdLevel};
use crate::fem::MaterialField;
use crate::mesh::SolidSector;
use std::collections::BTreeMap;

impl SectorStencil {
    /// Assembles the stencil of bricks of 8 nodes with what holds their faces.
    ///
    /// A node couples to its at most 27 neighbours through 3 x 3 blocks.
    ///
    /// # Errors
    /// [`OperatorError`] for bricks of 20 nodes, for sectors that are not mirror-symmetric, for a node without mass.
    pub fn of_revolution(
        sector: &SolidSector,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        if sector.is_quadratic() {
            let problem = "the transient of a three-dimensional body takes bricks of 8 nodes, mesh.element = \"quad4\": a lumped mass of \
                           20 nodes allows no step worth taking";
            return Err(OperatorError(problem.to_owned()));
        }
        let per_sector = sector.node_count();
        let layout = LineLayout::new(3, sector.sector_count(), per_sector);
        // One sector has all its neighbours among three.
        let mesh = sector.part(3);
        let node_masses = free_masses(&mesh, material)?.split_off(per_sector);
        let blocks = sector_blocks(&mesh, material, per_sector)?;
        let row = |(node, neighbours): (usize, &BTreeMap<usize, Blocks<3>>)| {
            let scale = [0, 1, 2].map(|c| match sector.is_held(3 * node + c) {
                true => 0.0,
                false => node_masses[node].recip(),
            });
            neighbours
                .iter()
                .filter(|_| scale != [0.0; 3])
                .map(|(&other, blocks)| coupling(blocks, scale, layout.line(other, 0)))
                .collect()
        };
        let rows = blocks.iter().enumerate().map(row).collect();
        let mut own = Self {
            masses: vec![0.0; layout.field_length()],
            rows: StencilRows::Sheet(rows, sector.strip.node_bandwidth()),
            first: 0,
            per_sector,
            layout,
            simd: simd.min(SimdLevel::detect()),
        };
        for (node, mass) in node_masses[..per_sector].iter().enumerate() {
            own.fill_masses(node, (0..3).filter(|c| !sector.is_held(3 * node + c)), *mass);
        }
        Ok(own)
    }
}

/// A neighbour's part of a stencil; rows are multiplied by `scale`.
fn coupling([before, here, after]: &Blocks<3>, scale: [f64; 3], start: usize) -> SheetCoupling {
    const EVEN: [(usize, usize); 5] = [(0, 0), (0, 2), (2, 0), (2, 2), (1, 1)];
    const ODD: [(usize, usize); 4] = [(0, 1), (2, 1), (1, 0), (1, 2)];
    SheetCoupling {
        start,
        here: EVEN.map(|(c, d)| scale[c] * here[c][d]),
        beside: EVEN.map(|(c, d)| scale[c] * 0.5 * (after[c][d] + before[c][d])),
        odd: ODD.map(|(c, d)| scale[c] * 0.5 * (after[c][d] - before[c][d])),
    }
}
