//! Contact that stiffens with pressure.

use super::*;

const LAWS: [NormalLaw; 2] = [exponential(2e6, 5e-6), cubic(1e12, 4e22)];

fn stiffening(mesh: &Mesh, law: NormalLaw) -> SlidingSurfaces {
    let linear = sliding(mesh, Some(law.stiffness(0.0)));
    SlidingSurfaces { stiffness: ContactStiffness { law: Some(law), ..linear.stiffness }, ..linear }
}

fn solved(mesh: &Mesh, contact: SlidingSurfaces) -> Assembly<'_> {
    assembled(mesh, contact, &[aside(mesh)]).unwrap()
}

/// Closed form: under the pressure p the surfaces approach by `h ln(1 + p / p_r)`, or by the root of the cubic.
#[test]
fn a_bar_under_pressure_sinks_by_the_approach_of_the_law() {
    let mesh = bar();
    for law in LAWS {
        let assembly = solved(&mesh, stiffening(&mesh, law));
        let approach = match law {
            NormalLaw::Exponential { reference_pressure, height } => {
                height * (1.0 + 1e8 / reference_pressure).ln()
            }
            NormalLaw::Cubic { .. } => law.approach(1e8),
        };
        near(law.pressure(approach), 1e8, 1e-12);
        let state = assembly.state(0.0).unwrap();
        let error = patch_error(&mesh, &state.displacements[0], approach);
        below(error / approach, 1e-9, format!("{law:?}"));
    }
}

/// Closed form: the same of the bar on a rigid plane, whose contact is rigid beside one that stiffens.
#[test]
fn a_law_and_rigid_contact_share_a_pressure() {
    let free: Vec<_> = PRESSED[1..].to_vec();
    let mesh = mesh_of(&file_of(&stacked(0.0), |point| point), &free);
    for law in LAWS {
        let floor = flat(RigidMotion::Sliding([1.0, 0.0, 0.0]), [0.0; 3], 0.0);
        let contacts = [stiffening(&mesh, law), on_rigid(&mesh, "lower_z0", floor, None)];
        let motions = (&[aside(&mesh)][..], Solved);
        let assembly = Assembly::new(&mesh, &STEEL, (&[], &contacts), motions, Consistent).unwrap();
        let state = assembly.state(0.0).unwrap();
        let approach = law.approach(1e8);
        let error = patch_error(&mesh, &state.displacements[0], approach);
        below(error / approach, 1e-9, format!("{law:?}"));
        let points = assembly.contacts().iter().flat_map(|(_, surface)| &surface.points);
        for (point, force) in points.zip(&state.normal_forces[0]) {
            near(force / point.weight, 1e8, 1e-9);
        }
    }
}

/// Independent: small motions are those of the linear contact whose stiffness is `dp / dg` at that pressure, friction included.
#[test]
fn small_motions_are_those_of_the_stiffness_at_the_pressure() {
    let mesh = bar();
    let spectrum = |contact: SlidingSurfaces| -> Vec<c64> {
        let first = eigenvalues(&solved(&mesh, contact.clone()), 0.0, 6);
        [first, eigenvalues(&solved(&mesh, contact), 0.3, 6)].concat()
    };
    for law in LAWS {
        let stiffness = law.stiffness(law.approach(1e8));
        if let NormalLaw::Exponential { reference_pressure, height } = law {
            near(stiffness * height, 1e8 + reference_pressure, 1e-12);
        }
        // Without friction the pressure is the same everywhere; with it, it is not.
        let [linear, own] = [sliding(&mesh, Some(stiffness)), stiffening(&mesh, law)].map(spectrum);
        below(largest_difference(&linear[..6], &own[..6]), 1e-8, format_args!("{law:?}"));
        let apart = largest_difference(&linear[6..], &own[6..]);
        assert!(apart > 1e-6 && apart < 0.1, "{law:?} {apart:e}");
    }
}

/// Theory: a cubic law without its cubic part is the linear contact, its base state and its motions under friction.
#[test]
fn a_law_that_hardly_stiffens_is_linear_contact() {
    let mesh = bar();
    let [linear, own] = [sliding(&mesh, Some(1e13)), stiffening(&mesh, cubic(1e13, 1e8))]
        .map(|contact| eigenvalues(&solved(&mesh, contact), 0.4, 6));
    below(largest_difference(&linear, &own), 1e-8, "a law that hardly stiffens");
}

/// Balance: forces of contact far stiffer than the bodies, which rounding moves from tangent to tangent, carry the load.
#[test]
fn contact_far_stiffer_than_the_bodies_has_a_state() {
    let mesh = bar();
    let assembly = solved(&mesh, stiffening(&mesh, exponential(1e8, 1e-12)));
    let area: f64 = assembly.contacts()[0].1.points.iter().map(|point| point.weight).sum();
    let force: f64 = assembly.state(0.0).unwrap().normal_forces(0.0).iter().sum();
    below((force / (1e8 * area) - 1.0).abs(), 1e-6, "force");
}

/// Balance: contact far stiffer than the bodies holds a block by few of many points, and they carry its load. It leans: the others are open.
#[test]
fn few_of_many_stiff_points_carry_a_block_that_nothing_else_holds() {
    let gap = |x: f64, z: f64| if z > 0.02 + 5e-8 { 3.0 * x * x } else { 0.0 };
    let blocks = file_of(&stacked(1e-7), |[x, y, z]| [x, y, z + gap(x, z)]);
    let mesh = mesh_of(&blocks, &PRESSED);
    let assembly = pressed(&mesh, Some(1e19));
    let (state, points) = (assembly.state(0.0).unwrap(), &assembly.contacts()[0].1.points);
    let are_pressed = state.is_pressed.iter().filter(|is_pressed| **is_pressed).count();
    assert!(20 * are_pressed < points.len(), "{are_pressed}");
    // Shape functions add up to one along z.
    let upwards = points.iter().zip(state.normal_forces(0.0)).map(|(point, force)| {
        let own = point.normal.iter().filter(|(dof, along)| dof % 3 == 2 && *along > 0.0);
        force * own.map(|own| own.1).sum::<f64>()
    });
    let load = 1e8 * 0.05 * 0.04;
    below((upwards.sum::<f64>() / load - 1.0).abs(), 1e-7, "force");
}
