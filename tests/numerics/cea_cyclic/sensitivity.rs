//! Independent check: sensitivities against finite differences of the whole analysis.

use crate::cea_cyclic::model::paper_options;
use crate::prelude::*;
use crate::waves::{STEP, difference, is_of, pairs, rates};
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

/// One eigenvalue of a changed model, by following its branch.
fn eigenvalue_of(model: &CyclicModel, like: &WavePair, friction: f64) -> c64 {
    let found = swept(model, &[friction], 17600.0);
    found.branches.iter().find(is_of(like)).unwrap().interpolate(friction).unwrap()
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
        for (pair, rate) in pairs.iter().zip(rates) {
            let numeric = difference(*step, &|share| eigenvalue_of(&moved(share), pair, FRICTION));
            // Relative to the change over the parameter's own size, and to |lambda| where that is tiny.
            let error = (rate * *value - numeric).norm();
            let size = numeric.norm() + 1e-3 * pair.eigenvalue.norm();
            assert!(error < tolerance * size, "{name} {pair:?} {numeric} {:e}", error / size);
        }
    }
    for pair in &pairs {
        let numeric = difference(1e-3, &|more| eigenvalue_of(model, pair, FRICTION + more));
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
    let of = |law: NormalLaw| stiffening(law);
    for (law, element) in laws.into_iter().zip([ElementKind::Quad8, ElementKind::Quad4]) {
        let mut contact = contact(610.0);
        contact.interference = 3e-4;
        let mut options = paper_options();
        options.contact = of(law);
        let specification = annulus(element, 24, 6);
        let model = CyclicModel { specification, material: POLYCARBONATE.into(), options, contact };
        // Shares of the values.
        let checks: [Check<'_>; 4] = [
            ("first number", 1.0, 1e-3, &|m, x| m.options.contact = of(moved(law, [x, 0.0]))),
            ("second number", 1.0, 1e-3, &|m, x| m.options.contact = of(moved(law, [0.0, x]))),
            ("E", 1.0, 1e-3, &|m, x| m.material.annulus.young_modulus *= 1.0 + x),
            ("nu", 1.0, 1e-3, &|m, x| m.material.annulus.poisson_ratio *= 1.0 + x),
        ];
        assert!(compare(&model, &checks, 1e-6) > 5);
    }
}
