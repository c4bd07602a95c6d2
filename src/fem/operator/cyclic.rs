//! `M^-1 K` of a uniform annulus as one stencil for each radius.

use super::kernel::{self, RowLayout, RowStencil};
use super::sparse::free_masses;
use super::{
    MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator, check_mirrored,
};
use crate::fem::{MaterialField, assemble_stiffness, assemble_supports};
use crate::mesh::{AnnulusMesh, BoundaryCondition};

/// `M^-1 K` of a four-node annulus mesh, without a matrix.
///
/// In polar frames every sector has the same element matrices, so node `(i, j)` couples to its 3 x 3
/// neighbourhood through 2 x 2 blocks that depend on the radial index `i` alone; the mirror symmetry of a
/// sector makes the diagonal entries even and the others odd in `j`, which leaves 18 numbers for each radius.
/// Fields hold one line along the circumference for each radius and component.
#[derive(Clone, Debug)]
pub struct CyclicStencil {
    layout: RowLayout,
    /// Nodes of a sector, clamped ones included.
    per_sector: usize,
    /// Whether the first of them is clamped: the bore of a shaft, which takes the place of the row of zeros.
    is_bore_clamped: bool,
    stencils: Vec<RowStencil>,
    masses: Vec<f64>,
    simd: SimdLevel,
}

/// `blocks[i][k][l][c][d]`: from component `d` of node `(i + k - 1, j + l - 1)` to component `c` of `(i, j)`.
type Blocks = Vec<[[[[f64; 2]; 2]; 3]; 3]>;

impl CyclicStencil {
    /// Assembles the stencil of `annulus` with what holds its edges; the rows of a shaft come before its own, and no
    /// coefficient connects them.
    ///
    /// # Errors
    /// [`OperatorError`] if the elements are not four-node quadrilaterals or the sectors not mirror-symmetric.
    pub fn assemble(
        annulus: &AnnulusMesh,
        material: &dyn MaterialField,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        if !annulus.mesh.is_quad4() {
            return Err(OperatorError::NotQuad4);
        }
        let node_masses = free_masses(&annulus.mesh, material)?;
        let blocks = sector_blocks(annulus, material);
        let entries = blocks.iter().flatten().flat_map(|block| {
            let of = |(c, d): (usize, usize)| ([0, 1, 2].map(|l| block[l][c][d]), c != d);
            [(0, 0), (0, 1), (1, 0), (1, 1)].map(of)
        });
        check_mirrored(entries)?;
        let per_sector = annulus.sector_node_count();
        let specification = &annulus.specification;
        let is_clamped = specification.outer == BoundaryCondition::Clamped;
        let bore = specification.shaft.map(|shaft| shaft.bore);
        let is_bore_clamped = bore == Some(BoundaryCondition::Clamped);
        let nodes = usize::from(is_bore_clamped)..per_sector - usize::from(is_clamped);
        let layout = RowLayout::new(annulus.sector_count(), nodes.len());
        let stencils = nodes
            .clone()
            .map(|i| row_stencil(&blocks[i], node_masses[i], i + 1 < nodes.end))
            .collect();
        let mut masses = vec![0.0; layout.field_length()];
        for (row, &mass) in node_masses[nodes].iter().enumerate() {
            for component in 0..2 {
                let start = layout.start(row, component);
                masses[start..start + layout.count].fill(mass);
            }
        }
        Ok(Self {
            layout,
            per_sector,
            is_bore_clamped,
            stencils,
            masses,
            simd: simd.min(SimdLevel::detect()),
        })
    }
}

/// Blocks that couple the nodes of sector 1 to sectors 0, 1 and 2.
fn sector_blocks(annulus: &AnnulusMesh, material: &dyn MaterialField) -> Blocks {
    let per_sector = annulus.sector_node_count();
    let mut blocks = vec![[[[[0.0; 2]; 2]; 3]; 3]; per_sector];
    let [springs, _] = assemble_supports(&annulus.mesh);
    let body = assemble_stiffness(&annulus.mesh, material).entries;
    for (row, column, value) in body.into_iter().chain(springs.entries) {
        let (node, other) = (row / 2, column / 2);
        if node / per_sector != 1 {
            continue;
        }
        let (i, other_i) = (node % per_sector, other % per_sector);
        let radial_offset = other_i + 1 - i;
        let sector_offset = other / per_sector;
        blocks[i][radial_offset][sector_offset][row % 2][column % 2] += value;
    }
    blocks
}

/// Stencil of one radius, divided by its mass; the outer neighbour of the last moving row is clamped.
fn row_stencil(blocks: &[[[[f64; 2]; 2]; 3]; 3], mass: f64, has_outer: bool) -> RowStencil {
    let mut stencil = RowStencil::default();
    for k in 0..if has_outer { 3 } else { 2 } {
        let entry = |l: usize, c: usize, d: usize| blocks[k][l][c][d] / mass;
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

impl StiffnessOperator for CyclicStencil {
    fn name(&self) -> &'static str {
        "cyclic"
    }

    fn simd(&self) -> SimdLevel {
        self.simd
    }

    fn dof_count(&self) -> usize {
        2 * self.per_sector * self.layout.count
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        let (node, component) = (dof / 2, dof % 2);
        let line = node % self.per_sector + usize::from(!self.is_bore_clamped);
        self.layout.line(line, component) + node / self.per_sector
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        kernel::cyclic_multiply(self.simd, &self.layout, &self.stencils, x, y);
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        kernel::cyclic_advance(
            self.simd,
            &self.layout,
            &self.stencils,
            &self.masses,
            fields,
            coefficients,
        )
    }
}
