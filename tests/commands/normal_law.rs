//! `contact.normal_law` as a user meets it: cases, refusals, tables, the shipped case.

use assert_cmd::Command;
use frictionsim::case::Case;
use std::path::Path;

const DISC: &str = r#"
[geometry]
inner_radius = 0.0205
outer_radius = 0.0905
[mesh]
circumferential_elements = 24
radial_elements = 5
[material]
young_modulus = 2.5e9
poisson_ratio = 0.38
density = 1228.0
formulation = "plane-strain"
[damping]
mass_coefficient = 40.0
stiffness_coefficient = 4.5e-7
[contact]
friction_coefficient = 0.3
interference = 25e-6
rotation_speed_rpm = 610.0
normal_law = "exponential"
reference_pressure = 2e5
height = 2e-6
[cea]
friction_coefficients = [0.0, 0.3]
modes = 8
[frf]
boundary = "sliding"
frequencies_hz = [5000.0, 9000.0]
force_node = 10
response_node = 22
"#;

fn read(text: &str, overrides: &[&str]) -> Result<Case, String> {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Case::parse("disc.toml", text.as_bytes(), &overrides).map_err(|errors| errors.to_string())
}

fn run(command: &str, case: &Path, out: &Path, set: &[&str]) -> String {
    let mut program = Command::cargo_bin("frictionsim").unwrap();
    program.arg(command).arg(case).arg("--out").arg(out);
    program.args(["--force", "--no-figures"]);
    for text in set {
        program.args(["--set", text]);
    }
    let output = program.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn numbers_that_a_law_lacks_or_does_not_have_are_said_with_their_key() {
    read(DISC, &[]).unwrap();
    let linear = DISC.replace("normal_law = \"exponential\"", "");
    for (text, set, part) in [
        (DISC, "contact.height=-1e-6", "contact.height"),
        (DISC, "contact.normal_stiffness=1e12", "has no effect with normal_law = \"exponential\""),
        (DISC, "contact.normal_law=cubic", "contact.reference_pressure has no effect"),
        (DISC, "contact.loss_factor=2", "contact.loss_factor = 2"),
        (&linear, "contact.friction_coefficient=0.2", "has no effect with normal_law = \"linear\""),
    ] {
        let message = read(text, &[set]).unwrap_err();
        assert!(message.contains(part), "{set}: {message}");
    }
    let cubic = DISC
        .replace("exponential", "cubic")
        .replace("reference_pressure = 2e5", "cubic_stiffness = 1e23")
        .replace("height = 2e-6", "normal_stiffness = \"rigid\"");
    let message = read(&cubic, &[]).unwrap_err();
    assert!(message.contains("does not stiffen"), "{message}");
    let rigid = linear
        .replace("reference_pressure = 2e5", "loss_factor = 0.1")
        .replace("height = 2e-6", "");
    let message = read(&rigid, &[]).unwrap_err();
    assert!(message.contains("rigid contact, which stores no energy"), "{message}");
    let solid = DISC
        .replace("plane-strain", "three-dimensional")
        .replace("[mesh]", "thickness = 0.009\n[mesh]\naxial_elements = 2");
    read(&solid, &[]).unwrap();
    // Rotating waves, where transients and basins begin, are those of rigid contact.
    let wave = "transient={ duration=1e-4, initial=\"limit-cycle\", limit_cycle_harmonic=1 }";
    let message = read(DISC, &[wave]).unwrap_err();
    assert!(message.contains("rotating wave of rigid contact"), "{message}");
    let basin = read(DISC, &["basin={}", "cycle={}"]).unwrap();
    assert!(!basin.has_rotating_waves());
    assert!(basin.require_basin().is_ok());
    let free =
        "boundaries.outer={ condition = \"support\", tangential_damping = 1.0, loss_factor = 0.1 }";
    let message = read(DISC, &[free]).unwrap_err();
    assert!(message.contains("support without springs"), "{message}");
}

/// Cross-method: harmonic by harmonic and over the whole mesh, eigenvalues, derivatives by the law's numbers and responses agree.
#[test]
fn both_methods_have_the_same_tables() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("disc.toml");
    std::fs::write(&case, DISC).unwrap();
    let number = |row: &csv::StringRecord, columns: &csv::StringRecord, name: &str| -> f64 {
        let place = columns.iter().position(|column| column == name);
        row[place.unwrap_or_else(|| panic!("{name} in {columns:?}"))].parse().unwrap_or(f64::NAN)
    };
    let sensitivities = |method: &str| {
        let out = folder.path().join(method);
        let method = format!("cea.method={method}");
        run("cea", &case, &out, &[&method, "cea.sensitivities=true"]);
        let mut table = csv::Reader::from_path(out.join("sensitivities.csv")).unwrap();
        let columns = table.headers().unwrap().clone();
        let names = ["growth_rate_per_s", "frequency_hz", "growth_rate_per_height"];
        let names =
            [&names[..], &["frequency_hz_per_height", "frequency_hz_per_reference_pressure"]];
        let rows = table.records().map(|row| {
            let row = row.unwrap();
            names.concat().iter().map(|name| number(&row, &columns, name)).collect::<Vec<f64>>()
        });
        rows.collect::<Vec<_>>()
    };
    let (cyclic, sparse) = (sensitivities("cyclic"), sensitivities("sparse"));
    let mut compared = 0;
    for own in &sparse {
        let apart = |row: &&Vec<f64>| (row[0] - own[0]).hypot(row[1] - own[1]);
        let same = cyclic.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap();
        assert!(apart(&same) < 1e-6 * own[1].abs());
        for (a, b) in own.iter().zip(same).skip(2) {
            // Differences of matrices with a step of 1e-4.
            let scale = own[1] / 2e-6;
            assert!((a - b).abs() < 1e-5 * b.abs() + 1e-9 * scale, "{own:?} {same:?}");
            compared += 1;
        }
    }
    assert!(compared > 6);
    let response = |method: &str| {
        let out = folder.path().join(format!("frf-{method}"));
        let method = format!("frf.method={method}");
        run("frf", &case, &out, &[&method]);
        std::fs::read_to_string(out.join("frf.csv")).unwrap()
    };
    let numbers = |text: String| -> Vec<f64> {
        let all = text.split([',', '\n']).filter_map(|cell| cell.parse().ok());
        all.collect()
    };
    let [a, b] = ["cyclic", "direct"].map(|method| numbers(response(method)));
    assert!(a.len() == b.len() && a.len() > 5);
    let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).abs() < 1e-7 * b.abs().max(1e-12 * largest(&[*b])), "{a} {b}");
    }
}

