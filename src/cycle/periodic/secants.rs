//! Newton's method on the differences of past iterates, plain periods on what they do not hold.

use super::vector::{add, dot, norm, orthogonalize};

/// Share of a difference that must lie beyond the others, lest it says nothing new.
const NEW: f64 = 1e-7;

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
/// Source: D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12 (1965), here with the period
/// as an unknown; R. Haelterman, J. Degroote and others call it a multi-secant quasi-Newton method.
pub struct SecantSpace {
    depth: usize,
    /// `dx`, `dT`, `dr`, oldest first.
    secants: Vec<(Vec<f64>, f64, Vec<f64>)>,
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
            secants: Vec::new(),
            basis: Vec::new(),
            triangle: Vec::new(),
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.secants.clear();
        self.basis.clear();
        self.triangle.clear();
    }

    /// Adds a difference of iterates with that of their residuals; where there are too many, the older half goes.
    pub fn push(&mut self, mut iterate: Vec<f64>, period: f64, mut residual: Vec<f64>) {
        let length = norm(&iterate);
        if !(length > 0.0) {
            return;
        }
        [&mut iterate, &mut residual]
            .into_iter()
            .flatten()
            .for_each(|value| *value /= length);
        if self.secants.len() >= self.depth {
            let kept = self.secants.split_off(self.depth / 2);
            self.clear();
            for (iterate, period, residual) in kept {
                self.append(iterate, period, residual);
            }
        }
        self.append(iterate, period / length, residual);
    }

    fn append(&mut self, iterate: Vec<f64>, period: f64, residual: Vec<f64>) {
        let mut own = residual.clone();
        let mut column = orthogonalize(&mut own, &self.basis);
        let length = norm(&own);
        if !(length > NEW * norm(&residual)) {
            return;
        }
        own.iter_mut().for_each(|value| *value /= length);
        column.push(length);
        self.basis.push(own);
        self.triangle.push(column);
        self.secants.push((iterate, period, residual));
    }

    /// The step from an iterate with this residual and this rate `x'` at its end: `dx` and `dT`.
    pub fn step(&self, residual: &[f64], rate: &[f64]) -> (Vec<f64>, f64) {
        // The change of the period takes what no secant holds.
        let mut beyond = rate.to_vec();
        orthogonalize(&mut beyond, &self.basis);
        let length = dot(&beyond, &beyond);
        let mut delay = 0.0;
        if length > 1e-16 * dot(rate, rate) {
            delay = -dot(&beyond, residual) / length;
        }
        let mut step = residual.to_vec();
        add(&mut step, delay, rate);

        // The triangle from its last row up.
        let mut wanted: Vec<f64> = self.basis.iter().map(|unit| -dot(unit, &step)).collect();
        for last in (0..wanted.len()).rev() {
            let column = &self.triangle[last];
            wanted[last] /= column[last];
            let factor = wanted[last];
            add(&mut wanted[..last], -factor, &column[..last]);
        }
        let mut period = delay;
        for (factor, (iterate, change, image)) in wanted.iter().zip(&self.secants) {
            add(&mut step, *factor, iterate);
            add(&mut step, *factor, image);
            period += factor * change;
        }
        (step, period)
    }
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
        let mut space = SecantSpace::new(20);
        let mut last: Option<(Vec<f64>, f64, Vec<f64>)> = None;
        for _ in 0..n + 4 {
            let r = residual(&x, period);
            if let Some((x0, t0, r0)) = last.take() {
                let change = |a: &[f64], b: &[f64]| super::super::vector::difference(a, b);
                space.push(change(&x, &x0), period - t0, change(&r, &r0));
            }
            let (dx, dt) = space.step(&r, &shift);
            last = Some((x.clone(), period, r));
            add(&mut x, 1.0, &dx);
            period += dt;
        }
        assert!(norm(&residual(&x, period)) < 1e-10);
        assert!((period - 2.0).abs() < 1e-10, "{period}");
    }
}
