//! Matrices of one sector of the annulus: element stiffness and mass, supports, damping, geometric stiffness.
//!
//! Dofs are `2 k` radial and `2 k + 1` tangential of sector node `k`; nodes are numbered outwards,
//! the contact edge first (see [`SectorMesh`]). So the matrices of a wave are block-tridiagonal in
//! the radius.

use super::element;
use super::fold::{SectorMatrix, WaveDofs};
use super::{MassKind, MaterialField, element_mass};
use crate::mesh::{BoundaryCondition, NodalSupport, SectorMesh};
use nalgebra::DMatrix;

/// The dofs that are not clamped.
pub fn wave_dofs(sector: &SectorMesh) -> WaveDofs {
    let free = 2 * sector.free_node_count();
    let of_one_body = if sector.specification.element.is_quadratic() { 9 } else { 3 };
    // Room for the contact of two bodies, in which a node of the shaft takes part in the motion of the pair.
    let pair = sector.specification.shaft.map_or(0, |_| 2 * sector.contact_count);
    let (dofs, sectors) = (2 * sector.node_count(), sector.sector_count());
    WaveDofs::new(dofs, |dof| dof >= free, of_one_body + pair, sectors)
}

/// Sums the element matrices `compute(e)` (nodal frames) of one sector.
fn assemble(sector: &SectorMesh, compute: impl Fn(usize) -> DMatrix<f64>) -> SectorMatrix {
    let mesh = &sector.strip;
    let elements = (0..mesh.element_count()).map(|e| {
        let nodes = mesh.element_nodes(e).iter().map(|&node| node as usize);
        let nodes = nodes.map(|node| (sector.sector_node_of[node], sector.half_steps[node]));
        (nodes.collect::<Vec<_>>(), compute(e))
    });
    SectorMatrix::sum(2, elements)
}

/// Springs and dashpots of the supported edges, Pa and Pa s.
pub fn supports(sector: &SectorMesh) -> [SectorMatrix; 2] {
    let supports = sector.strip.nodal_supports();
    let of = |part: fn(&NodalSupport) -> [[f64; 2]; 2]| {
        let own = supports.iter().map(|support| {
            let matrix = part(support);
            let node = [(sector.sector_node_of[support.node], 0)];
            (node, DMatrix::from_fn(2, 2, |row, column| matrix[row][column]))
        });
        SectorMatrix::sum(2, own)
    };
    [of(|support| support.stiffness), of(|support| support.damping)]
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
        (boundaries[own].name.clone(), supports(&alone))
    };
    let is_supported =
        |own: &usize| matches!(boundaries[*own].condition, BoundaryCondition::Support(_));
    (0..boundaries.len()).filter(is_supported).map(of).collect()
}

/// Stiffness of one sector with the springs of its supports, Pa.
pub fn supported_stiffness(sector: &SectorMesh, material: &dyn MaterialField) -> SectorMatrix {
    let [springs, _] = supports(sector);
    stiffness(sector, material).plus(&springs)
}

/// Elastic stiffness `K_e` of one sector without its supports, Pa.
pub fn stiffness(sector: &SectorMesh, material: &dyn MaterialField) -> SectorMatrix {
    let mesh = &sector.strip;
    assemble(sector, |e| element::stiffness(mesh, e, material.of(mesh.region(e))))
}

/// Mass of one sector, kg/m.
pub fn mass(sector: &SectorMesh, material: &dyn MaterialField, kind: MassKind) -> SectorMatrix {
    assemble(sector, |e| element_mass(&sector.strip, material, kind, e))
}

/// Geometric stiffness of the stress that a displacement, the same in every sector, causes, Pa.
///
/// `displacement` holds `(u_r, u_theta)` of each free sector node, m. A purely radial one gives a matrix of even parity, a purely
/// tangential one of odd parity.
pub fn geometric_stiffness(
    sector: &SectorMesh,
    material: &dyn MaterialField,
    displacement: &[f64],
) -> SectorMatrix {
    let component = |dof: usize| displacement.get(dof).copied().unwrap_or(0.0);
    let nodes = sector.sector_node_of.iter();
    let spread: Vec<f64> =
        nodes.flat_map(|node| [component(2 * node), component(2 * node + 1)]).collect();
    assemble(sector, |e| {
        let material = material.of(sector.strip.region(e));
        element::geometric_stiffness(&sector.strip, e, material, &spread)
    })
}
