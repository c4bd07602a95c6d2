//! The numbers of one column of a table.

use super::field::Value;

/// Largest magnitude of a measured number.
const LARGEST: f64 = 1e100;

/// Numbers of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Column {
    /// Values, or their real parts; seconds of time stamps since the first.
    pub real: Vec<f64>,
    /// Imaginary parts of a column of complex numbers.
    pub imaginary: Option<Vec<f64>>,
    /// Whether it holds time stamps.
    pub is_time: bool,
}

impl Column {
    /// Takes the next value; `first_day` is the day of the first time stamp of the table. Whether it is finite.
    pub(super) fn push(&mut self, value: Value, first_day: &mut Option<i64>) -> bool {
        let (real, imaginary) = match value {
            Value::Real(value) => (value, 0.0),
            Value::Complex(re, im) => {
                // The rows before were real.
                let rows = self.real.len();
                self.imaginary.get_or_insert_with(|| vec![0.0; rows]);
                (re, im)
            }
            Value::Time(day, seconds) => {
                self.is_time = true;
                // A time of day alone has day 0.
                let days = match day {
                    0 => 0,
                    _ => day - *first_day.get_or_insert(day),
                };
                (86_400.0 * days as f64 + seconds, 0.0)
            }
        };
        self.real.push(real);
        if let Some(parts) = &mut self.imaginary {
            parts.push(imaginary);
        }
        // Squares and sums of squares of samples must be finite, too.
        real.abs() <= LARGEST && imaginary.abs() <= LARGEST
    }
}
