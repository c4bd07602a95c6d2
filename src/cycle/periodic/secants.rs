//! Newton's method on the differences of past iterates, plain periods on what they do not hold.

use super::vector::{add, dot, norm, orthogonalize};

/// Share of a difference that must lie beyond the others, lest it says nothing new.
const NEW: f64 = 1e-7;
/// The same on a branch.
const NEW_ALONG: f64 = 1e-3;

/// What changes from one iterate to the next.
#[derive(Clone, Debug, Default)]
pub struct Change {
    /// `dx`.
    pub motion: Vec<f64>,
    /// `dT`, s.
    pub period: f64,
    /// Of the parameter of a branch and of the amplitude, each in units of its scale; zero where the parameter stands still.
    pub place: [f64; 2],
    /// `dr`.
    pub residual: Vec<f64>,
}

/// Differences of iterates `(dx, dT)` with those of their residuals `dr`, which a linear residual `r` would have as
/// `dr = r' (dx, dT)`.
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
/// Source: D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12 (1965), here with the period
/// as an unknown; R. Haelterman, J. Degroote and others call it a multi-secant quasi-Newton method.
#[derive(Clone, Debug)]
pub struct SecantSpace {
    depth: usize,
    /// Share of a difference that must lie beyond the others, lest it says nothing new.
    least: f64,
    is_along_branch: bool,
    /// `w` of the closure.
    closure: [f64; 2],
    /// Oldest first, along a branch latest first, of unit length; the closure's part is the last entry of each residual.
    changes: Vec<Change>,
    /// Orthonormal basis of the `dr`.
    basis: Vec<Vec<f64>>,
    /// Columns of the triangle `dr = basis . column`.
    triangle: Vec<Vec<f64>>,
}

impl SecantSpace {
    /// An empty space that keeps at most so many differences.
    pub fn new(depth: usize) -> Self {
        Self {
            depth,
            least: NEW,
            is_along_branch: false,
            closure: [0.0; 2],
            changes: Vec::new(),
            basis: Vec::new(),
            triangle: Vec::new(),
        }
    }

    /// One whose differences come from several points of a branch, between which the map bends: those that say little new
    /// beside later ones are left out.
    pub fn along_branch(depth: usize) -> Self {
        Self {
            least: NEW_ALONG,
            is_along_branch: true,
            ..Self::new(depth)
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.changes.clear();
        self.basis.clear();
        self.triangle.clear();
    }

    /// Gives the closure other weights, and what is known of its changes with them.
    pub fn aim(&mut self, closure: [f64; 2]) {
        self.closure = closure;
        let known = std::mem::take(&mut self.changes);
        self.build(known);
    }

    /// The basis of these changes, in their order.
    fn build(&mut self, changes: Vec<Change>) {
        self.clear();
        for mut change in changes {
            change.residual.pop();
            self.append(change);
        }
    }

    /// Adds a difference of iterates with that of their residuals; where there are too many, the older half goes.
    pub fn push(&mut self, mut change: Change) {
        let length = match norm(&change.motion) {
            0.0 => change.place[0].abs(),
            length => length,
        };
        if !(length > 0.0) {
            return;
        }
        let values = change.motion.iter_mut().chain(&mut change.residual);
        let values = values.chain(&mut change.place);
        values.for_each(|value| *value /= length);
        change.period /= length;
        if self.is_along_branch {
            // The latest first: older ones are left out beside it where they say the same of another point.
            let mut known = std::mem::take(&mut self.changes);
            known.truncate(self.depth - 1);
            self.clear();
            self.append(change);
            let latest = std::mem::take(&mut self.changes);
            return self.build(latest.into_iter().chain(known).collect());
        }
        if self.changes.len() >= self.depth {
            let kept = self.changes.split_off(self.depth / 2);
            self.build(kept);
        }
        self.append(change);
    }

    fn append(&mut self, mut change: Change) {
        let [by_value, by_amplitude] = self.closure;
        let [value, amplitude] = change.place;
        change
            .residual
            .push(by_value * value + by_amplitude * amplitude);
        let mut own = change.residual.clone();
        let mut column = orthogonalize(&mut own, &self.basis);
        let length = norm(&own);
        if !(length > self.least * norm(&change.residual)) {
            return;
        }
        own.iter_mut().for_each(|value| *value /= length);
        column.push(length);
        self.basis.push(own);
        self.triangle.push(column);
        self.changes.push(change);
    }

    /// The step from an iterate with this residual, this closure and this rate `x'` at its end: `dx`, `dT` and that of the
    /// parameter.
    pub fn step(&self, residual: &[f64], closure: f64, rate: &[f64]) -> (Vec<f64>, f64, f64) {
        // The change of the period takes what no secant holds.
        let mut beyond = rate.to_vec();
        beyond.push(0.0);
        orthogonalize(&mut beyond, &self.basis);
        let length = dot(&beyond, &beyond);
        let mut step = residual.to_vec();
        step.push(closure);
        let mut delay = 0.0;
        if length > 1e-16 * dot(rate, rate) {
            delay = -dot(&beyond, &step) / length;
        }
        add(&mut step, delay, rate);

        // The triangle from its last row up.
        let mut wanted: Vec<f64> = self.basis.iter().map(|unit| -dot(unit, &step)).collect();
        for last in (0..wanted.len()).rev() {
            let column = &self.triangle[last];
            wanted[last] /= column[last];
            let factor = wanted[last];
            add(&mut wanted[..last], -factor, &column[..last]);
        }
        let (mut period, mut value) = (delay, 0.0);
        for (factor, change) in wanted.iter().zip(&self.changes) {
            add(&mut step, *factor, &change.motion);
            add(&mut step, *factor, &change.residual);
            period += factor * change.period;
            value += factor * change.place[0];
        }
        step.pop();
        (step, period, value)
    }
}

#[cfg(test)]
mod tests {
    use super::super::vector::difference;
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
        let mut space = SecantSpace::new(20);
        let mut last: Option<(Vec<f64>, f64, Vec<f64>)> = None;
        for _ in 0..n + 4 {
            let r = residual(&x, period);
            if let Some((x0, t0, r0)) = last.take() {
                space.push(Change {
                    motion: difference(&x, &x0),
                    period: period - t0,
                    place: [0.0; 2],
                    residual: difference(&r, &r0),
                });
            }
            let (dx, dt, _) = space.step(&r, 0.0, &shift);
            last = Some((x.clone(), period, r));
            add(&mut x, 1.0, &dx);
            period += dt;
        }
        assert!(norm(&residual(&x, period)) < 1e-10);
        assert!((period - 2.0).abs() < 1e-10, "{period}");
    }
}
