//! `frictionsim convergence`: observed orders against the theory of the elements, the table of a transient, and what it refuses.

use crate::prelude::*;

/// A coarse disc; every test adds its analyses.
fn disc(sections: &str) -> String {
    disc_of([36, 8], sections)
}

const CEA: &str = "[cea]\nmax_frequency_hz = 9000.0\nfriction_coefficients = [0.0, 0.5]\n";

fn study(text: &str) -> Run {
    Run::new(&["convergence", "disc.toml", "-q"]).beside(&[("disc.toml", text)]).out("out")
}

fn summary(text: &str, set: &[&str]) -> Value {
    study(text).args(&["--json", "--no-figures"]).set(set).done().value()
}

fn quantities(series: &Value) -> &Vec<Value> {
    series["quantities"].as_array().unwrap()
}

/// Eigenvalues converge with twice the degree; coarse meshes are not quite asymptotic.
#[test]
fn eigenvalues_converge_with_twice_the_degree_of_the_elements() {
    let coarse = ["mesh.element=quad8 ; mesh.circumferential_elements=16 ; mesh.radial_elements=4"];
    let levels = [("[1, 2, 4]", &[][..], 2.0, 0.2), ("[1, 1.5, 2.25]", &coarse, 4.0, 0.5)];
    for (factors, set, wanted, bound) in levels {
        let text = disc(&format!("{CEA}[convergence]\nfactors = {factors}\n"));
        let summary = summary(&text, set);
        let all = quantities(&summary["series"][0]);
        let is_of = |q: &&Value, name: &str| q["name"].as_str().unwrap().starts_with(name);
        let own = all.iter().filter(|q| is_of(q, "frequency"));
        let orders: Vec<f64> = own.map(|q| q["order"].as_f64().unwrap()).collect();
        // n = 0 once and n = 1 in both directions.
        within(&orders, &[wanted; 3], bound);
        assert_eq!(all.iter().find(|q| is_of(q, "critical")).unwrap()["verdict"], "converging");
    }
}

#[test]
fn richardson_of_coarse_meshes_comes_nearer_to_a_fine_one_than_the_finest_of_them() {
    let [coarse, fine] = ["1, 1.5, 2.25", "4, 6, 8"].map(|factors| {
        let text = disc(&format!("{CEA}[convergence]\nfactors = [{factors}]\n"));
        let mut own = quantities(&summary(&text, &[])["series"][0]).clone();
        own.retain(|q| q["name"].as_str().unwrap().starts_with("frequency"));
        own
    });
    let limit = |q: &Value| q["extrapolated"].as_f64().unwrap();
    for (coarse, fine) in coarse.iter().zip(&fine) {
        assert_eq!(coarse["name"], fine["name"]);
        let exact = limit(fine);
        let finest = coarse["values"][2].as_f64().unwrap();
        let gain = (finest - exact).abs() / (limit(coarse) - exact).abs();
        assert!(gain > 3.0, "{}: {gain}", coarse["name"]);
    }
}

#[test]
fn a_transient_is_tabled_over_mesh_and_time_step_with_figures_and_report() {
    let text = disc(&format!(
        "{CEA}[transient]\nduration = 0.002\n[transient.perturbation]\nharmonics = [2]\n\
         [convergence]\nfactors = [0.5, 0.75, 1]\n\
         time_step_factors = [1, 0.5, 0.25]\n"
    ));
    let files =
        "convergence.csv summary.json report.html figures/convergence.svg figures/convergence.pdf";
    let said = "cea over the mesh ; transient over the mesh ; transient over the time step";
    let answer = study(&text).done().wrote(files).says(&[said]);
    let printed = &answer.stdout;
    // What decides is printed, the other modes are in the table.
    let left = printed.lines().find(|line| line.contains("--verbose"));
    assert!(left.is_some_and(|line| line.contains("do not grow")), "{printed}");
    assert!(printed.lines().count() < 60, "{printed}");
    let summary = answer.summary();
    let [cea, mesh, step] = [0, 1, 2].map(|k| &summary["series"][k]);
    assert_eq!(cea["levels"], json!(["18 x 4", "27 x 6", "36 x 8"]));
    let steps: Vec<f64> = serde_json::from_value(step["sizes"].clone()).unwrap();
    // A quarter of a step that divides the sample interval divides it too.
    assert!((steps[0] / steps[2] - 4.0).abs() < 1e-12, "{steps:?}");
    let rows = [cea, mesh, step].map(|s| 3 * quantities(s).len());
    assert_eq!(answer.text("convergence.csv").lines().count(), 1 + rows.iter().sum::<usize>());
    // The finest mesh and the longest step are the case itself: both series hold the same run.
    for (a, b) in quantities(mesh).iter().zip(quantities(step)) {
        assert_eq!((&a["name"], &a["values"][2]), (&b["name"], &b["values"][0]));
    }
}

