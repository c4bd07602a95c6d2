//! Text tables of measured data, read where their meaning is clear.
//!
//! Understood without being told: separators `,` `;` tab and blanks; decimal commas (where the
//! separator is another one); Windows and old Macintosh line ends; byte-order marks, UTF-8, UTF-16
//! and Latin-1; lines of comment (`#`, `%`, `//`, `!`, `*`); titles above the header; a row of units
//! beneath it; quoted names; frequencies out of order. Everything else is a [`ReadError`] with the
//! name of the source, line, column and what to do. The reader never touches a file: it is given
//! bytes and the name to use in messages.

mod error;
mod response;
mod table;
mod text;
mod time_signal;
mod units;

pub use error::{ReadError, ReadProblem};
pub use response::{ResponseFile, read_response};
pub use time_signal::{Channel, SignalFile, read_signal};
