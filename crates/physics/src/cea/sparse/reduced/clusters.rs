//! Equal eigenvalues of the projected problem, which a decomposition of its operator parts by rounding and leaves without vectors.

use crate::cea::sparse::packed::side_by_side;
use crate::cea::sparse::projected::weighted_sum;
use crate::cea::sparse::*;
use crate::linalg::dense::product;
use crate::linalg::dense_eigen::complex_eigen;

impl ReducedModel {
    /// Computes eigenvalues anew that lie together, where one of them is not one of the matrices `at` a friction coefficient, or has no
    /// vector of its own; all by rising frequency: strong dashpots make the operator so large that its rounding is more than the accuracy of slow modes.
    pub(super) fn part_clusters(
        &self,
        at: &ProjectedMatrices,
        mut modes: Vec<ReducedMode>,
    ) -> Vec<ReducedMode> {
        let m = at.mass.nrows();
        let parts = side_by_side(m, &modes.iter().map(|own| &own.right).collect::<Vec<_>>());
        let images = at.map(|own| (own.norm_l2(), product(own.as_ref(), parts.as_ref())));
        let is_vague = |j: usize| {
            let terms = images.terms(modes[j].eigenvalue);
            let size: f64 = terms.iter().map(|(factor, (norm, _))| factor.norm() * norm).sum();
            let residual = (0..m).map(|i| -> c64 {
                let at = |own: &Mat<f64>| c64::new(own[(i, 2 * j)], own[(i, 2 * j + 1)]);
                terms.iter().map(|(factor, (_, image))| factor * at(image)).sum() // T(lambda) x.
            });
            let residual = residual.map(|own| own.norm_sqr()).sum::<f64>().sqrt();
            !(residual <= CONVERGED * size * length(&modes[j].right))
        };
        let is_one_of = |i: usize| modes[i].is_among(modes[..i].iter());
        let mut is_done: Vec<bool> =
            (0..modes.len()).map(|i| !is_vague(i) && !is_one_of(i)).collect();
        while let Some(i) = is_done.iter().position(|own| !own) {
            is_done[i] = true;
            let value = modes[i].eigenvalue;
            let is_within = |own: c64, reach: f64| (own - value).norm() <= reach * value.norm();
            let own: Vec<usize> = (0..modes.len())
                .filter(|&j| is_within(modes[j].eigenvalue, SAME_EIGENVALUE))
                .collect();
            let Ok((values, vectors)) = cluster(at, value, own.len()) else { continue };
            for (k, &j) in own.iter().enumerate() {
                is_done[j] = true;
                if is_within(values[k], BESIDE) {
                    let mode = &mut modes[j];
                    mode.eigenvalue = values[k];
                    [mode.right, mode.left] =
                        vectors.each_ref().map(|own| own.col(k).iter().copied().collect());
                }
            }
        }
        // In the order of frequencies, which those of a cluster may have changed.
        crate::order::sort_by_number(&mut modes, |own| own.eigenvalue.im);
        modes
    }
}

/// `count` eigenvalues about `value` with right and left vectors, by inverse iteration with a block on either side,
///
/// ```text
/// X <- T(sigma)^-1 T' X,   W <- T(sigma)^-T T'^T W,   T' = 2 lambda M + C,
/// ```
///
/// and the small problem `(W^T T(lambda) X + delta W^T T' X) c = 0`, whose `delta` is as small as the cluster.
fn cluster(
    at: &ProjectedMatrices,
    value: c64,
    count: usize,
) -> Result<(Vec<c64>, [Mat<c64>; 2]), LinalgError> {
    let m = at.mass.nrows();
    let lu = ComplexDenseLu::factorize(at.pencil(value * (1.0 + MULTIPLE)));
    let slope = weighted_sum(&[(2.0 * value, &at.mass), (c64::new(1.0, 0.0), &at.damping)]);
    let start = random_columns(m, count, 5);
    let start = Mat::from_fn(m, count, |i, j| c64::new(start[(i, j)], 0.0));
    let (mut right, mut left) = (start.clone(), start);
    for _ in 0..3 {
        // Each gains six digits or so: the distance of the cluster from others over that of the shift from it.
        (right, left) = (&slope * &right, slope.transpose() * &left);
        lu.solve_in_place(right.as_mut());
        lu.solve_transpose_in_place(left.as_mut());
        (right, left) = (right.qr().compute_thin_Q(), left.qr().compute_thin_Q());
    }
    let [held, moved] = [&at.pencil(value), &slope].map(|own| left.transpose() * (own * &right));
    // With B = (W^T T' X)^-1 W^T T X: B c = -delta c, and d = (W^T T' X)^-T conj(y) of y^H B = -delta y^H.
    let (mut small, moved) = (held, ComplexDenseLu::factorize(moved));
    moved.solve_in_place(small.as_mut());
    let (values, [inner, outer]) = complex_eigen(small.as_ref())?;
    let mut outer = outer.conjugate().to_owned();
    moved.solve_transpose_in_place(outer.as_mut());
    let values = values.into_iter().map(|own| value - own).collect();
    Ok((values, [right * inner, left * outer]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::sparse::FrictionlessModes;
    use crate::cea::sparse::fixtures::string_on_belt;

    /// Exact: of two equal modes given as one vector, with values that rounding has moved, each has its value and a vector of its own.
    #[test]
    fn equal_modes_have_vectors_of_their_own() {
        let tangent = string_on_belt(8, 0.4, false);
        let rest = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(2)).unwrap();
        let linearization = Linearization::of(&tangent, rest.frequencies[1], rest.centre);
        let model = ReducedModel::empty(&tangent, linearization);
        let diagonal = |of: [f64; 3]| Mat::from_fn(3, 3, |i, j| if i == j { of[i] } else { 0.0 });
        let at = ProjectedMatrices {
            stiffness: diagonal([1.0, 1.0, 9.0]),
            damping: diagonal([0.02, 0.02, 1e3]),
            mass: diagonal([1.0; 3]),
            losses: Vec::new(),
        };
        let exact = c64::new(-0.01, (1.0_f64 - 1e-4).sqrt());
        let given = |shift: f64| ReducedMode {
            eigenvalue: exact + shift,
            derivative: c64::ZERO,
            right: vec![c64::ONE, c64::I, c64::ZERO],
            left: vec![c64::ONE, c64::I, c64::ZERO],
        };
        let found = model.part_clusters(&at, vec![given(1e-8), given(-3e-7)]);
        for mode in &found {
            assert!((mode.eigenvalue - exact).norm() < 1e-14, "{}", mode.eigenvalue);
            assert!(mode.right[2].norm() < 1e-12 && mode.left[2].norm() < 1e-12);
        }
        assert!(!found[1].is_among(found[..1].iter()));
    }
}
