//! The transient of a body of revolution against its eigenvalue analysis and against itself.

use super::*;

/// A run of a model, recorded.
fn run(model: &SolidModel, settings: &TransientSettings) -> Recorder {
    let sector = SolidSector::generate(&model.specification).unwrap();
    recorded(body(model, (&sector, &sector.whole())), OperatorChoice::Auto, settings).0
}

fn seeded(harmonic: usize, velocity: f64, duration: f64) -> TransientSettings {
    let seed = Perturbation::of(&[harmonic], velocity);
    transient_settings([duration, 1e-5, 0.0], InitialState::SteadySliding, seed)
}

fn lumped(element: ElementKind, divisions: [usize; 3]) -> SolidModel {
    let mut model = disc(element, divisions);
    model.options.mass = Lumped;
    model
}

/// A ring on a layer whose bottom slides on the ground: all of it is pressed.
fn ringed(divisions: [usize; 3]) -> SolidModel {
    let mut model = lumped(Quad4, divisions);
    model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.07 };
    model.specification.conditions[3] = Guide;
    model.contact.interference = 5e-6;
    model
}

/// Cross-method: the seeded wave grows at the rate, and with the frequency, of the eigenvalue analysis of the same mesh and mass.
/// The time step shortens the period by `(omega dt)^2 / 24`.
fn grows_as_predicted(model: &SolidModel, harmonic: usize, limit_hz: f64, duration: f64) {
    let all = modes(model, model.contact.friction_coefficient, limit_hz);
    let mode = fastest(all.iter().filter(|mode| mode.harmonic == harmonic));
    assert!(mode.is_unstable(), "{:?}", mode.growth_rate());
    let record = run(model, &seeded(harmonic, 1e-6, duration));
    grows_as(&record, harmonic, mode.eigenvalue, 2e-3);
}

#[test]
fn a_wave_on_the_inner_edge_grows_at_the_rate_of_the_eigenvalue_analysis() {
    grows_as_predicted(&lumped(Quad4, [32, 6, 2]), 2, 12e3, 0.02);
}

/// Springs in the face, friction along and across the sliding; and a law that is stepped itself, from the base state that it carries.
#[test]
fn a_wave_under_a_ring_grows_at_the_rate_of_the_eigenvalue_analysis() {
    let law = exponential(1e5, 1e-6);
    for (law, stiffness) in [(None, 1e12), (Some(law), law.stiffness(0.0))] {
        // At 6000 rpm one wave grows in spite of the damping of the body.
        let mut model = ringed([24, 7, 2]);
        model.contact.friction_coefficient = 0.1;
        model.contact.rotation_speed = 6000.0 * TAU / 60.0;
        model.options.damping_model = BodyOnly;
        model.options.contact.law = law;
        model.options.contact.normal_stiffness = Some(stiffness);
        grows_as_predicted(&model, 1, 7e3, 0.01);
    }
}

/// Independent: a time step has friction `mu N / V` across the sliding at each node; so has lumped contact in the tangent of its waves.
#[test]
fn friction_across_the_sliding_is_that_of_each_node() {
    let mut model = ringed([12, 6, 1]);
    model.options.damping = rayleigh_damping(0.0, 0.0);
    let (sector, base) = base(&model).unwrap();
    let wave = model.tangent().harmonic(1).at(0.3);
    let diagonal = wave.matrices.damping.chunks_exact(2 * wave.half_bandwidth + 1);
    let found = diagonal.map(|row| row[wave.half_bandwidth].re);
    let found = sorted(found.filter(|own| *own != 0.0));
    let exact = sorted(base.normal_forces().map(|(node, force)| {
        0.3 * force / (model.contact.rotation_speed * sector.nodes[node].radius)
    }));
    assert!(exact.len() > 2);
    near_each(&found, &exact, 1e-12);
}

