//! The matrices of small motions at one friction coefficient, and how their eigenproblem is solved.

use super::packed::add_complex_multiple;
use crate::cea::sparse::*;
use crate::linalg::dense::join_rows;
use crate::prestress::LossGain;

/// `K`, `C` and `M` at one friction coefficient, or their coefficients of one power of it.
pub struct StructureMatrices<'a> {
    pattern: &'a Arc<SparsityPattern>,
    /// Whether they are transposed, for left vectors.
    pub is_transposed: bool,
    /// Nonzero values by rows; of the reduced problem `K` and `M` alone, others are empty.
    values: MotionMatrices<Vec<f64>>,
    linearization: Linearization,
    /// What they are evaluated from, and where.
    source: (&'a SlidingTangent, f64),
}

impl<'a> StructureMatrices<'a> {
    /// The matrices of `tangent` at friction coefficient `mu`.
    pub fn at(tangent: &'a SlidingTangent, linearization: Linearization, mu: f64) -> Self {
        Self::of_side(tangent, linearization, (mu, false))
    }

    /// Those of right vectors or, transposed, of left ones.
    pub fn of_side(
        tangent: &'a SlidingTangent,
        linearization: Linearization,
        (mu, is_transposed): (f64, bool),
    ) -> Self {
        let of = |p: &MatrixPolynomial| match is_transposed {
            false => p.pattern().by_rows(&p.evaluate(mu)),
            true => p.evaluate(mu), // Columns of P are the rows of P^T.
        };
        let values = match linearization {
            Linearization::Companion { .. } => MotionMatrices::of(tangent, of),
            Linearization::Reduced(..) => MotionMatrices {
                stiffness: of(&tangent.stiffness),
                damping: Vec::new(),
                mass: of(&tangent.mass),
                losses: Vec::new(),
            },
        };
        let pattern = tangent.stiffness.pattern();
        Self { pattern, is_transposed, values, linearization, source: (tangent, mu) }
    }

    /// Number of unknowns.
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// The product with `x` of each that the problem has; indices are read once for those of all problems.
    pub fn images(&self, x: MatRef<'_, f64>) -> MotionMatrices<Mat<f64>> {
        fn all<const N: usize>(
            own: &StructureMatrices<'_>,
            values: [&[f64]; N],
            x: MatRef<'_, f64>,
        ) -> [Mat<f64>; N] {
            match own.is_transposed {
                false => own.pattern.multiply_sorted(values, x),
                true => own.pattern.multiply_transpose_each(values, x),
            }
        }
        let MotionMatrices { stiffness, damping, mass, losses } = &self.values;
        let ([stiffness, mass], damping) = if damping.is_empty() {
            (all(self, [stiffness, mass], x), Mat::zeros(x.nrows(), 0))
        } else {
            let [stiffness, damping, mass] = all(self, [stiffness, damping, mass], x);
            ([stiffness, mass], damping)
        };
        let lost = |(gain, own): &(_, Vec<f64>)| {
            let [image] = all(self, [own], x);
            (LossGain::clone(gain), image)
        };
        MotionMatrices { stiffness, damping, mass, losses: losses.iter().map(lost).collect() }
    }

    /// `K x - kappa M x` or, of the general problem, `T(lambda) x`, for vectors `x` side by side and the eigenvalue of each; and
    /// `M x`.
    pub fn residuals_and_momenta(
        &self,
        eigenvalues: impl Iterator<Item = c64>,
        x: MatRef<'_, f64>,
    ) -> (Mat<f64>, Mat<f64>) {
        let images = self.images(x);
        let mut residuals = Mat::zeros(x.nrows(), x.ncols());
        for (k, lambda) in eigenvalues.enumerate() {
            let value = self.linearization.value_of(lambda);
            for (factor, image) in self.linearization.terms(&images, value) {
                add_complex_multiple(&mut residuals, factor, image, k); // sum f_p P_p x.
            }
        }
        (residuals, images.mass)
    }

