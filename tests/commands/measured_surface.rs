//! `contacts.*.gap`: a measured surface beside a case.

use crate::prelude::*;

/// The face of the outer lining worn by a millimetre beyond a third of its arc, far more than the pressure closes.
#[test]
fn a_pad_that_is_worn_at_one_end_touches_at_the_other_and_keeps_its_table() {
    let mut worn = "x,y,z,gap\n".to_owned();
    for (i, j) in (0..=20).flat_map(|i| (0..=40).map(move |j| (i, j))) {
        let (radius, angle) = (0.070 + 0.002 * f64::from(i), f64::from(j) * 1.3 - 26.0);
        let [x, y, z] = polar([radius, (90.0 + angle).to_radians(), 0.006]);
        writeln!(worn, "{x:.6},{y:.6},{z},{:e}", if angle > 8.0 { 1e-3 } else { 0.0 }).unwrap();
    }
    let folder = folder_with(&[("wear.csv", worn.as_bytes())]);
    fs::create_dir(folder.path().join("meshes")).unwrap();
    for name in ["brake.toml", "meshes/brake.inp"] {
        fs::copy(shipped(name), folder.path().join(name)).unwrap();
    }
    let run = Run::of("cea", "brake.toml").within(&folder).out("run");
    let set = "contacts.Outer_Friction_face.gap=wear.csv ; cea.modes=1 ; \
               cea.friction_coefficients=[0.4]";
    let answer = run.args(&["--unset", "cea.max_frequency_hz"]).set(&[set]).done();
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
