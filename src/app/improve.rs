//! `frictionsim improve`: where a modification silences unstable modes.

use super::prelude::*;
use crate::results::improve::{document, figures, write};
use crate::study::improve::improve;

pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    let session = Session::start("improve", options)?;
    session.case.require_cea()?;
    let folder = session.begin()?;
    let found = improve(&session.case)?;
    write(&folder, &found)?;
    session.finish_result(folder, document(&found.summary), &found.summary, || figures(&found))
}
