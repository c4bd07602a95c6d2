//! What users write: cases and overrides.

use crate::prelude::*;

fn shipped_cases() -> Vec<Vec<u8>> {
    let names = names_in(shipped("").as_ref()).into_iter().filter(|name| name.ends_with(".toml"));
    names.map(|name| fs::read(shipped(&name)).unwrap()).collect()
}

fn parse(text: &[u8], set: &[String]) {
    match Case::parse("case.toml", text, set) {
        Ok(case) => drop(case.cost()),
        Err(errors) => drop([errors.render(true), errors.to_string()]),
    }
}

#[test]
fn no_case_makes_its_reader_panic() {
    let corpus = shipped_cases();
    hold("case", |random| text(random, &corpus), |bytes| parse(bytes, &[]));
}

#[test]
fn no_override_makes_its_reader_panic_or_cost_much() {
    let case = shipped_cases().remove(0);
    let corpus: Vec<Vec<u8>> = [
        "contact.friction_coefficient=0.4",
        "cea.friction_coefficients={ from = 0.0, to = 1.0, count = 51 }",
        "cea.shapes_at=[0.1, 0.2]",
        "sweep.\"contact.rotation_speed_rpm\"={ from = 10, to = 6000, count = 24, spacing = \"log\" }",
        "transient.perturbation.harmonics=[2]",
        "output.snapshots={ from = 0.0, to = 0.01, count = 100 }",
        "title=\"x\"",
    ]
    .map(|text| text.as_bytes().to_vec())
    .to_vec();
    let set = |bytes: &[u8]| parse(&case, &[String::from_utf8_lossy(bytes).into_owned()]);
    hold("set", |random| text(random, &corpus), set);
}
