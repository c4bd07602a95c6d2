//! `frictionsim basin`: which of two motions wins.

use super::{Failure, Run, RunOptions, Session};
use crate::study::basin::summary;
use clap::Args;

/// Which of two limit cycles wins
///
/// Runs transients with two seeds: two waves on the built-in disc, two modes on any other body. Bisects the ratio of
/// the seeds above which the second one wins. With one mode it finds the kick that tips stable sliding into its limit
/// cycle. Needs a [basin] section. A map over speed and friction is a sweep with analyses = ["basin"].
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

impl Run for Arguments {
    fn run(&self) -> Result<(), Failure> {
        let session = Session::start("basin", &self.options)?;
        session.case.require_basin()?;
        let folder = session.begin()?;
        let summary = summary(&session.case, &session.manifest)?;
        session.finish_finding(folder, &summary)
    }
}
