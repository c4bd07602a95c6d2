//! Three-dimensional bodies on a rigid counterface: from a mesh file, and generated ones on their whole mesh.

use crate::bricks::{Block, file_of};
use assert_cmd::Command;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

/// The built-in disc, coarse, as the harmonics solve it.
const DISC: &str = "[geometry]
inner_radius = 0.0205
outer_radius = 0.0905
thickness = 0.009

[mesh]
circumferential_elements = 16
radial_elements = 3
axial_elements = 1

[material]
young_modulus = 2.5e9
poisson_ratio = 0.3805
density = 1228.0
formulation = \"three-dimensional\"

[damping]
mass_coefficient = 40.0
stiffness_coefficient = 4.5e-7

[contact]
friction_coefficient = 0.3
interference = 25e-6
rotation_speed_rpm = 1e9

[cea]
friction_coefficients = [0.0, 0.3]
modes = 12
geometric_stiffness = false
";

/// A block of rubber on a plane that slides under it.
const BLOCK: &str = "[mesh]
file = \"block.msh\"

[boundaries.block_z1]
condition = \"clamped\"

[material]
young_modulus = 5e6
poisson_ratio = 0.4
density = 1100.0

[damping]
mass_coefficient = 5.0
stiffness_coefficient = 1e-6

[contact]
boundary = \"block_z0\"
counterface = \"plane\"
direction = [1.0, 0.0, 0.0]
speed = 0.5
friction_coefficient = 0.3
interference = 2e-4

[cea]
friction_coefficients = [0.0, 0.3]
modes = 8
";

fn block() -> Vec<u8> {
    let block =
        Block { name: "block", origin: [0.0; 3], size: [0.04, 0.03, 0.02], counts: [4, 3, 2] };
    file_of(&[block], |point| point)
}

/// What a command says of a case, and whether it succeeds.
fn run(folder: &Path, command: &str, case: &str, out: &str, sets: &[&str]) -> (bool, String) {
    fs::write(folder.join("block.msh"), block()).unwrap();
    fs::write(folder.join("case.toml"), case).unwrap();
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    program.current_dir(folder);
    program.args([command, "case.toml", "--out", out, "--force", "--no-figures"]);
    sets.iter().for_each(|set| {
        program.args(["--set", set]);
    });
    let output = program.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    (output.status.success(), said.into_owned())
}

/// Friction, frequency and growth rate of every mode.
fn modes(folder: &Path, out: &str) -> Vec<[f64; 3]> {
    let mut reader = csv::Reader::from_path(folder.join(out).join("eigenvalues.csv")).unwrap();
    let headers = reader.headers().unwrap().clone();
    let of = |name| headers.iter().position(|header| header == name).unwrap();
    let columns = ["friction_coefficient", "frequency_hz", "growth_rate_per_s"].map(of);
    let rows = reader.records().map(|row| row.unwrap());
    rows.map(|row| columns.map(|column| row[column].parse().unwrap())).collect()
}

/// Largest distance of a mode from the nearest of the others at the same friction, relative.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let to = |p: &[f64; 3], q: &[f64; 3]| ((p[1] - q[1]).hypot((p[2] - q[2]) / TAU)) / p[1];
    let nearest = |p: &[f64; 3]| {
        let others = b.iter().filter(|q| q[0] == p[0]).map(|q| to(p, q));
        others.fold(f64::INFINITY, f64::min)
    };
    a.iter().map(nearest).fold(0.0, f64::max)
}

