//! The modes of the projected problem by dense decompositions, of a wide one by an iteration for the leading ones.

use crate::cea::sparse::*;
use crate::linalg::dense::product;
use crate::linalg::dense_eigen::{
    RealEigen, complex_column, complex_eigen, real_eigen, real_eigenvalues,
};
use crate::linalg::{KrylovSchurSettings, RealPairs, krylov_schur};

/// Damping factor, of decay or of growth, from which on a motion may as well be one of those that do not oscillate.
const HARDLY_OSCILLATING: f64 = 0.95;

/// A matrix that is applied to blocks of vectors.
struct DenseOperator<'a>(MatRef<'a, f64>);

impl BlockOperator for DenseOperator<'_> {
    fn dimension(&self) -> usize {
        self.0.ncols()
    }

    fn apply(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        product(self.0, x)
    }
}

impl ReducedModel {
    /// The modes of projected matrices, without derivatives and scale.
    pub(super) fn solve_projected(
        &self,
        at: &ProjectedMatrices,
        count: usize,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        if let Some(gain) = at.losses.iter().find_map(|(gain, _)| gain.0.as_ref()) {
            let start_hz = gain.reference_hz;
            let frozen = |frequency_hz: f64| {
                let at = at.frozen(frequency_hz);
                Ok(self.part_clusters(&at, self.solve_lossy(&at, count)?))
            };
            return own_frequency::solve(at, &frozen, start_hz); // Each at its own frequency.
        }
        if !at.losses.is_empty() {
            return Ok(self.part_clusters(at, self.solve_lossy(at, count)?)); // i H alone.
        }
        Ok(self.part_clusters(at, self.solve_viscous(at, count)?))
    }

    /// [`Self::solve_projected`] without structural damping.
    fn solve_viscous(
        &self,
        at: &ProjectedMatrices,
        count: usize,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let centred = self.centred(at);
        let at = centred.as_ref().unwrap_or(at);
        let lu = DenseLu::factorize(at.stiffness.clone());
        let leading = match self.linearization {
            Linearization::Reduced(..) => count,
            Linearization::Companion { .. } => 2 * count, // A pair has two values, and two real vectors.
        };
        let operator = self.shift_inverted(at, &lu);
        let is_wide = operator.ncols() > WIDEST.max(4 * leading);
        let found = is_wide.then(|| self.leading_pairs(&operator, leading));
        let all = || real_eigen(operator.as_ref(), true, leading);
        let eigen = found.transpose()?.flatten().map_or_else(all, Ok)?;
        // The upper half of a left vector of the operator is K^T times that of the problem.
        let m = at.stiffness.nrows();
        let mut left = eigen.left.expect("left vectors are asked for");
        lu.solve_transpose_in_place(left.as_mut().split_at_row_mut(m).0);

        let upper = |vectors: &Mat<f64>, i: usize| {
            complex_column(&eigen.values, vectors.as_ref().get(..m, ..), i)
        };
        // w = conj y, as w^T T stands for y^H T.
        let left = |i: usize| upper(&left, i).into_iter().map(|own| own.conj()).collect();
        let vectors = |i: usize| [upper(&eigen.right, i), left(i)];
        Ok(self.leading(self.oscillating(&eigen.values, vectors), m, count, |_| true))
    }

    /// The oscillating modes of eigenvalues `s` of the operator, with right and left vectors, by falling `|s|`.
    fn oscillating(
        &self,
        values: &[c64],
        vectors: impl Fn(usize) -> [Vec<c64>; 2],
    ) -> impl Iterator<Item = ReducedMode> {
        let mut order: Vec<usize> = (0..values.len()).collect();
        crate::order::sort_by_number(&mut order, |&i| -values[i].norm()); // Largest |s| first: nearest to the centre.
        order.into_iter().filter_map(move |i| {
            let eigenvalue = self.linearization.eigenvalue(values[i])?;
            let [right, left] = vectors(i);
            Some(ReducedMode { eigenvalue, derivative: c64::ZERO, right, left })
        })
    }

    /// The first of modes by falling `|s|`, until `count` of them do that `is_counted` holds for. Where all `m` motions
    /// of the body are held, so are those that damping takes beyond them, though they oscillate more slowly.
    fn leading(
        &self,
        all: impl Iterator<Item = ReducedMode>,
        m: usize,
        count: usize,
        is_counted: impl Fn(&ReducedMode) -> bool,
    ) -> Vec<ReducedMode> {
        let (is_whole, mut counted, mut top) = (m == self.basis.columns().nrows(), 0, 0.0);
        let mut modes = Vec::new();
        for mode in all {
            if counted < count {
                counted += usize::from(is_counted(&mode));
                top = mode.eigenvalue.im.max(top);
                modes.push(mode);
            } else if !is_whole {
                break;
            } else if mode.eigenvalue.im < top && !mode.is_nearly_critical() {
                modes.push(mode);
            }
        }
        modes
    }

