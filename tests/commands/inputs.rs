//! What is said of bad meshes, bad names and dangerous files, and that nothing of the user's is replaced.

use assert_cmd::Command;
use predicates::prelude::*;
use predicates::str::contains;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A block of 4 x 4 mm on a plane, its mesh cut along the middle from `crack` on, clamped at the top.
struct Block {
    points: Vec<[f64; 2]>,
    quads: Vec<[usize; 4]>,
    edges: Vec<(usize, [usize; 2])>,
}

/// Elements along a side.
const SIDE: usize = 4;

impl Block {
    /// Columns `crack..=SIDE` of the middle row of nodes are doubled.
    fn new(crack: usize) -> Self {
        let node = |i: usize, j: usize| 1 + i + j * (SIDE + 1);
        let mut points: Vec<[f64; 2]> = (0..=SIDE)
            .flat_map(|j| (0..=SIDE).map(move |i| [1e-3 * i as f64, 1e-3 * j as f64]))
            .collect();
        let middle = SIDE / 2;
        let mut upper: Vec<usize> = (0..=SIDE).map(|i| node(i, middle)).collect();
        for i in crack..=SIDE {
            points.push(points[node(i, middle) - 1]);
            upper[i] = points.len();
        }
        let corner = |i: usize, j: usize, is_above: bool| match j == middle && is_above {
            true => upper[i],
            false => node(i, j),
        };
        let mut quads = Vec::new();
        for j in 0..SIDE {
            let above = j >= middle;
            for i in 0..SIDE {
                let (low, high) = (j, j + 1);
                quads.push([
                    corner(i, low, above),
                    corner(i + 1, low, above),
                    corner(i + 1, high, above),
                    corner(i, high, above),
                ]);
            }
        }
        let edges = (0..SIDE).flat_map(|i| {
            let top = [node(i + 1, SIDE), node(i, SIDE)];
            [(1, [node(i, 0), node(i + 1, 0)]), (2, top)]
        });
        Self { edges: edges.collect(), points, quads }
    }

    fn text(&self, region: &str) -> String {
        let mut out = format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"contact\"\n1 2 \"top\"\n2 3 \"{region}\"\n\
             $EndPhysicalNames\n$Nodes\n{}\n",
            self.points.len()
        );
        for (i, [x, y]) in self.points.iter().enumerate() {
            writeln!(out, "{} {x} {y} 0", i + 1).unwrap();
        }
        let count = self.edges.len() + self.quads.len();
        writeln!(out, "$EndNodes\n$Elements\n{count}").unwrap();
        for (i, (tag, [p, q])) in self.edges.iter().enumerate() {
            writeln!(out, "{} 1 2 {tag} {tag} {p} {q}", i + 1).unwrap();
        }
        for (i, [a, b, c, d]) in self.quads.iter().enumerate() {
            writeln!(out, "{} 3 2 3 3 {a} {b} {c} {d}", i + 1 + self.edges.len()).unwrap();
        }
        out + "$EndElements\n"
    }
}

const CASE: &str = r#"title = "block"
[mesh]
file = "block.msh"
[material]
young_modulus = 2.1e11
poisson_ratio = 0.3
density = 7800.0
[boundaries.top]
condition = "clamped"
[contact]
boundary = "contact"
counterface = "plane"
direction = [1.0, 0.0]
speed = 1.0
friction_coefficient = 0.3
interference = 1e-6
[cea]
modes = 2
"#;

/// A folder with `block.msh` and `block.toml`.
fn folder(mesh: &str, case: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("block.msh"), mesh).unwrap();
    fs::write(folder.path().join("block.toml"), case).unwrap();
    folder
}

fn frictionsim(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    command.current_dir(folder.path()).args(arguments);
    command
}

fn check(folder: &TempDir) -> assert_cmd::assert::Assert {
    frictionsim(folder, &["check", "block.toml"]).assert()
}

#[test]
fn nodes_that_coincide_without_being_joined_are_counted_and_located() {
    let whole = folder(&Block::new(SIDE + 1).text("block"), CASE);
    check(&whole).code(0).stdout(contains("another one lies").not());
    // Columns 1 to 4 are doubled; 4 edges on either side of the crack are free, and 4 + 4 of the two vertical sides.
    let cracked = folder(&Block::new(1).text("block"), CASE);
    check(&cracked)
        .code(0)
        .stdout(contains("4 nodes lie where another one lies"))
        .stdout(contains("12 and 26 at (0.001000, 0.002000) m"))
        .stdout(contains("16 free edges are in no physical curve"));
}

