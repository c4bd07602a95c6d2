//! Figures and report after every analysis, and `frictionsim plot`, which draws them again to the same bytes.
//!
//! Consistency checks: what the figures show is checked where they are drawn.

use crate::prelude::*;

/// Few dots are drawn soon; the picture of a mesh has the usual ones.
const FEW_DOTS: [&str; 2] = ["--dpi", "50"];

fn run(folder: &TempDir, command: &str, case: &str, set: &[&str]) -> Run {
    Run::new(&[command, &shipped(case), "--quiet"]).within(folder).out("out").set(set)
}

fn plot(folder: &TempDir, more: &[&str]) -> Run {
    Run::new(&["plot", "out"]).within(folder).args(more)
}

/// Every file below a folder with its bytes; locks and the manifest, whose file list grows, left out.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let name = |path: &PathBuf| path.strip_prefix(folder).unwrap().display().to_string();
    let files = files_below(folder).into_iter().map(|path| (name(&path), path));
    let files = files.filter(|(name, _)| !name.starts_with('.') && name != "manifest.json");
    files.map(|(name, path)| (name, fs::read(path).unwrap())).collect()
}

/// Holds a run to its figures, and `plot` to the same bytes, over them and where they are lost; and to fewer dots, where all are.
fn check_redrawn(folder: &TempDir, expected: &str) {
    let out = folder.path().join("out");
    let first = files(&out);
    for name in expected.split(' ') {
        for extension in ["svg", "png", "pdf"] {
            let file = format!("figures/{name}.{extension}");
            assert!(first.contains_key(&file), "{file}: {:?}", first.keys());
        }
    }
    let report = String::from_utf8(first["report.html"].clone()).unwrap();
    let drawings = first.keys().filter(|name| name.ends_with(".svg")).count();
    assert_eq!(report.matches("<figcaption>").count(), drawings);
    // Every row of a table has a cell for each of its columns.
    for table in report.split("<table>").skip(1) {
        let columns = table.split("</thead>").next().unwrap().matches("<th scope=\"col\"").count();
        let rows = table.split("<tr>").filter(|row| row.contains("<td"));
        assert!(rows.into_iter().all(|row| columns == 0 || row.matches("<td").count() == columns));
    }
    for lost in first.keys().filter(|name| name.ends_with(".svg") || *name == "report.html") {
        fs::remove_file(out.join(lost)).unwrap();
    }
    let answer = plot(folder, &FEW_DOTS).args(&["--threads", "1"]).done().says(&["figures in"]);
    assert_eq!(answer.stderr, "");
    plot(folder, &["--json"]).args(&FEW_DOTS).done().says(&["\"command\": \"plot\""]);
    let again = files(&out);
    assert!(first.keys().eq(again.keys()), "{:?}", again.keys());
    let changed: Vec<&String> = first.keys().filter(|name| first[*name] != again[*name]).collect();
    assert!(changed.is_empty(), "{changed:?} differ");
    fs::remove_dir_all(out.join("figures")).unwrap();
    fs::remove_file(out.join("report.html")).unwrap();
    plot(folder, &["--dpi", "25"]).done();
    let second = files(&out);
    assert!(first.keys().eq(second.keys()), "{:?}", second.keys());
    for (name, bytes) in second {
        assert_eq!(bytes.len() < first[&name].len(), name.ends_with(".png"), "{name}");
    }
}

const COARSE: &str = "mesh.circumferential_elements=60 ; mesh.radial_elements=12";

const SHORT: [&str; 2] =
    [COARSE, "output.probes=[1,200] ; output.snapshots=[0.002] ; transient.duration=0.004"];
const CYCLE_MESH: &str = "mesh.circumferential_elements=90 ; mesh.radial_elements=18";

