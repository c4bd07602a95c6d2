//! A mode in coordinates of the common basis.

use crate::cea::counted::NEARLY_CRITICAL;
use crate::cea::sparse::*;
use crate::linalg::dense::orthogonalize;
use crate::linalg::vectors::product;

/// One mode of the projected problem.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedMode {
    /// Eigenvalue `lambda`, `Im > 0`, rad/s.
    pub eigenvalue: c64,
    /// `dlambda/dmu`, rad/s.
    pub derivative: c64,
    /// Coordinates of the right vector `x`, of unit length.
    pub right: Vec<c64>,
    /// Coordinates of the left vector `w`, scaled to `w^T (2 lambda M + C) x = 1` (no conjugation).
    pub left: Vec<c64>,
}

/// A mode and its friction coefficient.
#[derive(Clone, Debug)]
pub struct ModeAt {
    /// Friction coefficient.
    pub mu: f64,
    /// Mode there.
    pub mode: ReducedMode,
}

/// A friction coefficient and its modes.
pub type ModesAt<'a> = (f64, &'a [ReducedMode]);

/// What is kept of a mode: eigenvalue and derivative, right and left vector.
pub type KeptMode = ([[f64; 2]; 2], Vec<[f64; 2]>, Vec<[f64; 2]>);

impl ReducedMode {
    /// What is kept of it, bit by bit.
    pub fn kept(&self) -> KeptMode {
        let pair = |v: c64| [v.re, v.im];
        let [right, left] = [&self.right, &self.left].map(|own| own.iter().copied().map(pair));
        let scalars = [self.eigenvalue, self.derivative].map(pair);
        (scalars, right.collect(), left.collect())
    }

    /// The mode that was kept.
    pub fn recalled((scalars, right, left): KeptMode) -> Self {
        let complex = |[re, im]: [f64; 2]| c64::new(re, im);
        let [eigenvalue, derivative] = scalars.map(complex);
        let [right, left] = [right, left].map(|own| own.into_iter().map(complex).collect());
        Self { eigenvalue, derivative, right, left }
    }

    /// The same with other coordinates of its vectors.
    pub fn map(&self, change: impl Fn(&[c64]) -> Vec<c64>) -> Self {
        let [right, left] = [&self.right, &self.left].map(|own| change(own));
        Self { right, left, ..*self }
    }

    /// Part of its eigenvalue that is round-off: that of a lone mode times the condition `|w| |x| / |w^T x|`, which rises without bound
    /// where two modes become one. Below that place neutral ones would else grow by round-off.
    pub fn round_off(&self) -> f64 {
        let condition =
            length(&self.left) * length(&self.right) / product(&self.left, &self.right).norm();
        CONVERGED * condition.max(1.0) // 1 where w is the conjugate of x.
    }

    /// Whether it grows by more than round-off.
    pub fn is_growing(&self) -> bool {
        !self.grows_at_most(self.round_off())
    }

    /// Whether its growth rate, relative to its frequency, is no more than this.
    pub fn grows_at_most(&self, relative: f64) -> bool {
        self.eigenvalue.re <= relative * self.eigenvalue.norm()
    }

    /// `-Re(lambda) / |lambda|`; 1 is critical.
    pub fn damping_factor(&self) -> f64 {
        -self.eigenvalue.re / self.eigenvalue.norm()
    }

    /// Whether it may cease to oscillate at the next friction coefficient.
    pub fn is_nearly_critical(&self) -> bool {
        self.damping_factor() > NEARLY_CRITICAL
    }

    /// Whether its right vector is in the span of those of `others` that have its eigenvalue.
    pub fn is_among<'a>(&self, others: impl Iterator<Item = &'a Self>) -> bool {
        let reach = SAME_EIGENVALUE * self.eigenvalue.norm();
        let mut known: Vec<Vec<c64>> = Vec::new();
        for other in others.filter(|own| (own.eigenvalue - self.eigenvalue).norm() <= reach) {
            let mut vector = other.right.clone();
            orthogonalize(&mut vector, &known);
            normalize(&mut vector);
            known.push(vector);
        }
        let mut beyond = self.right.clone();
        orthogonalize(&mut beyond, &known);
        length(&beyond).powi(2) < 2.0 * NEAR * length(&self.right).powi(2)
    }
}
