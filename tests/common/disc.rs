//! The paper's disc: geometry, material, damping and contact. Poisson's ratio and density are a fit to its Table 1.

use super::prelude::*;

pub const POLYCARBONATE: ElasticMaterial = elastic(2.5e9, 0.3805, 1228.0, PlaneStrain);

pub const DAMPING: RayleighDamping = rayleigh_damping(40.0, 4.5e-7);

/// An even mesh of the disc.
pub fn annulus(element: ElementKind, around: usize, radial: usize) -> AnnulusSpecification {
    ring([0.0205, 0.0905], element, around, radial)
}

pub fn ring(
    [inner_radius, outer_radius]: [f64; 2],
    element: ElementKind,
    circumferential: usize,
    radial: usize,
) -> AnnulusSpecification {
    AnnulusSpecification {
        inner_radius,
        outer_radius,
        circumferential_elements: circumferential,
        radial_elements: radial,
        radial_grading: 1.0,
        element,
        outer: Clamped,
        shaft: None,
    }
}

/// The cylinder with friction that falls over speeds of the order of its own, 1.31 m/s at 610 rpm.
pub fn falling(rotation_speed_rpm: f64) -> SlidingContact {
    let decay = Some(FrictionDecay { static_ratio: 1.5, decay_speed: 0.8 });
    SlidingContact { decay, ..contact(rotation_speed_rpm) }
}

/// The cylinder at friction coefficient 0.3.
pub fn contact(rotation_speed_rpm: f64) -> SlidingContact {
    sliding_at(0.3, 25e-6, rotation_speed_rpm * PI / 30.0)
}

/// Rigid contact without dashpots.
pub const RIGID: ContactStiffness = ContactStiffness {
    law: None,
    law_damping: 0.0,
    loss_factor: 0.0,
    normal_stiffness: None,
    normal_damping: 0.0,
    tangential_damping: 0.0,
    is_base_compliant: false,
};

/// The disc's linearisation without the stress of its base state.
pub const TANGENT: TangentOptions = TangentOptions {
    mass: MassKind::Consistent,
    geometric_stiffness: false,
    damping: DAMPING,
    damping_model: DampingModel::WholeTangent,
    contact: RIGID,
};

/// The same with springs, N/m for each square metre, and dashpots along the normal and the sliding.
pub const fn compliant(normal_stiffness: f64, [normal, tangential]: [f64; 2]) -> ContactStiffness {
    ContactStiffness {
        normal_stiffness: Some(normal_stiffness),
        normal_damping: normal,
        tangential_damping: tangential,
        ..RIGID
    }
}

pub const fn exponential(reference_pressure: f64, height: f64) -> NormalLaw {
    NormalLaw::Exponential { reference_pressure, height }
}

pub const fn cubic(stiffness: f64, cubic_stiffness: f64) -> NormalLaw {
    NormalLaw::Cubic { stiffness, cubic_stiffness }
}

/// Contact that stiffens with pressure.
pub fn stiffening(law: NormalLaw) -> ContactStiffness {
    ContactStiffness { normal_stiffness: Some(law.stiffness(0.0)), law: Some(law), ..RIGID }
}

/// A node of a response along the radius or around it.
pub fn at_node(node: usize, is_tangential: bool) -> Terminal {
    let direction = if is_tangential { Direction::Tangential } else { Direction::Radial };
    Terminal { node, direction }
}

/// Springs along the normal, the edge and the axis, of zero there those of the edge; dashpots along the normal and the edge.
pub const fn springs(stiffness: [f64; 3], dashpots: [f64; 2]) -> ElasticSupport {
    ElasticSupport {
        normal_stiffness: stiffness[0],
        tangential_stiffness: stiffness[1],
        axial_stiffness: if stiffness[2] > 0.0 { Some(stiffness[2]) } else { None },
        normal_damping: dashpots[0],
        tangential_damping: dashpots[1],
        loss_factor: 0.0,
    }
}

/// A boundary on such springs.
pub const fn support(stiffness: [f64; 3], dashpots: [f64; 2]) -> BoundaryCondition {
    BoundaryCondition::Support(springs(stiffness, dashpots))
}

/// Damping of the mass, 1/s, and of the stiffness, s.
pub const fn rayleigh_damping(mass: f64, stiffness: f64) -> RayleighDamping {
    RayleighDamping { mass_coefficient: mass, stiffness_coefficient: stiffness }
}

