//! Studies of imported bodies solve those bodies.
//!
//! A consistency check against the generated disc of the same mesh, and against the eigenvalue analysis of a body without
//! symmetry: its hub is round, its outer edge an oval about another centre.

use crate::prelude::*;
use frictionsim::results::uncertainty::document;
use frictionsim::study::fit::{MeasuredMode, fit_case, refuse_too_few};
use frictionsim::study::uncertainty::{Sampler, summarize};

pub const MODEL: &str = "[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.3805\n\
    density = 1228.0\n\
    [damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 4.5e-7\n\
    [contact]\nfriction_coefficient = 0.3\ninterference = 25e-6\nrotation_speed_rpm = 610.0\n";
const STUDIES: &str = "[cea]\nmodes = 6\nfriction_coefficients = [0.0, 0.5]\ngeometric_stiffness = false\n\
    [uncertainty]\nsamples = 2\nindex_samples = 0\n\
    [uncertainty.distributions]\n\"material.young_modulus\" = { uniform = [2.4e9, 2.6e9] }\n\
    [fit]\nstarts = 1\n[fit.parameters]\n\"material.density\" = [800.0, 2000.0]\n";
const GENERATED: &str = "[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\n\
    [mesh]\ncircumferential_elements = 18\nradial_elements = 3\n";

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mesh = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 18, 3)).unwrap().mesh;
    let oval = |[x, y]: [f64; 2]| {
        let outwards = (x.hypot(y) - 0.0205) / 0.07;
        [x * (1.0 + 0.3 * outwards) + 0.006 * outwards, y * (1.0 - 0.1 * outwards)]
    };
    let disc = write_msh(&mesh, FORMS[2], &[], |point| point);
    fs::write(folder.path().join("disc.msh"), disc).unwrap();
    let oval = write_msh(&mesh, FORMS[2], &[], oval);
    fs::write(folder.path().join("oval.msh"), oval).unwrap();
    folder
}

fn read(folder: &TempDir, mesh: &str, set: &[&str]) -> Result<Case, String> {
    let name = folder.path().join("case.toml").display().to_string();
    let text = match mesh {
        "" => format!("{GENERATED}{MODEL}{STUDIES}"),
        file => format!(
            "[mesh]\nfile = \"{file}\"\n[boundaries.outer]\ncondition = \"clamped\"\n{MODEL}{STUDIES}"
        ),
    };
    read_case(name, &text, set)
}

fn case(folder: &TempDir, mesh: &str, set: &[&str]) -> Case {
    read(folder, mesh, set).unwrap()
}

/// Critical friction and frequency of every onset that the eigenvalue analysis of a case has.
fn onsets(case: &Case) -> Vec<[f64; 2]> {
    let found = modes_and_onsets(case).unwrap().intervals;
    let onsets = found.iter();
    onsets.map(|i| [i.critical_friction, i.frequency_hz]).collect()
}

pub fn line(number: usize, frequency_hz: f64) -> MeasuredMode {
    MeasuredMode {
        line: number,
        frequency_hz,
        real_hz: None,
        harmonic: None,
        sigma_hz: None,
        is_unstable: false,
    }
}

fn assert_same(found: &[[f64; 2]], expected: &[[f64; 2]], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (a, b) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((a / b - 1.0).abs() < tolerance, "{found:?} {expected:?}");
    }
}

/// Onsets are located to 1e-8 by either solver.
#[test]
fn imported_disc_has_the_onsets_of_the_generated_one() {
    let folder = folder();
    for density in ["material.density=1000", "material.density=1600"] {
        let of = |mesh: &str| onsets(&case(&folder, mesh, &[density]));
        assert_same(&of("disc.msh")[..1], &of("")[..1], 1e-6);
    }
}

/// The case's own friction coefficient, 0.3, is no onset; it used to be given in its place.
#[test]
fn uncertainty_finds_the_lowest_critical_friction_of_an_imported_body() {
    let folder = folder();
    for mesh in ["disc.msh", "oval.msh"] {
        let body = case(&folder, mesh, &[]);
        let samples = Sampler::new(&body).unwrap().block(1);
        for sample in &samples {
            assert_eq!(sample.error, None);
            let set = format!("material.young_modulus={:?}", sample.values[0]);
            let expected = onsets(&case(&folder, mesh, &[&set]));
            let own = sample.onsets.iter();
            let own: Vec<[f64; 2]> =
                own.map(|onset| [onset.critical_friction, onset.frequency_hz]).collect();
            assert_same(&own, &expected, 1e-6);
            assert!((own[0][0] - 0.3).abs() > 0.01, "{own:?}");
            assert!(sample.onsets.iter().all(|onset| onset.harmonic.is_none()));
        }
        let summary = summarize(&body, &samples);
        let median = summary.critical_friction.median.unwrap();
        assert!((median - 0.3).abs() > 0.01, "{median}");
        let text = document(&summary).to_text();
        assert!(!text.contains("n ="), "{text}");
    }
}

#[test]
fn no_study_solves_an_imported_body_by_sectors() {
    let body = case(&folder(), "oval.msh", &["cea.method=cyclic"]);
    let refusal = |text: String| {
        assert!(text.contains("needs a body of equal sectors"), "{text}");
    };
    refusal(modes_and_onsets(&body).unwrap_err().messages().join("; "));
    let sampler = Sampler::new(&body).map(|_| ());
    refusal(sampler.unwrap_err().messages().join("; "));
    refusal(fit_case(&body, &[line(2, 1e4)], None).unwrap_err().messages().join("; "));
}