#[test]
fn limit_cycles_are_compared_harmonic_by_harmonic_and_doubtful_levels_are_named() {
    let text = disc("[cycle]\nharmonics = [1, 2]\n[convergence]\nfactors = [2, 2.5, 3]\n");
    let found = summary(&text, &[]);
    let series = found["series"].as_array().unwrap();
    let names: Vec<&str> = series.iter().map(|s| s["analysis"].as_str().unwrap()).collect();
    assert_eq!(names, ["cycle-n1", "cycle-n1-onset2", "cycle-n2"]);
    // Transients: 270 x 52 elements, last fifth of 50 ms; for the second onset 180 x 35, started on the cycle.
    for (series, wanted) in series.iter().zip([10229.8, 7667.4, 9431.5]) {
        let frequency = &quantities(series)[0];
        assert_eq!(frequency["name"], "main frequency");
        let finest = frequency["values"][2].as_f64().unwrap();
        assert!((finest / wanted - 1.0).abs() < 3e-3, "{finest}");
    }
    let text = text.replace("[2, 2.5, 3]", "[1, 1.5, 2]").replace("[1, 2]", "[2]");
    let found = summary(&text, &[]);
    let notes = found["series"][0]["notes"].to_string();
    has(&notes, &["36 x 8: NOT CONFIRMED ; 54 x 12: the wave on 54 elements"]);
    assert_eq!(quantities(&found["series"][0])[0]["verdict"], "missing");
}

/// At friction 0.5 a branch that has an onset before is none of the ten lowest modes: no shape tells it on other meshes.
#[test]
fn onsets_are_compared_of_branches_that_have_a_mode_at_the_friction_of_the_case() {
    let mesh = plane_block([0.04, 0.03], [4, 3], ["face", "back", "body"]);
    let text = include_str!("../cases/falling-friction-of-a-coarse-block.toml");
    let files = [("disc.toml", text.as_bytes()), ("part.msh", &mesh)];
    let run = Run::new(&["convergence", "disc.toml", "-q"]).beside(&files).out("out");
    let found = run.args(&["--json", "--no-figures"]).done().value();
    let names = quantities(&found["series"][0]).iter().map(|own| own["name"].as_str().unwrap());
    let onsets: Vec<&str> = names.filter(|name| name.starts_with("critical")).collect();
    assert_eq!(onsets, ["1", "3", "4"].map(|n| format!("critical friction, mode {n}")));
}

/// A body of revolution on its whole mesh is refined as it is generated: no cylinder fits into the straight edges of split elements.
#[test]
fn a_body_of_revolution_on_its_whole_mesh_stays_round_when_it_is_refined() {
    let sections = "[cea]\nmethod = \"sparse\"\nmodes = 4\n[convergence]\nfactors = [1, 2, 4]\n";
    let solid = "axial_elements = 1\n[material]\nformulation = \"three-dimensional\"\n";
    let text = disc(sections).replace("[material]\n", solid);
    let read = |counts: [usize; 3]| {
        let names = ["circumferential", "radial", "axial"];
        let set = names.iter().zip(counts).map(|(n, count)| format!("mesh.{n}_elements={count}"));
        case_of("disc.toml", &text, &set.collect::<Vec<_>>())
    };
    assert_eq!(read([12, 2, 1]).refined(2.0).unwrap().body, read([24, 4, 2]).body);

    // Its modes are recognised on finer meshes, whose nodes stand in another order: frequencies are those by harmonics.
    let set = ["mesh.circumferential_elements=12 ; mesh.radial_elements=2"];
    let [whole, waves] = ["sparse", "auto"].map(|method| {
        let found = summary(&text.replace("sparse", method), &set);
        let own = quantities(&found["series"][0]).iter().filter(|own| own["unit"] == "Hz");
        own.map(|own| own["values"][2].as_f64().unwrap()).collect::<Vec<f64>>()
    });
    assert!(whole.len() >= 6, "{whole:?}");
    for value in whole {
        let nearest = *nearest_by(&waves, |own| (*own - value).abs());
        assert!((nearest - value).abs() < 1e-6 * value.abs(), "{value} {waves:?}");
    }
}

/// Its counts take the factors that those of a disc at rest take, rounded alike.
#[test]
fn a_generated_disc_that_turns_is_refined_by_its_counts() {
    let motion = "[motion.disc]\naxis = [0.0, 0.0, 1.0]\nrotation_speed_rpm = 60.0\n";
    let solid = "axial_elements = 1\n[material]\nformulation = \"three-dimensional\"\n";
    let text = disc(&format!("{motion}[cea]\nmodes = 4\n[convergence]\n"));
    let text = text.replace("[material]\n", solid);
    let read = |[around, radial, axial]: [usize; 3]| {
        let around = format!("mesh.circumferential_elements={around}");
        let [radial, axial] = [("radial", radial), ("axial", axial)]
            .map(|(name, count)| format!("mesh.{name}_elements={count}"));
        case_of("disc.toml", &text, &[around, radial, axial])
    };
    let case = read([12, 2, 1]);
    assert_eq!(case.convergence.as_ref().unwrap().factors, [1.0, 1.5, 2.25]);
    assert_eq!(case.refined(2.25).unwrap().body, read([27, 5, 2]).body);
}
