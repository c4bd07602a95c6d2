//! The operator of bodies of equal sectors: one stencil for each node of a sector.

use super::kernel::{self, LineLayout, RowStencil, solid::SheetCoupling};
use super::{MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator};
use crate::fem::{MaterialField, assemble_stiffness, assemble_supports};
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// `M^-1 K` of a body of equal sectors, without a matrix.
///
/// In frames that turn with the sectors all have the same element matrices. A node couples to its neighbours in its own sector and the two
/// beside it through blocks that depend on the node of the sector alone, even or odd where that is its own mirror image. Fields hold one
/// line around for each node of a sector and each component. Dof `d (s n + k) + c` is component `c` of node `k` of sector `s`, `n` nodes to
/// a sector.
#[derive(Clone, Debug)]
pub struct SectorStencil {
    pub(super) layout: LineLayout,
    /// Nodes of a sector, held ones included.
    pub(super) per_sector: usize,
    /// Line of the first of them.
    pub(super) first: usize,
    pub(super) rows: StencilRows,
    pub(super) masses: Vec<f64>,
    pub(super) simd: SimdLevel,
}

/// The coefficients, those of a node divided by its mass.
#[derive(Clone, Debug)]
pub(super) enum StencilRows {
    /// Of four-node elements along a radius: node by node from the inside out.
    Radial(Vec<RowStencil>),
    /// Of bricks: what the neighbours of each node do, and how far apart they are numbered.
    Sheet(Vec<Vec<SheetCoupling>>, usize),
}

impl SectorStencil {
    /// Masses of the lines of a node, one for each component that moves.
    pub(super) fn fill_masses(
        &mut self,
        line: usize,
        components: impl Iterator<Item = usize>,
        mass: f64,
    ) {
        for component in components {
            let start = self.layout.line(line, component);
            self.masses[start..start + self.layout.count].fill(mass);
        }
    }
}

impl StiffnessOperator for SectorStencil {
    fn name(&self) -> &'static str {
        "cyclic"
    }

    fn dof_count(&self) -> usize {
        self.layout.components * self.per_sector * self.layout.count
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        let (node, component) = (dof / self.layout.components, dof % self.layout.components);
        let line = self.layout.line(node % self.per_sector + self.first, component);
        line + node / self.per_sector
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        let (simd, layout) = (self.simd, &self.layout);
        match &self.rows {
            StencilRows::Radial(rows) => kernel::radial_multiply(simd, layout, rows, x, y),
            StencilRows::Sheet(rows, _) => kernel::solid::sheet_multiply(simd, layout, rows, x, y),
        }
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        let (simd, layout, masses) = (self.simd, &self.layout, &self.masses);
        match &self.rows {
            StencilRows::Radial(rows) => {
                kernel::radial_advance(simd, layout, rows, masses, fields, coefficients)
            }
            StencilRows::Sheet(rows, reach) => kernel::solid::sheet_advance(
                simd,
                layout,
                (rows, *reach),
                masses,
                fields,
                coefficients,
            ),
        }
    }
}

/// `[l][c][d]`: from component `d` of a node in sector `s + l - 1` to component `c` of one in sector `s`.
pub(super) type Blocks<const D: usize> = [[[f64; D]; D]; 3];

/// Blocks between each of the `nodes` of a sector and its neighbours, springs of supports included, of a mesh of three equal sectors
/// at least.
///
/// # Errors
/// [`OperatorError`] where they are not their own mirror images, even or odd.
pub(super) fn sector_blocks<const D: usize>(
    mesh: &Mesh,
    material: &dyn MaterialField,
    nodes: usize,
) -> Result<Vec<BTreeMap<usize, Blocks<D>>>, OperatorError> {
    let dofs = D * nodes;
    let [springs, _] = assemble_supports(mesh);
    let entries = assemble_stiffness(mesh, material).entries.into_iter().chain(springs.entries);
    let mut blocks = vec![BTreeMap::<usize, Blocks<D>>::new(); nodes];
    // What couples sector 1 to sectors 0, 1 and 2.
    for (row, column, value) in entries.filter(|(row, ..)| row / dofs == 1) {
        let neighbours = &mut blocks[row % dofs / D];
        let block = neighbours.entry(column % dofs / D).or_insert([[[0.0; D]; D]; 3]);
        block[column / dofs][row % D][column % D] += value;
    }
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    for block in blocks.iter().flat_map(BTreeMap::values) {
        for (c, d) in (0..D * D).map(|k| (k / D, k % D)) {
            let [before, here, after] = block.each_ref().map(|own| own[c][d]);
            let is_odd = (c == 1) != (d == 1);
            let parity = if is_odd { -1.0 } else { 1.0 };
            worst = worst.max((after - parity * before).abs());
            if is_odd {
                worst = worst.max(here.abs());
            }
            largest = largest.max(here.abs());
        }
    }
    // Assembly order leaves a few units of round-off; anything more is no sector.
    match worst / largest {
        relative if relative > 1e-11 => Err(OperatorError(format!(
            "the cyclic operator needs sectors that are mirror-symmetric copies of one another; the stencils differ by a fraction of \
             {relative:.1e}: use transient.operator = \"sparse\""
        ))),
        _ => Ok(blocks),
    }
}
