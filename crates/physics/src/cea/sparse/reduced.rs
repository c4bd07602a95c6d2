//! The matrices of small motions projected on one basis that serves every friction coefficient.

mod clusters;
mod dense;
mod parts;

use super::basis::turn_to_real;
use super::packed::side_by_side;
use super::projected::summed;
use crate::cea::sparse::*;
use crate::linalg::FrictionWeights;
use crate::linalg::dense::{GrowingColumns, orthonormal_complement, product};
use crate::linalg::gram::complement;
use parts::BasisParts;
pub(super) use parts::inside;

/// Columns continued by zeros to `rows` entries.
fn lengthened(columns: &Mat<f64>, rows: usize) -> Mat<f64> {
    let known = columns.nrows();
    Mat::from_fn(rows, columns.ncols(), |i, j| if i < known { columns[(i, j)] } else { 0.0 })
}

/// Orthonormal `columns` continued by what `others` have beyond them.
fn widened(columns: Mat<f64>, others: Mat<f64>) -> Mat<f64> {
    let new = orthonormal_complement(columns.as_ref(), others, ROUND_OFF);
    join_columns(columns.as_ref(), new.as_ref())
}

/// The same of the coordinates of some samples.
fn spanned<'a>(columns: Mat<f64>, samples: impl Iterator<Item = &'a (f64, Mat<f64>)>) -> Mat<f64> {
    samples.fold(columns, |columns, (_, own)| {
        let own = lengthened(own, columns.nrows());
        widened(columns, own)
    })
}

/// `columns` times complex coordinates; nothing of no coordinates.
fn combined(columns: &Mat<f64>, coordinates: &[c64]) -> Vec<c64> {
    let mut sum =
        vec![c64::new(0.0, 0.0); if coordinates.is_empty() { 0 } else { columns.nrows() }];
    for (j, factor) in coordinates.iter().enumerate() {
        for (s, v) in sum.iter_mut().zip(column(columns.as_ref(), j)) {
            *s += factor * *v;
        }
    }
    sum
}

/// Damping as `C = b K + R`: `b` and the coefficients of `R`. Where stress damps in proportion, with all powers of friction and on all
/// unknowns, those of `R` beyond the first touch the contact alone.
fn beside_stiffness(tangent: &SlidingTangent) -> (f64, Vec<Vec<f64>>) {
    let [damping, stiffness] = [&tangent.damping, &tangent.stiffness].map(|p| p.coefficients());
    let size = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // The highest power has stress alone; without any the share is infinite, or no number.
    let last = damping.len() - 1;
    let share = stiffness.get(last).map_or(0.0, |own| size(&damping[last]) / size(own));
    let beside = |p: usize| -> Vec<f64> {
        let bound = if p == 0 { 0.0 } else { ROUND_OFF * size(&damping[p]) };
        let own = damping[p].iter().zip(&stiffness[p]).map(|(c, k)| c - share * k);
        own.map(|own| if own.abs() > bound { own } else { 0.0 }).collect()
    };
    match share.is_normal() && stiffness.len() == damping.len() && size(&beside(last)) == 0.0 {
        true => (share, (0..=last).map(beside).collect()),
        false => (0.0, damping.to_vec()),
    }
}

/// Makes of the left vectors of modes those that belong to their right ones, of which the decomposition leaves any basis of the space of a
/// multiple eigenvalue: `W G^-T` with `G = W^T N X`, of which `overlaps` has the entries.
fn pair_lefts(modes: &mut [ReducedMode], overlaps: &Mat<c64>) {
    let values: Vec<c64> = modes.iter().map(|mode| mode.eigenvalue).collect();
    let mut is_paired = vec![false; modes.len()];
    for i in 0..modes.len() {
        if is_paired[i] {
            continue;
        }
        let is_one = |j: usize| (values[j] - values[i]).norm() <= MULTIPLE * values[i].norm();
        let own: Vec<usize> = (i..modes.len()).filter(|&j| !is_paired[j] && is_one(j)).collect();
        own.iter().for_each(|&j| is_paired[j] = true);
        let gram = Mat::from_fn(own.len(), own.len(), |a, b| overlaps[(own[a], own[b])]); // G = W^T N X.
        // Coordinates of an earlier basis are shorter.
        let rows = own.iter().map(|&j| modes[j].left.len()).max().unwrap_or(0);
        let mut lefts = Mat::from_fn(own.len(), rows, |a, row| {
            modes[own[a]].left.get(row).copied().unwrap_or_default()
        });
        ComplexDenseLu::factorize(gram).solve_in_place(lefts.as_mut()); // G^-1 W^T, whose product with N X is 1.
        for (a, &j) in own.iter().enumerate() {
            modes[j].left = (0..rows).map(|row| lefts[(a, row)]).collect();
        }
    }
}

