//! The commands, their case files, figures and results as a user meets them; the structure of the source.

#[path = "../common/mod.rs"]
mod common;

mod architecture;
mod basin;
mod bodies;
mod case_files;
mod cli;
mod columns;
mod convergence_command;
mod cycle_command;
mod documentation;
mod embedded;
mod examples;
mod figures;
mod fit;
mod golden;
mod identify;
mod improve;
mod inputs;
mod mac;
mod materials;
mod measured_surface;
mod mesh_files;
mod mode_counts;
mod normal_force;
mod normal_law;
mod plot;
mod reading;
mod refusals;
mod results;
mod rigid_counterface;
mod rotor;
mod signal_command;
mod slow_sliding;
mod survival;
mod sweep;
mod transient_command;
mod uncertainty;

use common::{disc, draws, prelude, program, tier};
