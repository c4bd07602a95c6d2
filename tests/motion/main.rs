//! Transients and limit cycles against theory, each other and themselves.

#[path = "../common/bricks.rs"]
mod bricks;
#[path = "../common/cases.rs"]
mod cases;
#[path = "../common/coarse_block.rs"]
mod coarse_block;
#[path = "../common/disc.rs"]
mod disc;
#[path = "../common/kept.rs"]
mod kept;
#[path = "../common/mesh_text.rs"]
mod mesh_text;
#[path = "../common/tier.rs"]
mod tier;

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
mod oscillator;
mod prelude;
mod transient;
