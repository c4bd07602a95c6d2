//! Small motions of disc and shaft.

use crate::disc::{POLYCARBONATE, annulus, contact};
use crate::shaft::model::{STEEL, on, rigid_contact, spectrum, stiffer, with_shaft};
use faer::c64;
use frictionsim::cea::cyclic::sensitivities;
use frictionsim::cea::{ComplexMode, ModeLimit, SweepRequest, sparse};
use frictionsim::contact::ContactStiffness;
use frictionsim::fem::{
    AnnulusMaterials, MassKind, RayleighDamping, RegionMaterial, assemble_stiffness,
};
use frictionsim::mesh::{AnnulusMesh, BoundaryCondition, ElasticSupport, ElementKind};
use frictionsim::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};

fn nearest(mode: &ComplexMode, others: &[ComplexMode]) -> f64 {
    let same = others.iter().filter(|m| {
        (m.harmonic, m.branch, m.direction) == (mode.harmonic, mode.branch, mode.direction)
    });
    let distances = same.map(|m| (m.eigenvalue - mode.eigenvalue).norm());
    distances.fold(f64::MAX, f64::min) / mode.eigenvalue.norm()
}

/// Cross-method check: the sparse solver on the whole mesh knows nothing of the symmetry.
#[test]
fn cyclic_and_sparse_spectra_of_two_bodies_are_the_same() {
    let penalty = ContactStiffness {
        normal_stiffness: Some(7.4e12),
        normal_damping: 1e3,
        tangential_damping: 2e3,
        ..ContactStiffness::default()
    };
    let damped = |mut materials: AnnulusMaterials| {
        if let Some(shaft) = &mut materials.shaft {
            shaft.damping =
                Some(RayleighDamping { mass_coefficient: 5.0, stiffness_coefficient: 1e-8 });
        }
        materials
    };
    let cases = [
        (ElementKind::Quad4, 20, rigid_contact(true), on(POLYCARBONATE)),
        (ElementKind::Quad8, 12, rigid_contact(true), damped(on(STEEL))),
        (
            ElementKind::Quad4,
            18,
            TangentOptions {
                contact: penalty,
                damping_model: DampingModel::BodyOnly,
                mass: MassKind::Lumped,
                ..rigid_contact(true)
            },
            on(POLYCARBONATE),
        ),
    ];
    for (k, (element, around, options, materials)) in cases.into_iter().enumerate() {
        let mut specification = with_shaft(element, around, [2, 4]);
        if k == 2 {
            let spring = ElasticSupport {
                loss_factor: 0.0,
                normal_stiffness: 1e13,
                tangential_stiffness: 2e13,
                axial_stiffness: 0.0,
                normal_damping: 10.0,
                tangential_damping: 0.0,
            };
            let shaft = specification.shaft.as_mut().unwrap();
            shaft.bore = BoundaryCondition::Support(spring);
        }
        let frictions = [0.0, 0.3, 0.6];
        let limit = ModeLimit::Lowest(12);
        let cyclic = spectrum(&specification, &materials, &options, &frictions, limit).sweep;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let elastic = assemble_stiffness(&mesh, &materials);
        let base = SteadySliding::solve(&mesh, &elastic, &contact(610.0)).unwrap();
        let tangent = SlidingTangent::linearize(&mesh, &materials, &elastic, &base, &options);
        let request = SweepRequest {
            friction_coefficients: &frictions,
            limit,
            shapes_at: &[],
            count_modes: false,
        };
        let sparse = sparse::sweep(&tangent, &request, &|_| {}).unwrap();
        for (ours, theirs) in cyclic.points.iter().zip(&sparse.points) {
            for mode in &ours.modes {
                let distance = nearest(mode, &theirs.modes);
                assert!(distance < 1e-9, "case {k} {mode:?} {distance:e}");
            }
        }
        for (ours, theirs) in cyclic.intervals.iter().zip(&sparse.intervals) {
            assert!((ours.critical_friction - theirs.critical_friction).abs() < 1e-7);
        }
        assert!(!cyclic.intervals.is_empty(), "case {k}");
    }
}

/// Limit: a shaft whose modulus is beyond all others is the rigid cylinder.
#[test]
fn a_shaft_a_million_times_stiffer_is_the_rigid_cylinder() {
    for element in [ElementKind::Quad4, ElementKind::Quad8] {
        let options = rigid_contact(true);
        let (frictions, limit) = ([0.0, 0.3, 0.6], ModeLimit::Lowest(16));
        let soft = with_shaft(element, 24, [2, 5]);
        let stiff = spectrum(&soft, &stiffer(1e6), &options, &frictions, limit).sweep;
        let alone = AnnulusMaterials::from(POLYCARBONATE);
        let rigid = annulus(element, 24, 5);
        let rigid = spectrum(&rigid, &alone, &options, &frictions, limit).sweep;
        for (ours, theirs) in stiff.points.iter().zip(&rigid.points) {
            assert_eq!(ours.modes.len(), theirs.modes.len());
            for mode in &ours.modes {
                let distance = nearest(mode, &theirs.modes);
                assert!(distance < 1e-6, "{element:?} {mode:?} {distance:e}");
            }
        }
    }
}

