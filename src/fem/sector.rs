//! Matrices of one sector of the annulus, and their circumferential harmonics.
//!
//! All sectors are alike, so a wave `u = U(r) e^{i n theta}` over the nodes sees one small matrix for
//! each harmonic `n`: block-tridiagonal in the radius, with the contact edge free and the outer edge
//! clamped (or free too). In the basis `(u_r, -i u_theta)` that matrix is real where the annulus looks the same in a
//! mirror, and `i` times real where the mirror reverses it (the stress of sliding friction).

use super::element;
use super::{MassKind, MaterialField, RayleighDamping};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::{BoundaryCondition, NodalSupport, SectorMesh};
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// What a mirror along a radius does to a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MirrorParity {
    /// Leaves it as it is: harmonics are real in the basis `(u_r, -i u_theta)`.
    Even,
    /// Changes its sign: harmonics are `i` times the real matrix returned.
    Odd,
}

/// One matrix of the annulus, kept as the coupling of one sector with itself and its neighbours.
///
/// Dofs are `2 k` radial and `2 k + 1` tangential of sector node `k`, clamped nodes left out; nodes are
/// numbered outwards, so the contact edge comes first (see [`SectorMesh`]).
#[derive(Clone, Debug, PartialEq)]
pub struct SectorMatrix {
    sector_count: usize,
    parity: MirrorParity,
    /// Coupling of a node's row to the nodes `d` half sectors ahead, for the `d` that occur.
    couplings: Vec<(isize, BandedMatrix)>,
}

impl SectorMatrix {
    /// Sums the element matrices `compute(e)` (nodal frames) of one sector.
    pub fn assemble(
        sector: &SectorMesh,
        parity: MirrorParity,
        mut compute: impl FnMut(usize) -> DMatrix<f64>,
    ) -> Self {
        let dimension = 2 * sector.free_node_count();
        let mesh = &sector.strip;
        let half_bandwidth = half_bandwidth(sector);
        let differences: &[isize] = if sector.specification.element.is_quadratic() {
            &[-2, -1, 0, 1, 2]
        } else {
            &[-2, 0, 2]
        };
        let zero = BandedMatrix::zeros(dimension, half_bandwidth);
        let mut couplings: Vec<_> = differences.iter().map(|&d| (d, zero.clone())).collect();
        for e in 0..mesh.element_count() {
            let matrix = compute(e);
            let nodes = mesh.element_nodes(e);
            let dof =
                |local: usize| 2 * sector.sector_node_of[nodes[local / 2] as usize] + local % 2;
            let step = |local: usize| sector.half_steps[nodes[local / 2] as usize] as isize;
            for row in (0..matrix.nrows()).filter(|&row| dof(row) < dimension) {
                for column in (0..matrix.ncols()).filter(|&column| dof(column) < dimension) {
                    let difference = step(column) - step(row);
                    let place = differences.iter().position(|&d| d == difference);
                    let place = place.expect("an element spans one sector");
                    couplings[place].1.add(dof(row), dof(column), matrix[(row, column)]);
                }
            }
        }
        Self { sector_count: sector.sector_count(), parity, couplings }
    }

