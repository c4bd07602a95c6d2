//! Files of measured data, read where their meaning is clear.
//!
//! Text tables, understood without being told: separators `,` `;` tab and blanks; decimal commas (where the separator
//! is another one). Windows and old Macintosh line ends; byte-order marks, UTF-8, UTF-16 and Latin-1. Lines of comment
//! (`#`, `%`, `//`, `!`, `*`), titles above the header, a row of units beneath it. Quoted names; complex numbers
//! (`0.1+0.2j`); time stamps; frequencies out of order; listings of ANSYS POST26. Universal files (datasets 58 and
//! 58b), WAV and MATLAB files up to version 7 are told by their first bytes. Everything else is a [`ReadError`] with
//! the name of the source, line, column and what to do. The reader never touches a file: it is given bytes and the name
//! to use in messages.

mod columns;
mod error;
mod field;
mod headed;
mod mat;
mod modes;
mod named_columns;
mod response;
mod separator;
mod shapes;
mod table;
mod text;
mod time_signal;
mod uff;
mod uff_writing;
mod units;
mod wav;

pub use error::ReadError;
pub use modes::{MeasuredMode, read_modes};
pub use named_columns::{ModulusRow, read_gaps, read_moduli};
pub use response::{NamedResponse, ResponseFile, ResponseOptions, read_response};
pub use shapes::{MeasuredShape, read_shapes};
pub use time_signal::{Channel, SignalFile, SignalOptions, read_signal};
pub use uff_writing::{Place, write_mesh, write_mode, write_response, write_signal};
pub use wav::{slowdown, write_wav};

use table::{Table, read_table};

/// Kind of a file, from its first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Text,
    Universal,
    Wave,
    Matlab,
    /// One that is not read.
    Foreign(&'static str),
}

/// First bytes of files that are not read, and what these are.
const FOREIGN: [(&[u8], &str); 7] = [
    (b"\x89HDF", HDF5),
    (b"PK\x03\x04", "a ZIP archive, such as xlsx, ods or npz (export it as CSV)"),
    (b"\xd0\xcf\x11\xe0", "an old Excel workbook (export it as CSV)"),
    (b"%PDF", "a PDF document"),
    (b"\x93NUMPY", "a NumPy array (numpy.savetxt writes text)"),
    (b"$MeshFormat", "a Gmsh mesh, not a measurement"),
    (b"TDSm", "a LabVIEW TDMS file"),
];
const HDF5: &str = "an HDF5 file (MATLAB writes it as version 7.3)";

impl Format {
    fn of(bytes: &[u8]) -> Self {
        let begins = |mark: &[u8]| bytes.starts_with(mark);
        let begin = bytes.iter().position(|b| !b.is_ascii_whitespace());
        let dash = begin.map_or(&[][..], |at| &bytes[at..]);
        if begins(b"RIFF") && bytes.get(8..12) == Some(b"WAVE") {
            Format::Wave
        } else if bytes.get(126..128).is_some_and(|mark| mark == b"IM" || mark == b"MI") {
            Format::Matlab
        } else if begins(b"MATLAB 7.3") && bytes.len() > 512 {
            Format::Foreign(HDF5)
        } else if let Some((_, found)) = FOREIGN.iter().find(|(mark, _)| begins(mark)) {
            Format::Foreign(found)
        } else if dash.starts_with(b"-1") && uff::is_universal(dash) {
            Format::Universal
        } else {
            Format::Text
        }
    }

    /// The table that a text or a MATLAB file is; `columns` are names that take the place of the file's own.
    fn table(self, bytes: &[u8], columns: &[String]) -> Result<Table, ReadError> {
        match self {
            Format::Foreign(found) => Err(ReadError::foreign(found)),
            Format::Matlab => mat::read_table(bytes, columns),
            _ => read_table(bytes, columns),
        }
    }
}

/// Those of `all` that are wanted, by name or 1-based number; all where none is said.
fn selected<T: Clone>(
    all: Vec<T>,
    name: fn(&T) -> &str,
    wanted: &[String],
) -> Result<Vec<T>, ReadError> {
    if wanted.is_empty() {
        return Ok(all);
    }
    let one = |wanted: &String| {
        let number = wanted.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        let named = all.iter().find(|one| name(one) == wanted);
        named.or_else(|| all.get(number?)).cloned().ok_or_else(|| {
            let found = text::first_of(all.iter().map(name));
            ReadError::whole(format!("there is no channel {wanted}: the file has {found}"))
        })
    };
    wanted.iter().map(one).collect()
}
