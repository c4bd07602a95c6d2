//! The search for a periodic motion.

use super::map::{PeriodImage, PeriodMap, PeriodicState};
use super::secants::{Iterate, NEW, SecantSpace};
use crate::cycle::CycleError;
use serde::{Deserialize, Serialize};

/// Residual, relative to the amplitude of the vibration, at which a motion repeats itself.
pub const TOLERANCE: f64 = 1e-9;
/// Residual with which it is taken where no more is to be had: friction that falls with speed jumps a little where a node sets out.
pub const ACCEPTED: f64 = 1e-4;

/// Plain periods before the first secant, at least, and at most where the motion is still far from repeating itself: what the
/// start has of fast motions goes, and what attracts draws it near.
const PLAIN: [usize; 2] = [4, 30];
/// Residual from which on secants know better.
const NEAR: f64 = 0.05;
/// Plain periods of a second attempt, where the secants of the first have led nowhere.
const LONG: usize = 80;
/// Most periods.
const MOST: usize = 240;
/// Periods without a residual half as large as before after which the search ends.
const PATIENCE: usize = 50;
/// Most by which a plain period changes the period, relative to it.
const LONGEST: f64 = 0.05;
/// A residual so many times the smallest goes back to it.
const ASTRAY: f64 = 50.0;
/// How often that is done.
const RETURNS: usize = 3;
/// Share of the largest amplitude below which a vibration has died.
const DEAD: f64 = 1e-3;
/// Ratio of a period to the first one beyond which a search has left its mode: after no time at all every motion repeats itself.
const WIDEST: f64 = 4.0;
/// Residual of a motion that more steps may bring below [`ACCEPTED`], and how often they are doubled.
const NEARLY: f64 = 1e-2;
const REFINEMENTS: usize = 3;
/// Times the first amplitude above which a motion is out of all bounds.
const UNBOUNDED: f64 = 1e4;

/// A periodic motion.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Found {
    /// The state that comes back.
    pub state: PeriodicState,
    /// Where it comes; not kept.
    #[serde(skip)]
    pub image: PeriodImage,
    /// `|P(x) - x|` over the amplitude.
    pub residual: f64,
    /// Periods stepped for it.
    pub periods: usize,
    /// Steps of its period.
    pub steps: usize,
}

impl Found {
    /// Whether it repeats itself.
    fn is_accepted(&self) -> bool {
        self.residual <= ACCEPTED
    }

    /// Itself, if it repeats itself.
    fn accepted(self) -> Result<Self, CycleError> {
        let refused = CycleError::not_converged(self.periods, self.residual, self.state.period);
        if self.is_accepted() { Ok(self) } else { Err(refused) }
    }

    /// A motion that was kept, one period from its state; none where it is of another body.
    pub fn recalled(map: &mut PeriodMap<'_>, kept: Self) -> Option<Self> {
        let Self { state, steps, .. } = &kept;
        if state.motion.len() != map.unknowns() || !(state.period > 0.0 && *steps >= 1) {
            return None;
        }
        map.step_in(*steps);
        Some(Self { image: map.image(state), ..kept })
    }
}

/// A periodic motion near a state.
///
/// A motion that nearly repeats itself is stepped more finely: what a status of the contact that changes at whole steps leaves of
/// the residual falls with the step.
///
/// # Errors
/// A motion that dies, leaves its counterface, grows without bound or does not repeat itself.
pub fn find(map: &mut PeriodMap<'_>, start: PeriodicState) -> Result<Found, CycleError> {
    let (first, steps) = (map.periods(), map.steps());
    let result = match attempt(map, start.clone(), PLAIN) {
        Ok(found) if found.is_accepted() => Ok(found),
        Ok(_) | Err(CycleError::NotConverged { .. }) => attempt(map, start, [LONG; 2]),
        other => other,
    };
    let mut best = counted(result, map.periods() - first)?;
    for _ in 0..REFINEMENTS {
        if best.is_accepted() || best.residual > NEARLY {
            break;
        }
        map.step_in(2 * map.steps()); // What statuses at whole steps leave falls with the step.
        best = counted(attempt(map, best.state, PLAIN), map.periods() - first)?;
    }
    let found = best.accepted();
    if found.is_err() {
        map.step_in(steps); // As it was before the refinements.
    }
    found
}

/// A periodic motion near a state that may be far from it: what a transient of so many plain periods leads to.
pub fn find_settled(map: &mut PeriodMap<'_>, start: PeriodicState) -> Result<Found, CycleError> {
    attempt(map, start, [LONG; 2])?.accepted()
}

