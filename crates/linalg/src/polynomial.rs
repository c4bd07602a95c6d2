//! Sparse matrices that are polynomials in one parameter, on one shared sparsity pattern.

use super::dense::add;
use super::pattern::SparsityPattern;
use std::sync::Arc;

/// Weights of the coefficients of a [`MatrixPolynomial`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionWeights {
    origin: f64,
}

impl FrictionWeights {
    /// Those of [`MatrixPolynomial::frozen_below`], for `origin > 0`; of the powers of `mu` for 0.
    #[inline]
    pub fn frozen_below(origin: f64) -> Self {
        Self { origin }
    }

    /// The place of what `mu^p` multiplies, or with the origin `a` `(mu - a)^p` of what is frozen below it.
    #[inline]
    pub fn place(self, p: usize) -> usize {
        p + usize::from(!self.are_powers() && p > 0)
    }

    /// The places of what `mu` and the coefficient at `place` multiply, and their factors: `mu mu^p = mu^(p + 1)`, or with the origin `a`
    ///
    /// ```text
    /// mu 1 = min(mu, a) + (mu - a),    mu (mu - a)^p = a (mu - a)^p + (mu - a)^(p + 1)
    /// ```
    ///
    /// above `a`; linear below it, where `mu min(mu, a)` is taken as `a mu`.
    #[inline]
    pub fn times_mu(self, place: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let a = self.origin;
        let pair = match (self.are_powers(), place) {
            (true, _) => [(place + 1, 1.0), (0, 0.0)],
            (false, 0) => [(1, 1.0), (2, 1.0)],
            (false, 1) => [(1, a), (2, a)],
            (false, _) => [(place, a), (place + 1, 1.0)],
        };
        pair.into_iter().filter(|(_, factor)| *factor != 0.0)
    }

    /// Whether they are the powers of `mu`.
    #[inline]
    pub fn are_powers(self) -> bool {
        self.origin == 0.0
    }

    /// Weight of the coefficient at `place`.
    #[inline]
    pub fn at(self, place: usize, mu: f64) -> f64 {
        let beyond = (mu - self.origin).max(0.0);
        match place {
            0 => 1.0,
            _ if self.are_powers() => mu.powi(place as i32),
            1 => mu.min(self.origin),
            _ => beyond.powi(place as i32 - 1),
        }
    }

    /// Its derivative by `mu`, from above at the origin.
    #[inline]
    pub fn slope(self, place: usize, mu: f64) -> f64 {
        let power = place as i32;
        match place {
            0 => 0.0,
            _ if self.are_powers() => f64::from(power) * mu.powi(power - 1),
            1 => f64::from(u8::from(mu < self.origin)),
            _ if mu < self.origin => 0.0,
            _ => f64::from(power - 1) * (mu - self.origin).powi(power - 2),
        }
    }

    /// How `count` coefficients become `P(mu)`, or `dP/dmu`: `(place, factor, weight)` of steps `sum <- factor sum + weight P_place` from
    /// zero on, those of powers by Horner's rule.
    pub fn steps(self, count: usize, mu: f64, is_slope: bool) -> Vec<(usize, f64, f64)> {
        if self.are_powers() {
            let weight = |place: usize| if is_slope { place as f64 } else { 1.0 }; // Horner's rule on p P_p.
            let places = (usize::from(is_slope)..count).rev();
            return places.map(|place| (place, mu, weight(place))).collect();
        }
        let weight = if is_slope { Self::slope } else { Self::at };
        (0..count).map(|place| (place, 1.0, weight(self, place, mu))).collect()
    }
}

/// A square sparse matrix `P(mu) = P_0 + mu P_1 + mu^2 P_2 + ...` of a real parameter `mu`.
///
/// All coefficients are stored on the whole shared pattern, structural zeros included.
#[derive(Clone, Debug)]
pub struct MatrixPolynomial {
    pattern: Arc<SparsityPattern>,
    coefficients: Vec<Vec<f64>>,
    weights: FrictionWeights,
}

impl MatrixPolynomial {
    /// Polynomial on a given pattern; `triplets[p]` holds the `(row, column, value)` entries of the
    /// coefficient of `mu^p`. Repeated positions add up, in the order given.
    ///
    /// # Panics
    /// If an entry is not on the pattern.
    pub fn on_pattern(
        pattern: &Arc<SparsityPattern>,
        triplets: &[Vec<(usize, usize, f64)>],
    ) -> Self {
        let coefficients = triplets
            .iter()
            .map(|entries| {
                let mut values = vec![0.0; pattern.nonzero_count()];
                for &(row, column, value) in entries {
                    let position = pattern
                        .position(row, column)
                        .unwrap_or_else(|| panic!("entry ({row}, {column}) is off the pattern"));
                    values[position] += value;
                }
                values
            })
            .collect();
        Self::from_coefficients(pattern, coefficients)
    }

    /// Polynomial on its own pattern, the union of the positions of all triplets; see [`Self::on_pattern`].
    #[inline]
    pub fn from_triplets(dimension: usize, triplets: &[Vec<(usize, usize, f64)>]) -> Self {
        let positions = triplets.iter().flatten().map(|&(row, col, _)| (row, col));
        let pattern = Arc::new(SparsityPattern::from_positions(dimension, positions));
        Self::on_pattern(&pattern, triplets)
    }

