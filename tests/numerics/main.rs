//! Discretisation, spectra and responses against theory, other methods and themselves.

#[path = "../common/mod.rs"]
mod common;

mod assemblies;
mod body;
mod body_sensitivity;
mod cea_cyclic;
mod cea_sparse;
mod chords;
mod continuum;
mod continuum_reference;
mod convergence;
mod cyclic_symmetry;
mod eigen_linear_algebra;
mod fem_statics;
mod free_part;
mod frf;
mod frf_cyclic;
mod frf_sliding;
mod friction_law;
mod half_space;
mod improve;
mod matrices;
mod mesh_error;
mod normal_law;
mod opening;
mod orthotropy;
mod plane_body;
mod plane_spectrum;
mod prelude;
mod pyramids;
mod relaxation;
mod shaft;
mod sliding_bodies;
mod solid_elements;
mod solid_refinement;
mod solids;
mod structural_damping;
mod supported_bodies;
mod tabled;
mod tabled_disc;
mod two_bodies;
mod verification;
mod waves;

use common::{disc, draws, program, triangles};
