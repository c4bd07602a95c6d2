//! Limit cycles of bodies without symmetry: periodic motions of the whole mesh.
//!
//! Independent: a transient that grows into its cycle from noise with a step of its own; rotating waves, found along their phase;
//! an oscillator integrated from event to event. The others are identities.

use crate::prelude::*;
use frictionsim::results::cycle::Origin;
use frictionsim::study::cycle::refuse_nothing;

/// The block at a friction coefficient at which one mode grows.
fn block(overrides: &[&str]) -> Case {
    let folder = folder();
    let mesh = coarse_block(folder.path());
    let own = [&mesh, "contact.friction_coefficient=0.7 ; cycle={ confirmation_periods = 20 }"];
    shipped_case("sliding-block.toml", &[&own, overrides].concat())
}

pub fn found(result: &PeriodicResult) -> &FoundCycle {
    result.outcome.as_ref().unwrap()
}

/// Holds a case's first cycle to the end of its transient with another step: frequency 1e-3, statuses 0.02, powers 2 % of the external.
pub fn hold_to_transient(case: &Case) -> PeriodicResult {
    let result = cycles(case).remove(0);
    let motion = &found(&result).motion;
    let solved = TransientStudy::new(case, SimdLevel::detect()).unwrap();
    let end = solved.solve().unwrap().analysis.last_fifth;
    let frequency = end.main_frequency_hz.unwrap();
    near(motion.frequency_hz, frequency, 1e-3);
    within(&motion.fractions, &end.status, 0.02);
    let (own, other) = (motion.powers.contact, end.powers);
    let found = [own.external, own.stick, own.slide, motion.powers.material_damping];
    let expected = [other.external, other.stick, other.slide, end.material_damping];
    within(&found, &expected, 0.02 * other.external);
    result
}

/// A transient that grows from noise.
const FROM_NOISE: [&str; 1] = ["transient.duration=0.012 ; transient.time_step=4e-7 ; \
     transient.initial=\"steady-sliding\" ; transient.perturbation.noise=1e-2"];

#[test]
fn the_cycle_of_a_block_is_that_of_its_transient() {
    let result = hold_to_transient(&block(&FROM_NOISE));
    let cycle = found(&result);
    // A stable cycle: perturbations decay, a transient beside it comes back.
    let multipliers = cycle.stability.as_ref().unwrap().as_ref().unwrap();
    assert_eq!(multipliers.verdict(), Verdict::Stable);
    assert!(cycle.confirmation.as_ref().unwrap().agrees, "{:?}", cycle.confirmation);
    // The shift in phase has the multiplier 1, but for nodes that change their status at whole steps. That bends the map, which
    // differences over a finite perturbation see: 0.0004 to 0.008 off with 216 to 2443 steps of a period, without a law in them.
    near(multipliers.shift.unwrap(), 1.0, 0.01);
}

/// Nodes that set out at whole steps under falling friction take the shift in phase as far as 1.5 from 1: no perturbation that
/// grows. A transient of a hundred periods is the judge.
#[test]
fn a_cycle_on_which_a_transient_stays_is_not_called_unstable() {
    let cycle = "cycle={ onsets = \"lowest\", confirmation_periods = 100 }";
    for [decay_speed, speed] in [[0.63, 1.5], [0.3, 3.0]] {
        let law = format!(
            "contact.static_friction_ratio=1.4 ; contact.decay_speed={decay_speed:?} ; \
             contact.speed={speed:?}"
        );
        let result = cycles(&block(&[&law, cycle])).remove(0);
        let cycle = found(&result);
        assert!(cycle.confirmation.as_ref().unwrap().agrees, "{:?}", cycle.confirmation);
        let multipliers = cycle.stability.as_ref().unwrap().as_ref().unwrap();
        assert_ne!(multipliers.verdict(), Verdict::Unstable, "{multipliers:?}");
    }
}

