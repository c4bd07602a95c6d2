//! Left vectors that a basis of right ones does not hold.

use super::full_problem::FullProblem;
use super::linearization::Linearization;
use super::packed::{PackedEntry, add_complex_multiple};
use super::projected::weighted_sum;
use super::structure::StructureMatrices;
use super::{BESIDE, GROUP_WIDTH, HALF_THE_DIGITS, MOST_STEPS};
use crate::cea::ModeVectors;
use crate::linalg::dense::{add_product, column, dot, product, transpose_product};
use crate::linalg::{ComplexDenseLu, Mat, RealFactors, Scale, c64};
use crate::prestress::{MotionMatrices, SlidingTangent};
use std::ops::Deref;
use std::sync::LazyLock;

/// Modes that are corrected together: each is worked on by three vectors.
const PAIRS_AT_A_TIME: usize = GROUP_WIDTH / 3;

/// Corrects left vectors of modes over the unknowns, by the stiffness without friction, `P`, and the modes without friction, `Z`: the
/// least `P^-1 T(lambda)^T w` over
///
/// ```text
/// w = w_0 + span { t_0, t_1, .. },    t_k = p + Z E^-1 Z^T (r - T(lambda)^T p),    p = P^-1 r,    r = T(lambda)^T w_k
/// E = Z^T T(lambda')^T Z,             lambda' beside lambda
/// ```
///
/// until the energy of what a further correction would be is negligible; scales them to `w^T (2 lambda M + C) x = 1`. Right vectors at
/// several friction coefficients span what is global in a left one; what is missing is near the contact, where the normal force works on
/// its slip, and follows the load as in statics. What that stirs up of the modes, which `P` weighs otherwise than `T`, `E` takes out.
///
/// Source: S. C. Eisenstat, H. C. Elman and M. H. Schultz, SIAM J. Numer. Anal. 20 (1983), the generalized conjugate residual method;
/// R. A. Nicolaides, SIAM J. Numer. Anal. 24 (1987), deflation.
pub fn correct_lefts(
    (tangent, linearization): (&SlidingTangent, Linearization),
    (factors, modes): (&RealFactors, Mat<f64>),
    mu: f64,
    pairs: &mut [ModeVectors],
) {
    let matrices = StructureMatrices::of_side(tangent, linearization, (mu, true));
    let problem = FullProblem::at(tangent, mu);
    // Only where a left vector is open: not those of symmetric matrices, nor those at crossings, which the basis holds.
    let modes = LazyLock::new(|| AmongModes::of(&matrices, modes));
    crate::parallel::map(pairs.chunks_mut(PAIRS_AT_A_TIME), |group| {
        correct_group((&matrices, linearization), (factors, &modes), group);
        for ModeVectors { eigenvalue, right, left, .. } in group {
            let scale = problem.slope(*eigenvalue, left, right);
            left.iter_mut().for_each(|w| *w /= scale);
        }
    })
}

/// A vector: one column of a real one, real and imaginary part of a complex one.
type Packed = Mat<f64>;

/// A left vector, or a correction of one, and what the problem makes of it: `w`, `T(lambda)^T w` and `P^-1 T(lambda)^T w`.
type Mapped = [Packed; 3];

/// The left vector of a mode: real but for a factor, which it loses, where proportional damping leaves the right one real.
fn packed(ModeVectors { right, left, .. }: &ModeVectors, linearization: Linearization) -> Packed {
    let is_reduced = matches!(linearization, Linearization::Reduced(..));
    if is_reduced && right.iter().all(|x| x.im == 0.0) {
        let largest = left.iter().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        let turn = largest.map_or(c64::ONE, |own| own.conj() / own.norm());
        return Mat::from_fn(left.len(), 1, |i, _| (turn * left[i]).re);
    }
    Mat::from_fn(left.len(), 2, |i, j| if j == 0 { left[i].re } else { left[i].im })
}

/// Some of them, with the inverse values of their modes.
fn side_by_side<'v>(
    vectors: impl Iterator<Item = (c64, &'v Packed)>,
) -> (Mat<f64>, Vec<PackedEntry>) {
    let (mut columns, mut entries) = (Vec::new(), Vec::new());
    for (inverse_value, own) in vectors {
        let first = columns.len();
        columns.extend((0..own.ncols()).map(|j| column(own.as_ref(), j)));
        entries.push(PackedEntry { inverse_value, columns: first..columns.len() });
    }
    let rows = columns.first().map_or(0, |own| own.len());
    (Mat::from_fn(rows, columns.len(), |i, j| columns[j][i]), entries)
}

