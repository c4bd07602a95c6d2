//! Manifest of a result: program, case and inputs.

use frictionsim_output::Described;
use serde::{Deserialize, Serialize};

/// Everything needed to make a result again; part of every summary and of the output folder.
///
/// Holds no time of day: the same run writes the same manifest.
#[derive(Clone, Debug, Default, PartialEq, Eq, Described, Serialize, Deserialize)]
pub struct Manifest {
    /// Program name.
    pub program: String,
    /// Program version.
    pub version: String,
    /// Subcommand.
    pub command: String,
    /// Case file as the user named it.
    pub case_file: String,
    /// Text of the case file.
    pub case_text: String,
    /// SHA-256 of the effective case, overrides included.
    pub case_hash: String,
    /// Overrides `KEY=VALUE` in the order given.
    pub overrides: Vec<String>,
    /// Worker threads.
    pub threads: usize,
    /// SIMD level that the kernels ran with.
    pub simd: String,
}

impl Manifest {
    /// A manifest of this program's version.
    pub fn new(command: &str) -> Self {
        Self {
            program: "frictionsim".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: command.to_owned(),
            threads: 1,
            simd: "scalar".to_owned(),
            ..Self::default()
        }
    }

    /// The overrides in words.
    pub fn overrides_text(&self) -> String {
        if self.overrides.is_empty() { "none".to_owned() } else { self.overrides.join(", ") }
    }
}
