//! Consistency checks of sweeps as processes: killed, side by side, without room on the disk. Each
//! must leave whole files, and end in the very table of a run that nothing happened to.
#![cfg(unix)]

use crate::prelude::*;
use crate::sweep::table;

/// A coarse disc: thirty transients of some five milliseconds each.
const STUDY: &str = include_str!("../cases/sweep-of-short-runs.toml");

struct Study {
    root: TempDir,
}

impl Study {
    fn new() -> Self {
        Self { root: folder_with(&[("study.toml", coarse_disc(STUDY).as_bytes())]) }
    }

    fn folder(&self, name: &str) -> PathBuf {
        self.root.path().join(name)
    }

    fn sweep(&self, folder: &str, options: &[&str]) -> Run {
        let run = Run::of("sweep", "study.toml").args(&["--quiet", "--threads", "2"]);
        run.args(options).within(&self.root).out(folder)
    }

    /// Holds a folder to the table and the points of a sweep that nothing happened to.
    #[track_caller]
    fn is_whole(&self, folder: &str) {
        let (_, expected, expected_points) = &*WHOLE;
        assert!(table(&self.folder(folder)) == *expected, "{folder}");
        assert!(points(&self.folder(folder)) == *expected_points, "{folder}");
    }
}

/// The finished points by file name, byte for byte.
fn points(folder: &Path) -> BTreeMap<String, String> {
    let folder = folder.join("points");
    let names = if folder.exists() { names_in(&folder) } else { Vec::new() };
    let names = names.into_iter().filter(|name| name.starts_with("point-"));
    names.map(|name| (name.clone(), fs::read_to_string(folder.join(name)).unwrap())).collect()
}

/// Time, table and points of a sweep that nothing happens to, run once.
static WHOLE: LazyLock<(Duration, String, BTreeMap<String, String>)> = LazyLock::new(|| {
    let (study, clock) = (Study::new(), Instant::now());
    study.sweep("whole", &[]).done();
    let folder = study.folder("whole");
    (clock.elapsed(), table(&folder), points(&folder))
});

#[test]
fn killed_sweeps_resume_to_identical_results() {
    let study = Study::new();
    let (whole_time, expected, expected_points) = &*WHOLE;
    assert_eq!(expected_points.len(), 30);
    assert!(!expected.contains("failed"));
    let (mut draw, mut kills, mut round) = (crate::draws::draws(2), 0, 0);
    while kills < sized(4, 40) {
        let name = format!("killed-{round}");
        let folder = study.folder(&name);
        let mut finished = 0;
        loop {
            let mut child = study.sweep(&name, &["--resume"]).program();
            let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            std::thread::sleep(whole_time.mul_f64(0.6 * draw()));
            if let Some(status) = child.try_wait().unwrap() {
                assert!(status.success());
                break;
            }
            child.kill().unwrap();
            child.wait().unwrap();
            kills += 1;
            let left = points(&folder);
            assert!(left.len() >= finished, "a finished point was lost");
            finished = left.len();
        }
        study.is_whole(&name);
        round += 1;
    }
}

#[test]
fn processes_side_by_side_share_the_points_of_one_folder() {
    let study = Study::new();
    let ran =
        || study.sweep("shared", &["--resume", "--json"]).done().value()["ran"].as_u64().unwrap();
    let all: u64 = std::thread::scope(|scope| {
        [(); 3].map(|()| scope.spawn(ran)).map(|process| process.join().unwrap()).iter().sum()
    });
    assert_eq!((all, ran()), (30, 0), "each point once");
    study.is_whole("shared");
}

#[test]
fn shards_collect_to_the_table_of_the_whole_sweep() {
    let study = Study::new();
    study.sweep("shards", &["--shard", "2/3"]).done();
    let collect = || Run::new(&["collect", "shards"]).within(&study.root).end();
    study.sweep("shards", &["--shard", "1/3"]).done();
    collect().code(1).says(&["missing: 3, 6, 9, 12, 15, 18, 21, 24, 27, 30"]);
    assert_eq!(table(&study.folder("shards")).lines().count(), 21);
    study.sweep("shards", &["--shard", "3/3"]).done();
    collect().code(0);
    study.is_whole("shards");
}

#[test]
fn a_full_disk_is_named_and_leaves_earlier_points_whole() {
    let study = Study::new();
    study.sweep("full", &["--shard", "1/2"]).done();
    let before = points(&study.folder("full"));
    // No file above 512 bytes, which no point fits into; its signal is ignored, so that writing fails as on a full disk.
    let script = "trap '' XFSZ; ulimit -f 1; exec \"$0\" \"$@\"";
    let words = ["sweep", "study.toml", "--quiet", "--out", "full", "--shard", "2/2"];
    shell(&study.root, script, &words).code(1).warns(&["no room left", "point-"]);
    assert_eq!(points(&study.folder("full")), before);
    study.sweep("full", &["--resume"]).done();
    study.is_whole("full");
}

