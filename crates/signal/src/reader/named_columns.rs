//! Tables that are known by the names of their columns: gaps over a surface, moduli over frequency.

use super::error::ReadError;
use super::table::{Table, read_table};

/// What a column is called here, and what its name may begin with; a single letter is the whole name.
type Wanted = (&'static str, &'static [&'static str]);

/// A kind of table that is known by the names of its columns.
struct Kind<const N: usize> {
    columns: [Wanted; N],
    /// What to write above the numbers.
    header: &'static str,
    /// The units that the numbers are in, and what to do where they are not.
    units: (&'static str, &'static str),
    /// Whether a name says another unit.
    is_other: fn(&str) -> bool,
}

impl<const N: usize> Kind<N> {
    /// The rows of such a table, each with its line; without names, as many columns in their order.
    fn read(&self, bytes: &[u8]) -> Result<Vec<(usize, [f64; N])>, ReadError> {
        let table = read_table(bytes, &[])?;
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
            let fits = |name: &str, begin: &str| {
                name == begin || (begin.len() > 1 && name.starts_with(begin))
            };
            let is_it = |name: &String| begins.iter().any(|begin| fits(name, begin));
            let found = table.names.iter().position(is_it);
            *place = found.ok_or_else(|| table.missing(wanted, self.header))?;
        }
        Ok(places)
    }
}

const GAPS: Kind<4> = Kind {
    columns: [("x", &["x", "x_m"]), ("y", &["y", "y_m"]), ("z", &["z", "z_m"]), ("gap", &["gap"])],
    header: "name them in the first line: x, y, z, gap, all in m",
    units: ("m", "give x, y, z and gap in m"),
    is_other: |name| {
        let mut words = name.split(|c: char| !c.is_alphanumeric());
        words.any(|word| ["mm", "cm", "um", "nm", "inch", "micron", "microns"].contains(&word))
    },
};

/// Reads a table of columns `x`, `y`, `z` and `gap`, m; without names, four columns in this order.
///
/// # Errors
/// [`ReadError`] with the place: no such column, another unit, a cell that is no number.
pub fn read_gaps(bytes: &[u8], source: &str) -> Result<Vec<([f64; 3], f64)>, ReadError> {
    let rows = GAPS.read(bytes).map_err(|error| error.of(source))?.into_iter();
    Ok(rows.map(|(_, [x, y, z, gap])| ([x, y, z], gap)).collect())
}

const MODULI: Kind<3> = Kind {
    columns: [
        ("frequency_hz", &["frequency", "f_hz", "f"]),
        ("young_modulus", &["young", "modulus", "e"]),
        ("loss_factor", &["loss", "eta", "tan"]),
    ],
    header: "name them in the first line: frequency_hz, young_modulus, loss_factor",
    units: ("Hz and Pa", "give frequencies in Hz and moduli in Pa"),
    is_other: |name| ["khz", "rad", "kpa", "mpa", "gpa"].iter().any(|unit| name.contains(unit)),
};

/// A row of a table of moduli.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModulusRow {
    /// Line of the file, from 1.
    pub line: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Young's modulus, Pa.
    pub young_modulus: f64,
    /// Loss factor.
    pub loss_factor: f64,
}

/// Reads a table of columns `frequency_hz`, `young_modulus` and `loss_factor`; without names, three columns in this
/// order.
///
/// Nothing is asked of the numbers but that they are some: what a material cannot be is the caller's to say.
///
/// # Errors
/// [`ReadError`] with the place: no such column, another unit, a cell that is no number.
pub fn read_moduli(bytes: &[u8], source: &str) -> Result<Vec<ModulusRow>, ReadError> {
    let rows = MODULI.read(bytes).map_err(|error| error.of(source))?.into_iter();
    let row = |(line, numbers): (usize, [f64; 3])| {
        let [frequency_hz, young_modulus, loss_factor] = numbers;
        ModulusRow { line, frequency_hz, young_modulus, loss_factor }
    };
    Ok(rows.map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_or_by_place_and_other_units_are_refused() {
        let named = b"gap_m;x_m;y_m;z_m\n1e-6;1;2;3\n2e-6;4;5;6\n";
        let plain = b"# pad\n1 2 3 1e-6\n4 5 6 2e-6\n";
        let rows = [([1.0, 2.0, 3.0], 1e-6), ([4.0, 5.0, 6.0], 2e-6)];
        assert_eq!(read_gaps(named, "a.csv").unwrap(), rows);
        assert_eq!(read_gaps(plain, "b.csv").unwrap(), rows);
        for (text, expected) in [
            ("x,y,z,gap_um\n1,2,3,4\n", "in m"),
            ("x,y,z\n1,2,3\n", "gap"),
            ("1 2 3\n4 5 6\n", "gap"),
        ] {
            let error = read_gaps(text.as_bytes(), "g.csv").unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn columns_are_found_by_name_in_any_order_and_by_place_without_names() {
        let named = b"loss_factor;frequency_hz;young_modulus\n0,1;10;2e6\n0,2;100;3e6\n";
        let plain = b"# rubber\n10 2e6 0.1\n100 3e6 0.2\n";
        let (a, b) = (read_moduli(named, "a.csv").unwrap(), read_moduli(plain, "b.csv").unwrap());
        let numbers = |rows: &[ModulusRow]| -> Vec<[f64; 3]> {
            let rows = rows.iter();
            rows.map(|r| [r.frequency_hz, r.young_modulus, r.loss_factor]).collect()
        };
        assert_eq!(numbers(&a), [[10.0, 2e6, 0.1], [100.0, 3e6, 0.2]]);
        assert_eq!(numbers(&a), numbers(&b));
        assert_eq!(b[1].line, 3);
    }

    #[test]
    fn another_unit_and_a_missing_column_are_refused() {
        for (text, expected) in [
            ("frequency_hz,young_modulus_mpa,loss_factor\n1,2,0.1\n", "Hz and Pa"),
            ("frequency_hz,young_modulus\n1,2\n", "loss_factor"),
        ] {
            let error = read_moduli(text.as_bytes(), "t.csv").unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
