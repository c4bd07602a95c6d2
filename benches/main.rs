//! Every benchmark in one program, so that the library is linked once.
//!
//! `cargo bench NAME` runs those whose file or function has `NAME` in its name. Without `--bench`, as `cargo test --benches` calls
//! it, each runs once on a small mesh.

#[path = "../tests/common/mod.rs"]
mod common;

mod cea_cyclic;
mod cea_sparse;
mod check;
mod cycle;
mod fma_peak;
mod frf;
mod solid;
mod transient;

use common::disc;
use prelude::*;

/// What the benchmarks and the models of the tests name.
mod prelude {
    pub use crate::common::prelude::*;
    pub use crate::common::waves::WaveModel;
}

/// Benchmarks that print tables of their own; divan has the others.
const TABLES: [(&str, fn()); 4] = [
    ("check", check::run),
    ("cycle", cycle::run),
    ("solid", solid::run),
    ("transient", transient::run),
];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut filters = words.iter().filter(|word| !word.starts_with('-')).peekable();
    let is_every = filters.peek().is_none();
    let filters: Vec<&String> = filters.collect();
    for (name, run) in TABLES {
        if is_every || filters.iter().any(|filter| name.contains(*filter)) {
            println!("== {name}");
            run();
        }
    }
    divan::main();
}

/// Whether something is measured: `cargo bench` says so.
fn is_measured() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

/// An observer of runs whose motions nobody reads.
struct Ignore;

impl Observer for Ignore {
    fn observe(&mut self, _: &Sample<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
