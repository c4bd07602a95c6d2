//! Unknowns of bodies that are held, tied and in contact.

use super::{PrestressError, Result};
use crate::contact::{Point, Row, scaled, summed};
use crate::fem::{DofMap, Triplets};
use crate::linalg::{FrictionWeights, LuAnalysis, MatrixPolynomial, SparseLu};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// Share of a row's largest coefficient that its first free dof must have to be the one that the row replaces.
const SMALLEST_PIVOT: f64 = 0.3;

/// A change of basis `u = T y` that makes linear forms of the displacements unknowns of their own, and drops some.
///
/// Each form `g . u` taken in ([`Self::take`]) stands in `y` in place of one of its dofs, its pivot: the separation of a
/// contact point, the jump across a tie. What is dropped ([`Self::drop_unknown`]) vanishes: held dofs, jumps of ties,
/// separations of rigid contact. Forms may share dofs with each other; pivots are substituted as they come.
#[derive(Clone, Debug)]
pub struct Elimination {
    /// `u[pivot]` as a combination of `y`; every other dof is itself.
    combined: Vec<Option<Row>>,
    /// Pivots whose combination has this dof.
    used_in: BTreeMap<usize, BTreeSet<usize>>,
    is_dropped: Vec<bool>,
}

/// Friction of rigid contact: the normal force acts along the slip too.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidFriction {
    /// Displacement whose work is the normal force, over all dofs.
    pub lift: Row,
    /// `drag` times the row of the slip, over all dofs.
    pub slip: Row,
}

impl RigidFriction {
    /// That of a contact point.
    pub(super) fn of(point: &Point) -> Self {
        Self { lift: point.lift.clone(), slip: scaled(&point.slip, point.friction.drag) }
    }
}

impl Elimination {
    /// No forms yet; `held` of `total` dofs vanish.
    pub fn holding(total: usize, held: impl IntoIterator<Item = usize>) -> Self {
        let mut is_dropped = vec![false; total];
        held.into_iter().for_each(|dof| is_dropped[dof] = true);
        Self { combined: vec![None; total], used_in: BTreeMap::new(), is_dropped }
    }

    /// Makes `row . u` an entry of `y`, and returns which: that of the row's first dof that is free and not small in it.
    /// `None` where the row has no free dof left: what it measures is held or follows from forms taken before.
    pub fn take(&mut self, row: &Row) -> Option<usize> {
        // g over y, with all forms that were taken before.
        let own: BTreeMap<usize, f64> = self.transposed(row).iter().copied().collect();
        let is_free = |dof: usize| !self.is_dropped[dof] && self.combined[dof].is_none();
        let free = || own.iter().filter(|(dof, _)| is_free(**dof));
        let largest = free().fold(0.0_f64, |m, (_, value)| m.max(value.abs()));
        let size = row.iter().fold(0.0_f64, |m, entry| m.max(entry.1.abs()));
        if largest <= 1e-9 * size {
            return None;
        }
        // The row's own first dof if it will do: patterns and orders stay alike then.
        let is_large = |value: f64| value.abs() >= SMALLEST_PIVOT * largest;
        let firsts = row.iter().map(|entry| entry.0);
        let mut candidates = firsts.chain(free().map(|(dof, _)| *dof));
        let pivot = candidates
            .find(|dof| is_free(*dof) && own.get(dof).is_some_and(|value| is_large(*value)))?;
        // u[pivot] = (y[pivot] - sum of the others) / coefficient.
        let coefficient = own[&pivot];
        let others = own.iter().filter(|(dof, _)| **dof != pivot);
        let others = others.map(|(&dof, value)| (dof, -value / coefficient));
        let combination: Row = std::iter::once((pivot, 1.0 / coefficient))
            .chain(others.filter(|entry| entry.1 != 0.0))
            .collect();
        self.substitute(pivot, combination);
        Some(pivot)
    }

    /// Puts the combination of a new pivot into those that have it.
    fn substitute(&mut self, pivot: usize, combination: Row) {
        for earlier in self.used_in.remove(&pivot).unwrap_or_default() {
            let part = |&(dof, value): &(usize, f64)| match dof == pivot {
                true => scaled(&combination, value),
                false => vec![(dof, value)],
            };
            let row = summed(self.combined[earlier].iter().flatten().flat_map(part)); // Of u_e = ... + v u_pivot the part v u_pivot is v times the combination.
            self.record(earlier, &row);
            self.combined[earlier] = Some(row);
        }
        self.record(pivot, &combination);
        self.combined[pivot] = Some(combination);
    }

    fn record(&mut self, pivot: usize, row: &Row) {
        for &(dof, _) in row {
            self.used_in.entry(dof).or_default().insert(pivot);
        }
    }

