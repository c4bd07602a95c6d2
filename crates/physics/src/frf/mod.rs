//! Frequency responses of the model: direct solution line by line, harmonic by harmonic or of the whole mesh, or by model reduction.
//!
//! [`cyclic_response`] solves each circumferential harmonic of an annulus or of a body of revolution in three dimensions
//! ([`CyclicSystem`]), nothing neglected. [`FrfSystem`] holds mass, damping and stiffness of a free, clamped or sliding body.
//! [`direct_response`] solves `(K + i omega C - omega^2 M) u = f` of the whole mesh from sparse factorizations, to round-off at each line.
//! [`reduced_response`] projects the system on a few Krylov spaces first, and states the error that direct solutions at check lines find.
//! [`GaussianNoise`](crate::linalg::GaussianNoise) turns a computed response into a synthetic measurement.

mod direct;
mod driven;
mod error;
mod krylov;
mod neighbours;
mod port;
mod reduction;
mod system;
mod terminal;
mod waves;

pub use direct::direct_response;
pub use error::FrfError;
pub use port::Port;
pub use reduction::{ReducedResponse, reduced_response};
pub use system::FrfSystem;
pub use terminal::{Axis, Direction, FrfBoundary, Terminal};
pub use waves::{CyclicResponse, CyclicSystem, cyclic_response};