/// The law of a case stands in place of the constant stiffness that an input file gives.
#[test]
fn a_law_of_the_case_replaces_the_stiffness_of_an_input_file() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/brake.toml");
    let own = std::fs::read_to_string(&path).unwrap();
    let read = |text: &str| Case::parse(path.to_str().unwrap(), text.as_bytes(), &[]).unwrap();
    let law = "normal_law = \"exponential\"\nreference_pressure = 1e5\nheight = 1e-6\n";
    let sections = ["Outer", "Inner"].map(|pad| format!("[contacts.{pad}_Friction_face]\n{law}"));
    let (plain, stiffening) = (read(&own), read(&(own.clone() + &sections.concat())));
    let [plain, stiffening] =
        [&plain, &stiffening].map(|case| &case.body.assembly().unwrap().contacts);
    assert_eq!(plain.len(), 2);
    for (old, new) in plain.iter().zip(stiffening) {
        let linear = old.stiffness.normal_stiffness.unwrap();
        assert!(old.law.is_none() && (linear / 2e13 - 1.0).abs() < 1e-12);
        assert!(new.law.is_some() && new.surface == old.surface);
    }
}

/// The shipped case: critical friction moves with the pressure of the brake, and hardly on a contact of constant stiffness.
#[test]
fn critical_friction_of_the_shipped_case_depends_on_the_brake_pressure() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/brake-pressure.toml");
    let folder = tempfile::tempdir().unwrap();
    let pressures = [2.5e5, 5e5];
    let lowest = |case: &Path| -> [f64; 2] {
        let coarse = [
            "cea.max_frequency_hz=10500.0",
            "cea.friction_coefficients=[0.0, 0.5]",
            "sweep.\"boundaries.back.pressure\"=[2.5e5, 5e5]",
        ];
        let out = folder.path().join("out");
        run("sweep", case, &out, &coarse);
        let mut table = csv::Reader::from_path(out.join("stability.csv")).unwrap();
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        let number = |row: &csv::StringRecord, place: usize| row[place].parse::<f64>();
        pressures.map(|pressure| {
            let own = rows.iter().filter(|row| number(row, 0) == Ok(pressure));
            let critical = own.filter_map(|row| number(row, 4).ok());
            critical.fold(f64::INFINITY, f64::min)
        })
    };
    // From 0.387 to 0.249: the pair's other mode is on the springs of the lining.
    let [low, high] = lowest(&case);
    assert!(low > 0.35 && low < 0.42 && high < 0.7 * low, "{low} {high}");
    // The same contact without a law, from a case of its own: only the geometric stiffness follows the pressure.
    let text = std::fs::read_to_string(&case).unwrap();
    let lines = text.lines().map(|line| match line.split(' ').next() {
        Some("normal_law") => "normal_stiffness = 5e11".to_owned(),
        Some("reference_pressure" | "height") => String::new(),
        Some("file") => {
            let mesh = case.with_file_name("meshes/pressed-pad.msh");
            format!("file = {mesh:?}")
        }
        _ => line.to_owned(),
    });
    let constant = folder.path().join("constant.toml");
    std::fs::write(&constant, lines.collect::<Vec<_>>().join("\n")).unwrap();
    let [low, high] = lowest(&constant);
    assert!((high / low - 1.0).abs() < 1e-3, "{low} {high}");
}
