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

/// Writes a table: a header of column names, then a record for each row.
///
/// # Errors
/// Those of `out`; a row of another length than the header.
pub fn write<R: IntoIterator<Item: AsRef<[u8]>>>(
    out: impl Write,
    names: &[&str],
    rows: impl IntoIterator<Item = R>,
) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(names.iter().map(|name| tamed(name.as_bytes())))?;
    for row in rows {
        for cell in row {
            writer.write_field(tamed(cell.as_ref()))?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
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
        let rows = [["@SUM(1)", "-1.5"], ["-cmd", "+.5"]];
        write(&mut out, &["=cmd|' /C calc'!A0", "b"], rows).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text, "'=cmd|' /C calc'!A0,b\n'@SUM(1),-1.5\n'-cmd,+.5\n");
    }

    #[test]
    fn a_row_of_the_wrong_length_is_an_error() {
        assert!(write(Vec::new(), &["a", "b"], [["1"]]).is_err());
    }
}
