//! Tables whose rows are written as they are made.

use super::csv::Table;
use super::table::Cell;
use std::io::{self, Write};

/// A column whose rows are not of one kind: its name, and its cell of a row.
pub type Column<'a, T> = (&'a str, &'a dyn Fn(&T) -> Cell);

/// Writes a whole table of declared columns.
///
/// # Errors
/// Those of the writer.
pub fn write_rows<T>(
    out: impl Write,
    columns: &[Column<'_, T>],
    rows: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|column| column.0).collect();
    let mut table = Table::new(out, &names)?;
    for row in rows {
        table.row(columns.iter().map(|column| (column.1)(&row).csv()))?;
    }
    table.finish()
}
