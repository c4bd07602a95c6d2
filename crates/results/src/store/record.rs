//! Data that a command keeps bit by bit: what goes on from there, and what is drawn again.

use super::error::FolderError;
use super::folder::OutputFolder;
use super::framed::{self, Defect};
use super::reopening::read_existing;
use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::{self, Read, Write};
use std::path::Path;

/// Data that a command keeps bit by bit.
pub trait Record: Serialize + DeserializeOwned {
    /// Its file.
    const FILE: &str;
    /// How the file begins: which command it belongs to.
    const MAGIC: [u8; 8];
    /// Format of the data.
    const VERSION: u32;

    /// What does not fit together: lists that must be of one length, codes and sizes out of range. Whoever reads the
    /// record relies on `None`.
    fn inconsistency(&self) -> Option<&'static str>;
}

/// Writes the record of a run, deflated.
pub fn write_record<T: Record>(folder: &OutputFolder, record: &T) -> Result<(), FolderError> {
    folder.write_bulk(T::FILE, |out| {
        let mut deflated = DeflateEncoder::new(Vec::new(), Compression::default());
        deflated.write_all(&postcard::to_stdvec(record).map_err(io::Error::other)?)?;
        framed::write(out, T::MAGIC, T::VERSION, &deflated.finish()?)
    })
}

/// The record that the bytes of a file hold as they are.
pub fn decoded<T: Record>(bytes: &[u8]) -> Result<T, Defect> {
    whole(framed::read(bytes, T::MAGIC, T::VERSION)?)
}

fn whole<T: Record>(bytes: &[u8]) -> Result<T, Defect> {
    let record: T = postcard::from_bytes(bytes).map_err(Defect::damage)?;
    record.inconsistency().map_or(Ok(record), |what| Err(Defect::damage(what)))
}

fn inflated<T: Record>(bytes: &[u8]) -> Result<T, Defect> {
    let payload = framed::read(bytes, T::MAGIC, T::VERSION)?;
    let deflated: Vec<u8> = postcard::from_bytes(payload).map_err(Defect::damage)?;
    let mut bytes = Vec::new();
    DeflateDecoder::new(&deflated[..]).read_to_end(&mut bytes).map_err(Defect::damage)?;
    whole(&bytes)
}

/// Reads the record of a folder.
///
/// # Errors
/// [`FolderError::Unusable`] if it is missing, damaged or of another version; those of the file system.
pub fn read_record<T: Record>(folder: &Path) -> Result<T, FolderError> {
    let unusable = |reason: String| FolderError::no_results(folder, reason);
    let bytes = read_existing(&folder.join(T::FILE))?;
    let bytes = bytes.ok_or_else(|| unusable(format!("it has no {}: run it again", T::FILE)))?;
    inflated(&bytes).map_err(|defect| {
        let (file, wanted) = (T::FILE, T::VERSION);
        unusable(match defect {
            Defect::Version(found) => format!(
                "its {file} has format {found}, this version reads format {wanted}: run it again"
            ),
            Defect::Damage(reason) => format!("its {file} is damaged ({reason}): run it again"),
        })
    })
}
