//! Counts of eigenvalues, apart from how they were found.

use crate::cea::*;

/// `|Im lambda| / |lambda|` below which a motion decays without oscillating: its damping factor is above 0.995. Motions beyond
/// critical damping have real eigenvalues only where nothing couples two of them.
pub(super) const STANDSTILL: f64 = 0.1;

/// Damping factor from which on a mode is near critical damping: it may cease to oscillate at the next friction coefficient.
pub(super) const NEARLY_CRITICAL: f64 = 0.5;

/// Whether an eigenvalue has a positive imaginary part and is that of a motion that oscillates or grows.
pub(super) fn is_vibration(value: c64) -> bool {
    value.im > 0.0 && (value.re > 0.0 || value.im > STANDSTILL * value.norm()) // What grows counts, however slowly it turns.
}

/// Largest growth or decay that a count covers, at least, relative to the upper end of the frequencies (rad/s): wider, faster
/// motions than any that sound would be counted; narrower, strongly growing modes would be left out.
pub(super) const WIDEST_GROWTH: f64 = 0.2;
/// The same relative to the modes listed.
const BEYOND_LISTED: f64 = 1.5;

/// `Im lambda` over the decay of a motion at half of critical damping, 1.73: those below are not promised, so they are not counted.
fn least_slope() -> f64 {
    (NEARLY_CRITICAL.powi(-2) - 1.0).sqrt() // Of cos(phi) = 1/2 the tangent.
}

/// A rectangle of the upper half plane, but for what is damped by more than half of critical in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountedRegion {
    /// Range of `Im lambda / 2 pi`, Hz.
    pub frequencies_hz: [f64; 2],
    /// Range of `Re lambda`, 1/s.
    pub growth_rates: [f64; 2],
}

impl CountedRegion {
    /// About all eigenvalues `listed`, up to the angular frequency `top`; its sides stand `factor` times as far as usual.
    pub fn about(listed: &[c64], top: f64, factor: f64) -> Self {
        let lowest = listed.iter().fold(f64::INFINITY, |m, own| m.min(own.im));
        let reach = |sign: f64| {
            let rates = listed.iter().map(|own| BEYOND_LISTED * sign * own.re);
            factor * rates.fold(WIDEST_GROWTH * top, f64::max)
        };
        let [left, right] = [reach(-1.0), reach(1.0)];
        // Motions that decay faster are none that count below the upper end.
        let (left, low) = (left.min(0.9 * top / least_slope()), 0.5 * lowest);
        Self {
            frequencies_hz: [(STANDSTILL * left).min(low) / TAU, top / TAU],
            growth_rates: [-left, right],
        }
    }

    /// Its corners, counter-clockwise: five where the line of half of critical damping cuts one off.
    pub(super) fn corners(&self) -> Vec<c64> {
        let [low, high] = self.frequencies_hz.map(|hz| TAU * hz);
        let [left, right] = self.growth_rates;
        let least = -least_slope() * left;
        let mut corners = vec![(left.max(-low / least_slope()), low), (right, low), (right, high)];
        corners.push((left, high));
        corners.extend((least > (1.0 + NEAR) * low).then_some((left, least)));
        corners.into_iter().map(|(re, im)| c64::new(re, im)).collect()
    }

    /// Whether an eigenvalue lies inside.
    pub fn holds(&self, eigenvalue: c64) -> bool {
        let frequency_hz = eigenvalue.im / TAU;
        let [low, high] = self.frequencies_hz;
        let [left, right] = self.growth_rates;
        let is_inside = low < frequency_hz && frequency_hz < high;
        let is_damped = eigenvalue.im < -least_slope() * eigenvalue.re;
        is_inside && left < eigenvalue.re && eigenvalue.re < right && !is_damped
    }
}

/// The modes at one friction coefficient, counted independently of how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeCount {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Where eigenvalues were counted.
    pub region: CountedRegion,
    /// Modes that are known there.
    pub known: usize,
    /// How many of these only a search found that the count gave rise to.
    pub recovered: usize,
    /// Eigenvalues there that none of them is, negative where some of them are none; why it could not be counted.
    pub missing: Result<i64, String>,
    /// Mean of the missing ones.
    pub near: Option<c64>,
    /// Determinants that were taken.
    pub determinants: usize,
}

impl ModeCount {
    /// Eigenvalues counted, where they could be.
    pub fn counted(&self) -> Option<i64> {
        let missing = self.missing.as_ref().ok()?;
        Some(self.known as i64 + missing)
    }

    /// Whether as many were counted as are known.
    pub fn is_complete(&self) -> bool {
        self.missing == Ok(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact: the wedge of what is damped by more than half of critical is cut off, and holds nothing.
    #[test]
    fn what_is_strongly_damped_is_not_counted() {
        let region = CountedRegion::about(&[c64::new(-1.0, 10.0)], 1e4, 1.0);
        let corners = region.corners();
        assert_eq!((corners.len(), region.holds(c64::new(-1500.0, 2500.0))), (5, false));
        assert!(region.holds(c64::new(-1500.0, 2700.0)) && region.holds(c64::new(-1.0, 10.0)));
        let [above, below] = [corners[4], corners[0]].map(|own| -own.re / own.norm());
        assert!((above - 0.5).abs() < 1e-12 && (below - 0.5).abs() < 1e-12, "{above} {below}");
    }

    #[test]
    fn growth_that_hardly_oscillates_is_sought_all_the_same() {
        let [decay, growth] = [-1.0, 1.0].map(|re| c64::new(re, 0.03));
        assert!(!is_vibration(decay) && is_vibration(growth));
        assert!(!is_vibration(growth.conj()) && is_vibration(c64::new(-1.0, 0.2)));
    }
}
