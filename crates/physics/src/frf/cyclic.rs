//! Direct solution of each harmonic at each frequency.

use super::cyclic_system::Place;
use super::system::{BACKWARD_ERROR_BOUND, GROWTH_BOUND, check_frequencies};
use super::{CyclicSystem, FrfError, Terminal};
use crate::fem::RayleighDamping;
use crate::linalg::LinalgError;
use crate::linalg::banded::{BandedBatch, BandedLu, LANES, Lanes, multiply_band};
use crate::linalg::c64;
use crate::prestress::MovingHarmonic;
use std::f64::consts::{PI, TAU};

/// Harmonics held in memory at a time, and the entries of their bands where those are wide.
const HARMONICS_AT_ONCE: usize = 16;
const ENTRIES_AT_ONCE: usize = 1 << 21;

/// A response summed over all harmonics.
#[derive(Clone, Debug, PartialEq)]
pub struct CyclicResponse {
    /// Receptance `u / f` for each frequency, m/N; of a plane body for each metre of thickness.
    pub receptance: Vec<c64>,
    /// Largest backward error `|f - A x| / (|A| |x|)` of all harmonics and frequencies.
    pub backward_error: f64,
}

/// Receptance between two terminals, by direct solution of every circumferential harmonic.
///
/// A force at one node is a sum of waves over all `N` sectors, which a body of revolution answers one by one:
///
/// ```text
/// h = 1/N sum_n e^{i n (theta_response - theta_force)} [(K_n + i omega C_n - omega^2 M_n)^{-1}]_{response, force}
/// ```
///
/// No harmonic is left out: this is [`super::direct_response`] up to round-off, in sliding contact
/// too. Frequencies in parallel, the result independent of their number of threads. For a plane body of
/// thickness `b` divide by `b`; a body in three dimensions has its own thickness, and `h` is in m/N.
///
/// # Errors
/// [`FrfError::Node`], [`FrfError::NoAxes`]; [`FrfError::Frequency`]; [`FrfError::Factorization`] where an undamped system is at resonance.
pub fn cyclic_response(
    system: &CyclicSystem,
    force: Terminal,
    response: Terminal,
    frequencies_hz: &[f64],
) -> Result<CyclicResponse, FrfError> {
    check_frequencies(frequencies_hz)?;
    let force = system.place(force, "force_node")?;
    let response = system.place(response, "response_node")?;
    let mut receptance = vec![c64::ZERO; frequencies_hz.len()];
    let mut backward_error = 0.0_f64;
    let all: Vec<usize> = (0..=system.tangent.largest_harmonic()).collect();
    for numbers in all.chunks(system.harmonics_at_once(HARMONICS_AT_ONCE, ENTRIES_AT_ONCE)) {
        let waves: Vec<Wave> =
            crate::parallel::map(numbers, |&n| Wave::new(system, n, force, response));
        let lines = receptance.chunks_mut(LANES).zip(frequencies_hz.chunks(LANES));
        let errors: Result<Vec<f64>, _> = crate::parallel::map(lines, |(sums, frequencies)| {
            Lines::new(frequencies, &waves[0].bands).add(&waves, sums)
        });
        backward_error = errors?.into_iter().fold(backward_error, f64::max);
    }
    let share = 1.0 / system.dofs.sectors as f64;
    receptance.iter_mut().for_each(|h| *h *= share);
    Ok(CyclicResponse { receptance, backward_error })
}

/// One harmonic with what it has to do with force and response.
struct Wave {
    bands: MovingHarmonic,
    /// Where `C = alpha_R M + beta_R K`.
    proportional: Option<RayleighDamping>,
    /// No other harmonic is the mirror image of this one.
    is_standing: bool,
    force: usize,
    response: usize,
    /// From a solution for a unit force in the basis `(u_r, -i u_theta)` to the response.
    factor: c64,
    /// Harmonic `-n` has the same solution.
    is_real: bool,
}

impl Wave {
    fn new(system: &CyclicSystem, n: usize, force: Place, response: Place) -> Self {
        let (bands, proportional) = system.harmonic(n);
        let sectors = system.dofs.sectors;
        // Modulo a full turn, so that high harmonics lose no digits.
        let steps = response.half_steps + 2 * sectors - force.half_steps;
        let turns = (n * steps) % (2 * sectors);
        let angle = PI * turns as f64 / sectors as f64;
        let mut factor = c64::from_polar(1.0, angle);
        if response.is_tangential {
            factor *= c64::I;
        }
        if force.is_tangential {
            factor *= -c64::I;
        }
        let is_real = {
            // Proportional damping is as real as what it is proportional to.
            let mut all = bands.matrices.each().flatten();
            all.all(|value| value.im == 0.0)
        };
        Self {
            is_standing: system.tangent.is_standing(n),
            is_real,
            force: force.unknown,
            response: response.unknown,
            bands,
            proportional,
            factor,
        }
    }
}

/// A few frequencies solved together.
struct Lines<'a> {
    frequencies_hz: &'a [f64],
    dimension: usize,
    batch: BandedBatch,
}

