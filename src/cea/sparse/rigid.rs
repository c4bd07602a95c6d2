//! Rigid motions of bodies that nothing holds.

use crate::linalg::Mat;
use crate::linalg::MatrixPolynomial;
use crate::linalg::dense::{column, column_mut, dot};

/// Rigid motions `R` with `R^T M R = I`, and `M R`.
pub struct RigidMotions {
    motions: Mat<f64>,
    momenta: Mat<f64>,
}

impl RigidMotions {
    /// Those that some independent columns span.
    pub fn of(mass: &MatrixPolynomial, mut motions: Mat<f64>) -> Self {
        let values = mass.evaluate(0.0);
        let mut momenta = Mat::zeros(motions.nrows(), motions.ncols());
        // Twice is enough for orthogonality to round-off.
        for j in (0..motions.ncols()).flat_map(|j| [j, j]) {
            for i in 0..j {
                let share = dot(column(momenta.as_ref(), i), column(motions.as_ref(), j));
                let known = column(motions.as_ref(), i).to_vec();
                let own = column_mut(&mut motions, j).iter_mut();
                own.zip(known).for_each(|(own, known)| *own -= share * known);
            }
            let momentum = mass.pattern().multiply(&values, motions.get(.., j..j + 1));
            let momentum = column(momentum.as_ref(), 0).to_vec();
            let length = dot(column(motions.as_ref(), j), &momentum).sqrt();
            column_mut(&mut motions, j).iter_mut().for_each(|v| *v /= length);
            let target = column_mut(&mut momenta, j).iter_mut();
            target.zip(momentum).for_each(|(to, v)| *to = v / length);
        }
        Self { motions, momenta }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.motions.ncols()
    }

    /// Takes them out of each column.
    pub fn remove_from(&self, columns: &mut Mat<f64>) {
        for j in 0..columns.ncols() {
            for i in 0..self.count() {
                let share = dot(column(self.momenta.as_ref(), i), column(columns.as_ref(), j));
                let own = column_mut(columns, j).iter_mut();
                let known = column(self.motions.as_ref(), i);
                own.zip(known).for_each(|(own, known)| *own -= share * known);
            }
        }
    }
}
