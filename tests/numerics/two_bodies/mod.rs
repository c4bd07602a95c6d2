//! Two deformable bodies of a mesh file against the built-in shaft, theory, and their own transient.

mod glued;
mod model;
mod sweeps;

use crate::prelude::*;
use model::{blocks_of, held_blocks, rectangle, ring, rings, rings_of};

/// Disc and shaft as built in, by sectors.
fn built_in(
    element: ElementKind,
    around: usize,
    radial: [usize; 2],
    geometric_stiffness: bool,
    count: usize,
) -> Vec<ComplexMode> {
    let model = WaveModel {
        specification: on_shaft(annulus(element, around, radial[1]), radial[0]),
        material: POLYCARBONATE,
        options: options(Consistent, geometric_stiffness),
        contact: contact(610.0),
    };
    model.modes(0.3, Lowest(count))
}

/// Both bodies from a file.
fn modes(mesh: &Mesh, geometric_stiffness: bool, count: usize) -> Vec<ComplexMode> {
    let options = options(Consistent, geometric_stiffness);
    let tangent = linearized(mesh, &POLYCARBONATE, &contact(610.0), &options);
    modes_at(&tangent, 0.3, Lowest(count))
}

/// Cross-method check: pairs of nodes in polar frames, and mortar weights in global axes.
#[test]
fn matching_bodies_of_a_file_have_the_spectrum_of_the_built_in_shaft() {
    let mesh = rings([24, 24], [2, 5], 0.0);
    for (geometric_stiffness, tolerance) in [(false, 1e-9), (true, 3e-4)] {
        let found = modes(&mesh, geometric_stiffness, 8);
        let expected = built_in(Quad4, 24, [2, 5], geometric_stiffness, 10);
        let error = largest_error(&eigenvalues_of(&expected), &eigenvalues_of(&found));
        // Slopes of the edge are those of its chords, not of its polar components.
        below(error, tolerance, geometric_stiffness);
    }
}

/// Order of convergence: that of the elements, whether nodes lie opposite or not, and errors of one size.
#[test]
fn non_matching_meshes_keep_the_order_of_convergence() {
    let exact = eigenvalues_of(&built_in(Quad8, 120, [10, 24], false, 10));
    let error = |around: [usize; 2], k: usize| {
        let mesh = rings(around.map(|count| count * k), [k, 2 * k], 0.03);
        largest_error(&exact, &eigenvalues_of(&modes(&mesh, false, 6)))
    };
    let levels = [2, 3, 4];
    let apart = levels.map(|k| error([10, 12], k));
    let matching = levels.map(|k| error([12, 12], k));
    let order = |errors: [f64; 3]| (errors[0] / errors[2]).log2();
    // Second order on finer meshes than these.
    assert!(order(apart) > order(matching) - 0.1, "{apart:?} {matching:?}");
    // Of the shaft's elements there are a sixth fewer.
    let mut pairs = apart.iter().zip(&matching);
    assert!(pairs.all(|(a, b)| a / b < 1.44), "{apart:?} {matching:?}");
}

/// Springs on the top of the upper block.
fn mounting() -> ElasticSupport {
    springs([1e11, 1e10, 0.0], [0.0, 0.0])
}

/// A block pressed on another by the springs on its top; the lower one, wider on both sides, is clamped below.
fn blocks(along: [usize; 2]) -> Result<Mesh, BodyError> {
    let lower = rectangle([-0.01, -0.02], [0.06, 0.02], [along[0], 3]);
    let upper = rectangle([0.0, 0.0], [0.04, 0.03], [along[1], 4]);
    held_blocks([lower, upper], Support(mounting()))
}

