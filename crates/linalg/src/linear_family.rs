//! Linear systems that depend on a parameter, in one space.

use super::dense::{add, dot, norm, orthogonalize};
use super::{DenseLu, Mat};

/// Directions within which a residual falls to a share of what it was or, below a share of the scale, has reached round-off.
const PATIENCE: usize = 10;
const FALLING: f64 = 0.9;
const ROUND_OFF: f64 = 1e-11;

/// Part of a residual, orthogonal to the directions but for round-off, from which on it is a direction.
const BEYOND: f64 = 0.5;

/// The systems `(A_0 + mu A_1) x = b_0 + mu b_1` of operators near the identity, for one `mu` after the other: each residual is made
/// orthogonal to the space of all residuals so far (full orthogonalization, Saad 1981). Where `A_0` is the identity and one of both sides
/// is zero this is one Krylov space of `A_1` for all `mu`, and a few more directions where it nearly is.
#[derive(Clone, Debug)]
pub struct LinearFamily {
    right_sides: Vec<Vec<f64>>,
    scale: f64,
    /// Orthonormal ones, what `A_0` and `A_1` make of each, and the products of both, `v_i . A_p v_j`.
    directions: Vec<Vec<f64>>,
    images: [Vec<Vec<f64>>; 2],
    projected: [Mat<f64>; 2],
}

impl LinearFamily {
    /// The systems with the right sides `b_0` and `b_1`; beside the `scale` residuals count.
    pub fn new(right_sides: Vec<Vec<f64>>, scale: f64) -> Self {
        let ((directions, images), projected) = (Default::default(), [Mat::new(), Mat::new()]);
        Self { right_sides, scale, directions, images, projected }
    }

    /// Solves the system of one `mu` until the residual is below `tolerance` of the scale or `x`, or round-off lets it fall no more; returns
    /// `x` and the number of directions that `apply` mapped by `A_0` and `A_1`, or none where `most` of them were not enough.
    pub fn solve(
        &mut self,
        mu: f64,
        apply: impl Fn(&[f64]) -> Vec<Vec<f64>>,
        (tolerance, most): (f64, usize),
    ) -> Option<(Vec<f64>, usize)> {
        let (mut taken, mut falling, mut best) = (0, 0, f64::INFINITY);
        loop {
            let (x, mut next) = self.projected_at(mu);
            let left = norm(&next);
            falling = if left < FALLING * best { 0 } else { falling + 1 };
            best = best.min(left);
            let scale = self.scale.max(norm(&x));
            let is_small = best <= ROUND_OFF * scale; // Larger ones may grow for a while.
            if !(left > tolerance * scale) || is_small && falling >= PATIENCE {
                return Some((x, taken));
            }
            // One direction more.
            let before = norm(&next);
            orthogonalize(&mut next, &self.directions);
            let length = norm(&next);
            let least = if is_small { BEYOND * before } else { 0.0 };
            if taken == most || !(length > least) {
                return is_small.then_some((x, taken));
            }
            next.iter_mut().for_each(|v| *v /= length);
            let own = apply(&next);
            self.directions.push(next);
            let count = self.directions.len();
            for ((images, forms), own) in self.images.iter_mut().zip(&mut self.projected).zip(own) {
                images.push(own); // A_p v_j, and v_i . A_p v_j.
                forms.resize_with(count, count, |i, j| dot(&self.directions[i], &images[j]));
            }
            taken += 1;
        }
    }

    /// What the space has of the solution, and the residual.
    fn projected_at(&self, mu: f64) -> (Vec<f64>, Vec<f64>) {
        let (count, [fixed, moving]) = (self.directions.len(), &self.projected);
        let mut residual = self.right_sides[0].clone();
        add(&mut residual, mu, &self.right_sides[1]); // b_0 + mu b_1.
        // V^T (A_0 + mu A_1) V s = V^T b, x = V s.
        let mut shares = Mat::from_fn(count, 1, |i, _| dot(&self.directions[i], &residual));
        let forms = Mat::from_fn(count, count, |i, j| fixed[(i, j)] + mu * moving[(i, j)]);
        DenseLu::factorize(forms).solve_in_place(shares.as_mut());
        let mut x = vec![0.0; residual.len()];
        for (k, direction) in self.directions.iter().enumerate() {
            add(&mut x, shares[(k, 0)], direction);
            add(&mut residual, -shares[(k, 0)], &self.images[0][k]);
            add(&mut residual, -mu * shares[(k, 0)], &self.images[1][k]);
        }
        (x, residual)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// Closed form: the residuals of `0.5 x_i + x_(i-1) = b_i` around a ring grow until the space is the whole one.
    #[test]
    fn a_residual_that_falls_at_the_end_alone_is_waited_for() {
        let count = 30;
        let apply = |x: &[f64]| {
            let before = |i: usize| x[(i + count - 1) % count];
            let row = |i: usize| 0.5 * x[i] + before(i);
            vec![(0..count).map(row).collect(), vec![0.0; count]]
        };
        let mut right_side = vec![0.0; count];
        right_side[0] = 1.0;
        let mut family = LinearFamily::new(vec![right_side.clone(), vec![0.0; count]], 1.0);
        assert!(family.solve(0.0, apply, (1e-14, 20)).is_none());
        let (x, taken) = family.solve(0.0, apply, (1e-14, 20)).unwrap();
        let error = norm(&super::super::dense::difference(&apply(&x)[0], &right_side));
        assert!(error < 1e-14 && taken == 10, "{error:e} {taken}");
    }

    /// Consistency check: the residuals of systems that are not symmetric are as small as asked, and those after the first ask for next to no
    /// products, or for fewer where both sides are not zero.
    #[test]
    fn systems_of_a_family_are_solved_to_round_off_in_one_space() {
        let count = 60;
        let entry = |mu: f64, i: usize, j: usize| {
            let near = f64::from(u8::from(i == j));
            near + 0.3 * mu * ((3 * i + 7 * j) as f64).sin() / (1.0 + (i as f64 - j as f64).abs())
        };
        let times = |mu: f64, x: &[f64]| -> Vec<f64> {
            let row = |i: usize| (0..count).map(|j| entry(mu, i, j) * x[j]).sum();
            (0..count).map(row).collect()
        };
        let calls = Cell::new(0);
        let apply = |x: &[f64]| {
            calls.set(calls.get() + 1);
            let moved = times(1.0, x).iter().zip(x).map(|(own, x)| own - x).collect();
            vec![x.to_vec(), moved]
        };
        let right_side: Vec<f64> = (0..count).map(|i| (i as f64).cos()).collect();
        for moving in [0.0, 5.0] {
            let sides = vec![right_side.clone(), vec![moving; count]];
            let mut family = LinearFamily::new(sides, 8.0);
            let mut products = Vec::new();
            for mu in [1.0, 0.2, 0.6, 1.1] {
                let (x, taken) = family.solve(mu, apply, (1e-14, 60)).unwrap();
                let left = times(mu, &x)
                    .iter()
                    .zip(&right_side)
                    .map(|(a, b)| (a - b - mu * moving).abs())
                    .fold(0.0, f64::max);
                assert!(left < 1e-13, "{mu}: {left:e}");
                assert_eq!(calls.replace(0), taken);
                products.push(taken);
            }
            let most = if moving == 0.0 { 1 } else { 2 * products[0] / 3 }; // Two sides, two Krylov spaces.
            assert!(products[0] < 25, "{products:?}");
            assert!(products[1..].iter().all(|own| *own <= most), "{products:?}");
        }
    }
}
