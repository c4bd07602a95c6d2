//! Solid bodies on a rigid counterface: a block that is held at every node is one, and the program has another route for it.

use super::*;

/// How far the counterface is pushed in, m.
const INTERFERENCE: f64 = 2e-6;

/// The lower block held at every node, the upper one pressed and held at a side.
const HELD: [(&str, BoundaryCondition); 4] = [
    ("lower_z0", Clamped),
    ("lower_z1", Clamped),
    ("upper_x0", Fixed([true, true, false])),
    ("upper_z1", Pressure(3e5)),
];

/// Two blocks, the lower one flat as a sheet so that all its nodes lie on held sides.
fn sheet() -> [Block; 2] {
    let [mut lower, upper] = stacked(0.0);
    lower.counts[2] = 1;
    [lower, upper]
}

pub(super) fn plane(motion: RigidMotion, center: [f64; 3]) -> RigidCounterface {
    flat(motion, center, INTERFERENCE)
}

/// Independent check: a body all of whose nodes are held, of which gaps say how far it is pushed in.
#[test]
fn a_rigid_plane_is_a_body_that_is_held_everywhere() {
    let mesh = mesh_of(&file_of(&sheet(), |point| point), &HELD);
    let center = [1.0, 0.3, 0.0];
    let motion = aside(&mesh);
    let corners = [[-0.1, -0.1, 0.02], [0.2, -0.1, 0.02], [-0.1, 0.2, 0.02], [0.2, 0.2, 0.02]];
    let places = (0..400).map(|k| [0.0026 * f64::from(k % 20), 0.0022 * f64::from(k / 20), 0.02]);
    let points = places.chain(corners).map(|place| (place, -INTERFERENCE));
    let gaps = Arc::new(Topography::new("pushed.csv", points.collect()));
    for stiffness in [None, Some(2e13)] {
        let held =
            SlidingSurfaces { topography: Some(Arc::clone(&gaps)), ..sliding(&mesh, stiffness) };
        let held = assembled(&mesh, held, std::slice::from_ref(&motion)).unwrap();
        let counter = Counterpart::Rigid(plane(RigidMotion::Turning(10.0), center));
        let on_rigid = SlidingSurfaces { counter, ..sliding(&mesh, stiffness) };
        let on_rigid = assembled(&mesh, on_rigid, &[]).unwrap();
        let pressures = [&held, &on_rigid].map(|a| a.state(0.4).unwrap().normal_forces(0.4));
        if stiffness.is_none() {
            let largest = pressures[0].iter().copied().fold(0.0, f64::max);
            assert!(largest > 0.0);
            within(&pressures[0], &pressures[1], 1e-9 * largest);
        } else {
            // Points of the one are those of common segments.
            let [a, b] = pressures.map(|all| all.iter().sum::<f64>());
            near(a, b, 1e-3);
        }
        let spectra = [&held, &on_rigid].map(|assembly| eigenvalues(assembly, 0.4, 8));
        let bound = if stiffness.is_none() { 1e-9 } else { 1e-3 };
        below(largest_difference(&spectra[0], &spectra[1]), bound, "spectrum");
        assert!(spectra[0].iter().any(|eigenvalue| eigenvalue.re.abs() > 1e-6 * eigenvalue.im));
    }
}

/// A bush of one ring of bricks around a shaft that turns: every node of the bore is pressed alike.
#[test]
fn a_shaft_presses_a_bush_evenly_whatever_its_axis() {
    let block = brick("bush", [0.0; 3], [1.0; 3], [2, 24, 2]);
    let (radius, wall, center) = (0.02, 0.01, [0.3, -0.2, 0.5]);
    // The axis lies along (2, 2, 1) / 3.
    let [e, f, axis] = [[1.0, 0.0, -2.0], [-4.0, 5.0, -2.0], [2.0, 2.0, 1.0]]
        .map(|v| -> [f64; 3] { Vector3::from(v).normalize().into() });
    let place = |[r, turn, along]: [f64; 3]| {
        let (sin, cos) = (TAU * turn).sin_cos();
        let r = radius + wall * r;
        std::array::from_fn(|k| center[k] + r * (cos * e[k] + sin * f[k]) + 0.02 * along * axis[k])
    };
    let bytes = file_of(&[block], place);
    let mesh = mesh_of(&bytes, &[("bush_x1", Clamped)]);
    for shape in [RigidShape::Cylinder(None), RigidShape::Cylinder(Some(radius))] {
        let turning = flat(RigidMotion::Turning(-3.0), center, 1e-6);
        let rigid = RigidCounterface { shape, axis, ..turning };
        let assembly = assembled(&mesh, on_rigid(&mesh, "bush_x0", rigid, None), &[]).unwrap();
        let (_, surface) = &assembly.contacts()[0];
        for (point, site) in surface.points.iter().zip(&surface.sites) {
            near(point.speed, 3.0 * radius, 1e-9);
            assert!(point.gap.abs() < 1e-12);
            let arm: [f64; 3] = std::array::from_fn(|k| site.position[k] - center[k]);
            let outward: f64 = (0..3).map(|k| arm[k] * site.normal[k]).sum();
            assert!(outward > 0.9 * radius);
        }
        let forces = assembly.state(0.0).unwrap().normal_forces(0.0);
        assert!(forces.iter().zip(&surface.points).all(|(force, own)| force / own.weight > 1e6));
    }
}