    /// Polynomial whose coefficient of `mu^p` has the nonzero values `coefficients[p]`, in the order of the pattern.
    ///
    /// # Panics
    /// If a coefficient does not have one value for each nonzero.
    #[inline]
    pub fn from_coefficients(pattern: &Arc<SparsityPattern>, coefficients: Vec<Vec<f64>>) -> Self {
        for values in &coefficients {
            assert_eq!(values.len(), pattern.nonzero_count());
        }
        Self { pattern: Arc::clone(pattern), coefficients, weights: FrictionWeights::default() }
    }

    /// The same coefficients with other weights, for `origin > 0`:
    ///
    /// ```text
    /// P(mu) = P_0 + min(mu, origin) P_1 + sum_{p >= 2} max(mu - origin, 0)^(p - 1) P_p
    /// ```
    ///
    /// a polynomial above `origin`, linear below.
    #[inline]
    pub fn frozen_below(self, origin: f64) -> Self {
        Self { weights: FrictionWeights { origin }, ..self }
    }

    /// See [`Self::frozen_below`]; 0 of powers of `mu`.
    #[inline]
    pub fn origin(&self) -> f64 {
        self.weights.origin
    }

    /// What each coefficient weighs.
    #[inline]
    pub fn weights(&self) -> FrictionWeights {
        self.weights
    }

    /// Coefficients of the powers of `mu - a`, of the polynomial that it is above [`Self::frozen_below`].
    ///
    /// Near `a` they are of the size of the matrix. Powers about a place far away from where the polynomial was made cancel each other.
    pub fn about(&self, a: f64) -> Vec<Vec<f64>> {
        let mut terms = self.coefficients.clone();
        // What does not change above the origin is one term.
        let origin = self.origin();
        if origin > 0.0 && terms.len() > 1 {
            let linear = terms.remove(1);
            add(&mut terms[0], origin, &linear); // min(mu, a) is a there.
        }
        // Taylor's shift by repeated Horner steps: mu - origin = (mu - a) + shift.
        let shift = a - origin;
        for first in 0..terms.len() {
            for p in (first..terms.len() - 1).rev() {
                let (lower, upper) = terms.split_at_mut(p + 1);
                add(&mut lower[p], shift, &upper[0]); // P_p += shift P_{p+1}.
            }
        }
        terms
    }

    /// The shared pattern.
    #[inline]
    pub fn pattern(&self) -> &Arc<SparsityPattern> {
        &self.pattern
    }

    /// Nonzero values of each power's coefficient, lowest power first.
    #[inline]
    pub fn coefficients(&self) -> &[Vec<f64>] {
        &self.coefficients
    }

    /// Number of rows and of columns.
    #[inline]
    pub fn dimension(&self) -> usize {
        self.pattern.dimension()
    }

    /// The coefficient of `mu^power` alone, as a constant over the unknowns that it touches (its nonzero
    /// rows and columns), and these unknowns in ascending order.
    ///
    /// Friction touches the contact rows only: on the shared pattern most of such a coefficient is structural zeros.
    pub fn compact_coefficient(&self, power: usize) -> (Self, Vec<usize>) {
        let values = &self.coefficients[power];
        let nonzeros = || self.pattern.nonzeros().filter(|own| values[own.0] != 0.0);

        // The unknowns, and their places among themselves.
        let mut place = vec![None; self.dimension()];
        nonzeros().for_each(|(_, row, column)| (place[row], place[column]) = (Some(0), Some(0)));
        let mut unknowns = Vec::new();
        for (unknown, own) in place.iter_mut().enumerate().filter(|(_, own)| own.is_some()) {
            *own = Some(unknowns.len());
            unknowns.push(unknown);
        }

        // Rows and columns keep their order.
        let positions = nonzeros().filter_map(|(_, row, column)| place[row].zip(place[column]));
        let pattern = SparsityPattern::from_positions(unknowns.len(), positions);
        let kept = nonzeros().map(|(position, ..)| values[position]).collect();
        (Self::from_coefficients(&Arc::new(pattern), vec![kept]), unknowns)
    }

    /// Nonzero values of `P(mu)`.
    #[inline]
    pub fn evaluate(&self, mu: f64) -> Vec<f64> {
        self.summed(mu, false)
    }

    /// Nonzero values of `dP/dmu` at `mu`.
    #[inline]
    pub fn derivative(&self, mu: f64) -> Vec<f64> {
        self.summed(mu, true)
    }

    /// By how much the terms of `P(mu)` exceed their sum, largest entries taken: rounding of the terms is as many times that of the sum.
    #[inline]
    pub fn cancellation(&self, mu: f64) -> f64 {
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        // Two terms are a stiffness and its change: they do not cancel each other.
        if self.coefficients.len() <= 2 {
            return 1.0;
        }
        let terms = self.coefficients.iter().enumerate();
        let terms = terms.map(|(place, own)| self.weights().at(place, mu).abs() * largest(own));
        match largest(&self.evaluate(mu)) {
            0.0 => 1.0,
            sum => terms.sum::<f64>() / sum,
        }
    }

