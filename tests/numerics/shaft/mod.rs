//! A deformable shaft in the disc: eigenvalues and transient against theory, a rigid shaft and each other.

mod case;
mod eigenvalues;
pub mod model;
mod statics;
mod transient;