#[test]
fn bodies_that_part_are_told_from_those_that_were_not_merged() {
    let parted = folder(&Block::new(0).text("block"), CASE);
    check(&parted)
        .code(2)
        .stderr(contains("a part of the body that touches no other"))
        .stderr(contains("5 nodes lie where another one lies"))
        .stderr(contains("merge the parts"));
}

#[test]
fn elements_given_twice_are_refused_with_their_numbers_and_place() {
    let mut block = Block::new(SIDE + 1);
    let again = block.quads[5];
    // The same element from another corner on.
    block.quads.push([again[2], again[3], again[0], again[1]]);
    check(&folder(&block.text("block"), CASE))
        .code(2)
        .stderr(contains("1 element is given twice (elements 14 and 25 at"));
}

#[test]
fn an_element_with_a_small_jacobian_is_said_with_its_place() {
    let mut block = Block::new(SIDE + 1);
    // The inner node of the lower left element, all but on its diagonal.
    block.points[6] = [0.51e-3, 0.51e-3];
    check(&folder(&block.text("block"), CASE))
        .code(0)
        .stdout(contains("that of nodes 1, 2, 7, 6 at (0.000"));
}

#[test]
fn a_plane_that_slides_into_the_face_or_away_from_it_is_refused_at_its_direction() {
    let mesh = Block::new(SIDE + 1).text("block");
    for direction in ["[0.0, 1.0]", "[0.0, -1.0]", "[1.0, 0.5]", "[-1.0, 0.0]"] {
        let case = CASE.replace("direction = [1.0, 0.0]", &format!("direction = {direction}"));
        check(&folder(&mesh, &case))
            .code(2)
            .stderr(contains(format!("direction = {direction}")))
            .stderr(contains("must lie along the face"));
    }
    let slightly = CASE.replace("direction = [1.0, 0.0]", "direction = [1.0, 0.01]");
    check(&folder(&mesh, &slightly)).code(0);
}

#[test]
fn errors_of_names_stand_at_the_key_that_is_wrong() {
    let mesh = Block::new(SIDE + 1).text("block");
    let round = "counterface = \"cylinder\"\nrotation_speed_rpm = 60.0\ncenter = [0.0, -0.1]\n";
    for (from, to, line, said) in [
        (
            "boundary = \"contact\"",
            "boundary = \"contct\"",
            "boundary = \"contct\"",
            "did you mean \"contact\"?",
        ),
        ("[boundaries.top]", "[boundaries.tpo]", "[boundaries.tpo]", "did you mean \"top\"?"),
        (
            "counterface = \"plane\"",
            "counterface = \"body\"\ncounter_boundary = \"tops\"",
            "counter_boundary = \"tops\"",
            "did you mean \"top\"?",
        ),
        (
            "[boundaries.top]",
            "[materials.blok]\nyoung_modulus = 1e9\npoisson_ratio = 0.3\ndensity = 1000.0\n[boundaries.top]",
            "[materials.blok]",
            "did you mean \"block\"?",
        ),
        (
            "counterface = \"plane\"\ndirection = [1.0, 0.0]\nspeed = 1.0\n",
            round,
            "center = [0.0, -0.1]",
            "is not a circle",
        ),
    ] {
        let text = CASE.replace(from, to);
        let number = 1 + text.lines().position(|found| found == line).unwrap();
        check(&folder(&mesh, &text))
            .code(2)
            .stderr(contains(format!("block.toml:{number}:")))
            .stderr(contains(line))
            .stderr(contains(said));
    }
}

#[test]
fn a_mesh_in_millimetres_is_told_by_its_scale_and_one_beyond_all_lengths_refused() {
    let mesh = Block::new(SIDE + 1).text("block");
    let wide = CASE.replace("file = \"block.msh\"", "file = \"block.msh\"\nscale = 1e4");
    check(&folder(&mesh, &wide))
        .code(0)
        .stdout(contains("the mesh is 40.0000 m wide"))
        .stdout(contains("mesh.scale"))
        .stdout(contains("geometry.inner_radius").not());
    let far = mesh.replace("\n25 0.004 0.004 0\n", "\n25 1e300 0.004 0\n");
    assert_ne!(far, mesh);
    check(&folder(&far, CASE)).code(2).stderr(contains("node 25 lies at [1e300"));
}

