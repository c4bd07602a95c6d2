//! Gaps of a measured surface. Independent: the same bodies meshed with that gap; a plane of gaps.

use super::*;

/// The upper block tilted over `x`: opens by `SLOPE` at its far end, beyond what the pressure closes.
const SLOPE: f64 = 1e-3;

/// Scattered places over the contact, always the same.
fn places(count: usize) -> Vec<[f64; 3]> {
    let mut draw = crate::draws::draws(7);
    (0..count).map(|_| [0.05 * draw(), 0.04 * draw(), 0.02]).collect()
}

fn measured(places: &[[f64; 3]], gap: impl Fn([f64; 3]) -> f64) -> Option<Arc<Topography>> {
    let points = places.iter().map(|&place| (place, gap(place)));
    Some(Arc::new(Topography::new("pad.csv", points.collect())))
}

#[test]
fn a_plane_of_gaps_at_scattered_points_is_exact_and_measured_points_keep_their_own() {
    let mesh = bar();
    let plane = |[x, y, _]: [f64; 3]| 1e-6 + 3e-5 * x - 2e-5 * y;
    for stiffness in [None, Some(1e14)] {
        let topography = measured(&places(400), plane);
        let contact = SlidingSurfaces { topography, ..sliding(&mesh, stiffness) };
        let assembly = assembled(&mesh, contact, &[aside(&mesh)]).unwrap();
        let (_, surface) = &assembly.contacts()[0];
        for (point, site) in surface.points.iter().zip(&surface.sites) {
            // Dual weights give a node the value there of what is linear over its faces.
            below((point.gap - plane(site.position)).abs(), 1e-15, "gap");
        }
    }
}

#[test]
fn a_measured_gap_presses_as_the_same_gap_of_the_mesh_and_opens_where_it_opens() {
    // A pressure that does not close all of it.
    let mut lightly = PRESSED;
    lightly[5].1 = BoundaryCondition::Pressure(1e6);
    let flat = mesh_of(&file_of(&stacked(0.0), |point| point), &lightly);
    let gap = |x: f64| SLOPE * x;
    // The same gap in the mesh: the upper block is sheared by it.
    let tilted = mesh_of(
        &file_of(&stacked(1e-9), |[x, y, z]| {
            let is_upper = z > 0.02 + 5e-10;
            [x, y, if is_upper { z - 1e-9 + gap(x) } else { z }]
        }),
        &lightly,
    );
    let friction = 0.3;
    for stiffness in [None, Some(2e13)] {
        let plain = sliding(&tilted, stiffness);
        let topography = measured(&places(2000), |[x, ..]| gap(x));
        let contact = SlidingSurfaces { topography, ..sliding(&flat, stiffness) };
        let pressures = |mesh: &Mesh, contact: SlidingSurfaces| -> Vec<(f64, bool)> {
            let assembly = assembled(mesh, contact, &[aside(mesh)]).unwrap();
            let state = assembly.state(friction).unwrap();
            let forces = state.normal_forces(friction);
            let points = &assembly.contacts()[0].1.points;
            let pressure = points.iter().zip(forces).map(|(point, force)| force / point.weight);
            pressure.zip(state.is_pressed.iter().copied()).collect()
        };
        let (found, expected) = (pressures(&flat, contact), pressures(&tilted, plain));
        assert_eq!(found.len(), expected.len());
        let largest = expected.iter().map(|own| own.0).fold(0.0, f64::max);
        let open = expected.iter().filter(|own| !own.1).count();
        assert!(open > 0 && open < expected.len(), "{open} of {}", expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            // The sheared block is another body by the slope itself.
            assert!((found.0 - expected.0).abs() < 5.0 * SLOPE * largest, "{found:?} {expected:?}");
        }
    }
}
