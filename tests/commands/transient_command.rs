//! `frictionsim transient` as a user meets it: files, checkpoints, exit codes, and the shipped cases on coarse meshes.

use crate::prelude::*;

const BRICK: Block = brick("brick", [0.0; 3], [0.01; 3], [2, 1, 1]);

/// A command on a shipped case of the disc, on a mesh that steps in a microsecond.
fn coarse(command: &str, name: &str, out: &Path, overrides: &[&str]) -> Run {
    let coarse =
        ["mesh.circumferential_elements=60 ; mesh.radial_elements=12 ; output.probes=[1, 200] ; \
         output.snapshots=[0.002] ; transient.duration=0.004"];
    Run::new(&[command, &shipped(name)]).out(out).set(&coarse).set(overrides)
}

fn transient(out: &Path, overrides: &[&str]) -> Run {
    coarse("transient", "polycarbonate-610rpm.toml", out, overrides).args(&["--no-figures"])
}

fn resumed(out: &Path, overrides: &[&str]) -> Run {
    transient(out, overrides).args(&["--resume"])
}

/// Every result file but those that hold wall-clock times.
fn results(answer: &Answer) -> Vec<(&'static str, Vec<u8>)> {
    let names = "probe-1.csv probe-200.csv energy.csv contact.csv contact.npz harmonics.csv \
        snapshots.pvd snapshots/snapshot-001.vtu";
    names.split(' ').map(|name| (name, answer.bytes(name))).collect()
}

fn assert_same(found: &Answer, expected: &Answer) {
    for (found, expected) in results(found).into_iter().zip(results(expected)) {
        assert!(found == expected, "{}", expected.0);
    }
}

#[test]
fn every_promised_file_column_and_summary_key_is_there() {
    let said = "over the last fifth ; no contact node sticks or opens ; !no vibration grows";
    let answer = transient("out".as_ref(), &[]).done().says(&[said]);
    assert_eq!(
        answer.header("probe-200.csv"),
        "time_s,u_r_m,u_theta_m,v_r_m_per_s,v_theta_m_per_s,a_r_m_per_s2,a_theta_m_per_s2"
    );
    assert_eq!(
        answer.header("energy.csv"),
        "time_s,kinetic_j,strain_j,external_w,stick_w,slide_w,contact_dissipated_w,material_damping_w,\
         normal_contact_w,balance_residual"
    );
    assert_eq!(answer.header("contact.csv"), "time_s,stick,slip,open");
    let summary = answer.summary();
    let keys = "/steps /time_step_s /wall_s /element_steps_per_s /max_balance_residual \
        /main_frequency_hz /status/stick /status/slip /status/open /power_w/external \
        /power_w/stick /power_w/slide /power_w/contact_dissipated \
        /power_w/material_damping /harmonics/8 /growth /first_nonlinearity_s \
        /manifest/case_hash /manifest/simd /settled /settled_from_s /end_state /drift \
        /main_amplitude_m /significant_harmonics_m /no_growth \
        /probes/200/radial/acceleration_rms_m_per_s2 /perturbation/velocity \
        /contact_interval_s";
    for key in keys.split(' ') {
        assert!(summary.pointer(key).is_some(), "{key}");
    }
    assert!(summary["max_balance_residual"].as_f64().unwrap() < 1e-10);
}

/// At friction 0.2 and 1000 rpm the wave of two nodal diameters lives on beside that of one.
const TWO_FREQUENCIES: [&str; 1] =
    ["transient.duration=0.05 ; contact.friction_coefficient=0.2 ; \
     contact.rotation_speed_rpm=1000.0 ; transient.perturbation.harmonics=[1, 2] ; \
     transient.perturbation.velocity=0.3 ; cea.max_frequency_hz=9000.0"];

#[test]
fn a_vibration_of_two_frequencies_is_named_with_both_and_its_envelope() {
    let said = ["two frequencies, which is no limit cycle", "is above cea.max_frequency_hz = 9000"];
    let summary = transient(folder().path(), &TWO_FREQUENCIES).done().says(&said).summary();
    assert_eq!(summary["end_state"], "two-frequency");
    let [first, second] = [0, 1].map(|k| summary["frequencies_hz"][k].as_f64().unwrap());
    assert!(first > second + 500.0, "{first} {second}");
    assert!(summary["envelope_ratio"].as_f64().unwrap() > 1.4);
}

