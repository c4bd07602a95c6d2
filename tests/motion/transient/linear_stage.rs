//! The linear stage against the complex eigenvalues of the same model.

use crate::prelude::*;
use crate::transient::model::{disc, model, settings};
use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use frictionsim::linalg::MatrixPolynomial;
use frictionsim::prestress::SlidingTangent;

/// The matrix that acts on `U exp(i n theta_j)`, from the rows of one sector.
fn harmonic(
    polynomial: &MatrixPolynomial,
    tangent: &SlidingTangent,
    annulus: &AnnulusMesh,
    n: usize,
) -> Mat<c64> {
    let (per_sector, sectors) = (annulus.sector_node_count(), annulus.sector_count());
    // Unknowns of one sector, numbered by their dof within it.
    let local: Vec<usize> = tangent
        .unknowns
        .dofs
        .iter()
        .copied()
        .filter(|dof| dof / 2 / per_sector == 1)
        .map(|dof| dof - 2 * per_sector)
        .collect();
    let place = |dof: usize| {
        let sector = dof / 2 / per_sector;
        let within = local.binary_search(&(dof - 2 * per_sector * sector)).unwrap();
        (sector, within)
    };
    let values = polynomial.evaluate(0.3);
    let pattern = polynomial.pattern();
    let mut matrix = Mat::<c64>::zeros(local.len(), local.len());
    for column in 0..pattern.dimension() {
        let range = pattern.column_pointers()[column]..pattern.column_pointers()[column + 1];
        let (column_sector, j) = place(tangent.unknowns.dofs[column]);
        for k in range {
            let (row_sector, i) = place(tangent.unknowns.dofs[pattern.row_indices()[k]]);
            if row_sector == 1 {
                let angle = TAU * n as f64 * (column_sector as f64 - 1.0) / sectors as f64;
                matrix[(i, j)] += values[k] * c64::new(angle.cos(), angle.sin());
            }
        }
    }
    matrix
}

/// Eigenvalue with the largest real part for harmonic `n`, rigid contact, lumped mass, no geometric stiffness.
fn least_stable(model: &TransientModel<'_>, n: usize) -> c64 {
    let SteppedBody::Plane { mesh, annulus: Some(annulus) } = model.body else {
        panic!("an annulus");
    };
    let options = TangentOptions { mass: MassKind::Lumped, damping: model.damping, ..TANGENT };
    let tangent = linearized(mesh, model.material, &model.contact, &options);
    let mass = harmonic(&tangent.mass, &tangent, annulus, n);
    let stiffness = harmonic(&tangent.stiffness, &tangent, annulus, n);
    let reduced = mass.partial_piv_lu().solve(&stiffness);
    let (alpha, beta) = (model.damping.mass_coefficient, model.damping.stiffness_coefficient);
    let roots = reduced.eigenvalues().unwrap().into_iter().flat_map(|kappa| {
        // lambda^2 + (alpha + beta kappa) lambda + kappa = 0
        let half = (kappa * beta + alpha) * 0.5;
        let root = (half * half - kappa).sqrt();
        [root - half, -root - half]
    });
    roots.max_by(|a, b| a.re.total_cmp(&b.re)).unwrap()
}

/// Cross-method: the strongest check that the two halves of the program agree.
#[test]
fn seeded_harmonics_grow_as_the_complex_eigenvalues_predict() {
    let annulus = disc(60, 12);
    let model = model(&annulus, 610.0);
    for n in [1, 2, 3] {
        let mut settings = settings(0.012, &[n]);
        settings.initial = InitialState::SteadySliding;
        // Small enough to stay linear over the whole run.
        settings.perturbation = Perturbation::of(&[n], 1e-8);
        let (record, _) = recorded(model, OperatorChoice::Auto, &settings);
        let analysis = TransientAnalysis::of(&record, &[n]);
        assert_eq!(analysis.first_nonlinearity, None);
        grows_as(&record, n, least_stable(&model, n), 1e-3);
        // The unstable member of a pair travels against the rotor.
        assert_eq!(analysis.growth[0].direction(), -1);
    }
}
