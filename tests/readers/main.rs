//! Readers of measured data, meshes and results, with right, wrong and mutated input.

#[path = "../common/block.rs"]
mod block;
#[path = "../common/msh.rs"]
mod msh;
#[path = "../common/program.rs"]
mod program;
#[path = "../common/tier.rs"]
mod tier;

mod bounds;
mod fuzz;
mod mesh_files;
mod signal_reader;
