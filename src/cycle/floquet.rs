//! Leading Floquet exponents of a limit cycle, from the map of perturbations over one period.

use super::CycleError;
use super::stability::{CycleStability, FloquetExponent};
use super::stepping::Period;
use crate::linalg::dense_eigen::{RealEigen, real_eigen};
use crate::linalg::{Mat, c64};
use std::f64::consts::TAU;

/// Exponents kept.
const KEPT: usize = 4;
/// Of those, the leading ones that must have converged.
const CONVERGED: usize = 2;
/// Residual of a converged multiplier, relative to it.
const TOLERANCE: f64 = 4e-3;
/// Smallest and largest dimension of the Krylov space, and steps between two looks at it.
const DIMENSIONS: [usize; 3] = [12, 90, 4];
/// An exponent within this share of `omega`, with this overlap with the shift of the wave, is the shift itself.
const NEUTRAL: [f64; 2] = [0.05, 0.8];
/// Share of `omega` that every rate may be wrong by: what steps and nodes leave open of where a wave lands.
const FLOOR: f64 = 2e-4;
/// Harmonics, from zero on, of a start that knows nothing.
const START_HARMONICS: usize = 13;
/// Share of a known start that such a one adds, lest a mode that comes up between two cycles is missed.
const UNKNOWN_SHARE: f64 = 0.1;

/// The leading exponents of a cycle, and a start for those of its neighbours.
pub(super) struct LeadingExponents {
    pub stability: CycleStability,
    /// Sum of the leading modes, of unit length.
    pub modes: Vec<f64>,
}

/// Krylov space of the period's map: `P V = V H + h v e^T`.
struct Krylov<'a> {
    period: &'a Period<'a>,
    basis: Vec<Vec<f64>>,
    /// Columns of `H`, each with its subdiagonal entry.
    columns: Vec<Vec<f64>>,
}

/// One multiplier `rho` and its Ritz vector's coefficients.
struct Multiplier {
    value: c64,
    residual: f64,
    coefficients: Vec<c64>,
}

impl LeadingExponents {
    /// Arnoldi's process on the map of one period, until the leading multipliers have converged.
    ///
    /// `known` are modes of a neighbouring cycle. The exponent of the wave's own shift in phase is zero; what the steps of
    /// time and mesh make of it instead is how far the others may be trusted, by experience twice over: half of it, a five
    /// thousandth of `omega`, the residual and a hundredth of the rate make the uncertainty of each.
    ///
    /// # Errors
    /// [`CycleError::Stability`] where the leading multipliers do not converge.
    pub fn of(period: &Period<'_>, known: Option<&[f64]>) -> Result<Self, CycleError> {
        let mut krylov = Krylov::from(period, known);
        let shift = unit(period.shift());
        let [least, most, stride] = DIMENSIONS;
        loop {
            krylov.expand();
            let dimension = krylov.columns.len();
            if dimension < least || !dimension.is_multiple_of(stride) {
                continue;
            }
            let multipliers = krylov.multipliers()?;
            let (neutral, others) = krylov.without_shift(multipliers, &shift);
            let is_converged = |m: &Multiplier| m.residual < TOLERANCE;
            let is_done = others.len() >= CONVERGED
                && others.iter().take(CONVERGED).all(is_converged)
                && neutral.is_some();
            if is_done || dimension >= most {
                let kept = others.into_iter().take(KEPT);
                let kept: Vec<Multiplier> = kept.take_while(|m| m.residual < 0.2).collect();
                if kept.is_empty() {
                    return Err(CycleError::Stability { dimension });
                }
                return Ok(krylov.finish(kept, neutral));
            }
        }
    }
}

impl<'a> Krylov<'a> {
    fn from(period: &'a Period<'a>, known: Option<&[f64]>) -> Self {
        let mut start = unit(unknown_start(period));
        if let Some(known) = known.filter(|known| known.len() == start.len()) {
            for (x, k) in start.iter_mut().zip(known) {
                *x = UNKNOWN_SHARE * *x + k;
            }
        }
        // What the mesh damps within a period is of no interest.
        let first = unit(period.map(&start));
        Self { period, basis: vec![first], columns: Vec::new() }
    }

