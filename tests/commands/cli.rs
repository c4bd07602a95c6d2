//! Behaviour of the commands as a user meets it: exit codes, streams, files, messages.

use assert_cmd::Command;
use predicates::prelude::*;
use predicates::str::contains;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A coarse mesh, so that each run takes milliseconds.
const COARSE: [&str; 4] =
    ["--set", "mesh.circumferential_elements=16", "--set", "mesh.radial_elements=3"];

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")
}

fn disc() -> String {
    cases().join("polycarbonate-disc.toml").display().to_string()
}

/// The program in a folder of its own.
fn frictionsim(folder: &TempDir) -> Command {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    command.current_dir(folder.path());
    command
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Writes the disc case with some text replaced.
fn damaged(folder: &TempDir, from: &str, to: &str) -> &'static str {
    let text = fs::read_to_string(disc()).unwrap();
    assert!(text.contains(from), "{from}");
    fs::write(folder.path().join("bad.toml"), text.replace(from, to)).unwrap();
    "bad.toml"
}

/// What was printed, its words a space apart.
fn words(run: &assert_cmd::assert::Assert) -> String {
    let said = String::from_utf8_lossy(&run.get_output().stdout);
    said.split_whitespace().collect::<Vec<&str>>().join(" ")
}

#[test]
fn no_arguments_show_the_help_and_are_bad_usage() {
    let folder = folder();
    frictionsim(&folder).assert().code(2).stderr(contains("Usage"));
}

#[test]
fn help_lists_the_exit_codes_and_version_prints_the_package_version() {
    let folder = folder();
    let help = frictionsim(&folder).arg("--help").assert().code(0);
    help.stdout(contains(
        "Exit codes: 0 done, 1 the run failed, 2 bad usage or case, 130 interrupted",
    ));
    let version = frictionsim(&folder).arg("--version").assert().code(0);
    version.stdout(contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn every_shipped_case_is_valid_and_has_a_cost() {
    let folder = folder();
    let entries = fs::read_dir(cases()).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let is_case = |path: &PathBuf| path.extension().is_some_and(|e| e == "toml");
    let paths: Vec<PathBuf> = paths.filter(is_case).collect();
    let assert = frictionsim(&folder).arg("check").args(&paths).assert().code(0);
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert_eq!(text.matches(": valid").count(), paths.len(), "{text}");
    assert!(text.contains("steps") && text.contains("MiB") && text.contains("unknowns"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "check wrote something");
}

#[test]
fn check_reports_the_cost_as_numbers() {
    let folder = folder();
    let run = cases().join("polycarbonate-610rpm.toml");
    let assert = frictionsim(&folder).args(["check", "--json"]).arg(run).assert().code(0);
    let value: serde_json::Value = serde_json::from_slice(&assert.get_output().stdout).unwrap();
    let case = &value["cases"][0];
    assert_eq!(case["dofs"], 12960);
    let (step, steps) = (&case["transient"]["time_step_s"], &case["transient"]["steps"]);
    let covered = step.as_f64().unwrap() * steps.as_f64().unwrap();
    assert!((covered / 0.05 - 1.0).abs() < 1e-4, "{covered}");
    let cycles = cases().join("limit-cycle.toml");
    let run = frictionsim(&folder).args(["check", "--json"]).arg(cycles).assert().code(0);
    let report: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let cycle = &report["cases"][0]["cycle"];
    assert_eq!((&cycle["families"], &cycle["cycles"]), (&2.into(), &62.into()));
    assert_eq!(cycle["time"], "seconds");
}

#[test]
fn the_shipped_disc_turns_unstable_where_the_continuum_does() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    let run = command.args(["cea", &disc(), "--json", "--no-figures"]).assert().code(0);
    let summary: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    // Onset of the exact continuum model; the mesh and the prestress move it by less than 0.003.
    for (harmonic, branch, onset) in [(1, 2, 0.1224), (2, 1, 0.1382), (1, 1, 0.2121)] {
        let critical = summary["critical_frictions"].as_array().unwrap();
        let is_it =
            |row: &&serde_json::Value| row["harmonic"] == harmonic && row["branch"] == branch;
        let row = critical.iter().find(is_it).unwrap();
        let found = row["critical_friction"].as_f64().unwrap();
        assert!((found - onset).abs() < 0.003, "{harmonic} {branch} {found}");
        assert_eq!(row["direction"], -1, "the unstable wave travels against the rotor");
    }
    assert!(summary["largest_residual"].as_f64().unwrap() < 1e-9);
    let at = summary["unstable_counts"].as_array().unwrap();
    let row = at.iter().find(|row| row["friction_coefficient"] == 0.3).unwrap();
    assert_eq!((&row["modes"], &row["unstable"]), (&28.into(), &3.into()));
}

#[test]
fn an_eigenvalue_sweep_has_the_same_bytes_for_any_thread_count() {
    let folder = folder();
    let tables = ["1", "2"].map(|threads| {
        let mut command = frictionsim(&folder);
        command.args(["cea", &disc(), "--no-figures", "--out", threads, "--threads", threads]);
        command.args(COARSE).assert().code(0);
        ["eigenvalues.csv", "stability.csv", "prestress.csv", "modes.pvd"]
            .map(|name| fs::read(folder.path().join(threads).join(name)).unwrap())
    });
    assert_eq!(tables[0], tables[1]);
}

#[test]
fn cea_prints_the_table_and_draws_its_figures() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    let run =
        command.args(["--verbose", "cea", &disc(), "-o", "here"]).args(COARSE).assert().code(0);
    run.stdout(
        contains("critical friction")
            .and(contains("largest residual"))
            .and(contains("32 contact nodes slipping, 0 sticking, 0 open"))
            .and(contains("stable up to")),
    )
    .stderr("");
    for name in ["figures/locus.svg", "figures/pairs.png", "modes/mu-0.3-mode-001.vtu"] {
        assert!(folder.path().join("here").join(name).exists(), "{name}");
    }
}

#[test]
fn a_frequency_range_without_modes_is_an_error_of_the_case() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["cea", &disc(), "--set", "cea.max_frequency_hz=500"]).args(COARSE);
    let message = contains("there are no modes below it").and(contains("--set:1:"));
    command.assert().code(2).stderr(message);
}

