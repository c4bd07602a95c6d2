//! Consistency checks of parameter studies: the bookkeeping of points, with a made-up analysis in
//! place of a solver, so that the checks are about who runs what and what is kept of it.

use crate::prelude::*;
use frictionsim::app::OutputOptions;
use frictionsim::app::sweep::{SweepProgress, *};
use frictionsim::results::Head;
use frictionsim::results::sweep::{Start, SweepFolder};
use serde_json::Map;
use std::sync::atomic::{AtomicUsize, Ordering};

const GRID: &str = "\n[sweep]\n\"contact.friction_coefficient\" = [0.2, 0.3, 0.4]\n\
    \"contact.rotation_speed_rpm\" = { from = 10, to = 6000, count = 5, spacing = \"log\" }\n";

fn study(sweep: &str) -> Case {
    let file = include_str!("../../cases/polycarbonate-disc.toml");
    case_of("study.toml", &format!("{file}{sweep}"), AS_IT_IS)
}

#[test]
fn shards_are_disjoint_and_cover_every_point() {
    for count in 1..=9 {
        let shards = (1..=count).map(|own| Shard::points(format!("{own}/{count}").parse().ok(), 7));
        let mut all: Vec<usize> = shards.flatten().collect();
        all.sort_unstable();
        assert_eq!(all, [1, 2, 3, 4, 5, 6, 7]);
    }
    for text in ["0/4", "5/4", "1", "a/b", "1/0", "-1/4", ""] {
        assert!(text.parse::<Shard>().is_err(), "{text}");
    }
    assert!("4/4".parse::<Shard>().is_ok());
}

/// Its hash is that of a case without a study: it stays when the study grows.
#[test]
fn a_point_is_the_case_with_the_swept_values_as_overrides() {
    let swept = study(
        "\n[sweep]\nanalyses = [\"cea\"]\n\
         \"contact.friction_coefficient\" = { from = 0.1, to = 0.7, count = 7 }\n",
    );
    let point = SweepPlan::new(&swept).unwrap().point_case(3).unwrap();
    let plain = shipped_case("polycarbonate-disc.toml", &["contact.friction_coefficient=0.3"]);
    assert_eq!(point.raw.hash(), plain.raw.hash());
    assert_eq!(point.contact.sliding.friction_coefficient, 0.3);
}

#[test]
fn a_case_runs_the_analyses_that_it_has_sections_for() {
    let both = "\n[sweep]\n\"contact.friction_coefficient\" = [0.2]\n[transient]\nduration = 0.01";
    assert_eq!(SweepPlan::new(&study(both)).unwrap().analysis_names(), ["transient", "cea"]);
}

fn manifest(case: &Case) -> Manifest {
    let (case_text, case_hash) = (case.raw.text.clone(), case.raw.hash());
    Manifest { case_text, case_hash, ..Manifest::new("sweep") }
}

/// An analysis that is a formula of the case, and whose clock is never the same.
fn formula(case: &Case) -> Result<Map<String, Value>, Failure> {
    static CLOCK: AtomicUsize = AtomicUsize::new(0);
    let contact = &case.contact.sliding;
    let summary = json!({
        "main_frequency_hz": contact.friction_coefficient.sqrt() * 1e4 / contact.rotation_speed,
        "status": { "stick": contact.friction_coefficient / 3.0 },
        "wall_s": CLOCK.fetch_add(1, Ordering::Relaxed),
    });
    Ok(Map::from_iter([("transient".to_owned(), summary)]))
}

fn sweep(
    case: &Case,
    folder: &Path,
    (shard, threads, start): (Option<&str>, usize, Start),
    runner: &PointRunner<'_>,
) -> Result<usize, FolderError> {
    let plan = SweepPlan::new(case).unwrap();
    let shard: Option<Shard> = shard.map(|text| text.parse().unwrap());
    let (points, manifest) = (Shard::points(shard, plan.count()), manifest(case));
    let folder = SweepFolder::open(folder, &manifest, plan.count(), &points, start)?;
    let progress = SweepProgress::new(true, points.len());
    let run = SweepRun { plan: &plan, folder: &folder, progress: &progress, runner };
    let ran = run.run(&points, threads).unwrap();
    let output = OutputOptions { no_figures: true, ..OutputOptions::default() };
    let found = finished(&plan, &folder).unwrap();
    gather(&output, &folder, (case, &plan), Head::of(&case.title, 0.0), &found).unwrap();
    Ok(ran)
}

