//! `frictionsim basin` and its map: consistency of the search.

use crate::prelude::*;

const SEARCH: &str = "[basin]\ntolerance = 3.0
[sweep]\n\"contact.rotation_speed_rpm\" = [300.0, 6000.0]\nanalyses = [\"basin\"]\n";

fn run(words: &[&str]) -> Run {
    let changes = "contact.friction_coefficient=0.4 ; contact.rotation_speed_rpm=300.0";
    let case = disc_of([48, 9], SEARCH);
    Run::new(words).beside(&[("case.toml", case)]).set(&[changes]).out("out")
}

#[test]
fn the_boundary_separates_all_transients_of_its_search() {
    let answer = run(&["basin", "case.toml", "--no-figures"]).done();
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
    let answer = run(&["sweep", "case.toml"]).done().wrote("figures/basins.svg");
    let answer = answer.says(&["ratio below", "ratio above"]);
    assert!(answer.header("points.csv").contains("boundary.low,boundary.high"));
}

/// Sixty modes are looked at for the onsets of the waves: this mesh has 36.
#[test]
fn a_mesh_of_few_modes_has_a_basin() {
    let case = disc_of([12, 2], "[basin]\n");
    let run = Run::of("basin", "case.toml").beside(&[("case.toml", case)]);
    has(&run.end().said(), &["!cea.modes"]);
}

/// A wave of five nodal diameters decays on this disc: seeded fifty times as large it has lost before the other one saturates.
/// That was told as a boundary at a ratio of 1e-12.
#[test]
fn a_wave_that_does_not_grow_is_no_rival() {
    for harmonics in ["[2, 5]", "[5, 1]"] {
        let set = format!("basin.harmonics={harmonics}");
        let said = ["waves of 5 nodal diameters", "harmonics that grow: {1, 2"];
        run(&["basin", "case.toml", "--no-figures"]).set(&[&set]).end().code(1).warns(&said);
    }
}