#[test]
fn a_case_without_the_section_of_the_command_says_what_to_add() {
    let folder = folder();
    let study = cases().join("speed-friction-study.toml").display().to_string();
    let run = frictionsim(&folder).args(["cea", &study]).assert().code(2);
    run.stderr(contains("no [cea] section").and(contains("max_frequency_hz")));
}

#[test]
fn check_tells_scripts_what_is_wrong() {
    let folder = folder();
    let bad = damaged(&folder, "density = 1228.0", "density = -1");
    let run = frictionsim(&folder).args(["check", "--json", bad]).assert().code(2);
    let value: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    let errors = &value["cases"][0]["errors"];
    assert_eq!(errors.as_array().unwrap().len(), 1);
    assert!(errors[0].as_str().unwrap().contains("material.density"), "{errors}");
}

#[test]
fn check_goes_on_after_a_bad_case() {
    let folder = folder();
    let bad = damaged(&folder, "density = 1228.0", "density = -1");
    let assert = frictionsim(&folder).args(["check", bad, &disc()]).assert().code(2);
    assert
        .stdout(contains("polycarbonate-disc.toml: valid"))
        .stderr(contains("material.density = -1 must be positive").and(contains("1 of 2")));
}

#[test]
fn bad_cases_exit_with_2_and_say_where_and_what() {
    for (from, to, parts) in [
        ("poisson_ratio = 0.3805", "poisson_ratio = 0.5", ["bad.toml:27:", "between -1 and 0.5"]),
        ("outer_radius = 0.0905", "outer_radius = 0.01", ["must be above", "are they swapped?"]),
        ("radial_elements = 40", "radial_elements = 0", ["must be 1 or more", "radial_elements"]),
        (
            "mass_coefficient = 40.0",
            "mas_coefficient = 40",
            ["did you mean `mass_coefficient`?", "unknown key"],
        ),
        (
            "interference = 25e-6",
            "interference = true",
            ["must be a number, not a boolean", "^^^^"],
        ),
        ("[material]", "[material", ["bad.toml:", "[material"]),
    ] {
        let folder = folder();
        let bad = damaged(&folder, from, to);
        let assert = frictionsim(&folder).args(["mesh", bad]).assert().code(2);
        assert.stderr(contains(parts[0]).and(contains(parts[1]))).stdout("");
        assert!(!folder.path().join("results").exists(), "a bad case wrote results");
    }
}

