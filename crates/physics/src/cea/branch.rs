//! Eigenvalues as continuous functions of the friction coefficient.

use crate::cea::*;

/// A branch at one friction value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchPoint {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Eigenvalue `lambda`, rad/s, `Im(lambda) >= 0`.
    pub eigenvalue: c64,
    /// `d lambda / d mu`, rad/s.
    pub rate: c64,
    /// Relative residual, see [`crate::cea::ComplexMode::residual`].
    pub residual: f64,
}

/// One eigenvalue followed continuously from rest over the friction coefficient.
///
/// Between two points the cubic through both eigenvalues and rates represents it to about `1e-6` of `|lambda|`.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeBranch {
    /// Circumferential harmonic `n`.
    pub harmonic: usize,
    /// Rank of its frequency among the harmonic's modes without friction, 1 = lowest; from 1000 on where it does not reach back there.
    pub branch: usize,
    /// Direction of travel: +1 with the rotor, -1 against it, 0 standing.
    pub direction: i8,
    /// Points of rising friction coefficient from 0, or from where the mode begins to oscillate: the values asked for and those in
    /// between that the shape of the branch needed.
    pub points: Vec<BranchPoint>,
    /// Where `Re(lambda) > 0`.
    pub intervals: Vec<UnstableInterval>,
}

impl ModeBranch {
    /// Whether a mode is on it: both waves of a pair have one name, and opposite directions.
    pub fn has(&self, mode: &ComplexMode) -> bool {
        (self.harmonic, self.branch) == (mode.harmonic, mode.branch)
            && self.direction * mode.direction >= 0
    }

    /// `lambda` at any friction coefficient of the range, by the cubic between its neighbours; `None` outside.
    pub fn interpolate(&self, friction_coefficient: f64) -> Option<c64> {
        let mu = friction_coefficient;
        if let Some(point) = self.points.iter().find(|p| p.friction_coefficient == mu) {
            return Some(point.eigenvalue);
        }
        let is_around =
            |p: &&[BranchPoint]| p[0].friction_coefficient < mu && mu < p[1].friction_coefficient;
        let pair = self.points.windows(2).find(is_around)?;
        let cubic = Cubic::between(&pair[0], &pair[1]);
        Some(cubic.value((mu - pair[0].friction_coefficient) / cubic.width))
    }
}

/// Cubic through two points and slopes, over `t` from 0 to 1.
pub(super) struct Cubic {
    pub width: f64,
    coefficients: [c64; 4],
}

impl Cubic {
    pub fn between(start: &BranchPoint, end: &BranchPoint) -> Self {
        let width = end.friction_coefficient - start.friction_coefficient;
        let (a, b) = (start.eigenvalue, start.rate * width); // Slopes over t: width d lambda / d mu.
        let (rise, slope) = (end.eigenvalue - a, end.rate * width);
        Self { width, coefficients: [a, b, rise * 3.0 - b * 2.0 - slope, b + slope - rise * 2.0] }
    }

    pub fn value(&self, t: f64) -> c64 {
        let [a, b, c, d] = self.coefficients;
        a + (b + (c + d * t) * t) * t
    }

    pub fn real_part(&self, t: f64) -> f64 {
        self.value(t).re
    }

    /// Where the slope of the real part vanishes inside, rising.
    pub fn turning_points(&self) -> Vec<f64> {
        let [_, b, c, d] = self.coefficients.map(|value| value.re);
        let discriminant = c * c - 3.0 * b * d;
        if discriminant < 0.0 {
            return Vec::new();
        }
        let q = -(c + discriminant.sqrt().copysign(c)); // Stable roots of b + 2 c t + 3 d t^2.
        let mut roots = vec![q / (3.0 * d), b / q];
        roots.retain(|t| *t > 0.0 && *t < 1.0);
        roots.sort_by(f64::total_cmp);
        roots.dedup();
        roots
    }

    /// A root of the real part in [0, 1], by bisection.
    pub fn root(&self) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let is_positive = self.real_part(low) > 0.0; // The half that keeps the sign at its lower end.
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if (self.real_part(middle) > 0.0) == is_positive {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}
