//! `frictionsim collect`: the table over the points that a sweep has finished so far.

use super::sweep::{SweepPlan, finished_points, gather};
use super::{Failure, terminal};
use crate::case::{Case, RawCase};
use crate::results::sweep::{SweepFolder, SweepReport, print};
use clap::{Args, ValueHint};
use std::path::PathBuf;
use std::time::Instant;

/// Gather a sharded sweep's points: points.csv and summary.json
///
/// Says which points are missing and exits with 1 if there are any; the table then has the others.
#[derive(Args)]
pub struct Arguments {
    /// Output folder of the sweep
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    /// Print the summary object, alone, on stdout
    #[arg(long)]
    json: bool,
    /// Draw no figures
    #[arg(long)]
    no_figures: bool,
}

/// Runs the subcommand.
///
/// # Errors
/// A folder that is no sweep's, missing points, a folder that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let (folder, manifest) = SweepFolder::find(&arguments.folder)?;
    let text = manifest.case_text.as_bytes();
    let raw = RawCase::parse(&manifest.case_file, text, &manifest.overrides)?;
    let case = Case::from_raw(raw)?;
    let plan = SweepPlan::new(&case)?;
    let records = finished_points(&folder, plan.count())?;
    let report = SweepReport {
        title: &case.title,
        friction_coefficient: case.contact.sliding.friction_coefficient,
        keys: &plan.keys(),
        analyses: &plan.analysis_names(),
        count: plan.count(),
        records: &records,
        ran: None,
        wall_s: start.elapsed().as_secs_f64(),
    };
    let summary = gather(&folder, &report, &manifest, !arguments.no_figures)?;
    if arguments.json {
        terminal::print_json(&summary)?;
    } else {
        let path = folder.path().display();
        terminal::print(&format!("{}results in {path}\n", print(&report)))?;
    }
    match report.missing().len() {
        0 => Ok(()),
        missing => Err(Failure::run(format!(
            "{missing} of {} points are missing: run the sweep again with --resume",
            report.count
        ))),
    }
}
