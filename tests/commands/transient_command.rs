//! `frictionsim transient` as a user meets it: files, checkpoints, exit codes, and the shipped cases on coarse meshes.

use crate::bricks::{Block, file_of};
use assert_cmd::Command;
use predicates::str::contains;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const BRICK: Block = Block { name: "brick", origin: [0.0; 3], size: [0.01; 3], counts: [2, 1, 1] };

fn case(name: &str) -> String {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    cases.join(name).display().to_string()
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// The 610 rpm case on a mesh that steps in a microsecond, with every override as `KEY=VALUE`.
fn arguments(out: &Path, overrides: &[&str]) -> Vec<String> {
    let coarse = [
        "mesh.circumferential_elements=60",
        "mesh.radial_elements=12",
        "output.probes=[1, 200]",
        "output.snapshots=[0.002]",
        "transient.duration=0.004",
    ];
    let mut arguments = vec!["transient".to_owned(), case("polycarbonate-610rpm.toml")];
    arguments.extend(["--out".to_owned(), out.display().to_string()]);
    arguments.push("--no-figures".to_owned());
    for text in coarse.iter().chain(overrides) {
        arguments.extend(["--set".to_owned(), (*text).to_owned()]);
    }
    arguments
}

fn frictionsim(arguments: &[String]) -> Command {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    command.args(arguments);
    command
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

/// Every result file but those that hold wall-clock times.
fn results(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let names = [
        "probe-1.csv",
        "probe-200.csv",
        "energy.csv",
        "contact.csv",
        "contact.npz",
        "harmonics.csv",
        "snapshots.pvd",
        "snapshots/snapshot-001.vtu",
    ];
    names.iter().map(|name| (PathBuf::from(name), fs::read(folder.join(name)).unwrap())).collect()
}

#[test]
fn every_promised_file_column_and_summary_key_is_there() {
    let folder = folder();
    let out = folder.path().join("out");
    frictionsim(&arguments(&out, &[])).assert().code(0).stdout(contains("over the last fifth"));
    let first_line = |name: &str| {
        let text = fs::read_to_string(out.join(name)).unwrap();
        text.lines().next().unwrap().to_owned()
    };
    assert_eq!(
        first_line("probe-200.csv"),
        "time_s,u_r_m,u_theta_m,v_r_m_per_s,v_theta_m_per_s,a_r_m_per_s2,a_theta_m_per_s2"
    );
    assert_eq!(
        first_line("energy.csv"),
        "time_s,kinetic_j,strain_j,external_w,stick_w,slide_w,contact_dissipated_w,material_damping_w,\
         normal_contact_w,balance_residual"
    );
    assert_eq!(first_line("contact.csv"), "time_s,stick,slip,open");
    let summary = summary(&out);
    for key in [
        "/steps",
        "/time_step_s",
        "/wall_s",
        "/element_steps_per_s",
        "/max_balance_residual",
        "/main_frequency_hz",
        "/status/stick",
        "/status/slip",
        "/status/open",
        "/power_w/external",
        "/power_w/stick",
        "/power_w/slide",
        "/power_w/contact_dissipated",
        "/power_w/material_damping",
        "/harmonics/8",
        "/growth",
        "/first_nonlinearity_s",
        "/manifest/case_hash",
        "/manifest/simd",
    ] {
        assert!(summary.pointer(key).is_some(), "{key}");
    }
    assert!(summary["max_balance_residual"].as_f64().unwrap() < 1e-10);
    for key in [
        "/settled",
        "/settled_from_s",
        "/end_state",
        "/drift",
        "/main_amplitude_m",
        "/significant_harmonics_m",
        "/no_growth",
        "/probes/200/radial/acceleration_rms_m_per_s2",
        "/perturbation/velocity",
        "/contact_interval_s",
    ] {
        assert!(summary.pointer(key).is_some(), "{key}");
    }
}

/// At friction 0.2 and 1000 rpm the wave of two nodal diameters lives on beside that of one.
const TWO_FREQUENCIES: [&str; 6] = [
    "transient.duration=0.05",
    "contact.friction_coefficient=0.2",
    "contact.rotation_speed_rpm=1000.0",
    "transient.perturbation.harmonics=[1, 2]",
    "transient.perturbation.velocity=0.3",
    "cea.max_frequency_hz=9000.0",
];

#[test]
fn a_vibration_of_two_frequencies_is_named_with_both_and_its_envelope() {
    let folder = folder();
    let out = folder.path().join("out");
    frictionsim(&arguments(&out, &TWO_FREQUENCIES))
        .assert()
        .code(0)
        .stdout(contains("two frequencies, which is no limit cycle"))
        .stdout(contains("is above cea.max_frequency_hz = 9000"));
    let summary = summary(&out);
    assert_eq!(summary["end_state"], "two-frequency");
    let [first, second] = [0, 1].map(|k| summary["frequencies_hz"][k].as_f64().unwrap());
    assert!(first > second + 500.0, "{first} {second}");
    assert!(summary["envelope_ratio"].as_f64().unwrap() > 1.4);
}

#[test]
fn a_sweep_marks_points_that_are_no_limit_cycles_in_table_report_and_figures() {
    let folder = folder();
    let out = folder.path().join("out");
    let mut arguments = arguments(&out, &TWO_FREQUENCIES);
    arguments[0] = "sweep".to_owned();
    arguments.retain(|text| text != "--no-figures");
    let swept = "sweep={\"contact.rotation_speed_rpm\"=[1000.0, 10.0]}";
    arguments.extend(["--set".to_owned(), swept.to_owned()]);
    frictionsim(&arguments)
        .assert()
        .code(0)
        .stdout(contains("ends in"))
        .stdout(contains("two-frequency"))
        .stdout(contains("at 1 of 2 points (1)"));
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    assert!(read("report.html").contains("two-frequency"));
    for figure in ["figures/frequencies.svg", "figures/status.svg"] {
        assert!(read(figure).contains("two frequencies"), "{figure}");
    }
}

#[test]
fn a_ring_without_an_element_under_it_is_refused_with_the_count_that_it_needs() {
    let folder = folder();
    for command in ["transient", "cea"] {
        for elements in [1, 2] {
            Command::cargo_bin("frictionsim")
                .unwrap()
                .args([command, &case("ring-on-layer.toml"), "--no-figures", "--out"])
                .arg(folder.path().join("out"))
                .args(["--set", &format!("mesh.radial_elements={elements}")])
                .assert()
                .code(2)
                .stderr(contains("mesh.radial_elements"))
                .stderr(contains("at least 3 are needed"));
        }
    }
}

#[test]
fn a_jammed_block_is_said_to_jam_and_to_leave_small_displacements() {
    let folder = folder();
    let out = folder.path().join("out");
    let assert = Command::cargo_bin("frictionsim")
        .unwrap()
        .args(["transient", &case("sliding-block.toml"), "--no-figures", "--out"])
        .arg(&out)
        .args(["--set", "contact.friction_coefficient=0.9", "--set", "transient.duration=0.002"])
        .assert()
        .code(0)
        .stdout(contains("the body jams: there is no state of steady sliding"))
        .stdout(contains("leaves the theory of small displacements"));
    // A body without symmetry has no harmonic anywhere.
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(!text.contains("harmonic") && !text.contains("nodal"), "{text}");
    let summary = summary(&out);
    assert_eq!(summary["notes"].as_array().unwrap().len(), 2);
    assert!(summary["main_harmonic"].is_null());
    assert_eq!(summary["harmonics"].as_array().unwrap().len(), 0);
    assert_eq!(summary["significant_harmonics_m"].as_object().unwrap().len(), 0);
    assert!(!out.join("harmonics.csv").exists());
    assert!(summary["growth"].as_array().unwrap().iter().all(|g| g["harmonic"].is_null()));
}

/// The slowest mode of the stable block decays by 220 1/s here: the run ends at a hundredth of the deformation, far above round-off.
#[test]
fn a_vibration_that_decays_ends_in_steady_sliding() {
    let folder = folder();
    let out = folder.path().join("out");
    Command::cargo_bin("frictionsim")
        .unwrap()
        .args(["transient", &case("sliding-block.toml"), "--no-figures", "--out"])
        .arg(&out)
        .args(["--set", "damping.mass_coefficient=400.0", "--set", "transient.duration=0.04"])
        .assert()
        .code(0)
        .stdout(contains("The run ends in steady sliding"));
    assert_eq!(summary(&out)["end_state"], "steady-sliding");
}

#[test]
fn a_run_from_a_limit_cycle_has_no_linear_stage() {
    let folder = folder();
    let out = folder.path().join("out");
    let start = [
        "transient.initial=\"limit-cycle\"",
        "transient.limit_cycle_harmonic=2",
        // The waves of coarser meshes are no motion of the disc.
        "mesh.circumferential_elements=90",
        "mesh.radial_elements=18",
    ];
    let assert = frictionsim(&arguments(&out, &start)).assert().code(0);
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(!text.contains("linear stage"), "{text}");
    let summary = summary(&out);
    assert!(summary["growth"].as_array().unwrap().is_empty());
    assert!(summary["no_growth"].as_object().unwrap().is_empty());
}

#[test]
fn results_scale_with_the_thickness_and_nothing_else_does() {
    let folder = folder();
    let power = |thickness: &str| {
        let out = folder.path().join(thickness);
        let set = format!("geometry.thickness={thickness}");
        frictionsim(&arguments(&out, &[&set])).assert().code(0);
        let summary = summary(&out);
        [
            summary["power_w"]["external"].as_f64().unwrap(),
            summary["harmonics"][0].as_f64().unwrap(),
        ]
    };
    let (thin, thick) = (power("0.009"), power("0.018"));
    assert!((thick[0] / thin[0] - 2.0).abs() < 1e-14);
    assert_eq!(thin[1], thick[1]);
}

#[test]
fn results_are_the_same_bytes_for_any_number_of_threads() {
    let folder = folder();
    let run = |threads: &str| {
        let out = folder.path().join(threads);
        let mut arguments = arguments(&out, &[]);
        arguments.extend(["--threads".to_owned(), threads.to_owned()]);
        frictionsim(&arguments).assert().code(0);
        results(&out)
    };
    assert_eq!(run("1"), run("2"));
}

/// Starts a run and waits for its first checkpoint.
fn start_until_checkpoint(arguments: &[String], out: &Path) -> Child {
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("frictionsim"));
    command.args(arguments).stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    let start = Instant::now();
    while !out.join("checkpoint.bin").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no checkpoint after a minute");
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

const OFTEN: [&str; 2] = ["output.checkpoint_interval=0.02", "transient.duration=0.03"];

#[test]
fn a_killed_run_resumes_to_the_bytes_of_an_uninterrupted_one() {
    let folder = folder();
    let (whole, killed) = (folder.path().join("whole"), folder.path().join("killed"));
    frictionsim(&arguments(&whole, &OFTEN)).assert().code(0);
    let mut arguments = arguments(&killed, &OFTEN);
    let mut child = start_until_checkpoint(&arguments, &killed);
    child.kill().unwrap();
    child.wait().unwrap();
    arguments.push("--resume".to_owned());
    frictionsim(&arguments).assert().code(0);
    for (found, expected) in results(&killed).into_iter().zip(results(&whole)) {
        assert!(found == expected, "{}", expected.0.display());
    }
    let without_times = |mut summary: Value| {
        for key in ["wall_s", "element_steps_per_s"] {
            summary[key] = Value::Null;
        }
        summary
    };
    assert_eq!(without_times(summary(&killed)), without_times(summary(&whole)));
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_it_has_and_says_how_to_go_on() {
    let folder = folder();
    let out = folder.path().join("out");
    let mut arguments = arguments(&out, &OFTEN);
    let child = start_until_checkpoint(&arguments, &out);
    let status =
        std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(status.unwrap().success());
    let output = child.wait_with_output().unwrap();
    if output.status.code() == Some(0) {
        // The run ended before the signal came.
        return;
    }
    assert_eq!(output.status.code(), Some(130));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("--resume"), "{message}");
    assert_eq!(summary(&out)["finished"], false);
    assert!(out.join("energy.csv").exists());
    arguments.push("--resume".to_owned());
    frictionsim(&arguments).assert().code(0);
    assert_eq!(summary(&out)["finished"], true);
}

/// Longer runs of a finished one: the bytes of a run that was asked to last that long at once.
#[test]
fn a_finished_run_is_extended_bit_for_bit() {
    let folder = folder();
    let (whole, part) = (folder.path().join("whole"), folder.path().join("part"));
    let asked = |duration: &'static str| {
        let mut all =
            vec!["output.snapshots=[0.002, 0.005]", "transient.perturbation.velocity=0.5"];
        all.push(duration);
        all
    };
    frictionsim(&arguments(&whole, &asked("transient.duration=0.006"))).assert().code(0);
    frictionsim(&arguments(&part, &asked("transient.duration=0.003")))
        .assert()
        .code(0)
        .stderr(contains("0.005 s lies after the end of the run"));
    let mut longer = arguments(&part, &asked("transient.duration=0.006"));
    longer.push("--resume".to_owned());
    frictionsim(&longer).assert().code(0);
    for (found, expected) in results(&part).into_iter().zip(results(&whole)) {
        assert!(found == expected, "{}", expected.0.display());
    }
    let bytes = |folder: &Path, name: &str| fs::read(folder.join(name)).unwrap();
    for name in ["record.bin", "checkpoint.bin", "snapshots/snapshot-002.vtu"] {
        assert!(bytes(&part, name) == bytes(&whole, name), "{name}");
    }
    // Asked for again, it has nothing left to do; shorter than it is it cannot become.
    frictionsim(&longer).assert().code(0);
    let mut shorter = arguments(&part, &asked("transient.duration=0.004"));
    shorter.push("--resume".to_owned());
    frictionsim(&shorter)
        .assert()
        .code(2)
        .stderr(contains("has come to 0.006000 s, beyond transient.duration = 0.004 s"));
    // Nor can it go on from other seeds.
    let mut other = arguments(
        &part,
        &[
            "output.snapshots=[0.002, 0.005]",
            "transient.duration=0.006",
            "transient.perturbation={ harmonics = [2], velocity = 0.5, noise = 1e-3, noise_seed = 2 }",
        ],
    );
    other.push("--resume".to_owned());
    frictionsim(&other)
        .assert()
        .code(2)
        .stderr(contains("transient.perturbation.noise is 0.001 here, not given there"));
}

/// A mesh file that has changed since is another body: what is there stays as it is, and a plain rerun needs --force.
#[test]
fn a_refused_continuation_leaves_the_finished_folder_as_it_was() {
    let folder = folder();
    let mesh = String::from_utf8(file_of(&[BRICK], |point| point)).unwrap();
    let (path, case) = (folder.path().join("body.msh"), folder.path().join("case.toml"));
    fs::write(&path, &mesh).unwrap();
    fs::write(
        &case,
        "[mesh]\nfile = \"body.msh\"\n[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.38\ndensity = 1228.0\n\
         [boundaries.brick_z1]\ncondition = \"clamped\"\n[contact]\nboundary = \"brick_z0\"\ncounterface = \"plane\"\n\
         direction = [1.0, 0.0, 0.0]\nspeed = 1.0\nfriction_coefficient = 0.3\ninterference = 1e-5\n\
         normal_stiffness = 1e12\n[transient]\nduration = 4e-5\nexpansion_time = 1e-5\n",
    )
    .unwrap();
    let out = folder.path().join("out");
    let run = |further: &[&str]| {
        let mut all = vec!["transient", case.to_str().unwrap(), "--no-figures", "-qq", "--out"];
        all.push(out.to_str().unwrap());
        all.extend(further);
        frictionsim(&all.into_iter().map(str::to_owned).collect::<Vec<_>>()).assert()
    };
    run(&[]).code(0);
    let known = ["manifest.json", "mesh.msh", "summary.json", "checkpoint.bin"];
    let bytes = || known.map(|name| fs::read(out.join(name)).unwrap());
    let before = bytes();
    let moved = Block { size: [0.011, 0.01, 0.01], ..BRICK };
    fs::write(&path, file_of(&[moved], |point| point)).unwrap();
    run(&["--resume"]).code(2);
    assert!(bytes() == before, "the folder has changed");
    run(&[]).code(2).stderr(contains("--force"));
    assert!(bytes() == before);
    run(&["--force"]).code(0);
    assert!(bytes() != before);
}

#[test]
fn no_number_that_is_none_is_printed_or_written() {
    let folder = folder();
    for (name, set) in
        [("still", "contact.rotation_speed_rpm=0"), ("short", "transient.duration=0.0006")]
    {
        let out = folder.path().join(name);
        let output = frictionsim(&arguments(&out, &[set])).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let mut texts = vec![String::from_utf8_lossy(&output.stdout).into_owned()];
        for file in ["summary.json", "energy.csv", "contact.csv", "harmonics.csv", "probe-1.csv"] {
            texts.push(fs::read_to_string(out.join(file)).unwrap());
        }
        for text in &texts {
            let words = text.split(|c: char| c.is_whitespace() || ",:(".contains(c));
            for word in words {
                let word = word.trim_end_matches(['%', '.', ')']);
                let is_zero = word.parse::<f64>().is_ok_and(|value| value == 0.0);
                assert!(!["NaN", "nan", "inf", "-inf"].contains(&word), "{name}: {word}");
                assert!(!(is_zero && word.starts_with('-')), "{name}: {word}");
            }
        }
    }
}

#[test]
fn a_damaged_checkpoint_is_refused_with_the_reason_and_left_alone() {
    let folder = folder();
    let out = folder.path().join("out");
    let mut arguments = arguments(&out, &OFTEN);
    let mut child = start_until_checkpoint(&arguments, &out);
    child.kill().unwrap();
    child.wait().unwrap();
    let path = out.join("checkpoint.bin");
    let mut bytes = fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, &bytes).unwrap();
    arguments.push("--resume".to_owned());
    frictionsim(&arguments).assert().code(2).stderr(contains("checksum"));
    fs::write(&path, &bytes[..middle]).unwrap();
    frictionsim(&arguments).assert().code(2).stderr(contains("bytes where"));
    bytes[8] = 99;
    fs::write(&path, &bytes).unwrap();
    frictionsim(&arguments).assert().code(2).stderr(contains("format 99"));
    assert_eq!(fs::read(&path).unwrap(), bytes);
}

