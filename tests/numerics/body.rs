//! Bodies of any plane shape: mesh files, supports, partial contact, transients (independent checks, unless a test says otherwise).

use crate::prelude::*;

pub fn options(mass: MassKind, geometric_stiffness: bool) -> TangentOptions {
    TangentOptions { mass, geometric_stiffness, ..TANGENT }
}

/// The disc of a file in units of `scale`.
fn imported(bytes: &[u8], scale: f64) -> Mesh {
    let held = [("outer", Clamped)];
    let specification = BodySpecification { scale, ..plane_body("inner", CYLINDER, None, &held) };
    Mesh::from_gmsh(&FileMesh::read(bytes).unwrap(), &specification).unwrap()
}

fn modes(mesh: &Mesh, options: &TangentOptions, contact: &SlidingContact) -> Vec<ComplexMode> {
    let tangent = linearized(mesh, &POLYCARBONATE, contact, options);
    modes_at(&tangent, contact.friction_coefficient, Lowest(8))
}

#[test]
fn every_form_of_the_file_reads_to_one_mesh() {
    for element in [Quad4, Quad8] {
        let mesh = AnnulusMesh::generate(&annulus(element, 12, 3)).unwrap().mesh;
        let read = FORMS.map(|form| FileMesh::read(&write_msh(&mesh, form, &[], |p| p)).unwrap());
        // Labels of elements differ between text and groups of bytes in nothing.
        assert!(read.iter().all(|file| *file == read[0]), "{element:?}");
        let body = imported(&write_msh(&mesh, FORMS[0], &[], |p| p), 1.0);
        let counts = |mesh: &Mesh| (mesh.node_count(), mesh.element_count());
        assert_eq!(counts(&body), counts(&mesh));
        let length = |mesh: &Mesh| mesh.contact_edge().tributary_lengths.iter().sum::<f64>();
        near(length(&body), length(&mesh), 1e-5);
    }
}

/// The imported disc has the spectrum of the generated one, also turned, renumbered and in millimetres.
#[test]
fn turned_renumbered_and_scaled_meshes_have_one_spectrum() {
    let mesh = AnnulusMesh::generate(&annulus(Quad8, 24, 4)).unwrap().mesh;
    let contact = contact(610.0);
    let options = options(Consistent, true);
    let eigenvalues = |mesh: &Mesh| eigenvalues_of(&modes(mesh, &options, &contact));
    let expected = eigenvalues(&mesh);
    let plain: Vec<usize> = (1..=mesh.node_count()).collect();
    let reversed: Vec<usize> = plain.iter().rev().copied().collect();
    let (sin, cos) = 0.3_f64.sin_cos();
    let turn = |[x, y]: [f64; 2]| [1e3 * (cos * x - sin * y), 1e3 * (sin * x + cos * y)];
    let same = imported(&write_msh(&mesh, FORMS[2], &plain, |p| p), 1.0);
    near_each(&eigenvalues(&same), &expected, 1e-9);
    let other = imported(&write_msh(&mesh, FORMS[1], &reversed, turn), 1e-3);
    near_each(&eigenvalues(&other), &expected, 1e-9);
}

/// A mesh whose elements run clockwise is turned over: the mirrored disc has the same spectrum under the opposite rotation.
#[test]
fn a_mesh_that_runs_clockwise_is_turned_over() {
    let (options, mesh) = (options(Consistent, true), annulus(Quad8, 48, 8));
    let mesh = AnnulusMesh::generate(&mesh).unwrap().mesh;
    let mirrored = imported(&write_msh(&mesh, FORMS[3], &[], |[x, y]| [x, -y]), 1.0);
    let eigenvalues = |mesh: &Mesh, rpm: f64| eigenvalues_of(&modes(mesh, &options, &contact(rpm)));
    near_each(&eigenvalues(&mirrored, -610.0), &eigenvalues(&mesh, 610.0), 1e-9);
}

