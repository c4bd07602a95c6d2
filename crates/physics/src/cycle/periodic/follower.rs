//! The way along a branch: tangents, steps, values asked for, folds, ends.

use super::corrector::{Corrector, Goal, Guess, Place, Point, TOLERANCE, way};
use crate::cycle::CycleError;
use crate::cycle::continuation::{BranchEnd, Values, Way};
use crate::transient::TransientError;

/// Longest and shortest step in the plane of parameter and amplitude, each over its scale.
const STEPS: [f64; 2] = [0.1, 1e-4];
/// Least slope of a tangent along the parameter on which its values are aimed at.
pub(super) const ALONG: f64 = 0.3;
/// Least cosine between two steps that are not short.
const STRAIGHT: f64 = 0.3;
/// Amplitude, over the largest of the branch, at which a cycle has shrunk into steady sliding.
const BORN: f64 = 0.02;
/// Points that the next one is guessed from.
const KNOWN: usize = 3;
/// Points for each value asked for, and besides, after which a branch is given up.
const POINTS: [usize; 2] = [6, 60];
/// One half of a branch, from its first point on.
pub(super) struct Follower<'c, 'b, 'a> {
    pub corrector: Corrector<'b, 'a>,
    /// Values asked for.
    values: &'c Values,
    /// The points, from the first on.
    pub points: Vec<Point>,
    pub(super) tangent: Place,
    pub(super) length: f64,
    /// Largest amplitude so far, over its scale.
    pub(super) largest: f64,
    /// Points after the first step.
    begun: usize,
}

impl Way for Follower<'_, '_, '_> {
    type Error = TransientError;
    /// The tangent, lengths of a step and the largest amplitude, steps of a period, points after the first step, and all of them.
    type Kept = (Place, [f64; 2], [usize; 2], Vec<Point>);
    const BLOCK: usize = 20;

    fn count(&self) -> usize {
        self.points.len()
    }

    fn begin_block(&mut self) {
        self.corrector.forget();
        // The largest amplitude so far becomes the scale of amplitudes.
        let amplitudes = self.points.iter().map(|own| own.found.image.amplitude);
        self.corrector.scales[1] = amplitudes.fold(0.0, f64::max);
        self.largest = 1.0;
        self.length = self.length.min(STEPS[0]);
        if let [.., before, here] = &self.points[..] {
            let [from, to] = [before, here].map(|point| point.place(self.corrector.scales));
            (self.tangent, _) = way(from, to);
        }
    }

    fn kept(&self) -> Self::Kept {
        let (lengths, steps) = ([self.length, self.largest], self.corrector.map.steps());
        (self.tangent, lengths, [steps, self.begun], self.points.clone())
    }

    fn take_up(&mut self, (tangent, lengths, [steps, begun], points): Self::Kept) -> Option<()> {
        let points = points.into_iter().map(|own| self.corrector.recalled(own));
        let points: Vec<Point> = points.collect::<Option<_>>()?;
        points.first()?;
        (self.points, self.tangent, self.begun) = (points, tangent, begun);
        [self.length, self.largest] = lengths;
        self.corrector.map.step_in(steps);
        Some(())
    }

    /// One more point, or why there is none.
    fn advance(&mut self) -> Result<Option<BranchEnd>, TransientError> {
        if self.points.len() >= POINTS[0] * self.values.count() + POINTS[1] {
            return Ok(Some(BranchEnd::Steps));
        }
        let Some((goal, reach)) = self.goal() else { return Ok(Some(BranchEnd::Range)) };
        let guess = self.guess(&goal, reach);
        let here = self.here().clone();
        match self.corrector.correct(&here, guess, &goal) {
            Ok(next) if self.suits(&next, reach) => self.accept(next, reach),
            Err(CycleError::Stepping(error)) => Err(error),
            Err(CycleError::Separated) => Ok(Some(BranchEnd::Separated)),
            other => {
                self.length = 0.5 * reach;
                if self.length >= STEPS[1] || self.turn()? {
                    return Ok(None);
                }
                let is_small = self.place()[1] < 5.0 * BORN * self.largest;
                Ok(Some(match other {
                    Err(CycleError::Died(_)) => BranchEnd::Birth,
                    _ if is_small => BranchEnd::Birth,
                    _ => BranchEnd::Lost,
                }))
            }
        }
    }
}

impl<'c, 'b, 'a> Follower<'c, 'b, 'a> {
    /// A half that leaves `first` towards rising (`direction` > 0) or falling values.
    pub fn new(
        corrector: Corrector<'b, 'a>,
        values: &'c Values,
        first: Point,
        direction: f64,
    ) -> Self {
        Self {
            largest: first.place(corrector.scales)[1],
            corrector,
            values,
            points: vec![first],
            tangent: [direction, 0.0],
            length: STEPS[0],
            begun: 0,
        }
    }

    pub(super) fn here(&self) -> &Point {
        &self.points[self.points.len() - 1]
    }

    pub(super) fn place(&self) -> Place {
        self.here().place(self.corrector.scales)
    }