#[test]
fn bad_settings_are_bad_cases_with_their_bound() {
    let folder = folder();
    let out = folder.path().join("out");
    for (overrides, message) in [
        ("transient.time_step=2e-6", "above the stability limit of"),
        ("output.probes=[10000]", "10000"),
        ("transient.duration=0", "transient.duration"),
        ("transient.perturbation.harmonics=[31]", "30"),
        (
            "transient.perturbation.velocity=[1e-3, 2e-3]",
            "has 2 values, transient.perturbation.harmonics has 1",
        ),
        ("transient.perturbation={ phase_deg = 90 }", "without harmonics"),
        ("transient.perturbation.at=0.0041", "after the end of the run"),
        ("transient.perturbation.noise_seed=2", "without noise"),
        ("transient.expansion_time=0.005", "never be fully expanded"),
        ("output.sample_interval=0.01", "above transient.duration"),
    ] {
        frictionsim(&arguments(&out, &[overrides])).assert().code(2).stderr(contains(message));
    }
    assert!(!out.join("summary.json").exists());
}

/// The shipped cases keep their character on a coarse mesh.
#[test]
fn shipped_cases_end_in_the_limit_cycles_that_their_titles_say() {
    let folder = folder();
    for (name, harmonic, lifts_off) in
        [("polycarbonate-610rpm.toml", 2, true), ("polycarbonate-70rpm.toml", 1, false)]
    {
        let out = folder.path().join(name);
        let mut arguments = arguments(&out, &["transient.duration=0.04"]);
        arguments[1] = case(name);
        frictionsim(&arguments).assert().code(0);
        let summary = summary(&out);
        assert_eq!(summary["main_harmonic"], harmonic, "{name}");
        let open = summary["status"]["open"].as_f64().unwrap();
        assert_eq!(open > 0.0, lifts_off, "{name}: {open}");
        assert!(summary["status"]["stick"].as_f64().unwrap() > 0.2);
        assert!(summary["first_nonlinearity_s"].as_f64().unwrap() < 0.03);
    }
}
