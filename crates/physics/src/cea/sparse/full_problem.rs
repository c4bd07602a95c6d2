//! The full problem at one friction coefficient, with complex factors of its own.

use crate::linalg::{
    ComplexSparseLu, LinalgError, LuAnalysis, Mat, MatRef, MatrixPolynomial, SparsityPattern, c64,
};
use crate::prestress::SlidingTangent;
use std::sync::{Arc, OnceLock};

/// Order of elimination of all matrices of one tangent, made for the first factors.
#[derive(Clone, Default)]
pub struct SharedAnalysis(Arc<OnceLock<Result<LuAnalysis, LinalgError>>>);

impl SharedAnalysis {
    /// The analysis of `pattern`, the same each time.
    pub fn of(&self, pattern: &Arc<SparsityPattern>) -> Result<&LuAnalysis, LinalgError> {
        self.0.get_or_init(|| LuAnalysis::new(pattern)).as_ref().map_err(Clone::clone)
    }
}

/// What a matrix of `T(lambda)` is multiplied by.
pub type Factor<'a> = Arc<dyn Fn(c64) -> c64 + Send + Sync + 'a>;

/// `T(lambda) = K + lambda C + lambda^2 M + i H + sum_p g_p K_p` at one friction coefficient, `g_p` at the frequency of `lambda`.
pub struct FullProblem<'a> {
    pattern: &'a Arc<SparsityPattern>,
    analysis: SharedAnalysis,
    /// Nonzero values of the matrices, in this order, with their factors.
    terms: Vec<(Factor<'a>, Vec<f64>)>,
}

impl<'a> FullProblem<'a> {
    /// The problem of `tangent` at friction coefficient `mu`.
    pub fn at(tangent: &'a SlidingTangent, mu: f64) -> Self {
        Self::of(tangent, |matrix| matrix.evaluate(mu))
    }

    /// The same with an analysis that serves other friction coefficients too.
    pub fn sharing(self, analysis: &SharedAnalysis) -> Self {
        Self { analysis: analysis.clone(), ..self }
    }

    /// That of the values that are taken of each matrix: its derivatives by friction, too.
    pub fn of(tangent: &'a SlidingTangent, values: impl Fn(&MatrixPolynomial) -> Vec<f64>) -> Self {
        let mut terms: Vec<(Factor<'a>, Vec<f64>)> = vec![
            (Arc::new(|_| c64::new(1.0, 0.0)), values(&tangent.stiffness)),
            (Arc::new(|lambda| lambda), values(&tangent.damping)),
            (Arc::new(|lambda| lambda * lambda), values(&tangent.mass)),
        ];
        let lost: Factor<'a> = Arc::new(|_| c64::new(0.0, 1.0));
        terms.extend(tangent.structural.iter().map(|own| (Arc::clone(&lost), values(own))));
        terms.extend(tangent.tabled.iter().map(|part| -> (Factor<'a>, Vec<f64>) {
            (Arc::new(|lambda| part.gain.at(lambda)), values(&part.stiffness))
        }));
        Self { pattern: tangent.stiffness.pattern(), analysis: SharedAnalysis::default(), terms }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// Nonzero values of `T(lambda)`.
    fn pencil(&self, lambda: c64) -> Vec<c64> {
        let mut pencil = vec![c64::new(0.0, 0.0); self.pattern.nonzero_count()];
        for (factor, values) in &self.terms {
            let factor = factor(lambda);
            pencil.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * *value);
        }
        pencil
    }

    /// LU factors of `T(lambda)`.
    pub fn factors(&self, lambda: c64) -> Result<ComplexSparseLu, LinalgError> {
        ComplexSparseLu::factorize(self.analysis.of(self.pattern)?, self.pencil(lambda))
    }

    /// `ln det T(lambda)`, up to multiples of `2 pi i`; an error at an eigenvalue.
    pub fn ln_determinant(&self, lambda: c64) -> Result<c64, LinalgError> {
        self.analysis.of(self.pattern)?.ln_determinant(&self.pencil(lambda))
    }

    /// `P^T w` of each matrix, with its factor.
    pub fn transposed_images(&self, w: MatRef<'_, f64>) -> Vec<(Factor<'a>, Mat<f64>)> {
        let [elastic, damped, inert] = [0, 1, 2].map(|i| &self.terms[i].1[..]);
        let viscous = self.pattern.multiply_transpose_each([elastic, damped, inert], w);
        let others = self.terms[3..].iter();
        let others = others.map(|(_, values)| self.pattern.multiply_transpose(values, w));
        let factors = self.terms.iter().map(|(factor, _)| Arc::clone(factor));
        factors.zip(viscous.into_iter().chain(others)).collect()
    }

    /// `T(lambda)^T w` of each of `values` with its two columns of `w`, real and imaginary part.
    pub fn transposed_times(&self, values: &[c64], w: MatRef<'_, f64>) -> Mat<f64> {
        let mut sum = Mat::zeros(w.nrows(), w.ncols());
        for (factor, image) in self.transposed_images(w) {
            for (k, own) in values.iter().enumerate() {
                let factor = factor(*own);
                for i in 0..image.nrows() {
                    let value = factor * c64::new(image[(i, 2 * k)], image[(i, 2 * k + 1)]);
                    sum[(i, 2 * k)] += value.re;
                    sum[(i, 2 * k + 1)] += value.im;
                }
            }
        }
        sum
    }

    /// `w^T T(lambda) x`.
    pub fn form(&self, lambda: c64, w: &[c64], x: &[c64]) -> c64 {
        let forms = self.terms.iter();
        forms.map(|(factor, values)| factor(lambda) * form(self.pattern, values, w, x)).sum()
    }

    /// `w^T (2 lambda M + C) x`.
    pub fn slope(&self, lambda: c64, w: &[c64], x: &[c64]) -> c64 {
        let [damped, inert] = [1, 2].map(|i| form(self.pattern, &self.terms[i].1, w, x));
        2.0 * lambda * inert + damped
    }
}

/// `w^T P x` of a matrix with these nonzero `values`.
pub fn form(pattern: &SparsityPattern, values: &[f64], w: &[c64], x: &[c64]) -> c64 {
    let along = |j: usize| -> c64 { pattern.column(j).map(|(at, i)| w[i] * values[at]).sum() };
    (0..pattern.dimension()).map(|j| along(j) * x[j]).sum()
}