/// `V^T (lambda^2 M(mu) + lambda C(mu) + K(mu)) V` with an orthonormal `V` that holds the wanted right vectors
/// of all friction coefficients. Left vectors are those of the projected problem: they serve overlaps and derivatives.
///
/// Coordinates stay valid when the basis grows, with zeros for the columns added since; not so when it is compressed.
pub struct ReducedModel {
    linearization: Linearization,
    /// Coefficients of each matrix by power of `mu`; of `C` only where it is not proportional, and but for the `share` of `K` in it.
    terms: MotionMatrices<Vec<Term>>,
    share: f64,
    /// What they weigh.
    weights: FrictionWeights,
    /// `V`, `unknowns x m`.
    basis: GrowingColumns,
    /// Friction coefficients whose modes the basis holds as such, and the orthonormal coordinates that span them.
    pub(super) samples: Vec<(f64, Mat<f64>)>,
    /// Coordinates of corrections between samples, and where they were made.
    corrections: Vec<(f64, Mat<f64>)>,
    parts: BasisParts,
}

impl ReducedModel {
    /// A model without columns.
    pub fn empty(tangent: &SlidingTangent, linearization: Linearization) -> Self {
        // Without friction all are symmetric but for gyroscopic damping.
        let terms = |p: &MatrixPolynomial, is_symmetric: bool| -> Vec<Term> {
            let powers = 0..p.coefficients().len();
            let term = |power: usize| Term::new(p, power, is_symmetric && power == 0);
            powers.map(term).collect()
        };
        let (mut share, mut damping) = (0.0, Vec::new());
        if let Linearization::Companion { .. } = linearization {
            let (own, rest) = beside_stiffness(tangent);
            let rest = MatrixPolynomial::from_coefficients(tangent.stiffness.pattern(), rest);
            (share, damping) = (own, terms(&rest, !tangent.is_gyroscopic));
        }
        let losses = tangent.losses.iter();
        let terms = MotionMatrices {
            stiffness: terms(&tangent.stiffness, true),
            damping,
            mass: terms(&tangent.mass, true),
            losses: losses.map(|(gain, own)| (gain.clone(), terms(own, true))).collect(),
        };
        Self {
            linearization,
            share,
            basis: GrowingColumns::new(tangent.stiffness.dimension()),
            terms,
            weights: tangent.stiffness.weights(),
            samples: Vec::new(),
            corrections: Vec::new(),
            parts: BasisParts::default(),
        }
    }

    /// Number of columns of the basis.
    pub fn dimension(&self) -> usize {
        self.basis.count()
    }

    /// Adds what `columns` hold beyond the basis, down to the length `drop_below` and to a millionth of their own;
    /// returns the new columns of the basis.
    pub fn extend(&mut self, columns: Mat<f64>, drop_below: f64) -> Mat<f64> {
        let new = complement(self.basis.columns(), columns, drop_below);
        if new.ncols() == 0 {
            return new;
        }
        let basis = self.basis.columns();
        self.terms.each_mut().flatten().for_each(|term| term.grow(basis, &new)); // V and the new columns, before they are joined.
        self.basis.append(new.as_ref());
        new
    }

    /// The projected matrices at `mu`.
    pub fn at(&self, mu: f64) -> ProjectedMatrices {
        self.combine(|terms| summed(terms, self.weights, mu, false))
    }

    /// Their derivatives by `mu`.
    pub fn derivative_at(&self, mu: f64) -> ProjectedMatrices {
        self.combine(|terms| summed(terms, self.weights, mu, true))
    }

