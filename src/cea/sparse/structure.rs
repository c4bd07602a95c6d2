//! The matrices of small motions at one friction coefficient, and how their eigenproblem is solved.

use super::linearization::Linearization;
use super::packed::PackedEntry;
use crate::linalg::dense::{column, column_mut, join_rows};
use crate::linalg::{
    BlockOperator, LdlAnalysis, LinalgError, LuAnalysis, MatrixPolynomial, QuadraticOperator,
    SparseLdl, SparseLu, SparsityPattern,
};
use crate::linalg::{Mat, MatRef, Scale, c64};
use crate::prestress::{SlidingTangent, TabledStiffness};
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

/// `K`, `C` and `M` at one friction coefficient, or their coefficients of one power of it.
pub struct StructureMatrices<'a> {
    pattern: &'a Arc<SparsityPattern>,
    /// Nonzero values of `[K, C, M]`; empty where a matrix vanishes or is not needed.
    values: [Cow<'a, [f64]>; 3],
    /// Nonzero values of the structural damping `H`, of the general problem.
    structural: Option<Vec<f64>>,
    /// Parts whose stiffness depends on frequency, with its nonzero values.
    tabled: Vec<(&'a TabledStiffness, Vec<f64>)>,
    linearization: Linearization,
}

impl<'a> StructureMatrices<'a> {
    /// The matrices of `tangent` at friction coefficient `mu`.
    pub fn at(tangent: &'a SlidingTangent, linearization: Linearization, mu: f64) -> Self {
        let of = |p: &MatrixPolynomial| Cow::Owned(p.evaluate(mu));
        let damping = match linearization {
            Linearization::Reduced(_) => Cow::Borrowed(&[][..]),
            Linearization::Companion { .. } => of(&tangent.damping),
        };
        let structural = match linearization {
            Linearization::Reduced(_) => None,
            Linearization::Companion { .. } => tangent.structural.as_ref(),
        };
        let tabled = match linearization {
            Linearization::Reduced(_) => &[][..],
            Linearization::Companion { .. } => tangent.tabled.as_slice(),
        };
        let tabled = tabled.iter();
        Self {
            pattern: tangent.stiffness.pattern(),
            values: [of(&tangent.stiffness), damping, of(&tangent.mass)],
            structural: structural.map(|terms| terms.evaluate(mu)),
            tabled: tabled
                .map(|part| (part, part.stiffness.evaluate(mu)))
                .collect(),
            linearization,
        }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// `K x - kappa M x` or, of the general problem, `T(lambda) x`, for the packed vectors `x` of `entries`, in
    /// the same packing; and `M x`.
    pub fn residuals_and_momenta(
        &self,
        entries: &[PackedEntry],
        x: MatRef<'_, f64>,
    ) -> (Mat<f64>, Mat<f64>) {
        let [stiffness, damping, mass] = &self.values;
        match self.linearization {
            Linearization::Reduced(_) => {
                let [mut residual, inert] = self.pattern.multiply_each([stiffness, mass], x);
                for entry in entries {
                    let kappa = entry.inverse_value.inv();
                    add_complex_multiple(&mut residual, -kappa, &inert, entry);
                }
                (residual, inert)
            }
            Linearization::Companion { frequency_scale } => {
                let all = [&stiffness[..], damping, mass];
                let [mut residual, damped, inert] = self.pattern.multiply_each(all, x);
                for entry in entries {
                    let lambda = entry.inverse_value.inv() * frequency_scale;
                    add_complex_multiple(&mut residual, lambda * lambda, &inert, entry);
                    add_complex_multiple(&mut residual, lambda, &damped, entry);
                }
                if let Some(structural) = &self.structural {
                    let lost = self.pattern.multiply(structural, x);
                    for entry in entries {
                        add_complex_multiple(&mut residual, c64::new(0.0, 1.0), &lost, entry);
                    }
                }
                for (part, values) in &self.tabled {
                    let image = self.pattern.multiply(values, x);
                    for entry in entries {
                        let lambda = entry.inverse_value.inv() * frequency_scale;
                        add_complex_multiple(&mut residual, part.gain.at(lambda), &image, entry);
                    }
                }
                (residual, inert)
            }
        }
    }

    /// `T(lambda) x` over what [`Self::residuals_and_momenta`] returns: `T(lambda) = (1 + beta lambda) (K - kappa M)`.
    pub fn residual_factor(&self, lambda: c64) -> f64 {
        match self.linearization {
            Linearization::Reduced(damping) => {
                (lambda * damping.stiffness_coefficient + 1.0).norm()
            }
            Linearization::Companion { .. } => 1.0,
        }
    }

    /// What turns `|M x|` into the size of the inertia force in the units of a residual: `|kappa|` or
    /// `|lambda|^2`.
    pub fn inertia_factor(&self, entry: &PackedEntry) -> f64 {
        let value = entry.inverse_value.inv().norm();
        match self.linearization {
            Linearization::Reduced(_) => value,
            Linearization::Companion { frequency_scale } => (value * frequency_scale).powi(2),
        }
    }

    /// Largest row sums of `|K|`, `|C|` and `|M|`.
    pub fn norms(&self) -> [f64; 3] {
        let norm = |values: &[f64]| {
            let mut sums = vec![0.0; self.pattern.dimension()];
            for (&row, value) in self.pattern.row_indices().iter().zip(values) {
                sums[row] += value.abs();
            }
            sums.into_iter().fold(0.0, f64::max)
        };
        let [stiff, damped, inert] = [0, 1, 2].map(|i| norm(&self.values[i]));
        let damped = match self.linearization {
            Linearization::Reduced(damping) => {
                damping.mass_coefficient * inert + damping.stiffness_coefficient * stiff
            }
            Linearization::Companion { .. } => damped,
        };
        [stiff, damped, inert]
    }
}

/// `target += factor source` on one packed vector.
fn add_complex_multiple(
    target: &mut Mat<f64>,
    factor: c64,
    source: &Mat<f64>,
    entry: &PackedEntry,
) {
    let j = entry.column;
    let real = column(source.as_ref(), j);
    if !entry.is_complex {
        let sum = column_mut(target, j).iter_mut().zip(real);
        sum.for_each(|(t, p)| *t += factor.re * p);
        return;
    }
    let imaginary = column(source.as_ref(), j + 1);
    let parts = || real.iter().zip(imaginary);
    let sum = column_mut(target, j).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * p - factor.im * q);
    let sum = column_mut(target, j + 1).iter_mut().zip(parts());
    sum.for_each(|(t, (p, q))| *t += factor.re * q + factor.im * p);
}

/// Factors of `K(mu)`.
pub enum StiffnessFactors {
    /// Without friction: a factor five cheaper to compute and to solve with.
    Symmetric(Box<SparseLdl>),
    /// With friction.
    General(Box<SparseLu>),
}

impl StiffnessFactors {
    /// Factorizes `K(0)`, which is symmetric.
    ///
    /// # Errors
    /// If it is singular.
    pub fn frictionless(tangent: &SlidingTangent) -> Result<Self, LinalgError> {
        let analysis = LdlAnalysis::new(tangent.stiffness.pattern())?;
        let values = tangent.stiffness.evaluate(0.0);
        let factors = SparseLdl::factorize(&analysis, &values)?;
        Ok(Self::Symmetric(Box::new(factors)))
    }

    /// Factorizes `K(mu)` on an analysis made once and kept in `cache`.
    ///
    /// # Errors
    /// If it is singular.
    pub fn general(
        tangent: &SlidingTangent,
        cache: &OnceLock<Result<LuAnalysis, LinalgError>>,
        mu: f64,
    ) -> Result<Self, LinalgError> {
        let analysis = cache.get_or_init(|| LuAnalysis::new(tangent.stiffness.pattern()));
        let analysis = analysis.as_ref().map_err(Clone::clone)?;
        let factors = SparseLu::factorize(analysis, tangent.stiffness.evaluate(mu))?;
        Ok(Self::General(Box::new(factors)))
    }

    /// `K^-1 x` for each column, in place.
    pub fn solve_in_place(&self, x: &mut Mat<f64>) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x.as_mut()),
            Self::General(lu) => lu.solve_in_place(x.as_mut()),
        }
    }

    /// `K^-T x` for each column, in place.
    pub fn solve_transpose_in_place(&self, x: &mut Mat<f64>) {
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(x.as_mut()),
            Self::General(lu) => lu.solve_transpose_in_place(x.as_mut()),
        }
    }
}

