//! `frictionsim cycle` as a user runs it: the shipped case, at full size in the long tier, and what it says where there is no cycle.

use crate::tier::sized;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str], out: &Path) -> Output {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/limit-cycle.toml");
    Command::new(env!("CARGO_BIN_EXE_frictionsim"))
        .args(["cycle", case, "--json", "--no-figures", "--out"])
        .arg(out)
        .args(arguments)
        .output()
        .unwrap()
}

/// Settings of the shipped case on half as many elements along each side.
const COARSE: [&str; 4] =
    ["--set", "mesh.circumferential_elements=90", "--set", "mesh.radial_elements=18"];

fn error(arguments: &[&str]) -> (i32, String) {
    let folder = tempfile::tempdir().unwrap();
    let output = run(arguments, &folder.path().join("cycle"));
    let text = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), text)
}

#[test]
fn shipped_case_follows_both_waves_over_the_speed_and_says_where_the_single_one_loses_stability() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("cycle");
    let (mesh, count) = sized((&COARSE[..], 31), (&[], 61));
    let count_set = format!("cycle.continuation.count={count}");
    let output = run(&[mesh, &["--set", "cycle.frames=3", "--set", &count_set]].concat(), &out);
    assert!(output.status.success(), "{output:?}");
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [one, two] = summary["cycles"].as_array().unwrap().as_slice() else {
        panic!("two waves");
    };
    for wave in [one, two] {
        assert_eq!(wave["stability"]["is_stable"], true);
        // The explicit transient, started on the wave, is still there: the project's bounds for one model in both.
        let (own, run) = (&wave["main_frequency_hz"], &wave["confirmation"]);
        let ratio = run["main_frequency_hz"].as_f64().unwrap() / own.as_f64().unwrap();
        assert!((ratio - 1.0).abs() < 1e-3 && run["agrees"] == true, "{run}");
        for status in ["stick", "slip", "open"] {
            let [a, b] = [wave, run].map(|of| of["status"][status].as_f64().unwrap());
            assert!((a - b).abs() < 0.02, "{status}: {a} {b}");
        }
        let branch = &wave["branch"];
        assert!(branch["cycles"].as_u64().unwrap() >= count);
        let ends = serde_json::json!(["the range ends", "the range ends"]);
        assert_eq!(branch["ends"], ends);
    }
    let changes = one["branch"]["stability_changes"].as_array().unwrap();
    assert_eq!(changes.len(), 1);
    // Transients on the full mesh that start on the cycle stay at 1229 rpm and have left it at 1400.
    let at = changes[0]["at"].as_f64().unwrap();
    if let Some(range) = sized(None, Some(1229.0..1400.0)) {
        assert!(range.contains(&at), "{at}");
        assert_eq!(changes[0]["harmonic"], 2);
    }
    // The double wave loses stability where its last point ceases to stick: a transient of 4000 rpm leaves it.
    let changes = two["branch"]["stability_changes"].as_array().unwrap();
    assert_eq!(changes.len(), 1);
    let ratio = changes[0]["at"].as_f64().unwrap()
        / two["branch"]["saturation_speed_rpm"].as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");

    let frames = std::fs::read_to_string(out.join("cycle-n2.pvd")).unwrap();
    assert!(frames.contains("cycle-n2.vtu") && frames.contains("cycle-n2-002.vtu"));
    assert!(out.join("cycle-n1-001.vtu").exists() && !out.join("cycle-n1-003.vtu").exists());

    let table = std::fs::read_to_string(out.join("stability-n1.csv")).unwrap();
    let header = "contact.rotation_speed_rpm,class,growth_rate_per_s,wave_frequency_rad_per_s,harmonic,frequency_hz,uncertainty_per_s";
    assert_eq!(table.lines().next().unwrap(), header);
    let branch = std::fs::read_to_string(out.join("branch-n1.csv")).unwrap();
    assert!(branch.lines().next().unwrap().ends_with("growth_rate_per_s,stability"));
}

