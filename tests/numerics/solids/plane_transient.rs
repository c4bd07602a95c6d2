//! The transient of a guided body, `u_z = 0` at every node, beside that of plane strain.

use super::*;

/// Statuses, tangential displacements and normal forces of the contact nodes at every sample.
#[derive(Default)]
struct Course {
    status: Vec<Vec<ContactStatus>>,
    displacement: Vec<Vec<f64>>,
    force: Vec<f64>,
    kinetic: Vec<f64>,
}

/// Three periods of a wave strong enough that nodes stick and lift.
fn course(body: TransientModel<'_>, is_solid: bool) -> Course {
    let (initial, kick) = (InitialState::SteadySliding, Perturbation::of(&[2], 8.0));
    let mut settings = transient_settings([3e-4, 5e-6, 0.0], initial, kick);
    settings.time_step = TimeStep::Seconds(1e-7);
    let mut course = Course::default();
    watch(&mut started(body, OperatorChoice::Auto, &settings), |sample| {
        let nodes = sample.contact().status.len();
        course.status.push(sample.contact().status.clone());
        let tangential = |i| sample.contact_tangential_displacement(i);
        course.displacement.push((0..nodes).map(tangential).collect());
        course.force.push(sample.contact().normal_force.iter().sum());
        course.kinetic.push(sample.row.kinetic_energy);
        if is_solid {
            assert!(sample.displacement().into_iter().skip(2).step_by(3).all(|axial| axial == 0.0));
        }
    });
    course
}

/// Share of statuses that differ, and the largest relative differences of displacement, normal force and kinetic energy.
fn differences([around, radial]: [usize; 2]) -> [f64; 4] {
    // The course of a guided body, and that of plane strain.
    let model = guided(Quad4, [around, radial, 1]);
    let sector = SolidSector::generate(&model.specification).unwrap();
    let annulus = AnnulusMesh::generate(&model.specification.annulus).unwrap();
    let material = ElasticMaterial { formulation: PlaneStrain, ..model.material };
    let damping = model.options.damping;
    let flat = TransientModel::of_annulus(&annulus, &material, damping, model.contact);
    let thick = course(body(&model, (&sector, &sector.whole())), true);
    let flat = course(flat, false);
    assert_eq!(thick.status.len(), flat.status.len());
    let thickness = 0.009;
    let (mut other, mut total, mut seen) = (0, 0, [false; 3]);
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for (k, statuses) in flat.status.iter().enumerate() {
        // At each angle the node of the bottom, then that of the top.
        for (i, status) in statuses.iter().enumerate() {
            seen[*status as usize] = true;
            for layer in [2 * i, 2 * i + 1] {
                total += 1;
                other += usize::from(thick.status[k][layer] != *status);
                let u = flat.displacement[k][i];
                apart = apart.max((thick.displacement[k][layer] - u).abs());
                largest = largest.max(u.abs());
            }
        }
    }
    assert_eq!(seen, [true; 3]);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let relative = |of: fn(&Course) -> &[f64]| {
        let pairs = of(&thick).iter().zip(of(&flat));
        let apart: Vec<f64> = pairs.map(|(a, b)| a / thickness - b).collect();
        // Impacts are pulses of a step: forces in the mean.
        mean(&apart).abs() / mean(of(&flat))
    };
    [
        other as f64 / total as f64,
        apart / largest,
        relative(|course| &course.force),
        relative(|course| &course.kinetic),
    ]
}

/// Cross-method. Mass, contact and time steps are the same; in the plane the brick is a quadrilateral with incompatible modes,
/// the plane element one of full integration. Both are of second order, so that what is left between them falls with the
/// square of the element; impacts, which begin a sample earlier or later, take a part of that order.
#[test]
fn a_guided_body_moves_sticks_slips_and_opens_as_in_plane_strain_the_more_so_the_finer_the_mesh() {
    let coarse = differences([40, 8]);
    let fine = differences([80, 16]);
    // Statuses, displacement, mean normal force, mean kinetic energy; the last is within 0.2 % on both meshes.
    for (k, bound) in [0.04, 0.06, 0.01, 0.002].into_iter().enumerate() {
        assert!(fine[k] < bound, "{k}: {fine:?}");
        assert!(k == 3 || fine[k] < 0.4 * coarse[k], "{k}: {coarse:?} {fine:?}");
    }
}