    /// `T(lambda) x` over what [`Self::residuals_and_momenta`] returns: `T(lambda) = (1 + beta lambda) (K - kappa M)`.
    pub fn residual_factor(&self, lambda: c64) -> f64 {
        match self.linearization {
            Linearization::Reduced(damping, _) => {
                (lambda * damping.stiffness_coefficient + 1.0).norm()
            }
            Linearization::Companion { .. } => 1.0,
        }
    }

    /// Largest row sums of `|K|`, `|C|` and `|M|`; larger where the terms of a state that changes steeply with friction cancel each other.
    pub fn norms(&self) -> [f64; 3] {
        let norm = |values: &[f64]| {
            let row_sum = |row: usize| -> f64 {
                let own = self.pattern.row_range(row);
                values.get(own).into_iter().flatten().map(|v| v.abs()).sum()
            };
            (0..self.pattern.dimension()).map(row_sum).fold(0.0, f64::max)
        };
        let ((tangent, mu), own) = (self.source, &self.values);
        let [stiff, damped, inert] = [
            (&tangent.stiffness, &own.stiffness),
            (&tangent.damping, &own.damping),
            (&tangent.mass, &own.mass),
        ]
        .map(|(p, values)| (BESIDE * p.cancellation(mu)).max(1.0) * norm(values)); // Rounding of terms that cancel.
        let damped = match self.linearization {
            Linearization::Reduced(damping, _) => {
                damping.mass_coefficient * inert + damping.stiffness_coefficient * stiff // |C| <= alpha |M| + beta |K|.
            }
            Linearization::Companion { .. } => damped,
        };
        [stiff, damped, inert]
    }
}

/// Shift-and-invert about the centre, in real arithmetic: the lowest modes are its eigenvalues of largest
/// modulus. `K` and `C` stand for what takes their places there ([`Linearization`]).
///
/// Reduced problem: `K^-1 M`, eigenvalues `s = 1/(kappa + c^2)`. Quadratic problem:
///
/// ```text
/// [ -omega K^-1 C   -omega^2 K^-1 M ] [ x    ]     1  [ x    ]
/// [  I               0              ] [ nu x ]  =  -- [ nu x ],    lambda = c + omega nu.
///                                                  nu
/// ```
pub struct ShiftInverted<'a> {
    matrices: &'a StructureMatrices<'a>,
    factors: &'a SparseLu,
    /// Nonzero values by rows of `M`, or of `-omega C` and `-omega^2 M`.
    values: Vec<Vec<f64>>,
}

impl<'a> ShiftInverted<'a> {
    /// The operator of `matrices` at the friction coefficient of the `factors` of what takes the place of `K`.
    pub fn new(matrices: &'a StructureMatrices<'a>, factors: &'a SparseLu) -> Self {
        let MotionMatrices { damping, mass, .. } = &matrices.values;
        let values = match matrices.linearization {
            Linearization::Reduced(..) => vec![mass.clone()],
            Linearization::Companion { frequency_scale: omega, centre } => {
                let pairs = damping.iter().zip(mass);
                let centred = pairs.map(|(c, m)| -omega * (c + 2.0 * centre.shift * m)); // About c it is C + 2 c M.
                vec![centred.collect(), mass.iter().map(|m| -omega * omega * m).collect()]
            }
        };
        Self { matrices, factors, values }
    }
}

impl BlockOperator for ShiftInverted<'_> {
    fn dimension(&self) -> usize {
        self.values.len() * self.matrices.dimension()
    }

    fn apply(&self, z: MatRef<'_, f64>) -> Mat<f64> {
        let pattern = self.matrices.pattern;
        let [damping, mass] = &self.values[..] else {
            let [mut image] = pattern.multiply_sorted([&self.values[0]], z);
            self.factors.solve_in_place(image.as_mut()); // K^-1 M z.
            return image;
        };
        let (x, y) = z.split_at_row(pattern.dimension());
        let mut top = pattern.multiply_sum([damping, mass], [x, y]);
        self.factors.solve_in_place(top.as_mut()); // K^-1 (-omega C x - omega^2 M y).
        join_rows(top.as_ref(), x)
    }
}
