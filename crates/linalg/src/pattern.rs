//! Positions of the nonzeros of sparse matrices.

use super::LinalgError;
use super::dissection::nested_dissection;
use faer::Side;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::utils::{transpose, transpose_scratch};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use std::sync::{Arc, OnceLock};

/// Entries of factors from which on nested dissection is tried. At ten million it saves what it takes, at two hundred a third of them.
const LARGE: usize = 2_000_000;

/// Structural positions of the nonzeros of a square sparse matrix, column by column.
///
/// Rows are strictly increasing within each column. Several matrices share one pattern through
/// [`std::sync::Arc`], so that one symbolic factorization serves all of them and all their combinations.
#[derive(Clone, Debug)]
pub struct SparsityPattern {
    symbolic: SymbolicSparseColMat<usize>,
    /// The same nonzeros row by row, columns ascending within a row: start of each row in the two below.
    row_pointers: Vec<usize>,
    /// Index among the nonzeros.
    row_positions: Vec<u32>,
    row_columns: Vec<u32>,
    /// Structure of factors, made for the first ones.
    factors: OnceLock<Result<Arc<SymbolicCholesky<usize>>, LinalgError>>,
}

impl SparsityPattern {
    /// Pattern of a `dimension x dimension` matrix from `(row, column)` positions in any order, repeated or not.
    ///
    /// # Panics
    /// If a position lies outside the matrix, or there are more than `u32::MAX` nonzeros.
    pub fn from_positions(
        dimension: usize,
        positions: impl IntoIterator<Item = (usize, usize)>,
    ) -> Self {
        let mut columns: Vec<Vec<usize>> = vec![Vec::new(); dimension];
        for (row, column) in positions {
            assert!(row < dimension, "row {row} outside a matrix of {dimension}");
            columns[column].push(row);
        }
        let mut column_pointers = Vec::with_capacity(dimension + 1);
        column_pointers.push(0);
        let mut row_indices = Vec::new();
        for rows in &mut columns {
            rows.sort_unstable();
            rows.dedup();
            row_indices.extend_from_slice(rows);
            column_pointers.push(row_indices.len());
        }
        let symbolic = SymbolicSparseColMat::new_checked(
            dimension,
            dimension,
            column_pointers,
            None,
            row_indices,
        );
        let (row_pointers, row_positions, row_columns) = by_rows(&symbolic);
        let factors = OnceLock::new();
        Self { symbolic, row_pointers, row_positions, row_columns, factors }
    }

    /// Number of rows and of columns.
    #[inline]
    pub fn dimension(&self) -> usize {
        self.symbolic.ncols()
    }

    /// Number of structural nonzeros.
    #[inline]
    pub fn nonzero_count(&self) -> usize {
        self.symbolic.row_idx().len()
    }

    /// Start of each column in [`Self::row_indices`], `dimension + 1` values.
    #[inline]
    pub fn column_pointers(&self) -> &[usize] {
        self.symbolic.col_ptr()
    }

    /// Row of each nonzero.
    #[inline]
    pub fn row_indices(&self) -> &[usize] {
        self.symbolic.row_idx()
    }

    /// The nonzeros of one column: `(index among the nonzeros, row)`.
    #[inline]
    pub fn column(&self, column: usize) -> impl Iterator<Item = (usize, usize)> {
        let range = self.column_pointers()[column]..self.column_pointers()[column + 1];
        range.map(|position| (position, self.row_indices()[position]))
    }

    /// All nonzeros: `(index among the nonzeros, row, column)`.
    #[inline]
    pub fn nonzeros(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let columns = 0..self.dimension();
        columns.flat_map(|j| self.column(j).map(move |(position, i)| (position, i, j)))
    }