fn supported(stiffness: f64) -> BoundaryCondition {
    support([stiffness, stiffness, 0.0], [0.0, 0.0])
}

/// Unstable modes of the disc on an elastic rim, from a prototype with quadratic elements in the radius and exact
/// waves around it (rigid contact, friction 0.3, no prestress): harmonic, Hz, growth / 2 pi.
#[test]
fn a_supported_rim_gives_the_sounds_of_the_prototype() {
    let soft = "1 5942 151 ; 2 7168 95 ; 1 9305 114 ; 2 10359 4 ; 1 15468 82 ; 2 15841 67";
    let rows = [
        (Clamped, "1 6883 110 ; 2 8761 93 ; 1 10314 173"),
        (supported(2.0e11), "1 6143 146 ; 2 7474 96 ; 1 9534 125 ; 1 15740 63 ; 2 16142 63"),
        (supported(1.5e11), soft),
    ];
    let material = ElasticMaterial { formulation: PlaneStress, ..POLYCARBONATE };
    for (outer, expected) in rows {
        let disc = annulus(Quad8, 96, 20);
        let specification = AnnulusSpecification { outer, ..disc };
        let options = options(Consistent, false);
        let model = WaveModel { specification, material, options, contact: contact(610.0) };
        let modes = model.modes(0.3, MaxFrequency(17000.0));
        for [harmonic, frequency, growth] in rows_of(expected) {
            let near = modes.iter().find(|mode| {
                mode.harmonic as f64 == harmonic
                    && (mode.frequency_hz() / frequency - 1.0).abs() < 2e-3
                    && (mode.real_hz() - growth).abs() < 3.0
            });
            assert!(near.is_some(), "{outer:?}: n = {harmonic}, {frequency} Hz, {growth}");
        }
    }
}

/// A rectangle of `nx` by `ny` four-node elements, its corner at the origin, with boundaries bottom, right, top, left.
pub fn rectangle(width: f64, height: f64, nx: usize, ny: usize) -> Vec<u8> {
    let grid = Grid::of([even(width, nx), even(height, ny)], ["bottom", "top"], &|_| "block");
    grids(&[Grid { sides: ["left", "right"], ..grid }])
}

fn block_specification() -> BodySpecification {
    plane_body("bottom", ALONG_X, None, &[("right", Guide), ("top", Pressure(1e6))])
}

/// The block at some friction coefficients, pushed in by so much: no node is pulled or penetrates, beyond these of the force and m, and the
/// plane drags it along with the friction of the whole force. Force, open nodes at each friction, and where the contact changes.
fn pressed(
    specification: &BodySpecification,
    (frictions, interference): (&[f64], f64),
    [pulled, deep]: [f64; 2],
) -> (Vec<(f64, usize)>, Vec<f64>) {
    let file = FileMesh::read(&rectangle(0.04, 0.06, 20, 30)).unwrap();
    let mesh = Mesh::from_gmsh(&file, specification).unwrap();
    let edge = ContactInterface::of(&mesh);
    let contact = sliding_at(0.3, interference, 1.5);
    let body = Assembly::of_edge(&mesh, &POLYCARBONATE, &contact, RIGID).unwrap();
    let range = body.range(frictions, &Default::default()).unwrap();
    let states = frictions.iter().zip(&range.state_of).map(|(friction, &k)| {
        let state = &range.states[k];
        let (forces, moved) = (state.normal_forces(*friction), state.displacement(*friction));
        let total: f64 = forces.iter().sum();
        for (i, force) in forces.iter().enumerate() {
            let gap = moved[2 * edge.nodes[i] as usize] - interference;
            assert!(*force >= -pulled * total && gap >= -deep, "{friction} {i} {force} {gap}");
            assert!(*force <= pulled * total || gap.abs() < deep, "{friction} {i} {force} {gap}");
        }
        let torque = edge.torque(&contact, *friction, &forces);
        assert!((torque - friction * total).abs() < 1e-9 * total);
        (total, state.is_pressed.iter().filter(|is| !**is).count())
    });
    (states.collect(), range.changes.clone())
}