#[test]
fn meshes_of_other_programs_are_told_by_their_content_whatever_their_name() {
    for (text, said) in [
        ("*Heading\n test\n*Node\n1, 0., 0.\n", "no solid or plane elements (*ELEMENT"),
        ("$ comment\nBEGIN BULK\nGRID,1,,0.,0.,0.\n", "no solid elements (CTETRA"),
        ("    -1\n  2411\n", "it is truncated (-1 expected)"),
        ("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n", "meshio leaves such files"),
    ] {
        check(&folder(text, CASE)).code(2).stderr(contains(said));
    }
}

#[test]
fn long_names_and_many_unknown_keys_are_bounded_in_time_and_in_what_is_said() {
    let mesh = Block::new(SIDE + 1).text(&"b".repeat(1 << 20));
    check(&folder(&mesh, CASE))
        .code(2)
        .stderr(contains("the name of a physical group has 1048576 bytes"));

    let mesh = Block::new(SIDE + 1).text("block");
    let mut case = CASE.to_owned();
    for i in 0..30_000 {
        writeln!(case, "unknown_key_{i} = 1").unwrap();
    }
    let start = std::time::Instant::now();
    let assert = check(&folder(&mesh, &case)).code(2);
    let said = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(said.len() < 10_000, "{} bytes", said.len());
    assert!(said.contains("unknown key"), "{said}");
    // 52 s before; the limit leaves room for a busy machine.
    assert!(start.elapsed().as_secs() < 20);

    let long = format!("{CASE}{} = 1\n", "k".repeat(1 << 20));
    let assert = check(&folder(&mesh, &long)).code(2);
    assert!(assert.get_output().stderr.len() < 10_000);
}

/// A sine of 1 kHz, 1,000 samples at 20 kHz.
fn tone(channel: &str) -> String {
    let mut text = format!("time_s,\"{channel}\"\n");
    for i in 0..1000 {
        let time = f64::from(i) / 20e3;
        writeln!(text, "{time},{}", (std::f64::consts::TAU * 1e3 * time).sin()).unwrap();
    }
    text
}

#[test]
fn a_measurement_is_never_replaced_by_its_own_sound() {
    let folder = folder("", "");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("tone.csv"), tone("a")).unwrap();
    let run = |arguments: &[&str]| {
        let mut all = vec!["signal", "--no-figures", "-q"];
        all.extend(arguments);
        frictionsim(&folder, &all).assert()
    };
    run(&["tone.csv", "--wav", "tone.wav"]).code(0);
    let sound = fs::read(at("tone.wav")).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = |name| fs::metadata(at(name)).unwrap().permissions().mode();
        assert_eq!(mode("tone.wav"), mode("tone.csv"), "as any file, under the umask");
    }
    // The sound is now the measurement; neither it nor another file goes.
    let refused = run(&["tone.wav", "--wav", "tone.wav", "--force", "-o", "s"]);
    refused.code(2).stderr(contains("is the measurement itself"));
    fs::write(at("other.wav"), "kept").unwrap();
    for option in ["--wav", "--uff"] {
        let refused = run(&["tone.csv", option, "other.wav", "-o", "t"]);
        refused.code(2).stderr(contains(option)).stderr(contains("the file exists"));
        assert!(!at("t").exists(), "nothing is done before");
    }
    assert_eq!(fs::read(at("tone.wav")).unwrap(), sound);
    assert_eq!(fs::read(at("other.wav")).unwrap(), b"kept");
    run(&["tone.csv", "--wav", "other.wav", "--force", "-o", "t"]).code(0);
    assert_eq!(fs::read(at("other.wav")).unwrap(), sound);
}

/// Whether a terminal would act on some character of a text.
fn acts(text: &str) -> bool {
    let is_mark = |c| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    text.chars().any(|c| (c.is_control() && c != '\n' && c != '\t') || is_mark(c))
}

#[test]
fn nothing_from_a_file_or_an_option_acts_on_the_terminal() {
    const EVIL: &str = "x\u{1b}]0;owned\u{7}\u{9b}31m\u{202e}y";
    let title = "title = \"x\\u001b]0;owned\\u0007\\u009b31m\\u202ey\"";
    let mesh = Block::new(SIDE + 1).text("block");
    let folder = folder(&mesh, &CASE.replace("title = \"block\"", title));
    fs::write(folder.path().join("tone.csv"), tone(EVIL)).unwrap();
    fs::write(folder.path().join(format!("{EVIL}.toml")), "a = 1").unwrap();
    let file = format!("{EVIL}.toml");
    let key = format!("{EVIL}=1");
    let quoted = format!("\"{EVIL}\"=1");
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
        let output = frictionsim(&folder, arguments).output().unwrap();
        for text in [&output.stdout, &output.stderr] {
            let text = String::from_utf8_lossy(text);
            assert!(!acts(&text), "{arguments:?}: {text:?}");
        }
    }
    let json = frictionsim(&folder, &["check", "block.toml", "--json"]).output().unwrap();
    let object: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(object["cases"][0]["title"], EVIL);
}

