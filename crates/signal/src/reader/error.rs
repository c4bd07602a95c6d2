//! Errors of reading a table, with line and column.

use super::super::SignalError;

/// A table that cannot be read, with the place.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// Name of the source, as given to the reader.
    pub source_name: String,
    /// 1-based line, where one is to blame.
    pub line: Option<usize>,
    /// 1-based character in that line, where one is to blame.
    pub column: Option<usize>,
    /// What is wrong, and the remedy.
    pub problem: ReadProblem,
}

impl std::fmt::Display for ReadError {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{}", self.source_name)?;
        if let Some(line) = self.line {
            write!(out, ":{line}")?;
            if let Some(column) = self.column {
                write!(out, ":{column}")?;
            }
        }
        write!(out, ": {}", self.problem)
    }
}

impl std::error::Error for ReadError {}

impl ReadError {
    pub(super) fn whole(source_name: &str, problem: ReadProblem) -> Self {
        Self { source_name: source_name.to_string(), line: None, column: None, problem }
    }

    pub(super) fn at(source_name: &str, line: usize, column: usize, problem: ReadProblem) -> Self {
        Self {
            source_name: source_name.to_string(),
            line: Some(line),
            column: Some(column),
            problem,
        }
    }
}

/// Formats that are read, for messages.
pub(super) const FORMATS: &str = "text tables (csv, tsv, txt; ANSYS POST26 listings), universal \
    files (UFF/UNV, dataset 58 and 58b), WAV, MATLAB files up to version 7 (-v7)";

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadProblem {
    /// Nothing but blanks and comments.
    #[error("no data: the file is empty or holds only comments; export the measurement again")]
    Empty,
    /// No line consists of numbers.
    #[error(
        "no row of numbers found; rows of numbers separated by comma, semicolon, tab or blanks \
         are needed, or another supported format: {formats}",
        formats = FORMATS
    )]
    NoNumbers,
    /// A field is not a number.
    #[error("`{field}` in column {name} is not a number; remove the row or correct the value")]
    NotANumber {
        /// The field as written, shortened.
        field: String,
        /// Column name or number.
        name: String,
    },
    /// A field is NaN or infinite.
    #[error(
        "`{field}` in column {name} is not finite (or beyond 1e100); remove the row, or export without missing values"
    )]
    NotFinite {
        /// The field as written.
        field: String,
        /// Column name or number.
        name: String,
    },
    /// A number that the column cannot hold.
    #[error("`{field}` is not a valid value of column {name}; correct it, or leave the cell empty")]
    Impossible {
        /// The field as written.
        field: String,
        /// Column name.
        name: String,
    },
    /// A number with both a decimal comma and a decimal point.
    #[error(
        "`{0}` mixes comma and point; write numbers without thousands separators, as 1234.5 \
         or 1234,5"
    )]
    MixedDecimals(String),
    /// Commas may separate columns or decimals.
    #[error(
        "{found} fields separated by commas where the header names {expected}: the comma seems to \
         be both separator and decimal sign. Export with decimal points or separate by semicolons"
    )]
    AmbiguousComma {
        /// Fields in the row.
        found: usize,
        /// Columns named.
        expected: usize,
    },
    /// A row has another number of fields than the first.
    #[error("{found} fields where the rows before have {expected}; complete or remove the row")]
    FieldCount {
        /// Fields in this row.
        found: usize,
        /// Fields expected.
        expected: usize,
    },
    /// A needed column is missing.
    #[error("no column of {wanted} found (columns: {columns}); {remedy}")]
    MissingColumn {
        /// What is missing.
        wanted: &'static str,
        /// The columns found.
        columns: String,
        /// What to do.
        remedy: &'static str,
    },
    /// Not a list of modes.
    #[error(
        "{0} rows, one for each mode, are too many; is this a frequency response? `frictionsim \
         identify` finds its modes"
    )]
    TooManyModes(usize),
    /// Columns without names that could mean several things.
    #[error(
        "{count} columns without names could mean several things; add a first line such as \
         `{example}`, or give the names: --columns {example}"
    )]
    Unnamed {
        /// Number of columns.
        count: usize,
        /// A header that would do.
        example: &'static str,
    },
    /// Names given for another number of columns.
    #[error("--columns names {given} columns, the table has {found}; write `-` for one to skip")]
    ColumnCount {
        /// Names given.
        given: usize,
        /// Columns found.
        found: usize,
    },
    /// A channel that is not there.
    #[error("--channel {wanted}: the file has {found}")]
    NoChannel {
        /// As asked for.
        wanted: String,
        /// Names of those there are.
        found: String,
    },
    /// A file of a format that is recognised but not read.
    #[error("this is {0}; supported formats: {formats}", formats = FORMATS)]
    Format(&'static str),
    /// A file of a known format that is damaged or uses what is not read.
    #[error("{format}: {reason}")]
    Damaged {
        /// The format.
        format: &'static str,
        /// What is wrong, and the remedy.
        reason: String,
    },
    /// A time column that is rounded too coarsely to tell the rate.
    #[error(
        "the time column is rounded to {step} s, which hides the sampling rate (about {rate:.1} Hz); \
         give it with --rate HZ"
    )]
    RoundedTime {
        /// Smallest step in the column, s.
        step: f64,
        /// Rate from first to last sample, Hz.
        rate: f64,
    },
    /// A negative frequency.
    #[error("frequency {0} is negative; export the one-sided response")]
    NegativeFrequency(f64),
    /// One frequency, two values.
    #[error(
        "frequency {value} Hz is already in line {first_line} with another value; keep one of \
         the rows"
    )]
    DuplicateFrequency {
        /// The frequency, Hz.
        value: f64,
        /// Line of its first occurrence.
        first_line: usize,
    },
    /// A negative magnitude.
    #[error("magnitude {0} is negative; if it is in decibels, say so in the header (magnitude_db)")]
    NegativeMagnitude(f64),
    /// Time does not advance.
    #[error("time {value} s does not follow the {previous} s before it; sort the rows by time")]
    TimeOrder {
        /// The value, s.
        value: f64,
        /// The one before, s.
        previous: f64,
    },
    /// Samples are missing or not equidistant.
    #[error(
        "time {value} s is not on the grid of {step} s that the other rows have. Resample to equal \
         steps, or cut the record at the gap"
    )]
    TimeGap {
        /// The value, s.
        value: f64,
        /// Regular step, s.
        step: f64,
    },
    /// Neither a time column nor a rate.
    #[error(
        "no time column and no sampling rate; give --rate HZ, or a first line that names a `time_s` \
         column"
    )]
    NoRate,
    /// A rate that contradicts the time column.
    #[error("the time column says {column} Hz, the option {option} Hz; leave --rate out")]
    RateContradiction {
        /// From the column, Hz.
        column: f64,
        /// From the option, Hz.
        option: f64,
    },
    /// A sampling rate that is not positive.
    #[error("sampling rate {0} Hz must be positive and finite")]
    Rate(f64),
    /// The numbers are readable, but no signal.
    #[error("{0}")]
    Signal(#[from] SignalError),
}

impl ReadProblem {
    /// Why a field is no number.
    pub(super) fn unreadable(field: &str, name: String) -> Self {
        let field = super::text::shortened(field);
        if field.contains(',') && field.contains('.') {
            ReadProblem::MixedDecimals(field)
        } else {
            ReadProblem::NotANumber { field, name }
        }
    }
}
