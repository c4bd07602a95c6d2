//! Stability of limit cycles: growth of small perturbations that ride on the wave.

use super::CycleError;
use super::perturbed::Perturbed;
use crate::linalg::RationalFit;
use faer::c64;
use std::f64::consts::TAU;

/// Samples of the response along the window of frequencies.
const SAMPLES: usize = 72;
/// Growth rate along which it is sampled, as a share of `omega`: off the neutral shift in phase.
const OFFSET: f64 = 2e-3;
/// Relative accuracy asked of the rational fit.
const FIT_TOLERANCE: f64 = 1e-10;
/// Most support points of the fit.
const MOST_SUPPORTS: usize = 36;
/// Exponents decaying faster than this share of `omega` are not looked at.
const DEEPEST: f64 = 0.05;
/// Quarters of `omega` up to which exponents are looked for.
const REACH: i32 = 8;
/// Exponents kept for each class.
const KEPT: usize = 4;
/// An exponent of class zero within this share of `omega` is the wave's own shift in phase.
const NEUTRAL: f64 = 1e-4;

/// One exponent of a small perturbation of a limit cycle, and the mode that has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloquetExponent {
    /// `lambda` in the frame of the wave: growth rate in 1/s and frequency in rad/s.
    pub exponent: c64,
    /// Circumferential harmonic at which the mode moves the edge most.
    pub harmonic: usize,
    /// Frequency of that harmonic in the fixed frame, Hz.
    pub frequency_hz: f64,
}

/// How one class of small perturbations of a limit cycle grows.
///
/// A perturbation `e^{lambda t} e^{i p theta} W(r, n theta + omega t)` holds the circumferential harmonics `p + k n`; its
/// exponents `lambda` are those with a nontrivial `W` under the contact laws linearized at fixed contact states,
/// landing boundaries moving along. Harmonic `p + k n` then has the frequency `Im lambda + k omega`, so that `lambda` and
/// `lambda + i omega` are different motions of one class (the same ones of classes `p` and `p + n`). Of each pair of
/// `lambda` in class `p` and `conj(lambda)` in class `-p` one is kept; exponents are looked for up to `|Im lambda| = 2 omega`.
#[derive(Clone, Debug, PartialEq)]
pub struct PerturbationGrowth {
    /// Class `p`, `0 <= p <= n / 2`: harmonics that differ from `+-p` by a multiple of `n`.
    pub class: usize,
    /// Leading exponents, by falling growth rate. The wave's own shift in phase, which neither grows nor
    /// decays, is left out, and so are those that decay faster than a twentieth of `omega`.
    pub exponents: Vec<FloquetExponent>,
}

/// Stability of a limit cycle to every perturbation that its mesh can carry.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleStability {
    /// One entry for each class `p = 0..=n / 2`.
    pub classes: Vec<PerturbationGrowth>,
}

/// Where a branch of limit cycles changes its stability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityChange {
    /// The parameter, SI.
    pub value: f64,
    /// Circumferential harmonic of the mode that starts or ceases to grow.
    pub harmonic: usize,
    /// Its frequency in the fixed frame, Hz.
    pub frequency_hz: f64,
}

impl CycleStability {
    /// The exponent that grows fastest or decays slowest; `None` if all decay faster than a twentieth of `omega`.
    pub fn leading(&self) -> Option<&FloquetExponent> {
        let leading = self
            .classes
            .iter()
            .filter_map(|class| class.exponents.first());
        leading.max_by(|a, b| a.exponent.re.total_cmp(&b.exponent.re))
    }

    /// Whether every perturbation decays.
    pub fn is_stable(&self) -> bool {
        self.leading()
            .is_none_or(|leading| leading.exponent.re < 0.0)
    }

    /// Circumferential harmonics of the modes that grow, rising.
    pub fn growing_harmonics(&self) -> Vec<usize> {
        let exponents = self.classes.iter().flat_map(|class| &class.exponents);
        let growing = exponents.filter(|found| found.exponent.re >= 0.0);
        let mut harmonics: Vec<usize> = growing.map(|found| found.harmonic).collect();
        harmonics.sort_unstable();
        harmonics.dedup();
        harmonics
    }
}

