//! Tables with a head of names, cells of which may be empty.

use super::error::{EMPTY, ReadError, not_a_number};
use super::separator::{character, fields, separator_of};
use super::text::{comment, lines};

/// A row of such a table.
pub(super) struct Row<'a> {
    pub line: usize,
    text: &'a str,
    cells: Vec<&'a str>,
}

impl<'a> Row<'a> {
    /// The cell of a column, if the row has one there that is not empty.
    pub fn cell(&self, column: Option<usize>) -> Option<&'a str> {
        self.cells.get(column?).copied().filter(|cell| !cell.is_empty())
    }

    /// An error at a cell.
    pub fn error(&self, cell: &str, problem: String) -> ReadError {
        ReadError::at(self.line, character(self.text, cell), problem)
    }

    /// That the row has no number in a column that needs one.
    pub fn missing(&self, name: &str) -> ReadError {
        ReadError::at(self.line, 1, not_a_number("", &format!("`{name}`")))
    }
}

/// The names of the columns, lower case, and the rows below them; comments and rows without any cell are passed over.
///
/// # Errors
/// A text without a head.
pub(super) fn headed(
    text: &str,
) -> Result<(Vec<String>, impl Iterator<Item = Row<'_>>), ReadError> {
    let blank = |c: char| c.is_whitespace() || ";,".contains(c);
    let is_content = move |line: &str| !line.trim_matches(blank).is_empty();
    let mut rows = lines(text).filter(move |(_, line)| is_content(line) && comment(line).is_none());
    let head = rows.next().ok_or_else(|| ReadError::whole(EMPTY))?;
    let separator = separator_of(&[head]);
    // Units in brackets are part of the name: `Frequency [Hz]` is frequency_hz.
    let name = |field: &str| {
        let words = field.to_lowercase().replace([')', ']'], "");
        let words = words.split([' ', '(', '[']).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join("_")
    };
    let names = fields(head.1, separator).map(name).collect();
    let row = move |(line, text)| Row { line, text, cells: fields(text, separator).collect() };
    Ok((names, rows.map(row)))
}
