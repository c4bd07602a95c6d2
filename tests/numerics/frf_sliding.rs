//! Frequency responses in sliding contact against eigenvalues and eigenvectors: of a dense
//! decomposition, and of the eigenvalue analysis (other equations, other solvers: independent checks).

use crate::prelude::*;

const RADIAL: usize = 5;
/// Scale between displacement and velocity in the state, rad/s: balances the companion matrix.
const OMEGA: f64 = TAU * 1e5;

fn model(damping_model: DampingModel, stiffness: ContactStiffness) -> AnnulusModel {
    let mut model = paper(Quad4, 18, RADIAL);
    model.specification.radial_grading = 1.1;
    model.options.damping_model = damping_model;
    model.options.contact = stiffness;
    model
}

fn at(sector: usize, ring: usize, is_tangential: bool) -> Terminal {
    at_node(sector * (RADIAL + 1) + ring, is_tangential)
}

/// Poles, right vectors, left vectors and defect of the first-order form `z' = A z + b f`, `z = (OMEGA u, u')`.
struct ModalForm {
    poles: Vec<c64>,
    right: Mat<c64>,
    /// Rows are left vectors scaled to `left right = 1`.
    left: Mat<c64>,
    mass: DenseLu,
    /// `|right diag(poles) left - A|`, Frobenius.
    defect: f64,
}

impl ModalForm {
    fn of(tangent: &SlidingTangent, friction_coefficient: f64) -> Self {
        let size = tangent.mass.dimension();
        let dense = |p: &MatrixPolynomial| dense(p, friction_coefficient);
        let mass = DenseLu::factorize(dense(&tangent.mass));
        let (mut stiffness, mut damping) = (dense(&tangent.stiffness), dense(&tangent.damping));
        mass.solve_in_place(stiffness.as_mut());
        mass.solve_in_place(damping.as_mut());
        let companion = Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
            (true, true) => 0.0,
            (true, false) => OMEGA * f64::from(i == j - size),
            (false, true) => -stiffness[(i - size, j)] / OMEGA,
            (false, false) => -damping[(i - size, j - size)],
        });
        let decomposition = companion.eigen().unwrap();
        let right = decomposition.U().to_owned();
        let poles: Vec<c64> = decomposition.S().column_vector().iter().copied().collect();
        let unit = Mat::<c64>::identity(2 * size, 2 * size);
        let left = faer::linalg::solvers::Solve::solve(&right.partial_piv_lu(), &unit);
        let scaled = Mat::from_fn(2 * size, 2 * size, |i, k| right[(i, k)] * poles[k]);
        let again = &scaled * &left;
        let apart = Mat::from_fn(2 * size, 2 * size, |i, j| again[(i, j)] - companion[(i, j)]);
        Self { poles, right, left, mass, defect: apart.norm_l2() }
    }

    /// `sum_k r_k l_k^T b / (i omega - lambda_k)` of the response, and a bound of its error.
    ///
    /// The sum is exact for `A + E`, `|E|` the defect: to first order off by `c R E R b <= |c R| |E| |R b|`, `R = (i omega - A)^{-1}`.
    fn response(&self, frequency_hz: f64, force: usize, response: usize) -> (c64, f64) {
        let size = self.poles.len() / 2;
        let mut input = Mat::<f64>::zeros(size, 1);
        input[(force, 0)] = 1.0;
        self.mass.solve_in_place(input.as_mut());
        let s = c64::new(0.0, TAU * frequency_hz);
        let all = 2 * size;
        let amplitude = Mat::from_fn(all, 1, |k, _| {
            let sum: c64 = (0..size).map(|i| self.left[(k, size + i)] * input[(i, 0)]).sum();
            sum / (s - self.poles[k])
        });
        let state = &self.right * amplitude;
        let seen = Mat::from_fn(1, all, |_, k| self.right[(response, k)] / (s - self.poles[k]));
        let bound = (seen * &self.left).norm_l2() * self.defect * state.norm_l2() / OMEGA;
        (state[(response, 0)] / OMEGA, bound)
    }
}

#[test]
fn responses_in_sliding_contact_are_the_sums_over_right_and_left_eigenvectors() {
    let rigid = ContactStiffness::default();
    let penalty = compliant(7.4e12, [3e5, 2e5]);
    // Unstable modes included: the response is that of the equations, not of a steady state.
    let frequencies: Vec<f64> = (1..=40).map(|k| 431.7 * f64::from(k)).collect();
    for (damping_model, contact) in [(WholeTangent, rigid), (BodyOnly, rigid), (BodyOnly, penalty)]
    {
        let model = model(damping_model, contact);
        let tangent = model.whole();
        let modal = ModalForm::of(&tangent, 0.3);
        let unstable = modal.poles.iter().filter(|p| p.re > 0.0).count();
        assert!(unstable >= 2, "{unstable}");
        let mesh = AnnulusMesh::generate(&model.specification).unwrap().mesh;
        let whole = FrfSystem::sliding(&tangent, 0.3);
        let cyclic = CyclicSystem::sliding(&model.tangent(), 0.3);
        for [force, response] in [
            [at(0, 0, true), at(0, 0, true)],
            [at(3, 0, true), at(11, 2, false)],
            [at(7, 3, false), at(2, 0, true)],
        ] {
            let unknowns = [force, response].map(|own| {
                let component = own.direction.component().unwrap();
                tangent.unknowns.unknown_of[2 * own.node + component].unwrap()
            });
            let [from, to] = [force, response].map(|t| whole.port(&mesh, None, t, "node").unwrap());
            let direct = direct_response(&whole, &from, &to, &frequencies, &|_| {}).unwrap();
            let waves = cyclic_response(&cyclic, force, response, &frequencies).unwrap();
            let top = direct.iter().map(|h| h.norm()).fold(0.0, f64::max);
            for (k, f) in frequencies.iter().enumerate() {
                let (sum, bound) = modal.response(*f, unknowns[0], unknowns[1]);
                // The bound must itself be small, or it would say nothing.
                assert!(bound < 1e-6 * top, "{f} Hz: {bound:e} {top:e}");
                for found in [direct[k], waves.receptance[k]] {
                    // Both other solutions are exact to 1e-9 (their own tests).
                    let tolerance = bound + 1e-9 * found.norm().max(1e-3 * top);
                    let is_sum = (found - sum).norm() < tolerance;
                    assert!(is_sum, "{damping_model:?} {f} Hz: {found} {sum} {tolerance:e}");
                }
            }
        }
    }
}