    /// A matrix that couples no two nodes, `2 x 2` blocks `(node, block)` of free sector nodes.
    fn of_blocks(sector: &SectorMesh, blocks: &[(usize, [[f64; 2]; 2])]) -> Self {
        let mut matrix = Self::diagonal(sector, &[]);
        for &(node, block) in blocks {
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let place = (2 * node + row, 2 * node + column);
                matrix.couplings[0].1.add(place.0, place.1, block[row][column]);
            }
        }
        matrix
    }

    /// A diagonal matrix with the same value on both dofs of each free sector node.
    pub fn diagonal(sector: &SectorMesh, values: &[f64]) -> Self {
        let mut matrix = Self::assemble(sector, MirrorParity::Even, |e| {
            let size = 2 * sector.strip.element_nodes(e).len();
            DMatrix::zeros(size, size)
        });
        matrix.couplings.retain(|(difference, _)| *difference == 0);
        for (node, &value) in values.iter().enumerate().take(sector.free_node_count()) {
            for dof in [2 * node, 2 * node + 1] {
                matrix.couplings[0].1.add(dof, dof, value);
            }
        }
        matrix
    }

    /// Sum of two matrices of one sector and one parity; `other` may have fewer couplings.
    pub fn plus(&self, other: &Self) -> Self {
        assert_eq!(self.parity, other.parity);
        let mut result = self.clone();
        for (difference, term) in &other.couplings {
            let place = result.couplings.iter_mut().find(|(d, _)| d == difference);
            let (_, sum) = place.expect("the first matrix has all couplings of the second");
            sum.add_scaled(1.0, term);
        }
        result
    }

    /// Matrix of the wave `U e^{i n theta}`, one row for each dof of the sector.
    ///
    /// ```text
    /// (A_n U)_I e^{i n theta_I} = sum_J A_IJ U_J e^{i n theta_J},   U = (u_r, i w)
    /// ```
    ///
    /// written for `(u_r, w)` with the tangential rows multiplied by `-i`; real as it stands for even
    /// parity, to be multiplied by `i` for odd parity. Harmonics `n` and `N_theta - n` are mirror images, so
    /// `n <= N_theta / 2` is all there is.
    pub fn harmonic(&self, n: usize) -> BandedMatrix {
        let (_, first) = &self.couplings[0];
        let (dimension, half_bandwidth) = (first.dimension(), first.half_bandwidth());
        let mut result = BandedMatrix::zeros(dimension, half_bandwidth);
        for (difference, coupling) in &self.couplings {
            // Angles modulo a full turn, so that high harmonics lose no digits.
            let turns = (n as isize * difference).rem_euclid(2 * self.sector_count as isize);
            let (sin, cos) = (PI * turns as f64 / self.sector_count as f64).sin_cos();
            let (same, [radial_row, tangential_row]) = match self.parity {
                MirrorParity::Even => (cos, [-sin, sin]),
                MirrorParity::Odd => (sin, [cos, -cos]),
            };
            for row in 0..dimension {
                let across = [radial_row, tangential_row][row % 2];
                // Along a row of the band, entries alternate between the same and the other component.
                let pair = if half_bandwidth % 2 == 0 { [same, across] } else { [across, same] };
                let terms = coupling.row(row).iter().enumerate();
                for (sum, (k, term)) in result.row_mut(row).iter_mut().zip(terms) {
                    *sum += pair[k % 2] * term;
                }
            }
        }
        result
    }
}

/// Half bandwidth of a sector's matrices; with room for the contact of two bodies, in which a node of the shaft takes part
/// in the motion of the pair.
pub fn half_bandwidth(sector: &SectorMesh) -> usize {
    let of_one_body = if sector.specification.element.is_quadratic() { 9 } else { 3 };
    let pair = sector.specification.shaft.map_or(0, |_| 2 * sector.contact_count);
    of_one_body + pair
}

/// Springs and dashpots of the supported edges, Pa and Pa s; `None` where it has no support.
pub fn supports(sector: &SectorMesh) -> Option<[SectorMatrix; 2]> {
    let supports = sector.strip.nodal_supports();
    if supports.is_empty() {
        return None;
    }
    let node = |support: &NodalSupport| sector.sector_node_of[support.node];
    let of = |matrix: fn(&NodalSupport) -> [[f64; 2]; 2]| {
        let blocks: Vec<_> = supports.iter().map(|s| (node(s), matrix(s))).collect();
        SectorMatrix::of_blocks(sector, &blocks)
    };
    Some([of(|s| s.stiffness), of(|s| s.damping)])
}

/// Name, springs and dashpots of each supported edge.
pub fn each_support(sector: &SectorMesh) -> Vec<(String, [SectorMatrix; 2])> {
    let boundaries = &sector.strip.boundaries;
    let of = |own: usize| {
        // The sector with this support alone.
        let mut alone = sector.clone();
        for (other, boundary) in alone.strip.boundaries.iter_mut().enumerate() {
            if other != own {
                boundary.condition = BoundaryCondition::Free;
            }
        }
        Some((boundaries[own].name.clone(), supports(&alone)?))
    };
    let is_supported =
        |own: &usize| matches!(boundaries[*own].condition, BoundaryCondition::Support(_));
    let supported = (0..boundaries.len()).filter(is_supported);
    supported.filter_map(of).collect()
}

