//! Bounds on what is read: the one place that every reader asks.
//!
//! A file is small or damaged until it is read. Each kind of input has [`Limits`]; a [`Budget`] counts what was taken of
//! them, over all files that belong together.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use thiserror::Error;

/// Coordinates of a mesh or of measured points at most, in any unit: beyond it volumes and stiffnesses leave the range of numbers.
pub const LARGEST_COORDINATE: f64 = 1e12;
/// Displacements of measured shapes at most, in any unit: sums of their squares stay in the range of numbers.
pub const LARGEST_DISPLACEMENT: f64 = 1e100;
/// Unknowns of a superelement at most: its problem is solved whole, by dense matrices of twice its size.
pub const SUPERELEMENT_UNKNOWNS: usize = 2000;
/// Characters of a message at most.
pub const MESSAGE: usize = 600;

/// What may be read of one kind of input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Bytes of all files together.
    pub bytes: u64,
    /// Files.
    pub files: usize,
    /// Files that include each other, one in the other, and sets that name each other.
    pub depth: usize,
    /// Lines of the text, and members of all its sets.
    pub members: usize,
}

/// Limits of one file without members.
const fn one_file(bytes: u64) -> Limits {
    Limits { bytes, files: 1, depth: 1, members: 0 }
}

/// A case.
pub const CASE: Limits = one_file(16 << 20);
/// A table beside a case.
pub const TABLE: Limits = one_file(16 << 20);
/// A matrix of a superelement: 2000 x 2000 numbers of some 25 characters, with their places.
pub const MATRIX: Limits = one_file(256 << 20);
/// A measured signal, response or shape.
pub const MEASUREMENT: Limits = one_file(1 << 30);
/// A file of results.
pub const RESULT: Limits = one_file(16 << 30);
/// A mesh with all the files that it includes. Ten million nodes in quadratic elements take 16 million lines.
pub const MESH: Limits = Limits { bytes: 1 << 30, files: 10_000, depth: 32, members: 32_000_000 };

/// Why something is not read.
#[derive(Debug, Error)]
pub enum Refusal {
    /// The system does not give it.
    #[error("{0}")]
    System(#[from] io::Error),
    /// A pipe, a device or a folder: reading it may never end.
    #[error("it is not a regular file (but a pipe, a device or a folder)")]
    NotRegular,
    /// Too many bytes.
    #[error("it is larger than {} MiB{}", most >> 20, if *is_sum { " with the files that it includes" } else { "" })]
    Bytes {
        /// Bytes at most.
        most: u64,
        /// Whether files include others.
        is_sum: bool,
    },
    /// Too many files, files in files, or members of sets, in words.
    #[error("{0}")]
    Many(String),
}

/// What was read so far of one input, against its limits.
#[derive(Clone, Debug)]
pub struct Budget {
    limits: Limits,
    bytes: u64,
    files: usize,
    members: usize,
}

impl Budget {
    /// Nothing is read yet.
    pub fn new(limits: Limits) -> Self {
        Self { limits, bytes: 0, files: 0, members: 0 }
    }

    /// The bytes of a regular file.
    ///
    /// # Errors
    /// [`Refusal`]: the file cannot be read, is none, or is more than what may be read.
    pub fn read(&mut self, path: &Path) -> Result<Vec<u8>, Refusal> {
        self.files += 1;
        if self.files > self.limits.files {
            let most = self.limits.files;
            return Err(Refusal::Many(format!("more than {most} files are included")));
        }
        // Before it is opened: a pipe without a writer keeps whoever opens it.
        if !std::fs::metadata(path)?.is_file() {
            return Err(Refusal::NotRegular);
        }
        self.read_all(File::open(path)?)
    }

    /// All bytes of a source.
    ///
    /// # Errors
    /// [`Refusal`]: an error of the system, or more than what may be read.
    pub fn read_all(&mut self, source: impl Read) -> Result<Vec<u8>, Refusal> {
        let left = self.limits.bytes - self.bytes;
        let mut bytes = Vec::new();
        source.take(left + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > left {
            let (most, is_sum) = (self.limits.bytes, self.limits.files > 1);
            return Err(Refusal::Bytes { most, is_sum });
        }
        self.bytes += bytes.len() as u64;
        Ok(bytes)
    }

    /// Takes lines or members of sets.
    ///
    /// # Errors
    /// [`Refusal::Many`].
    pub fn take_members(&mut self, count: usize) -> Result<(), Refusal> {
        self.members = self.members.saturating_add(count);
        let most = self.limits.members;
        let what = || format!("the file has more than {most} lines and members of sets");
        if self.members <= most { Ok(()) } else { Err(Refusal::Many(what())) }
    }

    /// Refuses a depth beyond the limit.
    ///
    /// # Errors
    /// [`Refusal::Many`].
    pub fn descend(&self, depth: usize, what: &str) -> Result<(), Refusal> {
        let most = self.limits.depth;
        let what = || format!("more than {most} {what} name each other");
        if depth <= most { Ok(()) } else { Err(Refusal::Many(what())) }
    }
}

/// The bytes of one regular file.
///
/// # Errors
/// [`Refusal`].
pub fn read(path: &Path, limits: Limits) -> Result<Vec<u8>, Refusal> {
    Budget::new(limits).read(path)
}

/// As [`read`], with the kind of the system's error, for readers to which a file that is missing is none.
///
/// # Errors
/// Those of the system; [`io::ErrorKind::InvalidInput`] for what is not read.
pub fn read_file(path: &Path, limits: Limits) -> io::Result<Vec<u8>> {
    read(path, limits).map_err(|refusal| match refusal {
        Refusal::System(error) => error,
        other => io::Error::new(io::ErrorKind::InvalidInput, other.to_string()),
    })
}

/// As [`read_file`], the text of a file.
///
/// # Errors
/// As [`read_file`].
pub fn read_text(path: &Path, limits: Limits) -> io::Result<String> {
    let bytes = read_file(path, limits)?;
    String::from_utf8(bytes).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

/// A text of at most so many characters.
pub fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}...", &text[..end]),
    }
}

/// The first `most` of `all`, and how many more there are: `a, b and 3 more`.
pub fn first_of<T: std::fmt::Display>(all: impl IntoIterator<Item = T>, most: usize) -> String {
    let mut rest = all.into_iter();
    let first: Vec<String> = rest.by_ref().take(most).map(|item| item.to_string()).collect();
    match rest.count() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_show_the_first_and_count_the_rest() {
        assert_eq!(first_of(["a", "b"], 2), "a, b");
        assert_eq!(first_of(1..=12, 10), "1, 2, 3, 4, 5, 6, 7, 8, 9, 10 and 2 more");
    }

    #[test]
    fn a_source_without_end_is_refused_at_the_limit() {
        let few = Limits { bytes: 3, files: 1, depth: 1, members: 2 };
        assert_eq!(Budget::new(few).read_all(&b"abc"[..]).unwrap(), b"abc");
        assert!(Budget::new(few).read_all(&b"abcd"[..]).is_err());
        assert!(Budget::new(CASE).read_all(io::repeat(b'0')).is_err());
        let mut budget = Budget::new(few);
        assert!(budget.take_members(2).is_ok() && budget.take_members(usize::MAX).is_err());
    }
}
