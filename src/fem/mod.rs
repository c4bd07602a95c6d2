//! Elements, assembly, mass, stiffness, damping, stress.
//!
//! Every nodal vector and matrix is written in the nodal frames of [`crate::mesh::Mesh2d`]: dof
//! `2 i` of node `i` along the frame's first axis (radial on the annulus), dof `2 i + 1` along its
//! second (circumferential). Everything is for one metre of thickness.

mod assembly;
pub mod element;
mod material;
pub mod operator;
pub mod sector;
mod stress;

pub use assembly::{
    DofMap, MassKind, Triplets, assemble_geometric_stiffness, assemble_mass, assemble_stiffness,
    clamped_dofs, lumped_masses,
};
pub use material::{ElasticMaterial, MaterialError, PlaneFormulation, RayleighDamping};
pub use stress::{NodalStress, nodal_stress};
