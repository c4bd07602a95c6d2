//! Factors of the stiffness with friction.

use crate::linalg::dense::{column, column_mut, random_columns};
use crate::linalg::{
    DenseLu, LdlAnalysis, LinalgError, LuAnalysis, Mat, MatrixPolynomial, Scale, SparseLdl,
    SparseLu,
};
use std::sync::{Arc, OnceLock};

/// Rows that friction may touch for factors of `K(0)` to be updated. Each takes one solution; beyond, LU factors of the whole
/// are cheaper.
const MOST_ROWS: usize = 512;
/// Columns of the compliance that are worked on together.
const COLUMNS: usize = 32;
/// Backward error of a trial solution above which updated factors are singular to working precision.
const BACKWARD_ERROR_BOUND: f64 = 1e-9;

/// Factors of `K(mu)`.
pub enum StiffnessFactors {
    /// Without friction: a factor five cheaper to compute and to solve with.
    Symmetric(Arc<SparseLdl>),
    /// With friction on few rows: two solutions with the factors of `K(0)`, and a small dense one.
    Updated(Box<UpdatedFactors>),
    /// With friction.
    General(Box<SparseLu>),
}

impl StiffnessFactors {
    /// Factorizes `K(0)`, which is symmetric.
    ///
    /// # Errors
    /// If it is singular.
    pub fn frictionless(stiffness: &MatrixPolynomial) -> Result<Self, LinalgError> {
        Ok(Self::Symmetric(Arc::new(symmetric(stiffness)?)))
    }

    /// Factors of `K(mu)`, with what all friction coefficients share made once and kept in `cache`.
    ///
    /// # Errors
    /// If it is singular.
    pub fn general(
        stiffness: &MatrixPolynomial,
        cache: &FactorCache,
        mu: f64,
    ) -> Result<Self, LinalgError> {
        let shared = cache.shared.get_or_init(|| Shared::new(stiffness, cache.is_general));
        match shared.as_ref().map_err(Clone::clone)? {
            Shared::Base(base) => {
                let updated = UpdatedFactors::new(base, stiffness, mu)?;
                Ok(Self::Updated(Box::new(updated)))
            }
            Shared::Analysis(analysis) => {
                let factors = SparseLu::factorize(analysis, stiffness.evaluate(mu))?;
                Ok(Self::General(Box::new(factors)))
            }
        }
    }

    /// `K^-1 x` for each column, in place.
    pub fn solve_in_place(&self, x: &mut Mat<f64>) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x.as_mut()),
            Self::Updated(updated) => updated.solve_in_place(x),
            Self::General(lu) => lu.solve_in_place(x.as_mut()),
        }
    }

    /// `K^-T x` for each column, in place.
    pub fn solve_transpose_in_place(&self, x: &mut Mat<f64>) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x.as_mut()),
            Self::Updated(updated) => updated.solve_transpose_in_place(x),
            Self::General(lu) => lu.solve_transpose_in_place(x.as_mut()),
        }
    }
}

fn symmetric(stiffness: &MatrixPolynomial) -> Result<SparseLdl, LinalgError> {
    let analysis = LdlAnalysis::new(stiffness.pattern())?;
    SparseLdl::factorize(&analysis, &stiffness.evaluate(0.0))
}

/// What the factors of one tangent at several friction coefficients share.
#[derive(Default)]
pub struct FactorCache {
    shared: OnceLock<Result<Shared, LinalgError>>,
    /// Whether the matrix is not symmetric without friction.
    is_general: bool,
}

impl FactorCache {
    /// A cache for a matrix that is not symmetric without friction either.
    pub fn general() -> Self {
        Self { is_general: true, ..Self::default() }
    }

    /// Factors of `K(0)`, where those with friction are updates of them; `None` where they are not. `release` is called before they are
    /// made, to let go of what they replace.
    ///
    /// # Errors
    /// If it is singular.
    pub fn frictionless(
        &self,
        stiffness: &MatrixPolynomial,
        release: impl FnOnce(),
    ) -> Result<Option<StiffnessFactors>, LinalgError> {
        if self.is_general || friction_rows(stiffness).len() > MOST_ROWS {
            return Ok(None);
        }
        release();
        let shared = self.shared.get_or_init(|| Shared::new(stiffness, false));
        match shared.as_ref().map_err(Clone::clone)? {
            Shared::Base(base) => Ok(Some(StiffnessFactors::Symmetric(Arc::clone(&base.ldl)))),
            Shared::Analysis(_) => Ok(None),
        }
    }
}

enum Shared {
    Base(Arc<FrictionlessBase>),
    Analysis(LuAnalysis),
}

impl Shared {
    fn new(stiffness: &MatrixPolynomial, is_general: bool) -> Result<Self, LinalgError> {
        let rows = friction_rows(stiffness);
        if is_general || rows.len() > MOST_ROWS {
            return LuAnalysis::new(stiffness.pattern()).map(Self::Analysis);
        }
        let ldl = symmetric(stiffness)?;
        let base = FrictionlessBase::new(Arc::new(ldl), rows, stiffness);
        Ok(Self::Base(Arc::new(base)))
    }
}

