//! Stability of limit cycles: growth of small perturbations that ride on the wave.

use crate::linalg::c64;

/// One exponent of a small perturbation of a limit cycle, and the mode that has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloquetExponent {
    /// `lambda` in the frame of the wave: growth rate in 1/s and frequency in rad/s.
    pub exponent: c64,
    /// What its growth rate may be wrong by, 1/s.
    pub uncertainty: f64,
    /// Class `p`, `0 <= p <= n / 2`: the mode holds harmonics that differ from `+-p` by a multiple of `n`.
    pub class: usize,
    /// Circumferential harmonic at which the mode moves the edge most.
    pub harmonic: usize,
    /// Frequency of that harmonic in the fixed frame, Hz.
    pub frequency_hz: f64,
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
    /// What a growth rate says for sure.
    pub(super) fn of_rate(rate: f64, uncertainty: f64) -> Self {
        match rate {
            rate if rate > uncertainty => Self::Unstable,
            rate if rate < -uncertainty => Self::Stable,
            _ => Self::Undecided,
        }
    }

    /// What all perturbations together say.
    pub(super) fn of_all(all: impl Iterator<Item = Self> + Clone) -> Self {
        let has = |wanted: Self| all.clone().any(|found| found == wanted);
        let known = [Self::Unstable, Self::Undecided].into_iter().find(|&wanted| has(wanted));
        known.unwrap_or(Self::Stable)
    }

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

/// Stability of a limit cycle to every perturbation that its mesh can carry.
///
/// A perturbation `e^{lambda t} e^{i p theta} W(r, n theta + omega t)` holds the circumferential harmonics `p + k n`, each
/// with the frequency `Im lambda + k omega`.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleStability {
    /// Leading exponents, by falling growth rate. The wave's own shift in phase, which neither grows nor decays, is left
    /// out; of each conjugate pair one is kept.
    pub exponents: Vec<FloquetExponent>,
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
        (Some(one), Some(other)) if one != other => (one / (one - other)).clamp(0.0, 1.0),
        _ => 0.5,
    };
    from + share * (to - from)
}

impl StabilityChange {
    /// In words, of a wave of harmonic `n`: a mode of another harmonic turns at a frequency of its own, so that its multiplier
    /// leaves the unit circle at an angle.
    pub fn kind(&self, n: usize) -> &'static str {
        match self.harmonic == n {
            true => "of its own wave",
            false => "a Neimark-Sacker bifurcation, to two frequencies",
        }
    }
}

impl FloquetExponent {
    /// What its growth rate says for sure.
    pub fn verdict(&self) -> Verdict {
        Verdict::of_rate(self.exponent.re, self.uncertainty)
    }
}

impl CycleStability {
    /// The exponent that grows fastest or decays slowest; `None` if all decay too fast to be found.
    pub fn leading(&self) -> Option<&FloquetExponent> {
        self.exponents.first()
    }

    /// What the exponents say for sure.
    pub fn verdict(&self) -> Verdict {
        Verdict::of_all(self.exponents.iter().map(FloquetExponent::verdict))
    }

    /// Whether every perturbation decays for sure.
    pub fn is_stable(&self) -> bool {
        self.verdict() == Verdict::Stable
    }

    /// Circumferential harmonics of the modes that grow for sure, rising.
    pub fn growing_harmonics(&self) -> Vec<usize> {
        let growing = self.exponents.iter().filter(|e| e.verdict() == Verdict::Unstable);
        let mut harmonics: Vec<usize> = growing.map(|found| found.harmonic).collect();
        harmonics.sort_unstable();
        harmonics.dedup();
        harmonics
    }
}