/// `a^* b`.
fn inner(a: &Packed, b: &Packed) -> c64 {
    let part = |i: usize, j: usize| dot(column(a.as_ref(), i), column(b.as_ref(), j));
    match a.ncols() {
        1 => part(0, 0).into(),
        _ => c64::new(part(0, 0) + part(1, 1), part(0, 1) - part(1, 0)),
    }
}

/// About twice the elastic energy of the left vector of a mode: `w^T (2 lambda M + C) x` is 1.
fn left_energy(ModeVectors { eigenvalue, right, left, .. }: &ModeVectors) -> f64 {
    let square: f64 = left.iter().map(|v| v.norm_sqr()).sum();
    let product: c64 = left.iter().zip(right).map(|(w, x)| w * x).sum();
    0.5 * eigenvalue.norm() * square / product.norm()
}

/// The problem among some motions `Z`: `P^T Z` and `Z^T P^T Z` of the matrices of `T(lambda)`.
struct AmongModes {
    modes: Mat<f64>,
    images: MotionMatrices<Mat<f64>>,
    small: MotionMatrices<Mat<f64>>,
}

impl AmongModes {
    fn of(matrices: &StructureMatrices<'_>, modes: Mat<f64>) -> Self {
        let images = matrices.images(modes.as_ref());
        let small = images.map(|image| match image.nrows() {
            0 => Mat::new(),
            _ => transpose_product(modes.as_ref(), image.as_ref()),
        });
        Self { modes, images, small }
    }

    /// Adds to vectors what leaves nothing along `Z` of the residuals `left`, by the factors of `E`, and its image to those of the vectors.
    fn complete(
        &self,
        (entries, factors): (&[PackedEntry], &[&ComplexDenseLu]),
        (left, linearization): (Mat<f64>, Linearization),
        [vectors, images]: [&mut Mat<f64>; 2],
    ) {
        let along = transpose_product(self.modes.as_ref(), left.as_ref());
        let mut shares = Mat::zeros(along.nrows(), along.ncols());
        for (entry, factors) in entries.iter().zip(factors) {
            let own = entry.vector(&along);
            let mut share = Mat::from_fn(along.nrows(), 1, |i, _| own.at(i));
            factors.solve_in_place(share.as_mut());
            for (half, j) in entry.columns.clone().enumerate() {
                let part = |own: &c64| if half == 0 { own.re } else { own.im };
                let target = shares.col_mut(j).iter_mut().zip(share.col(0).iter());
                target.for_each(|(to, own)| *to = part(own));
            }
        }
        add_product(vectors.as_mut(), 1.0, self.modes.as_ref(), shares.as_ref());
        let value = |entry: &PackedEntry| linearization.value(entry.inverse_value);
        let terms: Vec<_> =
            entries.iter().map(|own| linearization.terms(&self.images, value(own))).collect();
        for (place, (_, columns)) in terms[0].iter().enumerate() {
            let sums = product(columns.as_ref(), shares.as_ref());
            for (entry, own) in entries.iter().zip(&terms) {
                add_complex_multiple(images, own[place].0, &sums, &entry.columns);
            }
        }
    }
}

