//! `frictionsim basin` and its map: consistency of the search.

use crate::prelude::*;

const CASE: &str = "[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\nthickness = 0.009
[mesh]\ncircumferential_elements = 48\nradial_elements = 9
[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.3805\ndensity = 1228.0
[damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 4.5e-7
[contact]\nfriction_coefficient = 0.4\ninterference = 25e-6\nrotation_speed_rpm = 300.0
[basin]\ntolerance = 3.0
[sweep]\n\"contact.rotation_speed_rpm\" = [300.0, 6000.0]\nanalyses = [\"basin\"]\n";

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
