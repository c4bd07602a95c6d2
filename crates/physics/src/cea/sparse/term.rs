//! Projection of one coefficient matrix on a growing basis.

use crate::cea::sparse::*;
use crate::linalg::dense::product;

/// One coefficient `P` of a matrix polynomial, over the unknowns that it touches.
struct Coefficient {
    matrix: MatrixPolynomial,
    /// Its nonzeros by rows.
    sorted: Vec<f64>,
    /// The unknowns, where they are not all.
    support: Option<Vec<usize>>,
    is_symmetric: bool,
}

/// A coefficient and its projection.
pub struct Term {
    coefficient: Arc<Coefficient>,
    /// Rows of `V` of the unknowns that it touches, where they are not all.
    restricted: Mat<f64>,
    /// `V^T P V`.
    pub projected: Mat<f64>,
}

impl Term {
    /// The coefficient of `mu^power` of `polynomial`.
    pub fn new(polynomial: &MatrixPolynomial, power: usize, is_symmetric: bool) -> Self {
        let (matrix, unknowns) = polynomial.compact_coefficient(power);
        let support = (unknowns.len() < polynomial.dimension()).then_some(unknowns);
        let rows = support.as_ref().map_or(0, Vec::len);
        let sorted = matrix.pattern().by_rows(&matrix.coefficients()[0]);
        let coefficient = Arc::new(Coefficient { matrix, sorted, support, is_symmetric });
        Self { coefficient, restricted: Mat::zeros(rows, 0), projected: Mat::zeros(0, 0) }
    }

    /// Adds the rows and columns of `new` vectors of the `basis`.
    pub fn grow(&mut self, basis: MatRef<'_, f64>, new: &Mat<f64>) {
        let Some(support) = &self.coefficient.support else {
            self.projected = self.grown(basis, new.as_ref());
            return;
        };
        let rows = Mat::from_fn(support.len(), new.ncols(), |i, j| new[(support[i], j)]);
        self.projected = self.grown(self.restricted.as_ref(), rows.as_ref());
        self.restricted = join_columns(self.restricted.as_ref(), rows.as_ref());
    }

    fn grown(&self, basis: MatRef<'_, f64>, new: MatRef<'_, f64>) -> Mat<f64> {
        let Coefficient { matrix, sorted, is_symmetric, .. } = &*self.coefficient;
        let (pattern, values, known) =
            (matrix.pattern(), &matrix.coefficients()[0], &self.projected);
        let (old, total) = (known.ncols(), known.ncols() + new.ncols());
        let [image] = pattern.multiply_sorted([sorted], new);
        let above = transpose_product(basis, image.as_ref()); // V^T P W of the new columns W.
        let below = if *is_symmetric {
            above.transpose().to_owned()
        } else {
            transpose_product(pattern.multiply_transpose(values, new).as_ref(), basis) // (P^T W)^T V = W^T P V.
        };
        let mut grown = Mat::zeros(total, total);
        grown.get_mut(..old, ..old).copy_from(known);
        grown.get_mut(..old, old..).copy_from(&above);
        grown.get_mut(old.., ..old).copy_from(&below);
        grown.get_mut(old.., old..).copy_from(&transpose_product(new, image.as_ref())); // W^T P W.
        grown
    }

    /// Restricts the basis to the span of the orthonormal `columns` of coordinates.
    pub fn compress(&mut self, columns: &Mat<f64>) {
        if self.coefficient.support.is_some() {
            self.restricted = product(self.restricted.as_ref(), columns.as_ref());
        }
        self.projected = projected(&self.projected, columns); // Q^T (V^T P V) Q.
    }

    /// The projection alone in that span, which does not grow.
    pub fn within(&self, columns: &Mat<f64>) -> Self {
        Self {
            coefficient: Arc::clone(&self.coefficient),
            restricted: Mat::zeros(0, 0),
            projected: projected(&self.projected, columns),
        }
    }
}

/// `P^T A P` of a small matrix `A` and orthonormal columns `P`.
pub fn projected(small: &Mat<f64>, columns: &Mat<f64>) -> Mat<f64> {
    let image = product(small.as_ref(), columns.as_ref());
    transpose_product(columns.as_ref(), image.as_ref())
}