    /// An entry of `y` that vanishes.
    pub fn drop_unknown(&mut self, dof: usize) {
        self.is_dropped[dof] = true;
    }

    /// What `y` remains.
    pub fn unknowns(&self) -> DofMap {
        let dropped = (0..self.is_dropped.len()).filter(|&dof| self.is_dropped[dof]);
        DofMap::excluding(self.is_dropped.len(), dropped)
    }

    /// Dofs that are combinations of `y`, with these.
    pub fn combinations(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.combined.iter().enumerate().filter_map(|(dof, row)| Some((dof, row.as_ref()?)))
    }

    /// `T^T g`: the form `g . u` over `y`, sorted, those that vanish included.
    pub fn transposed(&self, row: &[(usize, f64)]) -> Row {
        summed(row.iter().flat_map(|&(dof, value)| match &self.combined[dof] {
            None => vec![(dof, value)],
            Some(combination) => scaled(combination, value),
        }))
    }

    /// `T^T g` over the unknowns.
    pub(super) fn over(&self, unknowns: &DofMap, row: &Row) -> Row {
        let all = self.transposed(row).into_iter();
        all.filter_map(|(dof, a)| Some((unknowns.unknown_of[dof]?, a))).collect()
    }

    /// `T^T f` of forces over all dofs.
    pub fn transposed_forces(&self, forces: &[f64]) -> Vec<f64> {
        let mut result = forces.to_vec();
        self.combinations().for_each(|(pivot, _)| result[pivot] = 0.0);
        // (T^T f)_j = f_j + sum_p T_pj f_p, nothing at the pivots themselves but their own share.
        for (pivot, row) in self.combinations() {
            for &(dof, share) in row {
                result[dof] += share * forces[pivot];
            }
        }
        result
    }

    /// `u = T y`.
    pub fn displacement(&self, y: &[f64]) -> Vec<f64> {
        let mut u = y.to_vec();
        for (pivot, row) in self.combinations() {
            u[pivot] = row.iter().map(|&(dof, share)| share * y[dof]).sum();
        }
        u
    }

    /// The displacement under a `load` on bodies of a stiffness `T^T K T`: `u = T y` with `T^T K T y = T^T f`.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] unless it is positive definite.
    pub(super) fn displacement_under(
        &self,
        load: &[f64],
        stiffness: &Triplets,
    ) -> Result<Vec<f64>> {
        let unknowns = self.unknowns();
        let solver = factorized(stiffness, &unknowns)?;
        let y = solver.solve(unknowns.restrict(&self.transposed_forces(load)));
        Ok(self.displacement(&unknowns.expand(&y)))
    }

    /// `T^T A T` over `y`.
    pub fn congruent<'a>(&self, matrix: &'a Triplets) -> Cow<'a, Triplets> {
        match self.used_in.is_empty() {
            true => Cow::Borrowed(matrix),
            false => Cow::Owned(self.transposed_product(&self.transposed_product(matrix))),
        }
    }

    /// `(A T)^T`, merged.
    fn transposed_product(&self, matrix: &Triplets) -> Triplets {
        let mut product = Triplets { entries: Vec::with_capacity(matrix.entries.len()) };
        for &(row, column, value) in &matrix.entries {
            // Zeros stay: nonzeros are the same for all values of a parameter.
            match &self.combined[column] {
                Some(own) => {
                    own.iter().for_each(|&(dof, share)| product.push(dof, row, share * value))
                }
                None => product.push(column, row, value),
            }
        }
        product.merge();
        product
    }

    /// A diagonal matrix over the dofs that move by themselves: what another dof has goes to those that it follows, by the size
    /// of their shares.
    pub fn gathered(&self, diagonal: &Triplets) -> Triplets {
        let gather = |&(dof, _, value): &(usize, usize, f64)| {
            let mut row = self.transposed(&[(dof, 1.0)]);
            row.retain(|(other, share)| !self.is_dropped[*other] && *share != 0.0);
            let total: f64 = row.iter().map(|(_, share)| share.abs()).sum();
            row.into_iter().map(move |(other, share)| (other, other, value * share.abs() / total))
        };
        Triplets { entries: diagonal.entries.iter().flat_map(gather).collect() }
    }

    /// A matrix of small motions that comes with a power of `mu` over the unknowns: `T^T A T` without what vanishes, where `friction` adds
    /// `-mu` times the work of a lift, the normal force of rigid contact, to the rows of its slip. Coefficients have the given weights.
    pub(super) fn project(
        &self,
        (power, full): (usize, &Triplets),
        unknowns: &DofMap,
        (friction, weights): (&[RigidFriction], FrictionWeights),
    ) -> Vec<Triplets> {
        let powers = weights.times_mu(power).filter(|_| !friction.is_empty());
        let last = powers.fold(power, |last, (at, _)| last.max(at)); // The highest power that friction leads to.
        let mut projected = vec![Triplets::default(); last + 1];
        for &(row, column, value) in &self.congruent(full).entries {
            let [row, column] = [row, column].map(|dof| unknowns.unknown_of[dof]);
            if let (Some(row), Some(column)) = (row, column) {
                projected[power].push(row, column, value);
            }
        }
        // The normal forces of rigid contact are the work of their lifts, taken over all dofs.
        let mut lifts: Vec<Row> = vec![Row::new(); self.is_dropped.len()];
        for (i, rigid) in friction.iter().enumerate() {
            rigid.lift.iter().for_each(|&(dof, share)| lifts[dof].push((i, share)));
        }
        let mut forces = vec![Row::new(); friction.len()]; // N_i = lift_i^T A u: its row over all dofs.
        for &(row, column, value) in &full.entries {
            lifts[row].iter().for_each(|&(i, share)| forces[i].push((column, share * value)));
        }
        for (rigid, force) in friction.iter().zip(&forces) {
            let [slip, force] = [&rigid.slip, force].map(|row| self.over(unknowns, row)); // T^T of both.
            // Row of slip less mu times the normal force: - mu slip_i^T (lift_i^T A T).
            for (at, factor) in weights.times_mu(power) {
                projected[at].push_product(-factor, &slip, &force);
            }
        }
        projected
    }
}