/// Holds figures of a run to be there and to be drawn again: command, shipped case, changes, figures, one of them and its words.
macro_rules! drawn_again {
    ($($name:ident: $command:literal on $case:literal with $set:expr;
       $expected:literal, of which $figure:literal says $words:expr;)*) => {$(
        #[test]
        fn $name() {
            let folder = folder();
            let mesh = ($case == "sliding-block.toml").then(|| coarse_block(folder.path()));
            let plotted = run(&folder, $command, $case, &$set).set(mesh.as_slice());
            let answer = plotted.args(&FEW_DOTS).done();
            check_redrawn(&folder, $expected);
            has(&answer.text(concat!("figures/", $figure, ".svg")), $words);
        }
    )*};
}

drawn_again! {
    eigenvalue_figures_are_drawn_again: "cea" on "polycarbonate-disc.toml" with [
        COARSE,
        "cea.friction_coefficients={from=0.0,to=0.4,count=5} ; cea.shapes_at=[0.2,0.3]",
    ];
    "locus pairs prestress modes-mu-0.3 branch-n1-2-against", of which "locus" says &[];
    // The modes are those of the run's own linear stage: lumped mass, rigid contact.
    transient_figures_are_drawn_again: "transient" on "polycarbonate-610rpm.toml" with SHORT;
    "overview-1 overview-200 spectrum-200 growth velocity shear-stress trajectories contact energy",
        of which "growth" says &["rate of the eigenvalue analysis"];
    study_figures_are_drawn_again: "sweep" on "speed-friction-study.toml" with [
        COARSE,
        "output.probes=[1] ; transient.duration=0.004 ; \
         sweep.\"contact.rotation_speed_rpm\"=[70,610]",
        "sweep.\"contact.friction_coefficient\"=[0.3]",
    ];
    "frequencies status", of which "frequencies" says &["unstable mode of the eigenvalue analysis"];
    limit_cycle_figures_are_drawn_again: "cycle" on "limit-cycle.toml" with
        [CYCLE_MESH, "cycle.continuation.count=5"];
    "contact-n1 history-n1 orbit-n1 contact-n2 history-n2 orbit-n2 velocity shear-stress \
     branch-frequencies branch-shares",
        of which "branch-frequencies" says &["rotation speed", "onset of the instability"];
    figures_of_cycles_of_a_whole_mesh_are_drawn_again: "cycle" on "sliding-block.toml" with [
        "contact.friction_coefficient=0.7 ; cycle.stability=\"branch\"",
        "cycle.continuation={ key = \"contact.friction_coefficient\", from = 0.69, to = 0.71, \
         count = 3 }",
    ];
    "status-mode7 contact-mode7 history-mode7 orbit-mode7 harmonics-mode7 branch-frequencies \
     branch-shares velocity shear-stress",
        of which "velocity" says &[];
    figures_of_a_study_of_limit_cycles_are_drawn_again: "sweep" on "limit-cycle.toml" with [
        CYCLE_MESH,
        "cycle.continuation.count=5 ; cycle.stability=none ; cycle.confirmation_periods=0",
        "sweep.\"contact.friction_coefficient\"=[0.2,0.3]",
    ];
    "branch-frequencies branch-shares", of which "branch-shares" says
        &["n</tspan> = 1", "n</tspan> = 2", "μ</tspan> = 0.2", "μ</tspan> = 0.3"];
    convergence_figures_are_drawn_again: "convergence" on "convergence.toml" with [
        "mesh.circumferential_elements=36 ; mesh.radial_elements=8 ; transient.duration=0.002",
        "cea.max_frequency_hz=9000.0",
    ];
    "convergence", of which "convergence" says &[];
}

