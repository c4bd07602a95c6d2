//! Left vectors that a basis of right ones does not hold.

use super::packed::add_complex_multiple;
use super::projected::weighted_sum;
use crate::cea::sparse::*;
use crate::linalg::dense::{add_product, product};
use crate::linalg::vectors::dot;
use std::ops::Deref;
use std::sync::LazyLock;

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
    (factors, modes): (&SparseLu, Mat<f64>),
    mu: f64,
    pairs: &mut [ModeVectors],
) {
    let matrices = StructureMatrices::of_side(tangent, linearization, (mu, true));
    let problem = FullProblem::at(tangent, mu);
    // Only where a left vector is open: not those of symmetric matrices, nor those at crossings, which the basis holds.
    let modes = LazyLock::new(|| AmongModes::of(&matrices, modes));
    crate::parallel::map(pairs.chunks_mut(GROUP_WIDTH / 3), |group| {
        // Each is worked on by three vectors.
        correct_group((&matrices, linearization), (factors, &modes), group);
        for ModeVectors { eigenvalue, right, left, .. } in group {
            let scale = problem.slope(*eigenvalue, left, right);
            left.iter_mut().for_each(|w| *w /= scale);
        }
    })
}

/// A left vector, or a correction of one, and what the problem makes of it: `w`, `T(lambda)^T w` and `P^-1 T(lambda)^T w`.
type Mapped = [Vec<c64>; 3];

/// Inverse value and left vector of a mode: real where proportional damping leaves the right vector real, but for a factor of the left one
/// that it loses.
fn start_of(
    ModeVectors { eigenvalue, right, left, .. }: &ModeVectors,
    linearization: Linearization,
) -> (c64, Vec<c64>) {
    let value = linearization.inverse_value(*eigenvalue);
    let is_reduced = matches!(linearization, Linearization::Reduced(..));
    if !is_reduced || right.iter().any(|x| x.im != 0.0) {
        return (value, left.clone());
    }
    let largest = left.iter().max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
    let turn = largest.map_or(c64::ONE, |own| own.conj() / own.norm()); // The phase that makes its largest entry real.
    (value.re.into(), left.iter().map(|own| (turn * own).re.into()).collect())
}

/// About twice the elastic energy of the left vector of a mode: `w^T (2 lambda M + C) x` is 1.
fn left_energy(ModeVectors { eigenvalue, right, left, .. }: &ModeVectors) -> f64 {
    let square: f64 = left.iter().map(|v| v.norm_sqr()).sum();
    let product: c64 = left.iter().zip(right).map(|(w, x)| w * x).sum();
    0.5 * eigenvalue.norm() * square / product.norm() // |lambda|^2 w^H M w with w^T M x = 1 / (2 lambda).
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
        let small = images.map(|image| transpose_product(modes.as_ref(), image.as_ref())); // Z^T P^T Z.
        Self { modes, images, small }
    }

    /// Adds to vectors what leaves nothing along `Z` of the residuals `left`, by the factors of `E`, and its image to those of the vectors.
    fn complete(
        &self,
        (entries, factors): (&[PackedEntry], &[&ComplexDenseLu]),
        (left, linearization): (Mat<f64>, Linearization),
        [vectors, images]: [&mut Mat<f64>; 2],
    ) {
        let along = transpose_product(self.modes.as_ref(), left.as_ref()); // Z^T r.
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
        add_product(vectors.as_mut(), 1.0, self.modes.as_ref(), shares.as_ref()); // + Z E^-1 Z^T r.
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
    (factors, modes): (&SparseLu, &impl Deref<Target = AmongModes>),
    pairs: &mut [ModeVectors],
) {
    let (inverse_values, starts): (Vec<c64>, Vec<Vec<c64>>) =
        pairs.iter().map(|pair| start_of(pair, linearization)).unzip();
    let together = |own: Vec<(usize, &Vec<c64>)>| {
        let vectors = own.into_iter().map(|(k, vector)| (inverse_values[k], vector));
        PackedModes::of_vectors(matrices.dimension(), vectors)
    };
    // `[w, T(lambda)^T w, P^-1 T(lambda)^T w]` of each.
    let mapped = |entries: &[PackedEntry], vectors: Mat<f64>, images: Mat<f64>| -> Vec<Mapped> {
        let mut solved = images.clone();
        factors.solve_in_place(solved.as_mut());
        let all = [vectors, images, solved];
        entries.iter().map(|entry| all.each_ref().map(|own| entry.joined(own))).collect()
    };
    let goals: Vec<f64> = pairs.iter().map(left_energy).collect(); // Beside them corrections are negligible.
    let PackedModes { coordinates, entries } = together(starts.iter().enumerate().collect());
    let (images, _) = matrices.residuals_and_momenta(&entries, coordinates.as_ref()); // T(lambda)^T w_0.
    let mut lefts = mapped(&entries, coordinates, images);
    let energy = |[_, residual, correction]: &Mapped| dot(correction, residual).re.abs();
    let mut directions: Vec<Vec<Mapped>> = vec![Vec::new(); pairs.len()];
    let mut among: Vec<ComplexDenseLu> = Vec::new();
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    for _ in 0..MOST_STEPS {
        open.retain(|&k| energy(&lefts[k]) > BESIDE * BESIDE * goals[k]); // Three digits of the vector.
        if open.is_empty() {
            break;
        }
        if among.is_empty() {
            let beside = |own: &c64| linearization.value(*own) * (1.0 + BESIDE); // On it E would be singular.
            let small = |own| weighted_sum(&linearization.terms(&modes.small, beside(own)));
            among =
                inverse_values.iter().map(|own| ComplexDenseLu::factorize(small(own))).collect();
        }
        // Static corrections, and what these stir up of the modes.
        let [left, statics] =
            [1, 2].map(|part| together(open.iter().map(|&k| (k, &lefts[k][part])).collect()));
        let PackedModes { coordinates: mut vectors, entries } = statics;
        let (mut images, _) = matrices.residuals_and_momenta(&entries, vectors.as_ref());
        let own: Vec<&ComplexDenseLu> = open.iter().map(|&k| &among[k]).collect();
        let left = (left.coordinates - &images, linearization);
        modes.complete((&entries, &own), left, [&mut vectors, &mut images]);
        // The least residual over all directions so far.
        for (&k, own) in open.iter().zip(mapped(&entries, vectors, images)) {
            descend(&mut lefts[k], &mut directions[k], own);
        }
    }
    for (pair, [left, ..]) in pairs.iter_mut().zip(lefts) {
        if left.iter().all(|v| v.is_finite()) {
            pair.left = left;
        }
    }
}

