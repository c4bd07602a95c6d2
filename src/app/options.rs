//! Options that every running subcommand shares.

use super::figure_options::FigureOptions;
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// The case to run and how.
#[derive(Args, Clone, Debug)]
pub struct RunOptions {
    /// Case file
    #[arg(value_name = "CASE.toml", value_hint = ValueHint::FilePath)]
    pub case: PathBuf,
    /// Output folder; `None` is `results/STEM/COMMAND` with the stem of the case file's name.
    #[arg(
        long,
        help = "Output folder [default: results/<case file stem>/<command>]",
        value_name = "DIR",
        value_hint = ValueHint::DirPath
    )]
    pub out: Option<PathBuf>,
    /// Override a case key, for example contact.friction_coefficient=0.4 (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Print the summary object, alone, on stdout
    #[arg(long)]
    pub json: bool,
    /// Worker threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// SIMD level of the kernels
    #[arg(long, value_enum, value_name = "LEVEL", default_value = "auto")]
    pub simd: SimdChoice,
    /// No progress, no log but errors
    #[arg(long, short)]
    pub quiet: bool,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
    /// How figures are drawn
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Replace an output folder of a different case
    #[arg(long)]
    pub force: bool,
}

/// SIMD level asked for.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
#[value(rename_all = "lower")]
pub enum SimdChoice {
    /// The widest that the machine has
    Auto,
    /// No vector instructions
    Scalar,
    /// AVX2 with FMA
    Avx2,
    /// AVX-512
    Avx512,
}

impl SimdChoice {
    /// The level that a run uses and records; `None` if this machine does not have it.
    pub fn resolve(self) -> Option<&'static str> {
        match self {
            Self::Auto if has_avx512() => Some("avx512"),
            Self::Auto if has_avx2() => Some("avx2"),
            Self::Auto | Self::Scalar => Some("scalar"),
            Self::Avx2 => has_avx2().then_some("avx2"),
            Self::Avx512 => has_avx512().then_some("avx512"),
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
}

#[cfg(target_arch = "x86_64")]
fn has_avx512() -> bool {
    has_avx2()
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512vl")
        && is_x86_feature_detected!("avx512dq")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_avx2() -> bool {
    false
}

#[cfg(not(target_arch = "x86_64"))]
fn has_avx512() -> bool {
    false
}
