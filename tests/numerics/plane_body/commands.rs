//! The commands on imported bodies.

use crate::plane_body::studies::MODEL as MATERIAL;
use crate::prelude::*;

/// A folder with a coarse disc twice: `annulus.toml`, and `body.toml` with a mesh file in millimetres, nodes from 1001.
fn folder() -> TempDir {
    let mesh = AnnulusMesh::generate(&annulus(Quad4, 24, 4)).unwrap().mesh;
    let numbers: Vec<usize> = (1001..=1000 + mesh.node_count()).collect();
    let bytes = write_msh(&mesh, FORMS[2], &numbers, |[x, y]| [1e3 * x, 1e3 * y]);
    let run = include_str!("../../cases/short-run.toml");
    let generated = "[geometry]\ninner_radius = 0.0205\nouter_radius = 0.0905\n\
        [mesh]\ncircumferential_elements = 24\nradial_elements = 4\n";
    let imported =
        "[mesh]\nfile = \"disc.msh\"\nscale = 0.001\n[boundaries.outer]\ncondition = \"clamped\"\n";
    let [generated, imported] = [generated, imported].map(|own| format!("{own}{MATERIAL}{run}"));
    let files = [("annulus.toml", generated.as_bytes()), ("body.toml", imported.as_bytes())];
    folder_with(&[("disc.msh", &bytes), files[0], files[1]])
}

fn run(folder: &TempDir, command: &str, case: &str, set: &[&str]) -> Run {
    Run::of(command, case).within(folder).set(set)
}

/// Node 4 + 5 * 6 = 34 of the annulus stands at 90 degrees, 73 mm from the axis.
#[test]
fn a_probe_by_place_is_that_of_the_nearest_node_on_either_kind_of_mesh() {
    let folder = folder();
    let places = [
        ("annulus.toml", "output.probes=[34]", "34", "number"),
        ("annulus.toml", "output.probes=[{ radius = 0.0731, angle_deg = 91 }]", "34", "polar"),
        ("annulus.toml", "output.probes=[{ x = 1e-4, y = 0.0731 }]", "34", "point"),
        ("body.toml", "output.probes=[1034]", "1034", "label"),
        ("body.toml", "output.probes=[{ x = 1e-4, y = 0.0731 }]", "1034", "place"),
    ];
    let mut all = Vec::new();
    for (case, probe, label, out) in places {
        let answer = run(&folder, "transient", case, &[probe]).out(out).done();
        let probes = &answer.summary()["probes"][label];
        let is_placed = probe.contains('{');
        assert_eq!(probes["place"]["at_m"].is_array(), is_placed, "{probe}");
        let text = answer.text(&format!("probe-{label}.csv"));
        let rows = text.lines().skip(1);
        let numbers = |row: &str| row.split(',').map(|cell| cell.parse().unwrap()).collect();
        all.push((out, rows.map(numbers).collect::<Vec<Vec<f64>>>()));
    }
    let (_, expected) = &all[0];
    let largest = |column: usize| expected.iter().fold(0.0_f64, |m, row| m.max(row[column].abs()));
    for (name, found) in &all {
        assert_eq!(found.len(), expected.len(), "{name}");
        for (row, other) in found.iter().zip(expected) {
            // Sparse and cyclic sums differ in their last digits; accelerations are their differences.
            let near = |k: usize| (row[k] - other[k]).abs() <= 1e-6 * largest(k);
            assert!((0..7).all(near), "{name} {row:?} {other:?}");
        }
    }
}

#[test]
fn figures_of_a_body_are_drawn_again_without_its_mesh_file() {
    let folder = folder();
    let probe = "output.probes=[{ x = 0.0, y = 0.0205 }, { x = 0.0, y = 0.073 }]";
    let commands = ["transient", "cea", "mesh"];
    let answers = commands.map(|command| {
        let words = [command, "body.toml", "--quiet"];
        Run::new(&words).within(&folder).out(command).set(&[probe]).done()
    });
    fs::remove_file(folder.path().join("disc.msh")).unwrap();
    for (command, answer) in commands.iter().zip(answers) {
        let names = names_in(&answer.path("figures"));
        assert!(!names.is_empty());
        let all = || names.iter().map(|name| answer.bytes(&format!("figures/{name}")));
        let before: Vec<_> = all().collect();
        Run::new(&["plot", command]).within(&folder).done();
        assert!(all().eq(before), "{command}");
    }
}

#[test]
fn a_signal_is_named_by_the_modes_of_an_imported_body() {
    let folder = folder();
    let rows = run(&folder, "cea", "body.toml", &[]).out("cea").done().rows("eigenvalues.csv");
    let unstable = rows.iter().find(|row| row["unstable"] == "true").unwrap();
    let [mode, frequency] = unstable.numbers(["mode", "frequency_hz"]);
    let tone = tones(2e5, 20_000, &[("a", frequency)]);
    fs::write(folder.path().join("tone.csv"), tone).unwrap();
    let run = run(&folder, "signal", "tone.csv", &[]).args(&["--case", "body.toml"]).out("signal");
    let named = &run.done().summary()["channels"][0]["mode"];
    assert_eq!(named["mode"], mode as u64);
    assert!(named.get("harmonic").is_none());
}

/// Independent check of the order of four-node elements, from the command: its meshes are split, its arcs kept.
#[test]
fn convergence_of_an_imported_body_splits_its_elements() {
    let folder = folder();
    let set = ["convergence.analyses=[\"cea\"]", "cea.modes=8"];
    let summary = run(&folder, "convergence", "body.toml", &set).out("study").done().summary();
    let series = &summary["series"][0];
    assert_eq!(series["levels"][2], "1536 elements");
    let quantities = series["quantities"].as_array().unwrap();
    let name = |of: &Value| of["name"].as_str().is_some_and(|n| n.starts_with("frequency, mode"));
    let orders = quantities.iter().filter(|own| name(own));
    let orders: Vec<f64> = orders.filter_map(|own| own["order"].as_f64()).collect();
    assert!(orders.len() >= 3, "{orders:?}");
    // The start of 24 by 4 elements is coarse: only the lowest modes show the order within a twentieth.
    assert!(orders[..3].iter().all(|order| (order - 2.0).abs() < 0.1), "{orders:?}");
    let other = ["convergence.factors=[1, 1.5, 2.25]"];
    run(&folder, "convergence", "body.toml", &other).refused(&["powers of two"]);
}
