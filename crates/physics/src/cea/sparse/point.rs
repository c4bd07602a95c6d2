//! All modes at one friction coefficient, each held to its residual in the full matrices.

use super::reduced::inside;
use crate::cea::sparse::*;

/// What the full matrices say about one mode.
#[derive(Clone, Debug)]
pub struct ModeCheck {
    /// `|T(lambda) x| / ((|lambda|^2 |M| + |lambda| |C| + |K|) |x|)`.
    pub residual: f64,
    /// `|T(lambda) x| / ((|lambda|^2 + c^2) |M x|)`: stricter, as it does not count the stiffest waves of the mesh.
    pub force_residual: f64,
    /// See [`crate::cea::ComplexMode::uncertainty`].
    pub uncertainty: f64,
    /// See [`crate::cea::ComplexMode::contact_share`].
    pub contact_share: f64,
    /// Displacements of the contact edge.
    pub edge: Vec<c64>,
    /// Largest displacement.
    pub peak: f64,
}

impl ModeCheck {
    /// Relative error of the eigenvalue that the residual leaves open.
    fn error(&self) -> f64 {
        self.residual / f64::EPSILON * self.uncertainty // The uncertainty is what a residual of eps leaves open.
    }

    fn has_converged(&self) -> bool {
        self.residual <= RESIDUAL_BOUND && self.error() < 1.0
    }
}

/// The modes at one friction coefficient.
#[derive(Clone, Debug)]
pub struct SolvedPoint {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Modes by rising frequency; a few more than wanted.
    pub modes: Vec<ReducedMode>,
    /// Number of leading modes that are wanted.
    pub wanted: usize,
    /// Checks of leading modes, at least the wanted ones.
    pub checks: Vec<ModeCheck>,
    /// Frequency up to which modes are wanted here, rad/s: that of the highest where a number of them is.
    pub range_end: f64,
    /// Whether branches are only followed here, see [`crate::cea::SweepRequest::followed_at`].
    pub is_followed: bool,
    /// Whether left vectors are coarse still.
    pub has_coarse_lefts: bool,
}

impl SolvedPoint {
    /// Largest residuals of the wanted modes: relative to the matrices, and to the inertia force.
    pub fn worst(&self) -> (f64, f64) {
        let wanted = self.checks.iter().take(self.wanted);
        wanted
            .fold((0.0, 0.0), |(r, f), check| (check.residual.max(r), check.force_residual.max(f)))
    }

    /// Whether their residuals leave no more of the wanted eigenvalues open than their vectors do where they meet.
    pub fn is_sharp(&self) -> bool {
        self.checks.iter().take(self.wanted).all(|check| check.error() <= MULTIPLE)
    }

    /// The wanted modes that could still be improved: their residual force, relative to the inertia force, is above `goal`, or their
    /// residual above the bound of converged pairs.
    pub fn open_modes(&self, goal: f64) -> impl Iterator<Item = &ReducedMode> {
        let pairs = self.modes.iter().zip(&self.checks).take(self.wanted);
        let open = pairs.enumerate().filter(move |(i, (_, check))| {
            // A residual of round-off is no excuse where the mode answers to it, but for the least that there can be.
            let is_within = |errors: f64| check.residual <= errors * f64::EPSILON;
            let is_summed = is_within(ROUNDING_ERRORS) && check.error() <= RESIDUAL_BOUND;
            let is_round_off = is_within(2.0) || is_summed;
            let is_fine = check.force_residual <= goal && check.residual <= RESIDUAL_BOUND;
            !(is_fine || is_round_off || self.tells_growth(*i))
        });
        open.map(|(_, (mode, _))| mode)
    }

    /// Whether a mode is as sharp as a branch needs it that is only followed here: its residual force, relative to the inertia force, leaves
    /// the square over the distance from other eigenvalues open, which is less than its growth. What grows may do so from a jump on, where
    /// its frequency is told.
    fn tells_growth(&self, i: usize) -> bool {
        let (own, residual) = (self.modes[i].eigenvalue, self.checks[i].force_residual);
        let distances = self.modes.iter().map(|other| (other.eigenvalue - own).norm());
        let distance = distances.filter(|other| *other > 0.0).fold(own.norm(), f64::min);
        let [distance, growth] = [distance, own.re.abs()].map(|part| part / own.norm());
        let most = if self.modes[i].is_growing() { SAME_EIGENVALUE } else { NEAR };
        self.is_followed && residual.powi(2) <= distance * most.min(LITTLE * growth)
    }

    /// Whether mode `i` is what it is taken for.
    pub fn is_told(&self, i: usize) -> bool {
        self.checks[i].has_converged() || self.tells_growth(i)
    }

