//! Where steady sliding loses its static stability: a motion grows there without oscillating.

use crate::cea::sparse::branches::BranchEnd;
use crate::cea::sparse::linearization::shifted_stiffness;
use crate::cea::sparse::*;
use crate::linalg::Bracket;

impl SparseSweep<'_> {
    /// From where on a motion grows without oscillating, as an interval of the branch 0 and the frequency 0.
    ///
    /// `det K(mu)` has the sign of `(-1)^n` with `n` positive real eigenvalues: it changes where one passes zero. A mode that friction
    /// takes to frequency zero becomes two of them, so the ends of branches are where to look; a sweep may begin so. What is
    /// damped beyond the critical at rest has no branch: the sign at the last friction tells of it.
    ///
    /// # Errors
    /// If the analysis of the pattern fails.
    pub fn divergence(&self, all: &[TrackedBranch]) -> Result<Option<UnstableInterval>, CeaError> {
        if self.tangent.is_tabled() {
            return Ok(None);
        }
        let (start, first) = (self.grid[0], self.grid[self.first_asked()]);
        // At rest all is held by positive stiffness.
        let is_held = start == 0.0 && !self.is_unheld;
        let at_start = if is_held { 1.0 } else { self.sign_at(start)? };
        let is_unstable = (self.is_continued || self.is_unheld) && {
            let at_first = if first == start { at_start } else { self.sign_at(first)? };
            at_first < 0.0 || self.builder.model.static_growth(first)? > 1 // Of two the determinant has no sign.
        };
        let ends = all.iter().filter_map(|branch| branch.end.as_ref()?.diverges_at);
        let mut place = ends.chain(is_unstable.then_some(first)).min_by(f64::total_cmp);
        let after = &self.grid[1..];
        let last = &after[after.len().saturating_sub(1)..];
        if place.is_none() && self.sign_change((start, at_start), last)?.is_some() {
            place = self.sign_change((start, at_start), after)?;
        }
        Ok(place.map(|mu| mu.max(first)).map(|critical_friction| UnstableInterval {
            critical_friction,
            unstable_from_start: critical_friction == first,
            ..UnstableInterval::default()
        }))
    }

    /// Where, as a branch ends, `det K` changes its sign.
    pub(super) fn diverges_at(&self, end: &BranchEnd) -> Result<Option<f64>, CeaError> {
        if self.tangent.is_tabled() {
            return Ok(None);
        }
        let (low, beyond) = (end.seen.mu, end.lost_at);
        // Near zero the square of an eigenvalue moves evenly: as far again. What is damped beyond the critical may come there later.
        let ReducedMode { eigenvalue, derivative, .. } = end.seen.mode;
        let next = self.grid[if end.is_damped { self.grid.len() - 1 } else { end.after + 1 }];
        let reach = (low - (eigenvalue / derivative).re).clamp(beyond, next);
        let places = &[beyond, reach, next][..2 + usize::from(end.is_damped)];
        let place = self.sign_change((low, self.sign_at(low)?), places)?;
        let may_meet = eigenvalue.re > 0.0 && !self.tangent.is_lossy();
        Ok(if may_meet { self.meeting(low, [beyond, next])?.or(place) } else { place })
    }

    /// Where a growing mode and its conjugate meet and become two motions that grow without oscillating, which leave the determinant its sign.
    fn meeting(&self, mut low: f64, places: [f64; 2]) -> Result<Option<f64>, CeaError> {
        let grown = |mu: f64| self.builder.model.static_growth(mu);
        let two_more = grown(low)? + 2;
        for mut high in places {
            if grown(high)? < two_more {
                continue;
            }
            while high - low > SETTLED * (1.0 + high) {
                let middle = 0.5 * (low + high);
                let is_before = grown(middle)? < two_more;
                *(if is_before { &mut low } else { &mut high }) = middle;
            }
            return Ok(Some(high));
        }
        Ok(None)
    }

    /// Where `det K` changes from its sign at a friction coefficient, on the way to some places.
    fn sign_change(&self, from: (f64, f64), places: &[f64]) -> Result<Option<f64>, CeaError> {
        let ((mut low, before), mut places) = (from, places.iter());
        let (high, after) = loop {
            let Some(&high) = places.next() else { return Ok(None) };
            let after = self.ln_static(high)?;
            if before * after.im.cos() < 0.0 {
                break (high, after);
            }
            low = high;
        };
        // With signs, where products of two would be beyond the range of numbers.
        let before = self.ln_static(low)?;
        let size = before.re.max(after.re);
        let scaled = |ln: c64| ln.im.cos() * (ln.re - size).clamp(-300.0, 300.0).exp();
        let mut bracket = Bracket::new([(low, scaled(before)), (high, scaled(after))]);
        while bracket.width() > SETTLED * (1.0 + high) {
            bracket.narrow(|mu| Ok::<_, CeaError>(scaled(self.ln_static(mu)?)))?;
        }
        Ok(Some(bracket.middle()))
    }

    /// Sign of `det K(mu)`.
    fn sign_at(&self, mu: f64) -> Result<f64, CeaError> {
        Ok(self.ln_static(mu)?.im.cos()) // Im ln is pi where it is negative.
    }

    /// `ln det K(mu)`, or `ln det T(s)` where `s` tells growth from rigid motions; minus infinity where there are no factors.
    fn ln_static(&self, mu: f64) -> Result<c64, CeaError> {
        let growth = self.linearization.least_growth();
        let values = shifted_stiffness(self.tangent, mu, [growth, growth * growth]); // K + s C + s^2 M.
        let found = SparseLu::ln_determinant(self.builder.factors.analysis(), &values);
        Ok(found.unwrap_or(c64::new(f64::NEG_INFINITY, 0.0)))
    }
}

