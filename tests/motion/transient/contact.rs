//! The contact law, the steady start, and an exact impact.

use super::*;

/// Theory: the laws of Signorini and Coulomb at every node of every step.
#[test]
fn multipliers_obey_signorini_and_coulomb_at_every_step() {
    let annulus = disc(30, 6);
    for rpm in [610.0, -610.0] {
        let model = model(&annulus, rpm);
        let mut run = started(model, OperatorChoice::Auto, &kicked(3e-3, &[1, 2], 2.0));
        let surface_speed = model.contact.rotation_speed * 0.0205;
        let mut seen = [0; 3];
        while run.steps_done() < 10_000 {
            run.advance();
            let time = run.steps_done() as f64 * run.plan().time_step;
            let expansion = 25e-6 * (time / 1e-4).min(1.0);
            let (contact, fields) = (run.contact(), run.fields());
            for i in 0..contact.status.len() {
                let [normal, tangential] = contact.places(i);
                let displacement = fields.displacement[normal];
                let speed = fields.velocity[tangential];
                let (normal, tangential) = (contact.normal_force[i], contact.tangential_force[i]);
                let gap = displacement - expansion;
                seen[contact.status[i] as usize] += 1;
                match contact.status[i] {
                    ContactStatus::Open => assert!([normal, tangential] == [0.0; 2] && gap >= 0.0),
                    ContactStatus::Stick => {
                        assert!(normal > 0.0 && tangential.abs() <= 0.3 * normal);
                        // Rounding of the forces times dt / m.
                        assert!(gap.abs() < 1e-17 && (speed - surface_speed).abs() < 1e-10);
                    }
                    ContactStatus::Slip => {
                        assert!(normal > 0.0 && gap.abs() < 1e-17);
                        assert!((tangential.abs() - 0.3 * normal).abs() <= 1e-15 * normal);
                        // Friction drags the node towards the surface's speed.
                        assert!(tangential * (surface_speed - speed) > 0.0);
                    }
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 1000), "{seen:?}");
    }
}

/// Exact: rigid contact holds two bodies together, and what a sticking node has along the sliding is the speed between them.
#[test]
fn gap_and_velocity_of_a_node_between_two_bodies_are_those_over_the_other_body() {
    let specification = crate::disc::on_shaft(disc(30, 6).specification, 2);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let model = model(&annulus, 610.0);
    let mut run = started(model, OperatorChoice::Auto, &kicked(3e-3, &[1, 2], 2.0));
    let mut seen = [0; 3];
    while run.steps_done() < 5_000 {
        run.advance();
        if run.steps_done() as f64 * run.plan().time_step < 1.1e-4 {
            continue;
        }
        let (contact, fields) = (run.contact(), run.fields());
        for (i, status) in contact.status.iter().enumerate() {
            seen[*status as usize] += 1;
            let gap = contact.gap(i, &fields.displacement, 1.0);
            let [_, speed] = contact.relative(i, &fields.velocity);
            let is_open = *status == ContactStatus::Open;
            assert!(if is_open { gap >= -1e-17 } else { gap.abs() < 1e-16 }, "{gap:e}");
            let is_held = (speed - contact.counterface_speed(i)).abs() < 1e-9;
            assert!(is_held || *status != ContactStatus::Stick);
        }
    }
    assert!(seen.iter().all(|&count| count > 0), "{seen:?}");
}

/// Cross-method: the static solver's sliding state is a rest point of the time loop, on springs and contact that stiffens too.
#[test]
fn steady_sliding_start_stays_in_equilibrium() {
    let annulus = disc(36, 7);
    let springs = |normal_stiffness| ContactStiffness { normal_stiffness, ..RIGID };
    // The static solution is good to 1e-12; the balance of 1e-14 m against dt^2 N / m leaves 1e-9, and more on springs.
    for (contact, stiffness, bound) in [
        (contact(600.0), RIGID, 1e-8),
        (falling(610.0), RIGID, 1e-8),
        (falling(610.0), springs(Some(1e11)), 1e-6),
        (falling(610.0), springs(Some(7.4e12)), 1e-6),
        (contact(610.0), stiffening(LAWS[0]), 1e-8),
        (contact(610.0), stiffening(LAWS[1]), 1e-8),
    ] {
        let model = on_contact(&annulus, contact, stiffness);
        let initial = InitialState::SteadySliding;
        let settings = TransientSettings { initial, ..settings(1e-3, &[]) };
        let mut run = started(model, OperatorChoice::Auto, &settings);
        let mesh = &annulus.mesh;
        let body = Assembly::of_edge(mesh, model.material, &contact, stiffness).unwrap();
        let exact = body.state(0.3).unwrap().normal_forces(0.3);
        let torque = ContactInterface::of(mesh).torque(&contact, 0.3, &exact);
        let power = torque * contact.rotation_speed;
        watch(&mut run, |sample| {
            near_each(&sample.contact().normal_force, &exact, bound);
            assert_eq!([sample.row.counts.stick, sample.row.counts.open], [0, 0]);
            near(sample.row.powers.external, power, bound);
        });
    }
}

/// Theory: a bar of length L, clamped at its far end, hits a rigid wall with its near end at speed V. The
/// contact pressure is rho c V at once and stays until the wave released at the clamped end arrives,
/// L / c later; then the bar leaves the wall with speed V. The bar is a thin ring of large radius.
#[test]
fn bar_rebounds_from_a_rigid_wall_as_one_dimensional_theory_says() {
    let (inner, length, speed) = (10.0, 0.02, 1.0);
    let specification = crate::disc::ring([inner, inner + length], Quad4, 360, 200);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let mut model = model(&annulus, 0.0);
    model.damping = RayleighDamping::default();
    model.contact = sliding_at(0.0, 0.0, 0.0);
    let [lambda, shear] = model.material.of(0).lame_constants();
    let density = model.material.of(0).density;
    let wave_speed = ((lambda + 2.0 * shear) / density).sqrt();
    let crossing = length / wave_speed;
    let operator = model.operator(OperatorChoice::Cyclic, SimdLevel::detect()).unwrap();
    let mut settings = settings(1.5 * crossing, &[]);
    settings.sample_interval = crossing / 400.0;
    settings.expansion_time = 0.0;
    settings.time_step = TimeStep::Auto;
    // Every node but the clamped ones moves inwards.
    let mut state = CentralDifference::start(model, operator.as_ref(), &settings).unwrap().state();
    let masses = lumped_masses(&annulus.mesh, model.material);
    let held = &annulus.mesh.boundary("outer").unwrap().nodes;
    for node in (0..masses.len()).filter(|&node| !held.contains(&(node as u32))) {
        state.velocity[2 * node] = -speed;
        state.account.initial += 0.5 * masses[node] * speed * speed;
    }
    state.account.largest = state.account.initial;
    let mut run = CentralDifference::resume(model, operator.as_ref(), &settings, &state).unwrap();
    let edge: f64 = annulus.mesh.contact_edge().tributary_lengths.iter().sum();
    let (mut last_contact, mut impulse, mut plateau) = (0.0, 0.0, Vec::new());
    let dt = run.plan().time_step;
    while run.steps_done() < run.plan().total_steps() {
        let time = run.steps_done() as f64 * dt;
        run.advance();
        let pressure = run.contact().normal_force.iter().sum::<f64>() / edge;
        impulse += pressure * dt;
        if pressure > 0.0 {
            last_contact = time;
        }
        if time > 0.2 * crossing && time < 0.8 * crossing {
            plateau.push(pressure);
        }
    }
    let impedance = density * wave_speed * speed;
    let mean = plateau.iter().sum::<f64>() / plateau.len() as f64;
    // The ring's curvature changes everything by L / r = 0.2 %; a front is smeared over a few of 200 elements.
    let found = [mean / impedance, impulse / (impedance * crossing), last_contact / crossing];
    for (share, bound) in found.into_iter().zip([4e-3, 1e-2, 3e-2]) {
        assert!((share - 1.0).abs() < bound, "pressure, impulse, contact time: {found:?}");
    }
}

/// Cross-method: a node that a guide holds along the sliding slips on the plane that moves under it, and the plane takes the power of its
/// friction, as in the base state of the eigenvalue analysis.
#[test]
fn a_node_that_is_held_along_the_sliding_slips_with_its_friction() {
    let set = ["boundaries.side.condition=guide ; contact.friction_coefficient=0.1 ; \
         cea.friction_coefficients=[0.1] ; transient.duration=2e-5 ; transient.initial=steady-sliding"];
    let run = |command: &str| {
        Run::of(command, shipped("sliding-block.toml")).out("out").set(&set).done().summary()
    };
    let (base, transient) = (run("cea"), run("transient"));
    assert_eq!(base["base_state"]["slipping"], 33);
    assert_eq!(transient["status"]["slip"], 1.0);
    let base = base["base_state"]["power_w"].as_f64().unwrap();
    near(transient["power_w"]["external"].as_f64().unwrap(), base, 1e-9);
}

/// Theory: in space such a node moves across the sliding; at slow and at fast sliding `T = mu N v / |v|` with the mean slip of the step `v`.
#[test]
fn a_node_of_a_solid_that_is_held_along_the_sliding_drags_along_its_slip() {
    let block = [brick("block", [0.0; 3], [0.04, 0.03, 0.02], [3, 2, 2])];
    let file = file_of(&block, |point| point);
    let text = include_str!("../../cases/block-under-falling-friction.toml");
    let guided = "boundaries.block_x1.condition=guide ; transient.duration=0.01";
    for speed in [0.01, 1.0] {
        let changes = [guided.to_owned(), format!("contact.speed={speed:?}")];
        let case = case_beside("held-in-space", &[("body.msh", &file)], text, &changes);
        let study = TransientStudy::new(&case, SimdLevel::detect()).unwrap();
        let noise = Perturbation { noise: 0.1, ..Perturbation::default() };
        let settings = transient_settings([1e-4, 1e-4, 0.0], InitialState::SteadySliding, noise);
        let mut run = started(study.body(), OperatorChoice::Auto, &settings);
        let nodes = &study.body().interface().nodes;
        let mesh = case.body.mesh().unwrap();
        let held: Vec<usize> =
            (0..nodes.len()).filter(|&i| mesh.nodes[nodes[i] as usize][0] > 0.039).collect();
        assert_eq!(held.len(), 3);
        for _ in 0..200 {
            let before = run.state().velocity;
            run.advance();
            let (after, contact) = (run.state().velocity, run.contact());
            for &i in &held {
                let normal = contact.normal_force[i];
                if normal == 0.0 {
                    continue;
                }
                assert_eq!(contact.status[i], ContactStatus::Slip);
                let across = 3 * nodes[i] as usize + 1;
                let slip = [speed, -0.5 * (before[across] + after[across])];
                let size = slip[0].hypot(slip[1]);
                let friction = 0.3 * (1.0 + 0.3 * (-size / 0.5_f64).exp()) * normal;
                let found = [contact.tangential_force[i], contact.across_force[i]];
                within(&found, &slip.map(|slip| friction * slip / size), 1e-9 * friction);
            }
        }
    }
}
