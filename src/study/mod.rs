//! Studies of a case: what is computed at which points, and what is compared between them.
//!
//! A [`SweepPlan`] deals the points of a parameter study out to shards, each point a case of its own;
//! [`eigenvalues`] sweeps over friction; [`convergence`] compares the levels of a refinement; [`fit`] finds parameters from
//! measured modes; [`uncertainty`] draws samples of rough ones; [`tangent_options`] is how a case takes the tangent of
//! steady sliding. Nothing here touches a file or the terminal.

pub mod convergence;
pub mod eigenvalues;
mod error;
pub mod fit;
mod plan;
mod sobol;
mod tangent;
pub mod uncertainty;

pub use error::StudyError;
pub use plan::{Shard, SweepPlan, analysis_name, one_line};
pub use sobol::ScrambledSobol;
pub use tangent::{modes_at_own_friction, tangent_options};