pub fn table(folder: &Path) -> String {
    fs::read_to_string(folder.join("points.csv")).unwrap()
}

#[test]
fn the_table_is_the_same_bytes_for_any_threads_shards_and_restarts() {
    let case = study(GRID);
    let root = folder();
    let whole = root.path().join("whole");
    assert_eq!(sweep(&case, &whole, (None, 1, Start::Fresh), &formula).unwrap(), 15);
    let expected = table(&whole);
    assert_eq!(expected.lines().count(), 16);
    assert!(expected.starts_with(
        "contact.friction_coefficient,contact.rotation_speed_rpm,main_frequency_hz,status.stick,\
         point,error\n0.2,10,"
    ));
    for threads in [2, 7, 40] {
        let folder = root.path().join(format!("{threads}-threads"));
        sweep(&case, &folder, (None, threads, Start::Fresh), &formula).unwrap();
        assert_eq!(table(&folder), expected, "{threads} threads");
    }
    let shared = root.path().join("shards");
    for shard in ["3/4", "1/4", "2/4"] {
        sweep(&case, &shared, (Some(shard), 2, Start::Fresh), &formula).unwrap();
    }
    assert_ne!(table(&shared), expected);
    let ran = sweep(&case, &shared, (None, 2, Start::Resume), &formula).unwrap();
    assert_eq!(ran, 3, "the points of the fourth shard");
    assert_eq!(table(&shared), expected);
}

#[test]
fn a_failed_point_is_a_row_and_the_others_go_on() {
    let case = study(GRID);
    let folder = folder();
    let calls = AtomicUsize::new(0);
    let runner = |point: &Case| {
        calls.fetch_add(1, Ordering::Relaxed);
        let contact = &point.contact.sliding;
        if contact.rotation_speed < 2.0 {
            assert!(contact.friction_coefficient < 0.35, "made to panic");
            return Err(Failure::run("made to fail,\nin two lines"));
        }
        formula(point)
    };
    sweep(&case, folder.path(), (None, 3, Start::Fresh), &runner).unwrap();
    let text = table(folder.path());
    let failed: Vec<&str> = text.lines().filter(|row| row.contains("made to")).collect();
    assert_eq!(text.lines().count(), 16);
    assert_eq!(
        failed,
        [
            "0.2,10,,,1,\"made to fail, in two lines\"",
            "0.3,10,,,6,\"made to fail, in two lines\"",
            "0.4,10,,,11,panic: made to panic",
        ]
    );
    // A failure is a result: it is not tried again.
    sweep(&case, folder.path(), (None, 3, Start::Resume), &runner).unwrap();
    assert_eq!(calls.into_inner(), 15);
    assert_eq!(table(folder.path()), text);
}

#[test]
fn values_that_do_not_go_together_fail_their_point_alone() {
    let text = "\n[sweep]\n\"geometry.inner_radius\" = [0.01, 0.05]\n\
        \"geometry.outer_radius\" = [0.04, 0.0905]\nanalyses = [\"cea\"]\n";
    let folder = folder();
    sweep(&study(text), folder.path(), (None, 2, Start::Fresh), &formula).unwrap();
    let text = table(folder.path());
    let errors: Vec<bool> = text.lines().map(|row| row.contains("radius =")).collect();
    assert_eq!(errors, [false, false, false, true, false], "{text}");
}

#[test]
fn finished_points_are_kept_unless_asked_otherwise() {
    let case = study(GRID);
    let folder = folder();
    let run = |shard, start| sweep(&case, folder.path(), (shard, 2, start), &formula);
    assert_eq!(run(Some("1/3"), Start::Fresh).unwrap(), 5);
    // Another shard is not in its way; the same one, or the whole, is.
    assert_eq!(run(Some("2/3"), Start::Fresh).unwrap(), 5);
    let refused = run(Some("1/3"), Start::Fresh).unwrap_err();
    assert!(refused.is_usage() && refused.to_string().contains("--resume"), "{refused}");
    assert!(run(None, Start::Fresh).is_err());
    assert_eq!(run(None, Start::Resume).unwrap(), 5);
    assert_eq!(run(None, Start::Resume).unwrap(), 0);
    assert_eq!(run(Some("3/3"), Start::Over).unwrap(), 5);
    assert_eq!(run(None, Start::Over).unwrap(), 15);
}

