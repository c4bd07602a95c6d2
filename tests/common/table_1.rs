//! Table 1 of the paper: eigenvalues of the disc at friction coefficient 0.3.

use std::sync::LazyLock;

/// Harmonic and branch of each row, a digit each.
///
/// They are not printed there but identified with the exact continuum model; of a pair the row with the larger real part travels backwards.
const NAMES: &str =
    "01 11 11 21 21 12 12 02 31 31 22 22 41 41 51 51 32 32 03 13 13 61 61 04 23 23 42 42";

/// Real part and frequency, Hz, as the shipped table has them, harmonic and branch of each row.
pub static TABLE_1: LazyLock<Vec<(f64, f64, usize, usize)>> = LazyLock::new(|| {
    let rows = include_str!("../../cases/table-1.csv").lines().skip(2);
    let rows = rows.zip(NAMES.split(' ')).map(|(row, name)| {
        let (real, frequency) = row.split_once(',').unwrap();
        let [harmonic, branch] = [0, 1].map(|digit| usize::from(name.as_bytes()[digit] - b'0'));
        (real.parse().unwrap(), frequency.parse().unwrap(), harmonic, branch)
    });
    rows.collect()
});
