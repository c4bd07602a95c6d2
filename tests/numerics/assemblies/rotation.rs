//! Rings that turn, in both frames.

use super::*;

const SOFT: ElasticSupport = springs([2e6, 3e6, 0.0], [0.0, 0.0]);

/// A ring of bricks along radius, angle and axis, r 50 to 150 mm, 10 mm thick, its two ends glued.
pub(super) fn ring(counts: [usize; 3], bore: BoundaryCondition) -> (Mesh, TiedSurfaces) {
    let block = brick("ring", [0.05, 0.0, -0.005], [0.1, TAU, 0.01], counts);
    let mesh = mesh_of(&file_of(&[block], polar), &[("ring_x0", bore)]);
    let seam = tie(&mesh, "ring_y1", "ring_y0");
    (mesh, seam)
}

/// The ring turns about an axis parallel to its own.
pub(super) fn turning(rotation_speed: f64, center: [f64; 3], frame: RotationFrame) -> Motion {
    Motion { regions: vec![0], axis: [0.0, 0.0, 1.0], center, rotation_speed, inertia: Some(frame) }
}

/// A ring that turns about its own axis.
pub(super) fn spinning<'a>(
    mesh: &'a Mesh,
    seam: &TiedSurfaces,
    speed: f64,
    frame: RotationFrame,
) -> Assembly<'a> {
    let motions = [turning(speed, [0.0; 3], frame)];
    let ties = (std::slice::from_ref(seam), &[][..]);
    Assembly::new(mesh, &STEEL, ties, (&motions, Closed), Consistent).unwrap()
}

/// Closed form: a rigid rotor on soft springs, `I_d omega^2 -+ I_p Omega omega - k = 0` for its tilts, `sqrt(k / m)` for its
/// translations whatever the speed. Coriolis, transport and the centrifugal stress hold each other in balance there.
#[test]
fn a_rotor_on_soft_springs_tilts_as_a_rigid_gyroscope() {
    let (mesh, seam) = ring([4, 40, 1], Support(SOFT));
    let mass = assemble_mass(&mesh, &STEEL, Consistent);
    let [springs, _] = assemble_supports(&mesh);
    let form = |matrix: &frictionsim::fem::Triplets, motion: fn([f64; 3]) -> [f64; 3]| -> f64 {
        let x: Vec<f64> = mesh.nodes.iter().flat_map(|&node| motion(node)).collect();
        let image = matrix.multiply(x.len(), &x);
        x.iter().zip(image).map(|(a, b)| a * b).sum()
    };
    let tilt = |[_, y, z]: [f64; 3]| [0.0, -z, y];
    let spin = |[x, y, _]: [f64; 3]| [-y, x, 0.0];
    let (own, polar) = (form(&mass, tilt), form(&mass, spin));
    let stiffness = form(&springs, tilt);
    let speed = 200.0;
    let root = (polar * speed).hypot(2.0 * (stiffness * own).sqrt());
    let tilts = [1.0, -1.0].map(|sign| (root + sign * polar * speed) / (2.0 * own));
    let motions: [fn([f64; 3]) -> [f64; 3]; 4] =
        [|_| [1.0, 0.0, 0.0], |_| [0.0, 1.0, 0.0], |_| [0.0, 0.0, 1.0], spin];
    let along = motions.map(|motion| (form(&springs, motion) / form(&mass, motion)).sqrt());
    let expected = sorted(tilts.into_iter().chain(along));
    let found = eigenvalues(&spinning(&mesh, &seam, speed, RotationFrame::Rest), 0.0, 6);
    // A gyroscopic system takes no power.
    assert!(found.iter().all(|lambda| lambda.re.abs() < 1e-7 * lambda.im));
    let found: Vec<f64> = found.iter().map(|lambda| lambda.im).collect();
    // The ring bends a little: its lowest mode is at 3e3 rad/s.
    near_each(&found, &expected, 5e-3);
}

/// Theory: what nothing holds turns about its own axis in balance. A wave of two nodal diameters that stands at `omega` in the frame
/// that turns with the ring travels at `omega -+ 2 Omega` in the frame at rest, and nothing grows.
#[test]
fn a_free_ring_turns_and_both_frames_tell_the_same_of_its_waves() {
    let (mesh, seam) = ring([2, 40, 1], Free);
    let speed = 60.0;
    let lowest = |frame: RotationFrame| -> [f64; 2] {
        let tangent = tangent_at(&spinning(&mesh, &seam, speed, frame), 0.0, &OPTIONS);
        let found = swept(&tangent, &[0.0], Lowest(8));
        assert!(found.intervals.is_empty(), "{:?}", found.intervals);
        let own = found.points[0].modes.iter().map(|mode| mode.eigenvalue.im);
        // Rigid motions go round at the speed of the frame.
        let elastic: Vec<f64> = own.filter(|omega| *omega > 10.0 * speed).collect();
        [elastic[0], elastic[1]]
    };
    let [at_rest, along] = [RotationFrame::Rest, RotationFrame::Turning].map(lowest);
    let expected = [along[0] - 2.0 * speed, along[1] + 2.0 * speed];
    // 40 elements around carry a wave of two diameters to (2 / 40)^2 of the shift.
    within(&at_rest, &expected, 0.01 * 2.0 * speed);
}