#[test]
fn a_damaged_point_is_run_again() {
    let case = study(GRID);
    let folder = folder();
    sweep(&case, folder.path(), (None, 2, Start::Fresh), &formula).unwrap();
    let expected = table(folder.path());
    let path = |point: usize| folder.path().join(format!("points/point-{point:06}.json"));
    let whole = fs::read_to_string(path(4)).unwrap();
    fs::write(path(4), &whole[..whole.len() / 2]).unwrap();
    fs::copy(path(7), path(8)).unwrap();
    assert_eq!(sweep(&case, folder.path(), (None, 2, Start::Resume), &formula).unwrap(), 2);
    assert_eq!(table(folder.path()), expected);
}

#[test]
fn points_of_another_case_are_refused_and_replaced_only_by_force() {
    let (case, other) = (study(GRID), study(&GRID.replace("0.4", "0.5")));
    let folder = folder();
    sweep(&case, folder.path(), (None, 2, Start::Fresh), &formula).unwrap();
    let expected = table(folder.path());
    for start in [Start::Fresh, Start::Resume] {
        let refused = sweep(&other, folder.path(), (None, 2, start), &formula).unwrap_err();
        assert!(matches!(refused, FolderError::OtherCase { .. }));
    }
    assert_eq!(table(folder.path()), expected);
    assert_eq!(sweep(&other, folder.path(), (None, 2, Start::Over), &formula).unwrap(), 15);
    assert!(table(folder.path()).contains("\n0.5,"));
}

#[test]
fn sweeps_and_other_commands_keep_out_of_each_others_folder() {
    let case = study(GRID);
    let plan = SweepPlan::new(&case).unwrap();
    let folder = folder();
    let manifest = manifest(&case);
    let open = |start| SweepFolder::open(folder.path(), &manifest, plan.count(), &[1], start);
    let other = Manifest::new("cea");
    {
        let _sweep = open(Start::Fresh).unwrap();
        let second = OutputFolder::open(folder.path(), &other, Replace::Anything).unwrap_err();
        assert!(matches!(second, FolderError::Busy(_)));
        // Starting over would take the points from under the other process.
        assert!(matches!(open(Start::Over), Err(FolderError::Busy(_))));
    }
    let _cea = OutputFolder::open(folder.path(), &other, Replace::Anything).unwrap();
    assert!(matches!(open(Start::Resume), Err(FolderError::Busy(_))));
    assert!(SweepFolder::find(folder.path(), "sweep").is_err());
}

/// Frictions, directions and moduli of a coarse disc: reversed rotation mirrors it, so each condition has modes of its mirror image.
#[test]
fn the_operating_matrix_lists_every_unstable_mode_and_reversed_rotation_mirrors_it() {
    let sections = "[cea]\nmodes = 8\nfriction_coefficients = [0.1, 0.3]\n[sweep]\nanalyses = [\"cea\"]\n\
        \"contact.rotation_speed_rpm\" = [-610.0, 610.0]\n\
        \"material.young_modulus\" = [2.5e9, 5e9]\n";
    let run = Run::new(&["sweep", "case.toml"]).beside(&[("case.toml", coarse_disc(sections))]);
    let run = run.out("out");
    let answer = run.done().says(&["of 8 operating conditions (4 points)"]);
    // Every row of the modes of the points that grows is in the table, at both frictions.
    let unstable = answer.rows("unstable_modes.csv");
    let at = |friction: &str, modulus: &str, speed: &str| -> Vec<[f64; 3]> {
        let modulus: f64 = modulus.parse().unwrap();
        let own = unstable.iter().filter(|row| {
            row["friction_coefficient"] == friction
                && row.number("material.young_modulus") == modulus
                && row["contact.rotation_speed_rpm"].starts_with('-') == (speed == "-")
        });
        let numbers =
            |row: &Row| row.numbers(["frequency_hz", "growth_rate_per_s", "critical_friction"]);
        own.map(numbers).collect()
    };
    let grows = answer.rows("modes.csv").iter().filter(|row| row["unstable"] == "true").count();
    let of_own = unstable.iter().filter(|row| row["friction_coefficient"] == "0.3");
    assert_eq!(of_own.count(), grows);
    assert!(grows > 4, "{grows}");
    for modulus in ["2.5e9", "5e9"] {
        let [one, other] = ["", "-"].map(|sign| at("0.3", modulus, sign));
        assert_eq!(one.len(), other.len());
        for (a, b) in one.iter().zip(&other) {
            let near = |x: f64, y: f64| (x - y).abs() < 1e-6 * x.abs();
            assert!((0..3).all(|k| near(a[k], b[k])), "{a:?} {b:?}");
            // It grows behind its critical friction.
            assert!(a[1] > 0.0 && a[2] < 0.3, "{a:?}");
        }
    }
    // The figure has a panel for each direction, the report its table.
    has(&answer.text("report.html"), &["unstable_modes.csv", "forward, speed", "reverse, speed"]);
    assert!(answer.path("figures/operating-matrix.png").exists());
}

