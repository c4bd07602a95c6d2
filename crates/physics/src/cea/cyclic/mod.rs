//! The eigenvalues of a body of equal sectors, harmonic by harmonic: of a plane annulus, and of a body of revolution in three dimensions.
//!
//! In steady sliding all sectors are alike. So each circumferential harmonic `n` is a problem of its own (see
//! [`crate::prestress::WaveTangent`]). Without friction the problems are real and symmetric, and inertia counts their modes: none is
//! missed. Then each mode is followed continuously over the friction coefficient by two-sided Rayleigh quotient iteration.
//!
//! A harmonic of the plane annulus has a narrow band and is followed as it stands (`paths`). One in three dimensions has some
//! thousand unknowns, too many to factorize for every mode and friction coefficient. Friction acts on the few nodes of the
//! contact. So the harmonic is first reduced to its modes at rest and to what the contact causes (`reduced`). Structural damping
//! goes that way in the plane, too: eigenvalues of the small space are refined over all unknowns. Where friction damps the motion
//! across the sliding strongly, all eigenvalues of the small space are counted (`damped`).

mod across;
mod branch;
mod completeness;
mod damped;
mod definite;
mod follow;
mod found;
mod modes;
mod modes_below;
mod path;
mod paths;
mod pencil;
mod problem;
mod reduced;
mod reduction;
mod sensitivity;
mod sweep;

// What most files here name.
use crate::cea::*;
use follow::Follower;
use found::Wanted;
use path::{Eigenpair, Path, Waves};
use paths::HarmonicPaths;
use pencil::{Modes, Pencil};
use problem::{HarmonicProblem, Matrices};

pub use found::{Coverage, WaveSweep};
pub use paths::Overdamped;
pub use sensitivity::{Beside, WavePair, wave_pairs, wave_responses};
pub use sweep::{onsets, sweep, wave_sweep};