/// Factors of a stiffness over the unknowns.
///
/// # Errors
/// [`PrestressError::Singular`] unless it is positive definite.
pub(super) fn factorized(stiffness: &Triplets, unknowns: &DofMap) -> Result<SparseLu> {
    let place = |dof: usize| unknowns.unknown_of[dof];
    let entries = stiffness.entries.iter();
    let kept =
        entries.filter_map(|&(row, column, value)| Some((place(row)?, place(column)?, value))); // What is held is left out.
    let matrix = MatrixPolynomial::from_triplets(unknowns.len(), &[kept.collect()]);
    let analysis = LuAnalysis::new(matrix.pattern());
    let factors = analysis.and_then(|own| SparseLu::symmetric(&own, matrix.evaluate(0.0)));
    let definite = factors.ok().filter(|own| own.negative_count() == 0); // No negative pivot.
    definite.ok_or(PrestressError::Singular)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Consistency check: forms that share dofs with each other are what `y` says they are.
    #[test]
    fn forms_that_share_dofs_are_entries_of_the_new_basis() {
        let mut basis = Elimination::holding(6, [5]);
        let forms: [Row; 3] = [
            vec![(0, 0.8), (1, 0.6), (3, -1.0)],
            vec![(1, 2.0), (0, -0.5), (4, -0.25), (5, 3.0)],
            vec![(3, 1.0), (4, -1.0)],
        ];
        let pivots = forms.each_ref().map(|form| basis.take(form).unwrap());
        // Held dofs vanish.
        let y = [0.3, -1.7, 0.9, 2.2, -0.4, 0.0];
        let u = basis.displacement(&y);
        for (form, pivot) in forms.iter().zip(pivots) {
            let value: f64 = form.iter().map(|&(dof, a)| a * u[dof]).sum();
            assert!((value - y[pivot]).abs() < 1e-14);
        }
        // Forces and matrices follow: f . u = (T^T f) . y, and u . A u = y . (T^T A T) y.
        let forces = [1.0, -2.0, 0.5, 3.0, -1.0, 0.0];
        let work = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let moved = basis.transposed_forces(&forces);
        assert!((work(&forces, &u) - work(&moved, &y)).abs() < 1e-13);
        let mut matrix = Triplets::default();
        for i in 0..6 {
            matrix.push(i, (2 * i + 1) % 6, 1.0 + i as f64);
            matrix.push(i, i, 2.0);
        }
        let energy = work(&u, &matrix.multiply(6, &u));
        let congruent = basis.congruent(&matrix);
        assert!((work(&y, &congruent.multiply(6, &y)) - energy).abs() < 1e-12);
    }

    #[test]
    fn a_form_that_follows_from_others_is_not_taken_twice() {
        let mut basis = Elimination::holding(3, [2]);
        assert!(basis.take(&vec![(0, 1.0), (1, -1.0)]).is_some());
        let pivot = basis.take(&vec![(0, 1.0), (1, 1.0)]).unwrap();
        basis.drop_unknown(pivot);
        assert_eq!(basis.take(&vec![(0, 2.0), (2, 5.0)]), None);
    }
}
