//! Following a branch of limit cycles from one change of contact state to the next.
//!
//! With the contact state of every point fixed the equations are smooth: no gap in contact, no slip in stick, the phase fixed by
//! `Im(u_theta,1) = 0`. Forces, frequency and one parameter move along a curve, up to where an inequality of Signorini's and Coulomb's laws
//! is about to break. There the state of that one point changes, and the curve goes on to the side on which its new inequality holds. Folds
//! need no special care, and no iteration over contact states can cycle.

use super::continuation::{BranchEnd, Turning, Values, Way};
use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;
use super::state::{Event, PointState, WaveState};
use super::system::{Closure, Heading, System};
use super::wave::{Linearization, Wave};
use crate::cea::Unwatched;
use std::convert::Infallible;

/// Longest step along the branch, relative: a twentieth of the mean normal force, frequency or parameter.
const LONGEST_STEP: f64 = 0.05;

/// The corrector may go as far as the step is long, or as this: what lies farther is another curve.
const SHORTEST_REACH: f64 = 1e-3;

/// Scaled residuals below this are a solution.
const CONVERGED: f64 = 1e-11;

/// Scaled residuals below this are round-off once they shrink no more: the lighter the damping, the more the forces of
/// resonant harmonics cancel.
const STAGNANT: f64 = 1e-9;

/// Inequalities broken by less than this share of the mean normal force are round-off.
const TOLERANCE: f64 = 1e-8;

/// Values of the parameter that differ by less than this share are one.
const SAME: f64 = 1e-12;

/// Most changes of contact state along one branch.
const MOST_STEPS: usize = 6_000;

/// Friction coefficient beyond which no branch is followed.
const HIGHEST_FRICTION: f64 = 10.0;

/// One half of a branch of limit cycles over one parameter.
pub struct Branch<'a> {
    wave: &'a Wave,
    parameter: Parameter,
    values: &'a Values,
    /// Where it is.
    state: WaveState,
    heading: Option<Heading>,
    /// An inequality that the state is on the point of breaking, which decides the way.
    pub pending: Option<Event>,
    force_scale: f64,
    /// Sense of the parameter at the start, and at the last step: +1 or -1.
    direction: f64,
    pub turning: Turning,
    /// The cycles at values asked for.
    pub cycles: Vec<LimitCycle>,
    /// Changes of contact state that may still come.
    pub steps: usize,
    /// Friction coefficient beyond which it ends.
    pub highest: f64,
    /// Dense factorizations so far.
    pub factorizations: usize,
}

/// An inequality with its slack, N/m, and the slack's rate along the heading.
type Inequality = (Event, f64, f64);

/// Where a step wants to end.
#[derive(Clone, Copy, Debug)]
enum Goal {
    Event(Event),
    Value(f64),
    Length,
}