#[test]
fn a_sweep_marks_points_that_are_no_limit_cycles_in_table_report_and_figures() {
    let swept = "sweep={\"contact.rotation_speed_rpm\"=[1000.0, 10.0]}";
    let case = "polycarbonate-610rpm.toml";
    let run = coarse("sweep", case, "out".as_ref(), &TWO_FREQUENCIES).set(&[swept]);
    let answer = run.done().says(&["ends in", "two-frequency", "at 1 of 2 points (1)"]);
    has(&answer.text("report.html"), &["two-frequency"]);
    for figure in ["figures/frequencies.svg", "figures/status.svg"] {
        has(&answer.text(figure), &["two frequencies"]);
    }
}

#[test]
fn a_jammed_block_is_said_to_jam_and_to_leave_small_displacements() {
    let jams = ["contact.friction_coefficient=0.9", "transient.duration=0.002"];
    let run = Run::of("transient", shipped("sliding-block.toml")).out("out").set(&jams);
    // A body without symmetry has no harmonic anywhere.
    let answer = run.done().says(&["the body jams: there is no state of steady sliding ; \
         leaves the theory of small displacements ; !harmonic ; !nodal"]);
    let summary = answer.summary();
    assert_eq!(summary["notes"].as_array().unwrap().len(), 2);
    assert!(summary["main_harmonic"].is_null());
    assert_eq!(summary["harmonics"].as_array().unwrap().len(), 0);
    assert_eq!(summary["significant_harmonics_m"].as_object().unwrap().len(), 0);
    assert!(!answer.path("harmonics.csv").exists());
    assert!(summary["growth"].as_array().unwrap().iter().all(|g| g["harmonic"].is_null()));
}

/// The slowest mode of the stable block decays by 220 1/s here: the run ends at a hundredth of the deformation, far above round-off.
#[test]
fn a_vibration_that_decays_ends_in_steady_sliding() {
    let decays = ["damping.mass_coefficient=400.0", "transient.duration=0.04"];
    let run = Run::of("transient", shipped("sliding-block.toml")).out("out").set(&decays);
    let answer = run.done().says(&["The run ends in steady sliding"]);
    assert_eq!(answer.summary()["end_state"], "steady-sliding");
}

#[test]
fn a_run_from_a_limit_cycle_has_no_linear_stage() {
    // The waves of coarser meshes are no motion of the disc.
    let start = ["transient.initial=limit-cycle ; transient.limit_cycle_harmonic=2 ; \
         mesh.circumferential_elements=90 ; mesh.radial_elements=18"];
    let summary = transient(folder().path(), &start).done().says(&["!linear stage"]).summary();
    assert!(summary["growth"].as_array().unwrap().is_empty());
    assert!(summary["no_growth"].as_object().unwrap().is_empty());
}

#[test]
fn results_scale_with_the_thickness_and_nothing_else_does() {
    let power = |thickness: &str| {
        let set = format!("geometry.thickness={thickness}");
        let summary = transient("out".as_ref(), &[&set]).done().summary();
        ["/power_w/external", "/harmonics/0"]
            .map(|at| summary.pointer(at).unwrap().as_f64().unwrap())
    };
    let (thin, thick) = (power("0.009"), power("0.018"));
    assert!((thick[0] / thin[0] - 2.0).abs() < 1e-14);
    assert_eq!(thin[1], thick[1]);
}

#[test]
fn results_are_the_same_bytes_for_any_number_of_threads() {
    let run = |threads| transient("out".as_ref(), &[]).args(&["--threads", threads]).done();
    assert_same(&run("1"), &run("2"));
}

/// Ends a run that keeps its state often behind its first checkpoint.
fn stopped(out: &Path, signal: Option<&str>) -> Answer {
    transient(out, &OFTEN).stopped(signal, || out.join("checkpoint.bin").exists())
}

const OFTEN: [&str; 2] = ["output.checkpoint_interval=0.02", "transient.duration=0.03"];

/// Killed, and interrupted, which keeps what it has and says how to go on; a run may have ended before the signal came.
#[test]
fn a_stopped_run_resumes_to_the_bytes_of_an_uninterrupted_one() {
    let folder = folder();
    let whole = transient(&folder.path().join("whole"), &OFTEN).done();
    let without_times = |mut summary: Value| {
        ["wall_s", "element_steps_per_s"].iter().for_each(|key| summary[*key] = Value::Null);
        summary
    };
    for signal in [None, Some("INT")].into_iter().take(1 + usize::from(cfg!(unix))) {
        let out = folder.path().join(signal.unwrap_or("killed"));
        let answer = stopped(&out, signal);
        if signal.is_some() && answer.code != Some(0) {
            let answer = answer.code(130).warns(&["--resume"]).wrote("energy.csv");
            assert_eq!(answer.summary()["finished"], false);
        }
        let resumed = resumed(&out, &OFTEN).done();
        assert_same(&resumed, &whole);
        assert_eq!(without_times(resumed.summary()), without_times(whole.summary()));
    }
}

