//! Solid bodies that are tied together and slide on each other (independent checks, unless a test says otherwise).

mod normal_law;
mod prestress;
mod response;
mod rigid_counterface;
mod rotation;
mod slow_sliding;
mod topography;

use crate::prelude::*;
use BaseChoice::{Closed, Solved};

const OPTIONS: TangentOptions = TangentOptions { damping: rayleigh_damping(0.0, 0.0), ..TANGENT };

/// The lower side of `upper` slides on the upper side of `lower`.
fn sliding(mesh: &Mesh, normal_stiffness: Option<f64>) -> SlidingSurfaces {
    let counter = Counterpart::Surface(boundary(mesh, "lower_z1"));
    contact_of(mesh, "upper_z0", counter, normal_stiffness)
}

/// A surface on a rigid counterface.
pub fn on_rigid(
    mesh: &Mesh,
    surface: &str,
    rigid: RigidCounterface,
    normal_stiffness: Option<f64>,
) -> SlidingSurfaces {
    contact_of(mesh, surface, Counterpart::Rigid(rigid), normal_stiffness)
}

fn turning(mesh: &Mesh, axis: [f64; 3], center: [f64; 3]) -> Motion {
    let region = mesh.regions.iter().position(|name| name == "lower");
    Motion { regions: vec![region.unwrap()], axis, center, rotation_speed: 10.0, inertia: None }
}

fn stacked(gap: f64) -> [Block; 2] {
    [
        brick("lower", [0.0; 3], [0.05, 0.04, 0.02], [5, 3, 2]),
        brick("upper", [0.0, 0.0, 0.02 + gap], [0.05, 0.04, 0.015], [4, 4, 2]),
    ]
}

/// Symmetry planes on three sides leave a stack free to contract; the top is pressed.
const PRESSED: [(&str, BoundaryCondition); 6] = [
    ("lower_z0", Fixed([false, false, true])),
    ("lower_x0", Fixed([true, false, false])),
    ("upper_x0", Fixed([true, false, false])),
    ("lower_y0", Fixed([false, true, false])),
    ("upper_y0", Fixed([false, true, false])),
    ("upper_z1", Pressure(1e8)),
];

/// Largest error of the displacement of a bar under the pressure 1e8 Pa along z, m; the upper part moved on by `jump`.
fn patch_error(mesh: &Mesh, displacement: &[f64], jump: f64) -> f64 {
    let strain = 1e8 / STEEL.young_modulus;
    let lateral = STEEL.poisson_ratio * strain;
    let exact = mesh.nodes.iter().zip(mesh.bodies()).flat_map(|([x, y, z], body)| {
        [lateral * x, lateral * y, -strain * z - if body == 1 { jump } else { 0.0 }]
    });
    displacement.iter().zip(exact).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max)
}

/// Steel bodies with a contact, in the base state of their loads.
fn assembled<'a>(
    mesh: &'a Mesh,
    contact: SlidingSurfaces,
    motions: &[Motion],
) -> Result<Assembly<'a>, PrestressError> {
    Assembly::new(mesh, &STEEL, (&[], &[contact]), (motions, Solved), Consistent)
}

/// Far from its axis the lower block moves nearly straight on.
fn aside(mesh: &Mesh) -> Motion {
    turning(mesh, [0.0, 0.0, 1.0], [1.0, 0.3, 0.0])
}

/// The stack pressed together, sliding on springs or rigid contact.
fn pressed(mesh: &Mesh, normal_stiffness: Option<f64>) -> Assembly<'_> {
    assembled(mesh, sliding(mesh, normal_stiffness), &[aside(mesh)]).unwrap()
}

/// What the pressure shortens the stack by.
const SHORTER: f64 = 1e8 / STEEL.young_modulus * 0.035;

/// The stack as it is pressed.
fn bar() -> Mesh {
    mesh_of(&file_of(&stacked(0.0), |point| point), &PRESSED)
}

/// Small motions at a friction coefficient.
pub fn tangent_at(
    assembly: &Assembly<'_>,
    friction: f64,
    options: &TangentOptions,
) -> SlidingTangent {
    assembly.tangent(&assembly.state(friction).unwrap(), options).unwrap()
}

