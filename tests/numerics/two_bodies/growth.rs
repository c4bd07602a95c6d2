//! The linear stage of the transient between meshes that do not match, against the eigenvalues of the same bodies.

use super::*;

/// Size of the seeded mode, m: a slip speed a thousandth of the sliding, and far above the short waves, which grow faster, out
/// of round-off.
const SEED: f64 = 1e-8;

/// Cross-method check: a mode that is seeded as the eigenvalue analysis has it grows as that says.
#[test]
fn a_mode_of_two_bodies_whose_meshes_do_not_match_grows_as_its_eigenvalue_says() {
    let brass = elastic(1e11, 0.35, 8500.0, PlaneStrain);
    let mesh = rings([40, 48], [3, 9], 0.05);
    for shaft in [POLYCARBONATE, brass] {
        let materials = [POLYCARBONATE, shaft].map(RegionMaterial::from).to_vec();
        assert_eq!(mesh.regions, ["disc", "shaft"]);
        let options = options(Lumped, false);
        let tangent = linearized(&mesh, &materials, &contact(610.0), &options);
        let limit = Lowest(12);
        let request = SweepRequest { shapes_at: &[0.3], ..sweep_request(&[0.3], limit) };
        let found = sweep(&tangent, &request, &|_| {}).unwrap().points.remove(0).modes;
        let mode = fastest(&found);
        assert!(mode.eigenvalue.re > 0.0);
        let shape = mode.shape.as_ref().unwrap();
        let (record, harmonic) = run(&mesh, &materials, mode.eigenvalue, shape);
        let analysis = TransientAnalysis::of(&record, &[harmonic]);
        assert_eq!(analysis.first_nonlinearity, None);
        grows_as(&record, harmonic, mode.eigenvalue, 1e-3);
    }
}

/// A transient from steady sliding and `Re(shape e^(lambda t))`, with the harmonic of the edge in which it moves most.
fn run(
    mesh: &Mesh,
    materials: &Vec<RegionMaterial>,
    eigenvalue: c64,
    shape: &[c64],
) -> (Recorder, usize) {
    let body = SteppedBody::Plane { mesh, annulus: None };
    let model = TransientModel::new(body, materials, DAMPING, contact(610.0));
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let (initial, none) = (InitialState::SteadySliding, Perturbation::default());
    let settings = transient_settings([0.004, 4e-6, 0.0], initial, none);
    let step = model.plan(operator.as_ref(), &settings).unwrap().time_step;
    let bodies = Assembly::of_edge(mesh, materials, &contact(610.0), RIGID).unwrap();
    let mut displacement = bodies.state(0.3).unwrap().displacement(0.3);
    let pairs = displacement.iter_mut().zip(shape);
    pairs.for_each(|(u, phi)| *u += SEED * phi.re);
    // Half a step earlier.
    let rate = SEED * eigenvalue * (-0.5 * step * eigenvalue).exp();
    let velocity = shape.iter().map(|phi| (rate * phi).re).collect();
    let operator = operator.as_ref();
    let mut run =
        CentralDifference::start_from(model, operator, &settings, &displacement, velocity).unwrap();
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();
    let last = &record.rows.last().unwrap().harmonics;
    let size = |n: &usize| last[*n][0].hypot(last[*n][1]);
    let harmonic = (1..last.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
    (record, harmonic)
}
