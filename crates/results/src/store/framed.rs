//! Files that know whether they are whole: binary ones by magic, version, checksum, length, payload; JSON objects by a
//! last key that holds the checksum of all others. They appear under their name when they are whole.

use super::error::FolderError;
use crate::prelude::*;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Last key of a JSON file of the program's own.
const CHECKSUM: &str = "checksum";

/// Magic, version, checksum, length of what follows.
const HEADER: usize = 8 + 4 + 4 + 8;

/// Why a file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Defect {
    /// It has this format, which is not the one wanted.
    #[error("format {0}")]
    Version(u32),
    /// It is cut short or changed; what does not fit.
    #[error("{0}")]
    Damage(String),
}

impl Defect {
    pub(crate) fn damage(reason: impl ToString) -> Self {
        Self::Damage(reason.to_string())
    }
}

/// Writes header and payload, the bytes of `data`.
pub fn write(
    out: &mut dyn Write,
    magic: [u8; 8],
    version: u32,
    data: &impl Serialize,
) -> io::Result<()> {
    let payload = postcard::to_stdvec(data).map_err(io::Error::other)?;
    out.write_all(&magic)?;
    out.write_all(&version.to_le_bytes())?;
    out.write_all(&crc32fast::hash(&payload).to_le_bytes())?;
    out.write_all(&(payload.len() as u64).to_le_bytes())?;
    out.write_all(&payload)
}

/// The payload, if the file is whole and of this kind and version.
pub fn read(bytes: &[u8], magic: [u8; 8], version: u32) -> Result<&[u8], Defect> {
    let Some((header, payload)) = bytes.split_at_checked(HEADER) else {
        return Err(Defect::damage("it is shorter than its header"));
    };
    let (found, rest) = header.split_at(8);
    if found != magic {
        return Err(Defect::damage("it does not begin as such a file does"));
    }
    let word = |at: usize| u32::from_le_bytes(std::array::from_fn(|i| rest[at + i]));
    let (found, checksum) = (word(0), word(4));
    if found != version {
        return Err(Defect::Version(found));
    }
    let length = u64::from_le_bytes(std::array::from_fn(|i| rest[8 + i]));
    if length != payload.len() as u64 {
        return Err(Defect::Damage(format!("{} bytes where {length} were written", payload.len())));
    }
    if crc32fast::hash(payload) != checksum {
        return Err(Defect::damage("its checksum does not fit its contents"));
    }
    Ok(payload)
}

/// The checksum of a JSON object: that of its shortest text, so that other blanks and line ends do not matter.
fn checksum(object: &Value) -> io::Result<String> {
    Ok(format!("{:08x}", crc32fast::hash(&serde_json::to_vec(object)?)))
}

/// Writes a value as lines of JSON.
pub fn write_json(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    out.write_all(b"\n")
}

/// Writes a JSON object with its checksum.
pub fn write_sealed(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    let mut object = serde_json::to_value(value)?;
    let checksum = checksum(&object)?;
    object[CHECKSUM] = Value::String(checksum);
    write_json(out, &object)
}

/// Reads a JSON object and checks its checksum; without one it is damaged.
pub fn read_sealed(bytes: &[u8]) -> Result<Value, Defect> {
    let mut object: Value = serde_json::from_slice(bytes).map_err(Defect::damage)?;
    let Some(entries) = object.as_object_mut() else {
        return Err(Defect::damage("it is no object"));
    };
    let found = entries.shift_remove(CHECKSUM);
    let found = found.ok_or_else(|| Defect::damage("its checksum is gone"))?;
    let wanted = checksum(&object).map_err(Defect::damage)?;
    if found.as_str() != Some(&wanted) {
        return Err(Defect::damage("its checksum does not fit its contents"));
    }
    Ok(object)
}

/// How the name of a file that is still being written begins.
pub(crate) const TEMPORARY: &str = ".writing-";
/// Random characters that follow.
const RANDOM: usize = 6;

/// Whether a file has a name as half-written ones have.
pub(crate) fn is_temporary(name: &str) -> bool {
    name.strip_prefix(TEMPORARY).is_some_and(|rest| {
        rest.len() == RANDOM && rest.bytes().all(|byte| byte.is_ascii_alphanumeric())
    })
}

/// Passes bytes on and keeps their checksum.
struct Summing<W> {
    out: W,
    checksum: crc32fast::Hasher,
}

impl<W: Write> Write for Summing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.checksum.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes what a file holds.
pub(crate) type Fill<'a> = Box<dyn FnOnce(&mut dyn Write) -> io::Result<()> + 'a>;

/// Creates a folder, and those above it.
pub(crate) fn create_folder(path: &Path) -> Result<(), FolderError> {
    fs::create_dir_all(path).map_err(|e| FolderError::io("create folder", path, e))
}

/// Writes a file whole or not at all, flushed to the disk if it is to be durable; gives the checksum of its bytes.
pub(crate) fn write_whole(path: &Path, durable: bool, fill: Fill<'_>) -> Result<u32, FolderError> {
    try_write(path, durable, fill).map_err(|e| FolderError::io("write", path, e))
}

/// Writes a file under a temporary name in the same folder and renames it, flushed to the disk before
/// that if it is to be durable; gives the checksum of its bytes.
fn try_write(path: &Path, is_durable: bool, fill: Fill<'_>) -> io::Result<u32> {
    let parent = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(parent)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY).rand_bytes(RANDOM);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any file that a program creates, under the user's umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut temporary = builder.tempfile_in(parent)?;
    let summing = Summing { out: temporary.as_file_mut(), checksum: crc32fast::Hasher::new() };
    let mut out = BufWriter::with_capacity(1 << 16, summing);
    fill(&mut out)?;
    let checksum = out.into_inner().map_err(io::IntoInnerError::into_error)?.checksum.finalize();
    if is_durable {
        temporary.as_file().sync_all()?;
    }
    temporary.persist(path).map_err(|error| error.error)?;
    Ok(checksum)
}
