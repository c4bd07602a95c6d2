//! Following a branch of limit cycles from one change of contact state to the next.
//!
//! With the contact state of every point fixed the equations are smooth: no gap in contact, no slip in stick, the phase fixed by
//! `Im(u_theta,1) = 0`. Forces, frequency and one parameter move along a curve, up to where an inequality of Signorini's and Coulomb's laws
//! is about to break. There the state of that one point changes, and the curve goes on to the side on which its new inequality holds. Folds
//! need no special care, and no iteration over contact states can cycle.

use super::continuation::Values;
use super::parameter::Parameter;
use super::state::{Event, PointState, WaveState};
use super::system::{Closure, Heading, System};
use super::wave::{Linearization, Wave};

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

/// Where one step along a branch ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// At a change of contact state, or in the middle of nowhere.
    Moved,
    /// At a wanted value of the parameter.
    At(f64),
}

/// A branch of limit cycles over one parameter.
pub struct Branch<'a> {
    /// The wave.
    pub wave: &'a Wave<'a>,
    parameter: Parameter,
    /// Where it is.
    pub state: WaveState,
    heading: Option<Heading>,
    pending: Option<Event>,
    force_scale: f64,
    /// Sense of the parameter at the start, and at the last step: +1 or -1.
    pub direction: f64,
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
    /// A branch through `state`, at first towards rising (`direction` > 0) or falling parameter.
    ///
    /// `pending` is an inequality that the state is on the point of breaking; it then decides the way.
    pub fn new(
        wave: &'a Wave<'a>,
        parameter: Parameter,
        state: WaveState,
        direction: f64,
        pending: Option<Event>,
    ) -> Self {
        let force_scale = state.normal.iter().sum::<f64>() / state.normal.len() as f64; // Slacks and residuals are measured by it.
        Self {
            wave,
            parameter,
            state,
            heading: None,
            pending,
            force_scale,
            direction,
            factorizations: 0,
        }
    }

    /// The parameter's value, SI.
    pub fn value(&self) -> f64 {
        self.parameter.of(&self.state.point)
    }

    /// One step: to the next change of contact state, the next of `samples` or the longest step.
    ///
    /// `None` where the curve cannot be followed any further.
    pub fn advance(&mut self, samples: &Values) -> Option<Step> {
        let flipped = self.pending.take().map(|event| self.flip(event));
        // The tangent, turned so that what has just changed goes on to hold.
        let linear = Linearization::at(self.wave, &self.state, self.parameter);
        let system = System::new(&self.state, self.parameter, self.force_scale);
        let mut heading = system.tangent(&linear, self.heading.as_ref())?;
        self.factorizations += 1;
        let mut inequalities = self.inequalities(&linear, &heading);
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
        let (mut length, mut goal) = self.nearest(&inequalities, flipped, &heading, samples);
        // An inequality that breaks on the way after all becomes the goal; each such shortening is progress.
        for _ in 0..12 {
            let found = self.correct(&heading, length, goal);
            match found.map(|(state, linear)| (self.worst(&state, &linear), state)) {
                Some((None, state)) => match self.skipped(&state, samples, goal) {
                    Some(value) => goal = Goal::Value(value),
                    None => return Some(self.accept(state, heading, length, goal)),
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
    fn skipped(&self, state: &WaveState, samples: &Values, goal: Goal) -> Option<f64> {
        if matches!(goal, Goal::Value(_)) {
            return None;
        }
        let (from, to) = (self.value(), self.parameter.of(&state.point));
        samples.between(from.min(to), from.max(to), SAME * from.abs()).first().copied()
    }

    fn accept(&mut self, state: WaveState, heading: Heading, length: f64, goal: Goal) -> Step {
        // A secant smooths over many short steps; one of no length says nothing.
        let secant = Heading::between(&self.state, &state, self.parameter);
        let is_long = length > 1e-9;
        self.heading = Some(if is_long { secant } else { heading });
        self.state = state;
        match goal {
            Goal::Event(event) => {
                self.pending = Some(event);
                Step::Moved
            }
            Goal::Value(value) => Step::At(value),
            Goal::Length => Step::Moved,
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

    fn inequalities(&self, linear: &Linearization, heading: &Heading) -> Vec<Inequality> {
        let [gap, slip] = self.wave_rates(linear, heading);
        let friction = self.state.point.contact.friction_coefficient;
        let rise = self.parameter.friction_in(heading.scalars()[2]);
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

    /// Rates of gap and slip along a heading. Its tangential forces hold the friction coefficient's change already.
    fn wave_rates(&self, linear: &Linearization, heading: &Heading) -> [Vec<f64>; 2] {
        let forces = [heading.normal(), heading.tangential()].map(|own| self.wave.harmonics(own));
        let [frequency, _, parameter] = heading.scalars();
        let parameter = parameter - self.parameter.friction_in(parameter);
        let [by_frequency, by_parameter] = &linear.by[..] else {
            unreachable!("branches of one wave have one frequency");
        };
        [0, 1].map(|row| {
            // A convolution over the phase: products of harmonics.
            let columns = linear.columns[row].each_ref().map(|column| self.wave.harmonics(column));
            let mut rate = self.wave.values(
                (0..columns[0].len())
                    .map(|k| columns[0][k] * forces[0][k] + columns[1][k] * forces[1][k]),
            );
            let by = by_frequency[row].iter().zip(&by_parameter[row]);
            for (value, (by_frequency, by_parameter)) in rate.iter_mut().zip(by) {
                *value += by_frequency * frequency + by_parameter * parameter; // At fixed forces: by omega and by the parameter.
            }
            rate
        })
    }

    /// The nearest end of the coming step.
    fn nearest(
        &self,
        inequalities: &[Inequality],
        flipped: Option<Event>,
        heading: &Heading,
        samples: &Values,
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
        let ahead = samples.ahead(value, rise > 0.0, SAME * value.abs());
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
    ) -> Option<(WaveState, Linearization)> {
        let mut state = self.state.clone();
        heading.add_to(&mut state, length, self.parameter); // Predictor x + l dx, corrected below.
        let predicted = state.clone();
        let mut previous = f64::INFINITY;
        for _ in 0..8 {
            let linear = Linearization::at(self.wave, &state, self.parameter);
            let system = System::new(&state, self.parameter, self.force_scale);
            let closure = match goal {
                Goal::Event(event) => Closure::Event(event),
                Goal::Value(value) => Closure::Value(value),
                Goal::Length => Closure::Plane(heading, &predicted),
            };
            let (matrix, residual) = system.assemble(&linear, closure);
            let largest = residual.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
            if largest < CONVERGED || (largest < STAGNANT && largest > 0.25 * previous) {
                let strayed = system.distance(&predicted); // Farther than the step is long: another curve.
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
    fn worst(&self, state: &WaveState, linear: &Linearization) -> Option<(Event, f64)> {
        slacks(state, linear)
            .filter(|&(_, slack)| slack < -TOLERANCE * self.force_scale)
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Every inequality of a state with its slack, N/m.
fn slacks<'a>(
    state: &'a WaveState,
    linear: &'a Linearization,
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
