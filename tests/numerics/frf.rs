//! Frequency responses of the finite-element model against theory and against each other.

use crate::prelude::*;

const RADIAL: usize = 10;

fn annulus() -> AnnulusMesh {
    AnnulusMesh::generate(&crate::disc::annulus(Quad4, 48, RADIAL)).unwrap()
}

fn body(is_clamped: bool, damping: RayleighDamping) -> FrfSystem {
    let mass = Consistent;
    FrfSystem::body(&annulus().mesh, &POLYCARBONATE, mass, damping, is_clamped)
}

fn sliding(damping_model: DampingModel) -> FrfSystem {
    let options = TangentOptions { geometric_stiffness: true, damping_model, ..TANGENT };
    let tangent = linearized(&annulus().mesh, &POLYCARBONATE, &contact(610.0), &options);
    FrfSystem::sliding(&tangent, 0.3)
}

/// On a rim of springs and dashpots, which damp as no multiple of mass and stiffness does.
fn on_dashpots() -> FrfSystem {
    let mut mesh = annulus().mesh;
    let rim = mesh.boundaries.iter_mut().find(|own| own.condition == Clamped).unwrap();
    rim.condition = support([1e12, 1e12, 0.0], [5e5; 2]);
    FrfSystem::body(&mesh, &POLYCARBONATE, Consistent, DAMPING, true)
}

fn port(system: &FrfSystem, node: usize, is_tangential: bool) -> Port {
    let terminal = at_node(node, is_tangential);
    system.port(&annulus().mesh, None, terminal, "force_node").unwrap()
}

#[test]
fn free_disc_moves_as_a_rigid_body_far_below_its_first_resonance() {
    let undamped = RayleighDamping::default();
    let system = body(false, undamped);
    // A radial force passes through the centre: no rotation, acceleration F / m.
    let rim = port(&system, RADIAL, false);
    let frequency = 20.0;
    let h = direct_response(&system, &rim, &rim, &[frequency], &|_| {}).unwrap()[0];
    // Mass of the polygonal mesh: that of the polygon with 48 corners.
    let polygon = 48.0 / 2.0 * (TAU / 48.0).sin();
    let mass = 1228.0 * polygon * (0.0905f64.powi(2) - 0.0205f64.powi(2));
    // Elastic modes add (20 / 2800)^2, times the few modes there are.
    near(-h.re * (TAU * frequency).powi(2), 1.0 / mass, 1e-3);
}

#[test]
fn reduction_agrees_with_direct_solution_for_every_boundary() {
    let systems = [
        body(false, DAMPING),
        body(true, DAMPING),
        sliding(WholeTangent),
        sliding(BodyOnly),
        on_dashpots(),
    ];
    let f: Vec<f64> = (1..=300).map(|i| 33.3 * f64::from(i)).collect();
    for (k, system) in systems.iter().enumerate() {
        let (a, b) = (port(system, 0, true), port(system, 4 + 11 * 5, false));
        let reduced = reduced_response(system, &a, &b, &f).unwrap();
        assert!(reduced.largest_error <= 1e-6);
        let direct = direct_response(system, &a, &b, &f, &|_| {}).unwrap();
        let top = direct.iter().map(|h| h.norm()).fold(0.0, f64::max);
        for (x, y) in reduced.receptance.iter().zip(&direct) {
            // Between the check lines the error is an estimate: ten times it; at an antiresonance relative to a thousandth of the largest.
            assert!((x - y).norm() < 1e-5 * y.norm().max(1e-3 * top), "{k}: {x} {y}");
        }
    }
}