#[test]
fn a_missing_case_file_is_bad_usage() {
    let folder = folder();
    let assert = frictionsim(&folder).args(["mesh", "nowhere.toml"]).assert();
    assert.code(2).stderr(contains("cannot read nowhere.toml"));
}

#[test]
fn a_mesh_too_large_for_memory_is_refused_before_it_is_built() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["mesh", &disc(), "--set", "mesh.circumferential_elements=20000"]);
    command.args(["--set", "mesh.radial_elements=30000"]);
    let refused = contains("mesh.circumferential_elements").and(contains("lower mesh"));
    command.assert().code(2).stderr(refused);
}

#[test]
fn mesh_writes_into_the_default_folder_and_prints_statistics() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["mesh", &disc()]).args(COARSE);
    // 16 sectors of 3 x 3 + 2 nodes.
    assert!(words(&command.assert().code(0)).contains("nodes 176 elements 48 unknowns 352"));
    let results = folder.path().join("results/polycarbonate-disc/mesh");
    for name in
        ["mesh.vtu", "figures/mesh.svg", "figures/mesh.png", "summary.json", "manifest.json"]
    {
        assert!(results.join(name).exists(), "{name}");
    }
}

#[test]
fn json_is_the_summary_alone_with_its_manifest() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["mesh", &disc(), "--json", "--threads", "1", "--simd", "scalar"]).args(COARSE);
    let assert = command.assert().code(0);
    let printed: serde_json::Value = serde_json::from_slice(&assert.get_output().stdout).unwrap();
    let path = folder.path().join("results/polycarbonate-disc/mesh/summary.json");
    let written: serde_json::Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    assert_eq!(printed, written);
    let manifest = &printed["manifest"];
    assert_eq!(manifest["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(manifest["case_text"], fs::read_to_string(disc()).unwrap());
    assert_eq!(manifest["overrides"][1], "mesh.radial_elements=3");
    assert_eq!((&manifest["threads"], &manifest["simd"]), (&1.into(), &"scalar".into()));
}

#[test]
fn a_pipe_gets_no_progress_and_no_colours() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    let assert = command.args(["mesh", &disc()]).args(COARSE).assert().code(0);
    let output = assert.get_output();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!output.stdout.contains(&0x1b));
}

#[test]
fn no_figures_leaves_the_picture_out() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["mesh", &disc(), "--no-figures", "--out", "here"]).args(COARSE);
    command.assert().code(0);
    assert!(!folder.path().join("here/figures").exists());
    assert!(folder.path().join("here/mesh.vtu").exists());
}

#[test]
fn a_named_folder_of_another_case_is_refused_unless_forced() {
    let folder = folder();
    let run = |extra: &[&str]| {
        let mut command = frictionsim(&folder);
        command.args(["mesh", &disc(), "--out", "here"]).args(COARSE).args(extra);
        command.assert()
    };
    run(&[]).code(0);
    run(&[]).code(0);
    let other = ["--set", "mesh.radial_elements=4"];
    run(&other).code(2).stderr(contains("another case").and(contains("--force")));
    let forced = [other.as_slice(), &["--force"]].concat();
    assert!(words(&run(&forced).code(0)).contains("elements 64"));
}