/// A result with the periods of the whole search.
fn counted(mut result: Result<Found, CycleError>, all: usize) -> Result<Found, CycleError> {
    if let Ok(Found { periods, .. }) | Err(CycleError::NotConverged { periods, .. }) = &mut result {
        *periods = all;
    }
    result
}

/// The best motion of a search with so many plain periods first, at least and at most.
fn attempt(
    map: &mut PeriodMap<'_>,
    start: PeriodicState,
    [least, most]: [usize; 2],
) -> Result<Found, CycleError> {
    let first = map.periods();
    let mut search = Search {
        spent: 0,
        first_period: start.period,
        secants: SecantSpace::new(map.unknowns(), NEW),
        state: start,
        last: None,
        best: None,
        improved: (0, f64::INFINITY),
        largest: 0.0,
        first: None,
        returns: 0,
        is_plain: true,
    };
    loop {
        if map.fit(search.state.period) {
            search.forget();
        }
        let image = map.image(&search.state);
        search.spent = map.periods() - first;
        search.judge(&image, map.steps())?;
        let is_stuck = !search.is_plain && search.spent >= search.improved.0 + PATIENCE;
        let is_spent = search.spent >= MOST + least || is_stuck;
        if search.best_residual() < TOLERANCE || is_spent {
            let (best, periods) = (search.best, search.spent);
            let best = best.ok_or_else(|| CycleError::unbounded(periods))?;
            // In the steps that the map is left with.
            return Ok(Found { periods, steps: map.steps(), ..best });
        }
        let is_far = image.relative_residual() > NEAR && search.is_plain;
        search.is_plain = search.spent <= least || (is_far && search.spent <= most); // No more after the first secant.
        if search.is_plain { search.go_plainly(image) } else { search.go(image) }
    }
}

/// Where a search is.
struct Search {
    spent: usize,
    first_period: f64,
    secants: SecantSpace,
    state: PeriodicState,
    /// The iterate before.
    last: Option<Iterate>,
    /// The state of the smallest residual.
    best: Option<Found>,
    /// Periods spent when the residual last halved, and what it was then.
    improved: (usize, f64),
    largest: f64,
    first: Option<f64>,
    returns: usize,
    /// Whether no secant has been taken yet.
    is_plain: bool,
}

impl Search {
    fn best_residual(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |best| best.residual)
    }

    fn forget(&mut self) {
        self.secants.clear();
        self.last = None;
    }

    /// Keeps the image if it is the best, and refuses motions that lead nowhere.
    fn judge(&mut self, image: &PeriodImage, steps: usize) -> Result<(), CycleError> {
        let periods = self.spent;
        let first = *self.first.get_or_insert(image.vibration);
        if !image.is_finite() || image.vibration > UNBOUNDED * first {
            return Err(CycleError::unbounded(periods));
        }
        self.largest = self.largest.max(image.vibration);
        if image.vibration < DEAD * self.largest {
            return Err(CycleError::Died(periods));
        }
        if image.counts.stick + image.counts.slip == 0 {
            return Err(CycleError::Separated);
        }
        let residual = image.relative_residual();
        let period = self.state.period;
        if !(WIDEST.recip()..=WIDEST).contains(&(period / self.first_period)) {
            return Err(CycleError::not_converged(periods, residual, period));
        }
        if residual < 0.5 * self.improved.1 {
            self.improved = (self.spent, residual);
        }
        if residual < self.best_residual() {
            let (state, image) = (self.state.clone(), image.clone());
            self.best = Some(Found { state, image, residual, periods, steps });
        }
        Ok(())
    }

    /// One period further.
    fn go_plainly(&mut self, image: PeriodImage) {
        let limit = LONGEST * self.state.period;
        self.state.period += image.delay().clamp(-limit, limit); // T <- T - r . x' / |x'|^2, within bounds.
        self.state.motion = image.motion; // x <- P(x).
    }

    /// One step of the secants; from a state far worse than the best, back to that and a plain period on.
    fn go(&mut self, image: PeriodImage) {
        let residual = image.relative_residual();
        let is_astray = residual > ASTRAY * self.best_residual() && self.returns < RETURNS;
        if let (true, Some(best)) = (is_astray, &self.best) {
            self.returns += 1;
            self.improved.0 = self.spent; // Patience begins anew.
            self.state = best.state.clone();
            let image = best.image.clone();
            self.forget();
            return self.go_plainly(image);
        }
        let state = self.state.clone();
        let here = Iterate { state, place: [0.0; 2], residual: image.residual.clone() };
        if let Some(last) = self.last.take() {
            self.secants.push(here.since(&last));
        }
        let step = self.secants.step(&here.residual, 0.0, &image.rate);
        step.take(step.allowed(self.state.period, &image), &mut self.state);
        self.last = Some(here);
    }
}
