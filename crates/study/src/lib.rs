//! Studies of a case: what is computed at which points, and what is compared between them.
//!
//! A [`SweepPlan`] deals the points of a parameter study out to shards, each point a case of its own. [`eigenvalues`]
//! sweeps over friction; [`response`] excites the model at one node; [`transient`] steps through time. [`cycle`] finds
//! limit cycles directly and [`basin`] which of two wins; [`convergence`] compares the levels of a refinement.
//! [`improve`] finds what silences unstable modes; [`mac`] compares measured shapes with modes. [`matrices`] exports
//! what the eigenvalue analysis solves, and solves matrices from elsewhere. [`fit`] finds parameters
//! from measured modes; [`uncertainty`] draws samples of rough ones. [`tangent_options`] is how a case takes the
//! tangent of steady sliding. Nothing here touches a file or the terminal.

pub mod basin;
pub mod convergence;
pub mod cycle;
pub mod eigenvalues;
mod error;
pub mod fit;
pub mod improve;
pub mod mac;
pub mod matrices;
mod plan;
mod preflight;
mod prelude;
pub mod response;
mod sobol;
mod summary;
mod tangent;
pub mod transient;
pub mod uncertainty;

use cycle::operating_point;
use eigenvalues::{WholeMesh, asked_modes};
use prelude::*;

pub use eigenvalues::modes_at_own_friction;
pub use error::StudyError;
pub use plan::{Shard, SweepPlan, one_line};
pub use preflight::{Preflight, preflight, refuse_memory};
pub use sobol::ScrambledSobol;
pub use summary::summarize;
pub use tangent::{extent_of, tangent_options};
pub use transient::linear_stage;
