//! Limits of the system and of this program on files: how large they may become, how much of one is read.

use super::Failure;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest case file, bytes.
pub const LARGEST_CASE: u64 = 16 << 20;
/// Largest measurement or table, bytes.
pub const LARGEST_MEASUREMENT: u64 = 1 << 30;

/// Makes a write beyond the file size limit of the shell (`ulimit -f`) an error, as on a full disk, where the signal of
/// it would end the process without a word.
pub fn refuse_writes_beyond_limit() {
    #[cfg(unix)]
    {
        let noticed = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        // Without the handler such a write ends the process, which is no reason not to begin.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, noticed);
    }
}

/// The name that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Reads a file or standard input of at most `most` bytes.
///
/// # Errors
/// [`Failure::Usage`] with the file's name: it cannot be read, or has no end within the limit.
pub fn read_input(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let read = match path == Path::new(STANDARD_INPUT) {
        true => read_at_most(io::stdin().lock(), most),
        false => File::open(path).and_then(|file| read_at_most(file, most)),
    };
    let name = input_name(path);
    match read {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err(Failure::usage(format!(
            "{name} is larger than {} MiB, the limit for such files",
            most >> 20
        ))),
        Err(error) => Err(Failure::usage(format!("cannot read {name}: {error}"))),
    }
}

/// All bytes of a source; `None` if there are more than `most`.
fn read_at_most(source: impl Read, most: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= most).then_some(bytes))
}

/// What an input is called in messages.
pub fn input_name(path: &Path) -> String {
    if path == Path::new(STANDARD_INPUT) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_without_end_are_refused_at_the_limit() {
        assert_eq!(read_at_most(&b"abc"[..], 3).unwrap().unwrap(), b"abc");
        assert!(read_at_most(&b"abcd"[..], 3).unwrap().is_none());
        assert!(read_at_most(io::repeat(b'0'), 1 << 20).unwrap().is_none());
    }
}
