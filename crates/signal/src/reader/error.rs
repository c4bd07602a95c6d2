//! Why a measurement cannot be read, with line and column.

use super::text::shortened;
use std::fmt::Display;

/// A measurement that cannot be read, with the place.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// Name of the source, as given to the reader.
    pub source_name: String,
    /// Line and character in it, from 1, where one is to blame.
    pub place: Option<(usize, usize)>,
    /// What is wrong, and the remedy.
    pub problem: String,
}

impl Display for ReadError {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let place = self.place.map_or(String::new(), |(line, column)| format!(":{line}:{column}"));
        write!(out, "{}{place}: {}", self.source_name, self.problem)
    }
}

impl std::error::Error for ReadError {}

impl ReadError {
    /// Of the file as a whole, which [`Self::of`] names.
    pub(super) fn whole(problem: impl Display) -> Self {
        Self { source_name: String::new(), place: None, problem: problem.to_string() }
    }

    /// Of a place in it.
    pub(super) fn at(line: usize, column: usize, problem: impl Display) -> Self {
        Self { place: Some((line, column)), ..Self::whole(problem) }
    }

    /// The same under the name of the source.
    pub(super) fn of(self, source_name: &str) -> Self {
        Self { source_name: source_name.to_owned(), ..self }
    }

    /// A file of a known format that is damaged or uses what is not read.
    pub(super) fn damaged(format: &str, reason: impl Display) -> Self {
        Self::whole(format!("{format}: {reason}"))
    }

    /// A file of a format that is recognised but not read.
    pub(super) fn foreign(found: &str) -> Self {
        Self::whole(format!("this is {found}; supported formats: {FORMATS}"))
    }

    /// A needed column that is not among those found.
    pub(super) fn missing(wanted: &str, columns: &str, remedy: &str) -> Self {
        Self::whole(format!("no column of {wanted} found (columns: {columns}); {remedy}"))
    }

    /// No line consists of numbers.
    pub(super) fn no_numbers() -> Self {
        let needed = "rows of numbers separated by comma, semicolon, tab or blanks are needed, or \
             another supported format";
        Self::whole(format!("no row of numbers found; {needed}: {FORMATS}"))
    }
}

/// Formats that are read, for messages.
const FORMATS: &str = "text tables (csv, tsv, txt; ANSYS POST26 listings), universal \
    files (UFF/UNV, dataset 58 and 58b), WAV, MATLAB files up to version 7 (-v7)";

/// Nothing but blanks and comments.
pub(super) const EMPTY: &str =
    "no data: the file is empty or holds only comments; export the measurement again";

/// Neither a time column nor a rate.
pub(super) const NO_RATE: &str = "no time column and no sampling rate; give --rate HZ, or a first \
    line that names a `time_s` column";

/// A field in a column, by name or number, that is no number.
pub(super) fn not_a_number(field: &str, name: &str) -> String {
    format!("`{field}` in column {name} is not a number; remove the row or correct the value")
}

/// A field that is NaN, infinite or too large.
pub(super) fn not_finite(field: &str, name: &str) -> String {
    format!(
        "`{field}` in column {name} is not finite (or beyond 1e100); remove the row, or export without missing values"
    )
}

/// Why a field is no number.
pub(super) fn unreadable(field: &str, name: &str) -> String {
    let field = shortened(field);
    if field.contains(',') && field.contains('.') {
        return format!(
            "`{field}` mixes comma and point; write numbers without thousands separators, as 1234.5 or 1234,5"
        );
    }
    not_a_number(&field, name)
}
