//! Projection of one coefficient matrix on a growing basis.

use crate::linalg::MatrixPolynomial;
use crate::linalg::dense::{join_columns, product, transpose_product};
use crate::linalg::{Mat, MatRef};

/// One coefficient `P` of a matrix polynomial, over the unknowns that it touches.
pub struct Term {
    matrix: MatrixPolynomial,
    /// Its nonzeros by rows.
    sorted: Vec<f64>,
    /// The unknowns, where they are not all.
    support: Option<Vec<usize>>,
    /// Rows of `V` of these unknowns.
    restricted: Mat<f64>,
    is_symmetric: bool,
}

impl Term {
    /// The coefficient of `mu^power` of `polynomial`.
    pub fn new(polynomial: &MatrixPolynomial, power: usize, is_symmetric: bool) -> Self {
        let (matrix, unknowns) = polynomial.compact_coefficient(power);
        let support = (unknowns.len() < polynomial.dimension()).then_some(unknowns);
        let rows = support.as_ref().map_or(0, Vec::len);
        let sorted = matrix.pattern().by_rows(&matrix.coefficients()[0]);
        Self { matrix, sorted, support, restricted: Mat::zeros(rows, 0), is_symmetric }
    }

    /// `V^T P V` with the rows and columns of `new` basis vectors added.
    pub fn grow(&mut self, known: &Mat<f64>, basis: MatRef<'_, f64>, new: &Mat<f64>) -> Mat<f64> {
        let Some(support) = &self.support else {
            return self.grown(known, basis, new.as_ref());
        };
        let rows = Mat::from_fn(support.len(), new.ncols(), |i, j| new[(support[i], j)]);
        let grown = self.grown(known, self.restricted.as_ref(), rows.as_ref());
        self.restricted = join_columns(self.restricted.as_ref(), rows.as_ref());
        grown
    }

    fn grown(&self, known: &Mat<f64>, basis: MatRef<'_, f64>, new: MatRef<'_, f64>) -> Mat<f64> {
        let (pattern, values) = (self.matrix.pattern(), &self.matrix.coefficients()[0]);
        let (old, total) = (known.ncols(), known.ncols() + new.ncols());
        let [image] = pattern.multiply_sorted([&self.sorted], new);
        let above = transpose_product(basis, image.as_ref());
        let below = if self.is_symmetric {
            above.transpose().to_owned()
        } else {
            transpose_product(pattern.multiply_transpose(values, new).as_ref(), basis)
        };
        let mut grown = Mat::zeros(total, total);
        grown.get_mut(..old, ..old).copy_from(known);
        grown.get_mut(..old, old..).copy_from(&above);
        grown.get_mut(old.., ..old).copy_from(&below);
        grown.get_mut(old.., old..).copy_from(&transpose_product(new, image.as_ref()));
        grown
    }

    /// Restricts the basis to the span of the orthonormal `columns` of coordinates.
    pub fn compress(&mut self, columns: &Mat<f64>) {
        if self.support.is_some() {
            self.restricted = product(self.restricted.as_ref(), columns.as_ref());
        }
    }
}
