//! Studies of a case: what is computed at which points, and what is compared between them.
//!
//! A [`SweepPlan`] deals the points of a parameter study out to shards, each point a case of its own;
//! [`convergence`] compares the levels of a refinement; [`tangent_options`] is how a case takes the tangent of steady
//! sliding. Nothing here touches a file or the terminal.

pub mod convergence;
mod plan;
mod tangent;

pub use plan::{Shard, SweepPlan, analysis_name, one_line};
pub use tangent::{modes_at_own_friction, tangent_options};