#[test]
fn results_outlive_a_forced_run_that_fails_and_are_replaced_by_one_that_ends() {
    let mesh = Block::new(SIDE + 1).text("block");
    let folder = folder(&mesh, CASE);
    let listing = || {
        let entries = fs::read_dir(folder.path().join("out")).unwrap();
        let mut names: Vec<_> =
            entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    let out = ["--no-figures", "-q", "-o", "out"];
    let run = |arguments: &[&str]| frictionsim(&folder, &[arguments, &out].concat()).assert();
    run(&["mesh", "block.toml"]).code(0);
    let before = listing();
    let bytes = fs::read(folder.path().join("out/summary.json")).unwrap();

    // Refused: another command without --force; nothing is left behind.
    run(&["cea", "block.toml"]).code(2).stderr(contains("--force"));
    assert_eq!(listing(), before);
    // Fails while it runs: the transient blows up.
    let blows_up = [
        "transient",
        "block.toml",
        "--force",
        "--set",
        "transient.duration=1e-3",
        "--set",
        "transient.time_step=1e-6",
        "--set",
        "output.sample_interval=1e-5",
    ];
    run(&blows_up).code(predicates::ord::gt(0));
    let kept: Vec<String> = listing().into_iter().filter(|name| name != ".replacing").collect();
    assert_eq!(kept, before);
    assert_eq!(fs::read(folder.path().join("out/summary.json")).unwrap(), bytes);
    // One that ends takes the place of all of it.
    run(&["cea", "block.toml", "--force"]).code(0);
    let after = listing();
    assert!(after.contains(&"eigenvalues.csv".to_owned()), "{after:?}");
    assert!(!after.contains(&".replacing".to_owned()), "{after:?}");
}

#[test]
fn an_input_in_the_output_folder_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("in");
    fs::create_dir(&inside).unwrap();
    fs::write(inside.join("peaks.csv"), tone("a")).unwrap();
    let arguments = ["signal", "in/peaks.csv", "-o", "in", "--force", "--no-figures"];
    frictionsim(&folder, &arguments).assert().code(2).stderr(contains("which is the input"));
    assert_eq!(fs::read_to_string(inside.join("peaks.csv")).unwrap(), tone("a"));
    assert_eq!(fs::read_dir(&inside).unwrap().count(), 1, "no lock is left");
}

