//! Builders of bodies and cases, readers of results and the start of commands.

#![allow(dead_code, unused_imports, reason = "each binary uses a part")]

pub mod block;
pub mod bricks;
pub mod cases;
pub mod coarse;
pub mod disc;
pub mod draws;
pub mod kept;
pub mod mesh_text;
pub mod msh;
pub mod prelude;
pub mod program;
pub mod solids;
pub mod spectra;
pub mod table_1;
pub mod tier;
pub mod triangles;
pub mod waves;
