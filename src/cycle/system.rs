//! The linear systems of one step along a branch.

use super::parameter::Parameter;
use super::state::{Event, PointState, WaveState};
use super::wave::Linearization;
use crate::linalg::{DenseLu, Mat, MatMut, c64};

/// A change of forces, frequency and parameter.
#[derive(Clone, Debug)]
pub struct Heading {
    /// Change of the normal force at each point.
    pub normal: Vec<f64>,
    /// Change of the tangential force.
    pub tangential: Vec<f64>,
    /// Change of the frequency.
    pub frequency: f64,
    /// Change of the parameter.
    pub parameter: f64,
}

impl Heading {
    /// From one state to another.
    pub fn between(from: &WaveState, to: &WaveState, parameter: Parameter) -> Self {
        let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| b - a).collect();
        Self {
            normal: difference(&from.normal, &to.normal),
            tangential: difference(&from.tangential, &to.tangential),
            frequency: to.frequency - from.frequency,
            parameter: parameter.of(&to.point) - parameter.of(&from.point),
        }
    }

    /// Turns it round.
    pub fn reverse(&mut self) {
        self.normal.iter_mut().for_each(|value| *value = -*value);
        self.tangential
            .iter_mut()
            .for_each(|value| *value = -*value);
        self.frequency = -self.frequency;
        self.parameter = -self.parameter;
    }

    /// Moves a state by `length` times this; contact laws with fixed drag hold exactly afterwards.
    pub fn add_to(&self, state: &mut WaveState, length: f64, parameter: Parameter) {
        for i in 0..self.normal.len() {
            state.normal[i] += length * self.normal[i];
            state.tangential[i] += length * self.tangential[i];
        }
        state.frequency += length * self.frequency;
        let value = parameter.of(&state.point) + length * self.parameter;
        parameter.set(&mut state.point, value);
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
    /// The point lies in the plane across a heading through a state.
    Plane(&'a Heading, &'a WaveState),
    /// Only the direction along a heading matters (for tangents).
    Along(&'a Heading),
    /// Only the direction of the parameter matters (for tangents).
    AlongParameter,
}

/// The unknowns of one set of contact states: normal forces in contact, tangential forces in stick, frequency,
/// parameter.
///
/// All unknowns and equations are scaled: forces by the mean normal force, the frequency by a hundredth of itself,
/// the parameter by itself.
pub struct System<'a> {
    state: &'a WaveState,
    parameter: Parameter,
    contact: Vec<usize>,
    stick: Vec<usize>,
    force_scale: f64,
    frequency_scale: f64,
    parameter_scale: f64,
}

impl<'a> System<'a> {
    /// The unknowns of `state`.
    pub fn new(state: &'a WaveState, parameter: Parameter, force_scale: f64) -> Self {
        let (contact, stick) = state.active();
        Self {
            state,
            parameter,
            contact,
            stick,
            force_scale,
            frequency_scale: 0.01 * state.frequency,
            parameter_scale: parameter.of(&state.point).abs().max(1e-12),
        }
    }

    fn size(&self) -> usize {
        self.contact.len() + self.stick.len() + 2
    }

    /// A row of responses at `row`: columns of the circulant, drag of slipping points included.
    fn response_row(
        &self,
        matrix: &mut Mat<f64>,
        at: usize,
        row: usize,
        columns: &[Vec<f64>; 2],
        by: [&Vec<f64>; 2],
        scale: f64,
    ) {
        let points = self.state.contact.len();
        let friction = self.state.point.contact.friction_coefficient;
        let lag = |i: usize| if row >= i { row - i } else { row + points - i };
        let force = scale * self.force_scale;
        for (j, &i) in self.contact.iter().enumerate() {
            let drag = friction * self.state.contact[i].drag();
            matrix[(at, j)] = force * (columns[0][lag(i)] + drag * columns[1][lag(i)]);
        }
        for (j, &i) in self.stick.iter().enumerate() {
            matrix[(at, self.contact.len() + j)] = force * columns[1][lag(i)];
        }
        let end = self.size();
        matrix[(at, end - 2)] = scale * self.frequency_scale * by[0][row];
        matrix[(at, end - 1)] = scale * self.parameter_scale * by[1][row];
    }