/// Shift-and-invert about zero, in real arithmetic: the lowest modes are its eigenvalues of largest
/// modulus.
///
/// Reduced problem: `K^-1 M`, eigenvalues `s = 1/kappa`. Quadratic problem:
///
/// ```text
/// [ -omega K^-1 C   -omega^2 K^-1 M ] [ x    ]     1  [ x    ]
/// [  I               0              ] [ nu x ]  =  -- [ nu x ],    lambda = omega nu.
///                                                  nu
/// ```
pub struct ShiftInverted<'a> {
    /// Matrices at the friction coefficient of the factors.
    pub matrices: &'a StructureMatrices<'a>,
    /// Factors of `K`.
    pub factors: &'a StiffnessFactors,
}

impl BlockOperator for ShiftInverted<'_> {
    fn dimension(&self) -> usize {
        let n = self.matrices.pattern.dimension();
        match self.matrices.linearization {
            Linearization::Reduced(_) => n,
            Linearization::Companion { .. } => 2 * n,
        }
    }

    fn apply(&self, z: MatRef<'_, f64>) -> Mat<f64> {
        let [_, damping, mass] = &self.matrices.values;
        let product = |values: &[f64], x| self.matrices.pattern.multiply(values, x);
        match self.matrices.linearization {
            Linearization::Reduced(_) => {
                let mut image = product(mass, z);
                self.factors.solve_in_place(&mut image);
                image
            }
            Linearization::Companion {
                frequency_scale: omega,
            } => {
                let (x, y) = z.split_at_row(self.matrices.pattern.dimension());
                let mut top =
                    Scale(-omega) * product(damping, x) - Scale(omega * omega) * product(mass, y);
                self.factors.solve_in_place(&mut top);
                join_rows(top.as_ref(), x)
            }
        }
    }
}

