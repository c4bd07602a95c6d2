//! Behaviour of the commands as a user meets it: exit codes, streams, files, messages.

use crate::prelude::*;

/// A coarse mesh, so that each run takes milliseconds.
const COARSE: [&str; 2] = ["mesh.circumferential_elements=16", "mesh.radial_elements=3"];

fn disc() -> String {
    shipped("polycarbonate-disc.toml")
}

pub fn run(folder: &TempDir, words: &[&str]) -> Run {
    Run::new(words).within(folder)
}

fn on_disc(command: &str, more: &[&str]) -> Run {
    Run::new(&[command, &disc()]).set(&COARSE).args(more)
}

/// Writes the disc case with a negative density.
fn damaged(folder: &TempDir) -> &'static str {
    let text = fs::read_to_string(disc()).unwrap().replace("density = 1228.0", "density = -1");
    fs::write(folder.path().join("bad.toml"), text).unwrap();
    "bad.toml"
}

#[test]
fn help_has_exit_codes_and_default_folders_and_no_arguments_show_it_as_bad_usage() {
    run(&folder(), &[]).refused(&["Usage"]);
    let codes = "Exit codes: 0 done, 1 the run failed, 2 bad usage or case, 130 interrupted";
    run(&folder(), &["--help"]).done().says(&[codes]);
    run(&folder(), &["--version"]).done().says(&[env!("CARGO_PKG_VERSION")]);
    for (command, path) in [("cea", "results/CASE/cea"), ("signal", "results/SIGNAL/signal")] {
        run(&folder(), &[command, "--help"]).done().says(&[&format!("[default: {path}]")]);
    }
}

#[test]
fn check_reports_the_cost_as_numbers() {
    let cost = |name: &str| {
        run(&folder(), &["check", "--json", &shipped(name)]).done().value()["cases"][0].clone()
    };
    let case = cost("polycarbonate-610rpm.toml");
    assert_eq!(case["dofs"], 12960);
    let (step, steps) = (&case["transient"]["time_step_s"], &case["transient"]["steps"]);
    let covered = step.as_f64().unwrap() * steps.as_f64().unwrap();
    assert!((covered / 0.05 - 1.0).abs() < 1e-4, "{covered}");
    let cycle = &cost("limit-cycle.toml")["cycle"];
    assert_eq!((&cycle["families"], &cycle["cycles"]), (&2.into(), &62.into()));
    assert_eq!(cycle["time"], "seconds");
}

#[test]
fn a_sweep_has_the_values_asked_for_and_that_of_the_case() {
    for at in ["", " ; cea.shapes_at=[0.1]"] {
        let asked = format!("cea.friction_coefficients=[0.1, 0.2]{at}");
        let answer = on_disc("cea", &["--no-figures"]).set(&[asked]).out("o").done();
        let rows = answer.rows("eigenvalues.csv");
        let found: BTreeSet<_> = rows.iter().map(|row| &row["friction_coefficient"]).collect();
        assert_eq!(found.into_iter().collect::<Vec<_>>(), ["0.1", "0.2", "0.3"]);
    }
}

#[test]
fn cea_prints_the_table_and_draws_its_figures() {
    let said = "critical friction ; largest residual ; stable up to ; \
        32 contact nodes slipping, 0 sticking, 0 open";
    let answer = on_disc("cea", &["--verbose"]).out("here").done().says(&[said]);
    assert_eq!(answer.stderr, "");
    answer.wrote(
        "eigenvalues.csv stability.csv summary.json manifest.json modes.pvd \
         modes/mu-0.3-mode-001.vtu \
         prestress.csv prestress.vtu figures/locus.svg figures/pairs.png figures/prestress.png \
         figures/modes-mu-0.3.png",
    );
}

#[test]
fn a_file_that_is_not_there_is_answered_with_the_one_that_is_meant() {
    let folder = folder();
    damaged(&folder);
    run(&folder, &["cea", "bda.toml"]).refused(&["cannot read bda.toml", "did you mean bad.toml?"]);
    run(&folder, &["cea", "bad"]).refused(&["did you mean bad.toml?"]);
    let shipped = run(&folder, &["frf", "cases/hammer-test.toml"]);
    shipped.refused(&["`frictionsim init --all` writes the shipped cases ; !did you mean"]);
    // The system's words alone told neither where it was looked for nor what to do.
    run(&folder, &["cea", "another.toml"])
        .refused(&["cannot read another.toml: there is no file \
         ; another.toml; `frictionsim init ; !did you mean"]);
    run(&folder, &["mesh", "."]).refused(&["cannot read .: it is a folder"]);
}