    /// Where the coming step ends, and how long it is; none where the range ends here.
    fn goal(&self) -> Option<(Goal, f64)> {
        let (place, scale) = (self.place(), self.corrector.scales[0]);
        let slope = self.tangent[0];
        let slightly = 1e-9 * scale;
        let value = self.here().value;
        let next = *self.values.ahead(value, slope > 0.0, slightly).first()?;
        let distance = (next / scale - place[0]) / slope; // p + slope s = next.
        if slope.abs() > ALONG && distance <= self.length {
            return Some((Goal::Value(next), distance));
        }
        let goal = Goal::Length { from: place, tangent: self.tangent, length: self.length };
        Some((goal, self.length))
    }

    /// Where the step probably leads: on along the last points.
    fn guess(&self, goal: &Goal, reach: f64) -> Guess {
        // A fold may be a corner: no point before it says anything of the way on.
        let count = self.points.len();
        let fold = self.points.iter().rposition(|own| own.is_fold);
        let since = fold.map_or(0, |fold| fold.min(count - 2));
        let last = &self.points[since.max(count.saturating_sub(KNOWN))..];
        let scales = self.corrector.scales;
        let mut passed = 0.0;
        let mut known = vec![(&last[0], passed)];
        for pair in last.windows(2) {
            let [from, to] = [&pair[0], &pair[1]].map(|point| point.place(scales));
            passed += way(from, to).1; // Arc length by chords.
            known.push((&pair[1], passed));
        }
        let mut guess = Guess::through(&known, passed + reach);
        match goal {
            Goal::Value(value) => guess.value = *value,
            Goal::Length { .. } if count == 1 => guess.value += reach * self.tangent[0] * scales[0],
            Goal::Length { .. } => {}
        }
        guess
    }

    /// Distance to a point, and cosine of the angle at which it lies off the tangent.
    fn step_to(&self, next: &Point) -> (f64, f64) {
        let (direction, length) = way(self.place(), next.place(self.corrector.scales));
        (length, direction[0] * self.tangent[0] + direction[1] * self.tangent[1])
    }

    /// Whether a point may be the next one of this branch.
    fn suits(&self, next: &Point, reach: f64) -> bool {
        let (length, cosine) = self.step_to(next);
        let is_first = self.points.len() == 1;
        let is_short = reach < 8.0 * STEPS[1];
        // A first step goes along the parameter, however steep the branch is.
        let is_near = length <= if is_first { 1.0 } else { 3.0 * reach };
        next.value >= 0.0 && is_near && (is_first || is_short || cosine > STRAIGHT)
    }

    /// Takes a point, and the fold that it shows.
    fn accept(&mut self, next: Point, reach: f64) -> Result<Option<BranchEnd>, TransientError> {
        // Where the second step turns back the first was too long: around a bend its chord leads back along the branch.
        let first = self.here().value - self.points[0].value;
        let [way_back, scale] =
            [(next.value - self.here().value) * first, self.corrector.scales[0]];
        let is_second = self.points.len() > 1 && self.points.len() == self.begun;
        if is_second && way_back < 0.0 && first.abs() > 2.0 * STEPS[1] * scale {
            self.points.truncate(1);
            (self.tangent, self.length) = ([first.signum(), 0.0], 0.5 * first.abs() / scale);
            return Ok(None);
        }
        let (_, cosine) = self.step_to(&next);
        let is_easy = next.found.residual < 10.0 * TOLERANCE;
        let to = next.place(self.corrector.scales);
        (self.tangent, _) = way(self.place(), to);
        if is_easy && cosine > 0.9 {
            // Of amplitude the longest step goes by the largest so far.
            self.length = (1.5 * self.length).min(STEPS[0] * self.largest.clamp(1.0, 5.0));
        } else if cosine < 0.7 {
            self.length = 0.5 * reach;
        }
        self.length = self.length.max(2.0 * STEPS[1]); // One failure may halve it and still go on.

        // Beyond the range: its end is the last point, if there is one.
        let [least, most] = self.values.range();
        let from = self.here().value;
        let edge = next.value.clamp(least, most);
        if edge != next.value && (least..=most).contains(&from) {
            self.fill(&next, [edge]);
            return Ok(Some(BranchEnd::Range));
        }
        self.largest = self.largest.max(to[1]);
        let is_first = self.points.len() == 1;
        let between = self.values.between(from, next.value, 0.0);
        self.fill(&next, between);
        self.points.push(next);
        self.begun = if is_first { self.points.len() } else { self.begun };
        self.refine_fold();
        let is_born = self.place()[1] < BORN * self.largest;
        Ok(is_born.then_some(BranchEnd::Birth))
    }

    /// The points at values that lie between here and a point further on.
    fn fill(&mut self, next: &Point, values: impl IntoIterator<Item = f64>) {
        let here = self.here().clone();
        for value in values {
            let share = (value - here.value) / (next.value - here.value);
            let guess = here.towards(next, share);
            let found = self.corrector.correct(&here, guess, &Goal::Value(value));
            self.points.extend(found);
        }
    }
}