    /// The leading pairs of a wide operator by an iteration, which costs far less than all of them; nothing where it leaves one short.
    fn leading_pairs(
        &self,
        operator: &Mat<f64>,
        wanted: usize,
    ) -> Result<Option<RealEigen>, LinalgError> {
        let is_companion = matches!(self.linearization, Linearization::Companion { .. });
        let is_wanted = |s: c64| !is_companion || self.linearization.eigenvalue(s.conj()).is_some();
        let settings = KrylovSchurSettings {
            wanted,
            tie: 1.0,
            tolerance: ROUND_OFF,
            max_applications: 10 * (wanted + 20),
            dense_up_to: 0,
        };
        let side = |matrix: MatRef<'_, f64>| {
            let start = random_columns(matrix.ncols(), SEARCH_WIDTH, 3);
            krylov_schur(&DenseOperator(matrix), start, &is_wanted, &settings)
        };
        let right = side(operator.as_ref())?;
        let is_converged = |own: &RealPairs| own.residuals.iter().all(|r| *r <= CONVERGED);
        if !is_converged(&right) {
            return Ok(None);
        }
        // Those of the transpose, `S^T z = lambda z`, each with the eigenvalue that is its own.
        let other = side(operator.transpose())?;
        let mut columns = Mat::zeros(operator.ncols(), right.values.len());
        let mut is_free = vec![is_converged(&other); other.values.len()];
        for (i, value) in right.values.iter().enumerate().filter(|own| own.1.im >= 0.0) {
            let away = |j: &usize| (other.values[*j] - value).norm();
            let free = (0..is_free.len()).filter(|&j| is_free[j] && other.values[j].im >= 0.0);
            let nearest = free.min_by(|a, b| away(a).total_cmp(&away(b)));
            let same = nearest.filter(|j| away(j) <= SAME_EIGENVALUE * value.norm());
            let Some(j) = same.filter(|&j| (other.values[j].im > 0.0) == (value.im > 0.0)) else {
                return Ok(None);
            };
            is_free[j] = false;
            let signs = if value.im > 0.0 { &[1.0, -1.0][..] } else { &[1.0] }; // y = conj z.
            for (half, sign) in signs.iter().enumerate() {
                let own = column(other.vectors.as_ref(), j + half).iter();
                let target = column_mut(&mut columns, i + half).iter_mut();
                target.zip(own).for_each(|(y, z)| *y = sign * z);
            }
        }
        Ok(Some(RealEigen { values: right.values, right: right.vectors, left: Some(columns) }))
    }

    /// [`Self::solve_projected`] with structural damping `H`: the eigenvalues `1 / nu` of the complex operator
    ///
    /// ```text
    /// [ -omega (K + i H)^-1 C   -omega^2 (K + i H)^-1 M ]
    /// [  I                       0                      ],    lambda = omega nu, Im nu > 0;
    /// ```
    ///
    /// those with `Im nu < 0` are no motions: at negative frequencies the force is `-i H`.
    ///
    /// With `H` motions beyond critical damping have an imaginary part too: they are left out, and those near it do not count.
    fn solve_lossy(
        &self,
        at: &ProjectedMatrices,
        count: usize,
    ) -> Result<Vec<ReducedMode>, LinalgError> {
        let centred = self.centred(at);
        let at = centred.as_ref().unwrap_or(at);
        let (Linearization::Companion { frequency_scale: omega, .. }, [(_, structural)]) =
            (self.linearization, &at.losses[..])
        else {
            return Ok(Vec::new());
        };
        let (lu, operator) = lossy_operator(at, structural, omega);
        let m = at.stiffness.nrows();
        let (values, [right, left]) = complex_eigen(operator.as_ref())?;
        // The upper half of a left vector y^H of the operator is (K + i H)^T times that of the problem.
        let mut upper = Mat::from_fn(m, left.ncols(), |i, j| left[(i, j)].conj());
        lu.solve_transpose_in_place(upper.as_mut());
        let part = |vectors: &Mat<c64>, i: usize| column(vectors.as_ref(), i)[..m].to_vec();
        let oscillating = self.oscillating(&values, |i| [part(&right, i), part(&upper, i)]);
        let oscillating =
            oscillating.filter(|mode| !(mode.damping_factor().abs() > HARDLY_OSCILLATING));
        Ok(self.leading(oscillating, m, count, |mode| !mode.is_nearly_critical()))
    }

    /// The matrices about the centre of the linearisation, where it is not zero: `K + c C + c^2 M`, or `K + c^2 M`, and `C + 2 c M`.
    fn centred(&self, at: &ProjectedMatrices) -> Option<ProjectedMatrices> {
        let shift = self.linearization.centre().shift;
        if shift == 0.0 {
            return None;
        }
        let inert = &at.stiffness + Scale(shift * shift) * &at.mass;
        let (stiffness, damping) = match self.linearization {
            Linearization::Reduced(..) => (inert, at.damping.clone()),
            Linearization::Companion { .. } => {
                (inert + Scale(shift) * &at.damping, &at.damping + Scale(2.0 * shift) * &at.mass)
            }
        };
        let losses = at.losses.clone();
        Some(ProjectedMatrices { stiffness, damping, mass: at.mass.clone(), losses })
    }

    /// How many motions grow without oscillating at `mu`: positive real eigenvalues.
    pub fn static_growth(&self, mu: f64) -> Result<usize, LinalgError> {
        let at = self.at(mu);
        let centred = self.centred(&at);
        let at = centred.as_ref().unwrap_or(&at);
        let operator = self.shift_inverted(at, &DenseLu::factorize(at.stiffness.clone()));
        let values = real_eigenvalues(operator.as_ref())?.into_iter();
        let values = values.filter(|s| s.im == 0.0).map(|s| self.linearization.value(s).re);
        let least = self.linearization.least_growth();
        let grows = |value: &f64| match self.linearization {
            Linearization::Reduced(..) => -value > least * least, // lambda^2 = -kappa.
            Linearization::Companion { .. } => *value > least,
        };
        Ok(values.filter(grows).count())
    }

    /// The dense shift-inverted operator of the linearisation.
    fn shift_inverted(&self, at: &ProjectedMatrices, lu: &DenseLu) -> Mat<f64> {
        let mut inertia = at.mass.clone();
        lu.solve_in_place(inertia.as_mut());
        match self.linearization {
            Linearization::Reduced(..) => inertia, // K^-1 M.
            Linearization::Companion { frequency_scale: omega, .. } => {
                let m = at.stiffness.nrows();
                let mut damped = at.damping.clone();
                lu.solve_in_place(damped.as_mut());
                Mat::from_fn(2 * m, 2 * m, |i, j| match (i < m, j < m) {
                    (true, true) => -omega * damped[(i, j)],
                    (true, false) => -omega * omega * inertia[(i, j - m)],
                    (false, _) => f64::from(i - m == j),
                })
            }
        }
    }
}