#[cfg(test)]
mod tests {
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::sweep;
    use crate::cea::{ModeLimit, SweepRequest};
    use crate::fem::DofMap;
    use crate::linalg::MatrixPolynomial;
    use crate::prestress::{LossGain, SlidingTangent};
    use std::sync::Arc;

    /// Independent check: a string on springs that friction takes away, which grows beyond without oscillating. Losses of two of the
    /// springs between masses that push each other give that an imaginary part: it is no mode. Growth begins a little before the determinant
    /// of the stiffness vanishes, as losses have it.
    #[test]
    fn a_lossy_motion_that_grows_without_oscillating_is_no_mode() {
        let mut tangent = string_on_belt(60, 1.0, false);
        let pattern = Arc::clone(tangent.stiffness.pattern());
        let springs = [28, 30].into_iter().flat_map(|i| {
            let pair = [i, i + 1].into_iter().flat_map(move |j| [(i, j), (i + 1, j)]);
            pair.map(|(j, k)| (j, k, if j == k { 0.5 } else { -0.5 }))
        });
        let lost = MatrixPolynomial::on_pattern(&pattern, &[springs.collect()]);
        tangent.losses = vec![(LossGain(None), lost)];
        let softened = (20..40).map(|i| (i, i, -1.0)).collect();
        let added = MatrixPolynomial::on_pattern(&pattern, &[Vec::new(), softened]);
        tangent.stiffness = MatrixPolynomial::combination(1.0, &tangent.stiffness, 1.0, &added);

        let frictions = [0.0, 0.02, 0.05, 0.1, 0.15];
        let request = SweepRequest::new(&frictions, ModeLimit::Lowest(8));
        let found = sweep(&tangent, &request, &|_| {}).unwrap();
        for mode in found.points.iter().flat_map(|point| &point.modes) {
            assert!(mode.eigenvalue.re < mode.eigenvalue.im, "{}", mode.eigenvalue);
        }
        // The pivots of the tridiagonal matrix.
        let is_stable = |mu: f64| {
            let mut pivot = f64::INFINITY;
            (0..60).all(|i| {
                let own = if (20..40).contains(&i) { 2.01 - mu } else { 2.01 };
                pivot = own - if i % 2 == 1 { 1.0 - mu } else { 1.0 } / pivot;
                pivot > 0.0
            })
        };
        let critical = found.intervals.iter().map(|own| own.critical_friction);
        let critical = critical.fold(f64::INFINITY, f64::min);
        assert!(is_stable(0.97 * critical) && !is_stable(1.03 * critical), "{critical}");
    }