    /// The nonzeros of one row: `(index among the nonzeros, column)`.
    #[inline]
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        let range = self.row_range(row);
        let (positions, columns) = (&self.row_positions[range.clone()], &self.row_columns[range]);
        let pairs = positions.iter().zip(columns);
        pairs.map(|(&position, &column)| (position as usize, column as usize))
    }

    /// Where a row is among nonzeros sorted by rows.
    #[inline]
    pub fn row_range(&self, row: usize) -> std::ops::Range<usize> {
        self.row_pointers[row]..self.row_pointers[row + 1]
    }

    /// Column of each nonzero, sorted by rows.
    #[inline]
    pub(super) fn row_columns(&self) -> &[u32] {
        &self.row_columns
    }

    /// Values sorted by rows.
    pub fn by_rows(&self, values: &[f64]) -> Vec<f64> {
        let positions = self.row_positions.iter();
        positions.map(|&position| values[position as usize]).collect()
    }

    /// Whether every nonzero has one opposite.
    pub(super) fn is_symmetric(&self) -> bool {
        let is_alike = |i: usize| self.row(i).map(|own| own.1).eq(self.column(i).map(|own| own.1));
        (0..self.dimension()).all(is_alike)
    }

    /// Index of `(row, column)` among the nonzeros, if it is one.
    #[inline]
    pub fn position(&self, row: usize, column: usize) -> Option<usize> {
        let (start, end) = (self.column_pointers()[column], self.column_pointers()[column + 1]);
        self.row_indices()[start..end].binary_search(&row).ok().map(|offset| start + offset)
    }

    /// Entries of the Cholesky factors of matrices on this pattern.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub fn factor_entry_count(&self) -> Result<usize, LinalgError> {
        self.symbolic_cholesky().map(|symbolic| symbolic.len_val())
    }

    /// Order of elimination and structure of the Cholesky factors, neighbours of alike structure in one block; only the upper triangle
    /// counts. The order is that of approximate minimum degree or, of large factors, of nested dissection if that leaves fewer entries.
    ///
    /// # Errors
    /// If the analysis runs out of memory or index range.
    pub(super) fn symbolic_cholesky(&self) -> Result<Arc<SymbolicCholesky<usize>>, LinalgError> {
        self.factors.get_or_init(|| self.analysed().map(Arc::new)).clone()
    }

    fn analysed(&self) -> Result<SymbolicCholesky<usize>, LinalgError> {
        let by_degree = self.analysed_by(SymmetricOrdering::Amd)?;
        if by_degree.len_val() < LARGE {
            return Ok(by_degree);
        }
        let Some(unknowns) = nested_dissection(self) else {
            return Ok(by_degree);
        };
        let mut places = vec![0; unknowns.len()];
        unknowns.iter().enumerate().for_each(|(place, &unknown)| places[unknown] = place); // The inverse permutation.
        let order = PermRef::new_checked(&unknowns, &places, unknowns.len());
        let dissected = self.analysed_by(SymmetricOrdering::Custom(order))?;
        Ok(if dissected.len_val() < by_degree.len_val() { dissected } else { by_degree })
    }

    fn analysed_by(
        &self,
        order: SymmetricOrdering<'_, usize>,
    ) -> Result<SymbolicCholesky<usize>, LinalgError> {
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL, // Blocks whatever they cost: fronts are made of them.
            ..Default::default()
        };
        factorize_symbolic_cholesky(self.symbolic.as_ref(), Side::Upper, order, parameters)
            .map_err(|error| LinalgError::factorization(self.dimension(), format!("{error:?}")))
    }
}

/// Sorts the nonzeros of a column-wise pattern by rows: start of each row, index of each nonzero, its column.
fn by_rows(symbolic: &SymbolicSparseColMat<usize>) -> (Vec<usize>, Vec<u32>, Vec<u32>) {
    let (n, count) = (symbolic.ncols(), symbolic.row_idx().len());
    let most = u32::try_from(count).unwrap_or_else(|_| panic!("{count} nonzeros are too many"));
    let indices: Vec<u32> = (0..most).collect();
    let (mut pointers, mut columns, mut positions) =
        (vec![0; n + 1], vec![0; count], vec![0; count]);
    transpose(
        &mut positions,
        &mut pointers,
        &mut columns,
        SparseColMatRef::new(symbolic.as_ref(), &indices),
        MemStack::new(&mut MemBuffer::new(transpose_scratch::<usize>(n, n))),
    );
    (pointers, positions, columns.into_iter().map(|column| column as u32).collect())
}
