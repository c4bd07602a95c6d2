//! One point of a branch: a periodic motion and the value of the parameter at which it lives, found together.

use super::map::{PeriodImage, PeriodMap, PeriodicState};
use super::search::{ACCEPTED, Found};
use super::secants::{Iterate, NEW_ALONG, SecantSpace};
use crate::cycle::CycleError;
use crate::linalg::dense::{add, norm};
use crate::transient::TransientError;
use serde::{Deserialize, Serialize};

/// Residual of a point, relative to the amplitude of the vibration.
pub(super) const TOLERANCE: f64 = 1e-6;
/// Residual of a cycle that is one for sure.
pub(super) const GOOD: f64 = 1e-5;
/// What its closure may miss, in units of the scales.
const CLOSED: f64 = 1e-7;
/// Most periods for a point.
const MOST: usize = 80;
/// Periods without a residual half as large as before after which the search ends.
const PATIENCE: usize = 12;
/// Secants that are kept however far they lead.
const FEWEST: usize = 3;
/// Share of the last residual above which a step has gained nothing: older secants are of another status of the nodes.
const GAINED: f64 = 0.7;
/// Residual that is no neighbour's any more.
const ASTRAY: f64 = 0.7;

/// Parameter and amplitude of a point, each over a scale: the plane in which a branch is a curve.
pub(super) type Place = [f64; 2];

/// Direction and distance from one place to another.
pub(super) fn way(from: Place, to: Place) -> (Place, f64) {
    let step = [to[0] - from[0], to[1] - from[1]];
    let length = step[0].hypot(step[1]);
    (step.map(|part| part / length), length)
}

/// What ties a point of a branch down.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// This value of the parameter.
    Value(f64),
    /// So far along a tangent of unit length: pseudo-arclength.
    Length {
        /// Where the tangent begins.
        from: Place,
        /// The tangent.
        tangent: Place,
        /// How far.
        length: f64,
    },
}

impl Goal {
    /// What a place misses the goal by, and the derivatives of that by both parts of the place.
    fn closure(&self, place: Place, scales: Place) -> (f64, [f64; 2]) {
        match self {
            Self::Value(value) => (place[0] - value / scales[0], [1.0, 0.0]),
            Self::Length { from, tangent: [a, b], length } => {
                (a * (place[0] - from[0]) + b * (place[1] - from[1]) - length, [*a, *b])
            }
        }
    }
}

/// A point of a branch.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// The parameter, SI.
    pub value: f64,
    /// The motion.
    pub found: Found,
    /// Whether the branch turns back here.
    pub is_fold: bool,
}

impl Point {
    /// Where it lies.
    pub(super) fn place(&self, scales: Place) -> Place {
        [self.value / scales[0], self.found.image.amplitude / scales[1]]
    }

    /// The motion `share` of the way from here to another one and beyond.
    pub(super) fn towards(&self, other: &Self, share: f64) -> Guess {
        Guess::through(&[(self, 0.0), (other, 1.0)], share)
    }
}

impl Guess {
    /// The polynomial through points at places of a coordinate along the branch, continued to `to`.
    pub fn through(points: &[(&Point, f64)], to: f64) -> Self {
        let mut guess = Self { value: 0.0, state: PeriodicState::default() };
        for (i, (point, at)) in points.iter().enumerate() {
            let others = points.iter().enumerate().filter(|(j, _)| *j != i);
            // Lagrange: prod_j (s - s_j) / (s_i - s_j).
            let weight = others.map(|(_, (_, other))| (to - other) / (at - other)).product::<f64>();
            let own = &point.found.state;
            guess.state.motion.resize(own.motion.len(), 0.0);
            add(&mut guess.state.motion, weight, &own.motion);
            guess.state.period += weight * own.period;
            guess.value += weight * point.value;
        }
        guess
    }
}

/// Where a point is sought.
#[derive(Clone, Debug)]
pub(super) struct Guess {
    pub value: f64,
    pub state: PeriodicState,
}

/// Gives a map another value of the parameter.
pub(super) type Tune<'b, 'a> =
    &'b (dyn Fn(&mut PeriodMap<'a>, f64) -> Result<(), TransientError> + Sync);

/// Finds points of a branch, one from the other, with what the last ones have taught it of the map.
pub(super) struct Corrector<'b, 'a> {
    pub map: PeriodMap<'a>,
    tune: Tune<'b, 'a>,
    pub scales: Place,
    secants: SecantSpace,
    /// What the closure is multiplied by beside the residual: the amplitude of the vibration.
    weight: f64,
}

impl<'b, 'a> Corrector<'b, 'a> {
    /// One that knows nothing yet.
    pub fn new(map: PeriodMap<'a>, tune: Tune<'b, 'a>, scales: Place) -> Self {
        let secants = SecantSpace::new(map.unknowns(), NEW_ALONG);
        Self { map, tune, scales, secants, weight: 1.0 }
    }

    /// Forgets what is known of the map.
    pub fn forget(&mut self) {
        self.secants.clear();
    }

    /// A point that was kept: one period from its state; none where it is of another body.
    pub fn recalled(&mut self, kept: Point) -> Option<Point> {
        (self.tune)(&mut self.map, kept.value).ok()?;
        let found = Found::recalled(&mut self.map, kept.found)?;
        Some(Point { found, ..kept })
    }

