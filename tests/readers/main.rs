//! Readers of measured data, meshes and results, with right, wrong and mutated input.

#[path = "../common/msh.rs"]
mod msh;

mod fuzz;
mod signal_reader;
