//! What most of these tests name.

pub use crate::common::prelude::*;
pub use crate::oscillator::{EventDriven, cycles, near, oscillator};
pub use frictionsim::results::cycle::{FoundCycle, PeriodicResult};
pub use frictionsim::study::cycle::{CycleStudy, PeriodicStudy};
