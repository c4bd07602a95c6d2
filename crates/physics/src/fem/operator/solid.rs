//! `M^-1 K` of a body of revolution in three dimensions, one stencil for each node of a sector.

use super::kernel::{LineLayout, solid::SheetCoupling};
use super::stencil::{Blocks, StencilRows, sector_blocks};
use super::{OperatorError, SectorStencil, SimdLevel};
use crate::fem::{MassKind, MaterialField, assemble_mass, assemble_stiffness, assemble_supports};
use crate::mesh::SolidSector;
use std::collections::BTreeMap;

impl SectorStencil {
    /// Assembles the stencil of bricks of 8 nodes from the elastic stiffness of a sector and the
    /// springs of its supports, with the mass lumped by row sums.
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
            return Err(OperatorError::NotBrick8);
        }
        let layout = LineLayout::new(3, sector.sector_count(), sector.node_count());
        let node_masses = nodal_masses(sector, material)?;
        let [springs, _] = assemble_supports(&sector.strip.mesh);
        let both = [assemble_stiffness(&sector.strip.mesh, material), springs];
        let both = both.map(|own| sector.strip.folded(&own));
        let entries = both.iter().flat_map(|own| own.entries());
        let blocks = sector_blocks(sector.node_count(), entries)?;
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
            per_sector: sector.node_count(),
            layout,
            simd: simd.min(SimdLevel::detect()),
        };
        for (node, mass) in node_masses.iter().enumerate() {
            own.fill_masses(node, (0..3).filter(|c| !sector.is_held(3 * node + c)), *mass);
        }
        Ok(own)
    }
}

/// Lumped masses of the nodes of a sector, kg.
fn nodal_masses(
    sector: &SolidSector,
    material: &dyn MaterialField,
) -> Result<Vec<f64>, OperatorError> {
    let mut masses = vec![0.0; sector.node_count()];
    let lumped =
        sector.strip.folded(&assemble_mass(&sector.strip.mesh, material, MassKind::Lumped));
    let own = lumped.entries().filter(|&(row, column, ..)| row == column && row % 3 == 0);
    for (row, _, _, mass) in own {
        masses[row / 3] += mass;
    }
    match masses.iter().position(|mass| !(*mass > 0.0)) {
        Some(node) => Err(OperatorError::Massless { node: node + 1, mass: masses[node] }),
        None => Ok(masses),
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
