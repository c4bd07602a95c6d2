//! Independent checks of the element matrices against elasticity theory.

use crate::prelude::*;

fn annulus(element: ElementKind, circumferential: usize, radial: usize) -> Mesh {
    let specification = AnnulusSpecification {
        radial_grading: 1.05,
        ..crate::disc::annulus(element, circumferential, radial)
    };
    AnnulusMesh::generate(&specification).unwrap().mesh
}

fn polycarbonate(formulation: PlaneFormulation) -> ElasticMaterial {
    elastic(2.5e9, 0.38, 1228.0, formulation)
}

#[test]
fn linear_displacement_gives_constant_stress_and_no_interior_force() {
    for element in [Quad4, Quad8] {
        for formulation in [PlaneStrain, PlaneStress] {
            let (mesh, material) = (annulus(element, 17, 4), polycarbonate(formulation));
            let gradient = Matrix3::new(1e-3, 4e-4, 0.0, -2e-4, 5e-4, 0.0, 0.0, 0.0, 0.0);
            let displacement = sample(&mesh, |p| gradient * p);
            let stiffness = assemble_stiffness(&mesh, &material);
            let force = stiffness.multiply(2 * mesh.node_count(), &displacement);
            let edge = mesh.boundaries.iter().flat_map(|edge| &edge.nodes);
            let boundary = edge.flat_map(|&n| [2 * n as usize, 2 * n as usize + 1]);
            let interior = DofMap::excluding(2 * mesh.node_count(), boundary);
            let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let is_free = |&dof: &usize| force[dof].abs() < 1e-11 * largest;
            assert!(interior.dofs.iter().all(is_free), "{element:?} {formulation:?}");
            // Traces do not depend on the frame: sigma_11 + sigma_22 = (2 lambda + 2 G) tr(epsilon).
            let [lambda, g] = material.lame_constants();
            let trace = (2.0 * lambda + 2.0 * g) * 1.5e-3;
            for stress in nodal_stress(&mesh, &material, &displacement) {
                near(stress.radial + stress.hoop, trace, 1e-11);
            }
        }
    }
}

#[test]
fn contact_without_interference_is_reported_as_open_with_node_and_angle() {
    let material = polycarbonate(PlaneStrain);
    let mesh = annulus(Quad4, 24, 4);
    let contact = SlidingContact { interference: -1e-6, ..contact(610.0) };
    let body = Assembly::of_edge(&mesh, &material, &contact, RIGID).unwrap();
    let error = body.state(0.3).unwrap_err();
    let wanted = "24 of 24 contact nodes are not pressed, first node 1 at 0.000 degrees with -";
    assert!(error.to_string().contains(wanted), "{error}");
    assert!(error.to_string().contains("contact.interference"));
}

/// Independent check: torque is thickness times radius times the sum of traction times tributary length; pressure is Lame's.
#[test]
fn the_reported_torque_and_power_are_those_of_the_whole_thickness() {
    let coarse = "mesh.circumferential_elements=24 ; mesh.radial_elements=4";
    let case = shipped_case("polycarbonate-disc.toml", &[coarse]);
    let model = SlidingModel::new(&case, case.cea.as_ref().unwrap()).unwrap();
    let (base, field) = (model.base_state(&case), model.base_field(&case));
    let lengths = ContactInterface::of(&model.mesh).tributary_lengths;
    let force: f64 = field.contact.iter().zip(&lengths).map(|(own, w)| own.shear * w).sum();
    let torque = 0.009 * 0.0205 * force;
    near(base.torque_n_m.unwrap(), torque, 1e-12);
    near(base.power_w, torque * 610.0 * TAU / 60.0, 1e-12);
    // Lame's pressure for this interference: 2.827 MPa at nu = 0.38, a coarse mesh within 2 %.
    near(base.pressure_pa[0], 2.827e6, 0.02);
}
