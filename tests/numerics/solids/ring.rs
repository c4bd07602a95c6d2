//! A flat ring that presses on the face of a disc.

use super::*;

/// A ring on the outer half of the top face.
fn ringed(element: ElementKind, divisions: [usize; 3]) -> SolidModel {
    let mut model = disc(element, divisions);
    model.specification.contact = SolidContact::Ring { inner_radius: 0.05, outer_radius: 0.08 };
    model.contact.interference = 5e-6;
    model
}

/// A ring on the whole face of a layer whose bottom cannot move, guided at its sides.
fn layer(element: ElementKind) -> SolidModel {
    let mut model = ringed(element, [24, 4, 2]);
    model.specification.contact = SolidContact::Ring { inner_radius: 0.0205, outer_radius: 0.0905 };
    model.specification.conditions = [Guide, Guide, Free, Clamped];
    model
}

/// Theory: soft springs all have the pressure `k delta`, those on a clamped edge too.
#[test]
fn soft_springs_press_on_a_clamped_edge_too() {
    for element in [Quad4, Quad8] {
        let mut model = layer(element);
        model.specification.conditions[0] = Clamped;
        compliant(&mut model, 1e9);
        let (_, base) = base(&model).unwrap();
        let force: f64 = base.normal_forces().map(|(_, force)| force).sum();
        let area = TAU / 48.0 * (0.0905_f64.powi(2) - 0.0205_f64.powi(2));
        let chord = (TAU / 24.0).powi(2) / 6.0;
        let tolerance = 4e-3 + if element == Quad4 { chord } else { 0.0 };
        near(force, 1e9 * 5e-6 * area, tolerance);
    }
}

/// Independent check: a squeezed layer is in uniaxial strain, alone and in series with springs or with contact that stiffens. That gives
/// way by half the distance: its laws have the pressure there that the rest strains the layer with. Of the edge of an 8-node brick the
/// body has the chord, of a 20-node one a parabola, the springs the arc. Five times as stiff as the layer there, the exponential law
/// leaves twice as much of the face's error in the pressure as the springs.
#[test]
fn a_layer_shares_the_distance_with_the_contact_that_presses_it() {
    let angle: f64 = TAU / 24.0;
    let (chord, parabola) = (angle.powi(2) / 6.0, angle.powi(4));
    // Of the layer alone, on springs, and on laws.
    let bounds = [(Quad4, [chord; 3]), (Quad8, [1e-4, parabola / 2.0, parabola])];
    for (element, [rigid, spring, law]) in bounds {
        let model = layer(element);
        let [lambda, shear] = model.material.lame_constants();
        let stiffness = (lambda + 2.0 * shear) / 0.009;
        let (alone, half) = (stiffness * 5e-6, stiffness * 2.5e-6);
        let mut springs = model.clone();
        compliant(&mut springs, 3e11);
        let laws = [
            exponential(half / f64::exp_m1(5.0), 5e-7),
            cubic(0.1 * half / 2.5e-6, 0.9 * half / 2.5e-6_f64.powi(3)),
        ];
        let stiffens = laws.map(|own_law| {
            let mut own = model.clone();
            own.options.contact.law = Some(own_law);
            (own, half, law)
        });
        let series = 5e-6 / (1.0 / stiffness + 1.0 / 3e11);
        let linear = [(model, alone, rigid), (springs, series, spring)];
        for (model, exact, tolerance) in linear.into_iter().chain(stiffens) {
            let contact = model.options.contact;
            let (sector, base) = base(&model).unwrap();
            assert!(base.sliding.is_pressed.iter().all(|pressed| *pressed));
            let nodal: f64 = base.normal_forces().map(|(_, force)| force).sum();
            let area: f64 = sector.rings.iter().map(|ring| ring.area).sum();
            for pressure in base.pressures.iter().chain(&[nodal / area]) {
                near(*pressure, exact, tolerance);
            }
            for approach in base.approaches.iter().filter(|_| contact.law.is_some()) {
                near(*approach, 2.5e-6, tolerance);
            }
        }
    }
}