impl<'a> Lines<'a> {
    /// Of harmonics whose bands have this shape.
    fn new(frequencies_hz: &'a [f64], bands: &MovingHarmonic) -> Self {
        let dimension = bands.dimension();
        let batch = BandedBatch::new(dimension, bands.half_bandwidth);
        Self { frequencies_hz, dimension, batch }
    }

    /// Adds the waves' shares of the response; returns the largest backward error.
    fn add(&mut self, waves: &[Wave], sums: &mut [c64]) -> Result<f64, FrfError> {
        let mut largest = 0.0_f64;
        for wave in waves {
            let (ahead, error) = self.solve(wave, 1.0)?;
            largest = largest.max(error);
            if wave.is_standing {
                // The wave and its mirror image are one.
                for (sum, x) in sums.iter_mut().zip(&ahead) {
                    *sum += wave.factor * x;
                }
            } else if wave.is_real {
                for (sum, x) in sums.iter_mut().zip(&ahead) {
                    *sum += *x * (2.0 * wave.factor.re);
                }
            } else {
                // Harmonic -n sees the conjugate matrices: the conjugate solution at -omega.
                let (back, error) = self.solve(wave, -1.0)?;
                largest = largest.max(error);
                for (sum, (x, y)) in sums.iter_mut().zip(ahead.iter().zip(&back)) {
                    *sum += wave.factor * x + (wave.factor * y).conj();
                }
            }
        }
        Ok(largest)
    }

    /// The response unknown of one harmonic at `sign` times the frequencies, and the backward error.
    fn solve(&mut self, wave: &Wave, sign: f64) -> Result<([c64; LANES], f64), FrfError> {
        let frequencies = self.frequencies_hz;
        // Lanes left over repeat the last frequency.
        let lane_frequency = |lane: usize| frequencies[lane.min(frequencies.len() - 1)];
        let omega = |lane: usize| sign * TAU * lane_frequency(lane);
        let lanes = |factor: &dyn Fn(f64) -> c64| Lanes::from_fn(|lane| factor(omega(lane)));
        let MovingHarmonic { half_bandwidth, matrices } = &wave.bands;
        let (alpha, beta) = match &wave.proportional {
            Some(own) => (own.mass_coefficient, own.stiffness_coefficient),
            None => (0.0, 0.0),
        };
        let mut terms: Vec<(Lanes, &[c64])> = vec![
            (lanes(&|w| c64::new(1.0, w * beta)), &matrices.stiffness),
            (lanes(&|w| c64::new(-w * w, w * alpha)), &matrices.mass),
        ];
        if wave.proportional.is_none() {
            terms.push((lanes(&|w| c64::new(0.0, w)), &matrices.damping));
        }
        for (gain, values) in &matrices.losses {
            terms.push((lanes(&|w| gain.at(c64::new(0.0, w))), values));
        }
        self.batch.assemble(&terms);
        let quality = self.batch.solve(wave.force);
        let mut result = [c64::ZERO; LANES];
        let mut largest = 0.0_f64;
        for lane in 0..frequencies.len() {
            let mut growth = quality[lane].growth;
            result[lane] = self.batch.solution()[wave.response].get(lane);
            if quality[lane].backward_error <= BACKWARD_ERROR_BOUND {
                largest = largest.max(quality[lane].backward_error);
            } else {
                let (solution, error, own) =
                    pivoted(&self.batch.system(lane), *half_bandwidth, wave.force);
                (result[lane], growth) = (solution[wave.response], own);
                largest = largest.max(error);
            }
            if growth.is_nan() || growth >= GROWTH_BOUND {
                return Err(self.singular(lane_frequency(lane), growth));
            }
        }
        Ok((result, largest))
    }

    fn singular(&self, frequency_hz: f64, growth: f64) -> FrfError {
        FrfError::Factorization {
            frequency_hz,
            source: LinalgError::Factorization {
                dimension: self.dimension,
                reason: format!(
                    "singular to working precision (condition at least {growth:.1e}, the bound is \
                     {GROWTH_BOUND:.0e})"
                ),
            },
        }
    }
}

/// A solution with pivoting, its backward error, and `|A| |x| / |b|`.
fn pivoted(band: &[c64], h: usize, force: usize) -> (Vec<c64>, f64, f64) {
    let dimension = band.len() / (2 * h + 1);
    let mut lu = BandedLu::new(dimension, h);
    lu.factorize(band);
    let mut solution = vec![c64::ZERO; dimension];
    solution[force] = c64::ONE;
    lu.solve(&mut solution);
    let mut residual = multiply_band(band, h, &solution, false);
    residual[force] -= 1.0;
    let sums = band.chunks_exact(2 * h + 1).map(|row| row.iter().map(|value| value.norm()).sum());
    let norm = sums.fold(0.0_f64, f64::max);
    let [residual, largest] =
        [&residual, &solution].map(|own| own.iter().fold(0.0_f64, |m, x| m.max(x.norm())));
    let growth = norm * largest;
    (solution, residual / growth, growth)
}