/// The disc on a deformable shaft with a clamped bore of 6 mm.
pub fn on_shaft(disc: AnnulusSpecification, radial_elements: usize) -> AnnulusSpecification {
    let shaft = ShaftSpecification { inner_radius: 0.006, radial_elements, bore: Clamped };
    AnnulusSpecification { shaft: Some(shaft), ..disc }
}

/// Young's modulus, Poisson's ratio and density.
pub const fn elastic(
    young_modulus: f64,
    poisson_ratio: f64,
    density: f64,
    formulation: PlaneFormulation,
) -> ElasticMaterial {
    ElasticMaterial { young_modulus, poisson_ratio, density, formulation, ..ElasticMaterial::PLAIN }
}

/// Steel of solid bodies.
pub const STEEL: ElasticMaterial = elastic(2e11, 0.3, 7850.0, PlaneFormulation::ThreeDimensional);

/// Constant friction.
pub const fn sliding_at(friction: f64, interference: f64, rotation_speed: f64) -> SlidingContact {
    SlidingContact { decay: None, friction_coefficient: friction, interference, rotation_speed }
}

/// Eigenvalues without shapes.
pub fn sweep_request(friction_coefficients: &[f64], limit: ModeLimit) -> SweepRequest<'_> {
    SweepRequest::new(friction_coefficients, limit)
}

/// Small motions around steady sliding, to friction coefficients of 0.4 where contact stiffens.
pub fn linearized(
    mesh: &Mesh,
    material: &dyn MaterialField,
    contact: &SlidingContact,
    options: &TangentOptions,
) -> SlidingTangent {
    let body = Assembly::of_edge(mesh, material, contact, options.contact).unwrap();
    body.tangent(&body.range(&[0.0, 0.4], &Default::default()).unwrap().states[0], options).unwrap()
}

/// Eigenvalues over friction.
pub fn swept(tangent: &SlidingTangent, frictions: &[f64], limit: ModeLimit) -> FrictionSweep {
    sparse::sweep(tangent, &sweep_request(frictions, limit), &|_| {}).unwrap()
}

/// Modes at one friction coefficient.
pub fn modes_at(tangent: &SlidingTangent, friction: f64, limit: ModeLimit) -> Vec<ComplexMode> {
    swept(tangent, &[friction], limit).points.into_iter().next().unwrap().modes
}

/// A run at its start; its operator lives as long as the tests.
pub fn started<'a>(
    model: TransientModel<'a>,
    choice: OperatorChoice,
    settings: &TransientSettings,
) -> CentralDifference<'a> {
    let operator = Box::leak(model.operator(choice, SimdLevel::detect()).unwrap());
    CentralDifference::start(model, operator, settings).unwrap()
}

/// A run from its start to its end: its record, and the largest residual of its energy.
pub fn recorded(
    model: TransientModel<'_>,
    choice: OperatorChoice,
    settings: &TransientSettings,
) -> (Recorder, f64) {
    let mut run = started(model, choice, settings);
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();
    (record, run.state().account.largest_residual)
}

/// Moduli and loss factors of a chain over a band, as a table has them.
pub fn modulus_table(chain: &MaxwellChain, modulus: f64, band: [f64; 2]) -> ModulusTable {
    let rows = (0..=400).map(|i| {
        let frequency = band[0] * (band[1] / band[0]).powf(f64::from(i) / 400.0);
        let ratio = chain.ratio(frequency);
        [frequency, modulus * ratio.re, ratio.im / ratio.re]
    });
    ModulusTable::new("materials.lossy.table", "chain.csv", rows.collect())
}

/// Holds a run in two parts to the bits of one in one; gives the state between these.
pub fn goes_on(
    model: TransientModel<'_>,
    choice: OperatorChoice,
    [first, whole]: [&TransientSettings; 2],
) -> TransientState {
    let operator = model.operator(choice, SimdLevel::detect()).unwrap();
    let ran = |mut run: CentralDifference<'_>| {
        let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
        run.run(&mut record).unwrap();
        run.state()
    };
    let half = ran(started(model, choice, first));
    let resumed = CentralDifference::resume(model, operator.as_ref(), whole, &half).unwrap();
    assert_eq!(ran(resumed), ran(started(model, choice, whole)));
    half
}