    /// A string on springs that friction takes away amid it, with one end damped, and pairs of masses that nothing holds.
    fn softened_string(pairs: usize, is_proportional: bool) -> SlidingTangent {
        let count = 60 + 2 * pairs;
        let mut tangent = string_on_belt(60, 0.0, is_proportional);
        let mut elastic: Vec<(usize, usize, f64)> = (0..60).map(|i| (i, i, 2.01)).collect();
        elastic.extend((1..60).flat_map(|i| [(i - 1, i, -1.0), (i, i - 1, -1.0)]));
        elastic.extend((60..count).map(|i| (i, i, 1.0)));
        elastic.extend((60..count).map(|i| (i, i ^ 1, -1.0)));
        let softened = (20..40).map(|i| (i, i, -1.0)).collect();
        tangent.stiffness = MatrixPolynomial::from_triplets(count, &[elastic, softened]);
        let diagonal = |count: usize, value: f64| {
            let entries = (0..count).map(|i| (i, i, value)).collect();
            MatrixPolynomial::on_pattern(tangent.stiffness.pattern(), &[entries])
        };
        tangent.mass = diagonal(count, 1.0);
        tangent.damping = match is_proportional {
            true => MatrixPolynomial::combination(1e-3, &tangent.mass, 1e-3, &tangent.stiffness),
            false => diagonal(10, 1e-2),
        };
        tangent.unknowns = DofMap::excluding(count, []);
        tangent
    }

    /// Independent check: dashpots on the springs that friction takes away leave `det K`, hence the friction at which it passes zero,
    /// but what grows beyond does not oscillate at rest either.
    #[test]
    fn static_stability_is_lost_at_the_same_friction_by_an_overdamped_motion() {
        let critical = |tangent: &SlidingTangent| {
            let frictions = [0.0, 0.02, 0.05, 0.1, 0.15];
            let request = SweepRequest::new(&frictions, ModeLimit::Lowest(8));
            let found = sweep(tangent, &request, &|_| {}).unwrap();
            let mut modes = found.points.iter().flat_map(|point| &point.modes);
            assert!(modes.all(|mode| mode.eigenvalue.re < 0.0));
            found.intervals.iter().find(|own| own.branch == 0).map(|own| own.critical_friction)
        };
        let mut tangent = softened_string(0, false);
        let undamped = critical(&tangent).expect("a branch ends there");
        let dashpots = (15..45).map(|i| (i, i, 10.0)).collect();
        tangent.damping = MatrixPolynomial::on_pattern(tangent.stiffness.pattern(), &[dashpots]);
        let overdamped = critical(&tangent).expect("it diverges");
        assert!((overdamped - undamped).abs() < 1e-9, "{overdamped} {undamped}");
    }

    #[test]
    fn static_stability_is_lost_at_the_same_friction_beside_bodies_that_move_freely() {
        let frictions = [0.0, 0.02, 0.05, 0.1, 0.15];
        for is_proportional in [true, false] {
            let critical = [0, 1, 2].map(|pairs| {
                let tangent = softened_string(pairs, is_proportional);
                let request = SweepRequest::new(&frictions, ModeLimit::Lowest(8));
                let found = sweep(&tangent, &request, &|_| {}).unwrap();
                assert_eq!(found.rigid_motions, pairs);
                let mut statically = found.intervals.iter().filter(|own| own.branch == 0);
                statically.next().expect("it diverges").critical_friction
            });
            let apart = critical.map(|own| (own - critical[0]).abs());
            assert!(apart.iter().all(|own| *own < 1e-9), "{critical:?}");
        }
    }
}
