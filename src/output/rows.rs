//! Tables whose rows are written as they are made.

use super::csv::Table;
use super::table::Column;
use std::io::{self, Write};

/// Writes a whole table of declared columns.
pub fn write_rows<T>(
    out: impl Write,
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = T>,
) -> io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|column| column.key).collect();
    let mut table = Table::new(out, &names)?;
    for row in rows {
        table.row(columns.iter().map(|column| (column.cell)(&row).csv()))?;
    }
    table.finish()
}