/// A block that leans, sticks, slips and lifts off. Impacts bend its map: at 100, 400 and 1600 steps of a period small differences
/// have multipliers of 1.33, 0.91 and 2.1. An integrator of its own (Python, central differences) followed perturbations of 0.1 to
/// 1 % of the amplitude from period to period: they grow 1.15 to 1.28 times, 1.25 times with short steps, which is 2400 1/s.
#[test]
fn impacts_leave_a_perturbation_that_grows_its_rate() {
    let folder = folder();
    let [xs, ys] = [even(0.06, 5), even(0.04, 4)];
    let mesh = quadrilaterals(&xs, &ys, ["face", "back", "body"], |x, y| [x + 0.08 * y, y]);
    let path = folder.path().join("leaning.msh");
    fs::write(&path, mesh).unwrap();
    let own = format!(
        "mesh.file=\"{}\" ; mesh.scale=1.0 ; material.poisson_ratio=0.38 ; \
         boundaries.back.normal_stiffness=1e11 ; boundaries.back.tangential_stiffness=1e11 ; \
         damping.stiffness_coefficient=1e-7 ; contact.speed=1.0 ; \
         contact.friction_coefficient=0.2 ; cea.modes=12 ; cea.friction_coefficients=[0.2] ; \
         cycle={{ confirmation_periods = 0 }}",
        path.display()
    );
    let results = cycles(&shipped_case("sliding-block.toml", &[&own]));
    let cycle = results.iter().map(found).find(|own| own.motion.fractions[2] > 0.5).unwrap();
    near(cycle.motion.frequency_hz, 10_848.5, 1e-4);
    let multipliers = cycle.stability.as_ref().unwrap().as_ref().unwrap();
    assert_eq!(multipliers.verdict(), Verdict::Unstable, "{multipliers:?}");
    let leading = multipliers.leading().unwrap();
    assert!((leading.growth_rate - 2400.0).abs() < leading.uncertainty, "{leading:?}");
    assert!(leading.uncertainty < 1000.0, "{leading:?}");
    // None is said to grow faster.
    let most = leading.growth_rate + leading.uncertainty;
    assert!(multipliers.multipliers.iter().all(|own| own.growth_rate <= most));
}

#[test]
fn cycles_on_springs_and_dashpots_of_the_contact_and_of_two_bodies_are_those_of_their_transients() {
    let springs = ["contact.normal_stiffness=2e13", "contact.tangential_damping=1e3"];
    let shaft = "mesh.circumferential_elements=48 ; mesh.radial_elements=10 ; \
        mesh.shaft_radial_elements=2 ; cea.max_frequency_hz=12000.0 ; \
        cycle={ onsets = \"lowest\", confirmation_periods = 0, stability = \"none\" } ; \
        transient.duration=0.012 ; transient.perturbation={ harmonics = [1], velocity = 0.05 }";
    let on_springs = block(&[&FROM_NOISE[..], &springs].concat());
    for case in [on_springs, shipped_case("deformable-shaft.toml", &[shaft])] {
        let powers = found(&hold_to_transient(&case)).motion.powers;
        assert!(powers.balance_residual() < 1e-6);
        assert_eq!(powers.contact.damping > 0.0, case.contact.stiffness.tangential_damping > 0.0);
    }
}

#[test]
fn energy_of_a_cycle_closes_and_its_parts_add_up() {
    let results = cycles(&block(&["cycle={ confirmation_periods = 0, stability = \"none\" }"]));
    let cycle = found(&results[0]);
    let motion = &cycle.motion;
    // The balance of the time loop closes to round-off; what the motion misses its start by is left, times the energies that
    // go to and fro, a few times those that are lost.
    assert!(motion.residual < 1e-8, "{}", motion.residual);
    below(motion.powers.balance_residual(), 1e-7, "balance");
    let contact = motion.powers.contact;
    near(contact.stick + contact.slide + contact.contact_dissipated, contact.external, 1e-12);
    // Statuses are those of the nodes, harmonics those of the motion, both sum to the whole.
    let sum = |k: usize| motion.shares.iter().map(|share| share[k]).sum::<f64>();
    let means = [0, 1, 2].map(|k| sum(k) / motion.shares.len() as f64);
    within(&means, &motion.fractions, 1e-12);
    let told = &motion.harmonics[..cycle.harmonic_count];
    assert!(told.last().unwrap().remainder <= 1e-3);
    assert!(told.len() < motion.harmonics.len() && told.len() > 1);
    // Time begins where the node that moves most is farthest ahead.
    let ahead = motion.instants.iter().map(|at| at[motion.node].displacement[1]);
    let farthest = ahead.fold(f64::NEG_INFINITY, f64::max);
    let first = motion.instants[0][motion.node].displacement[1];
    assert!((farthest - first).abs() < 1e-3 * motion.amplitude);
}

