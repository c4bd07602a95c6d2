//! Small motions of disc and shaft.

use super::*;

/// Limit: a shaft whose modulus is beyond all others is the rigid cylinder.
#[test]
fn a_shaft_a_million_times_stiffer_is_the_rigid_cylinder() {
    for element in [Quad4, Quad8] {
        let options = rigid_contact(true);
        let (frictions, limit) = ([0.0, 0.3, 0.6], Lowest(16));
        let stiff = model(with_shaft(element, 24, [2, 5]), stiffer(1e6), options);
        let rigid = model(annulus(element, 24, 5), POLYCARBONATE.into(), options);
        let [stiff, rigid] = [stiff, rigid].map(|own| own.swept(&frictions, limit).sweep);
        assert_same(&stiff, &rigid, [1e-6; 2], &format!("{element:?}"));
    }
}

/// Consistency check: derivatives by central differences of whole analyses.
#[test]
fn sensitivities_of_two_bodies_are_those_of_each_bodys_own_parameters() {
    let mut own = model(with_shaft(Quad4, 24, [2, 4]), on(STEEL), rigid_contact(true));
    // So much that the little it does to a stiff shaft stands above round-off.
    own.material.shaft.as_mut().unwrap().damping = Some(rayleigh_damping(5e3, 1e-6));
    let solve = |model: &AnnulusModel<AnnulusMaterials>| {
        model.swept(&[0.0, 0.3], MaxFrequency(12e3)).branches
    };
    let found = pairs(&own.tangent(), &solve(&own), 0.3);
    type Change = fn(&mut AnnulusModel<AnnulusMaterials>, f64);
    fn shaft(model: &mut AnnulusModel<AnnulusMaterials>) -> &mut RegionMaterial {
        model.material.shaft.as_mut().unwrap()
    }
    fn damping(model: &mut AnnulusModel<AnnulusMaterials>) -> &mut RayleighDamping {
        shaft(model).damping.as_mut().unwrap()
    }
    // Differences of eigenvalues as far as these are straight: the less they change, the longer.
    let checks: [(&str, f64, Change); 9] = [
        ("E", 1e-5, |m, f| m.material.annulus.young_modulus *= f),
        ("rho", 1e-5, |m, f| m.material.annulus.density *= f),
        ("nu", 1e-5, |m, f| m.material.annulus.poisson_ratio *= f),
        ("beta", 1e-5, |m, f| m.options.damping.stiffness_coefficient *= f),
        ("shaft E", 1e-5, |m, f| shaft(m).elastic.young_modulus *= f),
        ("shaft nu", 1e-5, |m, f| shaft(m).elastic.poisson_ratio *= f),
        ("shaft rho", 1e-5, |m, f| shaft(m).elastic.density *= f),
        ("shaft alpha", 0.5, |m, f| damping(m).mass_coefficient *= f),
        ("shaft beta", 0.01, |m, f| damping(m).stiffness_coefficient *= f),
    ];
    for (name, h, change) in checks {
        let moved = |factor: f64| own.with(|model| change(model, factor));
        let rates = rates(&found, STEP, &|share| moved(1.0 + share).tangent());
        let sides = [1.0 + h, 1.0 - h].map(|factor| solve(&moved(factor)));
        for like in [1, 4] {
            let [above, below] = sides.each_ref().map(|branches| {
                branches.iter().find(is_of(&found[like])).unwrap().interpolate(0.3).unwrap()
            });
            let difference = (above - below) / (2.0 * h);
            let error = (difference - rates[like]).norm() / rates[like].norm().max(1e-12);
            // Differences of eigenvalues that are converged to 1e-12.
            assert!(error < 1e-5, "{name} of {like}: {difference} {} {error:e}", rates[like]);
        }
    }
}
