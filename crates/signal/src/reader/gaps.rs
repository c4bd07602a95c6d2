//! Tables of the gap over a measured surface.

use super::error::ReadError;
use super::named_columns::Kind;

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
    let rows = GAPS.read(bytes, source)?.into_iter();
    Ok(rows.map(|(_, [x, y, z, gap])| ([x, y, z], gap)).collect())
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
}