#[test]
fn what_cannot_be_found_says_why_and_what_to_change() {
    let (code, text) = error(&["--set", "mesh.element=quad8"]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("quad4"), "{text}");
    // A mesh too coarse for the wave: it is refused, not reported.
    let coarse =
        ["mesh.circumferential_elements=60", "mesh.radial_elements=12", "cycle.harmonics=[2]"];
    let arguments: Vec<&str> = coarse.iter().flat_map(|set| ["--set", set]).collect();
    let (code, text) = error(&arguments);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains("refine the mesh") && text.contains("mesh.circumferential_elements"),
        "{text}"
    );
}

#[test]
fn below_every_onset_steady_sliding_is_said_to_be_stable_once_and_that_is_no_failure() {
    let folder = tempfile::tempdir().unwrap();
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/limit-cycle.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_frictionsim"))
        .args(["cycle", case, "--no-figures", "--out"])
        .arg(folder.path().join("cycle"))
        .args(sized(
            &["--set", "mesh.circumferential_elements=60", "--set", "mesh.radial_elements=10"][..],
            &[],
        ))
        .args(sized(&["--set", "cycle.harmonics=[1,3]"][..], &[]))
        .args(["--set", "contact.friction_coefficient=0.1"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.matches("steady sliding is stable").count(), 1, "{text}");
    assert!(text.contains("0.1 < 0.1"), "{text}");
}

#[test]
fn a_wave_that_the_transient_does_not_confirm_is_said_to_be_none() {
    // On so few elements a wave is found whose only nonlinearity is one open phase; the disc has no such motion.
    let folder = tempfile::tempdir().unwrap();
    let coarse = [
        "--set",
        "mesh.circumferential_elements=36",
        "--set",
        "mesh.radial_elements=8",
        "--set",
        "cycle.harmonics=[2]",
        "--set",
        "cycle.stability=none",
        "--set",
        "cycle.continuation.count=2",
    ];
    let output = run(&coarse, &folder.path().join("cycle"));
    let warning = String::from_utf8(output.stderr).unwrap();
    assert!(warning.contains("NOT CONFIRMED") && warning.contains("refine the mesh"), "{warning}");
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(summary["cycles"][0]["confirmation"]["agrees"], false);
    // The same cases without the test of the transient.
    let asked = [&coarse[..], &["--set", "cycle.confirmation_periods=0"]].concat();
    let output = run(&asked, &folder.path().join("unconfirmed"));
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(summary["cycles"][0]["confirmation"], Value::Null);
}

#[test]
fn a_study_of_limit_cycles_has_the_same_table_for_any_threads() {
    let folder = tempfile::tempdir().unwrap();
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/limit-cycle.toml");
    let table = |threads: &str| {
        let out = folder.path().join(threads);
        let [stability, frictions] = sized(["none", "[0.3,0.4]"], ["branch", "[0.2,0.3,0.4]"]);
        let set = [
            "cycle.continuation.count=3".to_owned(),
            format!("cycle.stability={stability}"),
            format!("sweep.\"contact.friction_coefficient\"={frictions}"),
        ];
        let run = Command::new(env!("CARGO_BIN_EXE_frictionsim"))
            .args(["sweep", case, "--quiet", "--no-figures", "--threads", threads, "--out"])
            .arg(&out)
            .args(COARSE)
            .args(set.iter().flat_map(|set| ["--set", set.as_str()]))
            .output()
            .unwrap();
        assert!(run.status.success(), "{run:?}");
        std::fs::read_to_string(out.join("points.csv")).unwrap()
    };
    let text = table("1");
    assert_eq!(text, table("2"));
    let header = text.lines().next().unwrap();
    for column in [
        "contact.friction_coefficient,",
        "cycles.n2_o1.main_frequency_hz",
        "cycles.n1_o1.confirmation.agrees",
        "cycles.n1_o1.branch.saturation_speed_rpm",
    ] {
        assert!(header.contains(column), "{column}");
    }
    assert!(!header.contains("wall_s") && !header.contains("curves"));
    assert_eq!(text.lines().count(), sized(3, 4));
}

#[cfg(unix)]
#[test]
fn an_interrupted_search_says_what_is_kept_and_can_be_started_again() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("cycle");
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/limit-cycle.toml");
    // Hours of work, if it were let.
    let child = Command::new(env!("CARGO_BIN_EXE_frictionsim"))
        .args(["cycle", case, "--no-figures", "--out"])
        .arg(&out)
        .args(COARSE)
        .args(["--set", "cycle.continuation.count=100000"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let begin = std::time::Instant::now();
    while !out.join("manifest.json").exists() {
        assert!(begin.elapsed().as_secs() < 60);
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    // The handler is in place as soon as the folder is.
    std::thread::sleep(std::time::Duration::from_millis(200));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{text}");
    assert!(text.contains("interrupted; nothing of this run is kept"), "{text}");
    let short = ["--force", "--set", "cycle.continuation.count=2", "--set", "cycle.stability=none"];
    let again = run(&[&COARSE[..], &short].concat(), &out);
    assert!(again.status.success(), "{again:?}");
}

/// The shipped block at a friction coefficient at which one mode grows.
fn run_block(arguments: &[&str], out: &Path) -> Output {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/sliding-block.toml");
    Command::new(env!("CARGO_BIN_EXE_frictionsim"))
        .args(["cycle", case, "--json", "--no-figures"])
        .args(["--set", "contact.friction_coefficient=0.7"])
        .args(["--set", "cycle.frames=2", "--out"])
        .arg(out)
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn a_body_without_symmetry_has_its_cycle_in_tables_without_a_harmonic_of_a_circumference() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("cycle");
    let output = run_block(&[], &out);
    assert!(output.status.success(), "{output:?}");
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [own] = summary["cycles"].as_array().unwrap().as_slice() else {
        panic!("one mode grows: {summary}");
    };
    assert_eq!(own["mode"], 7);
    assert_eq!(own["stability"]["verdict"], "stable");
    assert_eq!(own["confirmation"]["agrees"], true);
    assert!(own["balance_residual"].as_f64().unwrap() < 1e-7);
    assert!(own["harmonic_remainder"].as_f64().unwrap() <= 1e-3);
    for absent in ["harmonic", "onset", "phases", "direction"] {
        assert!(own.get(absent).is_none(), "{absent}");
    }
    let header = |name: &str| {
        let text = std::fs::read_to_string(out.join(name)).unwrap();
        text.lines().next().unwrap().to_owned()
    };
    assert!(header("cycle-mode7.csv").starts_with("phase_rad,time_s,status,pressure_pa"));
    assert!(header("contact-mode7.csv").starts_with("node,x_m,y_m,stick,slip,open"));
    assert!(header("harmonics-mode7.csv").ends_with("remainder"));
    assert!(header("stability-mode7.csv").starts_with("growth_rate_per_s,beat_hz"));
    assert!(out.join("cycle-mode7-001.vtu").exists() && out.join("contact-mode7.npz").exists());
    // What an interrupted search keeps has served its purpose.
    assert!(!out.join("done-mode7.json").exists());
}

#[test]
fn the_cycle_of_a_whole_mesh_has_the_same_bytes_for_any_threads() {
    let folder = tempfile::tempdir().unwrap();
    let table = |threads: &str| {
        let out = folder.path().join(threads);
        let set = ["--threads", threads, "--set", "cycle.confirmation_periods=0"];
        let output = run_block(&set, &out);
        assert!(output.status.success(), "{output:?}");
        ["cycle-mode7.csv", "contact-mode7.npz", "stability-mode7.csv"]
            .map(|name| std::fs::read(out.join(name)).unwrap())
    };
    assert!(table("1") == table("2"));
}

#[test]
fn a_body_without_symmetry_says_what_it_does_not_use_and_where_nothing_grows() {
    let folder = tempfile::tempdir().unwrap();
    let set = ["--set", "cycle.harmonics=[1]", "--set", "contact.friction_coefficient=0.5"];
    let output = run_block(&set, &folder.path().join("stable"));
    let (words, text) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(output.status.success(), "{text}");
    assert!(text.contains("cycle.harmonics is not used"), "{text}");
    let summary: Value = serde_json::from_str(&words).unwrap();
    assert_eq!(summary["steady_sliding_stable"], true);
    assert!(summary["least_stable"]["growth_rate_per_s"].as_f64().unwrap() < 0.0);

    let rest = run_block(&["--set", "contact.speed=0"], &folder.path().join("rest"));
    let text = String::from_utf8(rest.stderr).unwrap();
    assert_eq!(rest.status.code(), Some(2), "{text}");
    assert!(text.contains("contact.speed") && text.contains("sticks at rest"), "{text}");
}
