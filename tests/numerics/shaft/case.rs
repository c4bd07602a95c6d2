//! Cases with a deformable shaft, good and bad.

use crate::prelude::*;

const CASE: &str =
    "[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\nshaft_inner_radius = 0.006
[mesh]\ncircumferential_elements = 24\nradial_elements = 5\nshaft_radial_elements = 2
[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.3805\ndensity = 1228.0
[materials.shaft]\nyoung_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0
[contact]\nfriction_coefficient = 0.3\ninterference = 25e-6\nrotation_speed_rpm = 610.0
[cea]\nmodes = 8
[cycle]\nharmonics = [2]
[frf]\nforce_node = 8\nfrequencies_hz = [1000.0]\n";

fn parse(from: &str, to: &str) -> Result<Case, String> {
    assert!(CASE.contains(from), "{from}");
    let text = CASE.replacen(from, to, 1);
    read_case("case.toml", &text, AS_IT_IS)
}

#[test]
fn a_case_describes_disc_and_shaft() {
    let case = parse("", "").unwrap();
    let shaft = case.body.grid().unwrap().shaft.unwrap();
    assert_eq!((shaft.inner_radius, shaft.radial_elements), (0.006, 2));
    assert_eq!(case.materials().of(1).young_modulus, 2.1e11);
    assert_eq!(case.mesh().unwrap().regions, ["disc", "shaft"]);
    assert_eq!(case.cost().nodes, 24 * 9);
    assert!(case.require_cea().is_ok());
}

#[test]
fn bad_shafts_are_refused_with_a_remedy() {
    for (from, to, key, remedy) in [
        ("[materials.shaft]", "[materials.disc]", "materials.disc", "[materials.shaft]"),
        (
            "[materials.shaft]\nyoung_modulus = 2.1e11\npoisson_ratio = 0.3\ndensity = 7850.0\n",
            "",
            "geometry.shaft_inner_radius",
            "add [materials.shaft]",
        ),
        ("shaft_inner_radius = 0.006", "", "materials.shaft", "give geometry.shaft_inner_radius"),
        (
            "shaft_inner_radius = 0.006",
            "shaft_inner_radius = 0.03",
            "geometry.shaft_inner_radius = 0.03",
            "must be below 0.0205",
        ),
        ("shaft_radial_elements = 2", "", "shaft_radial_elements", "missing"),
        (
            "[contact]",
            "[boundaries.bore]\ncondition = \"free\"\n[contact]",
            "holds the shaft",
            "tangential_stiffness above 0",
        ),
        (
            "[contact]",
            "[boundaries.shaft]\ncondition = \"clamped\"\n[contact]",
            "boundaries.shaft",
            "boundaries.bore",
        ),
    ] {
        let error = parse(from, to).unwrap_err();
        assert!(error.contains(key) && error.contains(remedy), "{to}: {error}");
    }
}

#[test]
fn rotating_waves_refuse_a_deformable_shaft() {
    let error = parse("", "").unwrap().require_rotating_waves().unwrap_err();
    let error = error.to_string();
    assert!(error.contains("geometry.shaft_inner_radius"), "{error}");
    assert!(error.contains("leave"), "{error}");
}
