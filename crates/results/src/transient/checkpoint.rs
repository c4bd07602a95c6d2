//! The state of a transient on disk, to go on from.

use crate::common::*;
use crate::framed::{self, Defect};
use crate::record::{Record, decoded};
use crate::reopening::read_existing;
use frictionsim_physics::transient::TransientState;

/// Name of the checkpoint in its folder.
pub const CHECKPOINT: &str = "checkpoint.bin";

/// Everything that a run needs to go on to the same bytes as one that was never stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the case without its end, which may be moved.
    pub case_hash: String,
    /// SIMD level: another one rounds differently.
    pub simd: String,
    /// State of the time loop.
    pub state: TransientState,
    /// What was recorded so far; `None` where the folder's record has it.
    pub record: Option<Recorder>,
}

impl Record for Checkpoint {
    const FILE: &str = CHECKPOINT;
    const MAGIC: [u8; 8] = *b"FRICSIMC";
    const VERSION: u32 = 7;

    fn inconsistency(&self) -> Option<&'static str> {
        self.record.as_ref().and_then(Record::inconsistency)
    }
}

/// What a longer run goes on from.
impl Record for Recorder {
    const FILE: &str = "record.bin";
    const MAGIC: [u8; 8] = *b"FRICSIMR";
    const VERSION: u32 = 8;

    fn inconsistency(&self) -> Option<&'static str> {
        (!self.is_consistent()).then_some("its samples, probes and frames do not fit together")
    }
}

/// Writes a checkpoint; the one before stays until this one is complete. Without a record it goes with that of the
/// folder.
pub fn write_checkpoint(
    folder: &OutputFolder,
    case_hash: &str,
    state: &TransientState,
    record: Option<&Recorder>,
) -> Result<(), FolderError> {
    // These are the bytes of a [`Checkpoint`], without a copy.
    let contents = (case_hash, &folder.manifest().simd, state, record);
    folder.write(CHECKPOINT, |out| {
        framed::write(out, Checkpoint::MAGIC, Checkpoint::VERSION, &contents)
    })
}

/// Reads the checkpoint of a folder, if there is one.
///
/// # Errors
/// [`FolderError::Unusable`] for one that is damaged, or of another run or version; the file is left as it is.
pub fn read_checkpoint(
    folder: &Path,
    case_hash: &str,
    simd: &str,
) -> Result<Option<Checkpoint>, FolderError> {
    let path = folder.join(CHECKPOINT);
    let unusable = |why: String| FolderError::unusable(&path, why);
    let again = "run without --resume to start over";
    let Some(bytes) = read_existing(&path)? else { return Ok(None) };
    let checkpoint: Checkpoint = decoded(&bytes).map_err(|defect| {
        unusable(match defect {
            Defect::Version(found) => format!(
                "has format {found}, this version reads format {}: resume with the version that wrote it, or {again}",
                Checkpoint::VERSION
            ),
            Defect::Damage(reason) => {
                format!("is damaged ({reason}): it is left as it is; {again}")
            }
        })
    })?;
    for (what, found, expected) in
        [("case hash", &checkpoint.case_hash, case_hash), ("SIMD level", &checkpoint.simd, simd)]
    {
        if found != expected {
            return Err(unusable(format!(
                "belongs to another run: its {what} is {found}, here it is {expected}; {again}"
            )));
        }
    }
    Ok(Some(checkpoint))
}
