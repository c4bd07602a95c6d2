//! `frictionsim collect`: the table over the points that a sweep has finished so far.

use super::figure_options::FigureOptions;
use super::profile::{Profile, Run};
use super::recorded_case::recorded_case;
use super::session::start_threads;
use super::sweep::{SweepPlan, drawing, finished, gather};
use super::{Failure, terminal};
use crate::results::sweep::{SweepFolder, SweepReport, document};
use clap::{ArgAction, Args, ValueHint};
use std::path::PathBuf;
use std::time::Instant;

/// Gather the points of a sweep that several processes share
///
/// Writes points.csv and summary.json. Names missing points and exits with 1 if there are any; the table has the
/// others.
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
    #[command(flatten)]
    figures: FigureOptions,
    /// No information messages; twice: errors only, and no table
    #[arg(long, short, action = ArgAction::Count)]
    quiet: u8,
}

impl Run for Arguments {
    const PROFILE: Profile = Profile {
        files: &[("points.csv", "one row for each finished point")],
        examples: &[("frictionsim collect study", "gather what the shards have finished")],
    };

    fn run(&self) -> Result<(), Failure> {
        let start = Instant::now();
        terminal::start_log(self.quiet, 0);
        start_threads(None);
        let (folder, manifest) = SweepFolder::find(&self.folder)?;
        let case = recorded_case(&self.folder, &manifest)?;
        let plan = SweepPlan::new(&case)?;
        let found = finished(&case, &plan, &folder)?;
        let report = SweepReport { wall_s: start.elapsed().as_secs_f64(), ..found };
        let drawing = (!self.no_figures).then(|| drawing(&case, &plan, &self.figures.drawing()));
        let summary = gather(&folder, &report, &manifest, drawing.as_ref())?;
        if self.json {
            terminal::print_json(&summary)?;
        } else if self.quiet < 2 {
            let path = folder.path().display();
            terminal::print(&format!("{}results in {path}\n", document(&report, false).to_text()))?;
        }
        match report.missing().len() {
            0 => Ok(()),
            missing => Err(Failure::run(format!(
                "{missing} of {} points are missing: run the sweep again with --resume",
                report.count
            ))),
        }
    }
}
