//! Readers of measured data, meshes and results, with right, wrong and mutated input.

#[path = "../common/mod.rs"]
mod common;

mod bounds;
mod fuzz;
mod mesh_files;
mod prelude;
mod signal_reader;

use common::program;
