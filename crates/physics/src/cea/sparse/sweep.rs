//! The stages of a sweep.

mod counts;
mod divergence;
mod ladder;
mod onset;
mod points;
mod results;

use super::basis::BasisBuilder;
use super::branches::{BranchLabel, label_first, track};
use super::edge::ContactEdge;
use super::frictionless::FrictionlessModes;
use crate::cea::PartWatch;
use crate::cea::sparse::*;
use std::borrow::Cow;

/// Complex modes of `tangent` at every friction coefficient of `request`, and where their branches turn unstable.
///
/// Oscillating modes of lowest natural frequency only: overdamped motions, and modes whose eigenvalue is far from the origin because of
/// damping alone, are not searched. Friction values are solved in parallel on the current rayon pool; the result is the same, bit for bit,
/// for any number of threads, and whether `watch` kept a part of it from an earlier run or not.
///
/// Points come in the order given; repeated values are computed once.
///
/// # Errors
/// [`CeaError`]: a bad request, a mode count that the inertia contradicts, a pair above the residual bound, a lost branch.
pub fn sweep(
    tangent: &SlidingTangent,
    request: &SweepRequest<'_>,
    watch: &dyn SweepWatch,
) -> Result<FrictionSweep, CeaError> {
    sweep_sharing(tangent, request, None, watch)
}

/// [`sweep`] of nearly the same body as one whose modes without friction are known: they serve for its own.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_sharing(
    tangent: &SlidingTangent,
    request: &SweepRequest<'_>,
    rest: Option<&FrictionlessModes>,
    watch: &dyn SweepWatch,
) -> Result<FrictionSweep, CeaError> {
    let tangent = referred(tangent, request.limit)?;
    sweep_holding(&tangent, (request, rest), (request.limit, GUARD_MODES), watch)
}

/// [`sweep`] from the modes within `limit` without friction, those wanted there at least; where it does not do with them, from `more`,
/// and from twice as many more each time.
fn sweep_holding(
    tangent: &SlidingTangent,
    (request, rest): (&SweepRequest<'_>, Option<&FrictionlessModes>),
    (limit, more): (ModeLimit, usize),
    watch: &dyn SweepWatch,
) -> Result<FrictionSweep, CeaError> {
    let own = SweepRequest { limit, ..*request };
    let mut sweep = SparseSweep::prepare(tangent, (&own, rest), watch)?;
    sweep.limit = request.limit;
    sweep.cover()?;
    sweep.solve()?;
    let mut branches = None;
    if !sweep.lacks_modes() {
        let tracked = sweep.track()?;
        let is_complete = !sweep.lacks_modes() && !sweep.lacks_places(&tracked)?;
        branches = is_complete.then_some(tracked);
    }
    let Some(branches) = branches else {
        let held = sweep.builder.count;
        let watch = PartWatch { whole: watch, prefix: format!("of-{held}-"), is_heard: true };
        let limit = ModeLimit::Lowest((held + more).min(sweep.elastic()));
        return sweep_holding(tangent, (request, None), (limit, 2 * more), &watch);
    };
    if let ModeLimit::MaxFrequency(limit_hz) = request.limit
        && sweep.points.iter().all(|point| point.wanted == 0)
    {
        let lowest = sweep.points.iter().filter_map(|point| point.modes.first());
        let lowest = lowest.map(|mode| mode.eigenvalue.im).reduce(f64::min);
        let lowest_hz = lowest.map_or(f64::NAN, |own| own / TAU);
        return Err(CeaError::NoModes { limit_hz, lowest_hz });
    }
    let (branches, counts) = sweep.count(request, branches)?;
    let found = sweep.finish(request, &branches)?;
    Ok(FrictionSweep { counts, ..found })
}

/// The tangent with its stiffness as it is at about the highest frequency wanted, where it depends on frequency: below that, as many
/// modes lie there as the problem frozen at it has.
fn referred(
    tangent: &SlidingTangent,
    limit: ModeLimit,
) -> Result<Cow<'_, SlidingTangent>, CeaError> {
    if !tangent.is_tabled() {
        return Ok(Cow::Borrowed(tangent));
    }
    limit.check()?;
    match limit {
        ModeLimit::MaxFrequency(limit_hz) => Ok(Cow::Owned(tangent.referred_to(limit_hz))),
        ModeLimit::Lowest(count) => {
            let (mut referred, mut highest_hz) = (tangent.clone(), 0.0);
            for _ in 0..MOST_ATTEMPTS {
                let modes = FrictionlessModes::compute(&referred, limit)?;
                let place = count.min(modes.frequencies.len()) - 1;
                let found_hz = modes.frequencies[place] / TAU;
                referred = tangent.referred_to(found_hz);
                if (found_hz - highest_hz).abs() <= (CHANGE_PLACES - 1.0) * found_hz {
                    break;
                }
                highest_hz = found_hz;
            }
            Ok(Cow::Owned(referred))
        }
    }
}

