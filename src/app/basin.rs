//! `frictionsim basin`: which of two motions wins.

use super::prelude::*;
use crate::study::basin::summary;

pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("basin", options)?;
    session.case.require_basin()?;
    let folder = session.begin()?;
    let summary = summary(&session.case, &session.manifest)?;
    session.finish_finding(folder, &summary)
}