/// Updates by friction of the factors of `K(0) - sigma M(0)`, with what all friction coefficients share made once.
#[derive(Default)]
pub struct FrictionUpdates {
    base: OnceLock<Arc<FrictionlessBase>>,
}

impl FrictionUpdates {
    /// Factors of `K(mu) - sigma M(0)` from these; `None` where friction touches too many rows.
    pub fn at(
        &self,
        factors: &StiffnessFactors,
        stiffness: &MatrixPolynomial,
        mu: f64,
    ) -> Option<StiffnessFactors> {
        let StiffnessFactors::Symmetric(ldl) = factors else {
            return None;
        };
        let rows = friction_rows(stiffness);
        if mu == 0.0 || rows.is_empty() || rows.len() > MOST_ROWS {
            return None;
        }
        let base = || Arc::new(FrictionlessBase::new(Arc::clone(ldl), rows, stiffness));
        let updated = UpdatedFactors::unchecked(self.base.get_or_init(base), stiffness, mu);
        Some(StiffnessFactors::Updated(Box::new(updated)))
    }
}

/// Rows of `K(mu)` that depend on `mu`: the tangential equations of the contact.
fn friction_rows(stiffness: &MatrixPolynomial) -> Vec<usize> {
    let mut touched = vec![false; stiffness.dimension()];
    for values in &stiffness.coefficients()[1..] {
        let nonzeros = stiffness.pattern().row_indices().iter().zip(values);
        nonzeros.filter(|(_, v)| **v != 0.0).for_each(|(&row, _)| touched[row] = true);
    }
    (0..touched.len()).filter(|&row| touched[row]).collect()
}

/// Factors of `K(0)`, and `R_p K(0)^-1 E` of `K(mu) = K(0) + E R(mu)`, `R = sum_p mu^p R_p`: `E` picks the rows that friction
/// touches.
struct FrictionlessBase {
    ldl: Arc<SparseLdl>,
    rows: Vec<usize>,
    /// `R_p K(0)^-1 E`, for each power from 1 on.
    couplings: Vec<Mat<f64>>,
}

impl FrictionlessBase {
    fn new(ldl: Arc<SparseLdl>, rows: Vec<usize>, stiffness: &MatrixPolynomial) -> Self {
        let powers = 1..stiffness.coefficients().len();
        let touched =
            |power: usize| FrictionRows::new(stiffness, &rows, &stiffness.coefficients()[power]);
        let by_power: Vec<FrictionRows> = powers.map(touched).collect();
        let mut couplings = vec![Mat::zeros(rows.len(), rows.len()); by_power.len()];
        // A few columns of the compliance at a time: all of them would take the memory of the factors.
        for first in (0..rows.len()).step_by(COLUMNS) {
            let own = &rows[first..rows.len().min(first + COLUMNS)];
            let mut compliance = Mat::zeros(stiffness.dimension(), own.len());
            for (j, &row) in own.iter().enumerate() {
                compliance[(row, j)] = 1.0;
            }
            ldl.solve_in_place(compliance.as_mut());
            for (coupling, terms) in couplings.iter_mut().zip(&by_power) {
                let mut target = coupling.get_mut(.., first..first + own.len());
                target.copy_from(&terms.times(&compliance));
            }
        }
        Self { couplings, ldl, rows }
    }
}

/// Some rows of a sparse matrix, without their zeros.
struct FrictionRows {
    starts: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl FrictionRows {
    fn new(stiffness: &MatrixPolynomial, rows: &[usize], values: &[f64]) -> Self {
        let mut own = Self { starts: vec![0], columns: Vec::new(), values: Vec::new() };
        for &row in rows {
            let nonzeros = stiffness.pattern().row(row);
            for (position, column) in nonzeros.filter(|(at, _)| values[*at] != 0.0) {
                own.columns.push(column);
                own.values.push(values[position]);
            }
            own.starts.push(own.columns.len());
        }
        own
    }

    fn entries(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let own = self.starts[row]..self.starts[row + 1];
        let columns = self.columns[own.clone()].iter().copied();
        columns.zip(self.values[own].iter().copied())
    }

    /// `R x`.
    fn times(&self, x: &Mat<f64>) -> Mat<f64> {
        let mut image = Mat::zeros(self.starts.len() - 1, x.ncols());
        for j in 0..x.ncols() {
            let x = column(x.as_ref(), j);
            for (row, sum) in column_mut(&mut image, j).iter_mut().enumerate() {
                *sum = self.entries(row).map(|(i, v)| v * x[i]).sum();
            }
        }
        image
    }

    /// `target -= R^T s`.
    fn subtract_transposed(&self, s: &Mat<f64>, target: &mut Mat<f64>) {
        for j in 0..s.ncols() {
            let (s, target) = (column(s.as_ref(), j), column_mut(target, j));
            for (row, factor) in s.iter().enumerate() {
                self.entries(row).for_each(|(i, v)| target[i] -= v * factor);
            }
        }
    }
}

/// `K(mu)^-1` by the factors of `K(0)`: with `Z = K(0)^-1 E` and `G = I + R Z`,
///
/// ```text
/// K(mu)^-1 b = K(0)^-1 (b - E G^-1 R K(0)^-1 b),    K(mu)^-T b = K(0)^-1 (b - R^T G^-T E^T K(0)^-1 b).
/// ```
///
/// Source: M. A. Woodbury, Inverting modified matrices, Princeton University (1950).
pub struct UpdatedFactors {
    base: Arc<FrictionlessBase>,
    rows: FrictionRows,
    small: DenseLu,
}

impl UpdatedFactors {
    fn new(
        base: &Arc<FrictionlessBase>,
        stiffness: &MatrixPolynomial,
        mu: f64,
    ) -> Result<Self, LinalgError> {
        let factors = Self::unchecked(base, stiffness, mu);
        factors.check(stiffness, &stiffness.evaluate(mu))?;
        Ok(factors)
    }