    fn combine(&self, evaluate: impl Fn(&[Term]) -> Mat<f64>) -> ProjectedMatrices {
        let mut all = self.terms.map(|terms| match terms[..] {
            // Proportional damping has none.
            [] => Mat::zeros(0, 0),
            _ => evaluate(terms),
        });
        if let Linearization::Reduced(coefficients, _) = self.linearization {
            all.damping = Scale(coefficients.mass_coefficient) * &all.mass
                + Scale(coefficients.stiffness_coefficient) * &all.stiffness; // C = alpha M + beta K.
        } else if self.share != 0.0 {
            all.damping += Scale(self.share) * &all.stiffness; // C = R + b K.
        }
        all
    }

    /// The `count` modes of largest `|s|` that oscillate, by rising frequency; overdamped ones are left out. Left vectors, and so
    /// derivatives, are those that the samples about `mu` hold.
    pub fn solve_with_coarse_lefts(
        &self,
        mu: f64,
        count: usize,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let at = self.at(mu);
        let mut modes = self.solve_in(self.span_of_nearest(mu, self.neighbours()), &at, count)?;
        self.complete(&mut modes, &at, mu);
        Ok(modes)
    }

    /// Replaces left vectors of modes in the span of a sample, and derivatives, by those in the whole basis.
    ///
    /// A sample holds right vectors only. With friction left ones are others, which that span hardly holds: overlaps
    /// and derivatives would be wrong. Right vectors at several friction coefficients together come close to them.
    pub fn refine_lefts(&self, modes: &mut [ReducedMode], mu: f64) {
        let values: Vec<c64> = modes.iter().map(|mode| mode.eigenvalue).collect();
        // The iteration would turn the vectors of one multiple eigenvalue into one.
        let is_single = |lambda: c64| {
            let near = |other: &&c64| (**other - lambda).norm() <= MULTIPLE * lambda.norm();
            values.iter().filter(near).count() == 1
        };
        let single = modes.iter_mut().filter(|mode| is_single(mode.eigenvalue));
        crate::parallel::map::<_, _, ()>(single, |mode| {
            if let Some(found) = self.mode_near(mu, mode) {
                mode.left = found.left;
            }
        });
        self.complete(modes, &self.at(mu), mu);
    }

    /// The modes for matching those at the `ends` of a range of friction, as many as there are: in their span where the basis is made of
    /// samples, without the small imaginary parts that light damping gives them, whose square is what eigenvalues are wrong by.
    pub fn solve_between(
        &self,
        mu: f64,
        ends: [&[ReducedMode]; 2],
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let (at, rows) = (self.at(mu), self.dimension());
        let span = (!self.samples.is_empty()).then(|| {
            let modes = ends.into_iter().flatten().map(|mode| &mode.right).collect::<Vec<_>>();
            let mut parts = side_by_side(rows, &modes);
            turn_to_real(&mut parts);
            orthonormal_complement(Mat::zeros(rows, 0).as_ref(), parts, NEAR)
        });
        let count = ends.map(<[_]>::len).into_iter().fold(0, usize::max);
        let mut modes = self.solve_in(span, &at, count)?;
        self.complete(&mut modes, &at, mu);
        Ok(modes)
    }

    /// Takes note that `vectors` are the modes at `mu`: the problem there is then solved in their span, and nearby in
    /// that of the nearest ones. Vectors at the same `mu` add to those held.
    pub fn hold_sample(&mut self, mu: f64, vectors: &Mat<f64>) {
        self.hold_coordinates(mu, transpose_product(self.basis.columns(), vectors.as_ref())); // V^T x.
    }

    /// Forgets the modes held at `mu`.
    pub fn drop_sample(&mut self, mu: f64) {
        self.samples.retain(|sample| sample.0 != mu);
        self.parts.change_at(mu);
    }

    /// Restricts the basis to its `known` first vectors and the modes held; the coordinates of the new basis in the old one, one column
    /// each.
    pub fn restrict(&mut self, known: usize) -> Mat<f64> {
        let m = self.dimension();
        let columns = spanned(Mat::identity(m, known), self.samples.iter());
        self.corrections.clear();
        for (_, held) in &mut self.samples {
            *held = transpose_product(columns.as_ref(), lengthened(held, m).as_ref()); // In the new orthonormal columns.
        }
        self.terms.each_mut().flatten().for_each(|term| term.compress(&columns));
        self.basis.combine(columns.as_ref());
        self.parts = BasisParts::default();
        columns
    }

