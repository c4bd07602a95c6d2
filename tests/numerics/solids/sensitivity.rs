//! Independent check: sensitivities of bodies of revolution against central differences of the whole analysis, base state included.

use crate::prelude::*;
use crate::solids::model::{bending, disc, tangent};
use crate::waves::{STEP, pairs, rates};

const FRICTION: f64 = 0.35;

/// Branch by harmonic, rank and direction.
type Name = (usize, usize, i8);

fn request() -> SweepRequest<'static> {
    sweep_request(&[0.0, 0.4], ModeLimit::MaxFrequency(9e3))
}

/// Eigenvalues of all branches at a friction coefficient, of the whole harmonics: what a small space leaves out of them, up to 1e-5 on
/// meshes as coarse as these, changes with the parameters.
fn eigenvalues(model: &SolidModel, friction: f64) -> BTreeMap<Name, c64> {
    let found = solid_sweep(model, &request()).unwrap();
    let own = pairs(&tangent(model), &found.branches, friction).into_iter();
    own.map(|s| ((s.harmonic, s.branch, s.direction), s.eigenvalue)).collect()
}

/// Fourth order, so that the step may stay far above round-off.
fn differences(step: f64, at: &dyn Fn(f64) -> BTreeMap<Name, c64>) -> BTreeMap<Name, c64> {
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * step));
    let all = b.keys().filter_map(|name| {
        let [a, b, c, d] = [a.get(name)?, b.get(name)?, c.get(name)?, d.get(name)?];
        Some((*name, ((c - b) * 8.0 - (d - a)) / (12.0 * step)))
    });
    all.collect()
}

/// Linear elements in the first tier; quadratic ones stay there under a ring in rigid contact and where a ring is pressed in part.
fn kinds() -> &'static [ElementKind] {
    let both = &[ElementKind::Quad4, ElementKind::Quad8];
    sized(&both[..1], both)
}

