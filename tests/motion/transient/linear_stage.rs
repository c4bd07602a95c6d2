//! The linear stage against the complex eigenvalues of the same model.

use super::*;
use frictionsim::cea::cyclic::sweep;

/// Eigenvalue of a harmonic with the largest real part as the time loop has it: lumped mass, no geometric stiffness.
fn least_stable(contact: &SlidingContact, stiffness: ContactStiffness, harmonic: usize) -> c64 {
    let options = TangentOptions { mass: Lumped, contact: stiffness, ..TANGENT };
    let at = [contact.friction_coefficient];
    let request = sweep_request(&at, Lowest(40));
    let specification = disc(60, 12).specification;
    let found = sweep(&specification, &POLYCARBONATE, &options, contact, &request).unwrap();
    let modes = found.sweep.points[0].modes.iter();
    fastest(modes.filter(|mode| mode.harmonic == harmonic)).eigenvalue
}

/// Cross-method: the strongest check that the two halves of the program agree, on rigid contact, springs with dashpots, and
/// contact that stiffens, at whose pressure the tangent is taken; under constant friction, and under friction that falls, at a
/// speed where it does and at one that leaves little of its fall.
#[test]
fn seeded_harmonics_grow_as_the_complex_eigenvalues_predict() {
    let annulus = disc(60, 12);
    let little = |rpm| SlidingContact { friction_coefficient: 0.1, ..falling(rpm) };
    let springs = compliant(5e11, [1e5, 1e4]);
    for (n, contact, stiffness) in [
        (1, contact(610.0), RIGID),
        (2, contact(610.0), RIGID),
        (3, contact(610.0), RIGID),
        (2, little(100.0), RIGID),
        (2, little(1800.0), RIGID),
        (2, contact(610.0), springs),
        (2, falling(610.0), springs),
        (2, contact(610.0), stiffening(LAWS[0])),
        (2, contact(610.0), stiffening(LAWS[1])),
    ] {
        let stepped = stiffness.damped_by(DAMPING.stiffness_coefficient);
        let model = on_contact(&annulus, contact, stepped);
        // Small enough to stay linear over the whole run.
        let mut settings = kicked(0.012, &[n], 1e-8);
        settings.initial = InitialState::SteadySliding;
        let (record, _) = recorded(model, OperatorChoice::Auto, &settings);
        let analysis = TransientAnalysis::of(&record, &[n]);
        assert_eq!(analysis.first_nonlinearity, None);
        let exact = least_stable(&contact, stiffness, n);
        grows_as(&record, n, exact, 1e-3);
        // The unstable member of a pair travels against the rotor.
        assert!(exact.re < 0.0 || analysis.growth[0].direction() == -1);
        if contact.friction_coefficient == 0.1 {
            // The fall of friction alone feeds the wave.
            assert_eq!(exact.re > 0.0, contact.rotation_speed < 20.0);
            let constant = SlidingContact { decay: None, ..contact };
            assert!(least_stable(&constant, stiffness, n).re < 0.0);
        }
        if stiffness == springs {
            assert!((least_stable(&contact, RIGID, n).re / exact.re - 1.0).abs() > 0.1);
        }
    }
}
