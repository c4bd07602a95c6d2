//! The cyclic eigenvalue analysis against theory, dense solutions, the sparse solver and the paper.

pub mod dense;
pub mod model;
mod sensitivity;
mod stability;
mod whole_mesh;
