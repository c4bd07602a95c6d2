//! Mesh files of other programs on the command line.

use crate::prelude::*;

/// Closed form: a ring of 36 straight-sided sectors, and pads of 7 and 8 of them.
#[test]
fn the_statistics_of_a_brake_of_an_input_file_are_those_of_its_geometry() {
    let summary = Run::of("mesh", shipped("brake.toml")).out("out").done().summary();
    let mesh = &summary["mesh"];
    assert_eq!(mesh["nodes"], 1140);
    assert_eq!(mesh["elements_by_kind"]["hex8"], 592);
    // Disc, two linings, two plates.
    assert_eq!(mesh["bodies"], 5);
    // Sectors of so many degrees, inner and outer radius and thickness in mm, density.
    let mass = |sectors: f64, degrees: f64, radii: [f64; 2], thickness: f64, density: f64| {
        let triangle = 0.5 * sectors * degrees.to_radians().sin();
        1e-9 * density * triangle * (radii[1] * radii[1] - radii[0] * radii[0]) * thickness
    };
    for (name, exact) in [
        ("Disc_Disc_iron", mass(36.0, 10.0, [45.0, 110.0], 12.0, 7200.0)),
        ("Outer_Lining", mass(7.0, 50.0 / 7.0, [72.0, 106.0], 10.0, 2600.0)),
        ("Inner_Backplate", mass(8.0, 7.0, [70.0, 108.0], 5.0, 7850.0)),
    ] {
        let regions = mesh["regions"].as_array().unwrap();
        let region = regions.iter().find(|region| region["name"] == name).unwrap();
        // Coordinates have nine digits in the file.
        near_each(&[region["mass_kg"].as_f64().unwrap()], &[exact], 1e-7);
    }
    let boundaries = mesh["boundaries"].as_array().unwrap();
    for (name, condition) in [
        ("Disc_Bore", "clamped"),
        ("Disc_Upper_face", "counterface"),
        ("Inner_Friction_face", "contact"),
        ("Inner_Lining_glue", "tie"),
        ("Outer_Piston", "pressure"),
        ("Outer_Plate", "fixed"),
    ] {
        let boundary = boundaries.iter().find(|boundary| boundary["name"] == name);
        assert_eq!(boundary.unwrap()["condition"], condition, "{name}");
    }
    has(&summary["not_used"].to_string(), &["*COMPLEX FREQUENCY (line "]);
    let ties = "ties taken from meshes/brake.inp: Glue_Outer, Glue_Inner";
    has(&summary["notes"].to_string(), &[ties]);
}

/// Closed form: a polygon of 24 straight sides, around which each node has its share of the tangent.
#[test]
fn a_body_of_revolution_names_its_four_faces_and_the_one_that_a_ring_presses_on() {
    let coarse = "mesh.circumferential_elements=24 ; mesh.radial_elements=4 ; \
        mesh.axial_elements=2 ; mesh.element=quad4";
    let run = Run::of("mesh", shipped("ring-on-layer.toml")).out("out");
    let summary = run.set(&[coarse]).done().summary();
    let sine = (std::f64::consts::PI / 12.0).sin();
    let around = |radius: f64| 24.0 * radius * sine;
    let face = 12.0 * (0.0905f64.powi(2) - 0.0205f64.powi(2)) * sine;
    let rows = [
        ("inner", "free", 72, around(0.0205) * 0.009),
        ("outer", "clamped", 72, around(0.0905) * 0.009),
        ("top", "contact", 120, face),
        ("bottom", "guide", 120, face),
    ];
    let boundaries = summary["mesh"]["boundaries"].as_array().unwrap();
    for ((name, condition, nodes, area), found) in rows.iter().zip(boundaries) {
        assert_eq!((&found["name"], &found["condition"]), (&(*name).into(), &(*condition).into()));
        assert_eq!(found["nodes"], *nodes);
        near_each(&[found["area_m2"].as_f64().unwrap()], &[*area], 1e-12);
    }
}

#[test]
fn the_case_that_init_writes_for_an_input_file_runs_as_it_is() {
    let folder = folder_with(&[("brake.inp", &fs::read(shipped("meshes/brake.inp")).unwrap())]);
    let init = || Run::new(&["init", "--from", "brake.inp"]).within(&folder);
    init().done();
    let text = fs::read_to_string(folder.path().join("brake.toml")).unwrap();
    has(&text, &["file = \"brake.inp\"", "# Not used: *COMPLEX FREQUENCY"]);
    // Stress-free contacts: the base state of thousands of points is not what is tested here.
    let closed = ["Outer", "Inner"].map(|pad| format!("contacts.{pad}_Friction_face.state=closed"));
    let run = Run::of("cea", "brake.toml").within(&folder).out("out").set(&closed);
    let summary = run.set(&["cea.modes=2", "cea.friction_coefficients=[0.4]"]).done().summary();
    assert!(summary["largest_residual"].as_f64().unwrap() < 1e-8, "{summary}");
    // A second time nothing is replaced.
    init().refused(&[]);
}

/// The picture names every region and what holds, loads and touches the bodies; `plot` draws it again to the same bytes.
#[test]
fn the_picture_of_solid_bodies_names_regions_and_boundaries() {
    let answer = Run::new(&["mesh", &shipped("brake.toml")]).out("out").done();
    let drawn = answer.text("figures/mesh.svg");
    // Nothing of the case is a support.
    let words = "Disc_Disc_iron ; Outer_Lining ; Inner_Backplate ; contact ; counterface ; \
        clamped ; pressure ; tie ; free ; regions, turned over ; !>support<";
    has(&drawn, &[words]);
    has(&answer.text("report.html"), &["Outer_Piston", "mass (kg)"]);
    fs::remove_file(answer.path("figures/mesh.svg")).unwrap();
    Run::new(&["plot"]).args(&[&answer.out]).done();
    assert_eq!(answer.text("figures/mesh.svg"), drawn);
}

#[test]
fn fields_of_bodies_of_revolution_have_their_stress() {
    let coarse = ["mesh.circumferential_elements=16", "mesh.radial_elements=10"];
    let few = "cea.friction_coefficients=[0.2] ; cea.max_frequency_hz=8000.0";
    let short = "transient.duration=1e-4 ; output.snapshots=[1e-4]";
    for (command, changes, file) in
        [("cea", few, "prestress.vtu"), ("transient", short, "snapshots/snapshot-001.vtu")]
    {
        let run = Run::of(command, shipped("ring-on-layer.toml")).out("out");
        let fields = run.args(&["-qq"]).set(&coarse).set(&[changes]).done().bytes(file);
        let stress = ["von_mises_pa", "stress_zz_pa", "stress_rt_pa", "stress_rz_pa"];
        let stress = stress.map(|name| format!("Name=\"{name}\""));
        has(&String::from_utf8_lossy(&fields), &stress.each_ref().map(String::as_str));
    }
}
