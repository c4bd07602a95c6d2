//! Binary files that know whether they are whole: magic, version, checksum, length, payload.

use std::io::{self, Write};

/// Magic, version, checksum, length of what follows.
const HEADER: usize = 8 + 4 + 4 + 8;

/// Why a file cannot be used.
pub enum Defect {
    /// It has this format, which is not the one wanted.
    Version(u32),
    /// It is cut short or changed; what does not fit.
    Damage(String),
}

/// Writes header and payload.
pub fn write(out: &mut dyn Write, magic: [u8; 8], version: u32, payload: &[u8]) -> io::Result<()> {
    out.write_all(&magic)?;
    out.write_all(&version.to_le_bytes())?;
    out.write_all(&crc32fast::hash(payload).to_le_bytes())?;
    out.write_all(&(payload.len() as u64).to_le_bytes())?;
    out.write_all(payload)
}

/// The payload, if the file is whole and of this kind and version.
pub fn read(bytes: &[u8], magic: [u8; 8], version: u32) -> Result<&[u8], Defect> {
    let damage = |reason: &str| Defect::Damage(reason.to_owned());
    let Some((header, payload)) = bytes.split_at_checked(HEADER) else {
        return Err(damage("it is shorter than its header"));
    };
    let (found, rest) = header.split_at(8);
    if found != magic {
        return Err(damage("it does not begin as such a file does"));
    }
    let word = |at: usize| u32::from_le_bytes(std::array::from_fn(|i| rest[at + i]));
    let (found, checksum) = (word(0), word(4));
    if found != version {
        return Err(Defect::Version(found));
    }
    let length = u64::from_le_bytes(std::array::from_fn(|i| rest[8 + i]));
    if length != payload.len() as u64 {
        return Err(Defect::Damage(format!(
            "{} bytes where {length} were written",
            payload.len()
        )));
    }
    if crc32fast::hash(payload) != checksum {
        return Err(damage("its checksum does not fit its contents"));
    }
    Ok(payload)
}
