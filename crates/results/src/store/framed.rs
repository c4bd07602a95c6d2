//! Files that know whether they are whole: binary ones by magic, version, checksum, length, payload; JSON objects by a
//! last key that holds the checksum of all others.

use serde::Serialize;
use serde_json::Value;
use std::io::{self, Write};

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

/// Reads a JSON object and checks its checksum; whether it has one. Without it is of a version before checksums, or
/// damaged.
pub fn read_sealed(bytes: &[u8]) -> Result<(Value, bool), Defect> {
    let mut object: Value = serde_json::from_slice(bytes).map_err(Defect::damage)?;
    let Some(entries) = object.as_object_mut() else {
        return Err(Defect::damage("it is no object"));
    };
    let Some(found) = entries.shift_remove(CHECKSUM) else { return Ok((object, false)) };
    let wanted = checksum(&object).map_err(Defect::damage)?;
    if found.as_str() != Some(&wanted) {
        return Err(Defect::damage("its checksum does not fit its contents"));
    }
    Ok((object, true))
}