/// Theory: a bar under pressure, through a contact whose meshes do not match, rigid and on springs, and through a tie.
#[test]
fn constant_pressure_passes_a_contact_and_a_tie_between_meshes_that_do_not_match() {
    let mesh = bar();
    for normal_stiffness in [None, Some(1e14)] {
        let assembly = pressed(&mesh, normal_stiffness);
        let state = assembly.state(0.0).unwrap();
        let jump = normal_stiffness.map_or(0.0, |stiffness| 1e8 / stiffness);
        let error = patch_error(&mesh, &state.displacements[0], jump);
        below(error / SHORTER, 1e-11, format!("{normal_stiffness:?}"));
        // Every point carries the pressure times its area.
        let points = &assembly.contacts()[0].1.points;
        for (point, force) in points.iter().zip(&state.normal_forces[0]) {
            assert!((force / point.weight - 1e8).abs() < 1e-9 * 1e8);
        }
        assert!(state.is_pressed.iter().all(|is_pressed| *is_pressed));
    }
    let glue = tie(&mesh, "upper_z0", "lower_z1");
    let assembly = Assembly::new(&mesh, &STEEL, (&[glue], &[]), (&[], Solved), Consistent).unwrap();
    let error = patch_error(&mesh, &assembly.state(0.0).unwrap().displacements[0], 0.0);
    below(error / SHORTER, 1e-11, "tied");
}

fn eigenvalues(assembly: &Assembly<'_>, friction: f64, count: usize) -> Vec<c64> {
    let tangent = tangent_at(assembly, friction, &OPTIONS);
    eigenvalues_of(&modes_at(&tangent, friction, Lowest(count)))
}

#[test]
fn a_tie_of_two_halves_has_the_spectrum_of_the_whole() {
    let clamped = [("whole_z0", Clamped)];
    let whole = [brick("whole", [0.0; 3], [0.05, 0.04, 0.04], [4, 3, 4])];
    let whole = mesh_of(&file_of(&whole, |point| point), &clamped);
    let expected = Assembly::new(&whole, &STEEL, (&[], &[]), (&[], Closed), Consistent).unwrap();
    let half = |name, height: f64| brick(name, [0.0, 0.0, height], [0.05, 0.04, 0.02], [4, 3, 2]);
    let halves = file_of(&[half("lower", 0.0), half("upper", 0.02)], |point| point);
    let halves = mesh_of(&halves, &[("lower_z0", Clamped)]);
    let glue = tie(&halves, "upper_z0", "lower_z1");
    let tied = Assembly::new(&halves, &STEEL, (&[glue], &[]), (&[], Closed), Consistent).unwrap();
    let [whole, halves] = [&expected, &tied].map(|own| eigenvalues(own, 0.0, 8));
    below(largest_difference(&whole, &halves), 1e-9, "tied halves");
}

/// A rotation about an axis of no symmetry.
fn turned(place: [f64; 3]) -> [f64; 3] {
    let turn = Rotation3::new(Vector3::new(2.0, 3.0, 6.0) * (0.83 / 7.0));
    (turn * Vector3::from(place)).into()
}

#[test]
fn an_assembly_turned_in_space_keeps_its_spectrum() {
    // A pad that covers part of the lower block, held on its top.
    let blocks = [
        brick("lower", [0.0; 3], [0.05, 0.04, 0.02], [3, 2, 1]),
        brick("upper", [0.012, 0.007, 0.02], [0.03, 0.025, 0.012], [2, 2, 1]),
    ];
    let held = [("lower_z0", Clamped), ("upper_x0", Clamped)];
    let center = [0.3, 0.01, 0.0];
    // Quadratic faces are not integrated exactly: their points must lie where they lay.
    for (order, normal_stiffness) in [(1, Some(1e14)), (1, None), (2, Some(1e14)), (2, None)] {
        let spectrum = |place: fn([f64; 3]) -> [f64; 3]| {
            let mesh = mesh_of(&file_of_order(&blocks, order, place), &held);
            let mut contact = sliding(&mesh, normal_stiffness);
            // Damping that is not proportional.
            contact.stiffness.tangential_damping = 1e7;
            let motion = turning(&mesh, place([0.0, 0.0, 1.0]), place(center));
            let assembly =
                Assembly::new(&mesh, &STEEL, (&[], &[contact]), (&[motion], Closed), Consistent)
                    .unwrap();
            eigenvalues(&assembly, 0.4, 8)
        };
        let [straight, turned] = [spectrum(|point| point), spectrum(turned)];
        let error = largest_difference(&straight, &turned);
        below(error, 1e-9, format!("{order} {normal_stiffness:?} {:?}", straight[0]));
        assert!(straight.iter().any(|lambda| lambda.re.abs() > 1e-6 * lambda.im));
    }
}
