//! Transients and limit cycles against theory, each other and themselves.

#[path = "../common/mod.rs"]
mod common;

mod assembly;
mod cycle;
mod cycle_basin;
mod cycle_branch;
mod cycle_discs;
mod cycle_periodic;
mod cycle_solids;
mod cycle_steps;
mod cycle_transient;
mod cycle_two_waves;
mod from_a_mode;
mod oscillator;
mod prelude;
mod transient;

use common::disc;
