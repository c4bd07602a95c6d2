//! Transients of solid bodies that are tied together and slide on each other.

use crate::prelude::*;

const DAMPING: RayleighDamping = rayleigh_damping(50.0, 1e-7);

const FRICTION: f64 = 0.4;

/// Normal stiffness and law; none in rigid contact.
type Springs = (Option<f64>, Option<NormalLaw>);

/// A block with a plate of `plate` elements glued to it, pressed onto another block that moves under it.
fn mesh(plate: [usize; 3]) -> Mesh {
    bodies([[4, 3, 2], [5, 4, 2], plate], true)
}

/// The same of as many elements for each body, with or without the block below.
fn bodies([lower, upper, plate]: [[usize; 3]; 3], with_lower: bool) -> Mesh {
    let block = |name, height: f64, thickness: f64, counts| {
        brick(name, [0.0, 0.0, height], [0.05, 0.04, thickness], counts)
    };
    let lower = block("lower", 0.0, 0.02, lower);
    let upper = [block("upper", 0.02, 0.015, upper), block("plate", 0.035, 0.005, plate)];
    let blocks: Vec<Block> = with_lower.then_some(lower).into_iter().chain(upper).collect();
    let held = Fixed([true, true, false]);
    let conditions = [("plate_x0", held), ("plate_z1", Pressure(2e6)), ("lower_z0", Clamped)];
    let conditions = &conditions[..if with_lower { 3 } else { 2 }];
    mesh_of(&file_of(&blocks, |point| point), conditions)
}

/// The upper block and its plate on a rigid plane that turns as the lower block does, pushed in by twice what the load presses.
fn on_rigid_plane(mesh: &Mesh, springs: Springs, speed: f64) -> Assembly<'_> {
    let plane = flat(RigidMotion::Turning(speed), [0.02, -0.2, 0.0], 5e-7);
    between(mesh, &STEEL, Counterpart::Rigid(plane), springs, (None, &[]))
}

fn assembly<'a>(
    mesh: &'a Mesh,
    materials: &'a dyn MaterialField,
    springs: Springs,
    decay: Option<FrictionDecay>,
    speed: f64,
) -> Assembly<'a> {
    let region = mesh.regions.iter().position(|name| name == "lower");
    let (axis, center) = ([0.0, 0.0, 1.0], [0.02, -0.2, 0.0]);
    let regions = vec![region.unwrap()];
    let motion = Motion { regions, axis, center, rotation_speed: speed, inertia: None };
    let lower = Counterpart::Surface(boundary(mesh, "lower_z1"));
    between(mesh, materials, lower, springs, (decay, &[motion]))
}

/// The upper block on what it slides on, glued to the plate.
fn between<'a>(
    mesh: &'a Mesh,
    materials: &'a dyn MaterialField,
    counter: Counterpart,
    (normal_stiffness, law): Springs,
    (decay, motions): (Option<FrictionDecay>, &[Motion]),
) -> Assembly<'a> {
    let mut contact = contact_of(mesh, "upper_z0", counter, normal_stiffness);
    contact.friction.decay = decay;
    contact.stiffness.law = law;
    let (tie, solved) = (tie(mesh, "upper_z1", "plate_z0"), BaseChoice::Solved);
    let surfaces = (&[tie][..], &[contact][..]);
    Assembly::new(mesh, materials, surfaces, (motions, solved), Lumped).unwrap()
}

fn model<'a>(assembly: &'a Assembly<'a>) -> TransientModel<'a> {
    let axis = [[0.02, -0.2, 0.0], [0.0, 0.0, 1.0]];
    let contact = sliding_at(FRICTION, 0.0, 10.0);
    let body = SteppedBody::Assembly { assembly, axis };
    TransientModel::new(body, assembly.materials, DAMPING, contact)
}

fn settings(initial: InitialState, duration: f64, noise: f64) -> TransientSettings {
    let perturbation = Perturbation { noise, ..Perturbation::default() };
    transient_settings([duration, 2e-6, 1e-4], initial, perturbation)
}

