//! Independent check: sensitivities against finite differences of the whole analysis.

use crate::cea_cyclic::model::paper_options;
use crate::disc::{POLYCARBONATE, annulus, contact};
use faer::c64;
use frictionsim::cea::cyclic::{CyclicModel, Sensitivity, sensitivities, sweep};
use frictionsim::cea::{ModeBranch, ModeLimit, SweepRequest};
use frictionsim::contact::{ContactStiffness, NormalLaw};
use frictionsim::fem::{ElasticMaterial, PlaneFormulation};
use frictionsim::mesh::ElementKind;
use frictionsim::prestress::DampingModel;

/// One eigenvalue of a changed model, by following its branch.
fn eigenvalue_of(model: &CyclicModel, like: &Sensitivity, friction: f64) -> c64 {
    let request = SweepRequest {
        friction_coefficients: &[friction],
        limit: ModeLimit::MaxFrequency(17600.0),
        shapes_at: &[],
        count_modes: false,
    };
    let found =
        sweep(&model.specification, &model.material, &model.options, &model.contact, &request)
            .unwrap();
    let is_same = |b: &&ModeBranch| {
        (b.harmonic, b.branch, b.direction) == (like.harmonic, like.branch, like.direction)
    };
    found.branches.iter().find(is_same).unwrap().interpolate(friction).unwrap()
}

/// Independent check: central differences of the whole analysis, prestress included.
#[test]
fn sensitivities_equal_finite_differences() {
    let mut rigid = paper_options();
    rigid.contact.normal_stiffness = None;
    let mut dashpots = paper_options();
    dashpots.damping_model = DampingModel::BodyOnly;
    dashpots.contact.normal_damping = 1e5;
    for (options, formulation, element) in [
        (paper_options(), PlaneFormulation::PlaneStrain, ElementKind::Quad4),
        (rigid, PlaneFormulation::PlaneStress, ElementKind::Quad8),
        (dashpots, PlaneFormulation::PlaneStrain, ElementKind::Quad4),
    ] {
        let mut contact = contact(610.0);
        // A strong prestress, so that its share cannot hide.
        contact.interference = 3e-4;
        let material = ElasticMaterial { formulation, ..POLYCARBONATE };
        let model = CyclicModel {
            specification: annulus(element, 24, 6),
            material: material.into(),
            options,
            contact,
        };
        let friction = 0.35;
        let request = SweepRequest {
            friction_coefficients: &[0.0, friction],
            limit: ModeLimit::MaxFrequency(12000.0),
            shapes_at: &[],
            count_modes: false,
        };
        let found =
            sweep(&model.specification, &model.material, &model.options, &model.contact, &request)
                .unwrap();
        for s in sensitivities(&found, friction).unwrap() {
            let difference = |step: f64, change: &dyn Fn(&mut CyclicModel, f64)| {
                let at = |offset: f64| {
                    let mut changed = model;
                    change(&mut changed, offset);
                    eigenvalue_of(&changed, &s, friction)
                };
                // Fourth order, so that the step may stay far above round-off.
                ((at(step) - at(-step)) * 8.0 - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step)
            };
            let k_n = options.contact.normal_stiffness.unwrap_or(1.0);
            let checks = [
                (
                    "nu",
                    1.0,
                    s.poisson_ratio.unwrap(),
                    difference(1e-3, &|m, h| m.material.annulus.poisson_ratio += h),
                ),
                (
                    "E",
                    2.5e9,
                    s.young_modulus.unwrap(),
                    difference(2e7, &|m, h| m.material.annulus.young_modulus += h),
                ),
                (
                    "rho",
                    1228.0,
                    s.density,
                    difference(10.0, &|m, h| m.material.annulus.density += h),
                ),
                (
                    "alpha",
                    40.0,
                    s.mass_coefficient,
                    difference(1.0, &|m, h| m.options.damping.mass_coefficient += h),
                ),
                (
                    "beta",
                    4.5e-7,
                    s.stiffness_coefficient,
                    difference(1e-8, &|m, h| m.options.damping.stiffness_coefficient += h),
                ),
                (
                    "k_n",
                    k_n,
                    s.normal_stiffness.unwrap_or(c64::new(0.0, 0.0)),
                    difference(k_n * 0.01, &|m, h| {
                        if let Some(k) = &mut m.options.contact.normal_stiffness {
                            *k += h;
                        }
                    }),
                ),
            ];
            for (name, scale, analytic, numeric) in checks {
                // Relative to the change over the parameter's own size, and to |lambda| where that is tiny.
                let error = (analytic - numeric).norm() * scale;
                let size = (numeric * scale).norm() + 1e-3 * s.eigenvalue.norm();
                assert!(
                    error < 2e-7 * size,
                    "{element:?} {name} {s:?} {numeric} {:e}",
                    error / size
                );
            }
            let at = |mu: f64| eigenvalue_of(&model, &s, mu);
            let h = 1e-3;
            let numeric = ((at(friction + h) - at(friction - h)) * 8.0
                - (at(friction + 2.0 * h) - at(friction - 2.0 * h)))
                / (12.0 * h);
            assert!((numeric - s.friction).norm() < 1e-9 * s.eigenvalue.norm());
        }
    }
}

