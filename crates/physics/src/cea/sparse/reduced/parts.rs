//! The projected problem in parts of a wide basis.
//!
//! Every sample makes the basis wider, and a mode beside one costs the cube of that. Modes and left vectors are nearly combinations
//! of the modes at the samples about them, and of the corrections there.

use super::spanned;
use crate::cea::sparse::*;
use crate::linalg::dense::GrowingColumns;
use std::sync::{Mutex, PoisonError};

/// The projected problem in a part of the basis.
pub(super) struct BasisPart {
    /// Orthonormal coordinates in the basis.
    pub columns: Mat<f64>,
    pub model: ReducedModel,
}

/// Parts, each with the friction coefficients of its samples, rising. Wherever the basis grows its columns stay what they are.
#[derive(Default)]
pub(super) struct BasisParts(Mutex<Vec<(Vec<f64>, Arc<BasisPart>)>>);

impl BasisParts {
    /// Drops what holds anything at `mu`.
    pub fn change_at(&mut self, mu: f64) {
        let known = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        known.retain(|(places, _)| !(places[0]..=places[places.len() - 1]).contains(&mu)); // A sample inside the range changes it.
    }
}

/// Coordinates of a vector in the space of orthonormal `columns`.
pub fn inside(columns: &Mat<f64>, vector: &[c64]) -> Vec<c64> {
    let along = |j: usize| -> c64 {
        vector.iter().zip(column(columns.as_ref(), j)).map(|(v, c)| *v * *c).sum()
    };
    (0..columns.ncols()).map(along).collect()
}

impl ReducedModel {
    /// The problem in the span of the modes at the samples nearest to `mu` and of the corrections among these: of a wide
    /// basis of matrices that do not depend on frequency.
    pub(super) fn surroundings(&self, mu: f64) -> Option<Arc<BasisPart>> {
        if self.samples.len() < 2 * NEIGHBOURS || self.terms.is_tabled() {
            return None;
        }
        let mut nearest: Vec<&(f64, Mat<f64>)> = self.samples.iter().collect();
        crate::order::sort_by_number(&mut nearest, |a| (a.0 - mu).abs());
        nearest.truncate(NEIGHBOURS);
        crate::order::sort_by_number(&mut nearest, |a| a.0); // Rising: one span from any mu among them.
        let places: Vec<f64> = nearest.iter().map(|sample| sample.0).collect(); // A part is known by its samples.
        let mut parts = self.parts.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = parts.iter().find(|(own, _)| *own == places) {
            return Some(Arc::clone(known));
        }

        let range = places[0]..=places[NEIGHBOURS - 1];
        let corrections = self.corrections.iter().filter(|own| range.contains(&own.0));
        let samples = nearest.into_iter().chain(corrections);
        let columns = spanned(Mat::zeros(self.dimension(), 0), samples);
        let part = Arc::new(BasisPart { model: self.within(&columns), columns });
        parts.push((places, Arc::clone(&part)));
        Some(part)
    }

    /// Overlaps of some modes with `others` in the matrices at `mu`, and those of the others with them.
    pub fn overlaps_at(
        &self,
        mu: f64,
        modes: &[ReducedMode],
        others: &[ReducedMode],
    ) -> [Mat<c64>; 2] {
        let Some(part) = self.surroundings(mu) else {
            let at = self.at(mu);
            return [at.overlaps(modes, others), at.overlaps(others, modes)];
        };
        let at = part.model.at(mu);
        let [modes, others] = [modes, others].map(|all| -> Vec<ReducedMode> {
            all.iter().map(|mode| mode.map(|own| inside(&part.columns, own))).collect()
        });
        [at.overlaps(&modes, &others), at.overlaps(&others, &modes)]
    }

