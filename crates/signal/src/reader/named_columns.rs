//! Columns of a table that is known by their names.

use super::error::{ReadError, missing_column};
use super::table::{Table, read_table};

/// What a column is called here, and what its name may begin with; a single letter is the whole name.
pub(super) type Wanted = (&'static str, &'static [&'static str]);

/// A kind of table that is known by the names of its columns.
pub(super) struct Kind<const N: usize> {
    pub columns: [Wanted; N],
    /// What to write above the numbers.
    pub header: &'static str,
    /// The units that the numbers are in, and what to do where they are not.
    pub units: (&'static str, &'static str),
    /// Whether a name says another unit.
    pub is_other: fn(&str) -> bool,
}

impl<const N: usize> Kind<N> {
    /// The rows of such a table, each with its line; without names, as many columns in their order.
    pub fn read(&self, bytes: &[u8], source: &str) -> Result<Vec<(usize, [f64; N])>, ReadError> {
        let table = read_table(bytes, source, &[])?;
        if table.names.iter().any(|name| (self.is_other)(name)) {
            return Err(table.missing(self.units.0, self.units.1));
        }
        let places = self.places(&table)?;
        let numbers = |row: usize| places.map(|place| table.columns[place].real[row]);
        Ok((0..table.rows()).map(|row| (table.line(row), numbers(row))).collect())
    }

    /// Where the columns are.
    fn places(&self, table: &Table) -> Result<[usize; N], ReadError> {
        let mut places = std::array::from_fn(|k| k);
        if table.names.is_empty() {
            let wanted = "as many columns as there are names";
            return match table.columns.len() == N {
                true => Ok(places),
                false => Err(table.missing(wanted, self.header)),
            };
        }
        for (place, (wanted, begins)) in places.iter_mut().zip(&self.columns) {
            let is_it = |name: &String| {
                let short = |begin: &&str| match begin.len() {
                    1 => name == *begin,
                    _ => name.starts_with(*begin),
                };
                begins.iter().any(short)
            };
            let found = table.names.iter().position(is_it);
            *place = found.ok_or_else(|| table.missing(wanted, self.header))?;
        }
        Ok(places)
    }
}

impl Table {
    /// That it lacks a column.
    pub(super) fn missing(&self, wanted: &str, remedy: &str) -> ReadError {
        ReadError::whole(&self.source, missing_column(wanted, &self.described(), remedy))
    }
}
