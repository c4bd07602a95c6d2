//! `frictionsim basin` and its map: consistency of the search.

use assert_cmd::Command;
use std::path::Path;

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

fn run(folder: &Path, command: &str, out: &str) -> String {
    let case = folder.join("case.toml");
    std::fs::write(&case, CASE).unwrap();
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    let program = program.current_dir(folder).args([command, "case.toml", "--out", out]);
    let output = program.assert().success().get_output().stdout.clone();
    String::from_utf8(output).unwrap()
}

#[test]
fn the_boundary_separates_all_transients_of_its_search() {
    let folder = tempfile::tempdir().unwrap();
    let printed = run(folder.path(), "basin", "out");
    assert!(printed.contains("n = 2 wins where its amplitude"), "{printed}");
    let summary = std::fs::read(folder.path().join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_slice(&summary).unwrap();
    let [low, high] = ["low", "high"].map(|end| summary["boundary"][end].as_f64().unwrap());
    assert!(low < high);
    let mut table = csv::Reader::from_path(folder.path().join("out/basin.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert!(rows.len() > 2);
    for row in rows {
        let [ratio, winner] = [1, 2].map(|column| row[column].parse::<f64>().unwrap());
        assert!(if winner == 1.0 { ratio <= low } else { ratio >= high }, "{ratio}: {winner}");
    }
}

#[test]
fn a_study_of_basins_has_columns_and_a_map() {
    let folder = tempfile::tempdir().unwrap();
    let printed = run(folder.path(), "sweep", "map");
    assert!(printed.contains("ratio below") && printed.contains("ratio above"), "{printed}");
    let table = std::fs::read_to_string(folder.path().join("map/points.csv")).unwrap();
    assert!(table.lines().next().unwrap().contains("boundary.low,boundary.high"));
    assert!(folder.path().join("map/figures/basins.svg").exists());
}