/// Longer runs of a finished one: the bytes of a run that was asked to last that long at once.
#[test]
fn a_finished_run_is_extended_bit_for_bit() {
    let folder = folder();
    let (whole, part) = (folder.path().join("whole"), folder.path().join("part"));
    let asked = |duration: &'static str| {
        ["output.snapshots=[0.002, 0.005]", "transient.perturbation.velocity=0.5", duration]
    };
    let (short, long) = (asked("transient.duration=0.003"), asked("transient.duration=0.006"));
    let whole = transient(&whole, &long).done();
    transient(&part, &short).done().warns(&["0.005 s lies after the end of the run"]);
    let longer = resumed(&part, &long).done();
    assert_same(&longer, &whole);
    for name in ["record.bin", "checkpoint.bin", "snapshots/snapshot-002.vtu"] {
        assert!(longer.bytes(name) == whole.bytes(name), "{name}");
    }
    // Asked for again, it has nothing left to do; shorter than it is it cannot become.
    resumed(&part, &long).done();
    resumed(&part, &asked("transient.duration=0.004"))
        .refused(&["has come to 0.006000 s, beyond transient.duration = 0.004 s"]);
    // Nor can it go on from other seeds.
    let seeds =
        "transient.perturbation={ harmonics = [2], velocity = 0.5, noise = 1e-3, noise_seed = 2 }";
    resumed(&part, &[long[0], long[2], seeds])
        .refused(&["transient.perturbation.noise is 0.001 here, not given there"]);
}

/// A mesh file that has changed since is another body: what is there stays as it is, and a plain rerun needs --force.
#[test]
fn a_refused_continuation_leaves_the_finished_folder_as_it_was() {
    let folder = folder();
    let path = folder.path().join("body.msh");
    fs::write(&path, file_of(&[BRICK], |point| point)).unwrap();
    let case = include_str!("../cases/short-transient.toml");
    let out = folder.path().join("out");
    let run = |more: &[&str]| Run::of_text("transient", folder.path(), case).out("out").args(more);
    run(&[]).done();
    let known = ["manifest.json", "mesh.msh", "summary.json", "checkpoint.bin"];
    let bytes = || known.map(|name| fs::read(out.join(name)).unwrap());
    let before = bytes();
    let moved = Block { size: [0.011, 0.01, 0.01], ..BRICK };
    fs::write(&path, file_of(&[moved], |point| point)).unwrap();
    run(&["--resume"]).refused(&[]);
    assert!(bytes() == before, "the folder has changed");
    run(&[]).refused(&["--force"]);
    assert!(bytes() == before);
    run(&["--force"]).done();
    assert!(bytes() != before);
}

#[test]
fn no_number_that_is_none_is_printed_or_written() {
    let cases = [("still", "contact.rotation_speed_rpm=0"), ("short", "transient.duration=0.0006")];
    for (name, set) in cases {
        let answer = transient("out".as_ref(), &[set]).done();
        let files = ["summary.json", "energy.csv", "contact.csv", "harmonics.csv", "probe-1.csv"];
        for text in files.map(|file| answer.text(file)).iter().chain([&answer.stdout]) {
            for word in text.split(|c: char| c.is_whitespace() || ",:(".contains(c)) {
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
    stopped(&out, None);
    let path = out.join("checkpoint.bin");
    let mut bytes = fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, &bytes).unwrap();
    resumed(&out, &OFTEN).refused(&["checksum"]);
    fs::write(&path, &bytes[..middle]).unwrap();
    resumed(&out, &OFTEN).refused(&["bytes where"]);
    bytes[8] = 99;
    fs::write(&path, &bytes).unwrap();
    resumed(&out, &OFTEN).refused(&["format 99"]);
    assert_eq!(fs::read(&path).unwrap(), bytes);
}

#[test]
fn shipped_cases_end_in_the_limit_cycles_that_their_titles_say() {
    let cases = [("polycarbonate-610rpm.toml", 2, true), ("polycarbonate-70rpm.toml", 1, false)];
    for (name, harmonic, lifts_off) in cases {
        let run = coarse("transient", name, "out".as_ref(), &["transient.duration=0.04"]);
        let summary = run.args(&["--no-figures"]).done().summary();
        assert_eq!(summary["main_harmonic"], harmonic, "{name}");
        let open = summary["status"]["open"].as_f64().unwrap();
        assert_eq!(open > 0.0, lifts_off, "{name}: {open}");
        assert!(summary["status"]["stick"].as_f64().unwrap() > 0.2);
        assert!(summary["first_nonlinearity_s"].as_f64().unwrap() < 0.03);
    }
}