#[test]
fn a_branch_of_cycles_goes_from_neighbour_to_neighbour() {
    let range = "cycle={ confirmation_periods = 0, stability = \"none\", continuation = { key = \
                 \"contact.friction_coefficient\", from = 0.64, to = 0.7, count = 4 } }";
    let results = cycles(&block(&[range]));
    let branch = found(&results[0]).branch.as_ref().unwrap();
    let values: Vec<f64> = branch.motions.iter().map(|own| own.value).collect();
    // The values asked for, and others between them.
    assert!(values.is_sorted() && values[0] == 0.64 && values.ends_with(&[0.7]), "{values:?}");
    let is_there = |wanted: f64| values.iter().any(|value| (value - wanted).abs() < 1e-12);
    assert!([0.66, 0.68].into_iter().all(is_there), "{values:?} {:?}", branch.ends);
    // The first one is the cycle that is found from its own mode.
    let own = cycles(&block(&["contact.friction_coefficient=0.64 ; \
         cycle={ confirmation_periods = 0, stability = \"none\" }"]));
    let (a, b) = (&branch.motions[0].motion, &found(&own[0]).motion);
    near(a.frequency_hz, b.frequency_hz, 1e-4);
    near(a.powers.contact.external, b.powers.contact.external, 1e-3);
}

#[test]
fn below_the_onset_steady_sliding_is_said_to_be_stable() {
    let case = block(&["contact.friction_coefficient=0.5"]);
    let study = PeriodicStudy::new(&case, SimdLevel::detect()).unwrap();
    let report = study.report(study.run(0, &Unwatched, &|_| {}).unwrap());
    assert!(refuse_nothing(&report).is_ok());
    let text = &report.notes[0];
    has(text, &["as far as 10 modes", "stable at friction 0.5"]);
    // The critical friction that it tells of: a mode grows above it, none below.
    let critical = report.critical_value.unwrap();
    assert_eq!(critical.key, Parameter::FrictionCoefficient.key());
    assert!(text.contains(&critical.to_string()), "{text}");
    for (factor, growing) in [(0.998, 0), (1.002, 1)] {
        let friction = factor * critical.value;
        let case = block(&[&format!("contact.friction_coefficient={friction}")]);
        let study = PeriodicStudy::new(&case, SimdLevel::detect()).unwrap();
        assert_eq!(study.sought.len(), growing, "{friction}");
    }
}

/// At the damping that is told of the lowest onset of the disc is the case's friction.
#[test]
fn the_critical_damping_of_stable_sliding_is_where_the_onset_is_the_friction() {
    let at = |damping: f64| {
        let coarse = "mesh.circumferential_elements=45 ; mesh.radial_elements=9";
        let own = format!("damping.stiffness_coefficient={damping:e}");
        let over = "contact.friction_coefficient=0.05 ; cycle={ continuation = { key = \
            \"damping.stiffness_coefficient\", from = 0.0, to = 4.5e-7, count = 5 } }";
        let case = shipped_case("limit-cycle.toml", &[coarse, &own, over]);
        let study = CycleStudy::new(&case, SimdLevel::detect()).unwrap();
        let report = study.report(Vec::new(), Vec::new());
        let Origin::Waves { lowest_onset } = report.origin else { panic!("a disc") };
        (report.critical_value, lowest_onset.unwrap())
    };
    let (critical, onset) = at(4.5e-7);
    let critical = critical.unwrap();
    assert!(onset.critical_friction > 0.05 && critical.value < 4.5e-7);
    near(at(critical.value).1.critical_friction, 0.05, 1e-3);
}

