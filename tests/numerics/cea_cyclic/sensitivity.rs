//! Independent check: sensitivities against finite differences of the whole analysis.

use crate::cea_cyclic::model::paper_options;
use crate::prelude::*;
use crate::waves::{STEP, is_of, pairs, rates};
use frictionsim::cea::cyclic::{WavePair, sweep};

const FRICTION: f64 = 0.35;

#[derive(Clone, Copy)]
struct CyclicModel {
    specification: AnnulusSpecification,
    material: AnnulusMaterials,
    options: TangentOptions,
    contact: SlidingContact,
}

fn swept(model: &CyclicModel, frictions: &[f64], limit_hz: f64) -> WaveSweep {
    let request = sweep_request(frictions, ModeLimit::MaxFrequency(limit_hz));
    let CyclicModel { specification, material, options, contact } = model;
    sweep(specification, material, options, contact, &request).unwrap()
}

fn tangent(model: &CyclicModel) -> WaveTangent {
    let sector = SectorMesh::generate(&model.specification).unwrap();
    let CyclicModel { material, options, contact, .. } = model;
    WaveTangent::of_annulus(&sector, material, options, contact).unwrap()
}

/// Differences of changed models by following each branch, of fourth order, so that the step may stay far above round-off; `at` has
/// model and friction so much further.
fn differences(pairs: &[WavePair], step: f64, at: &dyn Fn(f64) -> (CyclicModel, f64)) -> Vec<c64> {
    let sides = [-2.0, -1.0, 1.0, 2.0].map(|steps| {
        let (model, friction) = at(steps * step);
        (swept(&model, &[friction], 17600.0).branches, friction)
    });
    let difference = |pair: &WavePair| {
        let [a, b, c, d] = sides.each_ref().map(|(branches, friction)| {
            branches.iter().find(is_of(pair)).unwrap().interpolate(*friction).unwrap()
        });
        ((c - b) * 8.0 - (d - a)) / (12.0 * step)
    };
    pairs.iter().map(difference).collect()
}

/// Name, value, step relative to it for differences of analyses, and what a share of the value more is.
type Check<'a> = (&'a str, f64, f64, &'a dyn Fn(&mut CyclicModel, f64));

/// The derivatives of every branch by some parameters; how many branches there are.
fn compare(model: &CyclicModel, checks: &[Check<'_>], tolerance: f64) -> usize {
    let found = swept(model, &[0.0, FRICTION], 12000.0);
    let pairs = pairs(&tangent(model), &found.branches, FRICTION);
    for (name, value, step, change) in checks {
        let moved = |share: f64| {
            let mut changed = *model;
            change(&mut changed, share);
            changed
        };
        let rates = rates(&pairs, STEP * value, &|offset| tangent(&moved(offset / value)));
        let numeric = differences(&pairs, *step, &|share| (moved(share), FRICTION));
        for ((pair, rate), numeric) in pairs.iter().zip(rates).zip(numeric) {
            // Relative to the change over the parameter's own size, and to |lambda| where that is tiny.
            let error = (rate * *value - numeric).norm();
            let size = numeric.norm() + 1e-3 * pair.eigenvalue.norm();
            assert!(error < tolerance * size, "{name} {pair:?} {numeric} {:e}", error / size);
        }
    }
    let numeric = differences(&pairs, 1e-3, &|more| (*model, FRICTION + more));
    for (pair, numeric) in pairs.iter().zip(numeric) {
        assert!((numeric - pair.derivative).norm() < 1e-9 * pair.eigenvalue.norm());
    }
    pairs.len()
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
        let [around, across] = sized([20, 4], [24, 6]);
        let specification = annulus(element, around, across);
        let model = CyclicModel { specification, material: material.into(), options, contact };
        let own = POLYCARBONATE;
        let damping = options.damping;
        let mut checks: Vec<Check<'_>> = vec![
            ("nu", own.poisson_ratio, 2e-3, &|m, x| m.material.annulus.poisson_ratio *= 1.0 + x),
            ("E", own.young_modulus, 1e-2, &|m, x| m.material.annulus.young_modulus *= 1.0 + x),
            ("rho", own.density, 1e-2, &|m, x| m.material.annulus.density *= 1.0 + x),
            ("alpha", damping.mass_coefficient, 2e-2, &|m, x| {
                m.options.damping.mass_coefficient *= 1.0 + x;
            }),
            ("beta", damping.stiffness_coefficient, 2e-2, &|m, x| {
                m.options.damping.stiffness_coefficient *= 1.0 + x;
            }),
        ];
        if let Some(stiffness) = options.contact.normal_stiffness {
            checks.push(("k_n", stiffness, 1e-2, &|m, x| {
                *m.options.contact.normal_stiffness.as_mut().unwrap() *= 1.0 + x;
            }));
        }
        compare(&model, &checks, 2e-7);
    }
}

