//! `contacts.*.gap`: a measured surface beside a case.

use crate::prelude::*;

fn brake(folder: &TempDir) {
    fs::create_dir(folder.path().join("meshes")).unwrap();
    for name in ["brake.toml", "meshes/brake.inp"] {
        fs::copy(shipped(name), folder.path().join(name)).unwrap();
    }
}

/// The face of the outer lining, worn by `gap` of the angle from its middle (degrees) and the radius (m).
fn table(header: &str, gap: impl Fn(f64, f64) -> f64) -> String {
    let mut text = format!("{header}\n");
    for i in 0..=20 {
        for j in 0..=40 {
            let (radius, angle) = (0.070 + 0.002 * f64::from(i), f64::from(j) * 1.3 - 26.0);
            let (sine, cosine) = (90.0 + angle).to_radians().sin_cos();
            let (x, y) = (radius * cosine, radius * sine);
            writeln!(text, "{x:.6},{y:.6},0.006,{:.4e}", gap(angle, radius)).unwrap();
        }
    }
    text
}

fn cea(folder: &Path, set: &[&str]) -> Answer {
    let run = Run::of("cea", "brake.toml").within(folder).out("run").args(&["--force"]);
    let run = run.args(&["--unset", "cea.max_frequency_hz"]);
    run.set(&["cea.modes=1", "cea.friction_coefficients=[0.4]"]).set(set).end()
}

const GAP: &str = "contacts.Outer_Friction_face.gap=wear.csv";

/// Worn by a millimetre beyond a third of its arc, far more than the pressure closes.
#[test]
fn a_pad_that_is_worn_at_one_end_touches_at_the_other_and_keeps_its_table() {
    let folder = folder();
    brake(&folder);
    let worn = table("x,y,z,gap", |angle, _| if angle > 8.0 { 1e-3 } else { 0.0 });
    fs::write(folder.path().join("wear.csv"), &worn).unwrap();
    let answer = cea(folder.path(), &[GAP]).code(0);
    assert_eq!(answer.text("gap-Outer_Friction_face.csv"), worn);
    let points = answer.rows("prestress.csv");
    let mut counts = [[0; 2]; 2];
    for row in points.iter().filter(|row| row["contact"].starts_with("Outer")) {
        let [x, y] = row.numbers(["x_m", "y_m"]);
        let angle = y.atan2(x).to_degrees() - 90.0;
        let is_open = usize::from(row["status"] == "open");
        if angle > 9.5 {
            counts[1][is_open] += 1;
        } else if angle < -5.0 {
            counts[0][is_open] += 1;
        }
    }
    let [[_, _], [closed, worn_open]] = counts;
    assert!(closed == 0 && worn_open > 100, "{counts:?}");
    assert!(counts[0][0] > 100, "{counts:?}");
}

#[test]
fn measured_surfaces_that_cannot_be_meant_are_refused_with_the_remedy() {
    let folder = folder();
    brake(&folder);
    let write = |text: String| fs::write(folder.path().join("wear.csv"), text).unwrap();
    let refused = |set: &[&str], parts: &[&str]| {
        let answer = cea(folder.path(), set).warns(parts);
        assert_ne!(answer.code, Some(0));
    };
    refused(&[GAP], &["cannot read the table", "wear.csv"]);
    // The last is in millimetres, without saying so.
    let millimetres = table("x,y,z,gap", |_, _| 1e-6).replace("0.006", "6");
    for (text, said) in [
        (table("x,y,z,gap_um", |_, _| 1.0), "give x, y, z and gap in m"),
        (table("x,y,z", |_, _| 1.0), "contacts.Outer_Friction_face.gap"),
        (millimetres, "no measured point of wear.csv ; in metres, in the coordinates of the mesh"),
    ] {
        write(text);
        refused(&[GAP], &[said]);
    }
    write(table("x,y,z,gap", |_, _| 1e-6));
    let closed = ["Outer", "Inner"].map(|pad| format!("contacts.{pad}_Friction_face.state=closed"));
    refused(
        &[GAP, &closed[0], &closed[1]],
        &["closed and free of stress", "leave one of the two out"],
    );
}
