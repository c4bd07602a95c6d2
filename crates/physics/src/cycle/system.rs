//! The linear systems of one step along a branch, of one wave or of two.

use super::parameter::Parameter;
use super::state::{Event, WaveState};
use super::wave::{Linearization, Wave};
use crate::linalg::dense::{add, difference};
use crate::linalg::{DenseLu, Mat, MatMut, c64};

/// A change of forces, frequencies and parameter.
#[derive(Clone, Debug)]
pub struct Heading {
    /// Changes of the normal force at each point, of the tangential forces, of both frequencies (zero for a second wave that is not
    /// there), and of the parameter.
    values: Vec<f64>,
    points: usize,
}

impl Heading {
    pub fn between(from: &WaveState, to: &WaveState, parameter: Parameter) -> Self {
        let flat = |state: &WaveState| {
            let scalars = [&state.frequencies()[..], &[parameter.of(&state.point)]].concat();
            [&state.normal[..], &state.tangential, &scalars].concat()
        };
        Self { values: difference(&flat(to), &flat(from)), points: from.normal.len() }
    }

    /// Change of the normal force at each point.
    pub fn normal(&self) -> &[f64] {
        &self.values[..self.points]
    }

    /// Change of the tangential force.
    pub fn tangential(&self) -> &[f64] {
        &self.values[self.points..2 * self.points]
    }

    /// Changes of both frequencies and of the parameter.
    pub fn scalars(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.values[2 * self.points + i])
    }

    pub fn reverse(&mut self) {
        self.values.iter_mut().for_each(|value| *value = -*value);
    }

    /// Moves a state by `length` times this.
    pub fn shift(&self, state: &mut WaveState, length: f64, parameter: Parameter) {
        add(&mut state.normal, length, self.normal());
        add(&mut state.tangential, length, self.tangential());
        let [first, second, change] = self.scalars();
        for (own, change) in state.phases.iter_mut().zip([first, second]) {
            own.frequency += length * change;
        }
        let value = parameter.of(&state.point) + length * change;
        parameter.set(&mut state.point, value);
    }

    /// The same; contact laws with fixed drag hold exactly afterwards.
    pub fn add_to(&self, state: &mut WaveState, length: f64, parameter: Parameter) {
        self.shift(state, length, parameter);
        state.impose_law();
    }
}

/// The equation that picks a point on the curve.
#[derive(Clone, Copy)]
pub enum Closure<'a> {
    /// An inequality holds with equality.
    Event(Event),
    /// The parameter has a value.
    Value(f64),
    /// The first harmonic along a phase has an amplitude, m.
    Amplitude(usize, f64),
    /// The point lies in the plane across a heading through a state.
    Plane(&'a Heading, &'a WaveState),
}

/// The laws that a contact point obeys: no gap, no slip.
const GAP: usize = 0;
const SLIP: usize = 1;

/// One equation of a system, scaled: what it changes by with each unknown, and what it misses.
struct Equation {
    row: Vec<f64>,
    residual: f64,
}

/// The unknowns of one set of contact states: normal forces in contact, tangential forces in stick, and the scalars, one or two
/// frequencies and the parameter.
///
/// All unknowns and equations are scaled: forces by the mean normal force, a frequency by a hundredth of itself, the parameter by itself.
pub struct System<'w, 's> {
    /// The edge around the state.
    pub linear: Linearization<'w>,
    state: &'s WaveState,
    parameter: Parameter,
    contact: Vec<usize>,
    stick: Vec<usize>,
    force_scale: f64,
    /// Place of each unknown in a [`Heading`], and its scale.
    unknowns: Vec<(usize, f64)>,
}

impl<'w, 's> System<'w, 's> {
    pub fn at(
        wave: &'w Wave,
        state: &'s WaveState,
        parameter: Parameter,
        force_scale: f64,
    ) -> Self {
        let linear = Linearization::at(wave, state, parameter);
        let (contact, stick) = state.active();
        let points = state.contact.len();
        let forces = contact.iter().copied().chain(stick.iter().map(|i| points + i));
        let own = state.phases.iter().enumerate();
        // Forces in units of the mean one, frequencies of a hundredth, the parameter of itself.
        let own = own.map(|(wave, own)| (2 * points + wave, 0.01 * own.frequency));
        let last = (2 * points + 2, parameter.of(&state.point).abs().max(1e-12));
        let unknowns = forces.map(|place| (place, force_scale)).chain(own).chain([last]);
        let unknowns = unknowns.collect();
        Self { linear, state, parameter, contact, stick, force_scale, unknowns }
    }

    fn size(&self) -> usize {
        self.unknowns.len()
    }

    /// Unknown forces: the scalars come after them.
    fn forces(&self) -> usize {
        self.contact.len() + self.stick.len()
    }

    /// The frequencies and the parameter.
    fn scalars(&self) -> &[(usize, f64)] {
        &self.unknowns[self.forces()..]
    }