/// Independent check: the same of contact that stiffens with pressure, whose base state moves with every number.
#[test]
fn sensitivities_of_stiffening_contact_equal_finite_differences() {
    let laws = [
        NormalLaw::Exponential { reference_pressure: 2e5, height: 4e-6 },
        NormalLaw::Cubic { stiffness: 8e11, cubic_stiffness: 5e22 },
    ];
    let moved = |law: NormalLaw, number: usize, share: f64| match law {
        NormalLaw::Exponential { reference_pressure: p, height: h } => NormalLaw::Exponential {
            reference_pressure: if number == 0 { p * (1.0 + share) } else { p },
            height: if number == 1 { h * (1.0 + share) } else { h },
        },
        NormalLaw::Cubic { stiffness: k, cubic_stiffness: c } => NormalLaw::Cubic {
            stiffness: if number == 0 { k * (1.0 + share) } else { k },
            cubic_stiffness: if number == 1 { c * (1.0 + share) } else { c },
        },
    };
    let of = |law: NormalLaw| ContactStiffness {
        normal_stiffness: Some(law.stiffness(0.0)),
        law: Some(law),
        ..ContactStiffness::default()
    };
    for (law, element) in laws.into_iter().zip([ElementKind::Quad8, ElementKind::Quad4]) {
        let mut contact = contact(610.0);
        contact.interference = 3e-4;
        let mut options = paper_options();
        options.contact = of(law);
        let model = CyclicModel {
            specification: annulus(element, 24, 6),
            material: POLYCARBONATE.into(),
            options,
            contact,
        };
        let friction = 0.35;
        let request = SweepRequest {
            friction_coefficients: &[0.0, friction],
            limit: ModeLimit::MaxFrequency(12000.0),
            shapes_at: &[],
            count_modes: false,
        };
        let (specification, material) = (&model.specification, &model.material);
        let found = sweep(specification, material, &options, &contact, &request).unwrap();
        let sensitivities = sensitivities(&found, friction).unwrap();
        assert!(sensitivities.len() > 5);
        for s in &sensitivities {
            let difference = |change: &dyn Fn(&mut CyclicModel, f64)| {
                let at = |share: f64| {
                    let mut changed = model;
                    change(&mut changed, share);
                    eigenvalue_of(&changed, s, friction)
                };
                let h = 1e-3;
                ((at(h) - at(-h)) * 8.0 - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
            };
            let by_law =
                |number: usize| difference(&|m, x| m.options.contact = of(moved(law, number, x)));
            let [cubic, pressure, height] = s.normal_law;
            let own = match law {
                NormalLaw::Exponential { reference_pressure: p, height: h } => {
                    [pressure.unwrap() * p, height.unwrap() * h]
                }
                NormalLaw::Cubic { stiffness: k, cubic_stiffness: c } => {
                    [s.normal_stiffness.unwrap() * k, cubic.unwrap() * c]
                }
            };
            let modulus = POLYCARBONATE.young_modulus;
            let by_modulus = difference(&|m, x| m.material.annulus.young_modulus *= 1.0 + x);
            let ratio = POLYCARBONATE.poisson_ratio;
            let by_ratio = difference(&|m, x| m.material.annulus.poisson_ratio *= 1.0 + x);
            for (name, analytic, numeric) in [
                ("first number of the law", own[0], by_law(0)),
                ("second number of the law", own[1], by_law(1)),
                ("E", s.young_modulus.unwrap() * modulus, by_modulus),
                ("nu", s.poisson_ratio.unwrap() * ratio, by_ratio),
            ] {
                let error = (analytic - numeric).norm();
                let size = numeric.norm() + 1e-3 * s.eigenvalue.norm();
                assert!(error < 1e-6 * size, "{law:?} {name} {s:?} {numeric} {:e}", error / size);
            }
        }
    }
}