impl PerturbationGrowth {
    /// The leading exponents of one class, from the poles of the response of the contact conditions: sampled beside the
    /// imaginary axis, read off a rational fit, refined on the conditions themselves.
    pub(super) fn of(
        perturbed: &Perturbed<'_>,
        class: usize,
        harmonic: usize,
    ) -> Result<Self, CycleError> {
        let omega = perturbed.frequency();
        let mut found: Vec<c64> = Vec::new();
        for window in windows(class, harmonic) {
            for exponent in exponents_in(perturbed, window, class)? {
                let is_known = found
                    .iter()
                    .any(|known| (known - exponent).norm() < 1e-6 * omega);
                if !is_known {
                    found.push(exponent);
                }
            }
        }
        found.sort_by(|a, b| b.re.total_cmp(&a.re));
        let exponents = found.into_iter().filter_map(|exponent| {
            let k = perturbed.dominant_harmonic(exponent);
            // What moves from phase to phase is the grid's own.
            perturbed.resolves(k).then(|| FloquetExponent {
                exponent,
                harmonic: (class as isize + k * harmonic as isize).unsigned_abs(),
                frequency_hz: (exponent.im + k as f64 * omega).abs() / TAU,
            })
        });
        let exponents = exponents.take(KEPT);
        Ok(Self {
            class,
            exponents: exponents.collect(),
        })
    }
}

/// Windows of `Im lambda`, in quarters of `omega`, that hold each pair of exponents once.
///
/// Class `p` and `-p` are conjugate, and class `p + n` with `lambda + i omega` is class `p` again. So class 0 is
/// symmetric about zero, class `n / 2` about `omega / 2`, and no other is symmetric.
fn windows(class: usize, harmonic: usize) -> std::ops::Range<i32> {
    match class {
        0 => 0..REACH,
        _ if 2 * class == harmonic => 2 - REACH..2,
        _ => 2 - REACH..REACH,
    }
}

/// The leading exponents of one window.
fn exponents_in(
    perturbed: &Perturbed<'_>,
    window: i32,
    class: usize,
) -> Result<Vec<c64>, CycleError> {
    let omega = perturbed.frequency();
    let start = 0.25 * f64::from(window);
    // A little beyond both ends, so that exponents at the ends lie within.
    let points: Vec<c64> = (0..SAMPLES)
        .map(|i| {
            let share = i as f64 / (SAMPLES - 1) as f64;
            c64::new(OFFSET * omega, omega * (start - 0.03 + 0.31 * share))
        })
        .collect();
    let values: Vec<c64> = points
        .iter()
        .map(|&point| perturbed.response(point))
        .collect();
    let fit = RationalFit::new(&points, &values, FIT_TOLERANCE, MOST_SUPPORTS);
    let fit = fit.ok_or(CycleError::Stability { class })?;
    let mut poles = fit.poles();
    poles.retain(|pole| {
        let place = pole.im / omega - start;
        pole.re > -DEEPEST * omega && (-0.01..0.26).contains(&place)
    });
    poles.sort_by(|a, b| b.re.total_cmp(&a.re));
    let mut found: Vec<c64> = Vec::new();
    for pole in poles {
        let Some(exponent) = refined(perturbed, pole) else {
            continue;
        };
        let is_known = found
            .iter()
            .any(|known| (known - exponent).norm() < 1e-6 * omega);
        let is_neutral = class == 0 && exponent.norm() < NEUTRAL * omega;
        if !is_known && !is_neutral {
            found.push(exponent);
        }
        if found.len() == KEPT {
            break;
        }
    }
    Ok(found)
}

/// The zero of `1 / (b^T A^-1 c)` near a start, by the secant method; `None` where it leads away, as from a pole that
/// the fit has and the response has not.
fn refined(perturbed: &Perturbed<'_>, start: c64) -> Option<c64> {
    let omega = perturbed.frequency();
    let function = |z: c64| 1.0 / perturbed.response(z);
    let (mut before, mut now) = (start, start + c64::new(1e-5 * omega, 0.0));
    let mut value_before = function(before);
    for _ in 0..12 {
        let value = function(now);
        let step = value * (now - before) / (value - value_before);
        if !step.norm().is_finite() || (now - step - start).norm() > 0.02 * omega {
            return None;
        }
        (before, value_before) = (now, value);
        now -= step;
        if step.norm() < 1e-9 * omega {
            return Some(now);
        }
    }
    None
}