    fn parameter_scale(&self) -> f64 {
        self.unknowns[self.size() - 1].1
    }

    /// An equation for `scale` times a `value`, with the responses of that to each unknown: to the normal and the tangential force of
    /// a point by their weights, since a point that slips has both, and those to the scalars `by`.
    fn equation(
        &self,
        scale: f64,
        value: f64,
        response: impl Fn(usize, [f64; 2]) -> f64,
        by: impl Iterator<Item = f64>,
    ) -> Equation {
        let friction = self.state.point.contact.friction_coefficient;
        let pressed = self.contact.iter();
        // A slipping point's normal force brings mu N along.
        let pressed = pressed.map(|&i| (i, [1.0, friction * self.state.contact[i].drag()]));
        let sheared = self.stick.iter().map(|&i| (i, [0.0, 1.0]));
        let force = scale * self.force_scale; // For a unit of a scaled force.
        let mut row = Vec::with_capacity(self.size());
        row.extend(pressed.chain(sheared).map(|(i, weights)| force * response(i, weights)));
        row.extend(self.scalars().iter().zip(by).map(|((_, own), by)| scale * own * by));
        Equation { row, residual: scale * value }
    }

    /// That a law holds at a point, by columns of the circulant.
    fn law_at(&self, point: usize, law: usize) -> Equation {
        let linear = &self.linear;
        let [normal, tangential] = linear.columns.each_ref().map(|own| &own[law]);
        let response = |i: usize, [pressed, sheared]: [f64; 2]| {
            let lag = linear.wave.lag(i, point);
            pressed * normal[lag] + sheared * tangential[lag]
        };
        let scale = linear.scales[law] / self.force_scale;
        let value = [&linear.gap, &linear.slip][law][point];
        self.equation(scale, value, response, linear.by.iter().map(|by| by[law][point]))
    }

    /// That the real or the imaginary `part` of the first harmonic along a phase vanishes.
    fn first_harmonic(&self, wave: usize, part: impl Fn(c64) -> f64) -> Equation {
        let (grid, first) = (self.linear.wave, &self.linear.first[wave]);
        let response = |i: usize, [pressed, sheared]: [f64; 2]| {
            let [place, points] = [grid.places(i)[wave], grid.sides[wave]].map(|own| own as f64);
            let angle = -std::f64::consts::TAU * place / points; // A unit force there: e^{-i xi_i}.
            let response = pressed * first.row[0] + sheared * first.row[1];
            part(c64::from_polar(1.0, angle) * response)
        };
        let scale = self.linear.scales[0] / self.force_scale;
        self.equation(scale, part(first.value), response, first.by.iter().map(|by| part(*by)))
    }

    /// An equation for a few of the unknowns.
    fn equation_of(&self, factors: &[(usize, f64)], residual: f64) -> Equation {
        let mut row = vec![0.0; self.size()];
        factors.iter().for_each(|&(unknown, factor)| row[unknown] = factor);
        Equation { row, residual }
    }

    fn closure(&self, closure: Closure<'_>) -> Equation {
        let last = self.size() - 1;
        match closure {
            Closure::Event(event) => self.event(event),
            Closure::Value(value) => {
                let missed = self.parameter.of(&self.state.point) - value;
                self.equation_of(&[(last, 1.0)], missed / self.parameter_scale())
            }
            Closure::Amplitude(wave, value) => {
                let Equation { row, residual } = self.first_harmonic(wave, |own| own.re);
                let scale = self.linear.scales[0] / self.force_scale;
                Equation { row, residual: residual - scale * value }
            }
            Closure::Plane(heading, through) => {
                let row = self.scaled(heading);
                let offset = self.scaled(&Heading::between(through, self.state, self.parameter));
                let residual = row.iter().zip(&offset).map(|(a, b)| a * b).sum(); // heading . (state - through) = 0.
                Equation { row, residual }
            }
        }
    }

    /// That an inequality holds with equality.
    fn event(&self, event: Event) -> Equation {
        let i = event.point();
        let place = |list: &[usize]| list.binary_search(&i).expect("an active point");
        let (force, shear) = (self.state.normal[i], self.state.tangential[i]);
        let drag = match event {
            Event::Lift(_) => {
                return self.equation_of(&[(place(&self.contact), 1.0)], force / self.force_scale);
            }
            Event::Touch(_) => return self.law_at(i, GAP),
            Event::Rest(_) => return self.law_at(i, SLIP),
            Event::SlideForward(_) => 1.0,
            Event::SlideBackward(_) => -1.0,
        };
        let friction = self.state.point.contact.friction_coefficient;
        // d(mu N) = N dmu.
        let rise = self.parameter.friction_in(force * self.parameter_scale() / self.force_scale);
        let sheared = self.contact.len() + place(&self.stick);
        // mu N - drag T = 0.
        let factors = [(place(&self.contact), friction), (sheared, -drag), (self.size() - 1, rise)];
        self.equation_of(&factors, (friction * force - drag * shear) / self.force_scale)
    }

