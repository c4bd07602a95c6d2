//! Left vectors that a basis of right ones does not hold.

use super::full_problem::FullProblem;
use super::packed::{joined, side_by_side};
use super::projected::ProjectedMatrices;
use super::{BESIDE, GROUP_WIDTH, HALF_THE_DIGITS, MOST_STEPS};
use crate::cea::ModeVectors;
use crate::linalg::dense::{product, transpose_product};
use crate::linalg::vectors::{dot, length};
use crate::linalg::{ComplexDenseLu, Mat, RealFactors, c64};
use crate::prestress::{MotionMatrices, SlidingTangent};
use std::ops::Deref;
use std::sync::LazyLock;

/// Modes that are corrected together: each is worked on by three vectors.
const PAIRS_AT_A_TIME: usize = GROUP_WIDTH / 3;

/// About twice the elastic energy of the left vector of a mode: `w^T (2 lambda M + C) x` is 1.
fn left_energy(ModeVectors { eigenvalue, right, left, .. }: &ModeVectors) -> f64 {
    let square: f64 = left.iter().map(|v| v.norm_sqr()).sum();
    let product: c64 = left.iter().zip(right).map(|(w, x)| w * x).sum();
    0.5 * eigenvalue.norm() * square / product.norm()
}

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
    tangent: &SlidingTangent,
    (factors, modes): (&RealFactors, Mat<f64>),
    mu: f64,
    pairs: &mut [ModeVectors],
) {
    let problem = FullProblem::at(tangent, mu);
    // Only where a left vector is open: not those of symmetric matrices, nor those at crossings, which the basis holds.
    let modes = LazyLock::new(|| AmongModes::of(&problem, modes));
    crate::parallel::map(pairs.chunks_mut(PAIRS_AT_A_TIME), |group| {
        correct_group(&problem, (factors, &modes), group);
        for ModeVectors { eigenvalue, right, left, .. } in group {
            let scale = problem.slope(*eigenvalue, left, right);
            left.iter_mut().for_each(|w| *w /= scale);
        }
    })
}

/// The problem among some motions `Z`: `P^T Z` and `Z^T P^T Z` of the matrices of `T(lambda)`.
struct AmongModes {
    modes: Mat<f64>,
    images: MotionMatrices<Mat<f64>>,
    small: ProjectedMatrices,
}

impl AmongModes {
    fn of(problem: &FullProblem<'_>, modes: Mat<f64>) -> Self {
        let images = problem.transposed_images(modes.as_ref());
        let small = images.map(|image| transpose_product(modes.as_ref(), image.as_ref()));
        Self { modes, images, small }
    }

    /// Adds to each vector what leaves nothing along `Z` of its residual `r`, and its image to that of the vector, `[w, T(lambda)^T w]`.
    fn complete(&self, open: &[(c64, &ComplexDenseLu, &[c64])], vectors: &mut [[Vec<c64>; 2]]) {
        let left = open.iter().zip(&*vectors).map(|((_, _, residual), [_, image])| {
            residual.iter().zip(image).map(|(r, own)| r - own).collect::<Vec<c64>>()
        });
        let left = side_by_side(self.modes.nrows(), &left.collect::<Vec<_>>());
        let along = transpose_product(self.modes.as_ref(), left.as_ref());
        let shares = open.iter().enumerate().map(|(k, (_, factors, _))| {
            let own = joined(&along, k);
            let mut shares = Mat::from_fn(own.len(), 1, |i, _| own[i]);
            factors.solve_in_place(shares.as_mut());
            shares.col(0).iter().copied().collect()
        });
        let shares: Vec<Vec<c64>> = shares.collect();
        let mut add = |half: usize, columns: &Mat<f64>, factors: &dyn Fn(usize) -> c64| {
            let scaled = shares
                .iter()
                .enumerate()
                .map(|(k, own)| own.iter().map(|share| factors(k) * share).collect::<Vec<c64>>());
            let scaled = side_by_side(columns.ncols(), &scaled.collect::<Vec<_>>());
            let sums = product(columns.as_ref(), scaled.as_ref());
            for (k, vector) in vectors.iter_mut().enumerate() {
                vector[half].iter_mut().zip(joined(&sums, k)).for_each(|(to, own)| *to += own);
            }
        };
        add(0, &self.modes, &|_| c64::new(1.0, 0.0));
        let terms: Vec<_> = open.iter().map(|(lambda, ..)| self.images.terms(*lambda)).collect();
        for (place, (_, columns)) in terms[0].iter().enumerate() {
            add(1, columns, &|k| terms[k][place].0);
        }
    }
}