/// Holds the linear stage of a harmonic to the eigenvalue of a mode: its rate to 1 %, its frequency to a tolerance.
pub fn grows_as(record: &Recorder, harmonic: usize, expected: c64, tolerance: f64) {
    let analysis = TransientAnalysis::of(record, &[harmonic]);
    let stage = analysis.growth[0].stage.as_ref().unwrap();
    let found = c64::new(stage.rate_per_s.value, TAU * stage.frequency_hz.value.abs());
    let what = format!("n = {harmonic}: {found}, eigenvalue {expected}");
    assert!((found.re / expected.re - 1.0).abs() < 0.01, "{what}");
    assert!((found.im / expected.im.abs() - 1.0).abs() < tolerance, "{what}");
    assert!(analysis.largest_residual < 1e-10, "{what}, {:e}", analysis.largest_residual);
}

/// Looks at every sample.
pub struct Watch<F>(pub F);

impl<F: FnMut(&Sample<'_>)> Observer for Watch<F> {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        (self.0)(sample);
        ControlFlow::Continue(())
    }
}

/// Runs to the end, with a look at every sample.
pub fn watch(run: &mut CentralDifference<'_>, look: impl FnMut(&Sample<'_>)) {
    run.run(&mut Watch(look)).unwrap();
}

/// Holds growth and frequency of a body in steps of 0.1 us to those of the mode from which it starts; fields keep the mode's shape.
#[track_caller]
pub fn grows_from(model: TransientModel<'_>, mode: &ComplexMode) {
    let (lambda, shape) = (mode.eigenvalue, mode.shape.as_ref().unwrap());
    let duration = 4.0 * TAU / lambda.im;
    let (initial, none) = (InitialState::SteadySliding, Perturbation::default());
    let mut settings = transient_settings([duration, duration, 0.0], initial, none);
    settings.time_step = TimeStep::Seconds(1e-7);
    let operator = &*model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let step = model.plan(operator, &settings).unwrap().time_step;
    let base = model.sliding_displacement().unwrap();
    // Small against the compression, large against its round-off.
    let largest = base.iter().map(|u| u.abs()).fold(0.0, f64::max);
    let scale = 1e-5 * largest / shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let along = |factor: c64| shape.iter().map(move |x| scale * (factor * x).re);
    let start: Vec<f64> = base.iter().zip(along(c64::ONE)).map(|(u, x)| u + x).collect();
    let velocity = along(lambda * (-0.5 * step * lambda).exp()).collect();
    let mut run =
        CentralDifference::start_from(model, operator, &settings, &start, velocity).unwrap();
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();

    // The factor of the shape at the end, by least squares.
    let end = run.state();
    let moved: Vec<_> = end.displacement.iter().zip(&base).map(|(u, b)| (u - b) / scale).collect();
    let parts = DMatrix::from_fn(shape.len(), 2, |i, k| [shape[i].re, -shape[i].im][k]);
    let moved = DMatrix::from_vec(shape.len(), 1, moved);
    let factor = (parts.transpose() * &parts).lu().solve(&(parts.transpose() * &moved)).unwrap();
    let rest = (&moved - &parts * &factor).norm() / moved.norm();
    let time = end.step as f64 * step;
    let beyond = c64::new(factor[0], factor[1]) * (-time * lambda).exp();
    let found = lambda + c64::new(beyond.norm().ln(), beyond.arg()) / time;
    let residual = end.account.largest_residual;
    let what = format!("{found}, eigenvalue {lambda}, beside the shape {rest:e}, {residual:e}");
    println!("{what}, {:?}", record.rows.last().unwrap().counts);
    assert!((found.re / lambda.re - 1.0).abs() < 2e-3, "{what}");
    assert!((found.im / lambda.im - 1.0).abs() < 5e-4, "{what}");
    assert!(rest < 2e-3 && residual < 1e-10, "{what}");
}

/// A transient with the step that its model has: duration, interval of samples, time of the expansion.
pub fn transient_settings(
    times: [f64; 3],
    initial: InitialState,
    perturbation: Perturbation,
) -> TransientSettings {
    let [duration, sample_interval, expansion_time] = times;
    let time_step = TimeStep::Auto;
    TransientSettings {
        duration,
        time_step,
        sample_interval,
        expansion_time,
        initial,
        perturbation,
    }
}
