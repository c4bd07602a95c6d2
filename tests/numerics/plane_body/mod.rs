//! Bodies from mesh files as a user meets them: probes by place, refinement, signals beside modes, figures without the mesh in its place.

// The commands take material and contact from their cases.
#[allow(dead_code)]
mod commands;
mod geometry;
pub mod studies;