/// A steel disc clamped at its bore, under a ring with a lining from which it bends away.
#[test]
fn a_wave_under_a_ring_that_opens_in_part_grows_at_the_rate_of_the_eigenvalue_analysis() {
    let mut model = bending(Quad4, [24, 8, 2]);
    model.options.mass = Lumped;
    model.material.young_modulus = 2.1e11;
    model.material.poisson_ratio = 0.3;
    model.material.density = 7850.0;
    model.options.damping = rayleigh_damping(20.0, 1.5e-7);
    model.options.damping_model = BodyOnly;
    model.options.contact.normal_stiffness = Some(1e11);
    model.options.contact.is_base_compliant = true;
    model.contact.friction_coefficient = 0.4;
    let (_, base) = base(&model).unwrap();
    assert!(opens_in_part(&base));
    grows_as_predicted(&model, 3, 4e3, 0.03);
}

/// Coulomb's law has its disc at every contact node.
#[test]
fn energy_is_balanced_through_stick_slip_and_separation() {
    for contact in [SolidContact::Inner, ringed([24, 4, 2]).specification.contact] {
        let mut model = lumped(Quad4, [24, 4, 2]);
        model.specification.contact = contact;
        if contact != SolidContact::Inner {
            model.specification.conditions[3] = Guide;
        }
        let sector = SolidSector::generate(&model.specification).unwrap();
        let whole = sector.whole();
        let body = body(&model, (&sector, &whole));
        // Faster than the rotor, so that nodes stick and lift.
        let mut run = started(body, OperatorChoice::Auto, &seeded(2, 8.0, 1e-3));
        // Largest residual of the energy, and share of friction that acts across the sliding.
        let (mut seen, mut residual, mut largest_across) = ([false; 3], 0.0_f64, 0.0_f64);
        watch(&mut run, |sample| {
            let law = sample.contact();
            let forces = law.normal_force.iter().zip(&law.tangential_force).zip(&law.across_force);
            for (((normal, tangential), across), status) in forces.zip(&law.status) {
                let friction = tangential.hypot(*across);
                assert!(*normal >= 0.0 && friction <= 0.3 * normal * (1.0 + 1e-12));
                // A slipping node stands on the rim of the disc.
                let is_slipping = *status == ContactStatus::Slip;
                assert!(!is_slipping || friction >= 0.3 * normal * (1.0 - 1e-12));
                largest_across = largest_across.max(across.abs() / friction.max(1e-300));
                assert_eq!(*normal == 0.0, *status == ContactStatus::Open);
                seen[*status as usize] = true;
            }
            residual = residual.max(sample.row.balance_residual);
        });
        // Only a body that is free across the face lifts off it.
        let lifts = contact == SolidContact::Inner;
        assert_eq!(seen, [lifts, true, true]);
        assert!(residual < 1e-10 && largest_across > 0.1, "{residual} {largest_across}");
    }
}

/// Nodes stick, slip and lift in every period: 200,000 steps, half a million in the long tier.
#[test]
fn energy_is_balanced_over_long_squeal() {
    let model = lumped(Quad4, [24, 4, 2]);
    let mut settings = seeded(1, 1.0, sized(0.2, 0.5));
    settings.time_step = TimeStep::Seconds(1e-6);
    settings.sample_interval = 1e-4;
    let analysis = TransientAnalysis::of(&run(&model, &settings), &[1]);
    let status = analysis.last_fifth.status;
    assert!(status[0] > 0.01 && status[2] > 0.1 && analysis.largest_residual < 1e-10, "{status:?}");
}

#[test]
fn a_compliant_ring_with_dashpots_on_supports_of_its_own_keeps_the_balance() {
    let mut model = ringed([24, 4, 2]);
    model.options.contact.normal_stiffness = Some(1e12);
    model.options.contact.normal_damping = 1e4;
    model.options.contact.tangential_damping = 1e4;
    model.specification.conditions[1] = support([1e11, 1e11, 1e10], [1e4, 1e4]);
    let record = run(&model, &seeded(2, 0.5, 1e-3));
    assert!(TransientAnalysis::of(&record, &[2]).largest_residual < 1e-10);
    assert!(record.has_contact_springs());
}

#[test]
fn a_resumed_run_has_the_bits_of_one_that_was_never_stopped() {
    let model = ringed([24, 4, 2]);
    let sector = SolidSector::generate(&model.specification).unwrap();
    let whole = seeded(2, 1.0, 4e-4);
    let half = TransientSettings { duration: 2e-4, ..whole.clone() };
    goes_on(body(&model, (&sector, &sector.whole())), OperatorChoice::Auto, [&half, &whole]);
}
