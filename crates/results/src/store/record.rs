//! Data that a command keeps bit by bit: what goes on from there, and what is drawn again.

use super::framed::{self, Defect};
use super::{error::FolderError, folder::OutputFolder, reopening::read_existing};
use flate2::{Compression, read::DeflateDecoder, write::DeflateEncoder};
use serde::{Serialize, de::DeserializeOwned};
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

/// Bytes that a record inflates to at most: a small file must not fill the memory.
const MOST_BYTES: u64 = 4 << 30;

/// Writes the record of a run: its length, and its bytes deflated.
pub fn write_record<T: Record>(folder: &OutputFolder, record: &T) -> Result<(), FolderError> {
    folder.write_bulk(T::FILE, |out| {
        let bytes = postcard::to_stdvec(record).map_err(io::Error::other)?;
        let length = declared(bytes.len() as u64).map_err(io::Error::other)?;
        let mut deflated = DeflateEncoder::new(Vec::new(), Compression::default());
        deflated.write_all(&bytes)?;
        framed::write(out, T::MAGIC, T::VERSION, &(length, deflated.finish()?))
    })
}

/// A length that a record may have.
fn declared(length: u64) -> Result<u64, Defect> {
    let (found, most) = (length >> 20, MOST_BYTES >> 20);
    let long = || Defect::Damage(format!("{found} MiB of data, the limit is {most} MiB"));
    (length <= MOST_BYTES).then_some(length).ok_or_else(long)
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
    let (length, deflated): (u64, &[u8]) = postcard::from_bytes(payload).map_err(Defect::damage)?;
    let (length, mut bytes) = (declared(length)?, Vec::new());
    let inflated = DeflateDecoder::new(deflated).take(length + 1).read_to_end(&mut bytes);
    match inflated.map_err(Defect::damage)? as u64 {
        found if found == length => whole(&bytes),
        _ => Err(Defect::Damage(format!("its data are not the {length} bytes that it declares"))),
    }
}

/// Reads the record of a folder.
///
/// # Errors
/// [`FolderError::Unusable`] if it is missing, damaged or of another version; those of the file system.
pub fn read_record<T: Record>(folder: &Path) -> Result<T, FolderError> {
    let missing = || format!("has no {}: run it again without --no-figures", T::FILE);
    let bytes = read_existing(&folder.join(T::FILE))?;
    let bytes = bytes.ok_or_else(|| FolderError::unusable(folder, missing()))?;
    inflated(&bytes).map_err(|defect| {
        let (file, wanted) = (T::FILE, T::VERSION);
        let reason = match defect {
            Defect::Version(found) => format!(
                "its {file} has format {found}, this version reads format {wanted}: run it again"
            ),
            Defect::Damage(reason) => format!("its {file} is damaged ({reason}): run it again"),
        };
        FolderError::no_results(folder, reason)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Serialize, Deserialize)]
    struct Zeros(Vec<u8>);

    impl Record for Zeros {
        const FILE: &str = "zeros.bin";
        const MAGIC: [u8; 8] = *b"FRICSIM0";
        const VERSION: u32 = 1;

        fn inconsistency(&self) -> Option<&'static str> {
            None
        }
    }

    /// A file that says how many bytes it inflates to, which are `count` zeros in a list.
    fn crafted(declared: u64, count: usize) -> Vec<u8> {
        let mut deflated = DeflateEncoder::new(Vec::new(), Compression::default());
        deflated.write_all(&postcard::to_stdvec(&Zeros(vec![0; count])).unwrap()).unwrap();
        let mut file = Vec::new();
        let payload = (declared, deflated.finish().unwrap());
        framed::write(&mut file, Zeros::MAGIC, Zeros::VERSION, &payload).unwrap();
        file
    }

    #[test]
    fn a_record_inflates_to_what_it_declares_and_to_no_more_than_the_limit() {
        let count = 4 << 20;
        let length = count as u64 + 4;
        assert_eq!(inflated::<Zeros>(&crafted(length, count)).unwrap().0.len(), count);
        let said = |declared| {
            let file = crafted(declared, count);
            assert!(file.len() < count / 500);
            inflated::<Zeros>(&file).err().unwrap().to_string()
        };
        for other in [0, 1000, length - 1, length + 1] {
            assert_eq!(said(other), format!("its data are not the {other} bytes that it declares"));
        }
        for huge in [MOST_BYTES + (1 << 20), u64::MAX] {
            assert!(said(huge).ends_with("MiB of data, the limit is 4096 MiB"));
        }
    }
}
