//! What `check` says of time and memory beside what the command takes, one thread.
//!
//! `cargo bench check` runs whole commands and prints a table; without `--bench` the first two. Time is that of the
//! processor, memory the largest resident size, both as Linux tells them.

use crate::is_measured;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// A command on a shipped case with some keys of its own.
type Job = (&'static str, &'static str, &'static [&'static str]);

const JOBS: [Job; 14] = [
    ("cea", "polycarbonate-disc", &[]),
    ("transient", "polycarbonate-610rpm", &["transient.duration=0.005"]),
    ("cea", "polycarbonate-disc", &["cea.method=sparse"]),
    ("cea", "disc-off-centre", &[]),
    ("cea", "test-bench", &[]),
    ("cea", "pad-on-disc", &[]),
    ("cea", "disc-three-dimensions", &[]),
    ("cea", "brake", &[]),
    ("cea", "ventilated-disc", &[]),
    ("transient", "pad-on-disc", &["transient.duration=0.01"]),
    ("transient", "test-bench", &["transient.duration=0.005"]),
    ("cycle", "limit-cycle", &[]),
    ("cycle", "disc-off-centre", &["cycle.confirmation_periods=200"]),
    ("frf", "hammer-test", &[]),
];

pub fn run() {
    let jobs = if is_measured() { &JOBS[..] } else { &JOBS[..2] };
    println!(
        "{:<10} {:<24} {:>9} {:>9} {:>6} {:>9} {:>9} {:>6}",
        "command", "case", "said s", "took s", "ratio", "said MiB", "took MiB", "ratio"
    );
    for job in jobs {
        let (said, took) = (said(job), took(job));
        println!(
            "{:<10} {:<24} {:>9.2} {:>9.2} {:>6.2} {:>9.0} {:>9.0} {:>6.2}",
            job.0,
            job.1,
            said.seconds,
            took.seconds,
            said.seconds / took.seconds,
            said.mebibytes,
            took.mebibytes,
            said.mebibytes / took.mebibytes
        );
    }
}

struct Cost {
    seconds: f64,
    mebibytes: f64,
}

fn program(command: &str, (_, case, set): &Job) -> Command {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut program = Command::new(env!("CARGO_BIN_EXE_frictionsim"));
    program.arg(command);
    program.arg(root.join("cases").join(format!("{case}.toml")));
    set.iter().for_each(|set| {
        program.args(["--set", set]);
    });
    program
}

fn said(job: &Job) -> Cost {
    let output = program("check", job).arg("--json").output().unwrap();
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let cost = &answer["cases"][0][job.0];
    let number = |key: &str| cost[key].as_f64().unwrap_or(f64::NAN);
    Cost { seconds: number("estimated_s"), mebibytes: number("memory_bytes") / f64::from(1 << 20) }
}

fn took(job: &Job) -> Cost {
    let folder = tempfile::tempdir().unwrap();
    let before = children_seconds();
    let mut child = program(job.0, job)
        .args(["--no-figures", "-q", "-q", "--out"])
        .arg(folder.path().join("out"))
        .env("RAYON_NUM_THREADS", "1")
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0.0_f64;
    let end = loop {
        peak = peak.max(peak_mebibytes(&status).unwrap_or(0.0));
        if let Some(end) = child.try_wait().unwrap() {
            break end;
        }
        sleep(Duration::from_millis(5));
    };
    assert!(end.success(), "{} {}", job.0, job.1);
    Cost { seconds: children_seconds() - before, mebibytes: peak }
}

/// Processor time of the children that have ended, s: fields 16 and 17 of `/proc/self/stat`, in hundredths.
fn children_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    // The name of the program, in parentheses, may hold blanks.
    let (_, fields) = stat.rsplit_once(')').unwrap();
    let fields: Vec<&str> = fields.split_whitespace().collect();
    let ticks = |at: usize| fields[at].parse::<f64>().unwrap();
    (ticks(13) + ticks(14)) / 100.0
}

fn peak_mebibytes(status: &str) -> Option<f64> {
    let text = std::fs::read_to_string(status).ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes / 1024.0)
}
