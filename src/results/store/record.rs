//! `record.bin`: what a command keeps, bit by bit, to draw its figures again; the tables have the same numbers for people.

use super::error::FolderError;
use super::folder::OutputFolder;
use super::framed::{self, Defect};
use frictionsim_bounds::{RESULT, read_file};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io;
use std::path::Path;

/// Name of the record in its folder.
const RECORD: &str = "record.bin";

/// Data that a command keeps to draw its figures again.
pub trait Record: Serialize + DeserializeOwned {
    /// How the file begins: which command it belongs to.
    const MAGIC: [u8; 8];
    /// Format of the data.
    const VERSION: u32;

    /// What does not fit together: lists that must be of one length, codes and sizes out of range. Whoever draws the
    /// record relies on `None`.
    fn inconsistency(&self) -> Option<&'static str>;
}

/// Writes the record of a run.
///
/// # Errors
/// Those of the folder.
pub fn write_record<T: Record>(folder: &OutputFolder, record: &T) -> Result<(), FolderError> {
    folder.write_bulk(RECORD, |out| {
        let payload = postcard::to_stdvec(record).map_err(io::Error::other)?;
        framed::write(out, T::MAGIC, T::VERSION, &payload)
    })?;
    Ok(())
}

/// Refuses a record that is not one of its case's mesh.
///
/// # Errors
/// [`FolderError::NotResults`].
pub fn refuse_misfit(folder: &Path, fits: bool) -> Result<(), FolderError> {
    if fits {
        return Ok(());
    }
    Err(FolderError::NotResults {
        path: folder.to_owned(),
        reason: format!("its {RECORD} is damaged (it is not of the case's mesh): run it again"),
    })
}

/// Reads the record of a folder.
///
/// # Errors
/// [`FolderError::NotResults`] if it is missing, damaged or of another version; those of the file
/// system.
pub fn read_record<T: Record>(folder: &Path) -> Result<T, FolderError> {
    let path = folder.join(RECORD);
    let unusable = |reason: String| FolderError::NotResults { path: folder.to_owned(), reason };
    let bytes = match read_file(&path, RESULT) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(unusable(format!("it has no {RECORD}: run it again")));
        }
        Err(error) => return Err(FolderError::io("read", &path, error)),
    };
    let record = framed::read(&bytes, T::MAGIC, T::VERSION).and_then(|payload| {
        let record: T = postcard::from_bytes(payload).map_err(|e| Defect::Damage(e.to_string()))?;
        match record.inconsistency() {
            None => Ok(record),
            Some(what) => Err(Defect::Damage(what.to_owned())),
        }
    });
    record.map_err(|defect| {
        let wanted = T::VERSION;
        unusable(match defect {
            Defect::Version(found) => format!(
                "its {RECORD} has format {found}, this version reads format {wanted}: run it again"
            ),
            Defect::Damage(reason) => {
                format!("its {RECORD} is damaged ({reason}): run it again")
            }
        })
    })
}
