//! Independent check: sensitivities of bodies of revolution against central differences of the whole analysis, base state included.

use super::*;

/// Linear elements in the first tier; quadratic ones stay there under a ring in rigid contact and where a ring is pressed in part.
fn kinds() -> &'static [ElementKind] {
    let both = &[Quad4, Quad8];
    sized(&both[..1], both)
}

fn hold(model: &SolidModel, what: &str) {
    let limits_hz = [9e3; 2];
    let (tolerance, by_friction) = (1e-7, [2e-3, 1e-7]);
    Differences { limits_hz, is_whole: true, factor: 1.0, tolerance, by_friction }
        .hold(model, what);
}

const SPRINGS: ContactStiffness = compliant(2e12, [3e4, 2e4]);

const COMPLIANT: ContactStiffness =
    ContactStiffness { is_base_compliant: true, ..compliant(4e11, [3e4, 0.0]) };

/// Of about the stiffness of the body where it is pressed.
const LAWS: [NormalLaw; 2] = [exponential(2e6, 4e-5), cubic(1e11, 1e19)];

/// A strong prestress, so that its share cannot hide, and friction that falls with the speed.
fn strained(element: ElementKind, contact: ContactStiffness) -> SolidModel {
    let mut model = disc(element, if element == Quad4 { [8, 3, 2] } else { [6, 2, 1] });
    model.options.contact = contact;
    model.options.geometric_stiffness = true;
    model.contact.interference = 2e-4;
    model.contact.decay = Some(FrictionDecay { static_ratio: 1.3, decay_speed: 1.2 });
    model
}

/// In rigid contact, with a base state on springs, and where the stiffness follows the pressure, and that the approach.
#[test]
fn sensitivities_equal_finite_differences_whatever_carries_the_base_state() {
    let laws = LAWS.map(|law| ContactStiffness { normal_damping: 3e4, ..stiffening(law) });
    for &element in kinds() {
        for contact in [RIGID, COMPLIANT].into_iter().chain(laws) {
            hold(&strained(element, contact), &format!("{contact:?}, {element:?}"));
        }
    }
}

/// The slip speed and the drag change along the face.
#[test]
fn sensitivities_under_a_ring_in_rigid_contact_equal_finite_differences() {
    let mut model = strained(Quad8, ContactStiffness::default());
    model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.06 };
    // One element under the ring and one on either side; the pressure keeps off the values at which two eigenvalues meet.
    model.specification.annulus.radial_elements = 3;
    model.specification.conditions[3] = Guide;
    model.contact.interference = 1e-5;
    hold(&model, "ring");
}

#[test]
fn sensitivities_on_springs_equal_finite_differences() {
    for &element in kinds() {
        let mut model = strained(element, SPRINGS);
        model.contact.decay = None;
        // The base state of a body on springs changes with its stiffness even where it is pressed by a distance.
        model.specification.conditions[1] = support([2e11, 1e11, 1e11], [1e4, 1e4]);
        model.options.damping_model = BodyOnly;
        hold(&model, &format!("springs, {element:?}"));
    }
}

/// As stiff at rest as the springs of a body that is partly open.
const SOFT: NormalLaw = cubic(2e9, 2e18);

/// A plate bends away under the ring that presses it: the end of the pressed part moves with every parameter.
#[test]
fn sensitivities_follow_the_end_of_what_is_pressed() {
    let all = [None, Some(SOFT)].map(|law| [Quad8, Quad4].map(|e| (e, law))).concat();
    for &(element, law) in sized(&all[1..3], &all) {
        let mut model = strained(element, COMPLIANT);
        model.options.contact.law = law;
        model.specification.annulus.radial_elements = 5;
        model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.07 };
        model.contact.interference = 4e-5;
        // Soft, so that more than the last ring is pressed.
        model.options.contact.normal_stiffness = Some(2e9);
        let tangent = model.tangent();
        let pressed = tangent.contact.is_pressed;
        assert!(pressed.contains(&true) && pressed.contains(&false));
        hold(&model, &format!("partly open, {law:?}, {element:?}"));
    }
}

/// On springs that carry the base state the interference changes pressures, hardly a frequency: the
/// derivative is the same for another step, and for a modulus that differs in its last digits.
#[test]
fn a_derivative_by_the_interference_is_that_of_the_pressure_not_of_round_off() {
    let mut model = bending(Quad8, [24, 8, 2]);
    model.options.geometric_stiffness = true;
    model.options.contact =
        ContactStiffness { is_base_compliant: true, ..compliant(1e11, [0.0; 2]) };
    let own_rates = |modulus: f64, step: f64| -> Vec<f64> {
        let mut model = model.clone();
        model.material = elastic(modulus, 0.3, 7850.0, ThreeDimensional);
        let found = model.swept(&[0.0, 0.4], MaxFrequency(3e3));
        let all = pairs(&model.tangent(), &found.branches, Differences::FRICTION);
        let changed = |offset: f64| model.with(|own| own.contact.interference += offset).tangent();
        rates(&all, step * 1e-5, &changed).iter().map(|rate| rate.im).collect()
    };
    let own = own_rates(2.1e11, STEP);
    let largest = own.iter().fold(0.0_f64, |m, rate| m.max(rate.abs()));
    for other in [own_rates(2.1e11, 2.0 * STEP), own_rates(2.1e11 * (1.0 + 1e-14), STEP)] {
        let errors = own.iter().zip(&other).map(|(a, b)| (a - b).abs() / largest);
        let worst = errors.fold(0.0, f64::max);
        assert!(own.len() == other.len() && worst < 1e-6, "{worst:e} {own:?} {other:?}");
    }
}
