//! `frictionsim basin` and its map: consistency of the search.

use crate::prelude::*;

const SEARCH: &str = "[basin]\ntolerance = 3.0
[sweep]\n\"contact.rotation_speed_rpm\" = [300.0, 6000.0]\nanalyses = [\"basin\"]\n";

fn run(folder: &TempDir, words: &[&str]) -> Run {
    fs::write(folder.path().join("case.toml"), disc_of([48, 9], SEARCH)).unwrap();
    let changes = "contact.friction_coefficient=0.4 ; contact.rotation_speed_rpm=300.0";
    Run::new(words).within(folder).set(&[changes]).out("out")
}

#[test]
fn the_boundary_separates_all_transients_of_its_search() {
    let folder = folder();
    let answer = run(&folder, &["basin", "case.toml", "--no-figures"]).done();
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
    let answer = run(&folder, &["sweep", "case.toml"]).done();
    let answer = answer.says(&["ratio below", "ratio above"]).wrote("figures/basins.svg");
    assert!(answer.header("points.csv").contains("boundary.low,boundary.high"));
}

/// Sixty modes are looked at for the onsets of the waves: this mesh has 36.
#[test]
fn a_mesh_of_few_modes_has_a_basin() {
    let folder = folder();
    fs::write(folder.path().join("case.toml"), disc_of([12, 2], "[basin]\n")).unwrap();
    let run = Run::new(&["basin", "case.toml", "--no-figures"]).within(&folder).end();
    has(&run.said(), &["!cea.modes"]);
}
