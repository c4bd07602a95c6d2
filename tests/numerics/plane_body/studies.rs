//! Studies of imported bodies solve those bodies.
//!
//! A consistency check against the generated disc of the same mesh, and against the eigenvalue analysis of a body without
//! symmetry: its hub is round, its outer edge an oval about another centre.

use crate::body_sensitivity::oval;
use crate::prelude::*;
use frictionsim::results::Finding;
use frictionsim::study::fit::refuse_too_few;
use frictionsim::study::uncertainty::{Sampler, summarize};

pub const MODEL: &str = include_str!("../../cases/imported-disc.toml");
const STUDIES: &str = include_str!("../../cases/studies.toml");
const GENERATED: &str = "[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\n\
    [mesh]\ncircumferential_elements = 18\nradial_elements = 3\n";

fn folder() -> TempDir {
    let mesh = AnnulusMesh::generate(&annulus(Quad4, 18, 3)).unwrap().mesh;
    let disc = write_msh(&mesh, FORMS[2], &[], |point| point);
    let oval = write_msh(&mesh, FORMS[2], &[], oval);
    folder_with(&[("disc.msh", &disc), ("oval.msh", &oval)])
}

fn read(folder: &TempDir, mesh: &str, set: &[&str]) -> Result<Case, CaseErrors> {
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
    let found = modes_and_onsets(case).unwrap().intervals.into_iter();
    found.map(|i| [i.critical_friction, i.frequency_hz]).collect()
}

/// Onsets are located to 1e-8 by either solver.
#[test]
fn imported_disc_has_the_onsets_of_the_generated_one() {
    let folder = folder();
    for density in ["material.density=1000", "material.density=1600"] {
        let of = |mesh: &str| onsets(&case(&folder, mesh, &[density]));
        near_each(&of("disc.msh")[0], &of("")[0], 1e-6);
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
            let own = sample.onsets.iter().map(|own| [own.critical_friction, own.frequency_hz]);
            let own: Vec<[f64; 2]> = own.collect();
            near_each(own.as_flattened(), expected.as_flattened(), 1e-6);
            assert!((own[0][0] - 0.3).abs() > 0.01, "{own:?}");
            assert!(sample.onsets.iter().all(|onset| onset.harmonic.is_none()));
        }
        let summary = summarize(&body, &samples);
        let median = summary.critical_friction.median.unwrap();
        assert!((median - 0.3).abs() > 0.01, "{median}");
        has(&summary.document().to_text(), &["!n ="]);
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
    let perturbation = &body.transient.as_ref().unwrap().settings.perturbation;
    let expected = 0.5 * body.contact.sliding.rotation_speed * 0.0905;
    near(perturbation.waves[0].velocity, expected, 1e-9);
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
    has(&held("damping = 1e3").unwrap_err().to_string(), &["nothing holds the body"]);
    let sweep = modes_and_onsets(&held("stiffness = 1e9").unwrap()).unwrap();
    assert_eq!(sweep.points[0].modes.len(), 6);
}

/// A check solves no base state: it says what it knows at once.
#[test]
fn a_check_of_an_imported_body_estimates_its_own_size() {
    let folder = folder();
    let [disc, body] = ["", "disc.msh"].map(|mesh| case(&folder, mesh, &[]).cost());
    let sizes = [&disc, &body].map(|own| [own.nodes, own.elements, own.dofs]);
    assert_eq!(sizes[0], sizes[1]);
    // The whole mesh costs more than its harmonics.
    let [cyclic, sparse] = [disc, body].map(|cost| cost.cea.unwrap().run.operations);
    assert!(sparse > cyclic, "{sparse} {cyclic}");
    let forced = case(&folder, "", &["cea.method=sparse"]).cost();
    assert_eq!(forced.cea.unwrap().run.operations, sparse);
}

#[test]
fn a_table_of_more_modes_than_anybody_measures_is_refused_at_once() {
    let body = case(&folder(), "disc.msh", &[]);
    let many = (0..20_000).map(|k| measured_mode(k + 2, 1e3 + k as f64, None));
    let many = refuse_too_few(&body, &many.collect::<Vec<_>>()).unwrap_err();
    has(&many.to_string(), &["20000 lines, at most 1000"]);
    let none = refuse_too_few(&body, &[measured_mode(2, 1e-320, None)]).unwrap_err();
    has(&none.to_string(), &["no frequency of a mode"]);
    assert!(none.is_usage());
}