fn run(assembly: &Assembly<'_>, settings: &TransientSettings) -> (Recorder, f64) {
    let mut run = started(model(assembly), OperatorChoice::Auto, settings);
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();
    (record, run.fields().velocity.iter().fold(0.0, |most, v| v.abs().max(most)))
}

/// The modes of the eigenvalue analysis, with the lumped mass of the transient.
fn modes(assembly: &Assembly<'_>, count: usize) -> Vec<ComplexMode> {
    let options =
        TangentOptions { mass: Lumped, damping: DAMPING, damping_model: BodyOnly, ..TANGENT };
    // The eigenvalue analysis starts without friction: stiffness that depends on friction is known there too.
    let range = assembly.range(&[FRICTION, 0.0], &Default::default()).unwrap();
    let state = &range.states[range.state_of[0]];
    let tangent = assembly.tangent(state, &options).unwrap();
    let at = [FRICTION];
    let request = SweepRequest { shapes_at: &at, ..sweep_request(&at, Lowest(count)) };
    sparse::sweep(&tangent, &request, &|_| {}).unwrap().points.swap_remove(0).modes
}

/// Cross-method: what the mass of a tie whose meshes do not match goes to is the same in both analyses.
#[test]
fn an_assembly_of_meshes_that_do_not_match_grows_from_its_mode() {
    let mesh = mesh([4, 3, 1]);
    let decay = FrictionDecay { static_ratio: 4.0, decay_speed: 1.0 };
    for springs in SPRINGS {
        let assembly = assembly(&mesh, &STEEL, springs, Some(decay), 10.0);
        grows_from(model(&assembly), fastest(&modes(&assembly, 12)));
    }
}

/// Rigid contact, constant springs, and springs that stiffen to about the same at the pressure of 2 MPa.
const SPRINGS: [Springs; 3] =
    [(None, None), (Some(5e12), None), (Some(1e6 / 6e-7), Some(exponential(1e6, 6e-7)))];

/// Independent: the base state of the eigenvalue analysis, through a tie and a contact whose meshes do not match, is at rest.
#[test]
fn steady_sliding_of_an_assembly_is_an_equilibrium_of_its_transient() {
    let mesh = mesh([4, 3, 1]);
    for springs in SPRINGS {
        let assembly = assembly(&mesh, &STEEL, springs, None, 10.0);
        let (record, speed) = run(&assembly, &settings(InitialState::SteadySliding, 1e-4, 0.0));
        let counts = record.rows.last().unwrap().counts;
        let state = &assembly.range(&[FRICTION], &Default::default()).unwrap().states[0];
        let pressed = state.is_pressed.iter().filter(|pressed| **pressed);
        let open = state.is_pressed.len() - pressed.count();
        // Sliding at 2 m/s; round-off of the pressed displacement over a step.
        assert!(speed < 1e-7, "{springs:?}: {speed:e}");
        // Over the steps of a sample.
        let points = (counts.slip + counts.open) as usize / state.is_pressed.len();
        assert_eq!((counts.stick, counts.open as usize), (0, points * open));
    }
}

/// Theory: what the loads, friction and damping do is in the energy, through impacts, stick and lift-off. Consistency: a run that goes on
/// from a saved state is the same, bit by bit, as one that never stopped.
#[test]
fn the_energy_of_an_assembly_closes_from_rest_to_sliding_and_a_run_goes_on_bit_by_bit() {
    let mesh = mesh([4, 3, 1]);
    for springs in SPRINGS {
        let assembly = assembly(&mesh, &STEEL, springs, None, 0.05);
        let (record, _) = run(&assembly, &settings(InitialState::Rest, 1e-3, 0.05));
        let seen = |of: fn(&StatusCounts) -> u64| record.rows.iter().any(|row| of(&row.counts) > 0);
        assert!(seen(|own| own.stick) && seen(|own| own.slip) && seen(|own| own.open));
        below(TransientAnalysis::without_symmetry(&record).largest_residual, 1e-11, "residual");
        assert_eq!(record.unconverged_steps, 0);
        goes_on_to_the_same_bits(&assembly, InitialState::Rest);
    }
}

