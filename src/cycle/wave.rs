//! Forces and motion of a rotating wave on points along its phase.
//!
//! The wave `u(r, theta, t) = U(r, xi)`, `xi = n theta + omega t`, is sampled at an odd number `M` of phases
//! `xi_i = 2 pi i / M`. Time steps of `h = 2 pi / (omega M)` take each contact node from one phase to the next, so
//! that the discrete Fourier transform over the phases turns the equation of motion into one receptance for each
//! temporal harmonic `k`. With `phi = 2 pi k / M`, motion has the velocity of central differences of fourth order,
//! contact that of the last step:
//!
//! ```text
//! v = i s u,   s = (8 sin phi - sin 2 phi) / (6 h),   D = K_kn + i s C - s^2 M
//! v = b u,     b = (1 - e^{-i phi}) / h               in the gap and in the slip velocity
//! ```
//!
//! Both reach a few neighbours only: a jump of the force disturbs the phases around it, and no others. `s` is real, so that
//! the motion itself neither gains nor loses energy; `b` looks back, so that a point that touches can only push.

use super::body::{DynamicCoefficients, Receptance, WaveBody};
use super::parameter::{OperatingPoint, Parameter};
use super::state::WaveState;
use crate::fem::RayleighDamping;
use crate::linalg::c64;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A wave of one body on a grid of phases.
#[derive(Clone)]
pub struct Wave<'a> {
    /// The body.
    pub body: &'a WaveBody,
    points: usize,
    landing_share: f64,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
}

impl<'a> Wave<'a> {
    /// The wave on `2 K + 1` points, with `K + 1` harmonics in `body`, landing over `landing_share` of its period.
    pub fn new(body: &'a WaveBody, landing_share: f64) -> Self {
        let points = 2 * body.harmonic_count() - 1;
        let mut planner = FftPlanner::new();
        Self {
            body,
            points,
            landing_share,
            forward: planner.plan_fft_forward(points),
            inverse: planner.plan_fft_inverse(points),
        }
    }

    /// Number of points along the phase.
    pub fn points(&self) -> usize {
        self.points
    }

    /// `s / omega` of harmonic `k`: `k` itself in the limit of many points.
    pub fn order(&self, k: usize) -> f64 {
        let step = TAU / self.points as f64;
        let angle = k as f64 * step;
        (8.0 * angle.sin() - (2.0 * angle).sin()) / (6.0 * step)
    }

    /// `b / omega` of harmonic `k`: `i k` in the limit of many points.
    pub fn contact_order(&self, k: usize) -> c64 {
        let step = TAU / self.points as f64;
        let back = c64::from_polar(1.0, -(k as f64) * step);
        (1.0 - back) / step
    }

    /// Factor that turns a displacement into `u + tau v`.
    pub fn look_ahead(&self, k: usize) -> c64 {
        1.0 + TAU * self.landing_share * self.contact_order(k)
    }

    /// Harmonics `0..=K` of values on the points, `sum_i f_i e^{-i k xi_i}`.
    pub fn harmonics(&self, values: &[f64]) -> Vec<c64> {
        let mut spectrum: Vec<c64> = values.iter().map(|&value| c64::new(value, 0.0)).collect();
        self.forward.process(&mut spectrum);
        spectrum.truncate(self.points / 2 + 1);
        spectrum
    }

    /// Values on the points of harmonics `0..=K`, the inverse of [`Self::harmonics`].
    pub fn values(&self, harmonics: impl IntoIterator<Item = c64>) -> Vec<f64> {
        let scale = 1.0 / self.points as f64;
        let mut spectrum = vec![c64::new(0.0, 0.0); self.points];
        for (k, value) in harmonics.into_iter().enumerate() {
            spectrum[k] = value * scale;
            if k > 0 {
                spectrum[self.points - k] = spectrum[k].conj();
            } else {
                spectrum[0].im = 0.0;
            }
        }
        self.inverse.process(&mut spectrum);
        spectrum.into_iter().map(|value| value.re).collect()
    }
}

/// The contact edge around one state: residuals, their derivatives, and the columns of its circulant responses.
pub struct Linearization {
    /// `u_r + tau v_r - delta` at each point, m.
    pub gap: Vec<f64>,
    /// `v_theta - Omega a` at each point, m/s.
    pub slip: Vec<f64>,
    /// Derivatives of gap and slip with the frequency, forces fixed.
    pub by_frequency: [Vec<f64>; 2],
    /// Derivatives of gap and slip with the parameter, free forces fixed.
    pub by_parameter: [Vec<f64>; 2],
    /// Response of the gap, at rising phase, to a unit normal and tangential force at phase zero.
    pub gap_columns: [Vec<f64>; 2],
    /// Response of the tangential velocity.
    pub slip_columns: [Vec<f64>; 2],
    /// Forces for a unit of gap and of velocity.
    scales: [f64; 2],
    /// First harmonic of the tangential displacement (m), turned back by the state's origin, for unit first harmonics of
    /// the forces.
    pub first_row: [c64; 2],
    /// First harmonic of the tangential displacement of the edge, m.
    pub first: c64,
    /// Its derivatives with the frequency and the parameter.
    pub first_by: [c64; 2],
}

/// What a unit of both forces does at one harmonic, and its derivatives with frequency and parameter.
struct HarmonicResponse {
    slip_rate: c64,
    receptance: Receptance,
    changes: [Receptance; 2],
    slip_rate_changes: [c64; 2],
}

