//! `M^-1 K` of a uniform annulus as one stencil for each radius.

use super::kernel::{LineLayout, RowStencil};
use super::sparse::free_masses;
use super::stencil::{Blocks, StencilRows, sector_blocks};
use super::{OperatorError, SectorStencil, SimdLevel};
use crate::fem::MaterialField;
use crate::mesh::{AnnulusMesh, BoundaryCondition};
use std::collections::BTreeMap;

impl SectorStencil {
    /// Assembles the stencil of `annulus` with what holds its edges; the rows of a shaft come before its own, and no
    /// coefficient connects them.
    ///
    /// Node `(i, j)` couples to its 3 x 3 neighbourhood through 2 x 2 blocks that depend on the
    /// radial index `i` alone: 18 numbers for each radius.
    ///
    /// # Errors
    /// [`OperatorError`] if the elements are not four-node quadrilaterals or the sectors not mirror-symmetric.
    pub fn of_annulus(
        annulus: &AnnulusMesh,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        if !annulus.mesh.is_quad4() {
            let problem = "the cyclic operator needs mesh.element = \"quad4\"; use transient.operator = \"sparse\" for other elements";
            return Err(OperatorError(problem.to_owned()));
        }
        let node_masses = free_masses(&annulus.mesh, material)?;
        let per_sector = annulus.sector_node_count();
        let blocks = sector_blocks(&annulus.mesh, material, per_sector)?;
        let specification = &annulus.specification;
        let is_clamped = specification.outer == BoundaryCondition::Clamped;
        let bore = specification.shaft.map(|shaft| shaft.bore);
        let is_bore_clamped = bore == Some(BoundaryCondition::Clamped);
        let nodes = usize::from(is_bore_clamped)..per_sector - usize::from(is_clamped);
        // A row of zeros on either side, of which a clamped bore takes the place of the first.
        let layout = LineLayout::new(2, annulus.sector_count(), nodes.len() + 2);
        let stencil = |i: usize| row_stencil(i, &blocks[i], node_masses[i], i + 1 < nodes.end);
        let mut own = Self {
            masses: vec![0.0; layout.field_length()],
            rows: StencilRows::Radial(nodes.clone().map(stencil).collect()),
            first: usize::from(!is_bore_clamped),
            layout,
            per_sector,
            simd: simd.min(SimdLevel::detect()),
        };
        (1..).zip(&node_masses[nodes]).for_each(|(line, &mass)| own.fill_masses(line, 0..2, mass));
        Ok(own)
    }
}

/// Stencil of radius `i` from what its neighbours do, divided by its mass; the outer one of the last moving row is clamped.
fn row_stencil(
    i: usize,
    neighbours: &BTreeMap<usize, Blocks<2>>,
    mass: f64,
    has_outer: bool,
) -> RowStencil {
    let mut stencil = RowStencil::default();
    for (&other, block) in neighbours.iter().filter(|(other, _)| has_outer || **other <= i) {
        let k = other + 1 - i;
        let entry = |l: usize, c: usize, d: usize| block[l][c][d] / mass;
        let even = |c: usize| 0.5 * (entry(2, c, c) + entry(0, c, c));
        let odd = |c: usize, d: usize| 0.5 * (entry(2, c, d) - entry(0, c, d));
        stencil.rr0[k] = entry(1, 0, 0);
        stencil.rr1[k] = even(0);
        stencil.rt1[k] = odd(0, 1);
        stencil.tt0[k] = entry(1, 1, 1);
        stencil.tt1[k] = even(1);
        stencil.tr1[k] = odd(1, 0);
    }
    stencil
}