/// Steps of the friction values between two whose modes the basis holds, up to which their points are solved at once.
const MOST_BETWEEN_SAMPLES: usize = 3;

/// The stages of [`sweep`], in order.
pub struct SparseSweep<'a> {
    tangent: &'a SlidingTangent,
    linearization: Linearization,
    limit: ModeLimit,
    edge: ContactEdge,
    /// Of `K`, `C` and `M` without friction, see [`StructureMatrices::norms`].
    norms: [f64; 3],
    builder: BasisBuilder<'a>,
    /// Friction coefficients, ascending, 0 first unless the sweep is continued.
    grid: Vec<f64>,
    /// Smallest friction coefficient asked for.
    lowest: f64,
    /// Friction coefficients at which branches are only followed, see [`SweepRequest::followed_at`].
    followed: Vec<f64>,
    /// Whether branches begin at the first friction coefficient asked for.
    is_continued: bool,
    /// Whether at rest a stiffness that is not positive leaves motions unheld.
    is_unheld: bool,
    points: Vec<SolvedPoint>,
    /// Points where motions near critical damping that do not converge are left out.
    leaves_out: Vec<bool>,
    /// The modes that no iteration made converge, which are not listed.
    unconverged: Vec<UnconvergedMode>,
    labels: Vec<BranchLabel>,
    watch: &'a dyn SweepWatch,
}

