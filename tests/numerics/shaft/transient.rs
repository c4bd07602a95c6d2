//! The stencil that steps disc and shaft, and the contact between its rows; their energy is held in `motion transient/energy.rs`.

use super::*;

/// Cross-method check: the eigenvalue analysis of both bodies.
#[test]
fn a_wave_in_disc_and_shaft_grows_as_the_complex_eigenvalue_predicts() {
    let specification = with_shaft(Quad4, 48, [4, 10]);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let mut steel = on(STEEL);
    steel.shaft.as_mut().unwrap().damping = Some(rayleigh_damping(20.0, 1e-8));
    let options = TangentOptions { mass: Lumped, ..rigid_contact(false) };
    let (n, start) = (2, InitialState::SteadySliding);
    let settings = transient_settings([0.006, 4e-6, 1e-4], start, Perturbation::of(&[n], 1e-8));
    for materials in [on(POLYCARBONATE), steel] {
        let limit = MaxFrequency(20e3);
        let found = model(specification, materials.clone(), options).swept(&[0.0, 0.3], limit);
        let modes = found.sweep.points[1].modes.iter();
        let predicted = fastest(modes.filter(|mode| mode.harmonic == n)).eigenvalue;
        assert!(predicted.re > 0.0);
        let model = TransientModel::of_annulus(&annulus, &materials, DAMPING, contact(610.0));
        let (record, _) = recorded(model, OperatorChoice::Cyclic, &settings);
        // Two bodies alike have short waves that grow much faster, out of round-off: the fit ends before them.
        grows_as(&record, n, predicted, 1e-3);
    }
}