    /// One more vector, orthogonalized twice.
    fn expand(&mut self) {
        let last = self.basis.len() - 1;
        let mut image = self.period.map(&self.basis[last]);
        let mut column = vec![0.0; last + 2];
        for _ in 0..2 {
            for (vector, entry) in self.basis.iter().zip(&mut column) {
                let share = dot(vector, &image);
                *entry += share;
                image.iter_mut().zip(vector).for_each(|(x, v)| *x -= share * v);
            }
        }
        let length = dot(&image, &image).sqrt();
        column[last + 1] = length;
        image.iter_mut().for_each(|x| *x /= length);
        self.columns.push(column);
        self.basis.push(image);
    }

    /// Multipliers by falling modulus, one of each conjugate pair.
    fn multipliers(&self) -> Result<Vec<Multiplier>, CycleError> {
        let size = self.columns.len();
        let matrix =
            Mat::from_fn(size, size, |i, j| self.columns[j].get(i).copied().unwrap_or(0.0));
        let eigen = real_eigen(matrix.as_ref(), false, 0)
            .map_err(|_| CycleError::Stability { dimension: size })?;
        let overflow = self.columns[size - 1][size];
        let mut found: Vec<Multiplier> = (0..size)
            .filter(|&i| eigen.values[i].im >= 0.0)
            .map(|i| {
                let coefficients = coefficients(&eigen, i);
                let length = coefficients.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
                let value = eigen.values[i];
                Multiplier {
                    residual: overflow * coefficients[size - 1].norm() / (length * value.norm()),
                    value,
                    coefficients,
                }
            })
            .collect();
        found.sort_by(|a, b| b.value.norm().total_cmp(&a.value.norm()));
        Ok(found)
    }

    /// The exponent of the wave's own shift, and the other multipliers.
    fn without_shift(
        &self,
        multipliers: Vec<Multiplier>,
        shift: &[f64],
    ) -> (Option<c64>, Vec<Multiplier>) {
        let overlaps: Vec<f64> = self.basis.iter().map(|vector| dot(vector, shift)).collect();
        let [reach, least] = NEUTRAL;
        let mut neutral: Option<(usize, f64)> = None;
        for (i, multiplier) in multipliers.iter().enumerate().take(2 * KEPT) {
            let exponent = multiplier.value.ln() / TAU;
            let pairs = multiplier.coefficients.iter().zip(&overlaps);
            let overlap = pairs.map(|(y, o)| y * o).sum::<c64>().norm();
            let lengths = multiplier.coefficients.iter().map(|y| y.norm_sqr());
            let overlap = overlap / lengths.sum::<f64>().sqrt();
            if exponent.norm() < reach
                && overlap > least
                && neutral.is_none_or(|(_, best)| overlap > best)
            {
                neutral = Some((i, overlap));
            }
        }
        let mut others = multipliers;
        let neutral = neutral.map(|(i, _)| others.remove(i).value.ln() / self.period.duration);
        (neutral, others)
    }

    fn finish(&self, kept: Vec<Multiplier>, neutral: Option<c64>) -> LeadingExponents {
        let mut modes = vec![0.0; self.period.dimension()];
        let mut exponents = Vec::new();
        for multiplier in kept {
            let vector = self.vector(&multiplier);
            modes.iter_mut().zip(&vector).for_each(|(x, v)| *x += v.re + v.im);
            exponents.push(self.exponent(&multiplier, &vector, neutral));
        }
        LeadingExponents { stability: CycleStability { exponents }, modes: unit(modes) }
    }

    fn vector(&self, multiplier: &Multiplier) -> Vec<c64> {
        let mut vector = vec![c64::new(0.0, 0.0); self.period.dimension()];
        for (basis, &y) in self.basis.iter().zip(&multiplier.coefficients) {
            vector.iter_mut().zip(basis).for_each(|(x, b)| *x += y * b);
        }
        vector
    }

