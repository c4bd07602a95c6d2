//! Elements, assembly, mass, stiffness, damping, stress.

mod material;

pub use material::{ElasticMaterial, MaterialError, PlaneFormulation, RayleighDamping};