/// Independent check: the same of contact that stiffens with pressure, whose base state moves with every number.
#[test]
fn sensitivities_of_stiffening_contact_equal_finite_differences() {
    let laws = [
        NormalLaw::Exponential { reference_pressure: 2e5, height: 4e-6 },
        NormalLaw::Cubic { stiffness: 8e11, cubic_stiffness: 5e22 },
    ];
    let moved = |law: NormalLaw, [first, second]: [f64; 2]| match law {
        NormalLaw::Exponential { reference_pressure, height } => NormalLaw::Exponential {
            reference_pressure: reference_pressure * (1.0 + first),
            height: height * (1.0 + second),
        },
        NormalLaw::Cubic { stiffness, cubic_stiffness } => NormalLaw::Cubic {
            stiffness: stiffness * (1.0 + first),
            cubic_stiffness: cubic_stiffness * (1.0 + second),
        },
    };
    for (law, element) in laws.into_iter().zip([ElementKind::Quad8, ElementKind::Quad4]) {
        let mut contact = contact(610.0);
        contact.interference = 3e-4;
        let mut options = paper_options();
        options.contact = stiffening(law);
        let specification = annulus(element, 24, 6);
        let model = CyclicModel { specification, material: POLYCARBONATE.into(), options, contact };
        // Shares of the values.
        let checks: [Check<'_>; 4] = [
            ("first number", 1.0, 1e-3, &|m, x| {
                m.options.contact = stiffening(moved(law, [x, 0.0]));
            }),
            ("second number", 1.0, 1e-3, &|m, x| {
                m.options.contact = stiffening(moved(law, [0.0, x]));
            }),
            ("E", 1.0, 1e-3, &|m, x| m.material.annulus.young_modulus *= 1.0 + x),
            ("nu", 1.0, 1e-3, &|m, x| m.material.annulus.poisson_ratio *= 1.0 + x),
        ];
        assert!(compare(&model, &checks, 1e-6) > 5);
    }
}

/// Independent check: the same of friction that falls with speed, and of the pressure that it acts under.
#[test]
fn sensitivities_to_a_falling_law_equal_finite_differences() {
    for normal_stiffness in [None, Some(7.4e12)] {
        let mut options = paper_options();
        options.contact.normal_stiffness = normal_stiffness;
        let contact = SlidingContact { interference: 3e-4, ..falling(300.0) };
        let specification = annulus(ElementKind::Quad4, 24, 6);
        let model = CyclicModel { specification, material: POLYCARBONATE.into(), options, contact };
        let checks: [Check<'_>; 4] = [
            ("q", 1.0, 1e-3, &|m, x| m.contact.decay.as_mut().unwrap().static_ratio += x),
            ("v_c", 1.0, 1e-3, &|m, x| m.contact.decay.as_mut().unwrap().decay_speed += x),
            ("E", 1.0, 1e-3, &|m, x| m.material.annulus.young_modulus += 2e9 * x),
            ("nu", 1.0, 1e-3, &|m, x| m.material.annulus.poisson_ratio += x),
        ];
        assert!(compare(&model, &checks, 1e-6) > 5);
    }
}