impl<'a> SparseSweep<'a> {
    /// Computes the frictionless modes, where the sweep starts.
    pub fn prepare(
        tangent: &'a SlidingTangent,
        (request, rest): (&SweepRequest<'_>, Option<&FrictionlessModes>),
        watch: &'a dyn SweepWatch,
    ) -> Result<Self, CeaError> {
        let mut grid = request.rising_grid()?;
        request.limit.check()?;
        let lowest = grid[0];
        let modes = FrictionlessModes::compute_watched(tangent, (request.limit, rest), watch)?;
        // What structural damping leaves of rigid motions is recognised by following them from rest.
        let is_continued = request.is_continued && !(tangent.is_lossy() && modes.rigid > 0);
        if lowest > 0.0 && !is_continued {
            grid.insert(0, 0.0);
        }
        let highest = modes.frequencies.last().copied().unwrap_or(1.0); // Without any mode every scale will do.
        let linearization = Linearization::of(tangent, highest, modes.centre);
        let vectors = (&modes.vectors, modes.rigid);
        Ok(Self {
            tangent,
            linearization,
            limit: request.limit,
            edge: ContactEdge::of(tangent),
            norms: StructureMatrices::at(tangent, linearization, 0.0).norms(),
            builder: BasisBuilder::new(tangent, linearization, vectors, modes.factors, watch),
            leaves_out: vec![false; grid.len()],
            grid,
            lowest,
            // With other than viscous damping errors of eigenvalues are not of second order.
            followed: if tangent.is_lossy() { Vec::new() } else { request.followed_at.to_vec() },
            is_continued,
            is_unheld: modes.frequencies.first() == Some(&0.0),
            points: Vec::new(),
            unconverged: Vec::new(),
            labels: Vec::new(),
            watch,
        })
    }

    /// Grows the basis over the whole range of friction coefficients.
    pub fn cover(&mut self) -> Result<(), CeaError> {
        if self.builder.is_whole {
            return Ok(());
        }
        let is_reduced = matches!(self.linearization, Linearization::Reduced(..));
        if !self.is_continued && (self.lowest > 0.0 || is_reduced) {
            self.builder.begin_at_rest()?;
        }
        // Where branches are only followed corrections do, from modes at one place.
        let all = &self.grid[self.first_asked()..];
        let mut asked: Vec<f64> =
            all.iter().copied().filter(|mu| !self.followed.contains(mu)).collect();
        if asked.is_empty() {
            asked.push(all[all.len() / 2]);
        }
        let mut open: Vec<f64> = Vec::new();
        for mu in [asked[asked.len() - 1], asked[0], asked[asked.len() / 2]] {
            open.extend((!self.builder.is_sampled(mu) && !open.contains(&mu)).then_some(mu));
        }
        self.builder.sample(&open)?;
        self.fill_gaps()
    }

    /// Takes up the modes at the middle of a wide gap between those that the basis holds, where these do not converge there, and so in its
    /// halves: one point says what all points of a gap need.
    fn fill_gaps(&mut self) -> Result<(), CeaError> {
        let mut seen: Vec<usize> = Vec::new();
        loop {
            let is_held = |k: &usize| self.builder.is_sampled(self.grid[*k]);
            let held: Vec<usize> = (self.first_asked()..self.grid.len()).filter(is_held).collect();
            let wide = held.windows(2).filter(|ends| ends[1] - ends[0] > MOST_BETWEEN_SAMPLES);
            let middles = wide.map(|ends| (ends[0] + ends[1]) / 2);
            let middles: Vec<usize> = middles.filter(|k| !seen.contains(k)).collect(); // Each of them once.
            if middles.is_empty() {
                return Ok(());
            }
            let points = middles.iter().zip(self.solve_points(&middles)?);
            let open = points.filter(|(_, own)| own.open_modes(self.goal()).next().is_some());
            let open: Vec<f64> = open.map(|(&k, _)| self.grid[k]).collect();
            self.builder.sample(&open)?;
            seen.extend(middles);
        }
    }

    /// Index of the first friction value asked for; before it there is only 0, where branches begin.
    fn first_asked(&self) -> usize {
        self.grid.partition_point(|&mu| mu < self.lowest)
    }

    /// Motions of the body that are not rigid.
    fn elastic(&self) -> usize {
        self.tangent.unknowns.len() - self.builder.rigid
    }

    /// Whether friction brings modes from above a limit in frequency: there may be more where all that are held lie below.
    fn lacks_modes(&self) -> bool {
        let held = self.builder.count;
        let is_full = self.points.iter().any(|point| point.wanted >= held); // All that are held are wanted: there may be more.
        matches!(self.limit, ModeLimit::MaxFrequency(_)) && is_full && held < self.elastic()
    }

    /// Whether what grows without oscillating has taken the places of modes, of which a number is asked for.
    fn lacks_places(&self, branches: &[TrackedBranch]) -> Result<bool, CeaError> {
        let least = self.points.iter().map(|point| point.wanted).min();
        let is_short = matches!(self.limit, ModeLimit::Lowest(count) if least < Some(count));
        let may_hold_more = is_short && self.builder.count < self.elastic();
        Ok(may_hold_more && self.divergence(branches)?.is_some())
    }

    /// Solves all points, and grows the basis where a mode misses its residual.
    pub fn solve(&mut self) -> Result<(), CeaError> {
        self.points = self.solve_points(&(0..self.grid.len()).collect::<Vec<usize>>())?;
        self.climb_all()?;
        self.check_tables()?;
        self.unconverged.clear();
        for k in self.first_asked()..self.grid.len() {
            let (mu, point) = (self.grid[k], &self.points[k]);
            if point.converged() < point.wanted {
                let above = self.check(mu, &point.modes[point.checks.len()..]); // They may take the places of those that are left out.
                self.points[k].checks.extend(above);
            }
            let dropped = self.points[k].drop_unconverged(self.limit);
            self.unconverged.extend(dropped.into_iter().map(|own| UnconvergedMode::of(mu, own)));
        }
        let model = &self.builder.model;
        crate::parallel::map::<_, _, ()>(&mut self.points, |point| point.refine_lefts(model)); // Only now, as left vectors are dear.
        self.labels =
            label_first(&mut self.points[0], &self.builder.model, &self.edge, self.builder.count)?;
        Ok(())
    }

    /// Refuses modes whose stiffness follows from a table that does not reach them, or that changes too fast for them.
    fn check_tables(&self) -> Result<(), CeaError> {
        for point in &self.points[self.first_asked()..] {
            for (mode, check) in point.modes.iter().zip(&point.checks).take(point.wanted) {
                let frequency_hz = mode.eigenvalue.im / TAU;
                if let Some(table) = self.tangent.table_without(frequency_hz) {
                    let mu = point.friction_coefficient;
                    return Err(CeaError::beyond_table(table, mu, frequency_hz));
                }
                let is_unsettled = !(check.residual <= RESIDUAL_BOUND);
                if let Some((gain, _)) = self.tangent.tabled().next().filter(|_| is_unsettled) {
                    let (mu, residual) = (point.friction_coefficient, check.residual);
                    let key = &gain.table.key;
                    return Err(CeaError::Failed(format!(
                        "at friction coefficient {mu} the mode at about {frequency_hz:.1} Hz does \
                         not settle at a frequency of its own (relative residual {residual:.1e}). \
                         The modulus of {key} changes too fast there: give its table more rows \
                         or smooth it"
                    )));
                }
            }
        }
        Ok(())
    }

    /// Continues all branches from the first point. Where one is lost the basis takes up, of the quadratic problem, modes at
    /// more friction coefficients about that place; in the end an independent iteration searches for it. A branch that stays lost
    /// ends there, and a note says so.
    pub fn track(&mut self) -> Result<Vec<TrackedBranch>, CeaError> {
        let mut searched = Vec::new();
        loop {
            let (model, edge) = (&self.builder.model, &self.edge);
            let mut branches = track(&self.points, model, edge, &self.labels)?;
            for end in branches.iter_mut().filter_map(|branch| branch.end.as_mut()) {
                end.diverges_at = self.diverges_at(end)?;
            }
            let ends = branches.iter().filter_map(|branch| branch.end.as_ref());
            let lost = ends.filter(|end| end.is_lost() && !searched.contains(&end.after));
            let mut open: Vec<(usize, [f64; 2])> =
                lost.map(|end| (end.after, [end.seen.mu, end.lost_at])).collect();
            open.sort_by_key(|(k, _)| *k);
            open.dedup_by_key(|(k, _)| *k);
            if open.is_empty() || self.builder.is_whole {
                return Ok(branches);
            }
            for (k, [seen_at, lost_at]) in open {
                let (from, to) = (self.grid[k], self.grid[k + 1]);
                if !self.builder.improve_between(from, to, 0.5 * (seen_at + lost_at))? {
                    searched.push(k); // The last resort, once for each interval.
                    self.builder.search(to, TRACKING_MARGIN)?;
                }
            }
            self.solve()?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::Unwatched;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::linearization::Centre;
    use crate::linalg::{LuAnalysis, SparseLu};

    /// Consistency check: a mode taken away from one point is missed by the tracking and found again, with proportional
    /// and with general damping.
    #[test]
    fn deliberately_lost_mode_is_found_again() {
        for is_proportional in [true, false] {
            let tangent = string_on_belt(200, 0.4, is_proportional);
            let request = SweepRequest::new(&[0.0, 0.1, 0.2, 0.3], ModeLimit::Lowest(6));
            let mut sweep = SparseSweep::prepare(&tangent, (&request, None), &Unwatched).unwrap();
            sweep.cover().unwrap();
            sweep.solve().unwrap();
            let complete = sweep.points[2].modes.len();
            let lost = sweep.points[2].modes.remove(3);
            sweep.points[2].checks.remove(3);
            sweep.points[2].wanted -= 1;
            let branches = sweep.track().unwrap();
            assert!(sweep.points[2].modes.len() >= complete);
            let found = sweep.points[2].modes[3].eigenvalue;
            assert!((found - lost.eigenvalue).norm() < 1e-9 * found.norm());
            let is_whole = |b: &TrackedBranch| b.modes.iter().all(Option::is_some);
            assert!(branches.iter().take(6).all(is_whole));
        }
    }

    /// Consistency check: modes withheld from the basis are found by the independent search.
    #[test]
    fn search_finds_modes_that_the_basis_never_held() {
        let tangent = string_on_belt(200, 0.4, true);
        let modes = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(6)).unwrap();
        let linearization = Linearization::of(&tangent, 1.0, Centre::default());
        let without_second = crate::linalg::dense::pick_columns(&modes.vectors, &[0, 2, 3, 4, 5]);
        let mut builder = BasisBuilder::new(
            &tangent,
            linearization,
            (&without_second, 0),
            modes.factors,
            &Unwatched,
        );
        let before = builder.model.solve_with_coarse_lefts(0.2, 5).unwrap();
        builder.search(0.2, 2).unwrap();
        let after = builder.model.solve_with_coarse_lefts(0.2, 5).unwrap();
        let analysis = LuAnalysis::new(tangent.stiffness.pattern()).unwrap();
        let factors = SparseLu::symmetric(&analysis, tangent.stiffness.evaluate(0.0)).unwrap();
        let mut complete =
            BasisBuilder::new(&tangent, linearization, (&modes.vectors, 0), factors, &Unwatched);
        complete.sample(&[0.2]).unwrap();
        for (found, exact) in
            after.iter().zip(complete.model.solve_with_coarse_lefts(0.2, 5).unwrap())
        {
            assert!((found.eigenvalue - exact.eigenvalue).norm() < 1e-9 * exact.eigenvalue.norm());
        }
        // It was another one, not that with an error.
        let [old, new, next] = [&before[1], &after[1], &after[2]].map(|mode| mode.eigenvalue);
        assert!((old - new).norm() > 0.5 * (next - new).norm());
    }
}