    /// Matrix and residual, scaled.
    pub fn assemble(&self, linear: &Linearization, closure: Closure<'_>) -> (Mat<f64>, Vec<f64>) {
        let size = self.size();
        let mut matrix = Mat::zeros(size, size);
        let mut residual = vec![0.0; size];
        let normal = linear.normal_scale() / self.force_scale;
        let tangential = linear.tangential_scale() / self.force_scale;
        let gap_by = [&linear.by_frequency[0], &linear.by_parameter[0]];
        let slip_by = [&linear.by_frequency[1], &linear.by_parameter[1]];
        for (at, &i) in self.contact.iter().enumerate() {
            self.response_row(&mut matrix, at, i, &linear.gap_columns, gap_by, normal);
            residual[at] = normal * linear.gap[i];
        }
        for (j, &i) in self.stick.iter().enumerate() {
            let at = self.contact.len() + j;
            self.response_row(
                &mut matrix,
                at,
                i,
                &linear.slip_columns,
                slip_by,
                tangential,
            );
            residual[at] = tangential * linear.slip[i];
        }
        self.phase_row(&mut matrix, &mut residual, linear, normal);
        self.closure_row(&mut matrix, &mut residual, linear, closure);
        (matrix, residual)
    }

    /// `Im(u_theta,1) = 0`.
    fn phase_row(
        &self,
        matrix: &mut Mat<f64>,
        residual: &mut [f64],
        linear: &Linearization,
        scale: f64,
    ) {
        let at = self.size() - 2;
        let points = self.state.contact.len() as f64;
        let friction = self.state.point.contact.friction_coefficient;
        let turn = |i: usize| c64::from_polar(1.0, -std::f64::consts::TAU * i as f64 / points);
        let force = scale * self.force_scale;
        for (j, &i) in self.contact.iter().enumerate() {
            let drag = friction * self.state.contact[i].drag();
            let response = turn(i) * (linear.first_row[0] + drag * linear.first_row[1]);
            matrix[(at, j)] = force * response.im;
        }
        for (j, &i) in self.stick.iter().enumerate() {
            let response = turn(i) * linear.first_row[1];
            matrix[(at, self.contact.len() + j)] = force * response.im;
        }
        matrix[(at, at)] = scale * self.frequency_scale * linear.first_by[0].im;
        matrix[(at, at + 1)] = scale * self.parameter_scale * linear.first_by[1].im;
        residual[at] = scale * linear.first.im;
    }

    fn closure_row(
        &self,
        matrix: &mut Mat<f64>,
        residual: &mut [f64],
        linear: &Linearization,
        closure: Closure<'_>,
    ) {
        let at = self.size() - 1;
        match closure {
            Closure::Event(event) => self.event_row(matrix, residual, linear, event),
            Closure::Value(value) => {
                matrix[(at, at)] = 1.0;
                residual[at] =
                    (self.parameter.of(&self.state.point) - value) / self.parameter_scale;
            }
            Closure::AlongParameter => matrix[(at, at)] = 1.0,
            Closure::Along(heading) => {
                for (j, value) in self.scaled(heading).into_iter().enumerate() {
                    matrix[(at, j)] = value;
                }
            }
            Closure::Plane(heading, through) => {
                let row = self.scaled(heading);
                let offset = self.scaled(&Heading::between(through, self.state, self.parameter));
                residual[at] = row.iter().zip(&offset).map(|(a, b)| a * b).sum();
                for (j, value) in row.into_iter().enumerate() {
                    matrix[(at, j)] = value;
                }
            }
        }
    }

    fn event_row(
        &self,
        matrix: &mut Mat<f64>,
        residual: &mut [f64],
        linear: &Linearization,
        event: Event,
    ) {
        let at = self.size() - 1;
        let normal = linear.normal_scale() / self.force_scale;
        let tangential = linear.tangential_scale() / self.force_scale;
        let place = |list: &[usize], i: usize| list.binary_search(&i).expect("an active point");
        match event {
            Event::Lift(i) => {
                matrix[(at, place(&self.contact, i))] = 1.0;
                residual[at] = self.state.normal[i] / self.force_scale;
            }
            Event::Touch(i) => {
                let by = [&linear.by_frequency[0], &linear.by_parameter[0]];
                self.response_row(matrix, at, i, &linear.gap_columns, by, normal);
                residual[at] = normal * linear.gap[i];
            }
            Event::Rest(i) => {
                let by = [&linear.by_frequency[1], &linear.by_parameter[1]];
                self.response_row(matrix, at, i, &linear.slip_columns, by, tangential);
                residual[at] = tangential * linear.slip[i];
            }
            Event::SlideForward(i) | Event::SlideBackward(i) => {
                let drag = match event {
                    Event::SlideForward(_) => PointState::SlipForward.drag(),
                    _ => PointState::SlipBackward.drag(),
                };
                let friction = self.state.point.contact.friction_coefficient;
                let (force, shear) = (self.state.normal[i], self.state.tangential[i]);
                matrix[(at, place(&self.contact, i))] = friction;
                matrix[(at, self.contact.len() + place(&self.stick, i))] = -drag;
                if self.parameter == Parameter::FrictionCoefficient {
                    matrix[(at, at)] = force * self.parameter_scale / self.force_scale;
                }
                residual[at] = (friction * force - drag * shear) / self.force_scale;
            }
        }
    }

