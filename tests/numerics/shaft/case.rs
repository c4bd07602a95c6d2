//! Cases with a deformable shaft, good and bad.

use crate::prelude::*;

const CASE: &str = include_str!("../../commands/refused/shaft.toml");

fn case() -> Case {
    case_of("case.toml", CASE, AS_IT_IS)
}

#[test]
fn a_case_describes_disc_and_shaft() {
    let case = case();
    let shaft = case.body.grid().unwrap().shaft.unwrap();
    assert_eq!((shaft.inner_radius, shaft.radial_elements), (0.006, 2));
    assert_eq!(case.materials().of(1).young_modulus, 2.1e11);
    assert_eq!(case.body.mesh().unwrap().regions, ["disc", "shaft"]);
    assert_eq!(case.cost().nodes, 24 * 9);
    assert!(case.require_cea().is_ok());
}

#[test]
fn rotating_waves_refuse_a_deformable_shaft() {
    let error = case().require_rotating_waves().unwrap_err();
    has(&error.to_string(), &["geometry.shaft_inner_radius", "leave"]);
}