#[test]
fn no_run_replaces_the_results_of_another_one_in_silence() {
    let folder = folder();
    let around = ["--set", "mesh.circumferential_elements=16"];
    for elements in ["3", "4", "5", "3"] {
        let set = format!("mesh.radial_elements={elements}");
        let mut command = frictionsim(&folder);
        command.args(["mesh", &disc(), "--set", &set, "--json"]).args(around);
        command.assert().code(0);
    }
    let nodes = |name: &str| {
        let path = folder.path().join("results/polycarbonate-disc").join(name);
        let text = fs::read(path.join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_slice(&text).unwrap();
        summary["mesh"]["elements"].as_u64().unwrap()
    };
    // The first has the plain name, the others one that says what they differ in.
    assert_eq!(nodes("mesh"), 48);
    let beside = |n: usize| format!("mesh-radial_elements={n},circumferential_elements=16");
    assert_eq!(nodes(&beside(4)), 64);
    assert_eq!(nodes(&beside(5)), 80);
    assert!(!folder.path().join("results/polycarbonate-disc").join(beside(3)).exists());
    // Nothing tells the case as it is written from what is there: that is for the user to decide.
    let plain = || {
        let mut command = frictionsim(&folder);
        command.args(["mesh", &disc(), "--no-figures"]);
        command
    };
    let refused = contains("--set mesh.radial_elements=3").and(contains("--force"));
    plain().assert().code(2).stderr(refused);
    plain().arg("--force").assert().code(0);
    let name = folder.path().join("polycarbonate-disc.toml");
    let text = fs::read_to_string(disc()).unwrap();
    fs::write(&name, text.replace("density = 1228.0", "density = 1200.0")).unwrap();
    // Another case of the same name, and then that case edited.
    let mut command = frictionsim(&folder);
    let other = command.args(["mesh", "polycarbonate-disc.toml"]).assert();
    other.code(2).stderr(contains("another case"));
}

#[test]
fn an_output_folder_that_cannot_be_made_fails_the_run_with_its_path() {
    let folder = folder();
    fs::write(folder.path().join("file"), "x").unwrap();
    let mut command = frictionsim(&folder);
    command.args(["mesh", &disc(), "--out", "file/below"]).args(COARSE);
    command
        .assert()
        .code(1)
        .stderr(contains("cannot create folder file/below"))
        .stderr(contains("os error").count(1));
}

#[test]
fn a_folder_that_another_process_writes_is_refused() {
    let folder = folder();
    fs::create_dir(folder.path().join("here")).unwrap();
    let lock = fs::File::create(folder.path().join("here/.lock")).unwrap();
    lock.try_lock().unwrap();
    let run = || {
        let mut command = frictionsim(&folder);
        command.args(["mesh", &disc(), "--out", "here"]).args(COARSE);
        command.assert()
    };
    run().code(1).stderr(contains("being written by another process"));
    drop(lock);
    run().code(0);
}

#[test]
fn warnings_go_to_stderr_and_stay_unless_quiet_is_said_twice() {
    let folder = folder();
    let run = cases().join("polycarbonate-610rpm.toml").display().to_string();
    let mesh = |extra: &[&str]| {
        let mut command = frictionsim(&folder);
        command.args(["mesh", &run, "--set", "transient.duration=0.01"]).args(extra);
        command.assert().code(0)
    };
    mesh(&[]).stderr(contains("output.snapshots: 0.03 s lies after the end"));
    mesh(&["--quiet"]).stderr(contains("output.snapshots: 0.03 s lies after the end"));
    mesh(&["-qq"]).stderr("").stdout("");
}

#[test]
fn an_unavailable_thread_count_or_simd_level_is_bad_usage() {
    let folder = folder();
    for option in [["--threads", "0"], ["--simd", "mmx"]] {
        let mut command = frictionsim(&folder);
        command.args(["mesh", &disc()]).args(option).assert().code(2);
    }
}

#[test]
fn init_writes_cases_that_check_accepts_and_overwrites_nothing() {
    let folder = folder();
    let list = frictionsim(&folder).args(["init", "--list"]).assert().code(0);
    let text = String::from_utf8(list.get_output().stdout.clone()).unwrap();
    for line in text.lines() {
        let name = line.split_whitespace().next().unwrap();
        let file = format!("{name}.toml");
        let init = || frictionsim(&folder).args(["init", name]).assert();
        // Meshes and tables that the case reads are listed behind it.
        init().code(0).stdout(predicates::str::starts_with(format!("{file}\n")));
        frictionsim(&folder).args(["check", &file]).assert().code(0);
        let written = fs::read(folder.path().join(&file)).unwrap();
        fs::write(folder.path().join(&file), "precious").unwrap();
        init().code(2).stderr(contains("exists").and(contains("--force")));
        assert_eq!(fs::read_to_string(folder.path().join(&file)).unwrap(), "precious");
        frictionsim(&folder).args(["init", name, "--force"]).assert().code(0);
        assert_eq!(fs::read(folder.path().join(&file)).unwrap(), written);
    }
    let unknown = frictionsim(&folder).args(["init", "squeak"]).assert().code(2);
    unknown.stderr(contains("no template \"squeak\"").and(contains("transient")));
}

#[test]
fn init_all_writes_every_shipped_case_with_its_mesh_and_overwrites_nothing() {
    let folder = folder();
    let all = || frictionsim(&folder).args(["init", "--all"]).assert();
    all().code(0).stdout(contains("cases/sliding-block.toml"));
    let shipped = fs::read_dir(cases()).unwrap().flatten();
    let names = shipped.map(|entry| entry.file_name());
    let toml: Vec<_> = names.filter(|name| name.to_string_lossy().ends_with(".toml")).collect();
    assert!(toml.len() > 20);
    // Each is the shipped one, which another test checks, with what it reads beside it.
    for name in toml {
        let written = fs::read(folder.path().join("cases").join(&name)).unwrap();
        assert_eq!(written, fs::read(cases().join(&name)).unwrap());
    }
    for entry in fs::read_dir(cases().join("meshes")).unwrap().flatten() {
        let name = entry.file_name();
        if [".msh", ".inp"].iter().any(|end| name.to_string_lossy().ends_with(end)) {
            assert!(folder.path().join("cases/meshes").join(&name).exists(), "{name:?}");
        }
    }
    // What is there as it would be written stays; what is not is not overwritten.
    all().code(0).stdout("");
    fs::write(folder.path().join("cases/basin.toml"), "precious").unwrap();
    all().code(2).stderr(contains("basin.toml exists"));
}

#[test]
fn init_to_stdout_is_the_case_alone() {
    let folder = folder();
    let assert = frictionsim(&folder).args(["init", "--out", "-"]).assert().code(0);
    assert.stdout(fs::read_to_string(disc()).unwrap());
}

#[test]
fn completions_and_manual_name_every_subcommand() {
    let folder = folder();
    let help = frictionsim(&folder).arg("--help").assert();
    let text = String::from_utf8(help.get_output().stdout.clone()).unwrap();
    let names: Vec<&str> = text
        .lines()
        .skip_while(|line| !line.starts_with("Analyse:"))
        .take_while(|line| !line.starts_with("Options:"))
        .filter(|line| line.starts_with("  "))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(names.contains(&"check"), "{names:?}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let assert = frictionsim(&folder).args(["completions", shell]).assert().code(0);
        let script = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        for name in &names {
            assert!(script.contains(name), "{shell} does not know {name}");
        }
    }
    let man = frictionsim(&folder).arg("man").assert().code(0);
    let page = String::from_utf8(man.get_output().stdout.clone()).unwrap();
    assert!(page.contains(".TH frictionsim"));
    frictionsim(&folder).args(["man", "--out", "pages"]).assert().code(0);
    for name in names.iter().filter(|name| **name != "help") {
        let page = folder.path().join(format!("pages/frictionsim-{name}.1"));
        assert!(page.exists(), "{}", page.display());
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    use std::process::{Command, Stdio};
    let program = assert_cmd::cargo::cargo_bin("frictionsim");
    let mut child = Command::new(program)
        .args(["completions", "zsh"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn options_may_stand_before_the_command() {
    let folder = folder();
    let before = ["-q", "--no-figures", "-o", "here", "--set", COARSE[1], "mesh"];
    let mut command = frictionsim(&folder);
    command.args(before).arg(disc()).args(&COARSE[2..]);
    assert!(words(&command.assert().code(0)).contains("elements 48"));
    assert!(folder.path().join("here/summary.json").exists());
}

#[test]
fn a_case_from_standard_input_has_a_folder_of_its_own() {
    let folder = folder();
    let mut command = frictionsim(&folder);
    command.args(["mesh", "-", "-q"]).args(COARSE).write_stdin(fs::read(disc()).unwrap());
    command.assert().code(0);
    let results = folder.path().join("results/stdin/mesh");
    assert!(results.join("summary.json").exists());
    // It is drawn again from the folder alone.
    let plot = frictionsim(&folder).arg("plot").arg(&results).assert();
    plot.code(0);
    let bad = frictionsim(&folder).args(["mesh", "-"]).write_stdin("title = 3").assert();
    bad.code(2).stderr(contains("standard input:1:"));
}

#[test]
fn a_dry_run_checks_everything_and_touches_nothing() {
    let folder = folder();
    let run = |command: &str, more: &[&str]| {
        let mut program = frictionsim(&folder);
        program.args([command, &disc(), "--dry-run"]).args(COARSE);
        program.args(more).assert()
    };
    let said = contains("valid").and(contains("results/polycarbonate-disc/cea"));
    run("cea", &[]).code(0).stdout(said).stderr("");
    run("cea", &["--set", "material.density=-1"]).code(2);
    // What no section would help against comes before the section that is missing.
    run("transient", &[]).code(2).stderr(contains("quad4"));
    run("transient", &["--set", "mesh.element=quad4"]).code(2).stderr(contains("[transient]"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    fs::create_dir(folder.path().join("here")).unwrap();
    fs::write(folder.path().join("here/thesis.tex"), "x").unwrap();
    run("cea", &["--out", "here"]).code(2).stderr(contains("thesis.tex"));
    let json = run("cea", &["--json"]).code(0);
    let value: serde_json::Value = serde_json::from_slice(&json.get_output().stdout).unwrap();
    assert_eq!(value["folder"], "results/polycarbonate-disc/cea");
    assert_eq!(value["replaces"], false);
}

#[test]
fn denied_warnings_are_errors_of_the_case() {
    let folder = folder();
    let run = |more: &[&str]| {
        let mut command = frictionsim(&folder);
        command
            .args(["mesh", &disc(), "--no-figures", "--set"])
            .arg("contact.friction_coefficient=30")
            .args(COARSE)
            .args(more);
        command.assert()
    };
    run(&["--deny-warnings"]).code(2).stderr(contains("friction_coefficient"));
    assert!(!folder.path().join("results").exists());
    run(&[]).code(0).stderr(contains("WARN"));
}

#[test]
fn help_names_the_default_folder_of_the_command() {
    let folder = folder();
    for (command, path) in [("cea", "results/CASE/cea"), ("signal", "results/SIGNAL/signal")] {
        let help = frictionsim(&folder).args([command, "--help"]).assert();
        help.code(0).stdout(contains(format!("[default: {path}]")));
    }
}

#[test]
fn a_manual_page_tells_files_examples_and_exit_status() {
    let folder = folder();
    let page = frictionsim(&folder).args(["man", "cea"]).assert().code(0);
    let text = String::from_utf8(page.get_output().stdout.clone()).unwrap();
    for part in
        [".SH \"FILES\"", "eigenvalues.csv", ".SH \"EXAMPLES\"", "frictionsim cea disc.toml"]
    {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(text.contains(".SH \"EXIT STATUS\"") && text.contains("\\fB130\\fR"));
    let unknown = frictionsim(&folder).args(["man", "squeal"]).assert();
    unknown.code(2).stderr(contains("no command squeal"));
}

/// A table in a folder of results is known by that folder.
#[test]
fn tables_of_one_name_from_two_runs_have_a_folder_each() {
    let folder = folder();
    for (run, frequency) in [("70rpm", 900.0), ("610rpm", 1100.0)] {
        let path = folder.path().join("results").join(run).join("transient");
        fs::create_dir_all(&path).unwrap();
        let mut table = "time_s,v\n".to_owned();
        for i in 0..400 {
            let t = 1e-4 * f64::from(i);
            table += &format!("{t},{}\n", (std::f64::consts::TAU * frequency * t).sin());
        }
        fs::write(path.join("probe-1.csv"), table).unwrap();
        let signal = format!("results/{run}/transient/probe-1.csv");
        let mut command = frictionsim(&folder);
        command.args(["signal", &signal, "--no-figures"]).assert().code(0);
    }
    for name in ["signal", "signal-610rpm-transient"] {
        let path = folder.path().join("results/probe-1").join(name);
        assert!(path.join("summary.json").exists(), "{name}");
    }
}
