//! Independent check: sensitivities against finite differences of the whole analysis.

use crate::prelude::*;

/// The branches at the limit are looked for far above it.
fn hold(model: &AnnulusModel, [factor, tolerance]: [f64; 2], what: &str) {
    let (limits_hz, by_friction) = ([12000.0, 17600.0], [1e-3, 1e-9]);
    let differences = Differences { limits_hz, is_whole: false, factor, tolerance, by_friction };
    assert!(differences.hold(model, what) > 5, "{what}");
}

/// A strong prestress, so that its share cannot hide.
fn strained(element: ElementKind, [around, across]: [usize; 2]) -> AnnulusModel {
    paper(element, around, across).with(|own| own.contact.interference = 3e-4)
}

#[test]
fn sensitivities_equal_finite_differences() {
    let size = sized([20, 4], [24, 6]);
    let springs = strained(Quad4, size);
    let mut rigid = strained(Quad8, size);
    rigid.options.contact.normal_stiffness = None;
    rigid.material.formulation = PlaneStress;
    let mut dashpots = springs.clone();
    dashpots.options.damping_model = BodyOnly;
    dashpots.options.contact.normal_damping = 1e5;
    let mut lossy = springs.clone();
    lossy.material.loss_factor = 0.02;
    lossy.options.contact.loss_factor = 0.1;
    let all = [(springs, "springs"), (rigid, "rigid"), (dashpots, "dashpots"), (lossy, "losses")];
    for (model, what) in all {
        hold(&model, [2.5, 2e-7], what);
    }
}

/// The same of contact that stiffens with pressure, whose base state moves with every number.
#[test]
fn sensitivities_of_stiffening_contact_equal_finite_differences() {
    let laws = [exponential(2e5, 4e-6), cubic(8e11, 5e22)];
    for (law, element) in laws.into_iter().zip([Quad8, Quad4]) {
        let model = strained(element, [24, 6]).with(|own| own.options.contact = stiffening(law));
        hold(&model, [2.5, 1e-6], &format!("{law:?}"));
    }
}

/// The same of friction that falls with speed, and of the pressure that it acts under.
#[test]
fn sensitivities_to_a_falling_law_equal_finite_differences() {
    for normal_stiffness in [None, Some(7.4e12)] {
        let mut model = strained(Quad4, [24, 6]);
        model.options.contact.normal_stiffness = normal_stiffness;
        model.contact = SlidingContact { interference: 3e-4, ..falling(300.0) };
        hold(&model, [1.5, 1e-6], &format!("falling friction, {normal_stiffness:?}"));
    }
}
