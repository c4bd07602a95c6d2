//! `frictionsim cea` of a superelement that stands free.

use super::limits::{STANDARD_INPUT, input_name, read_input};
use super::session::start_threads;
use super::{Failure, RunOptions, terminal};
use crate::case::{FreeSystem, RawCase};
use crate::results::Manifest;
use crate::study::superelement::free_spectrum;
use frictionsim_bounds::CASE;
use std::path::Path;
use std::time::Instant;

/// The superelement that a case describes, where it describes no body. Its files are relative to the case, so it cannot
/// come from standard input.
///
/// # Errors
/// A case that cannot be read; matrices that are none.
pub fn described(case: &Path, overrides: &[String]) -> Result<Option<FreeSystem>, Failure> {
    if case == Path::new(STANDARD_INPUT) {
        return Ok(None);
    }
    let bytes = read_input(case, CASE)?;
    let raw = RawCase::parse(&input_name(case), &bytes, overrides)?;
    if FreeSystem::is_described_by(&raw) { Ok(Some(FreeSystem::read(raw)?)) } else { Ok(None) }
}

/// Solves it and writes the eigenvalues.
///
/// # Errors
/// Matrices that are singular together, an output folder that cannot be written.
pub fn run(options: &RunOptions, system: &FreeSystem) -> Result<(), Failure> {
    let start = Instant::now();
    terminal::start_log(options.output.quiet, options.output.verbose);
    let manifest = Manifest {
        case_file: options.case.display().to_string(),
        case_text: system.raw.text.clone(),
        case_hash: system.hash.clone(),
        overrides: system.raw.overrides.clone(),
        threads: start_threads(options.threads),
        ..Manifest::new("cea")
    };
    let folder = options.output.open_folder(&manifest, false)?;
    let spectrum = free_spectrum(system)?;
    let summary = spectrum.write(&folder, start.elapsed().as_secs_f64())?;
    options.output.finish(folder, &spectrum.print(), &summary)
}
