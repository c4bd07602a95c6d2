//! The two operators against the assembled matrix, each other and the scalar kernels.

use super::*;
use frictionsim::fem::operator::*;

const LEVELS: [SimdLevel; 3] = [SimdLevel::Scalar, SimdLevel::Avx2, SimdLevel::Avx512];

fn graded(circumferential_elements: usize, radial_elements: usize) -> AnnulusMesh {
    let even = disc(circumferential_elements, radial_elements).specification;
    AnnulusMesh::generate(&AnnulusSpecification { radial_grading: 1.15, ..even }).unwrap()
}

/// Cross-method: whatever the mesh's remainder modulo the vector width, both operators are `M^-1 K`.
#[test]
fn both_operators_equal_the_assembled_matrix_on_any_mesh() {
    for (around, across) in [(3, 1), (4, 2), (7, 3), (16, 5), (30, 4), (45, 3)] {
        let annulus = graded(around, across);
        let material = POLYCARBONATE;
        let stiffness = assemble_stiffness(&annulus.mesh, &material);
        let total = 2 * annulus.mesh.node_count();
        let free = DofMap::excluding(total, annulus.mesh.held_dofs());
        let values: Vec<f64> = (0..free.len()).map(|i| (1.7 * i as f64).sin()).collect();
        let x = free.expand(&values);
        let force = stiffness.multiply(total, &x);
        let masses = lumped_masses(&annulus.mesh, &material);
        let mut expected = vec![0.0; total];
        free.dofs.iter().for_each(|&dof| expected[dof] = force[dof] / masses[dof / 2]);
        for level in LEVELS.into_iter().filter(|level| level.available().is_ok()) {
            let operators: [Box<dyn StiffnessOperator>; 2] = [
                Box::new(SectorStencil::of_annulus(&annulus, &material, level).unwrap()),
                Box::new(SparseOperator::assemble(&annulus.mesh, &material, level).unwrap()),
            ];
            for operator in operators {
                let mut field = scatter(operator.as_ref(), &x);
                let mut product = field.clone();
                operator.multiply(&mut field, &mut product);
                let found = gather(operator.as_ref(), &product);
                // A dozen terms of the size of the largest.
                let error = largest_difference(&found, &expected) / largest(&expected);
                let name = operator.name();
                assert!(error < 1e-14, "{name} {level} {around} x {across}: {error:e}");
            }
        }
    }
}

fn end_state(choice: OperatorChoice, level: SimdLevel) -> (TransientState, [u64; 3]) {
    let annulus = disc(45, 9);
    let model = model(&annulus, 610.0);
    let operator = model.operator(choice, level).unwrap();
    let settings = kicked(4e-3, &[1, 2], 2.0);
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    let mut counts = [0; 3];
    watch(&mut run, |sample| {
        counts[0] += sample.row.counts.stick;
        counts[1] += sample.row.counts.slip;
        counts[2] += sample.row.counts.open;
    });
    (run.state(), counts)
}

/// Cross-method: round-off apart, over thousands of steps in which nodes stick, slip and lift off.
#[test]
fn stencil_and_sparse_rows_give_the_same_motion_through_contact() {
    let (cyclic, counts) = end_state(OperatorChoice::Cyclic, SimdLevel::detect());
    let (sparse, sparse_counts) = end_state(OperatorChoice::Sparse, SimdLevel::detect());
    assert!(cyclic.step >= 3000, "{}", cyclic.step);
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
    assert_eq!(counts, sparse_counts);
    // Round-off of 1e-16 a step, amplified where a status changes; no status changed its step.
    within(&sparse.displacement, &cyclic.displacement, 1e-10 * largest(&cyclic.displacement));
    within(&sparse.velocity, &cyclic.velocity, 1e-10 * largest(&cyclic.velocity));
}

#[test]
fn avx2_and_avx512_give_the_same_bits_and_scalar_the_same_motion() {
    for choice in [OperatorChoice::Cyclic, OperatorChoice::Sparse] {
        let (scalar, _) = end_state(choice, SimdLevel::Scalar);
        let mut fused = None;
        for level in LEVELS[1..].iter().copied().filter(|level| level.available().is_ok()) {
            let (state, _) = end_state(choice, level);
            let error = largest_difference(&state.displacement, &scalar.displacement)
                / largest(&scalar.displacement);
            assert!(error < 1e-10, "{choice:?} {level}: {error:e}");
            assert_eq!(*fused.get_or_insert_with(|| state.clone()), state, "{choice:?}");
        }
    }
}

