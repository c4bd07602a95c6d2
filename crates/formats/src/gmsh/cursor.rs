//! Numbers of a mesh file, from text or from bytes.

use crate::prelude::*;
/// A position in the bytes of a file, with what it takes to name it.
#[derive(Default)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    /// Whether numbers are bytes rather than text.
    pub is_binary: bool,
    /// Whether numbers have the other byte order than this machine.
    pub is_swapped: bool,
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, line: 1, ..Self::default() }
    }

    /// An error here.
    pub fn error(&self, message: impl Into<String>) -> MeshFileError {
        let place = match self.is_binary {
            true => format!("byte {}", self.at),
            false => format!("line {}", self.line),
        };
        MeshFileError { place, message: shortened(&message.into(), MESSAGE) }
    }

    /// Bytes that are left.
    pub fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Refuses a file that ends here.
    pub fn refuse_end(&self) -> Result<()> {
        ensure!(!self.bytes[self.at..].iter().all(u8::is_ascii_whitespace); self;
            "the file ends here: it is truncated. meshio leaves such files when it cannot write MSH 4.1 for want of \
             entities: use file_format=\"gmsh22\"");
        Ok(())
    }

    /// A count of things that take at least `smallest` bytes each: more than the file can hold is an error, so
    /// that nothing is reserved for what is not there.
    pub fn count(&mut self, what: &str, smallest: usize) -> Result<usize> {
        let count = self.size(what)?;
        ensure!(count <= self.remaining() / smallest; self;
            "{count} {what} are announced, which the rest of the file cannot hold: the file is truncated or damaged");
        Ok(count)
    }

    /// The rest of the line, without its end.
    pub fn text_line(&mut self) -> Option<String> {
        if self.at >= self.bytes.len() {
            return None;
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        self.line += 1;
        Some(String::from_utf8_lossy(&rest[..length]).trim().to_owned())
    }

    /// The next section name, without its `$`; text between sections is passed over.
    pub fn section(&mut self) -> Option<String> {
        loop {
            if let Some(name) = self.text_line()?.strip_prefix('$') {
                return Some(name.to_owned());
            }
        }
    }

    /// Passes over a section that is not read.
    pub fn skip_section(&mut self, name: &str) -> Result<()> {
        let (rest, end) = (&self.bytes[self.at..], format!("$End{name}"));
        let found = rest.windows(end.len()).position(|window| window == end.as_bytes());
        let offset = found!(found; self; "section ${name} has no {end}: the file is truncated");
        self.line += rest[..offset].iter().filter(|&&b| b == b'\n').count();
        self.at += offset;
        self.text_line();
        Ok(())
    }

    /// Checks the end of a section that was read.
    pub fn end(&mut self, name: &str) -> Result<()> {
        let expected = format!("$End{name}");
        loop {
            let line =
                found!(self.text_line(); self; "{expected} is missing: the file is truncated");
            if line == expected {
                return Ok(());
            }
            ensure!(line.is_empty(); self; "{expected} expected, found {}", quoted(&line));
        }
    }

    fn word(&mut self, what: &str) -> Result<&'a str> {
        while let Some(byte) = self.bytes.get(self.at).filter(|b| b.is_ascii_whitespace()) {
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let word = std::str::from_utf8(&rest[..length]).ok().filter(|word| !word.is_empty());
        let word = found!(word; self; "{what} expected: the file is truncated or damaged");
        ensure!(!word.starts_with('$'); self; "{what} expected, found {word}: the section is too short");
        self.at += length;
        Ok(word)
    }

    /// A number of so many bytes, or of a word.
    fn value<T: std::str::FromStr, const N: usize>(
        &mut self,
        what: &str,
        of_bytes: fn([u8; N]) -> T,
    ) -> Result<T> {
        if !self.is_binary {
            let word = self.word(what)?;
            return Ok(found!(word.parse().ok(); self; "{what} expected, found {}", quoted(word)));
        }
        let found = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk().copied());
        let mut bytes: [u8; N] = found!(found; self; "{what} expected: the file is truncated");
        self.at += N;
        if self.is_swapped {
            bytes.reverse();
        }
        Ok(of_bytes(bytes))
    }

    /// An integer of 32 bits.
    pub fn int(&mut self, what: &str) -> Result<i64> {
        self.value(what, |bytes| i64::from(i32::from_le_bytes(bytes)))
    }

    /// So many of them.
    pub fn ints(&mut self, count: usize, what: &str) -> Result<Vec<i64>> {
        (0..count).map(|_| self.int(what)).collect()
    }

    /// A count or a tag of 64 bits.
    pub fn size(&mut self, what: &str) -> Result<usize> {
        let value = self.value(what, u64::from_le_bytes)?;
        Ok(found!(usize::try_from(value).ok(); self; "{what} {value} is too large"))
    }

    /// So many of them.
    pub fn sizes(&mut self, count: usize, what: &str) -> Result<Vec<usize>> {
        (0..count).map(|_| self.size(what)).collect()
    }

    /// A count that MSH 2.2 writes as text even in binary files.
    pub fn text_count(&mut self, what: &str, smallest: usize) -> Result<usize> {
        let is_binary = std::mem::replace(&mut self.is_binary, false);
        let count = self.count(what, smallest);
        if is_binary && count.is_ok() {
            self.text_line();
        }
        self.is_binary = is_binary;
        count
    }

    /// A finite coordinate.
    pub fn number(&mut self, what: &str) -> Result<f64> {
        let value = self.value(what, f64::from_le_bytes)?;
        ensure!(value.is_finite(); self; "{what} {value} is not finite");
        Ok(value)
    }
}
