//! Forces and motion of a rotating wave on points along its phase.
//!
//! The wave `u(r, theta, t) = U(r, xi)`, `xi = n theta + omega t`, is sampled at an odd number `M` of phases `xi_i = 2 pi i / M`. Time
//! steps of `h = 2 pi / (omega M)` take each contact node from one phase to the next. So the discrete Fourier transform over the phases
//! turns the equation of motion into one receptance for each temporal harmonic `k`. With `phi = 2 pi k / M`, motion has the velocity of
//! central differences of fourth order, contact that of the last step:
//!
//! ```text
//! v = i s u,   s = (8 sin phi - sin 2 phi) / (6 h),   D = K_kn + i s C - s^2 M
//! v = b u,     b = (1 - e^{-i phi}) / h               in the gap and in the slip velocity
//! ```
//!
//! Both reach a few neighbours only: a jump of the force disturbs the phases around it, and no others. `s` is real, so that
//! the motion itself neither gains nor loses energy; `b` looks back, so that a point that touches can only push.
//!
//! Two waves at once, `U(r, xi_1, xi_2)` with `xi_a = n_a theta + omega_a t`, are the same on a grid of both phases. Harmonic `(k_1, k_2)`
//! has `n = k_1 n_1 + k_2 n_2` around the circumference; `s` and `b` are the sums of those along either phase.

use super::CycleError;
use super::body::{DiscModel, DynamicCoefficients, Receptance, WaveBody};
use super::grid::landing_share;
use super::parameter::Parameter;
use super::state::WaveState;
use crate::fem::RayleighDamping;
use crate::linalg::c64;
use crate::signal::{Fft, forward_transform, inverse_transform};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A wave of one body on a grid of phases, or two waves on a grid of both.
pub struct Wave {
    /// The body.
    pub body: WaveBody,
    /// Points along the first and the second phase; 1 along the second where there is none.
    pub sides: [usize; 2],
    landing_share: f64,
    /// `omega_2 / omega_1` in the look ahead of the gap.
    ratio: f64,
    /// Harmonics `(k_1, k_2)`, one of each conjugate pair.
    orders: Vec<[isize; 2]>,
    forward: [Arc<dyn Fft<f64>>; 2],
    inverse: [Arc<dyn Fft<f64>>; 2],
}

/// Harmonics `(k_1, k_2)` that a grid of odd sides holds, one of each conjugate pair: `(0, 0), (1, 0), ...` first, then those of
/// rising `k_2 > 0`.
fn orders([first, second]: [usize; 2]) -> Vec<[isize; 2]> {
    let [most, rows] = [first, second].map(|side| (side / 2) as isize);
    // One of each conjugate pair.
    let row = |k_2: isize| (if k_2 == 0 { 0 } else { -most }..=most).map(move |k_1| [k_1, k_2]);
    (0..=rows).flat_map(row).collect()
}

impl Wave {
    /// One wave of a disc or two, of these circumferential harmonics and about these frequencies (rad/s), 0 of a second one that is not
    /// there, on a grid of their phases.
    ///
    /// # Errors
    /// Those of [`WaveBody::new`].
    pub fn new(
        model: &DiscModel,
        harmonics: [isize; 2],
        frequencies: [f64; 2],
        sides: [usize; 2],
    ) -> Result<Self, CycleError> {
        let orders = orders(sides);
        let around = orders.iter().map(|[k_1, k_2]| k_1 * harmonics[0] + k_2 * harmonics[1]);
        let body = WaveBody::new(&model.specification, &model.material, around, harmonics[0])?;
        Ok(Self {
            landing_share: landing_share(frequencies[0], body.node_frequency, sides[0]),
            ratio: frequencies[1] / frequencies[0],
            body,
            sides,
            orders,
            forward: sides.map(forward_transform),
            inverse: sides.map(inverse_transform),
        })
    }

    /// Number of points of the grid.
    pub fn points(&self) -> usize {
        self.sides[0] * self.sides[1]
    }

    /// `s / omega` along both phases of harmonic `k`: `k_1, k_2` in the limit of many points.
    pub fn orders(&self, k: usize) -> [f64; 2] {
        [0, 1].map(|phase| {
            let step = TAU / self.sides[phase] as f64;
            let angle = self.orders[k][phase] as f64 * step;
            // Central differences over four neighbours in place of i k.
            (8.0 * angle.sin() - (2.0 * angle).sin()) / (6.0 * step)
        })
    }

    /// `b / omega` along both phases of harmonic `k`: `i k_1, i k_2` in the limit of many points.
    pub fn contact_orders(&self, k: usize) -> [c64; 2] {
        [0, 1].map(|phase| {
            let step = TAU / self.sides[phase] as f64;
            let back = c64::from_polar(1.0, -(self.orders[k][phase] as f64) * step);
            (1.0 - back) / step // The difference to the point before, as in the laws of contact.
        })
    }

