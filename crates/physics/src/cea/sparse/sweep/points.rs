//! Modes at the friction coefficients of a sweep, each held to its residual in the full matrices, and their vectors.

use crate::cea::sparse::packed::joined;
use crate::cea::sparse::packed::side_by_side;
use crate::cea::sparse::point::ModeCheck;
use crate::cea::sparse::point::normalize;
use crate::cea::sparse::*;
use crate::linalg::vectors::largest;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `|lambda|^2 |M| + |lambda| |C| + |K|` with the `norms` of the three.
fn magnitude([stiff, damped, inert]: [f64; 3], lambda: c64) -> f64 {
    let modulus = lambda.norm();
    modulus * modulus * inert + modulus * damped + stiff
}

/// See [`crate::cea::ComplexMode::uncertainty`]: of a mode with a right vector of unit length.
pub(super) fn uncertainty(norms: [f64; 3], mode: &ReducedMode) -> f64 {
    let lambda = mode.eigenvalue;
    f64::EPSILON * magnitude(norms, lambda) * length(&mode.left) / lambda.norm() // Of |x| = 1 and w^T T' x = 1.
}

impl SparseSweep<'_> {
    pub(super) fn solve_points(&self, indices: &[usize]) -> Result<Vec<SolvedPoint>, LinalgError> {
        let solved = AtomicUsize::new(0);
        crate::parallel::map(indices, |&k| {
            let point = self.solve_point(k);
            self.watch.reached(SweepProgress {
                stage: SweepStage::Values,
                solved: solved.fetch_add(1, Ordering::Relaxed) + 1,
                total: indices.len(),
            });
            point
        })
    }

    /// Point `k` in the basis as it is, or what an earlier run of the same sweep found there.
    fn solve_point(&self, k: usize) -> Result<SolvedPoint, LinalgError> {
        let (mu, leaves_out) = (self.grid[k], self.leaves_out[k]);
        let stage = if leaves_out { "-left-out" } else { "" };
        let (steps, held) = (self.builder.steps, self.builder.count);
        let name = format!("modes-{steps:04}-of-{held}-{mu:?}{stage}"); // The number of steps tells the state of the basis.
        let modes = match self.watch.recalled::<Vec<_>>(&name) {
            Some(kept) => kept.into_iter().map(ReducedMode::recalled).collect(),
            None => {
                let modes = self.modes(mu, leaves_out)?;
                let kept: Vec<_> = modes.iter().map(ReducedMode::kept).collect();
                self.watch.keep_value(&name, &kept);
                modes
            }
        };

        // What they are in the full matrices.
        let frequencies = modes.iter().map(|mode| mode.eigenvalue.im);
        let wanted = self.limit.selected(frequencies);
        let range_end = match self.limit {
            ModeLimit::Lowest(_) => modes[..wanted].last().map_or(0.0, |mode| mode.eigenvalue.im),
            ModeLimit::MaxFrequency(hz) => TAU * hz,
        };
        let checked = self.builder.count.max(wanted).min(modes.len()); // Those held beyond the wanted ones, too.
        let checks = self.check(mu, &modes[..checked]);
        Ok(SolvedPoint {
            friction_coefficient: mu,
            modes,
            wanted,
            checks,
            range_end,
            is_followed: self.followed.contains(&mu),
            has_coarse_lefts: true,
        })
    }

    /// The modes of the projected problem at `mu`. Left vectors are coarse ones, until [`SolvedPoint::refine_lefts`]. With `leaves_out`
    /// motions near critical damping that have not converged take no places: combinations of what the basis does not hold.
    fn modes(&self, mu: f64, leaves_out: bool) -> Result<Vec<ReducedMode>, LinalgError> {
        let count = self.builder.count + TRACKING_MARGIN;
        let mut modes = self.builder.model.solve_with_coarse_lefts(mu, count)?;
        if leaves_out {
            let checks = self.check(mu, &modes);
            let mut converged = checks.iter().map(|check| check.residual <= RESIDUAL_BOUND);
            modes.retain(|mode| converged.next() == Some(true) || !mode.is_nearly_critical());
        }
        Ok(modes)
    }

    /// Residuals and edge displacements of `modes` in the full matrices at `mu`.
    pub(super) fn check(&self, mu: f64, modes: &[ReducedMode]) -> Vec<ModeCheck> {
        let model = &self.builder.model;
        let matrices = StructureMatrices::at(self.tangent, self.linearization, mu);
        let norms = matrices.norms();
        let mut checks = Vec::with_capacity(modes.len());
        for group in modes.chunks(GROUP_WIDTH / 2) {
            let own: Vec<&Vec<c64>> = group.iter().map(|mode| &mode.right).collect();
            let x = model.expand(side_by_side(model.dimension(), &own).as_ref());
            let values = group.iter().map(|mode| mode.eigenvalue);
            let (residuals, momenta) = matrices.residuals_and_momenta(values, x.as_ref());
            checks.extend(group.iter().enumerate().map(|(k, mode)| {
                let lambda = mode.eigenvalue;
                let [residual, momentum, shape] =
                    [&residuals, &momenta, &x].map(|own| joined(own, k));
                let force = matrices.residual_factor(lambda) * length(&residual); // |T(lambda) x|.
                let inertia = self.linearization.inertia(lambda) * length(&momentum); // (|lambda|^2 + c^2) |M x|.
                let scale = magnitude(norms, lambda);
                ModeCheck {
                    residual: force / (scale * length(&shape)),
                    force_residual: force / inertia,
                    uncertainty: uncertainty(norms, mode),
                    contact_share: self.contact_share(&shape, &momentum),
                    edge: self.edge.restrict(|unknown| shape[unknown]),
                    peak: largest(&shape),
                }
            }));
        }
        checks
    }

    /// Kinetic energy of the contact edge's nodes over the whole. `momentum` is `M(mu) x`, which differs from
    /// that of the body alone, `M(0) x`, in the rows of these nodes.
    fn contact_share(&self, x: &[c64], momentum: &[c64]) -> f64 {
        let mass = &self.tangent.mass;
        let (pattern, values) = (mass.pattern(), &mass.coefficients()[0]);
        let along = |i: usize, p: c64| x[i].re * p.re + x[i].im * p.im; // Re(conj x p).
        let (mut edge, mut friction) = (0.0, 0.0);
        let contact = &self.tangent.contact;
        let touched = [&contact.tangential, &contact.normal, &contact.opposite];
        for &i in touched.into_iter().flatten() {
            let row = pattern.row(i);
            let own: c64 = row.map(|(position, j)| x[j] * values[position]).sum();
            edge += along(i, own);
            friction += along(i, momentum[i] - own);
        }
        let whole: f64 = (0..pattern.dimension()).map(|i| along(i, momentum[i])).sum();
        edge / (whole - friction) // Over x^H M(0) x.
    }

    /// Adds to the basis what left vectors of the wanted modes at point `k` lack, to three digits of these or more.
    pub(super) fn sharpen_lefts(&mut self, k: usize) {
        let (mu, point) = (self.grid[k], &mut self.points[k]);
        if mu == 0.0 {
            return; // The matrices are symmetric there, but for gyroscopic forces.
        }
        let wanted = &mut point.modes[..point.wanted];
        for _ in 0..2 {
            // A round leaves a tenth to a hundredth.
            if self.builder.correct(&[(mu, wanted)], &[true], true) {
                self.builder.model.refine_lefts(wanted, mu);
            }
        }
    }

    /// Right vectors and, if asked for, left ones of `modes` at `mu` over all nodal dofs, see [`ModeVectors`].
    pub(super) fn vectors(
        &self,
        (mu, with_lefts): (f64, bool),
        modes: &[ReducedMode],
    ) -> Vec<ModeVectors> {
        let (model, sides) = (&self.builder.model, if with_lefts { 2 } else { 1 });
        let groups = modes.chunks(GROUP_WIDTH / 4).flat_map(|group| {
            let both = group.iter().map(|mode| [&mode.right, &mode.left]);
            let own: Vec<&Vec<c64>> = both.flat_map(|own| own.into_iter().take(sides)).collect();
            let x = model.expand(side_by_side(model.dimension(), &own).as_ref());
            group.iter().enumerate().map(move |(j, mode)| {
                let mut right = self.tangent.displacement(&joined(&x, sides * j));
                let scale = normalize(&mut right);
                let mut left = Vec::new();
                if with_lefts {
                    left = self.tangent.left_displacement(&joined(&x, sides * j + 1), mu);
                    left.iter_mut().for_each(|v| *v *= scale); // w^T (2 lambda M + C) x stays 1.
                }
                ModeVectors { eigenvalue: mode.eigenvalue, rate: mode.derivative, right, left }
            })
        });
        groups.collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::{mode_pairs, sweep};
    use crate::cea::{ModeLimit, SweepRequest, Unwatched};
    use crate::linalg::c64;
    use crate::linalg::vectors::{dot, length};

    /// Independent check: inverse iteration in the full problem, of strings whose basis does not hold all motions.
    #[test]
    fn left_vectors_are_those_of_the_full_problem() {
        for is_proportional in [false, true] {
            let (tangent, mu) = (string_on_belt(400, 0.4, is_proportional), [0.3]);
            let request = SweepRequest {
                shapes_at: &mu,
                lefts_at: Some(0.3),
                ..SweepRequest::new(&mu, ModeLimit::Lowest(12))
            };
            let found = sweep(&tangent, &request, &Unwatched).unwrap();
            let modes = &found.points[0].modes;
            let values: Vec<c64> = modes.iter().map(|mode| mode.eigenvalue).collect();
            for (mode, exact) in modes.iter().zip(mode_pairs(&tangent, mu[0], &values)) {
                let (left, exact) = (mode.left.as_deref().unwrap(), exact.unwrap().left);
                let cosine = dot(left, &exact).norm() / (length(left) * length(&exact));
                let away = 1.0 - cosine * cosine;
                assert!(away < 1e-6, "{is_proportional} {}: {away}", mode.eigenvalue);
            }
        }
    }
}
