//! A deformable shaft in the disc: eigenvalues and transient against theory, a rigid shaft and each other.

mod eigenvalues;
pub mod model;
mod statics;
mod transient;