/// Cross-method: Lanczos against a dense eigenvalue decomposition.
#[test]
fn largest_frequency_is_that_of_the_dense_matrix() {
    let annulus = graded(12, 4);
    let material = POLYCARBONATE;
    let stiffness = assemble_stiffness(&annulus.mesh, &material);
    let masses = lumped_masses(&annulus.mesh, &material);
    let free = DofMap::excluding(2 * masses.len(), annulus.mesh.held_dofs());
    let mut matrix = Mat::<f64>::zeros(free.len(), free.len());
    for (row, column, value) in stiffness.entries {
        if let (Some(i), Some(j)) = (free.unknown_of[row], free.unknown_of[column]) {
            matrix[(i, j)] += value / (masses[row / 2] * masses[column / 2]).sqrt();
        }
    }
    let exact = matrix.self_adjoint_eigenvalues(faer::Side::Lower).unwrap().last().unwrap().sqrt();
    let operator = SparseOperator::assemble(&annulus.mesh, &material, SimdLevel::detect()).unwrap();
    near(largest_frequency(&operator), exact, 1e-9);
}

/// A body where it stands, with the velocity of a field.
fn moving(operator: &dyn StiffnessOperator, velocity: &[f64]) -> MotionFields {
    let velocity = scatter(operator, velocity);
    MotionFields { velocity, ..MotionFields::zeros(operator.field_length()) }
}

fn coefficients(model: &TransientModel<'_>, time_step: f64) -> StepCoefficients {
    let RayleighDamping { mass_coefficient, stiffness_coefficient } = model.damping;
    StepCoefficients { time_step, mass_coefficient, stiffness_coefficient }
}

/// The stability limit is sharp: free motion stays bounded just below it and explodes just above.
#[test]
fn steps_are_stable_below_the_limit_and_unstable_above() {
    let annulus = disc(24, 6);
    let model = model(&annulus, 0.0);
    let operator = model.operator(OperatorChoice::Cyclic, SimdLevel::detect()).unwrap();
    let limit = stable_step_limit(largest_frequency(operator.as_ref()), &model.damping);
    let start = Perturbation::of(&[1, 12], 1.0);
    for (factor, is_stable) in [(0.999, true), (1.001, false)] {
        let mut fields = moving(operator.as_ref(), &model.perturbed(&start).unwrap());
        let coefficients = coefficients(&model, factor * limit);
        operator.multiply(&mut fields.velocity, &mut fields.elastic_rate);
        for _ in 0..40_000 {
            operator.advance(&mut fields, &coefficients);
        }
        let speed = largest(&gather(operator.as_ref(), &fields.velocity));
        assert_eq!(speed < 10.0, is_stable, "{factor}: {speed:e}");
    }
}

/// Large bodies are stepped in pieces by several threads, in an order of nodes of their own.
#[test]
fn a_large_body_moves_as_with_the_stencil_and_to_the_same_bits_on_any_number_of_threads() {
    let annulus = disc(200, 180);
    let model = model(&annulus, 0.0);
    let operators = [OperatorChoice::Cyclic, OperatorChoice::Sparse]
        .map(|choice| model.operator(choice, SimdLevel::detect()).unwrap());
    let [cyclic, sparse] = &operators;
    let dofs = cyclic.dof_count();
    assert!((0..dofs).any(|dof| sparse.position(dof) != dof));
    let held: Vec<bool> = (0..dofs).map(|k| cyclic.masses()[cyclic.position(k)] == 0.0).collect();
    let start: Vec<f64> =
        (0..dofs).map(|dof| if held[dof] { 0.0 } else { (1.7 * dof as f64).sin() }).collect();
    let coefficients = coefficients(&model, 1e-8);
    let moved = |operator: &dyn StiffnessOperator, threads: usize| {
        let mut fields = moving(operator, &start);
        let powers: Vec<f64> = on_threads(threads, || {
            operator.multiply(&mut fields.velocity, &mut fields.elastic_rate);
            (0..4).map(|_| operator.advance(&mut fields, &coefficients)).collect()
        });
        (gather(operator, &fields.elastic), powers)
    };
    let (expected, expected_powers) = moved(cyclic.as_ref(), 1);
    let (alone, powers) = moved(sparse.as_ref(), 1);
    // A dozen terms of the size of the largest in each of five products.
    assert!(largest_difference(&alone, &expected) < 1e-13 * largest(&expected));
    // Sums of 70,000 terms, hardly any negative, in two orders.
    near_each(&powers, &expected_powers, 1e-12);
    for threads in [2, 3] {
        assert_eq!(moved(sparse.as_ref(), threads), (alone.clone(), powers.clone()));
    }
}