/// The upper blocks of [`ShiftInverted`] of the quadratic problem, `A = -omega K^-1 C` and `B = -omega^2 K^-1 M`.
pub struct Companion<'a> {
    pattern: &'a SparsityPattern,
    factors: &'a StiffnessFactors,
    /// Nonzero values of `-omega C` and `-omega^2 M`.
    values: [Vec<f64>; 2],
    is_transposed: bool,
}

impl<'a> Companion<'a> {
    /// The blocks of `matrices`, whose `K` has these `factors`.
    pub fn new(
        matrices: &'a StructureMatrices<'_>,
        factors: &'a StiffnessFactors,
        frequency_scale: f64,
    ) -> Self {
        let [_, damping, mass] = &matrices.values;
        let scaled = |factor: f64, values: &[f64]| values.iter().map(|v| factor * v).collect();
        Self {
            pattern: matrices.pattern,
            factors,
            values: [
                scaled(-frequency_scale, damping),
                scaled(-frequency_scale * frequency_scale, mass),
            ],
            is_transposed: false,
        }
    }

    /// The blocks of the transposed matrices: their vectors are the left ones.
    pub fn transposed(self) -> Self {
        Self {
            is_transposed: !self.is_transposed,
            ..self
        }
    }
}

impl QuadraticOperator for Companion<'_> {
    fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    fn apply(&self, x: MatRef<'_, f64>, y: MatRef<'_, f64>) -> Mat<f64> {
        let [damping, mass] = &self.values;
        if self.is_transposed {
            let product = |values, x| self.pattern.multiply_transpose(values, x);
            let mut image = product(damping, x) + product(mass, y);
            self.factors.solve_transpose_in_place(&mut image);
            return image;
        }
        let mut image = self.pattern.multiply_sum([damping, mass], [x, y]);
        self.factors.solve_in_place(&mut image);
        image
    }
}
