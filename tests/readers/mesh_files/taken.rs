//! What a case takes from its mesh file: units, sections, includes, and the case that `init --from` writes.

use super::said_of;
use crate::prelude::*;
use crate::program;

/// Two bricks of 10 mm on each other, in mm, t and s; what is under them is clamped, a pressure presses, friction 0.4.
const BRICKS: &str = include_str!("../meshes/bricks-in-contact.inp");

const CASE: &str = "[mesh]\nfile = \"bricks.inp\"\nunits = \"mm-t-s\"\n[cea]\nmodes = 3\n";

fn taken(folder: impl AsRef<Path>, text: &str) -> Case {
    case_of(folder.as_ref().join("case.toml"), text, AS_IT_IS)
}

/// What is said of a case of this file.
fn refused(deck: &str, text: &str) -> String {
    said_of(folder_with(deck).path(), text)
}

fn folder_with(deck: &str) -> TempDir {
    // `Back` is a surface: to be held it needs to be a set of nodes, too.
    let deck = deck
        .replace("*SURFACE, NAME=Back", "*NSET, NSET=Back\n15, 16, 17, 18\n*SURFACE, NAME=Back");
    program::folder_with(&[("bricks.inp", deck.as_bytes())])
}

#[test]
fn a_file_in_millimetres_gives_a_case_in_si_units() {
    let case = taken(folder_with(BRICKS), CASE);
    let body = case.body.assembly().unwrap();
    let region = |name: &str| body.mesh.regions.iter().position(|r| r == name).unwrap();
    let lower = &case.body.materials[region("Lower")];
    assert_eq!(lower.elastic.young_modulus, 1.1e11);
    assert_eq!(lower.elastic.density, 7200.0);
    let upper = &case.body.materials[region("Upper")];
    assert_eq!(upper.damping.unwrap().mass_coefficient, 40.0);
    assert!((body.mesh.region_measures()[region("Lower")] / 1e-6 - 1.0).abs() < 1e-12);
    assert_eq!(body.contacts[0].stiffness.normal_stiffness, Some(2e13));
    assert_eq!(case.contact.sliding.friction_coefficient, 0.4);
    let motion = &body.motions[0];
    assert!((motion.rotation_speed - TAU).abs() < 1e-12);
    assert_eq!((motion.axis, motion.center), ([0.0, 0.0, 1.0], [0.1, 0.0, 0.0]));
    let condition = |name: &str| body.mesh.boundary(name).unwrap().condition;
    assert_eq!(condition("Back"), Pressure(1.5e6));
    assert_eq!(condition("Back_nodes"), Fixed([true, false, false]));
    assert_eq!(condition("Ground"), Clamped);
    assert_eq!(case.number("materials.Lower.young_modulus"), Some(1.1e11));
    // Everything taken is said.
    let materials = "materials taken from bricks.inp: Lower (Iron), Upper (Lining)";
    let others = "contacts taken ; motion taken ; boundaries taken";
    has(&case.taken.notes.join("\n"), &[materials, others]);
}

#[test]
fn sections_of_the_case_win_over_those_of_the_file() {
    let folder = folder_with(BRICKS);
    let text = CASE.to_owned()
        + "[materials.Upper]\nyoung_modulus = 8e9\n[boundaries.Back]\ncondition = \"free\"\n[contacts.Under]\nfriction_coefficient = 0.1\n";
    let case = taken(&folder, &text);
    let body = case.body.assembly().unwrap();
    let region = body.mesh.regions.iter().position(|r| r == "Upper").unwrap();
    let upper = &case.body.materials[region];
    assert_eq!([upper.elastic.young_modulus, upper.elastic.density], [8e9, 2500.0]);
    assert_eq!(body.mesh.boundary("Back").unwrap().condition, Free);
    assert_eq!(case.contact.sliding.friction_coefficient, 0.1);
    // A contact of the same surfaces under another name replaces that of the file.
    let own = CASE.to_owned()
        + "[contacts.mine]\nsurface = \"Over\"\ncounter = \"Under\"\nfriction_coefficient = 0.2\n";
    assert_eq!(taken(&folder, &own).body.assembly().unwrap().contacts.len(), 1);
    // Nothing but the mesh.
    let bare = CASE.replace("[cea]\nmodes = 3\n", "").replace("units", "take = \"nothing\"\nunits")
        + "[material]\nyoung_modulus = 2e11\npoisson_ratio = 0.3\ndensity = 7850.0\n";
    let case = taken(&folder, &bare);
    let body = case.body.assembly().unwrap();
    assert!(body.contacts.is_empty() && body.motions.is_empty());
    assert!(case.taken.left_out.iter().any(|left_out| left_out.reason.contains("mesh.take")));
}