    fn unchecked(base: &Arc<FrictionlessBase>, stiffness: &MatrixPolynomial, mu: f64) -> Self {
        let (whole, frictionless) = (stiffness.evaluate(mu), stiffness.evaluate(0.0));
        let change: Vec<f64> = whole.iter().zip(&frictionless).map(|(a, b)| a - b).collect();
        let mut small = Mat::identity(base.rows.len(), base.rows.len());
        let (mut power, weights) = (mu, stiffness.weights());
        for (coupling, place) in base.couplings.iter().zip(1..) {
            let weight = match weights.are_powers() {
                true => power,
                false => weights.at(place, mu),
            };
            small += Scale(weight) * coupling;
            power *= mu;
        }
        Self {
            base: Arc::clone(base),
            rows: FrictionRows::new(stiffness, &base.rows, &change),
            small: DenseLu::factorize(small),
        }
    }

    fn solve_in_place(&self, x: &mut Mat<f64>) {
        let mut first = x.clone();
        self.base.ldl.solve_in_place(first.as_mut());
        let mut forces = self.rows.times(&first);
        self.small.solve_in_place(forces.as_mut());
        for j in 0..x.ncols() {
            let target = column_mut(x, j);
            let forces = column(forces.as_ref(), j);
            for (&row, force) in self.base.rows.iter().zip(forces) {
                target[row] -= force;
            }
        }
        self.base.ldl.solve_in_place(x.as_mut());
    }

    fn solve_transpose_in_place(&self, x: &mut Mat<f64>) {
        let mut first = x.clone();
        self.base.ldl.solve_in_place(first.as_mut());
        let rows = &self.base.rows;
        let mut forces = Mat::from_fn(rows.len(), x.ncols(), |i, j| first[(rows[i], j)]);
        self.small.solve_transpose_in_place(forces.as_mut());
        self.rows.subtract_transposed(&forces, x);
        self.base.ldl.solve_in_place(x.as_mut());
    }

    /// Neither the small matrix nor the update says that `K(mu)` is singular: a trial solution does.
    fn check(&self, stiffness: &MatrixPolynomial, values: &[f64]) -> Result<(), LinalgError> {
        let pattern = stiffness.pattern();
        let dimension = stiffness.dimension();
        let trial = random_columns(dimension, 1, 11);
        let mut x = trial.clone();
        self.solve_in_place(&mut x);
        let residual = (pattern.multiply(values, x.as_ref()) - &trial).norm_max();
        let mut sums = vec![0.0; dimension];
        for (&row, value) in pattern.row_indices().iter().zip(values) {
            sums[row] += value.abs();
        }
        let scale = sums.into_iter().fold(0.0, f64::max) * x.norm_max();
        let backward_error = residual / scale;
        // A solution this large says that the matrix has no inverse in double precision.
        if backward_error <= BACKWARD_ERROR_BOUND && scale < 1e15 * trial.norm_max() {
            return Ok(());
        }
        Err(LinalgError::Singular { dimension, backward_error, bound: BACKWARD_ERROR_BOUND })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;

    /// Exact: solutions with updated factors satisfy the equations with friction, and their transpose.
    #[test]
    fn updated_factors_solve_with_friction() {
        let tangent = string_on_belt(60, 0.4, false);
        let cache = FactorCache::default();
        let values = tangent.stiffness.evaluate(0.3);
        let factors = StiffnessFactors::general(&tangent.stiffness, &cache, 0.3).unwrap();
        assert!(matches!(factors, StiffnessFactors::Updated(_)));
        let b = random_columns(tangent.stiffness.dimension(), 3, 5);
        let pattern = tangent.stiffness.pattern();
        let (mut x, mut y) = (b.clone(), b.clone());
        factors.solve_in_place(&mut x);
        factors.solve_transpose_in_place(&mut y);
        let scale =
            x.norm_max().max(y.norm_max()) * values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!((pattern.multiply(&values, x.as_ref()) - &b).norm_max() < 1e-13 * scale);
        assert!((pattern.multiply_transpose(&values, y.as_ref()) - &b).norm_max() < 1e-13 * scale);
        // Without the friction the same vectors are no solutions.
        let frictionless = tangent.stiffness.evaluate(0.0);
        assert!((pattern.multiply(&frictionless, x.as_ref()) - &b).norm_max() > 1e-6);
    }
}
