//! Charts that several commands share, and what their colours mean.

mod critical_friction;
mod disc;
pub mod palette;

pub use critical_friction::{CriticalBranch, critical_friction};
pub use disc::Disc;