/// Independent: the harmonics of a body of revolution have assembly, base state and contact of their own. At this speed the dashpot
/// of friction across the sliding, which the one spreads over elements and the other has at nodes, is small.
#[test]
fn the_whole_mesh_of_a_body_of_revolution_has_the_spectrum_of_its_harmonics() {
    let folder = tempfile::tempdir().unwrap();
    let ring = DISC.replace(
        "rotation_speed_rpm",
        "boundary = \"top\"\nring_inner_radius = 0.04\nring_outer_radius = 0.07\nrotation_speed_rpm",
    );
    let ring = format!("{ring}\n[boundaries.bottom]\ncondition = \"guide\"\n");
    for case in [DISC, &ring] {
        for (out, method) in [("cyclic", "auto"), ("whole", "sparse")] {
            let set = format!("cea.method=\"{method}\"");
            let (is_done, said) = run(folder.path(), "cea", case, out, &[&set]);
            assert!(is_done, "{said}");
        }
        let [cyclic, whole] = ["cyclic", "whole"].map(|out| modes(folder.path(), out));
        let at_rest = |all: &[[f64; 3]]| -> Vec<[f64; 3]> {
            all.iter().filter(|mode| mode[0] == 0.0).copied().collect()
        };
        let still = distance(&at_rest(&whole), &at_rest(&cyclic));
        let sliding = distance(&whole, &cyclic);
        println!("{still:e} without friction, {sliding:e} with");
        assert!(still < 1e-10, "{still:e}");
        assert!(sliding < 1e-7, "{sliding:e}");
        fs::remove_dir_all(folder.path().join("cyclic")).unwrap();
        fs::remove_dir_all(folder.path().join("whole")).unwrap();
    }
}

/// What the harmonics cannot do is done on the whole mesh: a mass on the disc, its losses, its matrices.
#[test]
fn a_generated_body_of_revolution_takes_what_breaks_its_symmetry() {
    let folder = tempfile::tempdir().unwrap();
    let mass =
        format!("{DISC}\n[modifications.weight]\nat = {{ x = 0.0905, y = 0.0 }}\nmass = 0.01\n");
    let free = "boundaries.outer={condition=\"support\",normal_stiffness=1e10,tangential_stiffness=1e10,axial_stiffness=1e10}";
    let (is_done, said) =
        run(folder.path(), "cea", DISC, "plain", &[free, "cea.method=\"sparse\""]);
    assert!(is_done, "{said}");
    let (is_done, said) = run(folder.path(), "cea", &mass, "mass", &[free]);
    assert!(is_done, "{said}");
    let [plain, loaded] = ["plain", "mass"].map(|out| modes(folder.path(), out));
    assert!(loaded[0][1] < plain[0][1] * (1.0 - 1e-4), "{loaded:?} {plain:?}");
    // Without damping of its own, losses of 1 % damp a mode that contact does not by half as much.
    let lossy = [
        "material.loss_factor=0.01",
        "damping.mass_coefficient=0",
        "damping.stiffness_coefficient=0",
    ];
    let (is_done, said) = run(folder.path(), "cea", DISC, "lossy", &lossy);
    assert!(is_done, "{said}");
    for mode in modes(folder.path(), "lossy").iter().filter(|mode| mode[0] == 0.0) {
        let damping = -mode[2] / (TAU * mode[1]);
        assert!((damping - 0.005).abs() < 1e-5, "{mode:?}");
    }
    let (is_done, said) = run(folder.path(), "matrices", DISC, "refused", &[]);
    assert!(!is_done && said.contains("cea.method = \"sparse\""), "{said}");
    let (is_done, said) =
        run(folder.path(), "matrices", DISC, "written", &["cea.method=\"sparse\""]);
    assert!(is_done, "{said}");
}

