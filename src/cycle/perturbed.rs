//! The contact conditions of a limit cycle, linearized for perturbations that ride on the wave.

use super::WaveBody;
use super::body::{DynamicCoefficients, Receptance};
use super::limit_cycle::LimitCycle;
use super::parameter::Parameter;
use super::state::PointState;
use super::wave::{Linearization, Wave};
use crate::linalg::ComplexDenseLu;
use faer::{Mat, MatMut, c64};
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

const ZERO: c64 = c64::new(0.0, 0.0);

/// A force that the perturbation changes, and the condition that goes with it.
#[derive(Clone, Copy, Debug)]
struct Unknown {
    point: usize,
    /// Normal and tangential force for a unit of the unknown.
    force: [f64; 2],
    /// Whether the condition is one of the slip velocity, else of the gap.
    is_slip: bool,
    /// Jump of the force (N/m) at a boundary that the perturbation moves; `None` away from boundaries.
    jump: Option<f64>,
    /// What the unknown itself adds to the condition, m or m/s for each N/m.
    compliance: f64,
}

/// A limit cycle with its contact states held, seen by perturbations of one class.
pub(super) struct Perturbed<'a> {
    body: &'a WaveBody,
    cycle: &'a LimitCycle,
    landing_time: f64,
    /// Highest temporal harmonic `K`.
    highest: isize,
    inverse: Arc<dyn Fft<f64>>,
    unknowns: Vec<Unknown>,
}

impl<'a> Perturbed<'a> {
    /// `body` holds the harmonics `p + k n`, `k = -K..=K` in rising order.
    pub fn new(body: &'a WaveBody, wave: &Wave<'_>, cycle: &'a LimitCycle) -> Self {
        Self {
            body,
            cycle,
            landing_time: wave.landing_share() * TAU / cycle.state.frequency,
            highest: (wave.points() / 2) as isize,
            inverse: FftPlanner::new().plan_fft_inverse(wave.points()),
            unknowns: unknowns(wave, cycle),
        }
    }

    /// The same cycle, seen by the class that `body` holds.
    pub fn with_body<'b>(&self, body: &'b WaveBody) -> Perturbed<'b>
    where
        'a: 'b,
    {
        Perturbed {
            body,
            cycle: self.cycle,
            landing_time: self.landing_time,
            highest: self.highest,
            inverse: Arc::clone(&self.inverse),
            unknowns: self.unknowns.clone(),
        }
    }

    /// `omega`, rad/s.
    pub fn frequency(&self) -> f64 {
        self.cycle.state.frequency
    }

    fn points(&self) -> usize {
        self.cycle.state.normal.len()
    }

    /// Number of a temporal harmonic, symbol of its velocity and receptance of the edge, for each harmonic.
    fn responses(&self, exponent: c64) -> impl Iterator<Item = (isize, c64, Receptance)> + '_ {
        let omega = self.frequency();
        let step = TAU / (omega * self.points() as f64);
        let harmonics = (-self.highest..=self.highest).enumerate();
        harmonics.map(move |(index, k)| {
            let shifted = exponent + c64::new(0.0, k as f64 * omega);
            let angle = shifted * step;
            let rate = (8.0 * angle.sinh() - (2.0 * angle).sinh()) / (6.0 * step);
            let back = (-angle).exp();
            let contact_rate = (1.0 - back) / step;
            let at = DynamicCoefficients::new(rate, &self.cycle.state.point.damping);
            (k, contact_rate, self.body.receptance(index, at, []).0)
        })
    }

    /// `A(lambda)`: contact conditions of unit forces, `gap + tau v_n` at points in contact and `v_theta` at points that
    /// stick, in units of what a force does at its own point.
    fn matrix(&self, exponent: c64) -> Mat<c64> {
        let points = self.points();
        let mut columns = vec![vec![ZERO; points]; 4];
        for (k, rate, r) in self.responses(exponent) {
            let ahead = 1.0 + self.landing_time * rate;
            let place = k.rem_euclid(points as isize) as usize;
            for j in 0..2 {
                columns[j][place] = ahead * r[(0, j)];
                columns[2 + j][place] = rate * r[(1, j)];
            }
        }
        for column in &mut columns {
            self.inverse.process(column);
            column.iter_mut().for_each(|x| *x /= points as f64);
        }
        let scales = [columns[0][0], columns[3][0]].map(|own| 1.0 / own.norm());
        let size = self.unknowns.len();
        Mat::from_fn(size, size, |row, j| {
            let (condition, unknown) = (&self.unknowns[row], &self.unknowns[j]);
            let pair = 2 * usize::from(condition.is_slip);
            let lag = (condition.point + points - unknown.point) % points;
            let [normal, tangential] = unknown.force;
            let mut value = normal * columns[pair][lag] + tangential * columns[pair + 1][lag];
            if row == j {
                value += condition.compliance;
            }
            value * scales[usize::from(condition.is_slip)]
        })
    }

    /// Lets the wave shift in phase for nothing, as it can in truth: `A(0)` of class zero is singular.
    ///
    /// A point that lands finds its force at once. Where a perturbation moves the boundary by `d xi`, the force between
    /// its old and its new place changes by the whole jump, in proportion to the gap: a compliance between
    /// the force on the last open point and its gap. Its size depends on where between two phases the boundary lies,
    /// which no phase tells; but a shift of the whole wave must cost nothing, and that fixes it:
    /// `det(A + c e e^T) = 0` at `c = -1 / (A^-1)_ee`. With several boundaries, the largest jump is used so.
    /// Without landing it is the boundary at which slip comes to rest.
    pub fn calibrate(&mut self) {
        let jump = |unknown: &Unknown| unknown.jump.unwrap_or(0.0).abs();
        let landing = |unknown: &Unknown| unknown.jump.is_some() && !unknown.is_slip;
        let has_landing = self.unknowns.iter().any(landing);
        let boundaries = (0..self.unknowns.len()).filter(|&j| {
            let unknown = &self.unknowns[j];
            unknown.jump.is_some() && (landing(unknown) || !has_landing)
        });
        let largest =
            boundaries.max_by(|&i, &j| jump(&self.unknowns[i]).total_cmp(&jump(&self.unknowns[j])));
        let Some(j) = largest else {
            return;
        };
        self.unknowns[j].compliance = 0.0;
        let rigid = self.matrix(ZERO);
        let mut column = vec![ZERO; self.unknowns.len()];
        // A unit of compliance adds the scale of its row.
        self.unknowns[j].compliance = 1.0;
        column[j] = self.matrix(ZERO)[(j, j)] - rigid[(j, j)];
        self.solve(rigid, &mut column);
        self.unknowns[j].compliance = -1.0 / column[j].re;
    }

    fn solve(&self, matrix: Mat<c64>, column: &mut [c64]) {
        let view = MatMut::from_column_major_slice_mut(column, self.unknowns.len(), 1);
        ComplexDenseLu::factorize(matrix).solve_in_place(view);
    }

    /// Forces `A^-1 c` for a fixed `c` that no exponent's mode is orthogonal to but by chance.
    fn forces(&self, exponent: c64) -> Vec<c64> {
        let size = self.unknowns.len();
        let mut column: Vec<c64> = (0..size)
            .map(|i| entry(i, 0.618_033_988_749_894_9))
            .collect();
        self.solve(self.matrix(exponent), &mut column);
        column
    }

    /// `b^T A^-1 c`, whose poles are the exponents.
    pub fn response(&self, exponent: c64) -> c64 {
        let forces = self.forces(exponent);
        let terms = forces.iter().enumerate();
        terms
            .map(|(i, x)| x * entry(i, 0.754_877_666_246_692_7))
            .sum()
    }

    /// Whether the phases carry temporal harmonic `k`: six of them to a period, or more.
    pub fn resolves(&self, k: isize) -> bool {
        6 * k.unsigned_abs() <= self.points()
    }

    /// Temporal harmonic `k` at which the mode of an exponent moves the edge most.
    pub fn dominant_harmonic(&self, exponent: c64) -> isize {
        // Close to the exponent any right-hand side answers with its mode.
        let nearby = exponent + c64::new(1e-7 * self.frequency(), 0.0);
        let mut forces = vec![[ZERO; 2]; self.points()];
        for (unknown, value) in self.unknowns.iter().zip(self.forces(nearby)) {
            for (place, share) in forces[unknown.point].iter_mut().zip(unknown.force) {
                *place += value * share;
            }
        }
        let harmonic = |k: isize, component: usize| -> c64 {
            let step = -TAU * k as f64 / self.points() as f64;
            let terms = forces.iter().enumerate();
            terms
                .map(|(i, force)| force[component] * c64::from_polar(1.0, step * i as f64))
                .sum()
        };
        let motion = self.responses(nearby).map(|(k, _, r)| {
            let force = [harmonic(k, 0), harmonic(k, 1)];
            let moved = |row: usize| r[(row, 0)] * force[0] + r[(row, 1)] * force[1];
            (k, moved(0).norm_sqr() + moved(1).norm_sqr())
        });
        motion
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0, |largest| largest.0)
    }
}

