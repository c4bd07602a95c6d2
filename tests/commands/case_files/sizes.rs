//! Consistency checks of sizes: what a case asks for is weighed before anything of it is made.

use super::*;

#[test]
fn no_override_is_costly() {
    let long = "{ from = 1, to = 2, count = 100000 }";
    let nested = format!("{}=1", vec!["a"; 20_000].join("."));
    let swept = |key: &str| format!("sweep.\"{key}\"={long}");
    let speeds = swept("contact.rotation_speed_rpm");
    let others = [swept("contact.interference"), swept("material.density")];
    let snapshots = format!("output.snapshots={long}");
    let brackets = "[".repeat(50_000);
    for overrides in [
        &[&*speeds.replace("100000", "1000000000000")][..],
        &[&speeds],
        &[&speeds, &others[0], &others[1]],
        &[&speeds, &snapshots],
        &["output.snapshots={ from = 0, to = 1, count = 9000000000000000000 }"],
        &[&format!("{brackets}=1")],
        &[&format!("a={brackets}")],
        &[&nested],
    ] {
        let start = Instant::now();
        let _ = parse(STUDY, overrides).map_err(|errors| errors.to_string());
        let seconds = start.elapsed();
        // Milliseconds where nobody else is at work; hours where the numbers themselves are made.
        assert!(seconds < Duration::from_secs(30), "{seconds:?}: {:.80}", overrides[0]);
    }
}

#[test]
fn memory_is_refused_at_the_key_that_asks_for_it() {
    let fine = ["mesh.circumferential_elements=100000", "mesh.radial_elements=10000"];
    for (text, overrides, command, key) in [
        (RUN, vec!["output.sample_interval=1e-12"], "transient", "output.sample_interval"),
        (RUN, vec!["transient.duration=1e4"], "transient", "transient.duration"),
        (RUN, fine.to_vec(), "transient", "mesh.circumferential_elements"),
        (CYCLES, vec!["cycle.phases=100001"], "cycle", "cycle.phases"),
    ] {
        let case = valid(text, &overrides);
        let (bytes, blamed) = case.memory(command);
        assert!(bytes > 1e11, "{overrides:?}: {bytes}");
        assert_eq!(blamed, key);
        let errors = case.memory_error(command, bytes, 1e9).to_string();
        has(&errors, &[key, "GiB are available", "--set:1:"]);
    }
}

#[test]
fn the_cost_of_studies_counts_every_run() {
    let study = valid(STUDY, &[]);
    let one = study.cost().transient.unwrap().run.operations;
    let all = study.sweep_cost().unwrap();
    assert_eq!(all.runs, 72);
    assert!((all.run.operations / (72.0 * one) - 1.0).abs() < 1e-9);
    let meshes = valid(include_str!("../../../cases/convergence.toml"), &[]);
    let (one, all) = (meshes.cost(), meshes.convergence_cost().unwrap());
    // Three analyses on three meshes, and three time steps.
    assert_eq!(all.runs, 12);
    // Twice as fine a mesh has four times the elements and twice the steps.
    let transients =
        one.transient.unwrap().run.operations * (1.0 + 1.5f64.powi(3) + 8.0 + 1.0 + 2.0 + 4.0);
    let all = all.run.operations;
    assert!(all > 0.95 * transients, "{all} {transients}");
    // A solid mesh twice as fine has eight times the elements: beside the first, 8 and 64 times what grows least.
    let set = ["convergence={factors=[1,2,4],analyses=[\"cea\"]}"];
    let solid = shipped_case("tread-block.toml", &set);
    let (one, all) = (solid.cost().cea.unwrap().run, solid.convergence_cost().unwrap().run);
    assert!(all.operations > 73.0 * one.operations, "{one:?} {all:?}");
    assert!(all.memory_bytes > 73.0 * one.memory_bytes, "{one:?} {all:?}");
}

/// Against the run of a block of 20-node bricks: its unknowns, its peak of memory, and its time in words.
#[cfg(target_os = "linux")]
#[test]
fn the_cost_of_a_solid_case_is_that_of_its_run() {
    let block = Block { name: "block", origin: [0.0; 3], size: [1.0; 3], counts: [4, 4, 3] };
    let place = |[x, y, z]: [f64; 3]| [0.08 * x, 0.07 * y, 0.06 * z];
    let folder = folder_with(&[("block.msh", &file_of_order(&[block], 2, place))]);
    let text = include_str!("../../cases/rubber-block.toml");
    let stiffer = ["material.young_modulus=5e9", "contact.interference=2e-5"];
    let own = |command| Run::of_text(command, folder.path(), text).set(&stiffer);
    let run = |command| own(command).args(&["--unset", "damping"]);
    let told = run("check").args(&["--json"]).done().value()["cases"][0].clone();
    assert_eq!(told["dofs"], run("mesh").out("mesh").done().summary()["mesh"]["dofs"]);
    let mut child = run("cea").out("cea").args(&["--threads", "1"]).program();
    let mut child = child.stdout(Stdio::null()).spawn().unwrap();
    let (status, mut peak) = (format!("/proc/{}/status", child.id()), 0.0_f64);
    while child.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let number = |line: &str| line.trim_end_matches("kB").trim().parse::<f64>().unwrap();
        peak = peak.max(1024.0 * line.map_or(0.0, number));
        std::thread::sleep(Duration::from_millis(2));
    }
    let announced = told["memory_bytes"].as_f64().unwrap();
    assert!((0.5..2.0).contains(&(announced / peak)), "{announced:e} {peak:e}");
    assert_eq!(told["cea"]["time"], "seconds");
}
