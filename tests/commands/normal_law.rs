//! `contact.normal_law` as a user meets it: cases, refusals, tables, the shipped case.

use crate::prelude::*;

fn run(command: &str, case: &Path, out: &Path, set: &[&str]) -> Answer {
    Run::of(command, case).args(&["--force"]).out(out).set(set).done()
}

/// Cross-method: harmonic by harmonic and over the whole mesh, eigenvalues and derivatives by the law's numbers agree.
#[test]
fn both_methods_have_the_same_tables() {
    let folder = folder();
    let case = folder.path().join("disc.toml");
    fs::write(&case, include_str!("refused/stiffening.toml")).unwrap();
    let sensitivities = |method: &str| -> Vec<[f64; 5]> {
        let set = [&format!("cea.method={method}"), "cea.sensitivities=true"];
        let answer = run("cea", &case, &folder.path().join(method), &set);
        let (rate, hz) = ("growth_rate_per_s", "frequency_hz");
        let by_height = ["growth_rate_per_height", "frequency_hz_per_height"];
        let names = [rate, hz, by_height[0], by_height[1], "frequency_hz_per_reference_pressure"];
        columns(&answer.rows("sensitivities.csv"), names)
    };
    let (cyclic, sparse) = (sensitivities("cyclic"), sensitivities("sparse"));
    let mut compared = 0;
    for own in &sparse {
        let apart = |row: &&[f64; 5]| (row[0] - own[0]).hypot(row[1] - own[1]);
        let same = nearest_by(&cyclic, apart);
        assert!(apart(&same) < 1e-6 * own[1].abs());
        for (a, b) in own.iter().zip(same).skip(2) {
            // Differences of matrices with a step of 1e-4.
            let scale = own[1] / 2e-6;
            assert!((a - b).abs() < 1e-5 * b.abs() + 1e-9 * scale, "{own:?} {same:?}");
            compared += 1;
        }
    }
    assert!(compared > 6);
}

/// The law of a case stands in place of the constant stiffness that an input file gives.
#[test]
fn a_law_of_the_case_replaces_the_stiffness_of_an_input_file() {
    let path = shipped("brake.toml");
    let own = fs::read_to_string(&path).unwrap();
    let read = |text: &str| case_of(&path, text, AS_IT_IS);
    let law = "normal_law = \"exponential\"\nreference_pressure = 1e5\nheight = 1e-6\n";
    let sections = ["Outer", "Inner"].map(|pad| format!("[contacts.{pad}_Friction_face]\n{law}"));
    let (plain, stiffening) = (read(&own), read(&(own.clone() + &sections.concat())));
    let [plain, stiffening] =
        [&plain, &stiffening].map(|case| &case.body.assembly().unwrap().contacts);
    assert_eq!(plain.len(), 2);
    for (old, new) in plain.iter().zip(stiffening) {
        let linear = old.stiffness.normal_stiffness.unwrap();
        assert!(old.stiffness.law.is_none() && (linear / 2e13 - 1.0).abs() < 1e-12);
        assert!(new.stiffness.law.is_some() && new.surface == old.surface);
    }
}

/// The shipped case: critical friction moves with the pressure of the brake, and hardly on a contact of constant stiffness.
#[test]
fn critical_friction_of_the_shipped_case_depends_on_the_brake_pressure() {
    let case = shipped("brake-pressure.toml");
    let folder = folder();
    let pressures = [2.5e5, 5e5];
    let lowest = |case: &Path| -> [f64; 2] {
        let coarse = ["cea.max_frequency_hz=10500.0 ; cea.friction_coefficients=[0.0, 0.5] ; \
             sweep.\"boundaries.back.pressure\"=[2.5e5, 5e5]"];
        let out = folder.path().join("out");
        run("sweep", case, &out, &coarse);
        let rows = rows(&out.join("stability.csv"));
        pressures.map(|pressure| {
            let own = rows.iter().filter(|row| row.number("boundaries.back.pressure") == pressure);
            own.map(|row| row.number("critical_friction")).fold(f64::INFINITY, f64::min)
        })
    };
    // From 0.387 to 0.249: the pair's other mode is on the springs of the lining.
    let [low, high] = lowest(case.as_ref());
    assert!(low > 0.35 && low < 0.42 && high < 0.7 * low, "{low} {high}");
    // The same contact without a law, from a case of its own: only the geometric stiffness follows the pressure.
    let text = fs::read_to_string(&case).unwrap();
    let lines = text.lines().map(|line| match line.split(' ').next() {
        Some("normal_law") => "normal_stiffness = 5e11".to_owned(),
        Some("reference_pressure" | "height") => String::new(),
        Some("file") => format!("file = {:?}", shipped("meshes/pressed-pad.msh")),
        _ => line.to_owned(),
    });
    let constant = folder.path().join("constant.toml");
    fs::write(&constant, lines.collect::<Vec<_>>().join("\n")).unwrap();
    let [low, high] = lowest(&constant);
    assert!((high / low - 1.0).abs() < 1e-3, "{low} {high}");
}
