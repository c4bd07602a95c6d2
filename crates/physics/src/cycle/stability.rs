//! Stability of limit cycles: growth of small perturbations that ride on the wave.

use crate::linalg::c64;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// A small perturbation of a limit cycle, by what it is a period later.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FloquetMultiplier {
    /// `rho = e^{lambda T}`: the perturbation is `rho` times as large after a period.
    #[serde(with = "Kept")]
    pub multiplier: c64,
    /// `Re lambda = ln |rho| / T`, 1/s.
    pub growth_rate: f64,
    /// What that may be wrong by, 1/s.
    pub uncertainty: f64,
    /// `|arg rho| / 2 pi T`: distance of its frequency from the nearest harmonic of the cycle, Hz.
    pub beat_hz: f64,
    /// What it is around a disc, where it rides on a rotating wave.
    pub mode: Option<RidingMode>,
}

/// A mode that rides on a rotating wave, `e^{lambda t} e^{i p theta} W(r, n theta + omega t)`.
///
/// It holds the circumferential harmonics `p + k n`, each with the frequency `Im lambda + k omega`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RidingMode {
    /// `Im lambda`, its frequency in the frame of the wave, rad/s.
    pub frequency: f64,
    /// Class `p`, `0 <= p <= n / 2`: the mode holds harmonics that differ from `+-p` by a multiple of `n`.
    pub class: usize,
    /// Circumferential harmonic at which the mode moves the edge most.
    pub harmonic: usize,
    /// Frequency of that harmonic in the fixed frame, Hz.
    pub frequency_hz: f64,
}

/// A complex number as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(remote = "c64")]
struct Kept {
    re: f64,
    im: f64,
}

/// Whether small perturbations of a limit cycle decay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All decay.
    Stable,
    /// One grows.
    Unstable,
    /// The leading one neither grows nor decays by more than its uncertainty.
    Undecided,
}

impl Verdict {
    /// Whether all decay, where that is known for sure.
    pub fn is_stable(self) -> Option<bool> {
        (self != Self::Undecided).then_some(self == Self::Stable)
    }

    /// In one word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }
}

/// The leading multipliers of a limit cycle: its stability to every perturbation that its mesh can carry.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FloquetMultipliers {
    /// By falling modulus, one of each conjugate pair, without the shift in phase, which neither grows nor decays.
    pub multipliers: Vec<FloquetMultiplier>,
    /// Modulus of that of the shift in phase, which is 1 but for the steps in which nodes change their status; none where no direction was
    /// told to be it.
    pub shift: Option<f64>,
    /// Periods spent.
    pub periods: usize,
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

/// Where a branch changes its stability: neighbours that differ in it, among those of which it is known.
pub fn differing<T: Copy>(branch: impl Iterator<Item = (Option<bool>, T)>) -> Vec<[T; 2]> {
    let known: Vec<(bool, T)> = branch.filter_map(|(known, own)| Some((known?, own))).collect();
    let pairs = known.windows(2).filter(|pair| pair[0].0 != pair[1].0);
    pairs.map(|pair| [pair[0].1, pair[1].1]).collect()
}

/// The value between two at which the growth rate passes zero in a straight line; half way where one has no rate, which says nothing
/// about how far the change is.
pub(super) fn crossing([(from, one), (to, other)]: [(f64, Option<f64>); 2]) -> f64 {
    let share = match (one, other) {
        (Some(one), Some(other)) if one != other => (one / (one - other)).clamp(0.0, 1.0), // g_1 + share (g_2 - g_1) = 0.
        _ => 0.5,
    };
    from + share * (to - from)
}

impl FloquetMultiplier {
    /// That of a direction which the map of a period (s) multiplies; `open` is what its growth rate may be wrong by (1/s) besides a
    /// hundredth of itself.
    pub(super) fn new(multiplier: c64, period: f64, open: f64) -> Self {
        let growth_rate = multiplier.norm().ln() / period;
        Self {
            multiplier,
            growth_rate,
            uncertainty: open + 0.01 * growth_rate.abs(),
            beat_hz: multiplier.arg().abs() / (TAU * period),
            mode: None,
        }
    }

    /// Where it leaves the unit circle, in words: a pair at an angle brings a second frequency, one at -1 twice the period, one at 1 a
    /// neighbouring cycle.
    pub fn kind(&self) -> &'static str {
        match self.multiplier {
            own if own.im != 0.0 => "a Neimark-Sacker bifurcation, to two frequencies",
            own if own.re < 0.0 => "a period doubling",
            _ => "a fold or a branching to another cycle",
        }
    }

    /// What its growth rate says for sure.
    pub fn verdict(&self) -> Verdict {
        match self.growth_rate {
            rate if rate > self.uncertainty => Verdict::Unstable,
            rate if rate < -self.uncertainty => Verdict::Stable,
            _ => Verdict::Undecided,
        }
    }
}

impl FloquetMultipliers {
    /// The multiplier of the fastest growth or slowest decay.
    pub fn leading(&self) -> Option<&FloquetMultiplier> {
        self.multipliers.first()
    }

    /// What all of them together say for sure.
    pub fn verdict(&self) -> Verdict {
        let has = |wanted: Verdict| self.multipliers.iter().any(|own| own.verdict() == wanted);
        let known = [Verdict::Unstable, Verdict::Undecided].into_iter().find(|&wanted| has(wanted)); // One that grows decides.
        known.unwrap_or(Verdict::Stable)
    }

    /// Circumferential harmonics of the modes that grow for sure, rising; of a rotating wave.
    pub fn growing_harmonics(&self) -> Vec<usize> {
        let growing = self.multipliers.iter().filter(|own| own.verdict() == Verdict::Unstable);
        let all: BTreeSet<usize> = growing.filter_map(|own| Some(own.mode?.harmonic)).collect();
        all.into_iter().collect()
    }
}
