//! `frictionsim basin` and its map: consistency of the search.

use crate::prelude::*;

const CASE: &str = r#"
[geometry]
inner_radius = 0.0205
outer_radius = 0.0905
thickness = 0.009
[mesh]
circumferential_elements = 48
radial_elements = 9
[material]
young_modulus = 2.5e9
poisson_ratio = 0.3805
density = 1228.0
[damping]
mass_coefficient = 40.0
stiffness_coefficient = 4.5e-7
[contact]
friction_coefficient = 0.4
interference = 25e-6
rotation_speed_rpm = 300.0
[basin]
tolerance = 3.0
[sweep]
"contact.rotation_speed_rpm" = [300.0, 6000.0]
analyses = ["basin"]
"#;

#[test]
fn the_boundary_separates_all_transients_of_its_search() {
    let folder = folder();
    let answer = Run::of_text("basin", folder.path(), CASE).out("out").done();
    let answer = answer.says(&["n = 2 wins where its amplitude"]);
    let summary = answer.summary();
    let [low, high] = ["low", "high"].map(|end| summary["boundary"][end].as_f64().unwrap());
    assert!(low < high);
    let rows = answer.rows("basin.csv");
    assert!(rows.len() > 2);
    for row in rows {
        let [ratio, winner] = row.numbers(["saturation_ratio", "winner"]);
        assert!(if winner == 1.0 { ratio <= low } else { ratio >= high }, "{ratio}: {winner}");
    }
}

#[test]
fn a_study_of_basins_has_columns_and_a_map() {
    let folder = folder();
    std::fs::write(folder.path().join("case.toml"), CASE).unwrap();
    let run = Run::new(&["sweep", "case.toml"]).within(&folder).out("map");
    let answer = run.done().says(&["ratio below", "ratio above"]);
    assert!(answer.header("points.csv").contains("boundary.low,boundary.high"));
    assert!(answer.path("figures/basins.svg").exists());
}