    /// Matrix and residual, scaled.
    pub fn assemble(&self, closure: Closure<'_>) -> (Mat<f64>, Vec<f64>) {
        let gaps = self.contact.iter().map(|&i| self.law_at(i, GAP));
        let slips = self.stick.iter().map(|&i| self.law_at(i, SLIP));
        // `Im(u_theta,1) = 0` along each phase.
        let waves = 0..self.state.phases.len();
        let waves = waves.map(|wave| self.first_harmonic(wave, |value| value.im));
        let equations = gaps.chain(slips).chain(waves).chain([self.closure(closure)]);
        let mut matrix = Mat::zeros(self.size(), self.size());
        let place = |(at, Equation { row, residual }): (usize, Equation)| {
            row.into_iter().enumerate().for_each(|(j, value)| matrix[(at, j)] = value);
            residual
        };
        let residual = equations.enumerate().map(place).collect();
        (matrix, residual)
    }

    /// Scaled components of a heading along the unknowns.
    fn scaled(&self, heading: &Heading) -> Vec<f64> {
        self.unknowns.iter().map(|&(place, scale)| heading.values[place] / scale).collect()
    }

    /// Distance from another state, in the measure in which headings have length one.
    pub fn distance(&self, other: &WaveState) -> f64 {
        let change = Heading::between(other, self.state, self.parameter);
        self.length(&self.scaled(&change))
    }

    /// Root of the mean square of the forces, and of the squares of frequency and parameter, all scaled.
    fn length(&self, scaled: &[f64]) -> f64 {
        let points = self.state.contact.len() as f64;
        let (forces, rest) = scaled.split_at(self.forces());
        let forces: f64 = forces.iter().map(|value| value * value).sum();
        let rest: f64 = rest.iter().map(|value| value * value).sum();
        (forces / points + rest).sqrt()
    }

    /// The change that takes the residual away.
    pub fn solve(&self, matrix: Mat<f64>, residual: &[f64]) -> Option<Heading> {
        let right_side = residual.iter().map(|value| -value).collect(); // J dx = -r.
        Some(self.heading(&self.solved(matrix, right_side)?))
    }

    /// Direction of the curve, its root mean square force, frequency and parameter changes of scaled length one, along
    /// `previous` where there is one.
    pub fn tangent(&self, previous: Option<&Heading>) -> Option<Heading> {
        let along = |heading| Closure::Plane(heading, self.state);
        let (matrix, _) = self.assemble(previous.map_or(Closure::Value(0.0), along));
        let mut right_side = vec![0.0; self.size()];
        right_side[self.size() - 1] = 1.0; // All equations stay as they are but for the closure.
        let solution = self.solved(matrix, right_side)?;
        let mut length = self.length(&solution);
        // The closure may have picked the plane at an angle beyond a right one.
        if let Some(previous) = previous {
            let along: f64 = self.scaled(previous).iter().zip(&solution).map(|(a, b)| a * b).sum();
            length = length.copysign(along);
        }
        let scaled: Vec<f64> = solution.iter().map(|value| value / length).collect();
        Some(self.heading(&scaled))
    }

    fn solved(&self, mut matrix: Mat<f64>, mut right_side: Vec<f64>) -> Option<Vec<f64>> {
        // Rows of one size, so that pivots are chosen fairly; column by column, as the matrix lies in memory.
        let mut largest = vec![0.0_f64; self.size()];
        for j in 0..self.size() {
            let rows = largest.iter_mut().enumerate();
            rows.for_each(|(row, largest)| *largest = largest.max(matrix[(row, j)].abs()));
        }
        largest.iter_mut().filter(|own| **own == 0.0).for_each(|own| *own = 1.0);
        for j in 0..self.size() {
            largest.iter().enumerate().for_each(|(row, largest)| matrix[(row, j)] /= largest);
        }
        right_side.iter_mut().zip(&largest).for_each(|(own, largest)| *own /= largest);
        let count = right_side.len();
        let columns = MatMut::from_column_major_slice_mut(&mut right_side, count, 1);
        DenseLu::factorize(matrix).solve_in_place(columns);
        right_side.iter().all(|value| value.is_finite()).then_some(right_side)
    }

    fn heading(&self, solution: &[f64]) -> Heading {
        let points = self.state.contact.len();
        let mut values = vec![0.0; 2 * points + 3];
        for (&(place, scale), value) in self.unknowns.iter().zip(solution) {
            values[place] = value * scale;
        }
        // Slipping points are dragged along, by as much more as the friction coefficient rises.
        let friction = self.state.point.contact.friction_coefficient;
        let rise = self.parameter.friction_in(values[2 * points + 2]);
        for &i in &self.contact {
            let drag = self.state.contact[i].drag();
            if drag != 0.0 {
                values[points + i] = drag * friction * values[i]; // dT = drag (mu dN + N dmu).
                values[points + i] += drag * self.state.normal[i] * rise;
            }
        }
        Heading { values, points }
    }
}