    /// Scaled components of a heading along the unknowns.
    fn scaled(&self, heading: &Heading) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.size());
        values.extend(
            self.contact
                .iter()
                .map(|&i| heading.normal[i] / self.force_scale),
        );
        values.extend(
            self.stick
                .iter()
                .map(|&i| heading.tangential[i] / self.force_scale),
        );
        values.push(heading.frequency / self.frequency_scale);
        values.push(heading.parameter / self.parameter_scale);
        values
    }

    /// Distance from another state, in the measure in which headings have length one.
    pub fn distance(&self, other: &WaveState) -> f64 {
        let change = Heading::between(other, self.state, self.parameter);
        self.length(&self.scaled(&change))
    }

    /// Root of the mean square of the forces, and of the squares of frequency and parameter, all scaled.
    fn length(&self, scaled: &[f64]) -> f64 {
        let points = self.state.contact.len() as f64;
        let (forces, rest) = scaled.split_at(self.size() - 2);
        let forces: f64 = forces.iter().map(|value| value * value).sum();
        let rest: f64 = rest.iter().map(|value| value * value).sum();
        (forces / points + rest).sqrt()
    }

    /// The change that takes the residual away.
    pub fn solve(&self, matrix: Mat<f64>, residual: &[f64]) -> Option<Heading> {
        let right_side = residual.iter().map(|value| -value).collect();
        Some(self.heading(&self.solved(matrix, right_side)?))
    }

    /// Direction of the curve, its root mean square force, frequency and parameter changes of scaled length one, along
    /// `previous` where there is one.
    pub fn tangent(&self, linear: &Linearization, previous: Option<&Heading>) -> Option<Heading> {
        let closure = previous.map_or(Closure::AlongParameter, Closure::Along);
        let (matrix, _) = self.assemble(linear, closure);
        let mut right_side = vec![0.0; self.size()];
        right_side[self.size() - 1] = 1.0;
        let solution = self.solved(matrix, right_side)?;
        let mut length = self.length(&solution);
        // The closure may have picked the plane at an angle beyond a right one.
        if let Some(previous) = previous {
            let row = self.scaled(previous);
            let along: f64 = row.iter().zip(&solution).map(|(a, b)| a * b).sum();
            length = length.copysign(along);
        }
        let scaled: Vec<f64> = solution.iter().map(|value| value / length).collect();
        Some(self.heading(&scaled))
    }

    fn solved(&self, mut matrix: Mat<f64>, mut right_side: Vec<f64>) -> Option<Vec<f64>> {
        // Rows of one size, so that pivots are chosen fairly.
        for row in 0..self.size() {
            let largest = (0..self.size()).fold(0.0_f64, |m, j| m.max(matrix[(row, j)].abs()));
            if largest > 0.0 {
                (0..self.size()).for_each(|j| matrix[(row, j)] /= largest);
                right_side[row] /= largest;
            }
        }
        let count = right_side.len();
        let columns = MatMut::from_column_major_slice_mut(&mut right_side, count, 1);
        DenseLu::factorize(matrix).solve_in_place(columns);
        let is_finite = right_side.iter().all(|value| value.is_finite());
        is_finite.then_some(right_side)
    }

    fn heading(&self, solution: &[f64]) -> Heading {
        let points = self.state.contact.len();
        let friction = self.state.point.contact.friction_coefficient;
        let end = self.size();
        let parameter = solution[end - 1] * self.parameter_scale;
        let mut heading = Heading {
            normal: vec![0.0; points],
            tangential: vec![0.0; points],
            frequency: solution[end - 2] * self.frequency_scale,
            parameter,
        };
        for (j, &i) in self.contact.iter().enumerate() {
            heading.normal[i] = solution[j] * self.force_scale;
            let drag = self.state.contact[i].drag();
            heading.tangential[i] = drag * friction * heading.normal[i];
            if self.parameter == Parameter::FrictionCoefficient {
                heading.tangential[i] += drag * self.state.normal[i] * parameter;
            }
        }
        for (j, &i) in self.stick.iter().enumerate() {
            heading.tangential[i] = solution[self.contact.len() + j] * self.force_scale;
        }
        heading
    }
}
