//! Counts of the modes of a sweep, and the search for those that are missing.

use crate::cea::sparse::*;

/// Friction values up to which modes are counted at each.
const FEW_VALUES: usize = 6;

impl SparseSweep<'_> {
    /// Counts the modes by the argument principle: at each friction value asked for where these are few, else at the first, the middle
    /// and the last one and at each where another number of modes is unstable than before. Where some are missing an independent
    /// iteration searches for them, and `branches` are followed anew. Nothing where no counts are asked for.
    ///
    /// # Errors
    /// Stiffness that depends on frequency; those of the search.
    pub fn count(
        &mut self,
        request: &SweepRequest<'_>,
        branches: Vec<TrackedBranch>,
    ) -> Result<(Vec<TrackedBranch>, Vec<ModeCount>), CeaError> {
        if !request.count_modes {
            return Ok((branches, Vec::new()));
        }
        let counter = ModeCounter::new(self.tangent)?;
        let mut counts = Vec::new();
        for k in self.counted_values() {
            counts.push(self.completed_at(&counter, k)?);
        }
        let has_changed = counts.iter().any(|count| count.recovered > 0);
        let branches = if has_changed { self.track()? } else { branches };
        Ok((branches, counts))
    }

    /// The count at a point, after a search for what was missing.
    fn completed_at(&mut self, counter: &ModeCounter<'_>, k: usize) -> Result<ModeCount, CeaError> {
        let before = self.count_at(counter, k);
        let Ok(missing @ 1..) = before.missing else { return Ok(before) };
        self.builder.search(self.grid[k], TRACKING_MARGIN + missing as usize)?;
        self.solve()?;
        let after = self.count_at(counter, k);
        Ok(ModeCount {
            determinants: before.determinants + after.determinants,
            recovered: after.known.saturating_sub(before.known),
            ..after
        })
    }

    fn counted_values(&self) -> Vec<usize> {
        let all: Vec<usize> = (self.first_asked()..self.grid.len()).collect();
        if all.len() <= FEW_VALUES {
            return all;
        }
        let unstable = |k: usize| {
            let modes = &self.points[k].modes[..self.points[k].wanted];
            let uncertain = self.points[k].checks.iter().map(|check| check.uncertainty);
            let pairs = modes.iter().zip(uncertain);
            pairs.filter(|(mode, relative)| !mode.grows_at_most(*relative)).count()
        };
        let (first, last) = (all[0], all[all.len() - 1]);
        let mut chosen = vec![first, all[all.len() / 2], last];
        chosen.extend(all[1..].iter().filter(|&&k| unstable(k) != unstable(k - 1))); // Where another number of modes grows.
        chosen.sort_unstable();
        chosen.dedup();
        chosen
    }

    fn count_at(&self, counter: &ModeCounter<'_>, k: usize) -> ModeCount {
        let point = &self.points[k];
        let converged = point.modes.iter().zip(&point.checks);
        let converged = converged.filter(|(_, check)| check.residual <= RESIDUAL_BOUND);
        let known: Vec<c64> = converged.map(|(mode, _)| mode.eigenvalue).collect();
        let mut top = upper_end(point, &known, self.limit);
        let mut count = count_below(counter, point, &known, top);
        let highest = highest(point);
        for _ in 0..MOST_ATTEMPTS {
            let above = count.near.filter(|near| near.im > highest);
            // Of the lowest modes one above all that are listed is none.
            let (Some(above), ModeLimit::Lowest(_)) = (above, self.limit) else { break };
            let determinants = count.determinants;
            top = 0.5 * (highest + above.im.min(top)); // Between the highest listed and what is missing.
            count = count_below(counter, point, &known, top);
            count.determinants += determinants;
        }
        count
    }
}

