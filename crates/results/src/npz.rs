//! NPZ archives: named arrays as NumPy reads them, deflated.

use frictionsim_physics::contact::ContactStatus;
use std::io::{self, Cursor, Write};
use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

/// A number that an array of NumPy can hold.
pub trait NpyNumber: Copy {
    /// NumPy's name of the little-endian type.
    const DESCRIPTION: &'static str;
    /// Appends the little-endian bytes.
    fn append(self, bytes: &mut Vec<u8>);
}

macro_rules! numbers {
    ($($kind:ty: $description:literal),+) => {$(
        impl NpyNumber for $kind {
            const DESCRIPTION: &'static str = $description;
            fn append(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        }
    )+};
}

numbers!(f64: "<f8", f32: "<f4", u8: "|u1", i64: "<i8");

/// An archive in memory; the same arrays give the same bytes.
pub struct NpzArchive {
    zip: ZipWriter<Cursor<Vec<u8>>>,
}

impl Default for NpzArchive {
    fn default() -> Self {
        Self { zip: ZipWriter::new(Cursor::new(Vec::new())) }
    }
}

impl NpzArchive {
    /// Adds an array in C order.
    pub fn array<T: NpyNumber>(
        &mut self,
        name: &str,
        shape: &[usize],
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        let mut bytes = header(T::DESCRIPTION, shape);
        values.for_each(|value| value.append(&mut bytes));
        self.entry(name, &bytes)
    }

    /// Adds a word, which NumPy reads as an array of bytes without extents.
    pub fn word(&mut self, name: &str, word: &str) -> io::Result<()> {
        let mut bytes = header(&format!("|S{}", word.len()), &[]);
        bytes.extend(word.as_bytes());
        self.entry(name, &bytes)
    }

    /// Adds what the codes of an array `status` stand for: the numbers `status_open`, `status_stick` and `status_slip`.
    pub fn status_codes(&mut self) -> io::Result<()> {
        let statuses = [ContactStatus::Open, ContactStatus::Stick, ContactStatus::Slip];
        statuses.into_iter().try_for_each(|status| {
            let name = format!("status_{}", status.name());
            self.array(&name, &[], std::iter::once(status as u8))
        })
    }

    fn entry(&mut self, name: &str, bytes: &[u8]) -> io::Result<()> {
        // No time of day: the same run writes the same bytes.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default());
        self.zip.start_file(format!("{name}.npy"), options)?;
        self.zip.write_all(bytes)
    }

    /// The bytes of the whole archive.
    pub fn finish(self) -> io::Result<Vec<u8>> {
        Ok(self.zip.finish()?.into_inner())
    }
}

/// Header of the NPY format, version 1.0: magic, length, a Python dictionary, blanks to a multiple of 64 bytes.
fn header(description: &str, shape: &[usize]) -> Vec<u8> {
    let extents: String = shape.iter().map(|extent| format!("{extent},")).collect();
    let mut text =
        format!("{{'descr': '{description}', 'fortran_order': False, 'shape': ({extents}), }}");
    let unpadded = 10 + text.len() + 1;
    text.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stored bytes: the header that `numpy.lib.format` writes for a (2, 3) array of doubles, but for a comma.
    #[test]
    fn header_is_aligned_and_names_type_and_shape() {
        let bytes = header("<f8", &[2, 3]);
        assert_eq!(bytes.len() % 64, 0);
        assert_eq!(usize::from(bytes[8]) + 256 * usize::from(bytes[9]), bytes.len() - 10);
        let text = String::from_utf8_lossy(&bytes[10..]);
        assert!(text.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2,3,), }"));
        assert!(text.ends_with('\n'));
    }
}
