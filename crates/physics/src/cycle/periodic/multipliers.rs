//! Floquet multipliers of a periodic motion.

use super::map::{PeriodImage, PeriodMap, PeriodicState};
use crate::cycle::arnoldi::{MultiplierSearch, Ritz, unit};
use crate::cycle::{CycleError, FloquetMultiplier, FloquetMultipliers, Verdict};
use crate::linalg::dense::{add, difference, dot, norm};
use crate::linalg::{GaussianNoise, c64};

/// Multipliers kept, and the residual of one that is worth listing.
const LISTED: (usize, f64) = (6, 0.1);
/// The leading ones that must have converged, and the residual of a converged one, relative to it.
const CONVERGED: (usize, f64) = (2, 4e-3);
/// Smallest and largest dimension of the Krylov space, and periods between two looks at it.
const DIMENSIONS: [usize; 3] = [16, 100, 4];
/// Length of a perturbation, relative to the amplitude: so large that some nodes change their status at another step, whose kinks
/// then count as they do in the motion.
const PERTURBATION: f64 = 3e-3;
/// A multiplier whose logarithm is within this of 0 and whose direction has this share along the motion is the shift in phase. A
/// node that starts to slip where friction falls with speed, at a whole step, takes it as far from 1 as 1.5.
const NEUTRAL: [f64; 2] = [0.5, 0.7];
/// Lengths at which a perturbation is followed, relative to the amplitude, periods in which it turns to where it grows fastest,
/// and periods of either half of what is counted.
const FOLLOWED: ([f64; 2], usize, usize) = ([PERTURBATION, PERTURBATION / 3.0], 8, 20);

impl FloquetMultipliers {
    /// Arnoldi's process on differences of the period map at a periodic motion, until the leading multipliers have converged.
    ///
    /// # Errors
    /// [`CycleError::NotFound`] where they do not.
    pub fn of(map: &mut PeriodMap<'_>, state: &PeriodicState) -> Result<Self, CycleError> {
        let (begun, image) = (map.periods(), map.image(state));
        let mut beside = Beside { map, state, image: &image };
        let mut noise = GaussianNoise::new(1);
        let start = (0..state.motion.len()).map(|_| noise.draw().re).collect(); // Noise has a part along every direction.
        let is_shift = |own: &Ritz| own.value.ln().norm() < NEUTRAL[0] && own.along > NEUTRAL[1];
        let search = MultiplierSearch {
            dimensions: DIMENSIONS,
            converged: CONVERGED,
            listed: LISTED,
            is_shift: &is_shift,
            remedy: "cycle.confirmation_periods",
        };
        let found =
            search.run(&unit(start), image.rate.clone(), |d| beside.change_of(d, PERTURBATION))?;
        let direction = |own: &Ritz| unit(found.vector(own).iter().map(|v| v.re).collect());
        // Kinks may part the shift in phase in two. A perturbation that is followed without the shift grows as its multiplier says, a
        // part of the shift does not.
        let (first, has_others) = (&found.listed[0], found.listed.len() > 1);
        let followed = (has_others && is_shift(first)).then(|| beside.followed(direction(first)));
        let growth = followed.filter(|own| (own[0] - first.value.norm().ln()).abs() > own[1]);
        let listed = &found.listed[usize::from(growth.is_some())..];
        let along = direction(&listed[0]);
        let bend = beside.bend(&along) / listed[0].value.norm();
        // What is open of every rate: how far the shift is from 1, the residual, and the bend.
        let shift = found.shift.map(|shift| shift.norm());
        let parts = growth.map(|_| first.value.norm()).into_iter().chain(shift);
        let off = parts.map(|part| part.ln().abs()).reduce(f64::max).unwrap_or(NEUTRAL[0]);
        let of = |ritz: &Ritz| {
            let open = (ritz.residual + off + bend) / state.period;
            FloquetMultiplier::new(ritz.value, state.period, open)
        };
        let mut own = Self { multipliers: listed.iter().map(of).collect(), shift, periods: 0 };
        match own.verdict() {
            Verdict::Stable if growth.is_none() => {}
            Verdict::Unstable => {}
            _ => own.decide(state.period, growth.unwrap_or_else(|| beside.followed(along))),
        }
        own.periods = map.periods() - begun;
        Ok(own)
    }

