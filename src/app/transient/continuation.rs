//! Going on with an earlier run: from its checkpoint, to its own end or to a later one.

use crate::app::{Failure, Session};
use crate::case::RawCase;
use crate::results::transient::{Checkpoint, CheckpointError, read_checkpoint};
use crate::results::{OutputFolder, Replace, read_manifest};

/// Keys that may differ when a run goes on: what they say concerns its end alone.
const FREE: [&str; 2] = ["transient.duration", "transient.stop_when_settled"];

/// What a checkpoint is known by: the hash of the case without its end.
pub fn run_hash(session: &Session) -> String {
    session.case.raw.without(&FREE).hash()
}

/// Takes the folder of a run that goes on; its case may have another end.
///
/// # Errors
/// A folder of another run, with the key that differs; those of the folder.
pub fn reopen(session: &Session) -> Result<OutputFolder, Failure> {
    let ours = &session.manifest;
    let (path, _) = session.options.output.destination(ours, true);
    if OutputFolder::is_begun(&path, ours) {
        return session.reopen_folder();
    }
    let found = match read_manifest(&path) {
        Ok(found) if found.command == ours.command && found.case_hash != ours.case_hash => found,
        _ => return session.reopen_folder(),
    };
    let theirs = RawCase::parse(&found.case_file, found.case_text.as_bytes(), &found.overrides)?;
    let here = session.case.raw.without(&FREE);
    if let Some(difference) = here.difference(&theirs.without(&FREE)) {
        return Err(Failure::usage(format!(
            "{} holds the results of another case: {difference} there; go on with the case that it holds, or start \
             a run of its own with --out",
            path.display()
        )));
    }
    if session.options.output.dry_run {
        return Err(session.options.output.dry_run_at(&path, ours));
    }
    session.keep_mesh(OutputFolder::open(&path, ours, Replace::Continued)?)
}

/// The checkpoint of a folder, if there is one.
///
/// # Errors
/// [`CheckpointError`] for one that cannot be used.
pub fn find(session: &Session, folder: &OutputFolder) -> Result<Option<Checkpoint>, Failure> {
    match read_checkpoint(folder.path(), &run_hash(session), &session.manifest.simd) {
        Ok(checkpoint) => Ok(Some(checkpoint)),
        Err(CheckpointError::Missing { path }) => {
            tracing::warn!("{} does not exist: starting from the beginning", path.display());
            Ok(None)
        }
        Err(error) => Err(Failure::usage(error)),
    }
}