/// Consistency check: derivatives by central differences of whole analyses.
#[test]
fn sensitivities_of_two_bodies_are_those_of_each_bodys_own_parameters() {
    let specification = with_shaft(ElementKind::Quad4, 24, [2, 4]);
    let options = rigid_contact(true);
    let materials = |change: &dyn Fn(&mut AnnulusMaterials)| {
        let mut materials = on(STEEL);
        // So much that the little it does to a stiff shaft stands above round-off.
        materials.shaft.as_mut().unwrap().damping =
            Some(RayleighDamping { mass_coefficient: 5e3, stiffness_coefficient: 1e-6 });
        change(&mut materials);
        materials
    };
    let limit = ModeLimit::MaxFrequency(12e3);
    let solve = |materials: &AnnulusMaterials, options: &TangentOptions| {
        spectrum(&specification, materials, options, &[0.0, 0.3], limit)
    };
    let found = sensitivities(&solve(&materials(&|_| {}), &options), 0.3).unwrap();
    let eigenvalue = |materials: &AnnulusMaterials, options: &TangentOptions, like: usize| {
        let modes = solve(materials, options).sweep.points.pop().unwrap().modes;
        let of = &found[like];
        let is_same = |m: &&ComplexMode| {
            (m.harmonic, m.branch, m.direction) == (of.harmonic, of.branch, of.direction)
        };
        modes.iter().find(is_same).unwrap().eigenvalue
    };
    let check = |like: usize, name: &str, expected: c64, by: &dyn Fn(f64) -> c64, value: f64| {
        // As far as eigenvalues are straight: the less they change, the longer.
        let h = match name {
            "shaft alpha" => 0.5,
            "shaft beta" => 0.01,
            _ => 1e-5,
        };
        let difference = (by(1.0 + h) - by(1.0 - h)) / (2.0 * h * value);
        let error = (difference - expected).norm() / expected.norm().max(1e-12);
        println!("{name} of {like}: {error:e}");
        // Differences of eigenvalues that are converged to 1e-12.
        assert!(error < 1e-5, "{name} of {like}: {difference} {expected}");
    };
    for like in [1, 4] {
        let own = &found[like];
        let modulus =
            |f: f64| eigenvalue(&materials(&|m| m.annulus.young_modulus *= f), &options, like);
        check(like, "E", own.young_modulus.unwrap(), &modulus, 2.5e9);
        let density = |f: f64| eigenvalue(&materials(&|m| m.annulus.density *= f), &options, like);
        check(like, "rho", own.density, &density, 1228.0);
        let ratio =
            |f: f64| eigenvalue(&materials(&|m| m.annulus.poisson_ratio *= f), &options, like);
        check(like, "nu", own.poisson_ratio.unwrap(), &ratio, 0.3805);
        let beta = |f: f64| {
            let mut options = options;
            options.damping.stiffness_coefficient *= f;
            eigenvalue(&materials(&|_| {}), &options, like)
        };
        check(like, "beta", own.stiffness_coefficient, &beta, 4.5e-7);
        let shaft = |change: &dyn Fn(&mut RegionMaterial)| {
            let changed = materials(&|m| change(m.shaft.as_mut().unwrap()));
            eigenvalue(&changed, &options, like)
        };
        let damping = |shaft: &mut RegionMaterial, factors: [f64; 2]| {
            let own = shaft.damping.as_mut().unwrap();
            own.mass_coefficient *= factors[0];
            own.stiffness_coefficient *= factors[1];
        };
        let by = |name: &str, i: usize, value: f64, change: &dyn Fn(&mut RegionMaterial, f64)| {
            let changed = |f: f64| shaft(&|region| change(region, f));
            check(like, name, own.shaft[i].unwrap(), &changed, value);
        };
        by("shaft E", 0, STEEL.young_modulus, &|m, f| m.elastic.young_modulus *= f);
        by("shaft nu", 1, STEEL.poisson_ratio, &|m, f| m.elastic.poisson_ratio *= f);
        by("shaft rho", 2, STEEL.density, &|m, f| m.elastic.density *= f);
        by("shaft alpha", 3, 5e3, &|m, f| damping(m, [f, 1.0]));
        by("shaft beta", 4, 1e-6, &|m, f| damping(m, [1.0, f]));
    }
}
