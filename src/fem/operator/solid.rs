//! `M^-1 K` of a body of revolution in three dimensions, one stencil for each node of a sector.

use super::kernel::solid::{SheetCoupling, SheetLayout, solid_advance, solid_multiply};
use super::{
    MotionFields, OperatorError, SimdLevel, StepCoefficients, StiffnessOperator, check_mirrored,
};
use crate::fem::fold::SectorMatrix;
use crate::fem::{MassKind, MaterialField, sector};
use crate::mesh::SolidSector;
use std::collections::BTreeMap;

/// `M^-1 K` of bricks of 8 nodes, without a matrix.
///
/// In cylindrical frames every sector has the same element matrices, so a node couples to its at most 27 neighbours in its own
/// sector and the two beside it through 3 x 3 blocks that depend on the node of the sector alone. Fields hold one line along the
/// circumference for each of these nodes and each component `(u_r, u_theta, u_z)`. Dof `3 (s n + k) + c` is component `c` of node
/// `k` of sector `s`, `n` nodes to a sector. The mass is lumped by row sums.
#[derive(Clone, Debug)]
pub struct SolidStencil {
    layout: SheetLayout,
    rows: Vec<Vec<SheetCoupling>>,
    masses: Vec<f64>,
    simd: SimdLevel,
}

/// `[l][c][d]`: from component `d` of a node in sector `s + l - 1` to component `c` of one in sector `s`.
type Blocks = [[[f64; 3]; 3]; 3];

impl SolidStencil {
    /// Assembles the stencil from the elastic stiffness of a sector and the springs of its supports.
    ///
    /// # Errors
    /// [`OperatorError`] for bricks of 20 nodes, for sectors that are not mirror-symmetric, for a node without mass.
    pub fn assemble(
        sector: &SolidSector,
        material: &dyn MaterialField,
        springs: &SectorMatrix,
        simd: SimdLevel,
    ) -> Result<Self, OperatorError> {
        if sector.is_quadratic() {
            return Err(OperatorError::NotBrick8);
        }
        let layout =
            SheetLayout::new(sector.sector_count(), sector.node_count(), sector.node_bandwidth());
        let node_masses = nodal_masses(sector, material)?;
        let elastic = sector::stiffness(sector, material);
        let blocks = sector_blocks(sector, &[&elastic, springs]);
        let entries = blocks.iter().flat_map(BTreeMap::values).flat_map(|own| {
            let of = move |k: usize| {
                ([0, 1, 2].map(|l| own[l][k / 3][k % 3]), (k / 3 == 1) != (k % 3 == 1))
            };
            (0..9).map(of)
        });
        check_mirrored(entries)?;
        let row = |(node, neighbours): (usize, &BTreeMap<usize, Blocks>)| {
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
        let mut masses = vec![0.0; layout.field_length()];
        for (node, mass) in node_masses.iter().enumerate() {
            for component in (0..3).filter(|c| !sector.is_held(3 * node + c)) {
                let start = layout.line(node, component);
                masses[start..start + layout.count].fill(*mass);
            }
        }
        Ok(Self {
            rows: blocks.iter().enumerate().map(row).collect(),
            layout,
            masses,
            simd: simd.min(SimdLevel::detect()),
        })
    }
}

/// Lumped masses of the nodes of a sector, kg.
fn nodal_masses(
    sector: &SolidSector,
    material: &dyn MaterialField,
) -> Result<Vec<f64>, OperatorError> {
    let mut masses = vec![0.0; sector.node_count()];
    let lumped = sector::mass(sector, material, MassKind::Lumped);
    let own = lumped.entries().filter(|&(row, column, ..)| row == column && row % 3 == 0);
    for (row, _, _, mass) in own {
        masses[row / 3] += mass;
    }
    match masses.iter().position(|mass| !(*mass > 0.0)) {
        Some(node) => Err(OperatorError::Massless { node: node + 1, mass: masses[node] }),
        None => Ok(masses),
    }
}

/// Blocks between each node of a sector and its neighbours.
fn sector_blocks(sector: &SolidSector, terms: &[&SectorMatrix]) -> Vec<BTreeMap<usize, Blocks>> {
    let mut blocks = vec![BTreeMap::<usize, Blocks>::new(); sector.node_count()];
    for (row, column, ahead, value) in terms.iter().flat_map(|term| term.entries()) {
        let block = blocks[row / 3].entry(column / 3).or_default();
        block[(2 + ahead) as usize / 2][row % 3][column % 3] += value;
    }
    blocks
}

/// A neighbour's part of a stencil; rows are multiplied by `scale`.
fn coupling([before, here, after]: &Blocks, scale: [f64; 3], start: usize) -> SheetCoupling {
    const EVEN: [(usize, usize); 5] = [(0, 0), (0, 2), (2, 0), (2, 2), (1, 1)];
    const ODD: [(usize, usize); 4] = [(0, 1), (2, 1), (1, 0), (1, 2)];
    SheetCoupling {
        start,
        here: EVEN.map(|(c, d)| scale[c] * here[c][d]),
        beside: EVEN.map(|(c, d)| scale[c] * 0.5 * (after[c][d] + before[c][d])),
        odd: ODD.map(|(c, d)| scale[c] * 0.5 * (after[c][d] - before[c][d])),
    }
}

impl StiffnessOperator for SolidStencil {
    fn name(&self) -> &'static str {
        "cyclic"
    }

    fn simd(&self) -> SimdLevel {
        self.simd
    }

    fn dof_count(&self) -> usize {
        3 * self.layout.nodes * self.layout.count
    }

    fn field_length(&self) -> usize {
        self.masses.len()
    }

    fn position(&self, dof: usize) -> usize {
        let (node, component) = (dof / 3, dof % 3);
        let line = self.layout.line(node % self.layout.nodes, component);
        line + node / self.layout.nodes
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn multiply(&self, x: &mut [f64], y: &mut [f64]) {
        solid_multiply(self.simd, &self.layout, &self.rows, x, y);
    }

    fn advance(&self, fields: &mut MotionFields, coefficients: &StepCoefficients) -> f64 {
        solid_advance(self.simd, &self.layout, &self.rows, &self.masses, fields, coefficients)
    }
}
