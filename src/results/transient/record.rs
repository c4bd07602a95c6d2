//! `record.bin`: all that a transient recorded, to draw its figures again.

use super::framed::{self, Defect};
use crate::results::folder::{FolderError, OutputFolder};
use crate::transient::Recorder;
use std::fs;
use std::io;
use std::path::Path;

/// Name of the record in its folder.
const RECORD: &str = "record.bin";

const MAGIC: [u8; 8] = *b"FRICSIMR";
const VERSION: u32 = 1;

/// Writes the record as it is in memory, bit by bit; the tables have the same numbers for people.
///
/// # Errors
/// Those of the folder.
pub fn write_record(folder: &OutputFolder, record: &Recorder) -> Result<(), FolderError> {
    folder.write_bulk(RECORD, |out| {
        let payload = postcard::to_stdvec(record).map_err(io::Error::other)?;
        framed::write(out, MAGIC, VERSION, &payload)
    })?;
    Ok(())
}

/// Reads the record of a folder.
///
/// # Errors
/// [`FolderError::NotResults`] if it is missing, damaged or of another version; those of the file
/// system.
pub fn read_record(folder: &Path) -> Result<Recorder, FolderError> {
    let path = folder.join(RECORD);
    let unusable = |reason: String| FolderError::NotResults {
        path: folder.to_owned(),
        reason,
    };
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(unusable(format!("it has no {RECORD}: run it again")));
        }
        Err(error) => return Err(FolderError::io("read", &path, error)),
    };
    let record = framed::read(&bytes, MAGIC, VERSION).and_then(|payload| {
        postcard::from_bytes(payload).map_err(|e| Defect::Damage(e.to_string()))
    });
    record.map_err(|defect| {
        unusable(match defect {
            Defect::Version(found) => format!(
                "its {RECORD} has format {found}, this version reads format {VERSION}: run it again"
            ),
            Defect::Damage(reason) => {
                format!("its {RECORD} is damaged ({reason}): run it again")
            }
        })
    })
}