/// Independent: the base state under load and interference is at rest; what pushing a rigid plane does is in the energy.
#[test]
fn a_block_on_a_rigid_plane_rests_in_its_base_state_and_its_energy_closes() {
    let mesh = bodies([[4, 3, 2], [5, 4, 2], [4, 3, 1]], false);
    for springs in SPRINGS {
        let still = on_rigid_plane(&mesh, springs, 10.0);
        let (record, speed) = run(&still, &settings(InitialState::SteadySliding, 1e-4, 0.0));
        assert!(speed < 1e-7, "{speed:e}");
        assert_eq!(record.rows.last().unwrap().counts.stick, 0);
        let slow = on_rigid_plane(&mesh, springs, 0.05);
        let (record, _) = run(&slow, &settings(InitialState::Rest, 1e-3, 0.05));
        let residual = TransientAnalysis::without_symmetry(&record).largest_residual;
        below(residual, 1e-11, format_args!("{springs:?}: {speed:e} m/s, residual"));
        // So it does from the powers that the samples list.
        let energy = |row: &SampleRow| row.kinetic_energy + row.strain_energy + row.contact_energy;
        let most = record.rows.iter().map(energy).fold(0.0, f64::max);
        for pair in record.rows.windows(2) {
            let (own, lost) = (&pair[1].powers, pair[1].material_damping);
            let power = own.stick + own.slide + own.normal + own.pressure - own.damping - lost;
            let left = energy(&pair[1]) - energy(&pair[0]) - power * record.sample_interval;
            below(left.abs(), 1e-12 * most, "energy that no column has");
            assert!(own.pressure != 0.0);
        }
        assert_eq!(record.unconverged_steps, 0);
    }
}

/// Theory (Gershgorin): dashpots that outweigh the frequencies of the body bound the step, by the sums of their rows.
#[test]
fn heavy_dashpots_of_a_support_bound_the_step() {
    let mut mesh = mesh([4, 3, 1]);
    let held = boundary(&mesh, "plate_x0");
    let dashpot = 1e9;
    mesh.boundaries[held].condition = support([1e10, 1e10, 0.0], [dashpot, dashpot]);
    let assembly = assembly(&mesh, &STEEL, SPRINGS[0], None, 0.05);
    let operator = model(&assembly).operator(OperatorChoice::Auto, SimdLevel::Scalar).unwrap();
    let settings = settings(InitialState::Rest, 1e-4, 0.05);
    let plan = model(&assembly).plan(operator.as_ref(), &settings).unwrap();
    // Nodes of the face carry half an element of 12.5 mm.
    let rate = dashpot / (STEEL.density * 0.5 * 0.0125);
    assert!((0.5 * plan.limit * rate - 1.0).abs() < 0.1, "{} {rate}", plan.limit);
    let (record, speed) = run(&assembly, &settings);
    assert!(record.rows.iter().all(|row| row.balance_residual < 1e-11));
    // The load gives it some centimetres a second, an unstable step no bound.
    assert!(speed < 1.0, "{speed}");
}

/// Runs an assembly in one and in two parts; the state between these.
fn goes_on_to_the_same_bits(assembly: &Assembly<'_>, initial: InitialState) -> TransientState {
    let [first, whole] = [2e-4, 4e-4].map(|end| settings(initial, end, 0.05));
    goes_on(model(assembly), OperatorChoice::Auto, [&first, &whole])
}

/// Independent: a vibration grows at the rate and frequency of the eigenvalue analysis, which has matrices of its own.
#[test]
fn a_vibration_of_an_assembly_grows_as_its_eigenvalue_says() {
    // Lumped masses are the same before and after the tie is eliminated where its meshes match.
    let mesh = mesh([5, 4, 1]);
    let decay = FrictionDecay { static_ratio: 4.0, decay_speed: 1.0 };
    for springs in sized(&SPRINGS[..1], &SPRINGS).iter().copied() {
        let assembly = assembly(&mesh, &STEEL, springs, Some(decay), 10.0);
        let settings = settings(InitialState::SteadySliding, 4e-3, 1e-6);
        grows_as_one_of(&modes(&assembly, 40), &run(&assembly, &settings).0);
    }
}

