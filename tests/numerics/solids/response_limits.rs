//! Frequency responses of bodies of revolution where theory or the plane program knows the answer.

use super::*;
use crate::solids::response::{FREQUENCIES, at, body, sliding};

/// Responses of plane strain for each metre and of the guided body times its thickness to a force along the inner edge, at places
/// of a sixteenth of the circle: `(plane, solid)`, line by line.
fn plane_and_guided(around: usize, is_sliding: bool) -> Vec<(c64, c64)> {
    let mut model = guided(Quad8, [around, 5, 1]);
    model.options.geometric_stiffness = true;
    let solid = SolidSector::generate(&model.specification).unwrap();
    let plane = Strip::of_annulus(&model.specification.annulus).unwrap();
    let material = ElasticMaterial { formulation: PlaneStrain, ..model.material };
    let options = &model.options;
    let (flat, thick) = if is_sliding {
        let tangent = WaveTangent::of_annulus(&plane, &material, options, &model.contact);
        let flat = CyclicSystem::sliding(&tangent.unwrap(), 0.3);
        (flat, sliding(&model, 0.3))
    } else {
        let flat = WaveTangent::of_free(&plane, &material, options.mass, options.damping, true);
        (CyclicSystem::sliding(&flat, 0.0), body(&model, true))
    };
    let mut pairs = Vec::new();
    let motions = [(1, 0, Tangential), (3, 3, Radial), (7, 4, Tangential), (11, 2, Radial)];
    for (turn, place, direction) in motions {
        // A ray has its nodes by rising radius in the plane.
        let s = turn * around / 16;
        let plane_node = |s: usize, i: usize| s * plane.node_count() + i;
        let terminal = |node, direction| Terminal { node, direction };
        let force = terminal(plane_node(0, 0), Tangential);
        let response = terminal(plane_node(s, place), direction);
        let known = cyclic_response(&flat, force, response, &FREQUENCIES).unwrap();
        let mut sum = [c64::new(0.0, 0.0); FREQUENCIES.len()];
        // A line load goes to the three nodes of an edge in these shares.
        for (j, share) in [(0, 1.0 / 6.0), (1, 2.0 / 3.0), (2, 1.0 / 6.0)] {
            let force = at(&solid, 0, [0, j], 0, Tangential);
            let response = at(&solid, s, [place, 0], 0, direction);
            let found = cyclic_response(&thick, force, response, &FREQUENCIES).unwrap();
            for (sum, h) in sum.iter_mut().zip(&found.receptance) {
                *sum += h * (share * model.specification.thickness);
            }
        }
        pairs.extend(known.receptance.into_iter().zip(sum));
    }
    pairs
}

/// Cross-method.
#[test]
fn guided_faces_respond_as_plane_strain_does() {
    for (known, h) in plane_and_guided(16, false) {
        // Rounding of thousands of terms, amplified by condition numbers up to 1e4.
        near_each(&[h], &[known], 1e-9);
    }
    // In contact the reactions of mid-side nodes, which the middle of the thickness has none of, act along other normals than
    // those of the corners beside them: the two differ by the square of a sector.
    let apart = [16, 32].map(|around| {
        let pairs = plane_and_guided(around, true);
        let top = pairs.iter().fold(0.0_f64, |m, (known, _)| m.max(known.norm()));
        pairs.iter().map(|(known, h)| (h - known).norm() / top).fold(0.0, f64::max)
    });
    assert!(apart[1] < 5e-3 && apart[1] < apart[0] / 3.0, "{apart:?}");
}

/// Independent check: far below its first resonance a free disc translates, and tilts under an axial force at its rim.
#[test]
fn a_free_disc_moves_as_a_rigid_body_with_the_mass_of_its_true_thickness() {
    let model = disc(Quad8, [24, 4, 2]);
    let system = body(&model, false);
    let sector = SolidSector::generate(&model.specification).unwrap();
    let (a, b, t) = (0.0205_f64, 0.0905_f64, 0.009_f64);
    let mass = 1228.0 * 0.5 * TAU * (b * b - a * a) * t;
    let inertia = mass * ((a * a + b * b) / 4.0 + t * t / 12.0);
    let middle = |direction| at(&sector, 4, [8, 2], 0, direction);
    for (direction, exact) in [(Radial, 1.0 / mass), (Axial, 1.0 / mass + b * b / inertia)] {
        let rim = middle(direction);
        let f = 3.0;
        let h = cyclic_response(&system, rim, rim, &[f]).unwrap().receptance[0];
        // The phase of rigid motion is turned by alpha_R / omega.
        let omega = TAU * f;
        let undamped = -h * c64::new(omega * omega, -40.0 * omega);
        // The first of the elastic modes, 200 Hz, adds (3 / 200)^2 and more with alpha_R.
        near(undamped.re, exact, 5e-3);
    }
}
