//! Newton's method on the differences of past iterates, plain periods on what they do not hold.

use super::map::{PeriodImage, PeriodicState};
use crate::linalg::dense::{add, difference, dot, norm};
use std::collections::VecDeque;

/// Share of a difference that must lie beyond later ones, lest it says nothing new.
pub const NEW: f64 = 1e-6;
/// The same where differences come from several points of a branch, between which the map bends.
pub const NEW_ALONG: f64 = 0.05;
/// Fewest and most differences kept, and numbers that all their motions may have.
const DEPTHS: [usize; 2] = [24, 100];
const NUMBERS: usize = 16_000_000;
/// Longest step relative to the amplitude, of the period relative to it, and of the parameter in units of its scale.
const LONGEST: [f64; 3] = [0.3, 0.05, 0.1];

/// A state on the way of a search, or what changes from one to the next.
#[derive(Clone, Debug, Default)]
pub struct Iterate {
    /// `x` and `T`.
    pub state: PeriodicState,
    /// Parameter of a branch and amplitude, each in units of its scale; zero where the parameter stands still, and of a step that of the
    /// amplitude.
    pub place: [f64; 2],
    /// What the map misses it by; nothing of a step.
    pub residual: Vec<f64>,
}

impl Iterate {
    /// What has changed since an earlier one.
    pub fn since(&self, earlier: &Self) -> Self {
        let (to, from) = (&self.state, &earlier.state);
        let motion = difference(&to.motion, &from.motion);
        Self {
            state: PeriodicState { motion, period: to.period - from.period },
            place: [0, 1].map(|i| self.place[i] - earlier.place[i]),
            residual: difference(&self.residual, &earlier.residual),
        }
    }

    /// The share of a step that is not too long, from a state of this period with this image.
    pub fn allowed(&self, period: f64, image: &PeriodImage) -> f64 {
        let lengths = [
            norm(&self.state.motion) / image.vibration,
            self.state.period.abs() / period,
            self.place[0].abs(),
        ];
        lengths.iter().zip(LONGEST).fold(1.0_f64, |share, (length, longest)| {
            share.min(longest / length.max(f64::MIN_POSITIVE))
        })
    }

    /// Takes a share of it.
    pub fn take(&self, share: f64, state: &mut PeriodicState) {
        add(&mut state.motion, share, &self.state.motion);
        state.period += share * self.state.period;
    }
}

/// Differences of iterates `(dx, dT)` with those of their residuals `dr`, which a linear residual `r` would have as `dr = r' (dx, dT)`.
///
/// A step takes the combination of them, and of the change of the period with `dr / dT = dx / dt`, that leaves the least
/// residual, then one period on the rest:
///
/// ```text
/// min | r + sum g dr + tau x' |,   x <- x + sum g dx + (r + sum g dr + tau x'),   T <- T + tau + sum g dT
/// ```
///
/// On a branch the parameter `p` is one more unknown, `dp` one more part of a secant, and a closure `c(p, a)` that ties the
/// point down one more row of the residual: `dc = w . (dp, da)` of each secant. A change of `p` alone, or from one point of the
/// branch to the next, is a secant like any other.
///
/// The least squares go through the products `dr . dr`, the latest difference first: an older one that says little new beside
/// later ones is left out, of another point of the branch, where the map is another, as well as of this one.
///
/// Source: D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12 (1965), here with the period
/// as an unknown; R. Haelterman, J. Degroote and others call it a multi-secant quasi-Newton method.
#[derive(Clone, Debug)]
pub struct SecantSpace {
    depth: usize,
    /// Share of a difference that must lie beyond later ones, lest it says nothing new.
    least: f64,
    /// `w` of the closure.
    pub closure: [f64; 2],
    /// Latest first, of unit length, each with its products `dr . dr` with itself and, from the next one on, with later ones.
    changes: VecDeque<(Iterate, Vec<f64>)>,
}

impl SecantSpace {
    /// An empty space for so many unknowns; differences of which less than a share `least` is new beside later ones are left out.
    pub fn new(unknowns: usize, least: f64) -> Self {
        let [fewest, most] = DEPTHS;
        Self {
            depth: (NUMBERS / unknowns.max(1)).clamp(fewest, most), // As far as memory goes.
            least,
            closure: [0.0; 2],
            changes: VecDeque::new(),
        }
    }

    /// How many differences there are.
    pub fn count(&self) -> usize {
        self.changes.len()
    }

    /// Forgets all but so many of the latest.
    pub fn keep_latest(&mut self, count: usize) {
        self.changes.truncate(count);
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.changes.clear();
    }

    /// Adds a difference of iterates with that of their residuals; where there are too many, the oldest goes.
    pub fn push(&mut self, mut change: Iterate) {
        let length = match norm(&change.state.motion) {
            0.0 => change.place[0].abs(), // Of the parameter alone.
            length => length,
        };
        if !(length > 0.0) {
            return;
        }
        let values = change.state.motion.iter_mut().chain(&mut change.residual);
        values.chain(&mut change.place).for_each(|value| *value /= length);
        change.state.period /= length; // All of unit length, so that shares compare.
        self.changes.truncate(self.depth - 1);
        for (other, products) in &mut self.changes {
            products.push(dot(&change.residual, &other.residual));
        }
        let own = dot(&change.residual, &change.residual);
        self.changes.push_front((change, vec![own]));
    }

