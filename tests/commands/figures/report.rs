//! The report of an analysis, written to a folder.

use crate::figures::synthetic;
use frictionsim::fem::{NodalStress, RayleighDamping};
use frictionsim::results::cea::{BaseField, BaseState, CeaReport, draw};
use frictionsim::results::{DrawingOptions, Manifest, OutputFolder, Replace};
use std::time::Instant;

#[test]
fn report_of_an_eigenvalue_analysis_holds_every_figure_table_and_the_case() {
    let mesh = synthetic::mesh(180, 35);
    let mut sweep = synthetic::sweep(11);
    for index in [0, 3, 8] {
        let friction = sweep.points[index].friction_coefficient;
        sweep.points[index].modes = synthetic::modes(friction, Some(&mesh));
    }
    let contact = &mesh.contact_edge().nodes;
    let field = BaseField {
        is_pressed: None,
        nodes: contact.clone(),
        angles: contact
            .iter()
            .map(|&node| mesh.frame_angles()[node as usize])
            .collect(),
        pressures: vec![2.827e6; contact.len()],
        shears: vec![0.848e6; contact.len()],
        displacement: vec![0.0; 2 * mesh.node_count()],
        stress: mesh
            .nodes
            .iter()
            .map(|p| NodalStress {
                radial: -2.8e6 * (0.0205 / p[0].hypot(p[1])).powi(2),
                ..NodalStress::default()
            })
            .collect(),
    };
    let frictions: Vec<f64> = sweep
        .points
        .iter()
        .map(|p| p.friction_coefficient)
        .collect();
    let report = CeaReport {
        has_harmonics: true,
        title: "Polycarbonate disc",
        mesh: &mesh,
        dofs: 12_420,
        method: "cyclic",
        selection: "below 17500 Hz".into(),
        friction_coefficients: &frictions,
        sweep: &sweep,
        base: BaseState {
            friction_coefficient: 0.3,
            slipping: 180,
            sticking: 0,
            open: 0,
            pressure_pa: [2.827e6; 2],
            shear_pa: [0.848e6; 2],
            torque_n_m: Some(20.15),
            drag_n: None,
            power_w: 1287.0,
        },
        field: &field,
        solid: None,
        assembly: None,
        sensitivities: None,
        map: None,
        notes: vec![],
        wall_s: 1.2,
    };
    let damping = RayleighDamping {
        mass_coefficient: synthetic::MASS_COEFFICIENT,
        stiffness_coefficient: synthetic::STIFFNESS_COEFFICIENT,
    };
    let manifest = Manifest {
        case_text: "[mesh]\ncircumferential_elements = 180\n".into(),
        case_file: "disc.toml".into(),
        ..Manifest::new("cea")
    };
    let path = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("report");
    let folder = OutputFolder::open(&path, &manifest, Replace::Anything).unwrap();
    let start = Instant::now();
    draw(&folder, &report, damping, &DrawingOptions::default()).unwrap();
    println!("figures and report in {:?}", start.elapsed());
    folder.finish().unwrap();
    let text = std::fs::read_to_string(path.join("report.html")).unwrap();
    for wanted in [
        "<h1>Polycarbonate disc</h1>",
        "Critical friction of each branch",
        "Eigenvalues at friction coefficient 0.3",
        "circumferential_elements = 180",
        "Figure 1.",
    ] {
        assert!(text.contains(wanted), "{wanted}");
    }
    for name in [
        "locus",
        "pairs",
        "prestress",
        "modes-mu-0.3",
        "branch-n1-0-against",
    ] {
        assert!(text.contains(&format!("<figure id=\"{name}\">")), "{name}");
        for extension in ["svg", "png"] {
            let file = path.join(format!("figures/{name}.{extension}"));
            assert!(std::fs::metadata(file).unwrap().len() > 1000);
        }
    }
}
