//! `frictionsim improve`: where a modification silences unstable modes.

use super::{Failure, Run, RunOptions, Session};
use crate::results::improve::{document, figures, write};
use crate::study::improve::improve;
use clap::Args;

/// Find changes that silence the unstable modes
///
/// Computes the derivatives of growth rates by a mass, spring, dashpot, damping layer or removed patch at every place.
/// Predicts the best places with all modes together. Runs the best candidates again as cases of their own. The
/// [improve] section limits what may be changed and by how much.
#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    options: RunOptions,
}

impl Run for Arguments {
    fn run(&self) -> Result<(), Failure> {
        let session = Session::start("improve", &self.options)?;
        session.case.require_cea()?;
        let folder = session.begin()?;
        let found = improve(&session.case)?;
        let summary = found.summary;
        write(&folder, &summary, &found.mesh, &found.fields)?;
        let figures = || figures(&summary, &found.mesh, &found.fields);
        session.finish_result(folder, document(&summary), &summary, figures)
    }
}
