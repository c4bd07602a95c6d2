//! Tables of modulus and loss factor over frequency.

use super::error::ReadError;
use super::named_columns::Kind;

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
    let rows = MODULI.read(bytes, source)?.into_iter();
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
