//! A basis of the modes at a few friction coefficients, each from an iteration of its own.

use super::{BasisBuilder, turn_to_real};
use crate::cea::sparse::packed::{joined, side_by_side};
use crate::cea::sparse::*;
use std::convert::Infallible;

/// Complex factors of one round of corrections: more of them cost more than the rounds that they save.
const MOST_SHIFTS: usize = 6;

impl BasisBuilder<'_> {
    /// Leading vectors of the basis that are motions without friction: rigid ones and modes.
    pub fn leading_count(&self) -> usize {
        self.rigid + self.count
    }

    /// Begins the sample at `mu`, anew, with the rigid motions: in a span without them, what corrections have of them looks like modes.
    fn begin_sample(&mut self, mu: f64) {
        self.model.drop_sample(mu);
        self.sampled.retain(|held| *held != mu);
        self.sampled.push(mu);
        if self.rigid > 0 {
            self.model.hold_coordinates(mu, Mat::identity(self.model.dimension(), self.rigid)); // The rigid ones are its first columns.
        }
    }

    /// Takes up the modes without friction, where branches begin: where stiffness depends on frequency, each at its own. Else those
    /// without damping are near enough, or those of proportional damping.
    pub fn begin_at_rest(&mut self) -> Result<(), CeaError> {
        if self.tangent.is_tabled() {
            return self.sample(&[0.0]);
        }
        let modes = Mat::identity(self.model.dimension(), self.leading_count());
        self.model.hold_coordinates(0.0, modes);
        if let Linearization::Reduced(..) = self.linearization {
            self.sampled.push(0.0);
        }
        Ok(())
    }

    /// Takes up the modes at `values`, of which none is held, from iterations side by side. Of the quadratic problem they begin with
    /// combinations of the modes without friction, which the basis holds first. They leave structural damping and tables out: a start,
    /// which the ladder of a sweep improves.
    ///
    /// # Errors
    /// If a `K(mu)` is singular, or an iteration or a dense decomposition fails.
    pub fn sample(&mut self, values: &[f64]) -> Result<(), CeaError> {
        let is_companion = matches!(self.linearization, Linearization::Companion { .. });
        let count = self.leading_count();
        let leading = is_companion.then(|| count.min(self.model.dimension()));
        let found = self.steps(values, |own, i| own.dominant_vectors(values[i], count, leading))?;
        for (&mu, vectors) in values.iter().zip(found) {
            self.begin_sample(mu);
            self.take(mu, &vectors);
        }
        Ok(())
    }

    /// Whether the basis holds the modes at `mu` as such.
    pub fn is_sampled(&self, mu: f64) -> bool {
        self.sampled.contains(&mu)
    }

    /// Whether the full problem may be decomposed.
    pub fn is_small(&self) -> bool {
        2 * self.tangent.stiffness.dimension() <= WIDEST
    }

    /// Lets all motions of the body stand for the sample at `mu`.
    pub fn hold_all(&mut self, mu: f64) {
        let unknowns = self.tangent.stiffness.dimension();
        self.begin_sample(mu);
        self.take(mu, &Mat::identity(unknowns, unknowns));
        self.steps += 1; // A step like any other, by number.
    }

    /// Drops what repairs of lossy modes, each of many rounds, added to the basis beyond the modes that it holds; the coordinates of the
    /// new basis in the old one.
    pub fn restrict(&mut self) -> Option<Mat<f64>> {
        let may_restrict = self.tangent.is_lossy() && !self.model.samples.is_empty();
        may_restrict.then(|| self.model.restrict(self.leading_count().min(self.model.dimension())))
    }

    /// Lets `modes` stand for a sample at `mu`, if there is none and the basis is made of samples.
    pub fn take_up(&mut self, mu: f64, modes: &[ReducedMode]) {
        if !self.is_whole && !self.is_sampled(mu) {
            self.begin_sample(mu);
            self.model.hold_coordinates(mu, self.leading(modes));
        }
    }

    /// Takes up corrections of modes, each nearly one at its friction coefficient: of right vectors (`false`) and of left ones where `sides`
    /// has them, of which a basis of right ones holds less. An eigenvalue is wrong by the product of what both lack. Whether the basis grew.
    ///
    /// By the full problem there, `t = T(sigma)^-1 T(lambda) x`: what `x` has of another mode, with the eigenvalue `nu`, goes down to
    /// `|sigma - lambda| / |sigma - nu|`. Factors that hold friction, damping, losses and tables, and lie beside the mode, leave a hundredth
    /// or less. Or, `is_at_rest`, by the factors without friction, which cost next to nothing and leave more: of a left vector little, as
    /// what it lacks is near the contact and follows the load as in statics.
    pub fn correct(&mut self, states: &[ModesAt<'_>], sides: &[bool], is_at_rest: bool) -> bool {
        let values: Vec<f64> = states.iter().map(|state| state.0).collect();
        let Ok(found) = self.steps(&values, |builder, i| {
            let (mu, modes) = states[i];
            Ok::<_, Infallible>(match is_at_rest {
                true => builder.corrections_at_rest(mu, modes, sides),
                false => builder.shifted_corrections(mu, modes, sides),
            })
        });
        let none = Mat::zeros(self.tangent.stiffness.dimension(), 0);
        let all = found.iter().fold(none, |all, own| join_columns(all.as_ref(), own.as_ref()));
        let has_grown = self.model.extend(all, ROUND_OFF).ncols() > 0;
        for (&mu, own) in values.iter().zip(&found) {
            match self.is_sampled(mu) {
                true => self.model.hold_sample(mu, own),
                false => self.model.hold_correction(mu, own),
            }
        }
        has_grown
    }

    /// `(K(0) - sigma M(0))^-1 r` of the residuals `r`, two real columns each.
    fn corrections_at_rest(&self, mu: f64, modes: &[ReducedMode], sides: &[bool]) -> Mat<f64> {
        let own: Vec<&ReducedMode> = modes.iter().collect();
        let residuals = sides.iter().map(|is_left| self.residuals(&self.side(mu, *is_left), &own));
        let residuals: Vec<Vec<c64>> = residuals.flatten().collect();
        let mut parts = side_by_side(self.tangent.stiffness.dimension(), &residuals);
        self.factors.solve_in_place(parts.as_mut());
        turn_to_real(&mut parts);
        parts
    }

    /// The problem at `mu` of right vectors, or of left ones.
    fn side(&self, mu: f64, is_left: bool) -> StructureMatrices<'_> {
        StructureMatrices::of_side(self.tangent, self.linearization, (mu, is_left))
    }

    /// `T(lambda) x` of the vectors of modes on one side; of proportional damping but for a factor.
    fn residuals(&self, side: &StructureMatrices<'_>, modes: &[&ReducedMode]) -> Vec<Vec<c64>> {
        let groups = modes.chunks(GROUP_WIDTH / 2).flat_map(|group| {
            let own = group.iter().map(|m| if side.is_transposed { &m.left } else { &m.right });
            let own = side_by_side(self.model.dimension(), &own.collect::<Vec<_>>());
            let x = self.model.expand(own.as_ref());
            let values = group.iter().map(|mode| mode.eigenvalue);
            let (residuals, _) = side.residuals_and_momenta(values, x.as_ref());
            (0..group.len()).map(move |k| joined(&residuals, k))
        });
        groups.collect()
    }

    /// `T(sigma)^-1 r` of the residuals `r`, two real columns each. Neighbours in frequency share factors.
    fn shifted_corrections(&self, mu: f64, modes: &[ReducedMode], sides: &[bool]) -> Mat<f64> {
        let problem = FullProblem::at(self.tangent, mu).sharing(self.factors.analysis());
        let unknowns = problem.dimension();
        let sides: Vec<_> = sides.iter().map(|is_left| self.side(mu, *is_left)).collect();
        let mut open: Vec<&ReducedMode> = modes.iter().collect();
        crate::order::sort_by_number(&mut open, |own| own.eigenvalue.im);

        // Factors beside the middle one of each group; where an eigenvalue lies just there, another round has others.
        let share = open.len().div_ceil(MOST_SHIFTS).max(1); // So that MOST_SHIFTS factors serve all.
        let none = || Mat::zeros(unknowns, 0);
        let solved: Vec<Mat<f64>> = crate::parallel::map(open.chunks(share), |own| {
            let beside = own[own.len() / 2].eigenvalue * (1.0 + BESIDE);
            let Ok(factors) = problem.factors(beside) else { return none() };
            let of_side = |side: &StructureMatrices<'_>| {
                let residuals = self.residuals(side, own);
                let mut x = Mat::from_fn(unknowns, own.len(), |i, j| residuals[j][i]);
                match side.is_transposed {
                    true => factors.solve_transpose_in_place(x.as_mut()),
                    false => factors.solve_in_place(x.as_mut()),
                }
                let part = |x: c64, j: usize| if j.is_multiple_of(2) { x.re } else { x.im };
                Mat::from_fn(unknowns, 2 * own.len(), |i, j| part(x[(i, j / 2)], j))
            };
            sides.iter().fold(none(), |all, own| join_columns(all.as_ref(), of_side(own).as_ref()))
        });
        let mut columns =
            solved.iter().fold(none(), |all, own| join_columns(all.as_ref(), own.as_ref()));
        turn_to_real(&mut columns);
        columns
    }

    /// Lets the `modes` found in the sample at `mu`, if there is one, stand for it: corrections made it wider than they need.
    pub fn hold_solved(&mut self, mu: f64, modes: &[ReducedMode]) {
        if self.is_sampled(mu) && modes.len() >= self.count {
            self.begin_sample(mu);
            self.model.hold_coordinates(mu, self.leading(modes));
        }
    }

    /// Coordinates of the modes to be held, real and imaginary parts.
    fn leading(&self, modes: &[ReducedMode]) -> Mat<f64> {
        // Motions near critical damping, which may be none, take no places.
        let mut far = (0..modes.len()).filter(|&j| !modes[j].is_nearly_critical());
        let held = far.nth(self.count - 1).map_or(modes.len(), |j| {
            let end = CHANGE_PLACES * modes[j].eigenvalue.im; // No cut parts two that may change places.
            modes.partition_point(|mode| mode.eigenvalue.im < end)
        });
        let held: Vec<&Vec<c64>> = modes[..held].iter().map(|mode| &mode.right).collect();
        side_by_side(self.model.dimension(), &held)
    }

    /// Where `mu` lies among the friction coefficients whose modes the basis holds: an odd number at one, an even one between.
    pub fn gap(&self, mu: f64) -> usize {
        let below = self.sampled.iter().filter(|&&held| held < mu).count();
        2 * below + usize::from(self.is_sampled(mu))
    }

    /// Makes the tracking of branches over `from..to` surer: takes up the modes at an end or, after those, at the `place` between where a
    /// branch was lost; whether anything was left to do.
    pub fn improve_between(&mut self, from: f64, to: f64, place: f64) -> Result<bool, CeaError> {
        let is_between = |mu: &&f64| (from..to).contains(*mu);
        let has_many = self.sampled.iter().filter(is_between).count() > MOST_ATTEMPTS;
        let mut values = [from, to, place].into_iter(); // Ends first: they serve the intervals beside it, too.
        match values.find(|mu| !self.sampled.contains(mu)) {
            Some(mu) if !has_many => self.sample(&[mu]).map(|()| true),
            _ => Ok(false),
        }
    }
}
