//! Matrices of one sector of a body of revolution in three dimensions, three components a node, `(u_r, u_theta, u_z)`.

mod element;
mod face;
mod stress;

pub use element::{mass, stiffness};
pub use face::{FaceTerm, face_load, face_matrix, whole_element};
pub use stress::geometric_stiffness;

use super::fold::WaveDofs;
use crate::mesh::SolidSector;

/// The dofs that no boundary holds.
pub fn wave_dofs(sector: &SolidSector) -> WaveDofs {
    let half_bandwidth = 3 * sector.node_bandwidth() + 2;
    let (dofs, sectors) = (3 * sector.node_count(), sector.sector_count());
    WaveDofs::new(dofs, |dof| sector.is_held(dof), half_bandwidth, sectors)
}