    /// `i s` of harmonic `k`, 1/s.
    pub fn rate(&self, k: usize, frequencies: [f64; 2]) -> c64 {
        let orders = self.orders(k);
        c64::new(0.0, orders[0] * frequencies[0] + orders[1] * frequencies[1])
    }

    /// `b` of harmonic `k`, 1/s.
    pub fn contact_rate(&self, k: usize, frequencies: [f64; 2]) -> c64 {
        let orders = self.contact_orders(k);
        frequencies[0] * orders[0] + frequencies[1] * orders[1]
    }

    /// Factor that turns a displacement into `u + tau v`.
    pub fn look_ahead(&self, k: usize) -> c64 {
        1.0 + TAU * self.landing_share * self.contact_rate(k, [1.0, self.ratio]) // 1 + tau b, tau = landing_share 2 pi / omega_1.
    }

    /// `k_1 omega_1 + k_2 omega_2` of harmonic `k`, rad/s.
    pub fn phase(&self, k: usize, frequencies: [f64; 2]) -> f64 {
        let [k_1, k_2] = self.orders[k].map(|order| order as f64);
        k_1 * frequencies[0] + k_2 * frequencies[1]
    }

    /// Circumferential harmonic `k_1 n_1 + k_2 n_2` of harmonic `k`.
    pub fn circumferential(&self, k: usize, [first, second]: [isize; 2]) -> isize {
        let [k_1, k_2] = self.orders[k];
        k_1 * first + k_2 * second
    }

    /// Which harmonic is the first along a phase, `(1, 0)` or `(0, 1)`.
    pub fn first(&self, phase: usize) -> usize {
        [1, self.sides[0]][phase]
    }

    /// Places along both phases of a point of the grid: the first runs first.
    pub fn places(&self, point: usize) -> [usize; 2] {
        [point % self.sides[0], point / self.sides[0]]
    }

    /// Which point of the grid lies from its first as `to` from `from`: all are alike, a response depends on how far apart they are.
    pub fn lag(&self, from: usize, to: usize) -> usize {
        let [from, to] = [from, to].map(|point| self.places(point));
        let way = |at: usize| (to[at] + self.sides[at] - from[at]) % self.sides[at];
        way(1) * self.sides[0] + way(0)
    }

    /// Place of a harmonic in a spectrum of all.
    fn place(&self, [k_1, k_2]: [isize; 2]) -> usize {
        let [first, second] = self.sides.map(|side| side as isize);
        (k_2.rem_euclid(second) * first + k_1.rem_euclid(first)) as usize
    }

    /// Fourier transform along both phases, the first one contiguous.
    fn transform(&self, values: &mut [c64], plans: &[Arc<dyn Fft<f64>>; 2]) {
        plans[0].process(values);
        let [first, second] = self.sides;
        if second > 1 {
            let at = |i: usize| (i % second) * first + i / second; // Places of the grid with the second phase contiguous.
            let mut across: Vec<c64> = (0..values.len()).map(|i| values[at(i)]).collect();
            plans[1].process(&mut across);
            (0..values.len()).for_each(|i| values[at(i)] = across[i]);
        }
    }

    /// Harmonics of values on the points, `sum_i f_i e^{-i k xi_i}`.
    pub fn harmonics(&self, values: &[f64]) -> Vec<c64> {
        let mut spectrum: Vec<c64> = values.iter().map(|&value| c64::new(value, 0.0)).collect();
        self.transform(&mut spectrum, &self.forward);
        self.orders.iter().map(|&order| spectrum[self.place(order)]).collect()
    }

    /// Values on the points of harmonics, the inverse of [`Self::harmonics`].
    pub fn values(&self, harmonics: impl IntoIterator<Item = c64>) -> Vec<f64> {
        let scale = 1.0 / self.points() as f64;
        let mut spectrum = vec![c64::ZERO; self.points()];
        for (&[k_1, k_2], value) in self.orders.iter().zip(harmonics) {
            let (own, conjugate) = (self.place([k_1, k_2]), self.place([-k_1, -k_2]));
            spectrum[own] = value * scale;
            if conjugate == own {
                spectrum[own].im = 0.0; // The mean, and what is its own conjugate, is real.
            } else {
                spectrum[conjugate] = spectrum[own].conj();
            }
        }
        self.transform(&mut spectrum, &self.inverse);
        spectrum.into_iter().map(|value| value.re).collect()
    }

    /// Coefficients of the body at harmonic `k` of a state.
    pub fn coefficients(&self, k: usize, state: &WaveState) -> DynamicCoefficients {
        DynamicCoefficients::new(self.rate(k, state.frequencies()), &state.point.damping)
    }