#[test]
fn what_is_not_used_is_a_warning_and_what_is_wrong_has_its_line() {
    let load = BRICKS.replace("*STEP", "*CLOAD\n1, 1, 5.\n*STEP");
    has(&refused(&load, CASE), &["*CLOAD (line "]);
    let dropped = CASE.replace("[mesh]", "[mesh]\ndrop = [\"*CLOAD\"]");
    let left_out = taken(folder_with(&load), &dropped).taken.left_out;
    assert!(left_out.iter().any(|own| format!("{own:?}").contains("CLOAD")), "{left_out:?}");
    let folder = folder_with(&BRICKS.replace("*STEP", "*AMPLITUDE, NAME=A\n0., 1.\n*STEP"));
    has(&warnings(&taken(folder, CASE)), &["*AMPLITUDE (line "]);
    let wrong = BRICKS.replace("6000., 0.25", "6000., 0.75");
    has(&refused(&wrong, CASE), &["materials.Upper.poisson_ratio ; bricks.inp, line "]);
    // A material of two regions is told of once.
    let said = refused(&wrong.replace("MATERIAL=Iron", "MATERIAL=Lining"), CASE);
    assert_eq!(said.matches("poisson_ratio = 0.75").count(), 1);
    let both = CASE.replace("units", "scale = 0.001\nunits");
    has(&refused(BRICKS, &both), &["mesh.units and mesh.scale"]);
    // Millimetres read as metres.
    let metres = CASE.replace("units = \"mm-t-s\"\n", "");
    has(&refused(BRICKS, &metres), &["20.0000 m wide ; mesh.scale"]);
}

#[test]
fn included_files_stand_in_their_place_and_errors_name_them() {
    let folder = folder_with(BRICKS);
    let path = |name: &str| folder.path().join(name);
    let whole = fs::read_to_string(path("bricks.inp")).unwrap();
    let (nodes, rest) = whole.split_at(whole.find("*ELEMENT").unwrap());
    fs::create_dir(path("parts")).unwrap();
    fs::write(path("parts/nodes.inp"), nodes).unwrap();
    fs::write(path("parts/mesh.inp"), "** a comment\n*INCLUDE, INPUT=nodes.inp\n").unwrap();
    fs::write(path("bricks.inp"), format!("*Include, Input=\"parts/mesh.inp\"\n{rest}")).unwrap();
    assert_eq!(taken(&folder, CASE).body.assembly().unwrap().mesh.node_count(), 16);
    fs::write(path("parts/nodes.inp"), nodes.replace("7, 10, 10, 10", "7, 10, 1O, 10")).unwrap();
    let is_refused = |said: &str| has(&said_of(folder.path(), CASE), &[said]);
    is_refused("nodes.inp, line 8: a coordinate expected, found \"1O\"");
    fs::write(path("parts/nodes.inp"), "*INCLUDE, INPUT=mesh.inp\n").unwrap();
    is_refused("nodes.inp, line 1: cannot include mesh.inp: it includes this file itself");
    fs::remove_file(path("parts/nodes.inp")).unwrap();
    is_refused("mesh.inp, line 2: cannot include nodes.inp");
}

/// Consistency check: the sections that `init --from` writes are those that the case would take anyway.
#[test]
fn the_case_to_start_from_says_all_that_the_file_holds() {
    let folder = folder_with(BRICKS);
    let text = case_from(&folder.path().join("bricks.inp"), "bricks.inp").unwrap();
    has(&text, &["units = \"mm-t-s\""]);
    let started = taken(&folder, &text);
    let sections = &started.taken.sections;
    assert!(sections.iter().all(|section| section.path.0 == "material"), "{sections:?}");
    assert_eq!(started.body, taken(&folder, CASE).body);
    // A file without a motion gets one about the normal of the counter surface.
    let still = BRICKS
        .replace("*MOTION, ROTATION\nDisc, 6.283185307179586, 100., 0., 0., 100., 0., 5.\n", "");
    let folder = folder_with(&still);
    let text = case_from(&folder.path().join("bricks.inp"), "bricks.inp").unwrap();
    let case = taken(&folder, &text);
    let motion = &case.body.assembly().unwrap().motions[0];
    assert_eq!((motion.axis, motion.center), ([0.0, 0.0, 1.0], [0.005; 3]));
}
