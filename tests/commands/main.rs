//! The commands, their case files, figures and results as a user meets them; the structure of the source.

#[path = "../common/bricks.rs"]
mod bricks;
#[path = "../common/cases.rs"]
mod cases;
#[path = "../common/coarse_block.rs"]
mod coarse_block;
#[path = "../common/coarse_disc.rs"]
mod coarse_disc;
#[path = "../common/disc.rs"]
mod disc;
#[path = "../common/draws.rs"]
mod draws;
#[path = "../common/mesh_text.rs"]
mod mesh_text;
#[path = "../common/msh.rs"]
mod msh;
#[path = "../common/program.rs"]
mod program;
#[path = "../common/table_1.rs"]
mod table_1;
#[path = "../common/tier.rs"]
mod tier;

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
mod prelude;
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
