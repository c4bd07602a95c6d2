//! Harmonics of a body of equal sectors in the state that is excited, each solved directly at each frequency.

use super::system::{BACKWARD_ERROR_BOUND, GROWTH_BOUND, check_frequencies};
use super::{Direction, FrfError, Terminal};
use crate::fem::RayleighDamping;
use crate::fem::fold::WaveDofs;
use crate::linalg::LinalgError;
use crate::linalg::banded::{BandedBatch, BandedLu, LANES, Lanes, multiply_band};
use crate::linalg::c64;
use crate::linalg::vectors::largest;
use crate::prestress::{MovingHarmonic, WaveTangent};
use std::f64::consts::{PI, TAU};

/// Harmonics held in memory at a time, and the entries of their bands where those are wide.
const HARMONICS_AT_ONCE: usize = 16;
const ENTRIES_AT_ONCE: usize = 1 << 21;

/// [`super::FrfSystem`] of an annulus or of a body of revolution, as the matrices of its circumferential harmonics.
#[derive(Clone, Debug)]
pub struct CyclicSystem {
    tangent: WaveTangent,
    friction_coefficient: f64,
    /// Dofs of the sector that can be excited and observed.
    dofs: WaveDofs,
}

/// Where a terminal lies.
#[derive(Clone, Copy)]
struct Place {
    unknown: usize,
    /// Angle in halves of a sector.
    half_steps: usize,
    is_tangential: bool,
}

impl CyclicSystem {
    /// Small motions around steady sliding at a friction coefficient, in space the dashpot `mu p_0 / V` across the sliding included.
    ///
    /// In rigid contact the motion along the normal of pressed nodes is no unknown; the force of excitation acts on the
    /// body, not through the contact. A distance between two bodies is no place to strike or to observe.
    pub fn sliding(tangent: &WaveTangent, friction_coefficient: f64) -> Self {
        Self { tangent: tangent.clone(), friction_coefficient, dofs: tangent.places() }
    }

    /// Number of unknowns of the annulus.
    pub fn dimension(&self) -> usize {
        self.dofs.count * self.dofs.sectors
    }

    /// Checks that a terminal can move; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::Node`].
    pub fn check(&self, terminal: Terminal, key: &'static str) -> Result<(), FrfError> {
        self.place(terminal, key).map(|_| ())
    }

    /// Place of a terminal; `key` is the case key of its node.
    ///
    /// # Errors
    /// [`FrfError::Node`].
    fn place(&self, terminal: Terminal, key: &'static str) -> Result<Place, FrfError> {
        let per_sector = self.tangent.halves.len();
        let count = per_sector * self.dofs.sectors;
        if terminal.node >= count {
            return Err(terminal.missing(key, count));
        }
        let component = terminal.direction.component().ok_or_else(|| {
            let own = terminal.direction.name();
            let fault = format!(
                ": direction \"{own}\" is for bodies from a mesh file; use \"radial\", \"tangential\" or \"axial\""
            );
            FrfError::Node { key, fault }
        })?;
        if component >= self.tangent.components {
            return Err(terminal.in_plane(key));
        }
        let (sector, node) = (terminal.node / per_sector, terminal.node % per_sector);
        let unknown = self.dofs.unknown_of[self.tangent.components * node + component];
        Ok(Place {
            unknown: unknown.ok_or_else(|| terminal.constrained(key))?,
            half_steps: 2 * sector + self.tangent.halves[node],
            is_tangential: terminal.direction == Direction::Tangential,
        })
    }
}

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
/// [`FrfError::Node`]; [`FrfError::Frequency`]; [`FrfError::Factorization`] where an undamped system is at resonance.
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
    let entries = system.dofs.count * (2 * system.dofs.half_bandwidth + 1);
    for numbers in all.chunks((ENTRIES_AT_ONCE / entries.max(1)).clamp(1, HARMONICS_AT_ONCE)) {
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
        let harmonic = system.tangent.harmonic(n);
        let bands = harmonic.at(system.friction_coefficient);
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
        let is_real = bands.matrices.each().flatten().all(|value| value.im == 0.0);
        Self {
            is_standing: harmonic.is_standing,
            proportional: harmonic.damping.is_none().then_some(harmonic.rayleigh),
            is_real,
            force: force.unknown,
            response: response.unknown,
            bands,
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
        let MovingHarmonic { half_bandwidth, matrices } = &wave.bands;
        // Factors of K, M and C in K + i omega C - omega^2 M, lane by lane.
        let of_lanes: [_; LANES] = std::array::from_fn(|lane| {
            let root = c64::new(0.0, omega(lane));
            let mut terms = matrices.terms(root);
            terms.swap(1, 2);
            if let Some(own) = &wave.proportional {
                terms[0].0 += root * own.stiffness_coefficient; // C = alpha M + beta K.
                terms[1].0 += root * own.mass_coefficient;
                terms.remove(2);
            }
            terms
        });
        let terms = of_lanes[0]
            .iter()
            .enumerate()
            .map(|(k, (_, values))| (Lanes::from_fn(|lane| of_lanes[lane][k].0), &values[..]));
        let terms: Vec<(Lanes, &[c64])> = terms.collect();
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
        let reason = format!(
            "singular to working precision (condition at least {growth:.1e}, the bound is {GROWTH_BOUND:.0e})"
        );
        FrfError::Factorization {
            frequency_hz,
            source: LinalgError::factorization(self.dimension, reason),
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
    let [residual, largest] = [&residual, &solution].map(|own| largest(own));
    let growth = norm * largest;
    (solution, residual / growth, growth)
}
