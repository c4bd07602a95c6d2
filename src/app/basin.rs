//! `frictionsim basin`: which of two motions wins.

use super::profile::{Profile, Run};
use super::{Failure, RunOptions, Session};
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
    const PROFILE: Profile = Profile {
        files: &[("basin.csv", "one row for each transient of the search")],
        examples: &[(
            "frictionsim basin disc.toml",
            "which of two waves wins, by the ratio of their amplitudes at saturation",
        )],
    };

    fn run(&self) -> Result<(), Failure> {
        let session = Session::start("basin", &self.options)?;
        session.case.require_basin()?;
        let folder = session.begin()?;
        let summary = summary(&session.case, &session.manifest)?;
        session.finish_finding(folder, &summary)
    }
}