#[test]
fn response_and_identification_are_drawn_again_to_the_same_bytes() {
    let folder = folder();
    let set = "frf.force_node=13 ; frf.response_node=13 ; \
        frf.frequencies_hz={from=4.0,to=10000.0,count=2500}";
    run(&folder, "frf", "hammer-test.toml", &[COARSE, set]).args(&FEW_DOTS).done();
    check_redrawn(&folder, "response");
    fs::rename(folder.path().join("out/frf.csv"), folder.path().join("response.csv")).unwrap();
    // The tables are not needed.
    plot(&folder, &FEW_DOTS).done();
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    let identify = Run::new(&["identify", "response.csv", "--quiet"]).within(&folder).out("out");
    identify.args(&FEW_DOTS).done();
    check_redrawn(&folder, "identification");
}

#[test]
fn signal_figures_are_drawn_again_to_the_same_bytes() {
    let folder = folder();
    let text = tones(1e5, 4000, &[("left", 5000.0), ("right", 7000.0)]);
    fs::write(folder.path().join("signal.csv"), text).unwrap();
    let words = ["signal", "signal.csv", "--quiet", "--channel", "right", "--window", "0.002"];
    Run::new(&words).within(&folder).args(&FEW_DOTS).out("out").done();
    check_redrawn(&folder, "signal-1 spectrum-1");
}

#[test]
fn a_run_without_figures_keeps_none_to_draw() {
    let folder = folder();
    let run = || run(&folder, "transient", "polycarbonate-610rpm.toml", &SHORT);
    run().args(&FEW_DOTS).done().wrote("figures/overview-200.png");
    // Figures belong to the run: without them it starts from a clean folder.
    let gone = "!figures/overview-200.png !report.html !figures.bin";
    run().args(&["--no-figures"]).done().wrote(gone);
    plot(&folder, &[]).refused(&["out has no figures.bin: run it again without --no-figures"]);
}

#[test]
fn folders_that_cannot_be_drawn_are_bad_usage_with_a_reason() {
    let folder = folder();
    let refuse = |more: &[&str], reason: &str| plot(&folder, more).refused(&[reason]);
    refuse(&[], "there is no such folder");
    refuse(&["--dpi", "5"], "20 to 1200");
    run(&folder, "mesh", "polycarbonate-disc.toml", &[COARSE]).done();
    let above = Run::new(&["plot", "."]).within(&folder);
    above.refused(&["it has no manifest.json (results are in ./out)"]);
    let pair = Run::new(&["compare", "out", "none"]).within(&folder);
    pair.refused(&["none does not hold ; there is no such folder ; !without figures"]);
    let figures = folder.path().join("out/figures.bin");
    let whole = fs::read(&figures).unwrap();
    let mut bytes = whole.clone();
    bytes[whole.len() / 2] ^= 1;
    fs::write(&figures, &bytes).unwrap();
    refuse(&[], "its figures.bin is damaged (its checksum");
    // Of another version, which a comparison of its numbers says too.
    bytes[8] = 1;
    fs::write(&figures, &bytes).unwrap();
    let format = "its figures.bin has format 1, this version reads format 3: run it again";
    refuse(&[], format);
    Run::new(&["compare", "out", "out"]).within(&folder).out("both").done().warns(&[format]);
    fs::write(&figures, whole).unwrap();
    let summary = folder.path().join("out/summary.json");
    let text = fs::read_to_string(&summary).unwrap();
    fs::write(&summary, text.replacen("\"nodes\": ", "\"nodes\": 1", 1)).unwrap();
    refuse(&[], "its summary.json is damaged (its checksum");
    fs::remove_file(&summary).unwrap();
    refuse(&[], "the run did not end");
    let manifest = folder.path().join("out/manifest.json");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, text.replacen("radial_elements", "radial_element", 1)).unwrap();
    refuse(&[], "its manifest.json is damaged (its checksum");
}