    /// Displacement of the edge at each harmonic (unscaled sums) under the forces of a state.
    pub fn displacements(&self, state: &WaveState) -> Vec<[c64; 2]> {
        let forces = self.spectra([&state.normal, &state.tangential]).into_iter().enumerate();
        let displacement = forces.map(|(k, force)| {
            let (r, []) = self.body.receptance(k, self.coefficients(k, state), []);
            moved(&r, force)
        });
        displacement.collect()
    }

    /// Harmonics of normal and tangential forces.
    fn spectra(&self, forces: [&[f64]; 2]) -> Vec<[c64; 2]> {
        let [normal, tangential] = forces.map(|own| self.harmonics(own));
        normal.into_iter().zip(tangential).map(<[c64; 2]>::from).collect()
    }

    /// Motion of the edge on the points from its displacement at each harmonic, times a symbol of the harmonic.
    pub fn motion(&self, edge: &[[c64; 2]], symbol: impl Fn(usize) -> c64) -> [Vec<f64>; 2] {
        let own = |c: usize| edge.iter().enumerate().map(move |(k, u)| (k, u[c]));
        [0, 1].map(|c| self.values(own(c).map(|(k, u)| u * symbol(k))))
    }
}

/// `(u_r, u_theta)_k = R(lambda_k) (N, T)_k`.
fn moved(r: &Receptance, force: [c64; 2]) -> [c64; 2] {
    [0, 1].map(|row| r[(row, 0)] * force[0] + r[(row, 1)] * force[1])
}

/// What ties one phase down: the first harmonic along it of the tangential displacement of the edge, turned back by the state's
/// origin, and what it changes by.
pub struct FirstHarmonic {
    /// Itself, m.
    pub value: c64,
    /// For unit first harmonics of the normal and of the tangential force.
    pub row: [c64; 2],
    /// Derivatives with the frequencies and the parameter.
    pub by: Vec<c64>,
}

/// The contact edge around one state: residuals, their derivatives, and the columns of its circulant responses.
pub struct Linearization<'a> {
    pub wave: &'a Wave,
    /// `u_r + tau v_r - delta` at each point, m.
    pub gap: Vec<f64>,
    /// `v_theta - Omega a` at each point, m/s.
    pub slip: Vec<f64>,
    /// Derivatives of gap and slip with each frequency, forces fixed, and with the parameter, free forces fixed.
    pub by: Vec<[Vec<f64>; 2]>,
    /// Responses to a unit normal and tangential force at phase zero, of gap and tangential velocity, at rising phase.
    pub columns: [[Vec<f64>; 2]; 2],
    /// Normal force for a unit of gap and tangential force for one of velocity, N/m for each m or m/s: what closes them where the
    /// response is largest. A point's own response will not do: with little damping a resonance can take it through zero.
    pub scales: [f64; 2],
    /// What ties each phase down.
    pub first: Vec<FirstHarmonic>,
}

/// What a unit of both forces does at one harmonic, and its derivatives with both frequencies and the parameter.
struct HarmonicResponse {
    receptances: [Receptance; 4],
    slip_rates: [c64; 4],
}

impl HarmonicResponse {
    fn new(wave: &Wave, k: usize, state: &WaveState, parameter: Parameter) -> Self {
        let still = RayleighDamping::default();
        let rate = wave.rate(k, state.frequencies());
        let [first, second] = wave.orders(k).map(|order| c64::new(0.0, order)); // d(i s) / dw_1 and d(i s) / dw_2.
        let damping = &state.point.damping;
        let mut by_damping = still;
        match parameter {
            Parameter::MassDamping => by_damping.mass_coefficient = 1.0,
            Parameter::StiffnessDamping => by_damping.stiffness_coefficient = 1.0,
            _ => {}
        }
        let changes = [(first, &still), (second, &still), (c64::ZERO, &by_damping)];
        let (receptance, [by_first, by_second, by_parameter]) = wave.body.receptance(
            k,
            wave.coefficients(k, state),
            changes.map(|(rate_change, damping_change)| {
                DynamicCoefficients::derivative(rate, damping, rate_change, damping_change)
            }),
        );
        let [first, second] = wave.contact_orders(k);
        Self {
            receptances: [receptance, by_first, by_second, by_parameter],
            slip_rates: [wave.contact_rate(k, state.frequencies()), first, second, c64::ZERO],
        }
    }
}

