//! Matrices in the Matrix Market format.

use std::io::{self, Write};
use thiserror::Error;

/// A matrix by its entries; repeated positions add up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarketMatrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// `(row, column, value)`, counted from 0.
    pub entries: Vec<(usize, usize, f64)>,
}

/// Text that is no real matrix in the Matrix Market format: the line, and what is wrong there.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct MatrixMarketError(String);

/// What an entry below the diagonal is times in the place that mirrors it; none where that has its own.
type Mirrored = Option<f64>;

const SYMMETRIES: [(&str, Mirrored); 3] =
    [("general", None), ("symmetric", Some(1.0)), ("skew-symmetric", Some(-1.0))];

/// What comes of reading a matrix.
type Result<T, E = MatrixMarketError> = std::result::Result<T, E>;

/// A line of the text, counted from 1.
#[derive(Clone, Copy)]
struct Line<'a>(usize, &'a str);

impl Line<'_> {
    fn error(self, message: impl std::fmt::Display) -> MatrixMarketError {
        MatrixMarketError(format!("line {}: {message}", self.0))
    }

    fn finite(self, word: &str) -> Result<f64> {
        let value =
            found!(word.parse::<f64>().ok(); self; "\"{}\" should be a number", begin_of(word));
        ensure!(value.is_finite(); self; "{word} is not finite");
        Ok(value)
    }
}

impl MarketMatrix {
    /// Reads `coordinate` and `array` matrices of real or integer entries, general, symmetric or skew-symmetric, of at most so
    /// many rows and columns.
    ///
    /// # Errors
    /// [`MatrixMarketError`] with the line.
    pub fn read(text: &str, most: usize) -> Result<Self> {
        let (is_coordinate, mirrored) = read_banner(text.lines().next().unwrap_or_default())?;
        let lines = (1..).zip(text.lines()).skip(1).map(|(k, line)| Line(k, line.trim()));
        let mut lines = lines.filter(|line| !line.1.is_empty() && !line.1.starts_with('%'));
        let expected = match is_coordinate {
            true => "rows, columns and number of entries",
            false => "rows and columns",
        };
        let size = lines.next().unwrap_or(Line(text.lines().count(), ""));
        let whole: Option<Vec<usize>> = size.1.split_whitespace().map(|n| n.parse().ok()).collect();
        let whole = whole.filter(|n| n.len() == 2 + usize::from(is_coordinate));
        let whole = found!(whole; size; "\"{}\" should be {expected}", begin_of(size.1));
        let (rows, columns) = (whole[0], whole[1]);
        ensure!(rows.max(columns) <= most; size;
            "a matrix of {rows} x {columns} is larger than {most} x {most}");
        let mut matrix = Self { rows, columns, entries: Vec::new() };
        // Of arrays column by column; of a symmetric one the lower triangle alone.
        let first = |column: usize| match mirrored {
            None => 0,
            Some(sign) => column + usize::from(sign < 0.0),
        };
        let places = |column: usize| (first(column)..rows).map(move |row| (row, column));
        let mut places = (0..columns).flat_map(places);
        let all = || (0..columns).map(|column| rows.saturating_sub(first(column))).sum();
        let (promised, mut found) = (whole.get(2).copied().unwrap_or_else(all), 0);
        for line in lines {
            let words: Vec<&str> = line.1.split_whitespace().collect();
            if !is_coordinate {
                for word in words {
                    let (value, place) = (line.finite(word)?, places.next());
                    place.into_iter().for_each(|place| matrix.add(place, value, mirrored));
                    found += 1;
                }
                continue;
            }
            let entry = match words[..] {
                [row, column, value] => row.parse().ok().zip(column.parse().ok()).zip(Some(value)),
                _ => None,
            };
            let ((row, column), value) = found!(entry; line;
                "\"{}\" should be a row, a column and a value", begin_of(line.1));
            let value = line.finite(value)?;
            ensure!((1..=rows).contains(&row) && (1..=columns).contains(&column); line;
                "entry ({row}, {column}) lies outside a matrix of {rows} x {columns}");
            matrix.add((row - 1, column - 1), value, mirrored);
            found += 1;
        }
        let text = || format!("the size line promises {promised} entries, the file has {found}");
        if found == promised { Ok(matrix) } else { Err(MatrixMarketError(text())) }
    }

    fn add(&mut self, (row, column): (usize, usize), value: f64, mirrored: Mirrored) {
        let mirrored = mirrored.filter(|_| row != column);
        self.entries.push((row, column, value));
        self.entries.extend(mirrored.map(|sign| (column, row, sign * value)));
    }