#[test]
fn check_goes_on_after_a_bad_case_and_tells_scripts_what_is_wrong() {
    let folder = folder();
    let value = run(&folder, &["check", "--json", damaged(&folder)]).refused(&[]).value();
    let errors = &value["cases"][0]["errors"];
    assert_eq!(errors.as_array().unwrap().len(), 1);
    has(errors[0].as_str().unwrap(), &["material.density"]);
    let answer = run(&folder, &["check", damaged(&folder), &disc()])
        .refused(&["material.density = -1 must be positive", "1 of 2"]);
    answer.says(&["polycarbonate-disc.toml: valid"]);
}

#[test]
fn mesh_writes_into_the_default_folder_and_prints_statistics_without_progress_or_colours() {
    let answer = on_disc("mesh", &[]).done();
    // A pipe takes what is printed.
    assert!(answer.stderr.is_empty() && !answer.stdout.contains('\u{1b}'), "{}", answer.stderr);
    // 16 sectors of 3 x 3 + 2 nodes.
    has(&answer.words(), &["nodes 176 elements 48 unknowns 352"]);
    let files =
        ["mesh.vtu", "summary.json", "manifest.json", "figures/mesh.svg", "figures/mesh.png"];
    let files = files.map(|name| format!("results/polycarbonate-disc/mesh/{name}"));
    answer.wrote(&files.join(" "));
}

