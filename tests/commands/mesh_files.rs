//! Mesh files of other programs on the command line.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn shipped(name: &str) -> String {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    cases.join(name).display().to_string()
}

/// Runs the program in a folder of its own; the object that it prints.
fn object(folder: &TempDir, arguments: &[&str]) -> Value {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    let assert = command.current_dir(folder.path()).args(arguments).assert().success();
    serde_json::from_slice(&assert.get_output().stdout).unwrap()
}

/// Closed form: a ring of 36 straight-sided sectors, and pads of 7 and 8 of them.
#[test]
fn the_statistics_of_a_brake_of_an_input_file_are_those_of_its_geometry() {
    let folder = tempfile::tempdir().unwrap();
    let summary = object(&folder, &["mesh", &shipped("brake.toml"), "--json", "--no-figures"]);
    let mesh = &summary["mesh"];
    assert_eq!(mesh["nodes"], 1140);
    assert_eq!(mesh["elements_by_kind"]["hex8"], 592);
    // Disc, two linings, two plates.
    assert_eq!(mesh["bodies"], 5);
    // Sectors of so many degrees, inner and outer radius and thickness in mm, density.
    let mass = |sectors: f64, degrees: f64, radii: [f64; 2], thickness: f64, density: f64| {
        let triangle = 0.5 * sectors * degrees.to_radians().sin();
        1e-9 * density * triangle * (radii[1] * radii[1] - radii[0] * radii[0]) * thickness
    };
    for (name, exact) in [
        ("Disc_Disc_iron", mass(36.0, 10.0, [45.0, 110.0], 12.0, 7200.0)),
        ("Outer_Lining", mass(7.0, 50.0 / 7.0, [72.0, 106.0], 10.0, 2600.0)),
        ("Inner_Backplate", mass(8.0, 7.0, [70.0, 108.0], 5.0, 7850.0)),
    ] {
        let regions = mesh["regions"].as_array().unwrap();
        let region = regions.iter().find(|region| region["name"] == name).unwrap();
        let found = region["mass_kg"].as_f64().unwrap();
        // Coordinates have nine digits in the file.
        assert!((found / exact - 1.0).abs() < 1e-7, "{name} {found} {exact}");
    }
    let boundaries = mesh["boundaries"].as_array().unwrap();
    for (name, condition) in [
        ("Disc_Bore", "clamped"),
        ("Disc_Upper_face", "counterface"),
        ("Inner_Friction_face", "contact"),
        ("Inner_Lining_glue", "tie"),
        ("Outer_Piston", "pressure"),
        ("Outer_Plate", "fixed"),
    ] {
        let boundary = boundaries.iter().find(|boundary| boundary["name"] == name);
        assert_eq!(boundary.unwrap()["condition"], condition, "{name}");
    }
    let not_used = summary["not_used"].to_string();
    assert!(not_used.contains("*COMPLEX FREQUENCY (line "), "{not_used}");
    assert!(
        summary["notes"]
            .to_string()
            .contains("ties taken from meshes/brake.inp: Glue_Outer, Glue_Inner")
    );
}

#[test]
fn the_case_that_init_writes_for_an_input_file_runs_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(shipped("meshes/brake.inp"), folder.path().join("brake.inp")).unwrap();
    let mut init = Command::cargo_bin("frictionsim").unwrap();
    init.current_dir(folder.path()).args(["init", "--from", "brake.inp"]).assert().success();
    let text = fs::read_to_string(folder.path().join("brake.toml")).unwrap();
    assert!(
        text.contains("file = \"brake.inp\"") && text.contains("# Not used: *COMPLEX FREQUENCY"),
        "{text}"
    );
    // Stress-free contacts: the base state of thousands of points is not what is tested here.
    let closed = ["Outer", "Inner"].map(|pad| format!("contacts.{pad}_Friction_face.state=closed"));
    let summary = object(
        &folder,
        &[
            "cea",
            "brake.toml",
            "--json",
            "--no-figures",
            "--set",
            &closed[0],
            "--set",
            &closed[1],
            "--set",
            "cea.modes=2",
            "--set",
            "cea.friction_coefficients=[0.4]",
        ],
    );
    let lowest = summary["friction"][0]["modes"][0]["frequency_hz"].as_f64();
    println!("{lowest:?} {}", summary["largest_residual"]);
    assert!(summary["largest_residual"].as_f64().unwrap() < 1e-8, "{summary}");
    // A second time nothing is replaced.
    let mut again = Command::cargo_bin("frictionsim").unwrap();
    again.current_dir(folder.path()).args(["init", "--from", "brake.inp"]).assert().code(2);
}

/// The picture names every region and what holds, loads and touches the bodies; `plot` draws it again to the same bytes.
#[test]
fn the_picture_of_solid_bodies_names_regions_and_boundaries() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("out/figures/mesh.svg");
    object(&folder, &["mesh", &shipped("brake.toml"), "--json", "-o", "out"]);
    let drawn = fs::read_to_string(&picture).unwrap();
    let words = [
        "Disc_Disc_iron",
        "Outer_Lining",
        "Inner_Backplate",
        "contact",
        "counterface",
        "clamped",
        "pressure",
        "tie",
        "free",
        "regions, turned over",
    ];
    for word in words {
        assert!(drawn.contains(word), "{word}");
    }
    // Nothing of the case is a support.
    assert!(!drawn.contains(">support<"));
    let report = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(report.contains("Outer_Piston") && report.contains("mass (kg)"));
    fs::remove_file(&picture).unwrap();
    let mut plot = Command::cargo_bin("frictionsim").unwrap();
    plot.current_dir(folder.path()).args(["plot", "out"]);
    plot.assert().success();
    assert_eq!(fs::read_to_string(&picture).unwrap(), drawn);
}

/// Stress of solid bodies stands in the files for ParaView, of base states and of snapshots.
#[test]
fn fields_of_bodies_of_revolution_have_their_stress() {
    let folder = tempfile::tempdir().unwrap();
    let coarse = [
        "--set",
        "mesh.circumferential_elements=16",
        "--set",
        "mesh.radial_elements=10",
        "--no-figures",
        "-qq",
        "-o",
        "out",
    ];
    let run = |command: &str, changes: &[&str]| {
        let mut run = Command::cargo_bin("frictionsim").unwrap();
        let case = shipped("ring-on-layer.toml");
        run.current_dir(folder.path()).args([command, &case, "--force"]);
        run.args(coarse).args(changes).assert().success();
    };
    let holds_stress = |file: &str| {
        let bytes = fs::read(folder.path().join("out").join(file)).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        for name in ["von_mises_pa", "stress_zz_pa", "stress_rt_pa", "stress_rz_pa"] {
            assert!(text.contains(&format!("Name=\"{name}\"")), "{file}: {name}");
        }
    };
    run(
        "cea",
        &["--set", "cea.friction_coefficients=[0.2]", "--set", "cea.max_frequency_hz=8000.0"],
    );
    holds_stress("prestress.vtu");
    run("transient", &["--set", "transient.duration=1e-4", "--set", "output.snapshots=[1e-4]"]);
    let snapshots = fs::read_dir(folder.path().join("out/snapshots")).unwrap();
    let first = snapshots.flatten().next().unwrap().file_name();
    holds_stress(&format!("snapshots/{}", first.to_string_lossy()));
}