    /// The step from an iterate with this residual, this closure and this rate `x'` at its end.
    pub fn step(&self, residual: &[f64], closure: f64, rate: &[f64]) -> Iterate {
        let changes = || self.changes.iter().map(|(change, _)| change);
        let [by_value, by_amplitude] = self.closure;
        let closures: Vec<f64> =
            changes().map(|own| by_value * own.place[0] + by_amplitude * own.place[1]).collect();
        // Products of each difference with those after it; the change of the period, which takes what they do not hold, is last.
        let count = self.changes.len();
        let along: Vec<f64> = changes().map(|own| dot(&own.residual, rate)).collect();
        let product = |i: usize, j: usize| match (i < count, j < count) {
            (true, true) => {
                let products = &self.changes[i].1;
                products[i - j] + closures[i] * closures[j] // dr_i . dr_j + dc_i dc_j, j the later by i - j changes.
            }
            (false, true) => along[j], // x' . dr_j: a period has no part in the closure.
            _ => dot(rate, rate),
        };
        let mut against: Vec<f64> = changes()
            .zip(&closures)
            .map(|(own, own_closure)| -dot(&own.residual, residual) - own_closure * closure)
            .collect();
        against.push(-dot(rate, residual)); // Right sides: -(dr . r + dc c), and -x' . r.
        let factors = least_squares(&product, &against, self.least);

        // What they make of the residual, and the motion that goes with it.
        let state = PeriodicState { motion: residual.to_vec(), period: factors[count] };
        let mut step = Iterate { state, ..Iterate::default() };
        add(&mut step.state.motion, factors[count], rate);
        for (factor, change) in factors.iter().zip(changes()) {
            if *factor != 0.0 {
                add(&mut step.state.motion, *factor, &change.state.motion);
                add(&mut step.state.motion, *factor, &change.residual); // x + g dx, then one period: g dr.
                step.state.period += factor * change.state.period;
                step.place[0] += factor * change.place[0];
            }
        }
        step
    }
}

/// Solves `sum_j a_ij g_j = b_i` by Cholesky's factorization, `a` symmetric (`product(i, j)` for `j <= i`); rows that lie, but
/// for a share `least`, among those before them are left out, their `g` zero.
fn least_squares(product: &dyn Fn(usize, usize) -> f64, against: &[f64], least: f64) -> Vec<f64> {
    let mut kept: Vec<usize> = Vec::new();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut solved: Vec<f64> = Vec::new();
    for (i, wanted) in against.iter().enumerate() {
        let mut row: Vec<f64> = Vec::with_capacity(kept.len() + 1);
        for (&j, other) in kept.iter().zip(&rows) {
            let own = product(i, j) - dot(&row, &other[..row.len()]);
            row.push(own / other[row.len()]); // l_ij = (a_ij - sum_k l_ik l_jk) / l_jj.
        }
        let whole = product(i, i);
        let beyond = whole - dot(&row, &row); // l_ii^2.
        if !(beyond > least * least * whole) {
            continue;
        }
        let diagonal = beyond.sqrt();
        solved.push((wanted - dot(&row, &solved)) / diagonal); // L y = b.
        row.push(diagonal);
        kept.push(i);
        rows.push(row);
    }
    let mut factors = vec![0.0; against.len()];
    for last in (0..kept.len()).rev() {
        let own = solved[last] / rows[last][last]; // L^T g = y.
        factors[kept[last]] = own;
        add(&mut solved[..last], -own, &rows[last][..last]);
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::GaussianNoise;

    /// An affine map of `n` unknowns with one multiplier of 1.2, one of -0.95 and a shift of multiplier 1, whose residual
    /// changes with the period along the shift: the fixed point is found in about as many steps as there are unknowns.
    #[test]
    fn an_affine_map_with_growing_and_slow_directions_is_solved() {
        let n = 12;
        let mut noise = GaussianNoise::new(7);
        let multiplier = |i: usize| match i {
            0 => 1.0,
            1 => 1.2,
            2 => -0.95,
            i => 0.8 / i as f64,
        };
        let target: Vec<f64> = (0..n).map(|_| noise.draw().re).collect();
        let shift: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == 0))).collect();
        let residual = |x: &[f64], period: f64| -> Vec<f64> {
            let own = |i: usize| (multiplier(i) - 1.0) * (x[i] - target[i]);
            (0..n).map(|i| own(i) + (period - 2.0) * shift[i]).collect()
        };
        let (mut x, mut period) = (vec![0.0; n], 1.9);
        let mut space = SecantSpace::new(n, NEW);
        let mut last: Option<(Vec<f64>, f64, Vec<f64>)> = None;
        for _ in 0..n + 4 {
            let r = residual(&x, period);
            if let Some((x0, t0, r0)) = last.take() {
                let motion = difference(&x, &x0);
                space.push(Iterate {
                    state: PeriodicState { motion, period: period - t0 },
                    place: [0.0; 2],
                    residual: difference(&r, &r0),
                });
            }
            let step = space.step(&r, 0.0, &shift);
            last = Some((x.clone(), period, r));
            add(&mut x, 1.0, &step.state.motion);
            period += step.state.period;
        }
        assert!(norm(&residual(&x, period)) < 1e-10);
        assert!((period - 2.0).abs() < 1e-10, "{period}");
    }
}