/// Compares every derivative of every branch; returns the largest error relative to the change over the parameter's own size, or to
/// a thousandth of `|lambda|` where that is less.
fn compare(model: &SolidModel, what: &str) {
    let found = solid_sweep(model, &request()).unwrap();
    let all = pairs(&tangent(model), &found.branches, FRICTION);
    assert!(all.len() >= 5, "{what}: {}", all.len());
    let changed = |change: fn(&mut SolidModel, f64)| {
        move |offset: f64| {
            let mut changed = model.clone();
            change(&mut changed, offset);
            eigenvalues(&changed, FRICTION)
        }
    };
    let contact = model.options.contact;
    let (cubic, exponential) = match contact.law {
        Some(NormalLaw::Cubic { cubic_stiffness, .. }) => (Some(cubic_stiffness), None),
        Some(NormalLaw::Exponential { reference_pressure, height }) => {
            (None, Some([reference_pressure, height]))
        }
        None => (None, None),
    };
    let k_n = contact.normal_stiffness.filter(|_| exponential.is_none());
    let [p_r, height] = [0, 1].map(|k| exponential.map(|own| own[k]));
    let decay = model.contact.decay;
    type Change = fn(&mut SolidModel, f64);
    let checks: [(&str, Option<f64>, f64, Change); 11] = [
        ("nu", Some(1.0), 2.5e-4, |m, h| m.material.poisson_ratio += h),
        ("E", Some(2.5e9), 1e7, |m, h| m.material.young_modulus += h),
        ("rho", Some(1228.0), 5.0, |m, h| m.material.density += h),
        ("alpha", Some(40.0), 1.0, |m, h| m.options.damping.mass_coefficient += h),
        ("beta", Some(4.5e-7), 1e-8, |m, h| m.options.damping.stiffness_coefficient += h),
        ("k_n", k_n, 0.004 * k_n.unwrap_or(0.0), |m, h| {
            if let Some(k) = &mut m.options.contact.normal_stiffness {
                *k += h;
            }
            if let Some(NormalLaw::Cubic { stiffness, .. }) = &mut m.options.contact.law {
                *stiffness += h;
            }
        }),
        ("c", cubic, 0.004 * cubic.unwrap_or(0.0), |m, h| {
            if let Some(NormalLaw::Cubic { cubic_stiffness, .. }) = &mut m.options.contact.law {
                *cubic_stiffness += h;
            }
        }),
        ("p_r", p_r, 0.004 * p_r.unwrap_or(0.0), |m, h| {
            let law = &mut m.options.contact.law;
            if let Some(NormalLaw::Exponential { reference_pressure, .. }) = law {
                *reference_pressure += h;
            }
        }),
        ("h", height, 0.002 * height.unwrap_or(0.0), |m, h| {
            if let Some(NormalLaw::Exponential { height, .. }) = &mut m.options.contact.law {
                *height += h;
            }
        }),
        ("q", decay.map(|d| d.static_ratio), 5e-3, |m, h| {
            if let Some(decay) = &mut m.contact.decay {
                decay.static_ratio += h;
            }
        }),
        ("v_c", decay.map(|d| d.decay_speed), 5e-3, |m, h| {
            if let Some(decay) = &mut m.contact.decay {
                decay.decay_speed += h;
            }
        }),
    ];
    let mut errors = Vec::new();
    let mut check = |name: &str, scale: f64, numeric: &BTreeMap<Name, c64>, own: &[c64]| {
        assert!(numeric.len() + 2 >= all.len(), "{what}, {name}");
        let mut worst = (0.0, c64::new(0.0, 0.0), c64::new(0.0, 0.0), (0, 0, 0));
        for (s, own) in all.iter().zip(own) {
            let branch = (s.harmonic, s.branch, s.direction);
            // At the limit of frequency.
            let Some(numeric) = numeric.get(&branch) else {
                continue;
            };
            let size = (numeric * scale).norm() + 1e-3 * s.eigenvalue.norm();
            let error = (own - numeric).norm() * scale / size;
            if error.is_nan() || error > worst.0 {
                worst = (error, own * scale, numeric * scale, branch);
            }
        }
        println!("{what}, {name}: {:.1e} {:.6e} {:.6e} {:?}", worst.0, worst.1, worst.2, worst.3);
        errors.push(worst.0);
    };
    for (name, scale, step, change) in checks {
        let Some(scale) = scale else {
            continue;
        };
        // Of Poisson's ratio relative to what is left to 1/2.
        let own = rates(&all, STEP * if name == "nu" { 0.1 } else { scale }, &|offset| {
            let mut changed = model.clone();
            change(&mut changed, offset);
            tangent(&changed)
        });
        check(name, scale, &differences(step, &changed(change)), &own);
    }
    let by_friction = differences(2e-3, &|offset| eigenvalues(model, FRICTION + offset));
    let own: Vec<c64> = all.iter().map(|pair| pair.derivative).collect();
    check("mu", FRICTION, &by_friction, &own);
    assert!(errors.iter().all(|error| *error < 1e-7), "{what}: {errors:?}");
}

const SPRINGS: ContactStiffness = compliant(2e12, [3e4, 2e4]);

const COMPLIANT: ContactStiffness = ContactStiffness {
    normal_stiffness: Some(4e11),
    normal_damping: 3e4,
    is_base_compliant: true,
    ..RIGID
};

/// Of about the stiffness of the body where it is pressed.
const LAWS: [NormalLaw; 2] = [
    NormalLaw::Exponential { reference_pressure: 2e6, height: 4e-5 },
    NormalLaw::Cubic { stiffness: 1e11, cubic_stiffness: 1e19 },
];

/// A strong prestress, so that its share cannot hide, and friction that falls with the speed.
fn strained(element: ElementKind, contact: ContactStiffness) -> SolidModel {
    let divisions = match element {
        ElementKind::Quad4 => [8, 3, 2],
        _ => [6, 2, 1],
    };
    let mut model = disc(element, divisions);
    model.options.contact = contact;
    model.options.geometric_stiffness = true;
    model.contact.interference = 2e-4;
    model.contact.decay = Some(FrictionDecay { static_ratio: 1.3, decay_speed: 1.2 });
    model
}

#[test]
fn sensitivities_in_rigid_contact_equal_finite_differences() {
    for &element in kinds() {
        compare(&strained(element, ContactStiffness::default()), &format!("rigid, {element:?}"));
    }
}