/// Patch test: through meshes of any two fineness a constant pressure passes as it is.
#[test]
fn a_constant_pressure_passes_between_meshes_that_do_not_match() {
    for along in [[6, 4], [7, 5], [13, 4], [5, 11]] {
        let mesh = blocks(along).unwrap();
        let interface = ContactInterface::of(&mesh);
        let mut forces: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        for i in 0..interface.len() {
            let force = 2e6 * interface.tributary_lengths[i];
            for &(dof, share) in &interface.opposite[i].moves[0] {
                let (node, component) = (dof / 2, dof % 2);
                let (sin, cos) = mesh.frame_angles()[node].sin_cos();
                let axis = [[cos, sin], [-sin, cos]][component];
                let sum = forces.entry(node).or_insert([0.0; 2]);
                (0..2).for_each(|c| sum[c] += force * share * axis[c]);
            }
        }
        // What unit pressure over the covered part of the lower edge gives to its nodes.
        let size = 0.06 / along[0] as f64;
        for (node, force) in forces {
            let x = mesh.nodes[node][0];
            let hat = |at: f64| (1.0 - ((at - x) / size).abs()).max(0.0);
            let width = 0.04 / 4000.0;
            let points = (0..4000).map(|k| (f64::from(k) + 0.5) * width);
            let exact: f64 = points.map(|at| 2e6 * width * hat(at)).sum();
            // The midpoint rule on hats.
            let tolerance = 1e-5 * 2e6 * size;
            assert!((force[1] - exact).abs() < tolerance, "{along:?} {x} {force:?} {exact}");
            assert!(force[0].abs() < tolerance);
        }
    }
}

/// Theory: without Poisson's effect and friction springs and the upper block give way in a row, whatever the meshes.
#[test]
fn a_block_on_a_block_of_another_mesh_is_pressed_alike_everywhere() {
    let material = ElasticMaterial { poisson_ratio: 0.0, ..POLYCARBONATE };
    let mesh = blocks([13, 5]).unwrap();
    // The lower block as stiff as nothing deforms.
    let stiff = ElasticMaterial { young_modulus: 1e9 * material.young_modulus, ..material };
    let materials = [stiff, material].map(RegionMaterial::from).to_vec();
    assert_eq!(mesh.regions, ["lower", "upper"]);
    let sliding = sliding_at(0.0, 1e-5, 1.0);
    let body = Assembly::of_edge(&mesh, &materials, &sliding, RIGID).unwrap();
    let forces = body.state(0.0).unwrap().normal_forces(0.0);
    // Springs and block in a row: `delta = p (1 / k + h / E)`.
    let expected = 1e-5 / (1.0 / mounting().normal_stiffness + 0.03 / material.young_modulus);
    let points = forces.iter().zip(&body.contacts()[0].1.points);
    let pressures: Vec<f64> = points.map(|(force, point)| force / point.weight).collect();
    within(&pressures, &vec![expected; pressures.len()], 1e-6 * expected);
}

/// Theory: the discrete energy identity holds whatever the sweeps over the contact leave.
#[test]
fn energy_closes_through_stick_and_opening_between_meshes_that_do_not_match() {
    let mesh = rings([20, 27], [2, 5], 0.1);
    let compliant = compliant(2e12, [1e4, 1e3]);
    for stiffness in [ContactStiffness::default(), compliant] {
        let body = SteppedBody::Plane { mesh: &mesh, annulus: None };
        let plain = TransientModel::new(body, &POLYCARBONATE, DAMPING, contact(610.0));
        let seeds = Perturbation::of(&[1, 2], 4.0);
        let settings = transient_settings([2e-3, 4e-6, 1e-4], InitialState::Rest, seeds);
        let model = TransientModel { stiffness, ..plain };
        let (record, _) = recorded(model, OperatorChoice::Auto, &settings);
        let seen = |of: fn(&StatusCounts) -> u64| record.rows.iter().any(|row| of(&row.counts) > 0);
        assert!(seen(|own| own.open) && seen(|own| own.stick));
        assert!(record.rows.iter().all(|row| row.balance_residual < 1e-11));
    }
}

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
