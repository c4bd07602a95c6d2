//! Steady vibrations beside each other, whose beat looks like growth.

use super::{ExponentialStage, demodulation::Demodulated};
use faer::c64;

/// Rate of either vibration, over that of the stage, up to which both are steady beside it.
const STEADY: f64 = 0.2;
/// What they may leave of the signal, relative to it.
const LEFT: f64 = 0.05;

/// How far apart the two steady vibrations are, Hz, whose beat a stage is a part of; `None` where it is none.
///
/// Over the stage and as much before and after it `z(t) = a e^{p t} + b e^{q t}` is sought, whose values satisfy
/// `z(t + 2 h) = c z(t + h) + d z(t)` with `e^{p h}` and `e^{q h}` the roots of `r^2 = c r + d` (Prony): `c` and `d`,
/// then `a` and `b` by least squares. Growth out of silence, or beside a steady line, has another rate than zero.
pub(super) fn beat(signal: &Demodulated, stage: &ExponentialStage) -> Option<f64> {
    // The values, h apart.
    let length = stage.end_s - stage.start_s;
    let [first, end] = [stage.start_s - length, stage.end_s + length]
        .map(|place| signal.times.partition_point(|time| *time < place));
    let value = |k: usize| c64::from_polar(signal.log_amplitude[k].exp(), signal.phase[k]);
    let z: Vec<c64> = (first..end).map(value).collect();
    let lag = z.len() / 4; // Of fewer than four the factors are no numbers.
    let step = signal.times[first + lag] - signal.times[first];

    // The two roots.
    let places = 0..z.len() - 2 * lag;
    let [c, d] = fitted(places.map(|k| ([z[k + lag], z[k]], z[k + 2 * lag])))?;
    let half = (0.25 * c * c + d).sqrt();
    let exponents = [0.5 * c + half, 0.5 * c - half].map(|root| root.ln() / step);
    let is_steady = |p: &c64| p.re.abs() < STEADY * stage.rate_per_s.value.abs();

    // What the two leave.
    let time = |k: usize| signal.times[first + k] - stage.start_s;
    let terms = |k: usize| exponents.map(|p| (p * time(k)).exp());
    let [a, b] = fitted(z.iter().enumerate().map(|(k, z)| (terms(k), *z)))?;
    let left = |(k, z): (usize, &c64)| z - a * terms(k)[0] - b * terms(k)[1];
    let left: f64 = z.iter().enumerate().map(|own| left(own).norm_sqr()).sum();
    let whole: f64 = z.iter().map(|z| z.norm_sqr()).sum();
    let is_beat = exponents.iter().all(is_steady) && left <= LEFT * LEFT * whole;
    is_beat.then(|| (exponents[0] - exponents[1]).im.abs() / std::f64::consts::TAU)
}

/// The factors of two terms whose sum is nearest to the values; `None` where the terms depend on each other.
fn fitted(rows: impl Iterator<Item = ([c64; 2], c64)>) -> Option<[c64; 2]> {
    let (mut squares, mut mixed, mut sides) = ([0.0; 2], c64::ZERO, [c64::ZERO; 2]);
    for (terms, value) in rows {
        mixed += terms[0].conj() * terms[1];
        for (k, term) in terms.iter().enumerate() {
            squares[k] += term.norm_sqr();
            sides[k] += term.conj() * value;
        }
    }
    let determinant = squares[0] * squares[1] - mixed.norm_sqr();
    let found = [
        (sides[0] * squares[1] - mixed * sides[1]) / determinant,
        (sides[1] * squares[0] - mixed.conj() * sides[0]) / determinant,
    ];
    found.iter().all(|own| own.is_finite()).then_some(found)
}
