//! Readers hold against changed inputs: no panic, no input that costs more than seconds, nothing damaged is used.
//!
//! Each target changes real inputs, made or read when the test starts, by a seeded generator for a number of seconds:
//! `FRICTIONSIM_FUZZ_SECONDS`, 1 unless said otherwise, 10 in the long tier; `FRICTIONSIM_FUZZ_SEED` chooses where the seeds begin. A failure names
//! its seed and leaves the input in `target/tmp`.

mod meshes;
pub mod mutation;
mod readers;
mod results;

use crate::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Longest time for one input, s; generous, as other programs share the cores.
const LONGEST: f64 = 10.0;

fn variable(name: &str, default: u64) -> u64 {
    let text = std::env::var(name).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Tries inputs until the time is over: `make` builds one from a seed, `hold_one` must neither panic nor take long.
pub fn hold<T: AsRef<[u8]>>(name: &str, make: impl Fn(&mut Random) -> T, hold_one: impl Fn(&[u8])) {
    let seconds = Duration::from_secs(variable("FRICTIONSIM_FUZZ_SECONDS", sized(1, 10)));
    let (begin, first) = (Instant::now(), variable("FRICTIONSIM_FUZZ_SEED", 0));
    let mut seed = first;
    while begin.elapsed() < seconds {
        let input = make(&mut Random::new(seed));
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| hold_one(input.as_ref())));
        let took = start.elapsed().as_secs_f64();
        if outcome.is_err() || took > LONGEST {
            let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{seed}"));
            let _ = fs::write(&path, input.as_ref());
            panic!("{name}: seed {seed} after {took:.1} s, input in {}", path.display());
        }
        seed += 1;
    }
    println!("{name}: {} inputs held", seed - first);
}