#[test]
fn json_is_the_summary_alone_with_its_manifest() {
    let answer = on_disc("mesh", &["--json", "--threads", "1", "--simd", "scalar"]).done();
    let printed = answer.value();
    assert_eq!(printed, answer.json("results/polycarbonate-disc/mesh/summary.json"));
    let manifest = &printed["manifest"];
    assert_eq!(manifest["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(manifest["case_text"], fs::read_to_string(disc()).unwrap());
    assert_eq!(manifest["overrides"][1], "mesh.radial_elements=3");
    assert_eq!((&manifest["threads"], &manifest["simd"]), (&1.into(), &"scalar".into()));
}

#[test]
fn no_run_replaces_the_results_of_another_one_in_silence() {
    let folder = folder();
    for elements in ["3", "4", "5", "3"] {
        let set = format!("mesh.radial_elements={elements}");
        run(&folder, &["mesh", &disc(), "--json"]).set(&[&set, COARSE[0]]).done();
    }
    let results = folder.path().join("results/polycarbonate-disc");
    let elements = |name: &str| {
        let text = fs::read(results.join(name).join("summary.json")).unwrap();
        serde_json::from_slice::<Value>(&text).unwrap()["mesh"]["elements"].as_u64().unwrap()
    };
    // The first has the plain name, the others one that says what they differ in.
    assert_eq!(elements("mesh"), 48);
    let beside = |n: usize| format!("mesh-radial_elements={n},circumferential_elements=16");
    assert_eq!(elements(&beside(4)), 64);
    assert_eq!(elements(&beside(5)), 80);
    assert!(!results.join(beside(3)).exists());
    // Nothing tells the case as it is written from what is there: that is for the user to decide.
    let plain = || Run::of("mesh", disc()).within(&folder);
    plain().refused(&["--set mesh.radial_elements=3", "--force"]);
    plain().args(&["--force"]).done();
    let text = fs::read_to_string(disc()).unwrap().replace("density = 1228.0", "density = 1200.0");
    fs::write(folder.path().join("polycarbonate-disc.toml"), text).unwrap();
    // Another case of the same name, and then that case edited.
    run(&folder, &["mesh", "polycarbonate-disc.toml"]).refused(&["another case"]);
    // What else the results depend on counts as overrides do.
    for friction in ["0.2", "0.3"] {
        run(&folder, &["matrices", &disc(), "--friction", friction]).set(&COARSE).done();
    }
    let own = "matrices-friction=0.3,circumferential_elements=16,radial_elements=3/K.mtx";
    assert!(results.join(own).exists());
    let again = ["matrices", &disc(), "--out", "results/polycarbonate-disc/matrices"];
    run(&folder, &again).set(&COARSE).refused(&["matrices", "--friction 0.2 --set mesh"]);
}

#[test]
fn an_output_folder_that_cannot_be_made_fails_the_run_with_its_path() {
    let folder = folder_with(&[("file", "x".as_bytes())]);
    let onto = |out: &str| on_disc("mesh", &[]).within(&folder).out(out);
    let answer = onto("file/below").end().code(1);
    assert_eq!(answer.stderr.matches("os error").count(), 1, "{}", answer.stderr);
    answer.warns(&["cannot create folder file/below"]);
    onto("file").refused(&["file is a file: --out names a folder"]);
}

#[test]
fn a_folder_that_another_process_writes_is_refused() {
    let folder = folder();
    fs::create_dir(folder.path().join("here")).unwrap();
    let lock = fs::File::create(folder.path().join("here/.lock")).unwrap();
    lock.try_lock().unwrap();
    let mesh = || on_disc("mesh", &[]).within(&folder).out("here").end();
    mesh().code(1).warns(&["being written by another process"]);
    drop(lock);
    mesh().code(0);
}

#[test]
fn warnings_go_to_stderr_and_stay_unless_quiet_is_said_twice() {
    let folder = folder();
    let mesh = |more: &[&str]| {
        let words = ["mesh", &shipped("polycarbonate-610rpm.toml")];
        run(&folder, &words).set(&["transient.duration=0.01"]).args(more).done()
    };
    for more in [&[][..], &["--quiet"]] {
        mesh(more).warns(&["WARN ; output.snapshots: 0.03 s lies after the end"]);
    }
    let silent = mesh(&["-qq"]);
    assert_eq!((silent.stdout.as_str(), silent.stderr.as_str()), ("", ""));
}

#[test]
fn init_writes_cases_that_check_accepts_and_overwrites_nothing() {
    let folder = folder();
    let mut cost = String::new();
    for line in run(&folder, &["init", "--list"]).done().stdout.lines() {
        let mut words = line.split_whitespace();
        let name = words.next().unwrap();
        assert!(words.count() > 1, "no title: {line}");
        let file = format!("{name}.toml");
        // Meshes and tables that the case reads are listed behind it.
        let said = run(&folder, &["init", name]).done().stdout;
        assert!(said.starts_with(&format!("{file}\n")), "{said}");
        let there = || fs::read_dir(folder.path()).unwrap().count();
        let before = there();
        cost += &run(&folder, &["check", &file]).done().says(&[": valid"]).stdout;
        assert_eq!(there(), before, "check wrote something");
        let written = fs::read(folder.path().join(&file)).unwrap();
        fs::write(folder.path().join(&file), "precious").unwrap();
        run(&folder, &["init", name]).refused(&["exists", "--force"]);
        assert_eq!(fs::read_to_string(folder.path().join(&file)).unwrap(), "precious");
        run(&folder, &["init", name, "--force"]).done();
        assert_eq!(fs::read(folder.path().join(&file)).unwrap(), written);
    }
    has(&cost, &["steps ; MiB ; unknowns"]);
}

#[test]
fn init_all_writes_every_shipped_case_with_its_mesh_and_overwrites_nothing() {
    let folder = folder();
    let all = || run(&folder, &["init", "--all"]);
    all().done().says(&["cases/sliding-block.toml"]);
    let names = names_in(shipped("").as_ref());
    assert!(names.iter().filter(|name| name.ends_with(".toml")).count() > 20);
    // Each is the shipped one, which another test checks.
    let files = names.iter().map(String::as_str).filter(|name| name.contains('.'));
    for name in files.chain(["meshes/brake.inp"]) {
        let written = fs::read(folder.path().join("cases").join(name)).unwrap();
        assert_eq!(written, fs::read(shipped(name)).unwrap(), "{name}");
    }
    // What is there as it would be written stays; what is not is not overwritten.
    assert_eq!(all().done().stdout, "");
    fs::write(folder.path().join("cases/basin.toml"), "precious").unwrap();
    all().refused(&["basin.toml exists"]);
}

#[test]
fn every_short_name_is_a_shipped_case_and_stdout_has_the_case_alone() {
    let folder = folder();
    let said = run(&folder, &["init", "--out", "-"]).done().stdout;
    assert_eq!(said, fs::read_to_string(disc()).unwrap());
    let said = run(&folder, &["init", "nothing"]).refused(&["no template"]).stderr;
    let (_, names) = said.split_once("choose one of ").unwrap();
    let names: Vec<&str> = names.trim().split(", ").collect();
    assert!(names.contains(&"two-bodies") && names.contains(&"reference"), "{said}");
    for name in names {
        run(&folder, &["init", name, "--out", "-"]).done();
    }
}

#[test]
fn completions_and_manual_name_every_subcommand_with_files_and_exit_status() {
    let folder = folder();
    let help = run(&folder, &["--help"]).done().stdout;
    assert!(help.lines().all(|line| line.chars().count() <= 100), "{help}");
    let titles = ["Analyse:", "Study:", "Design:", "Measure:", "Inspect:", "Help:"];
    assert!(titles.map(|title| help.find(title).expect(title)).is_sorted(), "{help}");
    let lines = help.lines().skip_while(|line| !line.starts_with("Analyse:"));
    let lines = lines.take_while(|line| !line.starts_with("Options:"));
    let lines = lines.filter(|line| line.starts_with("  "));
    let names: Vec<&str> = lines.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"check"), "{names:?}");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        run(&folder, &["completions", shell]).done().says(&names);
    }
    run(&folder, &["man"]).done().says(&[".TH frictionsim"]);
    run(&folder, &["man", "cea"]).done().says(&[
        ".SH \"FILES\" ; eigenvalues.csv ; .SH \"EXAMPLES\" ; frictionsim cea disc.toml ; \
         .SH \"EXIT STATUS\" ; \\fB130\\fR",
    ]);
    run(&folder, &["man", "--out", "pages"]).done();
    for name in names.iter().filter(|name| **name != "help") {
        let page = folder.path().join(format!("pages/frictionsim-{name}.1"));
        assert!(page.exists(), "{}", page.display());
        assert_eq!(help.matches(&format!("\n  {name} ")).count(), 1, "{name}\n{help}");
        // Every command takes the options of all.
        run(&folder, &[name, "--help"]).done().says(&["--threads ; --simd ; --quiet ; --verbose"]);
        run(&folder, &[name, "--force", "--nonesuch"]).refused(&["argument '--nonesuch'"]);
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let mut program = Run::new(&["completions", "zsh"]).program();
    let mut child = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn options_may_stand_before_the_command() {
    let folder = folder();
    let before = ["-q", "--no-figures", "-o", "here", "--set", COARSE[0], "mesh", &disc()];
    has(&run(&folder, &before).set(&COARSE[1..]).done().words(), &["elements 48"]);
    assert!(folder.path().join("here/summary.json").exists());
}

#[test]
fn a_case_from_standard_input_has_a_folder_of_its_own() {
    let folder = folder();
    run(&folder, &["mesh", "-", "-q"]).set(&COARSE).input(fs::read(disc()).unwrap()).done();
    assert!(folder.path().join("results/stdin/mesh/summary.json").exists());
    // It is drawn again from the folder alone.
    run(&folder, &["plot", "results/stdin/mesh"]).done();
    run(&folder, &["mesh", "-"]).input(b"title = 3".to_vec()).refused(&["standard input:1:"]);
}

#[test]
fn a_dry_run_checks_everything_and_touches_nothing() {
    let folder = folder();
    let dry = |more: &[&str]| on_disc("cea", &[&["--dry-run"], more].concat()).within(&folder);
    let answer = dry(&[]).done().says(&["valid", "results/polycarbonate-disc/cea"]);
    assert_eq!(answer.stderr, "");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    fs::create_dir(folder.path().join("here")).unwrap();
    fs::write(folder.path().join("here/thesis.tex"), "x").unwrap();
    dry(&["--out", "here"]).refused(&["thesis.tex"]);
    let value = dry(&["--json"]).done().value();
    assert_eq!(value["folder"], "results/polycarbonate-disc/cea");
    assert_eq!(value["replaces"], false);
}

/// A table in a folder of results is known by that folder.
#[test]
fn tables_of_one_name_from_two_runs_have_a_folder_each() {
    let folder = folder();
    for (name, frequency) in [("70rpm", 900.0), ("610rpm", 1100.0)] {
        let path = folder.path().join("results").join(name).join("transient");
        fs::create_dir_all(&path).unwrap();
        fs::write(path.join("probe-1.csv"), tones(1e4, 400, &[("v", frequency)])).unwrap();
        let signal = format!("results/{name}/transient/probe-1.csv");
        run(&folder, &["signal", &signal, "--no-figures"]).done();
    }
    for name in ["signal", "signal-610rpm-transient"] {
        let path = folder.path().join("results/probe-1").join(name);
        assert!(path.join("summary.json").exists(), "{name}");
    }
}