    fn summed(&self, mu: f64, is_slope: bool) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.nonzero_count()];
        for (place, factor, weight) in self.weights.steps(self.coefficients.len(), mu, is_slope) {
            let pairs = values.iter_mut().zip(&self.coefficients[place]);
            pairs.for_each(|(sum, c)| *sum = factor * *sum + weight * c);
        }
        values
    }

    /// `alpha a + beta b` of two polynomials on the same pattern.
    ///
    /// # Panics
    /// If they do not share one pattern.
    pub fn combination(alpha: f64, a: &Self, beta: f64, b: &Self) -> Self {
        assert!(Arc::ptr_eq(&a.pattern, &b.pattern), "the two polynomials do not share a pattern");
        let count = a.coefficients.len().max(b.coefficients.len());
        let mut coefficients = vec![vec![0.0; a.pattern.nonzero_count()]; count];
        for (factor, polynomial) in [(alpha, a), (beta, b)] {
            let pairs = coefficients.iter_mut().zip(&polynomial.coefficients);
            pairs.for_each(|(sum, values)| add(sum, factor, values));
        }
        Self::from_coefficients(&a.pattern, coefficients).frozen_below(a.origin().max(b.origin()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: above the origin the places that `times_mu` names weigh `mu` times as much.
    #[test]
    fn terms_times_mu_weigh_mu_times_as_much() {
        for (origin, above) in [(0.0, 0.1), (0.4, 0.4), (0.4, 0.7)] {
            let weights = FrictionWeights::frozen_below(origin);
            for place in 0..5 {
                let terms = weights.times_mu(place);
                let sum: f64 = terms.map(|(at, factor)| factor * weights.at(at, above)).sum();
                assert!((sum - above * weights.at(place, above)).abs() < 1e-15);
            }
        }
    }

    /// Closed form: linear below the origin, a polynomial above, which powers about another place say too, and no jump between.
    #[test]
    fn a_frozen_polynomial_is_linear_below_its_origin_and_given_by_powers_above() {
        let pattern = Arc::new(SparsityPattern::from_positions(1, [(0, 0)]));
        let coefficients = vec![vec![2.0], vec![3.0], vec![-4.0], vec![5.0]];
        let frozen = MatrixPolynomial::from_coefficients(&pattern, coefficients).frozen_below(0.4);
        let exact = |mu: f64| match mu < 0.4 {
            true => 2.0 + 3.0 * mu,
            false => 2.0 + 3.0 * 0.4 - 4.0 * (mu - 0.4) + 5.0 * (mu - 0.4).powi(2),
        };
        let powers = frozen.about(0.5);
        for mu in [0.0, 0.1, 0.4, 0.7] {
            assert!((frozen.evaluate(mu)[0] - exact(mu)).abs() < 1e-15);
            let step = 1e-6;
            let slope = (exact(mu + step) - exact(mu)) / step;
            assert!((frozen.derivative(mu)[0] - slope).abs() < 1e-5);
        }
        for mu in [0.4_f64, 0.7, 1.1] {
            let terms = powers.iter().enumerate();
            let sum: f64 = terms.map(|(p, values)| values[0] * (mu - 0.5).powi(p as i32)).sum();
            assert!((sum - exact(mu)).abs() < 1e-14);
        }
    }

    fn quadratic() -> MatrixPolynomial {
        MatrixPolynomial::from_triplets(
            2,
            &[
                vec![(0, 0, 1.0), (1, 1, 2.0), (0, 0, 0.5)],
                vec![(1, 0, 3.0)],
                vec![(1, 0, -1.0), (1, 1, 4.0)],
            ],
        )
    }

    #[test]
    fn evaluation_sums_powers_and_repeated_entries() {
        let p = quadratic();
        assert_eq!(p.pattern().column_pointers(), [0, 2, 3]);
        assert_eq!(p.pattern().row_indices(), [0, 1, 1]);
        assert_eq!(p.evaluate(0.5), [1.5, 1.25, 3.0]);
        assert_eq!(p.evaluate(0.0), [1.5, 0.0, 2.0]);
    }

    #[test]
    fn derivative_equals_central_difference_of_a_quadratic() {
        let p = quadratic();
        let (mu, h) = (0.7, 0.25);
        let (above, below) = (p.evaluate(mu + h), p.evaluate(mu - h));
        for (i, d) in p.derivative(mu).iter().enumerate() {
            // Central differences of a quadratic are exact up to round-off.
            assert!((d - (above[i] - below[i]) / (2.0 * h)).abs() < 1e-14);
        }
    }

    #[test]
    fn combination_adds_coefficient_by_coefficient() {
        let p = quadratic();
        let q = MatrixPolynomial::on_pattern(p.pattern(), &[vec![(1, 1, 10.0)]]);
        let sum = MatrixPolynomial::combination(2.0, &p, -1.0, &q);
        assert_eq!(sum.evaluate(0.5), [3.0, 2.5, -4.0]);
    }
}
