//! Files that appear under their name when they are whole.

use super::error::FolderError;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

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
pub(crate) fn write_whole(
    path: &Path,
    is_durable: bool,
    fill: Fill<'_>,
) -> Result<u32, FolderError> {
    try_write(path, is_durable, fill).map_err(|e| FolderError::io("write", path, e))
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