impl<'a> Branch<'a> {
    /// That through `state`, at first towards rising (`direction` > 0) or falling parameter.
    pub fn new(
        wave: &'a Wave,
        (parameter, values): (Parameter, &'a Values),
        state: WaveState,
        direction: f64,
    ) -> Self {
        let force_scale = state.normal.iter().sum::<f64>() / state.normal.len() as f64; // Slacks and residuals are measured by it.
        Self {
            turning: Turning::new(parameter.of(&state.point), direction.signum(), wave.points()),
            wave,
            parameter,
            values,
            state,
            heading: None,
            pending: None,
            force_scale,
            direction,
            cycles: Vec::new(),
            steps: MOST_STEPS,
            highest: HIGHEST_FRICTION,
            factorizations: 0,
        }
    }

    /// The cycle at the only value asked for, or where the branch ends before and why.
    pub fn reach(mut self) -> Result<LimitCycle, (f64, BranchEnd)> {
        let Ok(end) = self.run("", &Unwatched);
        self.cycles.pop().ok_or((self.value(), end))
    }

    /// The parameter's value, SI.
    fn value(&self) -> f64 {
        self.parameter.of(&self.state.point)
    }

    /// One step: to the next change of contact state, the next value or the longest step.
    ///
    /// `None` where the curve cannot be followed any further.
    fn step(&mut self) -> Option<Goal> {
        let flipped = self.pending.take().map(|event| self.flip(event));
        // The tangent, turned so that what has just changed goes on to hold.
        let system = System::at(self.wave, &self.state, self.parameter, self.force_scale);
        let mut heading = system.tangent(self.heading.as_ref())?;
        let mut inequalities = self.inequalities(&system.linear, &heading);
        self.factorizations += 1;
        let sense = match flipped {
            Some(event) => inequalities.iter().find(|i| i.0 == event)?.2, // The rate of its slack: it must come to hold.
            None if self.heading.is_none() => self.direction * heading.scalars()[2],
            None => 1.0,
        };
        if sense < 0.0 {
            heading.reverse();
            inequalities.iter_mut().for_each(|inequality| inequality.2 *= -1.0);
        }
        self.direction = heading.scalars()[2].signum(); // Of the parameter, which folds turn.
        // As far as the first inequality that would break along it.
        let (mut length, mut goal) = self.nearest(&inequalities, flipped, &heading);
        // An inequality that breaks on the way after all becomes the goal; each such shortening is progress.
        for _ in 0..12 {
            let found = self.correct(&heading, length, goal);
            match found.map(|(state, linear)| (self.worst(&state, &linear), state)) {
                Some((None, state)) => match self.skipped(&state, goal) {
                    Some(value) => goal = Goal::Value(value),
                    None => {
                        self.accept(state, heading, length, goal);
                        return Some(goal);
                    }
                },
                Some((Some((event, slack)), _)) if Some(event) != flipped => {
                    let before = inequalities.iter().find(|i| i.0 == event);
                    let before = before.map_or(0.0, |i| i.1.max(0.0));
                    length *= before / (before - slack); // slack(s) = before + s (slack - before) = 0.
                    goal = Goal::Event(event);
                }
                // Nothing, or what came to hold breaks again within the step: a shorter one ends where it holds.
                _ => (length, goal) = (0.3 * length, Goal::Length),
            }
        }
        None
    }

    /// A wanted value that lies strictly between here and `state`: the curve bends more than its heading said.
    fn skipped(&self, state: &WaveState, goal: Goal) -> Option<f64> {
        if matches!(goal, Goal::Value(_)) {
            return None;
        }
        let (from, to) = (self.value(), self.parameter.of(&state.point));
        self.values.between(from.min(to), from.max(to), SAME * from.abs()).first().copied()
    }

    fn accept(&mut self, state: WaveState, heading: Heading, length: f64, goal: Goal) {
        // A secant smooths over many short steps; one of no length says nothing.
        let secant = Heading::between(&self.state, &state, self.parameter);
        let is_long = length > 1e-9;
        self.heading = Some(if is_long { secant } else { heading });
        self.state = state;
        if let Goal::Event(event) = goal {
            self.pending = Some(event);
        }
    }

    /// Changes the state of one point and returns the inequality that must now come to hold.
    fn flip(&mut self, event: Event) -> Event {
        let i = event.point();
        let (state, check) = match event {
            Event::Lift(_) => (PointState::Open, Event::Touch(i)),
            Event::Touch(_) => {
                let linear = Linearization::at(self.wave, &self.state, self.parameter);
                let slips = [PointState::SlipBackward, PointState::SlipForward];
                (slips[usize::from(linear.slip[i] < 0.0)], Event::Lift(i))
            }
            Event::SlideForward(_) => (PointState::SlipForward, Event::Rest(i)),
            Event::SlideBackward(_) => (PointState::SlipBackward, Event::Rest(i)),
            Event::Rest(_) if self.state.contact[i] == PointState::SlipForward => {
                (PointState::Stick, Event::SlideForward(i))
            }
            Event::Rest(_) => (PointState::Stick, Event::SlideBackward(i)),
        };
        self.state.contact[i] = state;
        if matches!(event, Event::Lift(_) | Event::Touch(_)) {
            (self.state.normal[i], self.state.tangential[i]) = (0.0, 0.0); // Contact ends and begins at N = 0, hence T = 0.
        }
        check
    }

    fn inequalities(&self, linear: &Linearization<'_>, heading: &Heading) -> Vec<Inequality> {
        let friction = self.state.point.contact.friction_coefficient;
        let [frequency, _, parameter] = heading.scalars();
        let rise = self.parameter.friction_in(parameter); // What it does is in the tangential forces of the heading.
        let forces = [heading.normal(), heading.tangential()];
        let [gap, slip] = linear.rates(forces, &[frequency, parameter - rise]);
        // How each slack changes along the heading.
        let with_rate = |(event, slack): (Event, f64)| {
            let i = event.point();
            let normal = heading.normal()[i];
            let rates = [
                normal,
                heading.tangential()[i],
                linear.scales[0] * gap[i],
                linear.scales[1] * slip[i],
                friction * normal + self.state.normal[i] * rise, // d(mu N) = mu dN + N dmu.
            ];
            (event, slack, event.slack(self.state.contact[i].drag(), rates))
        };
        slacks(&self.state, linear).map(with_rate).collect()
    }

    /// The nearest end of the coming step.
    fn nearest(
        &self,
        inequalities: &[Inequality],
        flipped: Option<Event>,
        heading: &Heading,
    ) -> (f64, Goal) {
        let mut best = (LONGEST_STEP, Goal::Length);
        for &(event, slack, rate) in inequalities {
            if Some(event) != flipped && rate < -1e-13 * self.force_scale {
                let length = slack.max(0.0) / -rate; // slack + length rate = 0.
                if length < best.0 {
                    best = (length, Goal::Event(event));
                }
            }
        }
        let value = self.value();
        let [_, _, rise] = heading.scalars();
        let ahead = self.values.ahead(value, rise > 0.0, SAME * value.abs());
        if let Some(&sample) = ahead.first() {
            let length = (sample - value) / rise; // value + length rise = sample.
            if length <= best.0 {
                best = (length, Goal::Value(sample));
            }
        }
        best
    }

    /// Newton's method from the predicted point, onto the goal.
    fn correct(
        &mut self,
        heading: &Heading,
        length: f64,
        goal: Goal,
    ) -> Option<(WaveState, Linearization<'a>)> {
        let mut state = self.state.clone();
        heading.add_to(&mut state, length, self.parameter); // Predictor x + l dx, corrected below.
        let predicted = state.clone();
        let mut previous = f64::INFINITY;
        for _ in 0..8 {
            let system = System::at(self.wave, &state, self.parameter, self.force_scale);
            let closure = match goal {
                Goal::Event(event) => Closure::Event(event),
                Goal::Value(value) => Closure::Value(value),
                Goal::Length => Closure::Plane(heading, &predicted),
            };
            let (matrix, residual) = system.assemble(closure);
            let largest = residual.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
            if largest < CONVERGED || (largest < STAGNANT && largest > 0.25 * previous) {
                let strayed = system.distance(&predicted); // Farther than the step is long: another curve.
                let linear = system.linear;
                return (strayed <= length.max(SHORTEST_REACH)).then_some((state, linear));
            }
            if !residual.iter().all(|value| value.abs() < 1e6) {
                return None;
            }
            previous = largest;
            let change = system.solve(matrix, &residual)?;
            self.factorizations += 1;
            change.add_to(&mut state, 1.0, self.parameter);
        }
        None
    }

    /// The inequality broken most, beyond round-off.
    fn worst(&self, state: &WaveState, linear: &Linearization<'_>) -> Option<(Event, f64)> {
        slacks(state, linear)
            .filter(|&(_, slack)| slack < -TOLERANCE * self.force_scale)
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Way for Branch<'_> {
    type Error = Infallible;
    type Kept = ();

    fn kept(&self) {}

    /// It is short enough to be followed again.
    fn take_up(&mut self, (): ()) -> Option<()> {
        None
    }

    /// One step, with the cycle where it ends at a value asked for.
    fn advance(&mut self) -> Result<Option<BranchEnd>, Infallible> {
        let Some(left) = self.steps.checked_sub(1) else { return Ok(Some(BranchEnd::Steps)) };
        self.steps = left;
        let Some(goal) = self.step() else { return Ok(Some(BranchEnd::Lost)) };
        self.turning.follow(self.value());
        if let Goal::Value(value) = goal {
            let cycle = LimitCycle::new(self.wave, self.state.clone());
            if !cycle.is_physical() {
                return Ok(Some(BranchEnd::Unphysical));
            }
            self.cycles.push(cycle);
            if self.values.end_at(value, self.direction > 0.0) {
                return Ok(Some(BranchEnd::Range));
            }
        }
        if self.state.contact.iter().all(|&point| point == PointState::SlipForward) {
            return Ok(Some(BranchEnd::Birth)); // Full slip: a linear wave, of any amplitude at its onset.
        }
        let is_beyond = !(self.state.point.contact.friction_coefficient < self.highest); // Not a number ends it, too.
        Ok(is_beyond.then_some(BranchEnd::Lost))
    }
}

/// Every inequality of a state with its slack, N/m.
fn slacks<'a>(
    state: &'a WaveState,
    linear: &'a Linearization<'_>,
) -> impl Iterator<Item = (Event, f64)> + 'a {
    let friction = state.point.contact.friction_coefficient;
    let points = state.contact.iter().enumerate();
    let events = points.flat_map(|(i, contact)| contact.events().iter().map(move |event| event(i)));
    events.map(move |event| {
        let i = event.point();
        let normal = state.normal[i];
        let gap = linear.scales[0] * linear.gap[i];
        let slip = linear.scales[1] * linear.slip[i];
        let parts = [normal, state.tangential[i], gap, slip, friction * normal];
        (event, event.slack(state.contact[i].drag(), parts))
    })
}