/// A left vector, or a correction of one, and what the problem makes of it: `w`, `T(lambda)^T w` and `P^-1 T(lambda)^T w`.
type Mapped = [Vec<c64>; 3];

/// Corrects some modes together.
fn correct_group(
    problem: &FullProblem<'_>,
    (factors, modes): (&RealFactors, &impl Deref<Target = AmongModes>),
    pairs: &mut [ModeVectors],
) {
    let eigenvalues: Vec<c64> = pairs.iter().map(|pair| pair.eigenvalue).collect();
    let images = |of: &[usize], vectors: &[&[c64]]| -> Vec<Vec<c64>> {
        let values: Vec<c64> = of.iter().map(|&k| eigenvalues[k]).collect();
        let w = side_by_side(problem.dimension(), vectors);
        let images = problem.transposed_times(&values, w.as_ref());
        (0..of.len()).map(|k| joined(&images, k)).collect()
    };
    let mapped = |vectors: Vec<[Vec<c64>; 2]>| -> Vec<Mapped> {
        let images: Vec<&[c64]> = vectors.iter().map(|[_, image]| &image[..]).collect();
        let mut solved = side_by_side(problem.dimension(), &images);
        factors.solve(solved.as_mut(), false);
        let all = vectors.into_iter().enumerate();
        all.map(|(k, [vector, image])| [vector, image, joined(&solved, k)]).collect()
    };
    let goals: Vec<f64> = pairs.iter().map(left_energy).collect();
    let mut open: Vec<usize> = (0..pairs.len()).collect();
    let starts: Vec<&[c64]> = pairs.iter().map(|pair| &pair.left[..]).collect();
    let starts = images(&open, &starts).into_iter().zip(starts);
    let mut lefts = mapped(starts.map(|(image, own)| [own.to_vec(), image]).collect());
    let energy = |[_, residual, correction]: &Mapped| dot(correction, residual).re.abs();
    let mut directions: Vec<Vec<Mapped>> = vec![Vec::new(); pairs.len()];
    let mut among: Vec<ComplexDenseLu> = Vec::new();
    for _ in 0..MOST_STEPS {
        open.retain(|&k| energy(&lefts[k]) > HALF_THE_DIGITS * goals[k]);
        if open.is_empty() {
            break;
        }
        if among.is_empty() {
            let beside = eigenvalues.iter().map(|lambda| lambda * (1.0 + BESIDE));
            among = beside.map(|own| ComplexDenseLu::factorize(modes.small.pencil(own))).collect();
        }
        // Static corrections, and what these stir up of the modes.
        let statics: Vec<&[c64]> = open.iter().map(|&k| &lefts[k][2][..]).collect();
        let corrections = images(&open, &statics).into_iter().zip(statics);
        let mut corrections: Vec<[Vec<c64>; 2]> =
            corrections.map(|(image, own)| [own.to_vec(), image]).collect();
        let own = |&k: &usize| (eigenvalues[k], &among[k], &lefts[k][1][..]);
        modes.complete(&open.iter().map(own).collect::<Vec<_>>(), &mut corrections);
        // The least residual over all directions so far.
        for (&k, mut own) in open.iter().zip(mapped(corrections)) {
            for other in &directions[k] {
                let share = dot(&other[2], &own[2]);
                subtract(&mut own, share, other);
            }
            let length = length(&own[2]);
            own.iter_mut().flatten().for_each(|v| *v /= length);
            let share = dot(&own[2], &lefts[k][2]);
            subtract(&mut lefts[k], share, &own);
            directions[k].push(own);
        }
    }
    for (pair, [left, ..]) in pairs.iter_mut().zip(lefts) {
        if left.iter().all(|v| v.is_finite()) {
            pair.left = left;
        }
    }
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
        let problem = FullProblem::at(&tangent, mu[0]);
        let modes = AmongModes::of(&problem, rest.vectors);
        let groups = pairs.chunks_mut(PAIRS_AT_A_TIME);
        groups.for_each(|group| correct_group(&problem, (&rest.factors, &&modes), group));
        for (own, other) in pairs.iter().zip(&exact) {
            let [w, exact] = [&own.left, &other.left].map(|w| w.as_slice());
            let cosine = dot(w, exact).norm() / (length(w) * length(exact));
            assert!(1.0 - cosine * cosine < 1e-6, "{}: {}", own.eigenvalue, 1.0 - cosine * cosine);
        }
    }
}
