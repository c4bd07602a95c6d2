//! Going on with an earlier run: from its checkpoint, to its own end or to a later one.

use crate::app::prelude::*;
use crate::case::RawCase;
use crate::results::transient::{CHECKPOINT, Checkpoint, read_checkpoint};
use crate::results::{Replace, read_manifest};

/// Keys that may differ when a run goes on: what they say concerns its end alone.
const FREE: [&str; 2] = ["transient.duration", "transient.stop_when_settled"];

/// What a checkpoint is known by: the hash of the case without its end.
pub fn run_hash(session: &Session) -> String {
    session.case.raw.without(&FREE).hash()
}

/// Where the files of the run lie that is to go on.
pub fn place(session: &Session) -> PathBuf {
    let (path, _) = session.options.output.destination(&session.manifest, true);
    OutputFolder::begun(&path, &session.manifest).unwrap_or(path)
}

/// Takes the folder of a run that goes on from its checkpoint, or starts over where `goes_on` is false.
pub fn reopen(session: &Session, goes_on: bool) -> Result<OutputFolder, Failure> {
    let ours = &session.manifest;
    let (path, _) = session.options.output.destination(ours, true);
    let is_extended = goes_on && place(session) == path;
    let found = read_manifest(&path).ok().filter(|found| found.case_hash != ours.case_hash);
    if found.is_none() || !is_extended {
        return session.open_folder(true);
    }
    if session.options.output.dry_run {
        return Err(session.options.output.dry_run_at(&path, ours));
    }
    let folder = OutputFolder::open(&path, ours, Replace::Continued)?;
    session.keep_inputs(&folder)?;
    Ok(folder)
}

/// Refuses to go on with a run whose case differs in more than its end.
fn refuse_other_case(session: &Session, path: &Path) -> Result<(), Failure> {
    let ours = &session.manifest;
    let found = match read_manifest(path) {
        Ok(found) if found.command == ours.command && found.case_hash != ours.case_hash => found,
        _ => return Ok(()),
    };
    let theirs = RawCase::parse(&found.case_file, found.case_text.as_bytes(), &found.overrides)?;
    let here = session.case.raw.without(&FREE);
    if let Some(difference) = here.difference(&theirs.without(&FREE)) {
        return Err(Failure::usage(format!(
            "{} holds the results of another case: {difference} there. Go on with the case that it \
             holds, or start a run of its own with --out",
            path.display()
        )));
    }
    Ok(())
}

/// The checkpoint to go on from, if there is one; nothing is written.
///
/// # Errors
/// A folder of another run, with the key that differs; a checkpoint that cannot be used.
pub fn find(session: &Session) -> Result<Option<Checkpoint>, Failure> {
    let path = place(session);
    refuse_other_case(session, &path)?;
    let found = read_checkpoint(&path, &run_hash(session), &session.manifest.simd);
    let found = found.map_err(Failure::usage)?;
    if found.is_none() && path.exists() {
        let missing = path.join(CHECKPOINT);
        tracing::warn!("{} does not exist: starting from the beginning", missing.display());
    }
    Ok(found)
}