#[test]
fn keys_that_go_together_take_the_same_values_at_every_point() {
    let case = study(
        "\n[sweep]\n\"contact.friction_coefficient\" = [0.2, 0.3]\n\
         \"damping.mass_coefficient\" = { values = { from = 1.0, to = 3.0, count = 3 }, also = \"cea.max_frequency_hz\" }\n",
    );
    let plan = SweepPlan::new(&case).unwrap();
    assert_eq!(plan.count(), 6);
    assert_eq!(
        Value::Object(plan.swept(2)),
        json!({ "contact.friction_coefficient": 0.2, "damping.mass_coefficient": 2, "cea.max_frequency_hz": 2 })
    );
    assert_eq!(plan.keys().len(), 3);
}

/// Two springs that go together: their keys end in the same word.
#[test]
fn keys_of_one_short_name_have_heads_of_their_own() {
    let sections = "[boundaries.outer]\ncondition = \"support\"\nnormal_stiffness = 1e12\n\
        tangential_stiffness = 1e12\n[cea]\nmodes = 8\nfriction_coefficients = [0.3]\n\
        [sweep]\nanalyses = [\"cea\"]\n\
        \"contact.normal_stiffness\" = { values = [1e12, 1e13], also = \"boundaries.outer.normal_stiffness\" }\n";
    let run = Run::new(&["sweep", "case.toml", "--format", "svg"]).out("out");
    let run = run.beside(&[("case.toml", coarse_disc(sections))]);
    let keys = ["contact.normal_stiffness", "boundaries.outer.normal_stiffness"];
    let html = run.done().says(&keys).text("report.html");
    let tables: Vec<&str> = html.split("<thead>").skip(1).collect();
    let heads = |table: &&str| -> Vec<String> {
        let row = table.split("</tr>").next().unwrap().split("</th>");
        row.map(|cell| cell.rsplit('>').next().unwrap().to_owned()).collect()
    };
    let tables: Vec<Vec<String>> = tables.iter().map(heads).collect();
    let of_keys = tables.iter().filter(|own| keys.iter().all(|key| own.contains(&key.to_string())));
    assert_eq!(of_keys.count(), 2, "modes and points: {tables:?}");
    for heads in &tables {
        let distinct: BTreeSet<&String> = heads.iter().collect();
        assert_eq!(distinct.len(), heads.len(), "{heads:?}");
    }
}

/// Files over all points are known beforehand: processes that share a folder write them.
#[test]
fn nothing_of_a_study_stays_where_another_one_takes_its_folder() {
    let folder = folder();
    let text = coarse_disc(
        "[cea]\nmax_frequency_hz = 12000\nfriction_coefficients = [0.0, 0.5]\n\
         [sweep]\nanalyses = [\"cea\"]\n\"contact.interference\" = [25e-6, 30e-6]\n",
    );
    fs::write(folder.path().join("disc.toml"), text).unwrap();
    let run = || Run::new(&["sweep", "disc.toml", "-q"]).within(&folder).out("out");
    let [table, figure] = ["unstable_modes.csv", "figures/operating-matrix.svg"];
    let first = run().done().wrote(table).wrote(figure);
    let other = "transient.duration=1e-3 ; sweep.analyses=[\"transient\"]";
    run().set(&[other]).args(&["--force", "--no-figures"]).done();
    assert!(![table, figure].map(|name| first.path(name).exists()).contains(&true));
}
