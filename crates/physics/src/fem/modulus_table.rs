//! Modulus and loss factor over frequency, as of rubber.

use crate::linalg::c64;
use std::f64::consts::TAU;

/// Young's modulus `E(f)` and loss factor `eta(f)` of a material: the stiffness of its part at the frequency `f` is
/// `E(f) (1 + i eta(f)) / E_s` times the one that its modulus `E_s` at the lowest frequency gives. Between rows both are linear in
/// the frequency; beyond the ends the last values stand, for iterations on their way: no result is given there.
#[derive(Clone, Debug, PartialEq)]
pub struct ModulusTable {
    /// The key of the case that names its file.
    pub key: String,
    /// The file as the case names it.
    pub file: String,
    /// Frequency in Hz, modulus in Pa and loss factor of each row, the frequency rising.
    rows: Vec<[f64; 3]>,
}

impl ModulusTable {
    /// The table that the file of a key holds: rows of frequency in Hz, modulus in Pa, loss factor.
    ///
    /// # Panics
    /// Of no rows.
    pub fn new(key: &str, file: &str, rows: Vec<[f64; 3]>) -> Self {
        assert!(!rows.is_empty(), "a table has rows");
        Self { key: key.to_owned(), file: file.to_owned(), rows }
    }

    /// Lowest and highest frequency, Hz.
    pub fn range_hz(&self) -> [f64; 2] {
        [self.rows[0][0], self.rows[self.rows.len() - 1][0]]
    }

    /// Whether it holds a frequency, Hz.
    pub fn covers(&self, frequency_hz: f64) -> bool {
        let [low, high] = self.range_hz();
        (low..=high).contains(&frequency_hz)
    }

    /// Modulus of the base state: the one at the lowest frequency, Pa.
    pub fn static_modulus(&self) -> f64 {
        self.rows[0][1]
    }

    /// The frequency of the largest modulus, Hz.
    pub fn stiffest_hz(&self) -> f64 {
        let rows = self.rows.iter().copied();
        rows.reduce(|best, row| if row[1] > best[1] { row } else { best }).map_or(0.0, |row| row[0])
    }

    /// `[E, eta]` at a frequency in Hz.
    pub fn at(&self, frequency_hz: f64) -> [f64; 2] {
        let (row, share) = self.place(frequency_hz);
        let [a, b] = [self.rows[row], self.rows[(row + 1).min(self.rows.len() - 1)]];
        [1, 2].map(|k| a[k] + share * (b[k] - a[k]))
    }

    /// `E (1 + i eta) / E_s` at a frequency in Hz.
    pub fn ratio(&self, frequency_hz: f64) -> c64 {
        let [modulus, loss_factor] = self.at(frequency_hz);
        c64::new(1.0, loss_factor) * (modulus / self.static_modulus())
    }

    /// Derivative of [`Self::ratio`] by the angular frequency, s; 0 beyond the ends.
    pub fn slope(&self, frequency_hz: f64) -> c64 {
        if !self.covers(frequency_hz) || self.rows.len() < 2 {
            return c64::ZERO;
        }
        let (row, _) = self.place(frequency_hz);
        let row = row.min(self.rows.len() - 2);
        let (a, b) = (self.rows[row], self.rows[row + 1]);
        let [de, dn] = [1, 2].map(|k| (b[k] - a[k]) / (b[0] - a[0]));
        let [modulus, loss_factor] = self.at(frequency_hz);
        let change = c64::new(1.0, loss_factor) * de + c64::new(0.0, modulus * dn);
        change / (TAU * self.static_modulus())
    }

    /// The row at or below a frequency, and the share of the way to the next one.
    fn place(&self, frequency_hz: f64) -> (usize, f64) {
        let above = self.rows.partition_point(|row| row[0] <= frequency_hz);
        match above {
            0 => (0, 0.0),
            above if above == self.rows.len() => (above - 1, 0.0),
            above => {
                let (low, high) = (self.rows[above - 1][0], self.rows[above][0]);
                (above - 1, (frequency_hz - low) / (high - low))
            }
        }
    }
}

/// The step of an eigenvalue whose stiffness depends on its own frequency: `d lambda` of
///
/// ```text
/// d lambda + h Im(d lambda) = q
/// ```
///
/// where `q` is the step at fixed stiffness and `h = w^T (dK/d omega) x / w^T (2 lambda M + C) x`: an eigenvalue of tables over
/// real frequencies is no analytic function of anything, so real and imaginary part go their own ways.
pub fn own_frequency_step(q: c64, h: c64) -> c64 {
    let turned = q.im / (1.0 + h.im);
    c64::new(q.re - h.re * turned, turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rubber() -> ModulusTable {
        let rows = vec![[10.0, 2e6, 0.1], [100.0, 3e6, 0.4], [1000.0, 9e6, 0.2]];
        ModulusTable::new("materials.shim.table", "rubber.csv", rows)
    }

    #[test]
    fn values_between_rows_lie_on_the_line_and_those_beyond_are_the_last() {
        let table = rubber();
        assert_eq!(table.at(55.0), [2.5e6, 0.25]);
        assert_eq!(table.at(100.0), [3e6, 0.4]);
        assert_eq!(table.at(1.0), [2e6, 0.1]);
        assert_eq!(table.at(2000.0), [9e6, 0.2]);
        assert!(table.covers(10.0) && table.covers(1000.0) && !table.covers(1000.1));
    }

    /// Consistency check: central differences of the ratio.
    #[test]
    fn the_slope_is_the_derivative_of_the_ratio() {
        let table = rubber();
        for frequency in [20.0, 99.0, 400.0] {
            let h = 1e-4;
            let difference = (table.ratio(frequency + h) - table.ratio(frequency - h)) / (2.0 * h);
            let slope = table.slope(frequency) * TAU;
            // Round-off of the ratio over the step.
            assert!((slope - difference).norm() < 1e-9 * (1.0 + slope.norm()), "{frequency}");
        }
    }

    #[test]
    fn the_step_of_an_eigenvalue_solves_its_equation() {
        let (q, h) = (c64::new(3.0, -2.0), c64::new(0.4, 0.7));
        let step = own_frequency_step(q, h);
        assert!((step + h * step.im - q).norm() < 1e-14);
    }
}