/// Takes out of a left vector what it has along one more direction, in the measure of the residual, beside those before.
fn descend(left: &mut Mapped, directions: &mut Vec<Mapped>, mut own: Mapped) {
    for other in directions.iter() {
        let share = dot(&other[2], &own[2]);
        subtract(&mut own, share, other);
    }
    let length = length(&own[2]);
    own.iter_mut().flatten().for_each(|v| *v /= length); // |P^-1 T^T t| is 1.
    let share = dot(&own[2], &left[2]); // Least |P^-1 T^T (w - share t)|.
    subtract(left, share, &own);
    directions.push(own);
}

/// `from -= share other`.
fn subtract(from: &mut Mapped, share: c64, other: &Mapped) {
    for (own, other) in from.iter_mut().zip(other) {
        own.iter_mut().zip(other).for_each(|(v, o)| *v -= share * o);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::fixtures::string_on_belt;
    use crate::cea::sparse::{FrictionlessModes, ModePair, mode_pairs, sweep};
    use crate::cea::{ModeLimit, SweepRequest, Unwatched};

    /// Independent check: inverse iteration in the full problem. The factors have their shift amid the modes, so that plain corrections of
    /// those below it grow, and the start, the right vectors, is far off. With proportional damping modes without coupling are real.
    #[test]
    fn corrections_from_right_vectors_lead_to_left_ones_without_factors_for_each() {
        for is_proportional in [false, true] {
            let (tangent, mu) = (string_on_belt(60, 0.4, is_proportional), [0.3]);
            let rest = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(12)).unwrap();
            let request = SweepRequest::new(&mu, ModeLimit::Lowest(12));
            let found = sweep(&tangent, &request, &Unwatched).unwrap();
            let modes = &found.points[0].modes;
            let values: Vec<c64> = modes.iter().map(|mode| mode.eigenvalue).collect();
            let exact: Vec<ModePair> =
                mode_pairs(&tangent, mu[0], &values).into_iter().flatten().collect();
            assert_eq!(exact.len(), values.len());
            let open = |own: &ModePair| {
                let largest = own.right.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()));
                let turn = largest.unwrap().conj() / largest.unwrap().norm();
                let mut right: Vec<c64> = own.right.iter().map(|x| turn * x).collect();
                if is_proportional && right.iter().all(|x| x.im.abs() < 1e-9) {
                    right.iter_mut().for_each(|x| x.im = 0.0);
                }
                let (eigenvalue, rate, left) = (own.eigenvalue, own.derivative, right.clone());
                ModeVectors { eigenvalue, rate, right, left }
            };
            let mut pairs: Vec<ModeVectors> = exact.iter().map(open).collect();
            let is_real = |own: &ModeVectors| own.right.iter().all(|x| x.im == 0.0);
            assert_eq!(pairs.iter().any(is_real), is_proportional);
            let problem = (&tangent, Linearization::of(&tangent, 1.0, rest.centre));
            correct_lefts(problem, (&rest.factors, rest.vectors), mu[0], &mut pairs);
            let full = FullProblem::at(&tangent, mu[0]);
            for (own, other) in pairs.iter().zip(&exact) {
                let [w, exact] = [&own.left, &other.left].map(|w| w.as_slice());
                let cosine = dot(w, exact).norm() / (length(w) * length(exact));
                let away = 1.0 - cosine * cosine;
                assert!(away < 1e-6, "{is_proportional} {}: {away}", own.eigenvalue);
                let slope = full.slope(own.eigenvalue, w, &own.right);
                assert!((slope - 1.0).norm() < 1e-12, "{slope}");
            }
        }
    }
}