/// The count at a point whose converged modes are `known`, up to the angular frequency `top`.
fn count_below(
    counter: &ModeCounter<'_>,
    point: &SolvedPoint,
    known: &[c64],
    top: f64,
) -> ModeCount {
    let inside: Vec<c64> = known.iter().copied().filter(|own| own.im < top).collect();
    let count = |factor: f64| {
        let region = CountedRegion::about(&inside, top, factor);
        counter.count(point.friction_coefficient, known, &region)
    };
    let mut found = count(1.0);
    // Where an eigenvalue lies on the edge of the region its sides are put elsewhere.
    for factor in [1.37, 0.83] {
        if found.missing.is_err() {
            found = count(factor);
        }
    }
    found
}

/// Highest angular frequency among the modes wanted.
fn highest(point: &SolvedPoint) -> f64 {
    let wanted = &point.modes[..point.wanted];
    wanted.iter().fold(0.0, |m, mode| mode.eigenvalue.im.max(m))
}

/// Angular frequency up to which the modes of a point are counted: the limit where one is given and no known mode is there, else the
/// middle of the first gap above the modes wanted.
fn upper_end(point: &SolvedPoint, known: &[c64], limit: ModeLimit) -> f64 {
    let limit = match limit {
        ModeLimit::MaxFrequency(hz) => TAU * hz,
        ModeLimit::Lowest(_) => highest(point),
    };
    let is_clear = |own: &c64| (own.im - limit).abs() > SAME_EIGENVALUE * limit;
    if known.iter().all(is_clear) {
        return limit;
    }
    let mut above: Vec<f64> = point.modes.iter().map(|mode| mode.eigenvalue.im).collect();
    above.retain(|own| *own >= limit * (1.0 - SAME_EIGENVALUE));
    above.sort_by(f64::total_cmp);
    let mut gaps = above.windows(2);
    let gap = gaps.find(|pair| pair[1] - pair[0] > 4.0 * SAME_EIGENVALUE * pair[1]);
    match gap {
        Some(pair) => 0.5 * (pair[0] + pair[1]),
        None => 1.02 * above.last().copied().unwrap_or(limit), // Nothing is known beyond the last one.
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::Unwatched;
    use crate::cea::sparse::fixtures::string_on_belt;

    /// Consistency check: a mode taken away from one point is counted as missing there, located, and found again, with proportional and
    /// with general damping.
    #[test]
    fn mode_dropped_on_purpose_is_counted_and_recovered() {
        for is_proportional in [true, false] {
            let tangent = string_on_belt(60, 0.4, is_proportional);
            let request = SweepRequest {
                count_modes: true,
                ..SweepRequest::new(&[0.0, 0.1, 0.2, 0.3], ModeLimit::Lowest(6))
            };
            let mut sweep = SparseSweep::prepare(&tangent, (&request, None), &Unwatched).unwrap();
            sweep.cover().unwrap();
            sweep.solve().unwrap();
            let branches = sweep.track().unwrap();
            let counter = ModeCounter::new(&tangent).unwrap();
            assert!(sweep.count_at(&counter, 2).is_complete());
            let lost = sweep.points[2].modes.remove(3).eigenvalue;
            sweep.points[2].checks.remove(3);
            sweep.points[2].wanted -= 1;
            let count = sweep.count_at(&counter, 2);
            assert_eq!(count.missing, Ok(1), "{count:?}");
            let near = count.near.unwrap();
            let top = TAU * count.region.frequencies_hz[1];
            assert!((near - lost).norm() < 5e-3 * top, "{near} {lost}");
            let (branches, counts) = sweep.count(&request, branches).unwrap();
            assert!(counts.iter().all(ModeCount::is_complete), "{counts:?}");
            let recovered: Vec<usize> = counts.iter().map(|count| count.recovered).collect();
            assert_eq!(recovered, [0, 0, 1, 0]);
            let found = sweep.points[2].modes[3].eigenvalue;
            assert!((found - lost).norm() < 1e-9 * lost.norm());
            assert!(branches.len() >= 6);
        }
    }
}
