//! What is said of bad meshes, bad names and dangerous files, and that nothing of the user's is replaced.

use crate::cli::run;
use crate::prelude::*;

/// A block of 4 x 4 mm on a plane, clamped at the top.
const CASE: &str = include_str!("refused/block.toml");
const MESH: &str = include_str!("refused/block.msh");

fn block_in(mesh: &str, case: &str) -> TempDir {
    folder_with(&[("block.msh", mesh.as_bytes()), ("block.toml", case.as_bytes())])
}

fn on_block(mesh: &str, case: &str) -> Answer {
    run(&block_in(mesh, case), &["check", "block.toml"]).end()
}

#[test]
fn long_names_and_many_unknown_keys_are_bounded_in_time_and_in_what_is_said() {
    let mesh = MESH.replace("\"block\"", &format!("\"{}\"", "b".repeat(1 << 20)));
    on_block(&mesh, CASE).code(2).warns(&["the name of a physical group has 1048576 bytes"]);
    let keys: String = (0..30_000).map(|i| format!("unknown_key_{i} = 1\n")).collect();
    let start = Instant::now();
    let said = on_block(MESH, &(CASE.to_owned() + &keys)).code(2).warns(&["unknown key"]).stderr;
    assert!(said.len() < 10_000, "{} bytes", said.len());
    // 52 s before; the limit leaves room for a busy machine.
    assert!(start.elapsed().as_secs() < 20);
    let long = format!("{CASE}{} = 1\n", "k".repeat(1 << 20));
    assert!(on_block(MESH, &long).code(2).stderr.len() < 10_000);
}

/// A sine of 1 kHz, 1,000 samples at 20 kHz.
fn tone(channel: &str) -> String {
    tones(20e3, 1000, &[(&format!("\"{channel}\""), 1e3)])
}

#[test]
fn a_measurement_is_never_replaced_by_its_own_sound() {
    let folder = folder_with(&[("tone.csv", tone("a").as_bytes())]);
    let at = |name: &str| folder.path().join(name);
    let signal = |words: &[&str]| run(&folder, &["signal", "--no-figures", "-q"]).args(words);
    signal(&["tone.csv", "--wav", "tone.wav"]).done();
    let sound = fs::read(at("tone.wav")).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = |name| fs::metadata(at(name)).unwrap().permissions().mode();
        assert_eq!(mode("tone.wav"), mode("tone.csv"), "as any file, under the umask");
    }
    // The sound is now the measurement; neither it nor another file goes.
    signal(&["tone.wav", "--wav", "tone.wav", "--force", "-o", "s"])
        .refused(&["is the measurement itself"]);
    fs::write(at("other.wav"), "kept").unwrap();
    for option in ["--wav", "--uff"] {
        signal(&["tone.csv", option, "other.wav", "-o", "t"]).refused(&[option, "the file exists"]);
        assert!(!at("t").exists(), "nothing is done before");
    }
    assert_eq!(fs::read(at("tone.wav")).unwrap(), sound);
    assert_eq!(fs::read(at("other.wav")).unwrap(), b"kept");
    signal(&["tone.csv", "--wav", "other.wav", "--force", "-o", "t"]).done();
    assert_eq!(fs::read(at("other.wav")).unwrap(), sound);
}

#[test]
fn nothing_from_a_file_or_an_option_acts_on_the_terminal() {
    const EVIL: &str = "x\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}y";
    let title = "title = \"x\\u001b]0;owned\\u0007\\u009b31m\\u202ey\"";
    let folder = block_in(MESH, &CASE.replace("title = \"block\"", title));
    fs::write(folder.path().join("tone.csv"), tone(EVIL)).unwrap();
    fs::write(folder.path().join(format!("{EVIL}.toml")), "a = 1").unwrap();
    let file = format!("{EVIL}.toml");
    let key = format!("{EVIL}=1");
    let quoted = format!("\"{EVIL}\"=1");
    let is_mark = |c| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let acts = |c: char| c.is_control() && !['\n', '\t'].contains(&c) || is_mark(c);
    for arguments in [
        &["check", "block.toml"][..],
        &["check", "block.toml", "--json"],
        &["check", &file],
        &["check", "block.toml", "--set", &key],
        &["check", "block.toml", "--set", &quoted],
        &["check", "missing.toml", EVIL],
        &["check", &format!("--{EVIL}")],
        &["mesh", "block.toml", "--no-figures", "-o", EVIL],
        &["signal", "tone.csv", "--no-figures"],
        &["signal", "tone.csv", "--no-figures", "--json", "--force"],
        &["signal", "tone.csv", "--channel", EVIL, "--channel", "none"],
        &["plot", EVIL],
        &["compare", EVIL, EVIL],
        &["init", EVIL],
    ] {
        let answer = run(&folder, arguments).end();
        for text in [&answer.stdout, &answer.stderr] {
            assert!(!text.contains(acts), "{arguments:?}: {text:?}");
        }
    }
    let object = run(&folder, &["check", "block.toml", "--json"]).end().value();
    assert_eq!(object["cases"][0]["title"], EVIL);
}