/// The factors of `K + i H`, and the operator of [`ReducedModel::solve_lossy`] that they make.
fn lossy_operator(
    at: &ProjectedMatrices,
    structural: &Mat<f64>,
    omega: f64,
) -> (ComplexDenseLu, Mat<c64>) {
    let m = at.stiffness.nrows();
    let complex =
        |p: &Mat<f64>, factor: f64| Mat::from_fn(m, m, |i, j| c64::new(factor * p[(i, j)], 0.0));
    let lu = ComplexDenseLu::factorize(Mat::from_fn(m, m, |i, j| {
        c64::new(at.stiffness[(i, j)], structural[(i, j)]) // K + i H.
    }));
    let (mut damped, mut inert) = (complex(&at.damping, -omega), complex(&at.mass, -omega * omega));
    lu.solve_in_place(damped.as_mut());
    lu.solve_in_place(inert.as_mut());
    let operator = Mat::from_fn(2 * m, 2 * m, |i, j| match (i < m, j < m) {
        (true, true) => damped[(i, j)],
        (true, false) => inert[(i, j - m)],
        (false, _) => c64::new(f64::from(u8::from(i - m == j)), 0.0),
    });
    (lu, operator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cea::ModeLimit;
    use crate::cea::sparse::FrictionlessModes;
    use crate::cea::sparse::fixtures::string_on_belt;

    /// Consistency check: the leading pairs of a wide operator, by an iteration, are those of all, and solve the problem on both sides.
    #[test]
    fn leading_pairs_of_a_wide_operator_are_those_of_all() {
        for is_proportional in [false, true] {
            let count = if is_proportional { WIDEST + 10 } else { WIDEST / 2 + 10 };
            let tangent = string_on_belt(count, 0.4, is_proportional);
            let rest = FrictionlessModes::compute(&tangent, ModeLimit::Lowest(40)).unwrap();
            let linearization = Linearization::of(&tangent, rest.frequencies[39], rest.centre);
            let mut model = ReducedModel::empty(&tangent, linearization);
            model.extend(Mat::identity(count, count), ROUND_OFF);
            let at = model.at(0.3);
            let found = model.solve_projected(&at, 40).unwrap();

            let centred = model.centred(&at);
            let held = centred.as_ref().unwrap_or(&at);
            let operator = model.shift_inverted(held, &DenseLu::factorize(held.stiffness.clone()));
            let wanted = if is_proportional { 40 } else { 80 };
            assert!(model.leading_pairs(&operator, wanted).unwrap().is_some());
            let all = real_eigenvalues(operator.as_ref()).unwrap();
            let mut all: Vec<c64> =
                all.into_iter().filter_map(|s| linearization.eigenvalue(s)).collect();
            crate::order::sort_by_number(&mut all, |own| own.im);
            assert_eq!(found.len(), 40);
            for (mode, exact) in found.iter().zip(&all) {
                let away = (mode.eigenvalue - exact).norm() / exact.norm();
                let t = at.pencil(mode.eigenvalue);
                let sides = [(&mode.right, t.as_ref()), (&mode.left, t.transpose())];
                let residuals = sides.map(|(own, t)| {
                    let own = Mat::from_fn(count, 1, |i, _| own[i]);
                    (t * &own).norm_l2() / own.norm_l2()
                });
                assert!(away < 1e-9, "{away:e}");
                assert!(residuals.iter().all(|own| *own < 1e-9), "{residuals:?}");
            }
        }
    }
}