/// A block that a pressure presses on a moving plane and a smooth stop holds is in balance, pressed everywhere.
#[test]
fn a_pressed_block_is_in_balance() {
    let frictions = [0.0, 0.1, 0.3, 0.6];
    for (total, open) in pressed(&block_specification(), (&frictions, 0.0), [1e-9, 1e-15]).0 {
        assert!((total / (1e6 * 0.04) - 1.0).abs() < 1e-8 && open == 0, "{total} {open}");
    }
}

/// On an elastic mounting the drag tilts the block: nodes open one by one as friction rises.
#[test]
fn a_block_on_an_elastic_mounting_lifts_a_corner_as_friction_rises() {
    let mut specification = block_specification();
    specification.conditions = vec![("top".to_owned(), support([1e12, 1e12, 0.0], [0.0, 0.0]))];
    // Round-off of the interpolation in the friction coefficient.
    let (states, changes) = pressed(&specification, (&[0.1, 0.3, 0.5], 1e-5), [1e-6, 1e-11]);
    let open: Vec<usize> = states.iter().map(|state| state.1).collect();
    assert!(open[0] == 0 && open[1] > 0 && open[2] > open[1], "{open:?}");
    assert!(changes.len() == 2 && changes.iter().all(|mu| (0.1..0.5).contains(mu)));
}

/// The eigenvalue's growth and frequency in the linear stage of a transient, on a disc whose hole is off centre.
#[test]
fn a_body_without_symmetry_grows_in_time_as_its_eigenvalue_says() {
    let mesh = AnnulusMesh::generate(&annulus(Quad4, 60, 12)).unwrap().mesh;
    // The rim moves by 5 mm, the hole stays.
    let shift = |[x, y]: [f64; 2]| {
        let depth = (x.hypot(y) - 0.0205) / 0.07;
        [x - 5e-3 * depth, y]
    };
    let body = imported(&write_msh(&mesh, FORMS[0], &[], shift), 1.0);
    let contact = contact(610.0);
    let found = modes(&body, &options(Lumped, false), &contact);
    let exact = fastest(&found);
    let stepped = SteppedBody::Plane { mesh: &body, annulus: None };
    let model = TransientModel::new(stepped, &POLYCARBONATE, DAMPING, contact);
    let seed = Perturbation::of(&[1, 2], 1e-12);
    let settings = transient_settings([0.03, 4e-6, 0.0], InitialState::SteadySliding, seed);
    let (mut record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    assert!(residual < 1e-10);
    // The second half of the linear stage, where the fastest mode is alone.
    record.rows.drain(..record.rows.len() / 2);
    grows_as(&record, 2, exact.eigenvalue, 1e-3);
}

/// Energy closes to round-off with supports, dashpots, pressure and a contact that opens.
#[test]
fn energy_closes_with_supports_pressure_and_partial_contact() {
    let file = FileMesh::read(&rectangle(0.04, 0.06, 8, 12)).unwrap();
    let mut specification = block_specification();
    specification.conditions[0].1 = support([1e11, 1e10, 0.0], [3e4, 1e4]);
    let mesh = Mesh::from_gmsh(&file, &specification).unwrap();
    let body = SteppedBody::Plane { mesh: &mesh, annulus: None };
    let damping = rayleigh_damping(40.0, 1e-7);
    let model = TransientModel::new(body, &POLYCARBONATE, damping, sliding_at(0.5, 0.0, 1.5));
    let settings =
        transient_settings([2e-3, 5e-6, 1e-4], InitialState::Rest, Perturbation::default());
    let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    assert!(residual < 1e-10, "{}", residual);
    assert!(record.rows.iter().any(|row| row.counts.open > 0));
}
