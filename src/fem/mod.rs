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
pub mod solid;
mod stress;

pub use assembly::{
    DofMap, MassKind, Triplets, assemble_extra_damping, assemble_geometric_stiffness,
    assemble_mass, assemble_stiffness, assemble_supports, lumped_masses,
};
pub use material::{
    AnnulusMaterials, ElasticMaterial, MaterialField, PlaneFormulation, RayleighDamping,
    RegionMaterial,
};
pub use stress::{NodalStress, nodal_stress};