impl<'a> Linearization<'a> {
    /// Linearizes the edge around `state` with respect to forces, frequencies and `parameter`.
    pub fn at(wave: &'a Wave, state: &WaveState, parameter: Parameter) -> Self {
        let harmonics = 0..wave.orders.len();
        let responses = harmonics.map(|k| HarmonicResponse::new(wave, k, state, parameter));
        let responses: Vec<HarmonicResponse> = responses.collect();
        let contact = &state.point.contact;
        // Displacement of the edge, and its derivatives with both frequencies and the parameter.
        let forces = responses.iter().zip(wave.spectra([&state.normal, &state.tangential]));
        let edge = forces.map(|(own, force)| own.receptances.map(|r| moved(&r, force)));
        let mut edge: Vec<[[c64; 2]; 4]> = edge.collect();
        if parameter == Parameter::FrictionCoefficient {
            let points = state.contact.iter().zip(&state.normal);
            let change: Vec<f64> = points.map(|(own, normal)| own.drag() * normal).collect(); // dT / dmu where points slip.
            let change = wave.harmonics(&change);
            for ((edge, own), change) in edge.iter_mut().zip(&responses).zip(change) {
                edge[3] = moved(&own.receptances[0], [c64::ZERO, change]);
            }
        }

        // Gap and slip: the displacements less the interference and the speed of the surface.
        let slip_rate = |k: usize, which: usize| responses[k].slip_rates[which];
        let [mut gap, mut slip] = laws(wave, |k| [edge[k][0][0], slip_rate(k, 0) * edge[k][0][1]]);
        gap.iter_mut().for_each(|gap| *gap -= contact.interference);
        let surface_speed = contact.rotation_speed * wave.body.radius;
        slip.iter_mut().for_each(|slip| *slip -= surface_speed);

        let phases = &state.phases; // How they change with each frequency and the parameter.
        let scalars = || (1..=phases.len()).chain([3]);
        let slip_change = |k: usize, which: usize| {
            slip_rate(k, 0) * edge[k][which][1] + slip_rate(k, which) * edge[k][0][1] // d(b u) = b du + u db.
        };
        let by = scalars().map(|which| laws(wave, |k| [edge[k][which][0], slip_change(k, which)]));
        let mut by: Vec<[Vec<f64>; 2]> = by.collect();
        // The first harmonic of the tangential displacement along each phase, which the choice of its origin fixes.
        let first = phases.iter().enumerate().map(|(number, phase)| {
            let k = wave.first(number);
            let share = c64::from_polar(2.0 / wave.points() as f64, -phase.origin);
            FirstHarmonic {
                value: share * edge[k][0][1],
                row: [0, 1].map(|j| share * responses[k].receptances[0][(1, j)]),
                by: scalars().map(|which| share * edge[k][which][1]).collect(),
            }
        });
        let [by_gap, by_slip] = &mut by[phases.len()]; // The interference and the speed of the surface move them directly.
        match parameter {
            Parameter::RotationSpeed | Parameter::Speed => by_slip.fill(-wave.body.radius),
            Parameter::Interference => by_gap.fill(-1.0),
            _ => {}
        }
        // And with a normal (j = 0) and a tangential force (j = 1) at one point.
        let response = |k: usize, row: usize, j: usize| responses[k].receptances[0][(row, j)];
        let columns = [0, 1]
            .map(|j| laws(wave, |k| [response(k, 0, j), slip_rate(k, 0) * response(k, 1, j)]));
        let largest = |own: &Vec<f64>| own.iter().fold(0.0_f64, |m, value| m.max(value.abs()));
        Self {
            gap,
            slip,
            by,
            scales: [0, 1].map(|law| 1.0 / largest(&columns[law][law])),
            first: first.collect(),
            columns,
            wave,
        }
    }

    /// Rates of gap and slip along changes of the normal and the tangential forces, of each frequency and of the parameter.
    pub fn rates(&self, forces: [&[f64]; 2], scalars: &[f64]) -> [Vec<f64>; 2] {
        let forces = self.wave.spectra(forces);
        [0, 1].map(|law| {
            // A convolution over the phase: products of harmonics.
            let columns = self.columns.each_ref().map(|own| &own[law][..]);
            let pairs = self.wave.spectra(columns).into_iter().zip(&forces);
            let mut rates = self.wave.values(pairs.map(|(a, b)| a[0] * b[0] + a[1] * b[1]));
            for (i, rate) in rates.iter_mut().enumerate() {
                let changes = self.by.iter().zip(scalars).map(|(by, change)| by[law][i] * change);
                *rate += changes.sum::<f64>(); // At fixed forces: by each frequency and by the parameter.
            }
            rates
        })
    }
}

/// What the laws of contact see on the points, `u_r + tau v_r` and `v_theta`, from `u_r` and `v_theta` at each harmonic.
fn laws(wave: &Wave, edge: impl Fn(usize) -> [c64; 2]) -> [Vec<f64>; 2] {
    let harmonics = || 0..wave.orders.len();
    let gap = harmonics().map(|k| wave.look_ahead(k) * edge(k)[0]);
    [wave.values(gap), wave.values(harmonics().map(|k| edge(k)[1]))]
}
