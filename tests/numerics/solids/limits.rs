//! Three dimensions where the plane program knows the answer.

use super::*;

fn plane(model: &SolidModel, formulation: PlaneFormulation, limit_hz: f64) -> Vec<ComplexMode> {
    let plane = WaveModel {
        specification: model.specification.annulus,
        material: ElasticMaterial { formulation, ..model.material },
        options: model.options,
        contact: model.contact,
    };
    plane.modes(0.3, MaxFrequency(limit_hz))
}

/// Eigenvalue of the given modes nearest to one of the plane.
fn nearest<'a>(modes: &'a [ComplexMode], wanted: &ComplexMode) -> &'a ComplexMode {
    let same = modes.iter().filter(|mode| mode.harmonic == wanted.harmonic);
    nearest_by(same, |mode| (mode.eigenvalue - wanted.eigenvalue).norm())
}

#[test]
fn guided_faces_give_plane_strain() {
    for geometric_stiffness in [false, true] {
        let mut model = guided(Quad8, [24, 5, 1]);
        model.options.geometric_stiffness = geometric_stiffness;
        let solid = modes(&model, 0.3, 11_500.0);
        for mode in plane(&model, PlaneStrain, 11_000.0) {
            // A 20-node brick has no node at mid-thickness between its sides, a plane quadrilateral has: 0.3 Hz at 11 kHz.
            near_each(&[nearest(&solid, &mode).eigenvalue], &[mode.eigenvalue], 3e-5);
        }
    }
}

/// Self-consistency: the space of a limit twice as high leaves out next to nothing.
#[test]
fn the_estimate_of_what_the_small_space_of_a_harmonic_leaves_out_is_what_it_leaves_out() {
    let model = disc(Quad8, [24, 5, 1]);
    let up_to = |limit_hz: f64| model.swept(&[0.3], MaxFrequency(limit_hz));
    let (small, large) = (up_to(9000.0), up_to(18_000.0));
    let left_out = small.sweep.points[0].modes.iter().map(|mode| {
        let better = nearest(&large.sweep.points[0].modes, mode);
        (better.eigenvalue - mode.eigenvalue).norm() / mode.eigenvalue.norm()
    });
    let largest = left_out.fold(0.0, f64::max);
    let ratio = small.reduction_error / largest;
    assert!((0.5..2.0).contains(&ratio), "{ratio}");
}

#[test]
fn a_thin_disc_has_the_modes_of_plane_stress() {
    let mut model = disc(Quad8, [24, 8, 1]);
    model.specification.thickness = 2e-4;
    let mut in_plane = modes(&model, 0.3, 9000.0);
    in_plane.retain(|mode| mode.axial_share.unwrap() < 0.1);
    let reference = plane(&model, PlaneStress, 8900.0);
    assert!(reference.len() > 3);
    for mode in reference {
        // The elements at the clamp cannot thin as they are stretched.
        near_each(&[nearest(&in_plane, &mode).eigenvalue], &[mode.eigenvalue], 1e-2);
    }
}

/// Theory: `u_r = a r + b / r, u_z = c z` has the stresses of a thick tube, `sigma_r = lambda (2 a + c) + 2 G (a - b / r^2)`. Without `b`
/// the field is linear, and every node has its stress to round-off; with it the largest error falls with the square of the mesh.
#[test]
fn the_stress_of_a_stretched_tube_is_that_of_the_theory() {
    let (a, c) = (1e-4, -3e-5);
    let worst = |kind: ElementKind, divisions: [usize; 3], b: f64| {
        let model = disc(kind, divisions);
        let sector = SolidSector::generate(&model.specification).unwrap();
        let nodes = sector.nodes.iter();
        let displacement: Vec<f64> = nodes
            .flat_map(|node| [a * node.radius + b / node.radius, 0.0, c * node.height])
            .collect();
        let [lambda, shear] = model.material.lame_constants();
        let stress = revolved_stress(&sector, &model.material, &displacement);
        let whole = displacement.repeat(sector.sector_count());
        let all = revolved_stress(&sector, &model.material, &whole);
        let mut worst = 0.0f64;
        for (k, node) in sector.nodes.iter().enumerate() {
            let trace = lambda * (2.0 * a + c);
            let turn = b / node.radius.powi(2);
            let exact = [a - turn, a + turn, c].map(|strain| trace + 2.0 * shear * strain);
            for (component, found) in stress[k].0.iter().enumerate() {
                let exact = exact.get(component).copied().unwrap_or(0.0);
                worst = worst.max((found - exact).abs() / (2.0 * shear * a));
                // One sector that all repeat, or all of them.
                let other = all[sector.node_count() + k].0[component];
                assert!((found - other).abs() < 1e-9 * shear * a);
            }
        }
        worst
    };
    assert!([Quad4, Quad8].iter().all(|&kind| worst(kind, [24, 4, 2], 0.0) < 1e-9));
    // b / r^2 is 1e-4 inside.
    let inner = disc(Quad4, [24, 4, 1]).specification.annulus.inner_radius;
    let b = 1e-4 * inner * inner;
    let [coarse, fine] = [1, 2].map(|k| worst(Quad4, [48 * k, 12 * k, 1], b));
    assert!(fine < 0.1 && fine < 0.35 * coarse, "{coarse:.4} {fine:.4}");
}