#[test]
fn files_of_others_that_look_unfinished_stay() {
    let folder = folder(&Block::new(SIDE + 1).text("block"), CASE);
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    for name in [".writing-report-of-mine", ".writing-abc"] {
        fs::write(out.join(name), "mine").unwrap();
    }
    let arguments = ["mesh", "block.toml", "-o", "out", "--force", "--no-figures", "-q"];
    frictionsim(&folder, &arguments).assert().code(0);
    frictionsim(&folder, &arguments).assert().code(0);
    assert!(out.join(".writing-report-of-mine").exists() && out.join(".writing-abc").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_size_limit_of_the_shell_is_a_full_disk() {
    let folder = folder(&Block::new(SIDE + 1).text("block"), CASE);
    let program = assert_cmd::cargo::cargo_bin("frictionsim");
    let line = format!("ulimit -f 1; {} mesh block.toml --no-figures -q -o out", program.display());
    Command::new("sh")
        .current_dir(folder.path())
        .args(["-c", &line])
        .assert()
        .code(1)
        .stderr(contains("file size limit"));
}

#[cfg(unix)]
#[test]
fn a_case_without_end_is_refused_at_the_limit() {
    let folder = tempfile::tempdir().unwrap();
    frictionsim(&folder, &["check", "/dev/zero"])
        .assert()
        .code(2)
        .stderr(contains("larger than 16 MiB"));
}

/// A MATLAB file of one compressed variable: `count` bytes that are all zero.
fn bomb(count: u32) -> Vec<u8> {
    let mut plain = Vec::new();
    let mut tag = |kind: u32, data: &[u8], length: u32| {
        plain.extend(kind.to_le_bytes());
        plain.extend(length.to_le_bytes());
        plain.extend(data);
    };
    tag(14, &[], 56 + count);
    tag(6, &[9, 0, 0, 0, 0, 0, 0, 0], 8);
    tag(5, &[count.to_le_bytes(), 1u32.to_le_bytes()].concat(), 8);
    tag(1, b"zeros\0\0\0", 5);
    tag(2, &vec![0; count as usize], count);
    let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    std::io::Write::write_all(&mut packed, &plain).unwrap();
    let packed = packed.finish().unwrap();
    let mut file = vec![b' '; 124];
    file.extend([0, 1, b'I', b'M']);
    file.extend(15u32.to_le_bytes());
    file.extend((packed.len() as u32).to_le_bytes());
    file.extend(packed);
    file
}

#[test]
fn a_small_file_that_inflates_to_a_huge_one_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path: &Path = &folder.path().join("bomb.mat");
    fs::write(path, bomb(100 << 20)).unwrap();
    assert!(fs::metadata(path).unwrap().len() < 1 << 20);
    frictionsim(&folder, &["signal", "bomb.mat", "--rate", "1000", "--no-figures"])
        .assert()
        .code(2)
        .stderr(contains("MATLAB file"))
        .stderr(contains("million numbers, the limit"));
}

#[test]
fn a_run_that_was_interrupted_while_it_replaces_others_goes_on_where_it_was() {
    use frictionsim::results::{Manifest, OutputFolder, Replace};
    let manifest =
        |command: &str| Manifest { case_hash: command.to_owned(), ..Manifest::new(command) };
    let folder = tempfile::tempdir().unwrap();
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
    assert!(
        !at("table.csv").exists() && !at(".replacing").exists() && !at("checkpoint.bin").exists()
    );
    assert_eq!(fs::read(at("energy.csv")).unwrap(), b"new");
}

#[test]
fn answers_to_common_slips_name_what_was_meant() {
    let mesh = Block::new(SIDE + 1).text("block");
    let folder = folder(&mesh, CASE);
    fs::write(folder.path().join("table.toml"), "frequency_hz,real\n1,2\n3,4\n").unwrap();
    fs::write(folder.path().join("mesh.toml"), &mesh).unwrap();
    fs::write(folder.path().join("comma.toml"), "[contact]\nfriction_coefficient = 0,3\n").unwrap();
    fs::write(folder.path().join("disc.csv"), &mesh).unwrap();
    let frf = "frf.frequencies_hz={from=1,to=10,step=1}";
    let continuation = "cycle.continuation={key=\"contact.friction\",from=0.1,to=0.2}";
    for (arguments, said) in [
        (&["check", "table.toml"][..], "this is a table of values, not a case"),
        (
            &["cea", "block.toml", "contact.friction_coefficient=0.2"],
            "is changed by --set 'contact.friction_coefficient=0.2'",
        ),
        (&["check", "mesh.toml"], "this is a Gmsh mesh"),
        (&["check", "comma.toml"], "decimal point, not a comma: 0.3"),
        (&["signal", "disc.csv"], "this is a Gmsh mesh, not a measurement"),
        (
            &["check", "block.toml", "--set", "output.probes=[{r=0.02,angle=90}]"],
            "did you mean `radius`?",
        ),
        (
            &["check", "block.toml", "--set", "output.probes=[{r=0.02,angle=90}]"],
            "did you mean `angle_deg`?",
        ),
        (
            &["check", "block.toml", "--set", frf, "--set", "frf.force_node=1"],
            "did you mean `count`?",
        ),
        (
            &["check", "block.toml", "--set", continuation],
            "did you mean \"contact.friction_coefficient\"?",
        ),
        (
            &[
                "check",
                "block.toml",
                "--set",
                "uncertainty.distributions={\"material.youngs_modulus\"={uniform=[1,2]}}",
            ],
            "\"material.youngs_modulus\" in uncertainty.distributions cannot be varied",
        ),
        (&["eigen", "block.toml"], "`frictionsim cea`"),
    ] {
        frictionsim(&folder, arguments).assert().code(2).stderr(contains(said));
    }
    let range = ["check", "block.toml", "--set", frf, "--set", "frf.force_node=1"];
    frictionsim(&folder, &range).assert().code(2).stderr(contains("missing or empty").not());
}