    /// Wanted modes that have converged, and whose eigenvalue their residual does not leave open.
    pub fn converged(&self) -> usize {
        (0..self.wanted.min(self.checks.len())).filter(|&i| self.is_told(i)).count()
    }

    /// Takes out the wanted modes that have not converged; their frequencies, rad/s. Where a number of modes is wanted those above take
    /// their places, as far as they have converged.
    pub fn drop_unconverged(&mut self, limit: ModeLimit) -> Vec<f64> {
        let mut dropped = Vec::new();
        for i in (0..self.wanted.min(self.checks.len())).rev() {
            if !self.is_told(i) {
                self.checks.remove(i);
                dropped.push(self.modes.remove(i).eigenvalue.im);
                self.wanted -= 1;
            }
        }
        if let (ModeLimit::Lowest(_), [_, ..]) = (limit, &dropped[..]) {
            let above = self.checks.iter().skip(self.wanted).take(dropped.len());
            self.wanted += above.take_while(|check| check.has_converged()).count();
            self.range_end = self.modes[..self.wanted].last().map_or(0.0, |own| own.eigenvalue.im);
        }
        dropped
    }

    /// Left vectors in the whole basis of `model`, with what depends on them: each takes an LU of that size, so points get them once
    /// their modes have converged.
    pub fn refine_lefts(&mut self, model: &ReducedModel) {
        let mu = self.friction_coefficient;
        let is_coarse = std::mem::take(&mut self.has_coarse_lefts);
        if !is_coarse || mu == 0.0 || !model.samples.iter().any(|own| own.0 == mu) {
            return;
        }
        let lengths = |modes: &[ReducedMode]| -> Vec<f64> {
            modes.iter().map(|mode| length(&mode.left)).collect()
        };
        let coarse = lengths(&self.modes);
        model.refine_lefts(&mut self.modes, mu);
        let refined = lengths(&self.modes);
        for (check, (old, new)) in self.checks.iter_mut().zip(coarse.iter().zip(&refined)) {
            check.uncertainty *= new / old; // It goes with the length of w.
        }
    }

    /// The same modes in the span of `columns`, orthonormal coordinates in the basis until now; left vectors are coarse again.
    pub(super) fn restrict(&mut self, columns: &Mat<f64>) {
        self.has_coarse_lefts = true;
        for mode in &mut self.modes {
            for vector in [&mut mode.right, &mut mode.left] {
                *vector = inside(columns, vector);
            }
        }
    }
}

/// Scales a nodal vector so that its largest entry is 1; what it was divided by.
pub fn normalize(shape: &mut [c64]) -> c64 {
    let zero = c64::new(0.0, 0.0);
    let largest =
        shape.iter().fold(zero, |best, &v| if v.norm_sqr() > best.norm_sqr() { v } else { best });
    if largest == zero {
        return c64::new(1.0, 0.0);
    }
    shape.iter_mut().for_each(|v| *v /= largest);
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact: neither what has not converged is a mode, nor what its residual leaves open by its own size.
    #[test]
    fn eigenvalues_that_residuals_leave_open_are_no_modes() {
        let mode = |k: usize| ReducedMode {
            eigenvalue: c64::new(-0.1, k as f64),
            derivative: c64::new(0.0, 0.0),
            right: Vec::new(),
            left: Vec::new(),
        };
        let check = |(residual, uncertainty)| ModeCheck {
            residual,
            force_residual: 0.0,
            uncertainty,
            contact_share: 0.0,
            edge: Vec::new(),
            peak: 1.0,
        };
        let mut point = SolvedPoint {
            friction_coefficient: 0.3,
            modes: (1..=4).map(mode).collect(),
            wanted: 4,
            checks: [(1e-16, 1e-5), (2e-9, 1e-15), (2e-10, 1e-5), (2e-10, 1e-12)].map(check).into(),
            range_end: 5.0,
            is_followed: false,
            has_coarse_lefts: false,
        };
        assert_eq!(point.drop_unconverged(ModeLimit::MaxFrequency(1.0)), [3.0, 2.0]);
        assert_eq!((point.wanted, point.checks.len()), (2, 2));
        let left: Vec<f64> = point.modes.iter().map(|own| own.eigenvalue.im).collect();
        assert_eq!(left, [1.0, 4.0]);
        // Of a number of modes the next ones move up as far as they have converged.
        let numbers = [(1e-16, 1e-5), (2e-9, 1e-15), (2e-10, 1e-12), (2e-10, 1e-5)].map(check);
        (point.modes, point.checks) = ((1..=4).map(mode).collect(), numbers.into());
        point.wanted = 2;
        assert_eq!(point.drop_unconverged(ModeLimit::Lowest(2)), [2.0]);
        assert_eq!((point.wanted, point.range_end), (2, 3.0));
    }
}
