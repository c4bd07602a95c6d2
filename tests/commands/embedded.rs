//! Commands inside another program: side by side, interrupted, panicking.

use crate::prelude::*;
use frictionsim::app::embedded::EmbeddedRun;
use std::ffi::OsString;

fn words(command: &str, case: &str, folder: &TempDir, name: &str, set: &[&str]) -> Vec<OsString> {
    let out = folder.path().join(name).display().to_string();
    let coarse = ["mesh.circumferential_elements=16", "mesh.radial_elements=3"];
    let head = [command, &shipped(case), "--out", &out, "-qq", "--no-figures"];
    let set = coarse.iter().chain(set).flat_map(|change| ["--set", *change]);
    head.into_iter().chain(set).map(OsString::from).collect()
}

fn run(words: Vec<OsString>) -> Result<(), Failure> {
    EmbeddedRun::default().run(words, 1)
}

/// Stops a command after a while, which must end soon and say how it goes on.
fn stopped_after(milliseconds: u64, words: Vec<OsString>, said: &str) {
    let start = Instant::now();
    let is_due = |_: &EmbeddedRun| start.elapsed() >= Duration::from_millis(milliseconds);
    let (failure, time) = stopped(words, is_due);
    // The whole analysis takes over a minute: it ended early, not at its end, on a loaded machine too.
    assert!(time < Duration::from_secs(30));
    assert!(interruption(&failure).contains(said), "{failure:?}");
}

/// Runs a command on a thread, stops it once that is due, and gives its failure and how long it took to stop.
fn stopped(words: Vec<OsString>, is_due: impl Fn(&EmbeddedRun) -> bool) -> (Failure, Duration) {
    let run = EmbeddedRun::default();
    let own = run.clone();
    let thread = std::thread::spawn(move || own.run(words, 2));
    while !is_due(&run) && !thread.is_finished() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let asked = Instant::now();
    run.stop();
    let outcome = thread.join().unwrap();
    (outcome.unwrap_err(), asked.elapsed())
}

fn interruption(failure: &Failure) -> &str {
    match failure {
        Failure::Interrupted(text) => text,
        other => panic!("{other:?}"),
    }
}

const RUN: [&str; 3] =
    ["output.probes=[1]", "output.sample_interval=1e-5", "contact.friction_coefficient=0.3"];

fn transient(folder: &TempDir, name: &str, duration: &str) -> Vec<OsString> {
    let set = [&RUN[..], &[duration]].concat();
    words("transient", "polycarbonate-610rpm.toml", folder, name, &set)
}

#[test]
fn a_transient_that_is_stopped_keeps_what_it_has_and_resumes_to_the_same_bytes() {
    let folder = folder();
    let counts = |run: &EmbeddedRun| run.progress().is_some_and(|progress| progress.done > 0);
    let (failure, time) = stopped(transient(&folder, "run", "transient.duration=10.0"), counts);
    assert!(interruption(&failure).contains("--resume"), "{failure:?}");
    assert!(time < Duration::from_secs(15), "{time:?}");
    let table = fs::read_to_string(folder.path().join("run/energy.csv")).unwrap();
    let reached: f64 = table.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
    // A little further than it came, in one run and in two.
    let duration = format!("transient.duration={:.3}", reached + 0.002);
    let mut again = transient(&folder, "run", &duration);
    again.push("--resume".into());
    run(again).unwrap();
    run(transient(&folder, "whole", &duration)).unwrap();
    for name in ["energy.csv", "contact.csv", "probe-1.csv", "harmonics.csv"] {
        let [one, two] = ["run", "whole"].map(|run| fs::read(folder.path().join(run).join(name)));
        assert_eq!(one.unwrap(), two.unwrap(), "{name}");
    }
}

#[test]
fn a_sweep_that_is_stopped_keeps_its_finished_points() {
    let folder = folder();
    let swept = "sweep={\"contact.rotation_speed_rpm\"=[600.0, 605.0, 610.0, 620.0]}";
    let set = [&RUN[..], &["transient.duration=0.5", swept]].concat();
    let study = words("sweep", "polycarbonate-610rpm.toml", &folder, "study", &set);
    stopped_after(300, study, "--resume");
    // An interrupted point is no failed point.
    let points = folder.path().join("study/points");
    for name in names_in(&points) {
        has(&fs::read_to_string(points.join(name)).unwrap_or_default(), &["!panic"]);
    }
}

#[test]
fn an_eigenvalue_analysis_is_stopped_between_factorizations() {
    let folder = folder();
    let set = ["cea.method=sparse", "mesh.radial_elements=35", "mesh.circumferential_elements=180"];
    let case = words("cea", "polycarbonate-disc.toml", &folder, "cea", &set);
    stopped_after(500, case, "--resume goes on");
}

#[test]
fn a_panic_is_caught_and_the_next_run_goes_on() {
    let run = EmbeddedRun::default();
    let failure = run.enclose(1, || -> Result<(), Failure> {
        rayon::join(|| (), || panic!("of the test"));
        Ok(())
    });
    let error = failure.unwrap_err();
    assert!(matches!(&error, Failure::Panic(text) if text == "of the test"), "{error:?}");
    assert_eq!(run.enclose(1, || Ok(7)).unwrap(), 7);
}

#[test]
fn bad_words_and_bad_cases_are_failures_as_on_the_command_line() {
    let folder = folder();
    let unknown = run(vec!["cea".into(), "--colour".into()]).unwrap_err();
    assert!(matches!(&unknown, Failure::Usage(_)), "{unknown:?}");
    assert!(unknown.messages()[0].contains("--colour"));
    let set = ["contact.friction_coefficient=-1"];
    let bad = run(words("cea", "polycarbonate-disc.toml", &folder, "x", &set)).unwrap_err();
    assert!(matches!(&bad, Failure::Case(_)), "{bad:?}");
}

#[test]
fn warnings_are_kept_for_the_caller_and_each_run_has_its_own() {
    let folder = folder();
    let (loud, calm) = (EmbeddedRun::default(), EmbeddedRun::default());
    let set = |thickness: &'static str| ["cea.friction_coefficients=[0.3]", thickness];
    let case = "polycarbonate-disc.toml";
    for (run, name, thickness) in
        [(&loud, "thick", "geometry.thickness=9.0"), (&calm, "usual", "geometry.thickness=0.009")]
    {
        run.run(words("cea", case, &folder, name, &set(thickness)), 1).unwrap();
    }
    has(&loud.take_log(), &["WARN ; thickness"]);
    assert_eq!(calm.take_log(), "");
}