#[test]
fn results_outlive_a_forced_run_that_fails_and_are_replaced_by_one_that_ends() {
    let folder = block_in(MESH, CASE);
    let listing = || names_in(&folder.path().join("out"));
    let onto = |command: &str, more: &[&str]| {
        Run::of(command, "block.toml").within(&folder).out("out").args(&["-q"]).args(more)
    };
    let first = onto("mesh", &[]).done();
    let (before, bytes) = (listing(), first.bytes("summary.json"));
    // Refused: another command without --force; nothing is left behind.
    onto("cea", &[]).refused(&["--force"]);
    assert_eq!(listing(), before);
    // Fails while it runs: the transient blows up.
    let set = ["transient.duration=1e-3 ; transient.time_step=1e-6 ; output.sample_interval=1e-5"];
    assert!(onto("transient", &["--force"]).set(&set).end().code > Some(0));
    let kept: Vec<String> = listing().into_iter().filter(|name| name != ".replacing").collect();
    assert_eq!(kept, before);
    assert_eq!(first.bytes("summary.json"), bytes);
    // One that ends takes the place of all of it.
    onto("cea", &["--force"]).done().wrote("eigenvalues.csv !.replacing");
}

#[test]
fn an_input_in_the_output_folder_is_not_replaced() {
    let folder = folder();
    let inside = folder.path().join("in");
    fs::create_dir(&inside).unwrap();
    fs::write(inside.join("peaks.csv"), tone("a")).unwrap();
    let signal = Run::of("signal", "in/peaks.csv").within(&folder).out("in").args(&["--force"]);
    assert_eq!(signal.refused(&["which is the input"]).text("peaks.csv"), tone("a"));
    assert_eq!(names_in(&inside), ["peaks.csv"], "no lock is left");
}

#[test]
fn files_of_others_that_look_unfinished_stay() {
    let folder = block_in(MESH, CASE);
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    for name in [".writing-report-of-mine", ".writing-abc"] {
        fs::write(out.join(name), "mine").unwrap();
    }
    for _ in 0..2 {
        Run::of("mesh", "block.toml").within(&folder).out("out").args(&["--force", "-q"]).done();
    }
    assert!(out.join(".writing-report-of-mine").exists() && out.join(".writing-abc").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_size_limit_of_the_shell_is_a_full_disk_and_a_case_without_end_is_refused() {
    let folder = block_in(MESH, CASE);
    let script = "ulimit -f 1; \"$0\" mesh block.toml --no-figures -q -o out";
    shell(&folder, script, &[]).code(1).warns(&["file size limit"]);
    run(&folder, &["check", "/dev/zero"]).refused(&["larger than 16 MiB"]);
}

#[test]
fn a_run_that_was_interrupted_while_it_replaces_others_goes_on_where_it_was() {
    let manifest = |own: &str| Manifest { case_hash: own.to_owned(), ..Manifest::new(own) };
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let open = |command, replace| OutputFolder::open(folder.path(), &manifest(command), replace);
    let old = open("cea", Replace::SameCase).unwrap();
    old.write("table.csv", |out| out.write_all(b"old")).unwrap();
    old.finish().unwrap();
    assert!(open("transient", Replace::SameCase).is_err());
    let begun = open("transient", Replace::Anything).unwrap();
    begun.write("checkpoint.bin", |out| out.write_all(b"state")).unwrap();
    begun.suspend().unwrap();
    assert_eq!(fs::read(at("table.csv")).unwrap(), b"old");
    assert!(OutputFolder::begun(folder.path(), &manifest("transient")).is_some());
    // Killed before its end once more.
    drop(open("transient", Replace::SameCase).unwrap());
    let again = open("transient", Replace::SameCase).unwrap();
    assert_eq!(fs::read(again.path().join("checkpoint.bin")).unwrap(), b"state");
    again.write("energy.csv", |out| out.write_all(b"new")).unwrap();
    again.finish().unwrap();
    let gone = ["table.csv", ".replacing", "checkpoint.bin"];
    assert!(!gone.map(|name| at(name).exists()).contains(&true));
    assert_eq!(fs::read(at("energy.csv")).unwrap(), b"new");
}

#[test]
fn files_of_another_kind_are_named() {
    let folder = folder_with(&[
        ("table.toml", b"frequency_hz,real\n1,2\n3,4\n"),
        ("mesh.toml", MESH.as_bytes()),
        ("comma.toml", b"[contact]\nfriction_coefficient = 0,3\n"),
        ("disc.csv", MESH.as_bytes()),
    ]);
    for (command, name, said) in [
        ("check", "table.toml", "this is a table of values, not a case"),
        ("check", "mesh.toml", "this is a Gmsh mesh"),
        ("check", "comma.toml", "decimal point, not a comma: 0.3"),
        ("signal", "disc.csv", "this is a Gmsh mesh, not a measurement"),
    ] {
        run(&folder, &[command, name]).refused(&[said]);
    }
}