/// Corrects some modes together.
fn correct_group(
    (matrices, linearization): (&StructureMatrices<'_>, Linearization),
    (factors, modes): (&RealFactors, &impl Deref<Target = AmongModes>),
    pairs: &mut [ModeVectors],
) {
    let inverse_values: Vec<c64> =
        pairs.iter().map(|pair| linearization.inverse_value(pair.eigenvalue)).collect();
    let inverse_values = &inverse_values[..];
    // `[w, T(lambda)^T w, P^-1 T(lambda)^T w]` of each.
    let mapped = |entries: &[PackedEntry], vectors: Mat<f64>, images: Mat<f64>| -> Vec<Mapped> {
        let mut solved = images.clone();
        factors.solve(solved.as_mut(), false);
        let all = [vectors, images, solved];
        let own = |entry: &PackedEntry| {
            all.each_ref().map(|own| own.get(.., entry.columns.clone()).to_owned())
        };
        entries.iter().map(own).collect()
    };
    let goals: Vec<f64> = pairs.iter().map(left_energy).collect();
    let starts: Vec<Packed> = pairs.iter().map(|pair| packed(pair, linearization)).collect();
    let (starts, entries) = side_by_side(inverse_values.iter().copied().zip(&starts));
    let (images, _) = matrices.residuals_and_momenta(&entries, starts.as_ref());
    let mut lefts = mapped(&entries, starts, images);
    let energy = |[_, residual, correction]: &Mapped| inner(correction, residual).re.abs();
    let mut directions: Vec<Vec<Mapped>> = vec![Vec::new(); pairs.len()];
    let mut among: Vec<ComplexDenseLu> = Vec::new();
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    for _ in 0..MOST_STEPS {
        open.retain(|&k| energy(&lefts[k]) > HALF_THE_DIGITS * goals[k]);
        if open.is_empty() {
            break;
        }
        if among.is_empty() {
            let beside = |own: &c64| linearization.value(*own) * (1.0 + BESIDE);
            let small = |own| weighted_sum(&linearization.terms(&modes.small, beside(own)));
            among =
                inverse_values.iter().map(|own| ComplexDenseLu::factorize(small(own))).collect();
        }
        // Static corrections, and what these stir up of the modes.
        let [residuals, statics] = [1, 2]
            .map(|part| side_by_side(open.iter().map(|&k| (inverse_values[k], &lefts[k][part]))));
        let (mut vectors, entries) = statics;
        let (mut images, _) = matrices.residuals_and_momenta(&entries, vectors.as_ref());
        let own: Vec<&ComplexDenseLu> = open.iter().map(|&k| &among[k]).collect();
        let left = (residuals.0 - &images, linearization);
        modes.complete((&entries, &own), left, [&mut vectors, &mut images]);
        // The least residual over all directions so far.
        for (&k, mut own) in open.iter().zip(mapped(&entries, vectors, images)) {
            for other in &directions[k] {
                let share = inner(&other[2], &own[2]);
                subtract(&mut own, share, other);
            }
            let length = own[2].norm_l2();
            own.iter_mut().for_each(|part| *part *= Scale(length.recip()));
            let share = inner(&own[2], &lefts[k][2]);
            subtract(&mut lefts[k], share, &own);
            directions[k].push(own);
        }
    }
    for (pair, [left, ..]) in pairs.iter_mut().zip(&lefts) {
        let entry = |i: usize| match left.ncols() {
            1 => left[(i, 0)].into(),
            _ => c64::new(left[(i, 0)], left[(i, 1)]),
        };
        let left: Vec<c64> = (0..pair.left.len()).map(entry).collect();
        if left.iter().all(|v| v.is_finite()) {
            pair.left = left;
        }
    }
}

/// `from -= share other`.
fn subtract(from: &mut Mapped, share: c64, other: &Mapped) {
    for (own, other) in from.iter_mut().zip(other) {
        add_complex_multiple(own, -share, other, &(0..other.ncols()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::{FrictionlessModes, ModePair, mode_pairs, sweep};
    use crate::cea::{ModeLimit, SweepRequest, Unwatched};

    /// Independent check: inverse iteration in the full problem. The factors have their shift amid the modes, so that plain corrections of
    /// those below it grow, and the start, the right vectors, is far off.
    #[test]
    fn corrections_from_right_vectors_lead_to_left_ones_without_factors_for_each() {
        let (tangent, mu) = (string_on_belt(60, 0.4, false), [0.3]);
        let rest = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(12)).unwrap();
        let request = SweepRequest::new(&mu, ModeLimit::Lowest(12));
        let found = sweep(&tangent, &request, &Unwatched).unwrap();
        let values: Vec<c64> = found.points[0].modes.iter().map(|mode| mode.eigenvalue).collect();
        let exact: Vec<ModePair> =
            mode_pairs(&tangent, mu[0], &values).into_iter().flatten().collect();
        assert_eq!(exact.len(), values.len());
        let open = |own: &ModePair| ModeVectors {
            eigenvalue: own.eigenvalue,
            rate: own.derivative,
            right: own.right.clone(),
            left: own.right.clone(),
        };
        let mut pairs: Vec<ModeVectors> = exact.iter().map(open).collect();
        let linearization = Linearization::of(&tangent, 1.0, rest.centre);
        correct_lefts((&tangent, linearization), (&rest.factors, rest.vectors), mu[0], &mut pairs);
        for (own, other) in pairs.iter().zip(&exact) {
            let [w, exact] = [&own.left, &other.left].map(|w| w.as_slice());
            let cosine = dot(w, exact).norm() / (dot(w, w) * dot(exact, exact)).norm().sqrt();
            assert!(1.0 - cosine * cosine < 1e-6, "{}: {}", own.eigenvalue, 1.0 - cosine * cosine);
        }
    }
}