/// Compares the strongest vibration of a record with the mode next to it, which it gives: several grow.
fn grows_as_one_of(modes: &[ComplexMode], record: &Recorder) -> [f64; 2] {
    let analysis = TransientAnalysis::without_symmetry(record);
    let stage = analysis.growth[0].stage.as_ref().unwrap();
    let found = [stage.rate_per_s.value, stage.frequency_hz.value.abs()];
    let expected = nearest(modes, found[1]);
    assert!(analysis.largest_residual < 1e-10);
    near(found[0], expected[0], 0.01);
    near(found[1], expected[1], 1e-3);
    expected
}

/// Growth (1/s) and frequency (Hz) of the mode next to a frequency.
fn nearest(modes: &[ComplexMode], frequency_hz: f64) -> [f64; 2] {
    let own = nearest_by(modes, |mode| (mode.frequency_hz() - frequency_hz).abs());
    [TAU * own.real_hz(), own.frequency_hz()]
}

/// Band of the losses, Hz.
const BAND: [f64; 2] = [200.0, 2e5];

/// Materials in time, a chain for the losses of the upper block, and those of the eigenvalue analysis, with its modulus as a table.
fn losing(mesh: &Mesh) -> [Vec<RegionMaterial>; 2] {
    let upper = mesh.regions.iter().position(|name| name == "upper").unwrap();
    let chain = || MaxwellChain::fit(&|_| c64::new(1.0, 0.01), BAND);
    let count = mesh.regions.len();
    let in_time = |region| RegionMaterial::in_time(&STEEL, region, (region == upper).then(chain));
    let table = modulus_table(&chain(), STEEL.young_modulus, BAND);
    let lossy = ElasticMaterial { young_modulus: table.static_modulus(), ..STEEL };
    let mut materials = vec![RegionMaterial::from(STEEL); count];
    materials[upper] = RegionMaterial { table: Some(Arc::new(table)), ..lossy.into() };
    [(0..count).map(in_time).collect(), materials]
}

/// Cross-method: with a Maxwell chain in the upper block a vibration grows as the eigenvalue with the modulus of its own frequency,
/// another rate than without losses, and energy of springs and dashpots are in the balance; a run goes on to the same bits.
#[test]
fn losses_of_an_assembly_slow_its_growth_as_the_eigenvalue_says() {
    let coarse = [[3, 2, 2], [4, 3, 2], [4, 3, 1]];
    let mesh = bodies(sized(coarse, [[4, 3, 2], [5, 4, 2], [5, 4, 1]]), true);
    let [in_time, tabled] = losing(&mesh);
    let decay = Some(FrictionDecay { static_ratio: 4.0, decay_speed: 1.0 });
    let springs = SPRINGS[1];
    let count = sized(12, 40);
    let lossless = modes(&assembly(&mesh, &STEEL, springs, decay, 10.0), count);
    let expected = modes(&assembly(&mesh, &tabled, springs, decay, 10.0), count);
    let stepped = assembly(&mesh, &in_time, springs, decay, 10.0);
    let whole = settings(InitialState::SteadySliding, sized(3e-3, 4e-3), 1e-6);
    let [rate, frequency] = grows_as_one_of(&expected, &run(&stepped, &whole).0);
    let [without, _] = nearest(&lossless, frequency);
    println!("{rate} 1/s, {without} 1/s without losses");
    assert!(without > 1.02 * rate, "{rate} {without}");
    let half = goes_on_to_the_same_bits(&stepped, InitialState::SteadySliding);
    assert!(half.relaxation.iter().flatten().any(|z| *z != 0.0));
}