#[test]
fn rotating_waves_are_sought_in_no_imported_body() {
    let set = ["basin={ harmonics = [1, 2] } ; cycle={ confirmation_periods = 0 } ; \
         transient={ duration = 1e-4, initial = \"limit-cycle\", limit_cycle_harmonic = 1 }"];
    let body = case(&folder(), "disc.msh", &set);
    let errors =
        [body.require_rotating_waves().unwrap_err(), body.require_transient().unwrap_err()];
    for error in errors {
        let text = error.to_string();
        assert!(text.contains("rotational symmetry of the built-in annulus"), "{text}");
    }
    // Its limit cycles are periodic motions of the whole mesh, and its modes compete.
    let error = body.require_basin().unwrap_err().to_string();
    assert!(error.contains("basin.harmonics is not used"), "{error}");
    assert!(body.require_cycle().is_ok() && !body.has_rotating_waves());
}

/// Warnings and limits compare an imported body with its own size, and name keys that the case has.
#[test]
fn warnings_name_no_radius_that_an_imported_body_does_not_have() {
    let folder = folder();
    let body = case(&folder, "oval.msh", &["contact.interference=0.02"]);
    let said: Vec<String> = body.warnings.iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|text| text.contains("contact.interference")), "{said:?}");
    let large = case(&folder, "oval.msh", &["mesh.scale=1000", "contact.interference=0.1"]);
    let wide: Vec<String> = large.warnings.iter().map(ToString::to_string).collect();
    assert!(wide.iter().any(|text| text.contains("m wide")), "{wide:?}");
    for text in said.iter().chain(&wide) {
        assert!(!text.contains("geometry.inner_radius"), "{text}");
        assert!(!text.contains("geometry.outer_radius"), "{text}");
    }
}

/// On a cylinder outside the body, and on a plane, the slip speed is not that of a cylinder within.
#[test]
fn relative_seeds_of_an_imported_body_are_shares_of_its_own_slip_speed() {
    let set = [
        "transient={ duration = 1e-4, expansion_time = 1e-5, perturbation = { harmonics = [1], velocity = 0.5, relative = true } } ; \
         contact.boundary=outer ; boundaries={ inner = { condition = \"clamped\" } }",
    ];
    let body = case(&folder(), "disc.msh", &set);
    let perturbation = &body.transient.as_ref().unwrap().perturbation;
    let expected = 0.5 * body.contact.sliding.rotation_speed * 0.0905;
    let found = perturbation.waves[0].velocity;
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

#[test]
fn keys_that_have_no_effect_beside_a_mesh_file_are_said() {
    let set = ["mesh.circumferential_elements=10", "geometry.inner_radius=0.02"];
    let body = case(&folder(), "disc.msh", &set);
    let said: Vec<String> = body.warnings.iter().map(ToString::to_string).collect();
    for key in ["mesh.circumferential_elements", "geometry.inner_radius"] {
        let expected = format!("{key} is not used: mesh.file describes the body");
        assert!(said.iter().any(|text| text.contains(&expected)), "{said:?}");
    }
}

/// Contact around a hole holds a disc but for its turning, which sliding friction does not stop: a spring at a node of the rim does.
#[test]
fn a_spring_at_a_node_holds_a_body_that_no_boundary_holds() {
    let folder = folder();
    let free = "boundaries={ outer = { condition = \"free\" } }";
    let held = |stiffness: &str| {
        let spring = "at = { radius = 0.0905, angle_deg = 20 }";
        let spring = format!("modifications.stop={{ {spring}, {stiffness} }}");
        read(&folder, "disc.msh", &[free, &spring])
    };
    let error = held("damping = 1e3").unwrap_err();
    assert!(error.contains("nothing holds the body"), "{error}");
    let sweep = modes_and_onsets(&held("stiffness = 1e9").unwrap()).unwrap();
    assert_eq!(sweep.points[0].modes.len(), 6);
}

/// A contact at rest sticks: no study takes it for one that slides.
#[test]
fn no_study_takes_a_contact_at_rest_for_one_that_slides() {
    let folder = folder();
    for mesh in ["", "disc.msh"] {
        let still = case(&folder, mesh, &["contact.rotation_speed_rpm=0"]);
        let text = modes_and_onsets(&still).unwrap_err().messages().join("; ");
        assert!(text.contains("the contact sticks at rest"), "{text}");
        let error = Sampler::new(&still).map(|_| ()).unwrap_err();
        let text = error.messages().join("; ");
        assert!(text.contains("the contact sticks at rest"), "{text}");
    }
}

/// A check solves no base state: it says what it knows at once.
#[test]
fn a_check_of_an_imported_body_estimates_its_own_size() {
    let folder = folder();
    let [disc, body] = ["", "disc.msh"].map(|mesh| case(&folder, mesh, &[]).cost());
    assert_eq!(body.nodes, disc.nodes);
    assert_eq!(body.elements, disc.elements);
    assert_eq!(body.dofs, disc.dofs);
    // The whole mesh costs more than its harmonics.
    let [cyclic, sparse] = [disc, body].map(|cost| cost.cea.unwrap().run.operations);
    assert!(sparse > cyclic, "{sparse} {cyclic}");
    let forced = case(&folder, "", &["cea.method=sparse"]).cost();
    assert_eq!(forced.cea.unwrap().run.operations, sparse);
}

#[test]
fn a_table_of_more_modes_than_anybody_measures_is_refused_at_once() {
    let body = case(&folder(), "disc.msh", &[]);
    let many: Vec<MeasuredMode> = (0..20_000).map(|k| line(k + 2, 1e3 + k as f64)).collect();
    let text = refuse_too_few(&body, &many).unwrap_err().to_string();
    assert!(text.contains("20000 lines, at most 1000"), "{text}");
    let text = refuse_too_few(&body, &[line(2, 1e-320)]).unwrap_err();
    assert!(text.to_string().contains("no frequency of a mode"), "{text}");
    assert!(text.is_usage());
}