/// The slip speed and the drag change along the face.
#[test]
fn sensitivities_under_a_ring_in_rigid_contact_equal_finite_differences() {
    let mut model = strained(ElementKind::Quad8, ContactStiffness::default());
    model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.06 };
    // One element under the ring and one on either side; the pressure keeps off the values at which two eigenvalues meet.
    model.specification.annulus.radial_elements = 3;
    model.specification.conditions[3] = BoundaryCondition::Guide;
    model.contact.interference = 1e-5;
    compare(&model, "ring");
}

#[test]
fn sensitivities_on_springs_equal_finite_differences() {
    for &element in kinds() {
        let mut model = strained(element, SPRINGS);
        model.contact.decay = None;
        // The base state of a body on springs changes with its stiffness even where it is pressed by a distance.
        model.specification.conditions[1] =
            BoundaryCondition::Support(springs([2e11, 1e11, 1e11], [1e4, 1e4]));
        model.options.damping_model = DampingModel::BodyOnly;
        compare(&model, &format!("springs, {element:?}"));
    }
}

#[test]
fn sensitivities_with_a_base_state_on_springs_equal_finite_differences() {
    for &element in kinds() {
        compare(&strained(element, COMPLIANT), &format!("compliant, {element:?}"));
    }
}

/// The stiffness follows the pressure, and that the approach.
#[test]
fn sensitivities_of_a_contact_that_stiffens_equal_finite_differences() {
    for &element in kinds() {
        for law in LAWS {
            let contact = ContactStiffness {
                law: Some(law),
                normal_stiffness: Some(law.stiffness(0.0)),
                is_base_compliant: false,
                ..COMPLIANT
            };
            compare(&strained(element, contact), &format!("{law:?}, {element:?}"));
        }
    }
}

/// As stiff at rest as the springs of a body that is partly open.
const SOFT: NormalLaw = NormalLaw::Cubic { stiffness: 2e9, cubic_stiffness: 2e18 };

/// A plate bends away under the ring that presses it: the end of the pressed part moves with every parameter.
#[test]
fn sensitivities_follow_the_end_of_what_is_pressed() {
    let all =
        [None, Some(SOFT)].map(|law| [ElementKind::Quad8, ElementKind::Quad4].map(|e| (e, law)));
    let all = all.concat();
    for &(element, law) in sized(&all[1..3], &all) {
        let mut model = strained(element, COMPLIANT);
        model.options.contact.law = law;
        model.specification.annulus.radial_elements = 5;
        model.specification.contact = SolidContact::Ring { inner_radius: 0.03, outer_radius: 0.07 };
        model.contact.interference = 4e-5;
        // Soft, so that more than the last ring is pressed.
        model.options.contact.normal_stiffness = Some(2e9);
        let tangent = tangent(&model);
        let pressed = tangent.pressed();
        assert!(pressed.contains(&true) && pressed.contains(&false));
        compare(&model, &format!("partly open, {law:?}, {element:?}"));
    }
}

/// On springs that carry the base state the interference changes pressures, hardly a frequency: the
/// derivative is the same for another step, and for a modulus that differs in its last digits.
#[test]
fn a_derivative_by_the_interference_is_that_of_the_pressure_not_of_round_off() {
    let mut model = bending(ElementKind::Quad8, [24, 8, 2]);
    model.options.geometric_stiffness = true;
    model.options.contact = ContactStiffness {
        normal_stiffness: Some(1e11),
        is_base_compliant: true,
        ..ContactStiffness::default()
    };
    let own_rates = |modulus: f64, step: f64| -> Vec<f64> {
        let mut model = model.clone();
        model.material = elastic(modulus, 0.3, 7850.0, PlaneFormulation::ThreeDimensional);
        let request = sweep_request(&[0.0, 0.4], ModeLimit::MaxFrequency(3e3));
        let found = solid_sweep(&model, &request).unwrap();
        let all = pairs(&tangent(&model), &found.branches, FRICTION);
        let changed = |offset: f64| {
            let mut changed = model.clone();
            changed.contact.interference += offset;
            tangent(&changed)
        };
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