/// Every analysis takes a solid block on a rigid plane.
#[test]
fn a_block_of_solid_elements_slides_on_a_rigid_plane() {
    let folder = tempfile::tempdir().unwrap();
    let analyses = [
        ("check", ""),
        ("mesh", ""),
        ("cea", ""),
        ("matrices", ""),
        ("improve", "improve={}"),
        ("transient", "transient={duration=2e-3,expansion_time=1e-3}"),
        (
            "frf",
            "frf={boundary=\"sliding\",force_node=30,force_direction=\"z\",frequencies_hz=[100.0,200.0]}",
        ),
    ];
    for (command, section) in analyses {
        let sets: Vec<&str> = std::iter::once(section).filter(|set| !set.is_empty()).collect();
        let case = if command == "improve" {
            BLOCK
                .replace("friction_coefficients = [0.0, 0.3]", "friction_coefficients = [0.0, 0.9]")
        } else {
            BLOCK.to_owned()
        };
        let (is_done, said) = match command {
            "check" => {
                fs::write(folder.path().join("block.msh"), block()).unwrap();
                fs::write(folder.path().join("case.toml"), &case).unwrap();
                let mut program = Command::cargo_bin("frictionsim").unwrap();
                let output = program
                    .current_dir(folder.path())
                    .args(["check", "case.toml"])
                    .output()
                    .unwrap();
                (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
            }
            _ => run(folder.path(), command, &case, command, &sets),
        };
        // A body that is stable has nothing to improve.
        assert!(is_done || said.contains("grows"), "{command}: {said}");
    }
    let summary = fs::read_to_string(folder.path().join("transient/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let residual = summary["max_balance_residual"].as_f64().unwrap();
    assert!(residual < 1e-10, "{residual:e}");
    let summary = fs::read_to_string(folder.path().join("cea/summary.json")).unwrap();
    assert!(summary.contains("drag_n"), "{summary}");
}

/// Errors name the key.
#[test]
fn rigid_counterfaces_of_solid_bodies_that_cannot_be_are_refused_at_their_keys() {
    let folder = tempfile::tempdir().unwrap();
    for (change, parts) in [
        (("speed = 0.5", ""), ["missing key `contact.speed`", "--> case.toml"]),
        (
            ("direction = [1.0, 0.0, 0.0]", "direction = [1.0, 0.0]"),
            ["needs three numbers", "contact.direction"],
        ),
        (
            ("direction = [1.0, 0.0, 0.0]", "direction = [1.0, 0.0, 0.5]"),
            ["move along it", "correct `direction`"],
        ),
        (
            ("speed = 0.5", "speed = 0.5\nrotation_speed_rpm = 3.0"),
            ["not both", "rotation_speed_rpm"],
        ),
        (("\"plane\"", "\"body\""), ["is for two plane bodies", "[contacts.NAME]"]),
        (("\"plane\"", "\"sphere\""), ["is not round", "radius"]),
        (("speed = 0.5", "speed = 0.0"), ["contact.speed = 0", "the contact sticks"]),
    ] {
        let case = BLOCK.replace(change.0, change.1);
        assert_ne!(case, BLOCK);
        let (is_done, said) = run(folder.path(), "cea", &case, "run", &[]);
        assert!(!is_done, "{change:?}");
        for part in parts {
            assert!(said.contains(part), "{part:?} is not in\n{said}");
        }
    }
}

/// Numbers by LAPACK: the dense eigenvalues of the exported matrices at this friction have a mode at 1424.66 Hz with growth 0.0 1/s.
#[test]
fn the_shipped_tread_block_squeals_in_its_shear_mode() {
    let folder = tempfile::tempdir().unwrap();
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    fs::create_dir(folder.path().join("meshes")).unwrap();
    let mesh = "meshes/tread-block.msh";
    fs::copy(cases.join(mesh), folder.path().join(mesh)).unwrap();
    let case = fs::read_to_string(cases.join("tread-block.toml")).unwrap();
    let sets = ["cea.friction_coefficients=[0.0,0.4,0.5]", "cea.modes=4"];
    let (is_done, said) = run(folder.path(), "cea", &case, "run", &sets);
    assert!(is_done, "{said}");
    let summary = fs::read_to_string(folder.path().join("run/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let onset = &summary["critical_frictions"][0];
    let [friction, frequency] =
        ["critical_friction", "frequency_hz"].map(|key| onset[key].as_f64().unwrap());
    assert!((friction - 0.451102).abs() < 1e-6, "{onset}");
    assert!((frequency - 1424.66).abs() < 0.01, "{onset}");
}