    /// A point's motion with its vibration about its mean so many times as large, at another value.
    ///
    /// # Errors
    /// A body that the time loop cannot take.
    pub fn scaled(&mut self, point: &Point, by: f64, value: f64) -> Result<Guess, TransientError> {
        (self.tune)(&mut self.map, point.value)?;
        self.map.step_in(point.found.steps);
        let mean = self.map.mean(&point.found.state);
        Ok(Guess { value, state: point.found.state.stretched(&mean, by) })
    }

    /// The point at a goal, from a guess; `near` is a point of the branch close by.
    ///
    /// # Errors
    /// A motion that dies, leaves its counterface, or does not repeat itself.
    pub fn correct(&mut self, near: &Point, from: Guess, goal: &Goal) -> Result<Point, CycleError> {
        let found = self.search(near, from.clone(), goal);
        let is_good = found.as_ref().is_ok_and(|point| point.found.residual < GOOD);
        if is_good || matches!(found, Err(CycleError::Stepping(_))) {
            return found;
        }
        // What the last points have taught may be of another status of the nodes: once more without it.
        self.forget();
        let second = self.search(near, from, goal);
        match (&found, &second) {
            (Ok(one), Ok(other)) if one.found.residual <= other.found.residual => found,
            (Ok(_), Err(_)) => found,
            _ => second,
        }
    }

    fn search(&mut self, near: &Point, mut guess: Guess, goal: &Goal) -> Result<Point, CycleError> {
        self.weight = near.found.image.vibration;
        let first = self.map.periods();
        let mut last = Some(Iterate {
            state: near.found.state.clone(),
            place: near.place(self.scales),
            residual: near.found.image.residual.clone(),
        });
        let mut best: Option<(f64, Point)> = None;
        let mut improved = (0, f64::INFINITY);
        loop {
            // The map at the guess.
            (self.tune)(&mut self.map, guess.value)?;
            if self.map.fit(guess.state.period) {
                self.secants.clear(); // Another number of steps is another map.
                last = None;
            }
            let image = self.map.image(&guess.state);
            let periods = self.map.periods() - first;
            let residual = self.judged(near, &image, periods)?;
            let place = [guess.value / self.scales[0], image.amplitude / self.scales[1]];
            let (closure, weights) = goal.closure(place, self.scales);
            self.secants.closure = weights.map(|by| self.weight * by); // Weighed like a residual.
            let missed = residual.max(closure.abs() * TOLERANCE / CLOSED); // A closure of CLOSED counts as much as a residual of TOLERANCE.
            if missed < 0.5 * improved.1 {
                improved = (periods, missed);
            }
            if best.as_ref().is_none_or(|best| missed < best.0) {
                best = Some((missed, self.point(&guess, &image)));
            }
            let is_spent = periods >= MOST || periods >= improved.0 + PATIENCE;
            if missed < TOLERANCE || is_spent {
                let Some((missed, mut point)) = best else {
                    return Err(CycleError::unbounded(periods));
                };
                point.found.periods = periods;
                let refused = CycleError::not_converged(periods, missed, point.found.state.period);
                return if missed <= ACCEPTED { Ok(point) } else { Err(refused) };
            }
            // One step of the secants.
            let state = guess.state.clone();
            let here = Iterate { state, place, residual: image.residual.clone() };
            if let Some(last) = last.take() {
                // Older changes go where the last one has gained nothing.
                if periods > 1 && norm(&here.residual) > GAINED * norm(&last.residual) {
                    self.secants.keep_latest(periods);
                }
                self.secants.push(here.since(&last));
            }
            last = Some(here);
            self.step(&mut guess, &image, closure);
            if let Goal::Value(value) = goal {
                guess.value = *value; // No step may leave the value asked for.
            }
        }
    }

    /// On to the next guess: by the secants, of which the older half goes as long as they lead too far.
    fn step(&mut self, guess: &mut Guess, image: &PeriodImage, closure: f64) {
        let closure = self.weight * closure;
        loop {
            let step = self.secants.step(&image.residual, closure, &image.rate);
            let share = step.allowed(guess.state.period, image);
            if share == 1.0 || self.secants.count() <= FEWEST {
                step.take(share, &mut guess.state);
                guess.value += share * step.place[0] * self.scales[0];
                return;
            }
            self.secants.keep_latest(self.secants.count() / 2);
        }
    }

    /// The relative residual of a motion that may lie on the branch of `near`.
    fn judged(&self, near: &Point, image: &PeriodImage, periods: usize) -> Result<f64, CycleError> {
        if !image.is_finite() {
            return Err(CycleError::unbounded(periods));
        }
        if image.counts.stick + image.counts.slip == 0 {
            return Err(CycleError::Separated);
        }
        if image.amplitude < 1e-3 * near.found.image.amplitude {
            return Err(CycleError::Died(periods));
        }
        let residual = image.relative_residual();
        if residual > ASTRAY {
            let period = near.found.state.period;
            return Err(CycleError::not_converged(periods, residual, period));
        }
        Ok(residual)
    }

    fn point(&self, guess: &Guess, image: &PeriodImage) -> Point {
        Point {
            value: guess.value,
            is_fold: false,
            found: Found {
                state: guess.state.clone(),
                image: image.clone(),
                residual: image.relative_residual(),
                periods: 0,
                steps: self.map.steps(),
            },
        }
    }
}