#[test]
fn the_picture_of_an_imported_mesh_names_boundaries_regions_and_normals() {
    let folder = folder();
    let answer = run(&folder, "mesh", "pad-on-disc.toml", &[]).done();
    let picture = answer.text("figures/mesh.svg");
    has(&picture, &[">lining< ; >rim< ; >hub< ; pad:  ; counterface edge"]);
    has(&picture, &["outward normal of the contact edge"]);
    // The contact edge lies over its counterface.
    assert!(picture.rfind("#d55e00") > picture.rfind("#56b4e9"));
    let summary = answer.summary();
    let boundaries = summary["mesh"]["boundaries"].as_array().unwrap();
    assert_eq!(boundaries.iter().find(|b| b["name"] == "rim").unwrap()["condition"], "counterface");
    has(&String::from_utf8_lossy(&answer.bytes("mesh.vtu")), &["Name=\"region_id\""]);
}

#[test]
fn a_comparison_names_its_runs_in_each_figure_and_draws_no_bodies() {
    let folder = folder();
    let few = "cea.friction_coefficients=[0.0, 0.3] ; cea.modes=4";
    // With twice the force the traction of one is in kPa, of the other in MPa.
    for (out, change) in
        [("soft", "contact.interference=1.25e-5"), ("stiff", "contact.interference=5e-5")]
    {
        let own = Run::new(&["cea", &shipped("polycarbonate-disc.toml")]).within(&folder);
        let own = own.out(out).set(&[COARSE, few, change]).done();
        assert!(own.out.join("figures/modes-mu-0.3.svg").exists());
    }
    let both = Run::new(&["compare", "soft", "stiff"]).within(&folder).out("both").done();
    let figure = |name: &str| both.text(&format!("figures/{name}.svg"));
    ["locus", "prestress"].iter().for_each(|name| has(&figure(name), &[">soft< ; >stiff<"]));
    has(&figure("prestress"), &["pressure ; traction"]);
    assert!(!both.out.join("figures/modes-mu-0.3.svg").exists());
    // Of a sweep, whose folder several processes write, too; its axes name what is swept.
    for out in ["two", "too"] {
        let words = ["sweep", &shipped("polycarbonate-disc.toml")];
        let swept =
            "sweep={ \"contact.rotation_speed_rpm\" = [71.0, 613.0], analyses = [\"cea\"] }";
        Run::new(&words).within(&folder).out(out).set(&[COARSE, few, swept]).done();
    }
    let both = Run::new(&["compare", "two", "too"]).within(&folder).out("sweeps").done();
    has(&both.text("figures/operating-matrix.svg"), &[">two< ; >too< ; >71< ; >613<"]);
}

#[test]
fn a_comparison_warns_where_forces_of_one_run_alone_are_for_each_metre() {
    let folder = folder();
    let few = "cea.friction_coefficients=[0.3] ; cea.shapes_at=[0.3] ; cea.modes=2";
    let changes = ["contact.speed=1.5", "geometry.thickness=0.01", "geometry.thickness=0.02"];
    for (out, change) in ["metre", "thin", "thick"].into_iter().zip(changes) {
        let words = ["cea", &shipped("sliding-block.toml"), "--no-figures"];
        Run::new(&words).within(&folder).out(out).set(&[few, change]).done();
    }
    let said = "for each metre of thickness, of others of the whole body";
    let told = |[one, other]: [&str; 2]| {
        let words = ["compare", one, other, "--no-figures"];
        Run::new(&words).within(&folder).out(format!("{one}-{other}")).done().stderr
    };
    assert!(told(["metre", "thin"]).contains(said));
    assert!(!told(["thin", "thick"]).contains(said));
    // A response has no forces, and a mesh no number that an analysis has.
    let frf = "frf={ force_node = 1, force_direction = \"x\", frequencies_hz = [1000.0] }";
    for (command, change) in [("frf", frf), ("mesh", "geometry.thickness=0.02")] {
        let words = [command, &shipped("sliding-block.toml"), "--no-figures"];
        Run::new(&words).within(&folder).out(command).set(&[change]).done();
    }
    assert!(!told(["thick", "frf"]).contains(said));
    let pair = Run::new(&["compare", "thick", "mesh"]).within(&folder);
    pair.refused(&["these runs (cea, mesh) share no number"]);
}