    /// Writes it as `coordinate real general`, every number in the shortest form that reads back as the same bits.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, comment: &str, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "%%MatrixMarket matrix coordinate real general")?;
        for line in comment.lines() {
            writeln!(out, "% {line}")?;
        }
        writeln!(out, "{} {} {}", self.rows, self.columns, self.entries.len())?;
        for (row, column, value) in &self.entries {
            writeln!(out, "{} {} {value:?}", row + 1, column + 1)?;
        }
        Ok(())
    }

    /// Row pointers, columns and values of the compressed rows, columns rising within each; repeated positions added up.
    pub fn compressed_rows(&self) -> (Vec<usize>, Vec<usize>, Vec<f64>) {
        let mut sorted = self.entries.clone();
        sorted.sort_by_key(|&(row, column, _)| (row, column));
        sorted.dedup_by(|next, sum| {
            let is_same = (next.0, next.1) == (sum.0, sum.1);
            if is_same {
                sum.2 += next.2;
            }
            is_same
        });
        let first = |row: usize| sorted.partition_point(|entry| entry.0 < row);
        let pointers = (0..=self.rows).map(first).collect();
        let (columns, values) = sorted.iter().map(|entry| (entry.1, entry.2)).unzip();
        (pointers, columns, values)
    }
}

/// Whether a matrix is given by its entries, and its symmetry.
fn read_banner(banner: &str) -> Result<(bool, Mirrored)> {
    let lower = banner.to_lowercase();
    let words: Vec<&str> = lower.split_whitespace().collect();
    let symmetry = match words[..] {
        [
            "%%matrixmarket",
            "matrix",
            "coordinate" | "array",
            "real" | "double" | "integer",
            own,
        ] => SYMMETRIES.iter().find(|known| known.0 == own),
        _ => None,
    };
    symmetry.map(|symmetry| (words[2] == "coordinate", symmetry.1)).ok_or_else(|| {
        MatrixMarketError(format!(
            "line 1 is no Matrix Market banner of a real matrix: \"{}\"; expected \
             \"%%MatrixMarket matrix coordinate real general\" (or array, integer, symmetric, \
             skew-symmetric)",
            begin_of(banner)
        ))
    })
}

/// What messages show of a text.
fn begin_of(text: &str) -> String {
    text.chars().take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_matrix_reads_back_bit_for_bit() {
        let matrix = MarketMatrix {
            rows: 3,
            columns: 2,
            entries: vec![(0, 1, 0.1), (2, 0, -1.0 / 3.0e200), (2, 1, 5e-324)],
        };
        let mut text = Vec::new();
        matrix.write("K\nN/m", &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(MarketMatrix::read(&text, 3), Ok(matrix));
    }

    #[test]
    fn triangles_and_arrays_are_completed() {
        let symmetric =
            "%%MatrixMarket matrix coordinate real symmetric\n% c\n2 2 2\n1 1 4\n2 1 -1\n";
        let read = MarketMatrix::read(symmetric, 2).unwrap();
        assert_eq!(read.entries, [(0, 0, 4.0), (1, 0, -1.0), (0, 1, -1.0)]);
        let array = "%%MatrixMarket matrix array integer skew-symmetric\n2 2\n7\n";
        let read = MarketMatrix::read(array, 2).unwrap();
        assert_eq!(read.entries, [(1, 0, 7.0), (0, 1, -7.0)]);
        assert_eq!(read.compressed_rows(), (vec![0, 1, 2], vec![1, 0], vec![-7.0, 7.0]));
    }

    #[test]
    fn what_is_no_matrix_is_refused_with_its_line() {
        let banner = "%%MatrixMarket matrix coordinate real general\n";
        for (body, message) in [
            ("2 2\n", "line 2: \"2 2\" should be rows, columns and number of entries"),
            ("2 2 1\n1 x 3\n", "line 3: \"1 x 3\" should be a row, a column and a value"),
            ("2 2 1\n1 2 nan\n", "line 3: nan is not finite"),
            ("2 2 1\n3 1 1.0\n", "line 3: entry (3, 1) lies outside a matrix of 2 x 2"),
            ("2 2 2\n1 1 1.0\n", "the size line promises 2 entries, the file has 1"),
        ] {
            let error = MarketMatrix::read(&format!("{banner}{body}"), 2).unwrap_err();
            assert_eq!(error.to_string(), message);
        }
        assert!(
            MarketMatrix::read("%%MatrixMarket matrix coordinate complex general\n", 2).is_err()
        );
    }
}
