//! Squeal of systems with a sliding point contact. Cross-method: responses know no modes.
//!
//! Source: P. Duffour, J. Woodhouse, Instability of systems with a frictional point contact, part 1, J. Sound Vib. 271 (2004)
//! 365. With one contact point on a rigid slider every eigenvalue is a root of
//!
//! ```text
//! G_nn(lambda) + mu G_nt(lambda) = 0,
//! ```
//!
//! `G_nn`, `G_nt` the normal response of the body without contact to a normal force and to one along the sliding. At a
//! critical friction of `cea` the root lies on the axis, where `frf` has both responses.

use super::*;

#[test]
fn duffour_woodhouse_critical_friction_is_a_root_of_two_responses() {
    // A leaning block stands on its edge: one node of its face touches the plane.
    let xs: Vec<f64> = (0..=8).map(|i| 0.03 * (f64::from(i) / 8.0 - 0.5)).collect();
    let ys: Vec<f64> = (0..=10).map(|j| f64::from(j) / 10.0).collect();
    let mesh = quadrilaterals(&xs, &ys, ["face", "top", "body"], |x, share| {
        let y = 0.1 * x.abs() * (1.0 - share) + 0.05 * share;
        [x - y, y]
    });
    let folder = folder("duffour_woodhouse", &mesh);
    let body = include_str!("../../cases/duffour-woodhouse.toml");
    let cea = "[cea]\nmodes = 6\nfriction_coefficients = { from = 0.0, to = 0.4, count = 5 }\n\
               geometric_stiffness = false\n";
    let onsets = table(&folder, "cea", &format!("{body}{cea}"), "", "stability.csv");
    let pressed = rows(&folder.join("cea/prestress.csv"));
    assert_eq!(pressed.iter().filter(|node| node.number("pressure_pa") > 0.0).count(), 1);
    assert!(!onsets.is_empty());
    for onset in &onsets {
        let response = |direction: &str| {
            let frf = format!(
                "[frf]\nboundary = \"clamped\"\nforce_node = {{ x = 0.0, y = 0.0 }}\nforce_direction = \"{direction}\"\n\
                 response_node = {{ x = 0.0, y = 0.0 }}\nresponse_direction = \"y\"\nquantity = \"receptance\"\n\
                 method = \"direct\"\nfrequencies_hz = [{:?}]\n",
                onset.number("frequency_hz")
            );
            let line = &table(&folder, "frf", &format!("{body}{frf}"), "", "frf.csv")[0];
            c64::new(line.number("receptance_real"), line.number("receptance_imaginary"))
        };
        let (normal, along) = (response("y"), response("x"));
        let rest = normal + along * onset.number("critical_friction");
        assert!(rest.norm() < 1e-6 * normal.norm(), "{onset:?}: {normal} {along}");
    }
}