/// Multiples of an irrational number modulo one, centred: a vector without structure, the same on every machine.
fn entry(i: usize, step: f64) -> c64 {
    c64::new(2.0 * ((i + 1) as f64 * step).fract() - 1.0, 0.0)
}

/// Forces in contact, in stick, and at boundaries over which the force jumps.
fn unknowns(wave: &Wave<'_>, cycle: &LimitCycle) -> Vec<Unknown> {
    let state = &cycle.state;
    let linear = Linearization::at(wave, state, Parameter::RotationSpeed);
    let count = state.contact.len();
    let friction = state.point.contact.friction_coefficient;
    let mut unknowns = Vec::new();
    for i in 0..count {
        let (here, next, before) = (state.contact[i], (i + 1) % count, (i + count - 1) % count);
        let mut push = |force: [f64; 2], is_slip: bool, jump: Option<f64>, compliance: f64| {
            unknowns.push(Unknown {
                point: i,
                force,
                is_slip,
                jump,
                compliance,
            });
        };
        if here != PointState::Open {
            push([1.0, friction * here.drag()], false, None, 0.0);
        }
        if here == PointState::Stick {
            push([0.0, 1.0], true, None, 0.0);
        }
        // Over one phase of width h: d f h = -jump d xi with d xi = -d s / s'.
        let (normal, tangential) = (state.normal[next], state.tangential[next]);
        let lands = here == PointState::Open && state.contact[next] != PointState::Open;
        if lands && normal > 0.0 {
            let closing = linear.gap[before] - linear.gap[i];
            let force = [1.0, tangential / normal];
            push(force, false, Some(normal), (closing / normal).max(0.0));
        }
        let rests = here.drag() != 0.0 && state.contact[next] == PointState::Stick;
        let jump = here.drag() * friction * normal - tangential;
        let slowing = linear.slip[i] - linear.slip[before];
        // A force without jump, or against the trend of the motion, is not carried along.
        if rests && slowing / jump > 0.0 {
            push([0.0, 1.0], true, Some(jump), slowing / jump);
        }
    }
    unknowns
}