/// Stiffness of one sector with the springs of its supports, Pa.
pub fn supported_stiffness(sector: &SectorMesh, material: &dyn MaterialField) -> SectorMatrix {
    let elastic = stiffness(sector, material);
    match supports(sector) {
        Some([springs, _]) => elastic.plus(&springs),
        None => elastic,
    }
}

/// Elastic stiffness `K_e` of one sector without its supports, Pa.
pub fn stiffness(sector: &SectorMesh, material: &dyn MaterialField) -> SectorMatrix {
    let mesh = &sector.strip;
    SectorMatrix::assemble(sector, MirrorParity::Even, |e| {
        element::stiffness(mesh, e, material.of(mesh.region(e)))
    })
}

/// What damping coefficients of their own add to `alpha_R M + beta_R K_e`, Pa s; `None` where no region has its own. See
/// [`super::assemble_extra_damping`].
pub fn extra_damping(
    sector: &SectorMesh,
    material: &dyn MaterialField,
    kind: MassKind,
    common: RayleighDamping,
) -> Option<SectorMatrix> {
    let mesh = &sector.strip;
    let own = |e: usize| material.own_damping(mesh.region(e));
    (0..mesh.element_count()).find_map(own)?;
    Some(SectorMatrix::assemble(sector, MirrorParity::Even, |e| {
        let elastic = material.of(mesh.region(e));
        let damping = own(e).unwrap_or(common);
        let mass = match kind {
            MassKind::Consistent => element::consistent_mass(mesh, e, elastic),
            MassKind::Lumped => {
                let masses = element::lumped_mass(mesh, e, elastic);
                let size = 2 * masses.len();
                DMatrix::from_fn(size, size, |i, j| if i == j { masses[i / 2] } else { 0.0 })
            }
        };
        mass * (damping.mass_coefficient - common.mass_coefficient)
            + element::stiffness(mesh, e, elastic)
                * (damping.stiffness_coefficient - common.stiffness_coefficient)
    }))
}

/// Mass of one sector, kg/m.
pub fn mass(sector: &SectorMesh, material: &dyn MaterialField, kind: MassKind) -> SectorMatrix {
    let mesh = &sector.strip;
    match kind {
        MassKind::Consistent => SectorMatrix::assemble(sector, MirrorParity::Even, |e| {
            element::consistent_mass(mesh, e, material.of(mesh.region(e)))
        }),
        MassKind::Lumped => {
            let mut masses = vec![0.0; sector.node_count()];
            for e in 0..mesh.element_count() {
                let shares = element::lumped_mass(mesh, e, material.of(mesh.region(e)));
                for (&node, share) in mesh.element_nodes(e).iter().zip(shares) {
                    masses[sector.sector_node_of[node as usize]] += share;
                }
            }
            SectorMatrix::diagonal(sector, &masses)
        }
    }
}

/// Geometric stiffness of the stress that a displacement, the same in every sector, causes, Pa.
///
/// `displacement` holds `(u_r, u_theta)` of each free sector node, m. It must be purely radial for even
/// and purely tangential for odd parity.
pub fn geometric_stiffness(
    sector: &SectorMesh,
    material: &dyn MaterialField,
    displacement: &[f64],
    parity: MirrorParity,
) -> SectorMatrix {
    let component = |dof: usize| displacement.get(dof).copied().unwrap_or(0.0);
    let spread: Vec<f64> = sector
        .sector_node_of
        .iter()
        .flat_map(|node| [component(2 * node), component(2 * node + 1)])
        .collect();
    SectorMatrix::assemble(sector, parity, |e| {
        let material = material.of(sector.strip.region(e));
        element::geometric_stiffness(&sector.strip, e, material, &spread)
    })
}