/// Theory: contact that hardly stiffens is the linear one, in the base state and in its spectrum.
#[test]
fn a_law_that_hardly_stiffens_is_springs() {
    let mut linear = ringed(Quad8, [24, 7, 1]);
    compliant(&mut linear, 3e11);
    let mut own = linear.clone();
    own.options.contact.law = Some(cubic(3e11, 1e8));
    let [linear, own] = [linear, own].map(|model| modes(&model, 0.5, 4000.0));
    assert_eq!(linear.len(), own.len());
    near_each(&eigenvalues_of(&own), &eigenvalues_of(&linear), 1e-8);
}

fn compliant(model: &mut SolidModel, stiffness: f64) {
    model.options.contact.normal_stiffness = Some(stiffness);
    model.options.contact.is_base_compliant = true;
}

/// Under rigid contact the ring of a bending plate touches a line, and springs on it are as many as the mesh is wide.
#[test]
fn springs_that_carry_the_base_state_give_a_contact_that_opens_a_width_of_its_own() {
    let found = [14, 28, 56].map(|radial| {
        let mut model = ringed(Quad8, [24, radial, 2]);
        compliant(&mut model, 3e11);
        let (sector, base) = base(&model).unwrap();
        assert!(opens_in_part(&base));
        let force: f64 = base.normal_forces().map(|(_, force)| force).sum();
        let modes = modes(&model, 0.5, 4000.0);
        let rate = modes.iter().map(|mode| mode.growth_rate());
        [force * sector.sector_count() as f64, rate.fold(f64::MIN, f64::max)]
    });
    for quantity in 0..2 {
        let [coarse, middle, fine] = found.map(|values| values[quantity]);
        let errors = [coarse, middle].map(|value| (value / fine - 1.0).abs());
        assert!(errors[0] < 0.04 && errors[1] < 0.01, "{errors:?}");
    }
}

/// Independent check: a finer mesh. Stiff springs touch at the inner edge of the ring; along a coarse quadratic element, pressed at its
/// ends, the parabola of the approach opens in the middle, where springs do not pull.
#[test]
fn stiff_springs_pull_nothing_where_the_middle_of_an_element_is_open() {
    let lowest = |radial: usize| {
        let mut model = ringed(Quad8, [24, radial, 1]);
        compliant(&mut model, 1e13);
        modes(&model, 0.0, 1500.0)[0].frequency_hz()
    };
    let fine = lowest(14);
    for (radial, tolerance) in [(4, 0.03), (7, 0.01)] {
        near(lowest(radial), fine, tolerance);
    }
}

#[test]
fn a_ring_on_a_bending_plate_opens_and_keeps_the_contact_conditions() {
    for element in [Quad4, Quad8] {
        let (sector, base) = base(&ringed(element, [24, 14, 2])).unwrap();
        assert!(opens_in_part(&base));
        for ((ring, &pressed), pressure) in
            sector.rings.iter().zip(&base.sliding.is_pressed).zip(&base.pressures)
        {
            let depth = -base.sliding.state.displacements[0][3 * ring.nodes[0] + 2];
            let is_held = *pressure > 0.0 && (depth - 5e-6).abs() < 1e-18;
            assert!(if pressed { is_held } else { *pressure == 0.0 && depth >= 5e-6 });
        }
    }
}

/// Independent check: the torque of friction is that of the ground.
#[test]
fn reaction_of_the_ground_balances_the_friction_of_the_ring() {
    let (sector, base) = base(&ringed(Quad8, [24, 14, 2])).unwrap();
    let torque = base.torque(&sector, 0.3);
    let forces = base.normal_forces().map(|(node, n)| 0.3 * n * sector.nodes[node].radius);
    near(torque, 24.0 * forces.sum::<f64>(), 1e-12);
    assert!(torque > 0.0);
}

/// Both bricks see the same squeal: 8 nodes on a finer mesh.
#[test]
fn bricks_of_8_and_20_nodes_agree_on_a_disc_under_a_ring() {
    let unstable = |model: &SolidModel| {
        let found = modes(model, 0.5, 9000.0);
        sorted(found.iter().filter(|mode| mode.harmonic < 4).map(ComplexMode::frequency_hz))
    };
    let fine = unstable(&ringed(Quad8, [36, 14, 2]));
    near_each(&fine, &unstable(&ringed(Quad4, [72, 28, 4])), 0.01);
}
