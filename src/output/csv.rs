//! Comma-separated tables.

use std::borrow::Cow;
use std::io::{self, Write};

/// A number in the shortest form that reads back as the same bits; empty if it is not finite, 0.0 for -0.0.
pub fn format_number(value: f64) -> String {
    if value.is_finite() { format!("{:?}", value + 0.0) } else { String::new() }
}

/// A cell that no spreadsheet takes for a formula: one that begins like one, and is no number, stands behind an
/// apostrophe.
fn tamed(cell: &[u8]) -> Cow<'_, [u8]> {
    let is_formula = match cell {
        [b'=' | b'@' | b'\t' | b'\r', ..] => true,
        [b'+' | b'-', next, ..] => !next.is_ascii_digit() && *next != b'.',
        _ => false,
    };
    if is_formula { [b"'", cell].concat().into() } else { cell.into() }
}

/// Writes a table row by row: a header of column names, then records.
pub struct Table<W: Write> {
    writer: csv::Writer<W>,
}

impl<W: Write> Table<W> {
    /// Starts a table with its column names.
    pub fn new(out: W, columns: &[&str]) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(columns.iter().map(|name| tamed(name.as_bytes())))?;
        Ok(Self { writer })
    }

    /// Writes one row of cells.
    ///
    /// # Errors
    /// Those of the writer; a row of another length than the header.
    pub fn row<I, S>(&mut self, cells: I) -> io::Result<()>
    where
        I: IntoIterator<Item = S>,
        S: AsRef<[u8]>,
    {
        for cell in cells {
            self.writer.write_field(tamed(cell.as_ref()))?;
        }
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    /// Ends the table.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_numbers_read_back_bit_for_bit() {
        for value in [0.1 + 0.2, 1.0, 5e-324, f64::MAX, 1.0 / 3.0, 1e-7] {
            let read: f64 = format_number(value).parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits());
        }
        assert_eq!(format_number(f64::NAN), "");
        assert_eq!(format_number(-0.0), "0.0");
    }

    #[test]
    fn no_cell_is_a_formula_and_every_number_stays_one() {
        let mut out = Vec::new();
        let mut table = Table::new(&mut out, &["=cmd|' /C calc'!A0", "b"]).unwrap();
        table.row(["@SUM(1)", "-1.5"]).unwrap();
        table.row(["-cmd", "+.5"]).unwrap();
        table.finish().unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text, "'=cmd|' /C calc'!A0,b\n'@SUM(1),-1.5\n'-cmd,+.5\n");
    }

    #[test]
    fn a_row_of_the_wrong_length_is_an_error() {
        let mut table = Table::new(Vec::new(), &["a", "b"]).unwrap();
        assert!(table.row(["1"]).is_err());
    }
}