#[test]
fn a_folder_that_is_not_there_to_go_on_with_is_named_once() {
    let study = Study::new();
    let set = ["sweep={ \"contact.friction_coefficient\" = [0.3] }", "cea={ modes = 1 }"];
    for command in ["sweep", "cea", "transient"] {
        let run = || Run::of(command, "study.toml").within(&study.root).set(&set).out(command);
        let said = run().args(&["--resume"]).done().stderr;
        let note = format!("{command} does not exist: starting from the beginning");
        assert_eq!(said.matches(&note).count(), 1, "{said}");
        assert!(said.matches("from the beginning").count() == 1, "{said}");
    }
}

#[test]
fn a_failed_point_ends_in_exit_code_1_after_all_others_are_done() {
    let study = Study::new();
    let set = "sweep.\"transient.time_step\"=[\"auto\", 3.9e-6]";
    let summary = study.sweep("failing", &["--json"]).set(&[set]).end().code(1).value();
    assert_eq!(summary["finished"], 60);
    let failed = summary["failed"].as_array().unwrap();
    assert_eq!(failed.len(), 30, "{failed:?}");
    assert!(failed.iter().all(|point| point["swept"]["transient.time_step"] == 3.9e-6));
    assert_eq!(table(&study.folder("failing")).lines().count(), 61);
}

/// Without a sweep: one run after the other, each printing its summary.
#[test]
fn a_shell_loop_over_transients_gives_what_the_sweep_gives() {
    let study = Study::new();
    let script = "for mu in 0.2 0.3; do \
         \"$0\" transient study.toml --set contact.friction_coefficient=$mu --json --quiet --no-figures \
         || exit; done";
    let printed = shell(&study.root, script, &[]).code(0).stdout;
    let summaries = serde_json::Deserializer::from_str(&printed).into_iter::<Value>();
    let looped: Vec<Value> = summaries.map(Result::unwrap).collect();
    let set = "sweep={ \"contact.friction_coefficient\" = [0.2, 0.3] }";
    study.sweep("swept", &["--set", set]).done();
    let swept = points(&study.folder("swept"));
    assert_eq!((looped.len(), swept.len()), (2, 2));
    for (one, text) in looped.iter().zip(swept.values()) {
        let point: Value = serde_json::from_str(text).unwrap();
        let other = &point["summaries"]["transient"];
        for key in ["steps", "main_frequency_hz", "status", "power_w", "harmonics", "growth"] {
            assert_eq!(one[key], other[key], "{key}");
        }
    }
}

#[test]
fn a_terminated_sweep_says_how_to_go_on() {
    let study = Study::new();
    let folder = study.folder("stopped");
    let ended = study.sweep("stopped", &[]).stopped(Some("TERM"), || !points(&folder).is_empty());
    ended.code(130).warns(&["--resume"]);
}

/// Runs `cea` of a body without symmetry into a folder.
fn cea(folder: &Path, options: &[&str]) -> Run {
    Run::of("cea", shipped("sliding-block.toml")).args(&["--quiet"]).out(folder).args(options)
}

fn steps(folder: &Path) -> usize {
    let entries = fs::read_dir(folder.join("progress")).into_iter().flatten().flatten();
    entries.filter(|own| own.path().extension().is_some_and(|end| end == "bin")).count()
}

#[test]
fn an_eigenvalue_sweep_stopped_twice_resumes_to_identical_tables() {
    let root = folder_with(&[]);
    let (stopped, whole) = (root.path().join("stopped"), root.path().join("whole"));
    for (options, wanted) in [(&[][..], 2), (&["--resume"], 4)] {
        // On a busy machine the first run may have come further than it was let.
        let wanted = wanted.max(steps(&stopped) + 1);
        let ended = cea(&stopped, options).stopped(Some("TERM"), || steps(&stopped) >= wanted);
        ended.code(130).warns(&["--resume"]);
    }
    for (folder, options) in [(&stopped, &["--resume"][..]), (&whole, &[])] {
        cea(folder, options).done();
        assert!(!folder.join("progress").exists());
    }
    for table in ["eigenvalues.csv", "stability.csv"] {
        let [one, other] = [&stopped, &whole].map(|f| fs::read(f.join(table)).unwrap());
        assert!(one == other, "{table}");
    }
}
