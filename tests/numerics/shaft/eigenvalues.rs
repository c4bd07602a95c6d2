//! Small motions of disc and shaft.

use crate::prelude::*;
use crate::shaft::model::{STEEL, on, rigid_contact, spectrum, stiffer, with_shaft};
use crate::waves::{STEP, is_of, pairs, rates};

/// Cross-method check: the sparse solver on the whole mesh knows nothing of the symmetry.
#[test]
fn cyclic_and_sparse_spectra_of_two_bodies_are_the_same() {
    let penalty = compliant(7.4e12, [1e3, 2e3]);
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
            let spring = springs([1e13, 2e13, 0.0], [10.0, 0.0]);
            let shaft = specification.shaft.as_mut().unwrap();
            shaft.bore = BoundaryCondition::Support(spring);
        }
        let frictions = [0.0, 0.3, 0.6];
        let limit = ModeLimit::Lowest(12);
        let cyclic = spectrum(&specification, &materials, &options, &frictions, limit).sweep;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let tangent = linearized(&mesh, &materials, &contact(610.0), &options);
        let request = sweep_request(&frictions, limit);
        let sparse = sparse::sweep(&tangent, &request, &|_| {}).unwrap();
        assert_same(&cyclic, &sparse, [1e-9, 1e-7], &format!("case {k}"));
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
        assert_same(&stiff, &rigid, [1e-6; 2], &format!("{element:?}"));
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
    let tangent = |materials: &AnnulusMaterials, options: &TangentOptions| {
        let sector = SectorMesh::generate(&specification).unwrap();
        WaveTangent::of_annulus(&sector, materials, options, &contact(610.0)).unwrap()
    };
    let own = materials(&|_| {});
    let found = pairs(&tangent(&own, &options), &solve(&own, &options).branches, 0.3);
    let damping = |shaft: &mut RegionMaterial, factors: [f64; 2]| {
        let own = shaft.damping.as_mut().unwrap();
        own.mass_coefficient *= factors[0];
        own.stiffness_coefficient *= factors[1];
    };
    type Change<'a> = &'a dyn Fn(&mut AnnulusMaterials, &mut TangentOptions, f64);
    let shaft = |m: &mut AnnulusMaterials, change: &dyn Fn(&mut RegionMaterial)| {
        change(m.shaft.as_mut().unwrap());
    };
    // Differences of eigenvalues as far as these are straight: the less they change, the longer.
    let checks: [(&str, f64, Change<'_>); 9] = [
        ("E", 1e-5, &|m, _, f| m.annulus.young_modulus *= f),
        ("rho", 1e-5, &|m, _, f| m.annulus.density *= f),
        ("nu", 1e-5, &|m, _, f| m.annulus.poisson_ratio *= f),
        ("beta", 1e-5, &|_, options, f| options.damping.stiffness_coefficient *= f),
        ("shaft E", 1e-5, &|m, _, f| shaft(m, &|own| own.elastic.young_modulus *= f)),
        ("shaft nu", 1e-5, &|m, _, f| shaft(m, &|own| own.elastic.poisson_ratio *= f)),
        ("shaft rho", 1e-5, &|m, _, f| shaft(m, &|own| own.elastic.density *= f)),
        ("shaft alpha", 0.5, &|m, _, f| shaft(m, &|own| damping(own, [f, 1.0]))),
        ("shaft beta", 0.01, &|m, _, f| shaft(m, &|own| damping(own, [1.0, f]))),
    ];
    for (name, h, change) in checks {
        let moved = |factor: f64| {
            let (mut materials, mut options) = (own, options);
            change(&mut materials, &mut options, factor);
            (materials, options)
        };
        let rates = rates(&found, STEP, &|share| {
            let (materials, options) = moved(1.0 + share);
            tangent(&materials, &options)
        });
        let sides = [1.0 + h, 1.0 - h].map(|factor| {
            let (materials, options) = moved(factor);
            solve(&materials, &options).branches
        });
        for like in [1, 4] {
            let [above, below] = sides.each_ref().map(|branches| {
                let branch = branches.iter().find(is_of(&found[like])).unwrap();
                branch.interpolate(0.3).unwrap()
            });
            let difference = (above - below) / (2.0 * h);
            let error = (difference - rates[like]).norm() / rates[like].norm().max(1e-12);
            // Differences of eigenvalues that are converged to 1e-12.
            assert!(error < 1e-5, "{name} of {like}: {difference} {} {error:e}", rates[like]);
        }
    }
}