    /// A multiplier as an exponent, with the circumferential harmonic that moves the edge most and its frequency.
    fn exponent(
        &self,
        multiplier: &Multiplier,
        vector: &[c64],
        neutral: Option<c64>,
    ) -> FloquetExponent {
        let (period, omega) = (self.period, self.period.frequency());
        let exponent = multiplier.value.ln() / period.duration;
        let (sectors, per) = (period.sectors() as isize, period.sector_dofs());
        let half = vector.len() / 2;
        // Amplitude of e^{i m theta} in one dof of the edge, of displacement or velocity.
        let amplitude = |m: isize, part: usize, dof: usize| -> c64 {
            let terms = (0..sectors).map(|sector| {
                let angle = -TAU * ((m * sector).rem_euclid(sectors)) as f64 / sectors as f64;
                vector[part + sector as usize * per + dof] * c64::from_polar(1.0, angle)
            });
            terms.sum()
        };
        // Resolved motion of the edge lives in low harmonics.
        let highest = (sectors / 2).min(40);
        let energy = |m: isize| amplitude(m, 0, 0).norm_sqr() + amplitude(m, 0, 1).norm_sqr();
        let harmonic = (-highest..=highest)
            .map(|m| (m, energy(m)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map_or(0, |largest| largest.0);
        let dof = usize::from(amplitude(harmonic, 0, 1).norm() > amplitude(harmonic, 0, 0).norm());
        // v / (omega u) of that harmonic tells its frequency, which the multiplier knows up to multiples of omega.
        let ratio = amplitude(harmonic, half, dof) / amplitude(harmonic, 0, dof);
        let whole = (ratio.im - exponent.im / omega).round();
        let fixed = exponent.im + whole * omega;
        // In the frame of the wave, harmonic p + k n has the frequency Im lambda + k omega.
        let (n, count) = (period.harmonic, period.harmonic.abs());
        let rest = harmonic.rem_euclid(count);
        let signed = if 2 * rest > count { rest - count } else { rest };
        let turns = (harmonic - signed) / n;
        let residual = multiplier.residual / period.duration;
        let shift = neutral.map_or(NEUTRAL[0] * omega, |neutral| 0.5 * neutral.norm());
        FloquetExponent {
            exponent: c64::new(exponent.re, fixed - turns as f64 * omega),
            uncertainty: FLOOR * omega + shift + residual + 0.01 * exponent.re.abs(),
            class: signed.unsigned_abs(),
            harmonic: harmonic.unsigned_abs(),
            frequency_hz: fixed.abs() / TAU,
        }
    }
}

/// Eigenvector `i`, of unit length or nearly so.
fn coefficients(eigen: &RealEigen, i: usize) -> Vec<c64> {
    let rows = 0..eigen.right.nrows();
    match eigen.values[i].im {
        im if im > 0.0 => {
            rows.map(|row| c64::new(eigen.right[(row, i)], eigen.right[(row, i + 1)])).collect()
        }
        _ => rows.map(|row| c64::new(eigen.right[(row, i)], 0.0)).collect(),
    }
}

/// Smooth velocities of the low harmonics in both components, largest at the edge: the same on every machine.
fn unknown_start(period: &Period<'_>) -> Vec<f64> {
    let (sectors, per) = (period.sectors(), period.sector_dofs());
    let half = period.dimension() / 2;
    let mut start = vec![0.0; 2 * half];
    for sector in 0..sectors {
        let angle = TAU * sector as f64 / sectors as f64;
        for dof in 0..per {
            let depth = (dof / 2) as f64 / (per / 2) as f64;
            let component = dof % 2;
            start[half + sector * per + dof] = (0..START_HARMONICS)
                .map(|m| {
                    // Phases and shares without structure: multiples of irrational numbers.
                    let phase =
                        TAU * ((2 * m + component + 1) as f64 * 0.618_033_988_749_894_9).fract();
                    let bend =
                        1.0 + ((m + 3 * component + 1) as f64 * 0.754_877_666_246_692_7).fract();
                    (m as f64 * angle + phase).cos()
                        * (0.5 * std::f64::consts::PI * bend * depth).cos()
                })
                .sum::<f64>();
        }
    }
    start
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(mut vector: Vec<f64>) -> Vec<f64> {
    let length = dot(&vector, &vector).sqrt();
    vector.iter_mut().for_each(|x| *x /= length);
    vector
}
