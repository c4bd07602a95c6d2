//! The linear stage of the transient between meshes that do not match, against the eigenvalues of the same bodies.

use super::*;

/// Cross-method check: a transient that starts from a mode of the eigenvalue analysis grows as that says.
#[test]
fn a_mode_of_two_bodies_whose_meshes_do_not_match_grows_as_its_eigenvalue_says() {
    let brass = elastic(1e11, 0.35, 8500.0, PlaneStrain);
    let mesh = rings([40, 48], [3, 9], 0.05);
    for shaft in [POLYCARBONATE, brass] {
        let materials = [POLYCARBONATE, shaft].map(RegionMaterial::from).to_vec();
        assert_eq!(mesh.regions, ["disc", "shaft"]);
        let options = options(Lumped, false);
        let tangent = linearized(&mesh, &materials, &contact(610.0), &options);
        let request = SweepRequest { shapes_at: &[0.3], ..sweep_request(&[0.3], Lowest(12)) };
        let found = sweep(&tangent, &request, &|_| {}).unwrap().points.remove(0).modes;
        let mode = fastest(&found);
        assert!(mode.eigenvalue.re > 0.0);
        let body = SteppedBody::Plane { mesh: &mesh, annulus: None };
        grows_from(TransientModel::new(body, &materials, DAMPING, contact(610.0)), mode);
    }
}
