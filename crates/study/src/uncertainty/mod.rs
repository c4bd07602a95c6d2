//! Probability of squeal and the parameters that decide it: onsets of samples drawn from the distributions of a case.
//!
//! ```no_run
//! use frictionsim::case::Case;
//! use frictionsim::study::uncertainty::{BLOCK, Sampler, summarize};
//!
//! let bytes = std::fs::read("cases/squeal-probability.toml")?;
//! let case = Case::parse("disc", &bytes, &["uncertainty.samples=128".to_owned()])?;
//! let sampler = Sampler::new(&case)?;
//! let samples: Vec<_> = (1..=128 / BLOCK).flat_map(|block| sampler.block(block)).collect();
//! let found = summarize(&case, &samples);
//! println!("{:?}, decided by {:?}", found.probability_unstable, found.decisive);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod robust;
mod samples;
mod summary;

pub use robust::{Design, curves};
pub use samples::{BLOCK, Sampler, largest_friction};
pub use summary::{indices, indices_with_intervals, summarize, wilson};
