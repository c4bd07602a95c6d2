//! `frictionsim basin`: which of two waves wins.

use super::cycle::disc_model;
use super::{Failure, RunOptions, Session, terminal};
use crate::case::Case;
use crate::cycle::OperatingPoint;
use crate::fem::operator::SimdLevel;
use crate::results::basin::{BasinSummary, write_basin};
use crate::results::{Manifest, write_summary};
use clap::Args;
use serde_json::{Value, json};
use std::time::Instant;

/// Which of two limit cycles wins: the amplitude ratio at saturation that decides
///
/// Transients from steady sliding with two waves seeded, the ratio of the seeds bisected until the amplitude ratio is known
/// above which the second wave wins. Needs a basin section in the case. A map over speed and friction is a sweep with
/// analyses = ["basin"].
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

/// Runs the subcommand.
///
/// # Errors
/// A bad case, steady sliding that is stable, an output folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let session = Session::start("basin", &arguments.options)?;
    session.check_memory(session.case.cost().mesh_memory_bytes)?;
    session.case.require_basin()?;
    let folder = session.open_folder()?;
    terminal::catch_signals(terminal::NOTHING_KEPT);
    let summary = find(&session.case, &session.manifest)?;
    write_basin(&folder, &summary)?;
    let object = write_summary(&folder, &summary)?;
    let path = folder.path().to_owned();
    folder.finish()?;
    session.print(&summary.text(), &object, &path)
}

/// Finds the boundary of a case without writing a file, and gives its summary: a point of a sweep.
///
/// # Errors
/// As [`run`].
pub fn summarize(case: &Case, manifest: &Manifest) -> Result<Value, Failure> {
    Ok(json!(find(case, manifest)?))
}

fn find(case: &Case, manifest: &Manifest) -> Result<BasinSummary, Failure> {
    let start = Instant::now();
    let request = case.require_basin()?;
    let simd = SimdLevel::choose(&manifest.simd).map_err(Failure::usage)?;
    let point = OperatingPoint {
        contact: case.contact.sliding,
        damping: case.damping.rayleigh,
    };
    let found = disc_model(case)
        .basin(&point, request, simd)
        .map_err(Failure::run)?;
    let wall_s = start.elapsed().as_secs_f64();
    Ok(BasinSummary::new(
        &case.title,
        request,
        &found,
        wall_s,
        manifest,
    ))
}