    /// Takes the leading one by what a period makes of a perturbation that was followed; none of the others grows faster.
    fn decide(&mut self, period: f64, [growth, open]: [f64; 2]) {
        let turned = c64::from_polar(growth.exp(), self.multipliers[0].multiplier.arg()); // Of |P d| alone its angle is not known anew.
        let leading = FloquetMultiplier::new(turned, period, open / period);
        let most = leading.growth_rate + leading.uncertainty;
        self.multipliers[0] = leading;
        self.multipliers.retain(|other| other.growth_rate <= most);
        // None may be thought to grow faster than the leading one.
        let others = self.multipliers.iter_mut().skip(1);
        others.for_each(|own| own.uncertainty = own.uncertainty.min(most - own.growth_rate));
    }
}

/// A periodic motion, beside which others begin.
struct Beside<'m, 'a> {
    map: &'m mut PeriodMap<'a>,
    state: &'m PeriodicState,
    image: &'m PeriodImage,
}

impl Beside<'_, '_> {
    /// `(P(x + l d) - P(x)) / l` of a direction `d`, `l` a share of the amplitude.
    fn change_of(&mut self, direction: &[f64], share: f64) -> Vec<f64> {
        let length = share * self.image.vibration;
        let mut moved = self.state.clone();
        add(&mut moved.motion, length, direction);
        let change = difference(&self.map.image(&moved).motion, &self.image.motion);
        change.into_iter().map(|value| value / length).collect()
    }

    /// `|P(x + l d) - 2 P(x) + P(x - l d)| / l`, 0 of a smooth map. A node that changes its status bends the map: it has another slope along
    /// a direction than against it, and a perturbation may meet either. Known is the one along; the other is smaller by as much at most.
    fn bend(&mut self, along: &[f64]) -> f64 {
        let [one, other] = [PERTURBATION, -PERTURBATION].map(|share| self.change_of(along, share));
        norm(&difference(&one, &other))
    }

    /// Mean of the growth over a period, `ln |P d| / |d|`, of a perturbation that begins in a `direction` and keeps a length, without the
    /// shift in phase, and what that may be wrong by: how far the means of both halves and lengths lie apart. Where impacts bend the map,
    /// no linear one is near it.
    fn followed(&mut self, mut direction: Vec<f64>) -> [f64; 2] {
        let rate = unit(self.image.rate.clone());
        let (lengths, turns, half) = FOLLOWED;
        let mut growth = |length| {
            let mut next = self.change_of(&direction, length);
            let shift = dot(&next, &rate);
            add(&mut next, -shift, &rate); // A shift in phase neither grows nor decays.
            let growth = norm(&next).ln();
            direction = unit(next);
            growth
        };
        let mut sum = |length, periods| (0..periods).map(|_| growth(length)).sum::<f64>();
        let sums = lengths.map(|length| [turns, half, half].map(|periods| sum(length, periods)));
        let means = sums.map(|[_, one, other]| [one, other].map(|sum| sum / half as f64)).concat(); // The turns to its direction do not count.
        let [least, most] = [f64::min, f64::max].map(|of| means.iter().copied().fold(means[0], of));
        [means.iter().sum::<f64>() / means.len() as f64, most - least] // Mean and spread of four: two lengths, two halves.
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_multiplier_tells_what_becomes_of_the_cycle() {
        let kind = |re: f64, im: f64| FloquetMultiplier::new(c64::new(re, im), 1.0, 0.1).kind();
        assert!(kind(0.6, 0.9).contains("Neimark-Sacker"));
        assert!(kind(-1.1, 0.0).contains("doubling"));
        assert!(kind(1.1, 0.0).contains("fold"));
    }
}