    /// [`Self::hold_sample`] of vectors given by their coordinates in the basis.
    pub fn hold_coordinates(&mut self, mu: f64, coordinates: Mat<f64>) {
        self.parts.change_at(mu);
        let rows = coordinates.nrows();
        let place = self.samples.iter().position(|sample| sample.0 == mu);
        let place = place.unwrap_or_else(|| {
            self.samples.push((mu, Mat::zeros(rows, 0)));
            self.samples.len() - 1
        });
        let held = &mut self.samples[place].1;
        *held = widened(lengthened(held, rows), coordinates);
    }

    /// Adds the corrections `vectors` of modes at `mu` to what is held there.
    pub fn hold_correction(&mut self, mu: f64, vectors: &Mat<f64>) {
        let coordinates = transpose_product(self.basis.columns(), vectors.as_ref());
        self.corrections.push((mu, coordinates));
        self.parts.change_at(mu);
    }

    /// Samples about a friction coefficient whose modes together come near its own. Of a large body they are more: a wider dense
    /// problem costs less than another sample.
    fn neighbours(&self) -> usize {
        let widths = self.samples.iter().map(|(_, coordinates)| coordinates.ncols());
        let widest = widths.max().unwrap_or(1).max(1);
        (self.basis.columns().nrows().isqrt() / widest).max(NEIGHBOURS) // About as many columns as the root of the unknowns.
    }

    /// Orthonormal coordinates of the span of the `count` samples nearest to `mu`, or of the one there; nothing without samples.
    fn span_of_nearest(&self, mu: f64, count: usize) -> Option<Mat<f64>> {
        let mut nearest: Vec<&(f64, Mat<f64>)> = self.samples.iter().collect();
        crate::order::sort_by_number(&mut nearest, |a| (a.0 - mu).abs());
        let first = nearest.first()?;
        let columns = lengthened(&first.1, self.dimension());
        if first.0 == mu {
            return Some(columns);
        }
        nearest.truncate(count);
        Some(spanned(columns, nearest.into_iter().skip(1)))
    }

    /// The modes within a space of coordinates, or in the whole basis, without derivatives and scale.
    fn solve_in(
        &self,
        space: Option<Mat<f64>>,
        at: &ProjectedMatrices,
        count: usize,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let Some(columns) = space else { return self.solve_projected(at, count) };
        let mut modes = self.solve_projected(&at.within(&columns), count)?;
        for mode in &mut modes {
            mode.right = combined(&columns, &mode.right);
            mode.left = combined(&columns, &mode.left);
        }
        Ok(modes)
    }

    /// The mode at `mu` near `guess`, by two-sided Rayleigh quotient iteration from its eigenvalue and vectors; nothing
    /// where that does not settle.
    pub fn mode_near(&self, mu: f64, guess: &ReducedMode) -> Option<ReducedMode> {
        if let Some(part) = self.surroundings(mu) {
            let guess = guess.map(|own| inside(&part.columns, own));
            return Some(part.model.mode_near(mu, &guess)?.map(|own| combined(&part.columns, own)));
        }
        let at = self.at(mu);
        let mut modes = [at.mode_near(guess)?];
        self.complete(&mut modes, &at, mu);
        let [mode] = modes;
        (mode.eigenvalue.im > 0.0).then_some(mode)
    }

    /// Normalizes vectors, so that `w_i^T (2 lambda M + C) x_j` is 1 for one mode and 0 for others of a multiple eigenvalue, and computes
    /// `dlambda/dmu = -w^T T'(lambda) x`; where stiffness depends on frequency, the mode's own follows ([`own_frequency_step`]).
    pub(super) fn complete(&self, modes: &mut [ReducedMode], at: &ProjectedMatrices, mu: f64) {
        for mode in modes.iter_mut() {
            let length = length(&mode.right);
            mode.right.iter_mut().for_each(|v| *v /= length);
        }
        pair_lefts(modes, &at.overlaps(modes, modes));
        let changes = self.derivative_at(mu).pencil_forms(modes, modes);
        for (j, mode) in modes.iter_mut().enumerate() {
            mode.derivative = at.followed(mode, -changes[(j, j)], c64::new(1.0, 0.0));
        }
    }

    /// `V` times coordinates (of this or an earlier basis).
    pub fn expand(&self, coordinates: MatRef<'_, f64>) -> Mat<f64> {
        let known = self.basis.columns().get(.., ..coordinates.nrows());
        product(known, coordinates)
    }
}
