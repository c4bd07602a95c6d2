//! Columns of a table that is known by their names.

use super::error::{ReadError, missing_column};
use super::table::Table;

/// What a column is called here, and what its name may begin with; a single letter is the whole name.
pub(super) type Wanted = (&'static str, &'static [&'static str]);

impl Table {
    /// Where the wanted columns are; without names, as many columns in their order.
    pub(super) fn places<const N: usize>(
        &self,
        wanted: &[Wanted; N],
        source: &str,
        header: &'static str,
    ) -> Result<[usize; N], ReadError> {
        let mut places = std::array::from_fn(|k| k);
        if self.names.is_empty() {
            return match self.columns.len() == N {
                true => Ok(places),
                false => Err(self.missing(source, "as many columns as there are names", header)),
            };
        }
        for (place, (wanted, begins)) in places.iter_mut().zip(wanted) {
            let is_it = |name: &String| {
                let short = |begin: &&str| match begin.len() {
                    1 => name == *begin,
                    _ => name.starts_with(*begin),
                };
                begins.iter().any(short)
            };
            let found = self.names.iter().position(is_it);
            *place = found.ok_or_else(|| self.missing(source, wanted, header))?;
        }
        Ok(places)
    }

    /// That it lacks a column.
    pub(super) fn missing(&self, source: &str, wanted: &str, remedy: &str) -> ReadError {
        ReadError::whole(source, missing_column(wanted, &self.described(), remedy))
    }
}
