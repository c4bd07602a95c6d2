//! Elements, assembly, mass, stiffness, damping, stress.
//!
//! Every nodal vector and matrix is written in the nodal frames of [`crate::mesh::Mesh`]. Dof `d i + a` is that of node `i` along axis `a`
//! of its frame, `d` the dimension. On the annulus dof `2 i` is radial and dof `2 i + 1` circumferential. Everything in the plane is for
//! one metre of thickness.

mod assembly;
mod discretization;
mod dof_map;
pub mod element;
pub mod fold;
mod gain;
mod material;
mod maxwell;
mod modulus_table;
pub mod operator;
mod orthotropy;
mod recovery;
mod rotation;
mod stress;
mod support;
mod triplets;

pub use assembly::{
    MassKind, assemble_around, assemble_extra_damping, assemble_mass, assemble_patch_damping,
    assemble_point_masses, assemble_stiffness, element_mass, element_matrices, element_stiffness,
    lumped_masses, region_mass, region_stiffness, region_stiffnesses,
};
pub use discretization::DiscretizationError;
pub use dof_map::DofMap;
pub use element::ElementGeometry;
pub use gain::{LossGain, TabledGain};
pub use material::{
    ElasticMaterial, MaterialField, PlaneFormulation, RayleighDamping, RegionMaterial,
};
pub use maxwell::{MaxwellChain, MaxwellElement};
pub use modulus_table::{ModulusTable, own_frequency_step};
pub use orthotropy::{Elasticity, Indefinite, MaterialAxes, Orthotropy, RATIOS, beside};
pub use rotation::{RotationFrame, RotationTerms, Spin, assemble_rotation};
pub use stress::{NodalStress, SolidStress, nodal_stress, revolved_stress, solid_stress};
pub use support::{
    assemble_attachments, assemble_pressures, assemble_support, assemble_supports, element_supports,
};
pub use triplets::Triplets;
