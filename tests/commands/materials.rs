//! Materials as a user meets them: results beside theory, keys that name one number of a list, refusals.

use crate::prelude::*;
use frictionsim::case::{Cea, CeaMethod};
use frictionsim::study::eigenvalues::Solver;

fn read(overrides: &[&str]) -> Result<Case, CaseErrors> {
    read_case("disc.toml", include_str!("refused/orthotropic.toml"), overrides)
}

/// Theory (Lekhnitskii): a disc of cylindrical orthotropy in plane stress, clamped outside and widened inside:
/// `u = A (r^k - b^2k r^-k)`, `k^2 = E_theta / E_r`, `sigma_r = E_r / (1 - nu_rt nu_tr) (u' + nu_tr u / r)`.
#[test]
fn the_pressure_of_a_cylindrically_orthotropic_disc_is_lekhnitskiis() {
    let case = read(&[]).unwrap();
    let sector = Strip::of_annulus(case.body.annulus().unwrap()).unwrap();
    let elastic = sector.stiffness_alike(&case.body.materials);
    let state = SectorSliding::solve(&sector, &elastic, &case.contact.sliding, None).unwrap();
    let (a, b, k): (f64, f64, f64) = (0.0205, 0.0905, 2.5_f64.sqrt());
    let [e_r, nu_rt, nu_tr] = [2e9, 0.2, 0.2 * 2.5];
    let share = (a / b).powf(2.0 * k);
    let slope = -k * (1.0 + share) / (1.0 - share);
    let exact = -e_r / (1.0 - nu_rt * nu_tr) * 25e-6 / a * (slope + nu_tr);
    // Corners and middles of quadratic edges share the force: the mean over one sector's edge.
    let force: f64 = state.state.normal_forces[0].iter().sum();
    let mean = force / sector.mesh.contact_edge().tributary_lengths.iter().sum::<f64>();
    assert!((mean / exact - 1.0).abs() < 1e-3, "{mean} {exact}");
}

#[test]
fn one_number_of_a_list_is_set_by_its_place_counted_from_one() {
    for key in ["material.young_moduli[2]", "material.young_moduli.2"] {
        let case = read(&[&format!("{key}=4e9")]).unwrap();
        let orthotropy = case.material.orthotropy.unwrap();
        assert_eq!(orthotropy.young_moduli, [2e9, 4e9, 1.5e9]);
        assert_eq!(case.number(key), Some(4e9));
    }
    let study = "fit.parameters={\"material.shear_moduli[1]\"=[1e9, 2e9]}";
    let fit = read(&[study]).unwrap().fit.unwrap();
    assert_eq!(fit.parameters[0].parameter.key, "material.shear_moduli[1]");
}

/// Theory: a material that is isotropic across axis 3 has five constants, `G_12 = E_1 / (2 (1 + nu_12))`.
#[test]
fn five_constants_are_the_nine_of_a_transversely_isotropic_material() {
    let five = ["young_moduli=[8e9, 1.5e9]", "poisson_ratios=[0.25, 0.1]", "shear_moduli=[1e9]"];
    let nine = [
        "young_moduli=[8e9, 8e9, 1.5e9]",
        "poisson_ratios=[0.25, 0.1, 0.1]",
        "shear_moduli=[3.2e9, 1e9, 1e9]",
    ];
    let [five, nine] = [five, nine].map(|keys| {
        let keys = keys.map(|key| format!("material.{key}"));
        read(&keys.each_ref().map(String::as_str)).unwrap().material
    });
    assert_eq!(five, nine);
    // A disc of revolution takes its axis 3 along z.
    assert!(five.orthotropy.unwrap().is_invariant_about_z());
}

#[test]
fn structural_damping_has_its_meaning_or_is_refused() {
    let lossy = "material.loss_factor=0.1 ; mesh.element=quad4 ; \
        transient={ duration=1e-4, expansion_time=5e-5 }";
    let case = read(&[lossy]).unwrap();
    let message = case.require_transient().unwrap_err().to_string();
    has(&message, &["material.loss_factor ; cea.max_frequency_hz ; stiffness_coefficient"]);
    // With a band to keep it over, a chain stands for it, whose error is known.
    let stepped = read(&[lossy, "cea.max_frequency_hz=12000.0"]).unwrap();
    stepped.require_transient().unwrap();
    let chain = stepped.relaxed.as_ref().unwrap()[0].chain.as_ref().unwrap();
    assert_eq!(chain.band_hz, [120.0, 12000.0]);
    assert!(chain.largest_error < 0.15, "{}", chain.largest_error);
    for method in [CeaMethod::Auto, CeaMethod::Cyclic] {
        let cea = Cea { count_modes: true, method, ..case.require_cea().unwrap().clone() };
        assert_eq!(Solver::of_analysis(&case, &cea).unwrap(), Solver::Waves);
    }
}

/// A ring whose layers are two regions, each with a section of its own.
const TWO_REGIONS: &str = include_str!("../cases/ring-of-two-regions.toml");

#[test]
fn a_common_material_is_asked_for_only_where_a_region_has_none() {
    let region = |layer| if layer < 2 { "disc" } else { "rim" };
    let ring = ring_grid([0.0205, 0.0905], [16, 4], ["inner", "outer"], &region);
    let folder = folder_with(&[("ring.msh", &grids(&[ring]))]);
    let read = |text: &str| read_case(folder.path().join("case.toml"), text, AS_IT_IS);
    let case = read(TWO_REGIONS).unwrap();
    // What asks for one material gets that of the first region.
    assert_eq!([case.material.young_modulus, case.material.density], [2.5e9, 1228.0]);
    // A formulation alone is no material.
    read(&format!("{TWO_REGIONS}[material]\nformulation = \"plane-stress\"\n")).unwrap();
    let (text, rest) = TWO_REGIONS.split_once("[materials.rim]").unwrap();
    let (_, rest) = rest.split_once("[boundaries").unwrap();
    let bare = read(&format!("{text}[boundaries{rest}")).unwrap_err().to_string();
    has(&bare, &["ring.msh: the region \"rim\" has no material ; [materials.rim] ; [material]"]);
}