/// In slow sliding the nodes of the pad stick together, at whole steps, and the motion repeats itself to no more than 1e-5; it is that
/// of a transient of 0.1 s (15368.5 Hz, stick 0.375).
#[test]
fn the_cycle_of_a_pad_in_slow_sliding_is_that_of_its_transient() {
    let slow = "contact.rotation_speed_rpm=5.0 ; \
        cycle={ onsets = \"lowest\", confirmation_periods = 0, stability = \"none\" }";
    let results = cycles(&shipped_case("pad-on-disc.toml", &[slow]));
    let motion = &found(&results[0]).motion;
    assert!(motion.residual < 1e-4, "{}", motion.residual);
    near(motion.frequency_hz, 15_368.5, 1e-3);
    assert!((motion.fractions[0] - 0.375).abs() < 0.01, "{:?}", motion.fractions);
}

/// The same cycle by two methods: a wave along its phase, and a motion of the whole mesh.
#[test]
fn rotating_waves_are_periodic_motions_of_the_whole_mesh() {
    let own = "mesh.circumferential_elements=90 ; mesh.radial_elements=18 ; \
               cea={ modes = 8, friction_coefficients = [0.3], geometric_stiffness = false }";
    let disc = |cycle: &str| shipped_case("limit-cycle.toml", &[own, cycle]);
    let case = disc("cycle={ harmonics = [2], onsets = \"lowest\", confirmation_periods = 0 }");
    let waves = CycleStudy::new(&case, SimdLevel::detect()).unwrap().run(0, &|| {});
    let found_wave = waves[0].outcome.as_ref().unwrap();
    let wave = &found_wave.cycle;
    let all = cycles(&disc("cycle={ confirmation_periods = 0 }"));
    let distance = |result: &&PeriodicResult| {
        let motion = result.outcome.as_ref().ok().map(|found| found.motion.frequency_hz);
        (motion.unwrap_or(0.0) / wave.frequency_hz() - 1.0).abs()
    };
    let nearest = nearest_by(&all, distance);
    let motion = &found(nearest).motion;
    // The phases of the wave's own search are the difference.
    near(motion.frequency_hz, wave.frequency_hz(), 5e-4);
    within(&motion.fractions, &wave.fractions, 0.01);
    let (own, other) = (motion.powers.contact, wave.powers.contact);
    near(own.external, other.external, 0.01);
    within(&[own.stick, own.slide], &[other.stick, other.slide], 0.01 * other.external);
    // Floquet exponents of the wave, from linearized contact, and multipliers, from differences of the motion.
    let own = found(nearest).stability.as_ref().unwrap().as_ref().unwrap().leading().unwrap();
    let other = found_wave.stability.as_ref().unwrap().as_ref().unwrap().leading().unwrap();
    let bound = own.uncertainty + other.uncertainty;
    assert!((own.growth_rate - other.growth_rate).abs() < bound, "{own:?} {other:?}");
}

#[test]
fn an_oscillator_that_sticks_and_slips_agrees_with_integration_from_event_to_event() {
    let case = oscillator(folder().path(), &[]);
    let results = cycles(&case);
    assert_eq!(results.len(), 1);
    let motion = &found(&results[0]).motion;
    let reference = EventDriven::new(&case);
    let (frequency, stick) = reference.run([1e-6, 1e-6, 0.0, 0.0], 1.2e-8, 120, 20).unwrap();
    // A node comes to rest or leaves it at a step of 2.5e-9 s, half a step late each time.
    near(motion.frequency_hz, frequency, 1e-4);
    assert!((motion.fractions[0] - stick).abs() < 1e-3, "{:?} {stick}", motion.fractions);
    assert!(stick > 0.02, "{stick}");
}