impl HarmonicResponse {
    fn new(
        wave: &Wave<'_>,
        k: usize,
        frequency: f64,
        point: &OperatingPoint,
        parameter: Parameter,
    ) -> Self {
        let still = RayleighDamping {
            mass_coefficient: 0.0,
            stiffness_coefficient: 0.0,
        };
        let rate = c64::new(0.0, frequency * wave.order(k));
        let rate_changes = [c64::new(0.0, wave.order(k)), c64::new(0.0, 0.0)];
        let damping = &point.damping;
        let mut by_damping = still;
        match parameter {
            Parameter::MassDamping => by_damping.mass_coefficient = 1.0,
            Parameter::StiffnessDamping => by_damping.stiffness_coefficient = 1.0,
            _ => {}
        }
        let (receptance, changes) = wave.body.receptance(
            k,
            DynamicCoefficients::new(rate, damping),
            [
                DynamicCoefficients::derivative(rate, damping, rate_changes[0], &still),
                DynamicCoefficients::derivative(rate, damping, rate_changes[1], &by_damping),
            ],
        );
        Self {
            slip_rate: frequency * wave.contact_order(k),
            receptance,
            changes,
            slip_rate_changes: [wave.contact_order(k), c64::new(0.0, 0.0)],
        }
    }

    /// Displacement of the edge, and its derivatives.
    fn displacement(&self, force: [c64; 2]) -> [[c64; 2]; 3] {
        let times =
            |m: &Receptance| [0, 1].map(|row| m[(row, 0)] * force[0] + m[(row, 1)] * force[1]);
        [
            times(&self.receptance),
            times(&self.changes[0]),
            times(&self.changes[1]),
        ]
    }
}

impl Linearization {
    /// Linearizes the edge around `state` with respect to forces, frequency and `parameter`.
    pub fn at(wave: &Wave<'_>, state: &WaveState, parameter: Parameter) -> Self {
        let responses: Vec<HarmonicResponse> = (0..wave.body.harmonic_count())
            .map(|k| HarmonicResponse::new(wave, k, state.frequency, &state.point, parameter))
            .collect();
        let enumerated = || responses.iter().enumerate();
        let gap_column = |j: usize| {
            wave.values(enumerated().map(|(k, r)| wave.look_ahead(k) * r.receptance[(0, j)]))
        };
        let slip_column =
            |j: usize| wave.values(enumerated().map(|(_, r)| r.slip_rate * r.receptance[(1, j)]));
        let normal = wave.harmonics(&state.normal);
        let tangential = wave.harmonics(&state.tangential);
        let moved: Vec<[[c64; 2]; 3]> = enumerated()
            .map(|(k, r)| r.displacement([normal[k], tangential[k]]))
            .collect();
        let gap_of = |which: usize| {
            wave.values(enumerated().map(|(k, _)| wave.look_ahead(k) * moved[k][which][0]))
        };
        let velocity_change = |which: usize| {
            wave.values(enumerated().map(|(k, r)| {
                let change = r.slip_rate_changes[which];
                r.slip_rate * moved[k][1 + which][1] + change * moved[k][0][1]
            }))
        };
        let mut gap = gap_of(0);
        let mut slip = wave.values(enumerated().map(|(k, r)| r.slip_rate * moved[k][0][1]));
        let contact = &state.point.contact;
        gap.iter_mut().for_each(|gap| *gap -= contact.interference);
        let surface_speed = contact.rotation_speed * wave.body.radius;
        slip.iter_mut().for_each(|slip| *slip -= surface_speed);

        let share = c64::from_polar(2.0 / wave.points as f64, -state.origin);
        let first_row = [0, 1].map(|j| share * responses[1].receptance[(1, j)]);
        let mut first_by = [share * moved[1][1][1], share * moved[1][2][1]];
        let mut by_parameter = [gap_of(2), velocity_change(1)];
        match parameter {
            Parameter::FrictionCoefficient => {
                let change: Vec<f64> = state.slipping_normal();
                let change = wave.harmonics(&change);
                let respond = |row: usize, k: usize| responses[k].receptance[(row, 1)] * change[k];
                by_parameter = [
                    wave.values(enumerated().map(|(k, _)| wave.look_ahead(k) * respond(0, k))),
                    wave.values(enumerated().map(|(k, r)| r.slip_rate * respond(1, k))),
                ];
                first_by[1] = share * respond(1, 1);
            }
            Parameter::RotationSpeed | Parameter::Speed => by_parameter[1].fill(-wave.body.radius),
            Parameter::Interference => by_parameter[0].fill(-1.0),
            Parameter::MassDamping | Parameter::StiffnessDamping => {}
        }
        let gap_columns = [gap_column(0), gap_column(1)];
        let slip_columns = [slip_column(0), slip_column(1)];
        Self {
            gap,
            slip,
            by_frequency: [gap_of(1), velocity_change(0)],
            by_parameter,
            scales: [&gap_columns[0], &slip_columns[1]].map(|column| 1.0 / largest(column)),
            gap_columns,
            slip_columns,
            first_row,
            first: share * moved[1][0][1],
            first_by,
        }
    }

    /// Normal force for a unit of gap, N/m for each m: what closes it where the response is largest. The point's own
    /// response will not do: with little damping a resonance can take it through zero.
    pub fn normal_scale(&self) -> f64 {
        self.scales[0]
    }

    /// Tangential force for a unit of velocity, likewise.
    pub fn tangential_scale(&self) -> f64 {
        self.scales[1]
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0_f64, |m, value| m.max(value.abs()))
}

impl Wave<'_> {
    /// Displacement of every free node outwards at harmonic `k` for that of the edge.
    pub fn profile(
        &self,
        k: usize,
        rate: c64,
        damping: &RayleighDamping,
        edge: [c64; 2],
    ) -> Vec<[c64; 2]> {
        self.body
            .profile(k, DynamicCoefficients::new(rate, damping), edge)
    }
}