    /// The projected problem alone, in the space of orthonormal `columns` of coordinates.
    fn within(&self, columns: &Mat<f64>) -> Self {
        let within = |terms: &Vec<Term>| terms.iter().map(|term| term.within(columns)).collect();
        Self {
            linearization: self.linearization,
            terms: self.terms.map(within),
            share: self.share,
            weights: self.weights,
            basis: GrowingColumns::new(0),
            samples: Vec::new(),
            corrections: Vec::new(),
            parts: BasisParts::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::reduced::{beside_stiffness, lengthened};
    use crate::cea::sparse::{BasisBuilder, FrictionlessModes, Linearization};
    use crate::cea::{ModeLimit, Unwatched};
    use crate::linalg::MatrixPolynomial;
    use crate::linalg::dense::orthonormal_complement;

    /// Consistency check: between samples a mode in a part of the basis is that in all of it. Samples that change do not leave an
    /// earlier part behind.
    #[test]
    fn a_mode_in_a_part_of_the_basis_is_that_in_all_of_it() {
        let tangent = string_on_belt(400, 0.4, false);
        let modes = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(6)).unwrap();
        let linearization = Linearization::of(&tangent, modes.frequencies[5], modes.centre);
        let start = (&modes.vectors, modes.rigid);
        let mut builder =
            BasisBuilder::new(&tangent, linearization, start, modes.factors, &Unwatched);
        let values: Vec<f64> = (0..16).map(|i| 0.04 * f64::from(i)).collect();
        for mu in &values[1..] {
            builder.sample(&[*mu]).unwrap();
        }
        let (model, mu) = (&mut builder.model, 0.294);
        assert!(model.surroundings(mu).unwrap().columns.ncols() < model.dimension());
        for guess in model.solve_with_coarse_lefts(mu, 6).unwrap() {
            let part = model.mode_near(mu, &guess).unwrap().eigenvalue;
            let all = model.at(mu).mode_near(&guess).unwrap().eigenvalue;
            assert!((part - all).norm() < 1e-9 * all.norm(), "{part} {all}");
        }

        // Three samples held anew come last: where those were that span the part are those of higher friction now.
        let held: Vec<(f64, Mat<f64>)> = model.samples[..3].to_vec();
        held.iter().for_each(|own| model.drop_sample(own.0));
        held.into_iter().for_each(|(mu, own)| model.hold_coordinates(mu, own));
        let columns = &model.surroundings(0.414).unwrap().columns;
        let own = model.samples.iter().find(|own| own.0 == values[12]).unwrap();
        let own = lengthened(&own.1, columns.nrows());
        let beyond = orthonormal_complement(columns.as_ref(), own, 1e-9);
        assert_eq!(beyond.ncols(), 0);
    }

    /// Consistency check: whether damping follows what friction does to the stiffness, or has a part of its own there, its projection is
    /// that of the damping itself.
    #[test]
    fn damping_beside_the_stiffness_is_projected_whole() {
        for own_part in [0.0, 0.02] {
            let mut tangent = string_on_belt(400, 0.4, false);
            let pattern = std::sync::Arc::clone(tangent.stiffness.pattern());
            let dashpots = [(0..90, 0.05), (0..60, own_part)];
            let dashpots = dashpots.map(|(at, own)| at.map(|i| (i, i, own)).collect());
            let dashpots = MatrixPolynomial::on_pattern(&pattern, &dashpots);
            tangent.damping = MatrixPolynomial::combination(1.0, &tangent.damping, 1.0, &dashpots);
            let (share, rest) = beside_stiffness(&tangent);
            let is_shared = own_part == 0.0;
            assert!((share - if is_shared { 1e-3 } else { 0.0 }).abs() < 1e-15, "{share}");
            assert_eq!(rest[1].iter().all(|value| *value == 0.0), is_shared);

            let modes = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(6)).unwrap();
            let linearization = Linearization::of(&tangent, modes.frequencies[5], modes.centre);
            let start = (&modes.vectors, modes.rigid);
            let builder =
                BasisBuilder::new(&tangent, linearization, start, modes.factors, &Unwatched);
            let (model, mu) = (&builder.model, 0.3);
            let all = model.expand(Mat::identity(model.dimension(), model.dimension()).as_ref());
            let image = pattern.multiply(&tangent.damping.evaluate(mu), all.as_ref());
            let away = (all.transpose() * image - model.at(mu).damping).norm_max();
            assert!(away < 1e-14, "{away:e}");
        }
    }
}
