//! The report of an analysis, written to a folder.

use crate::synthetic;
use frictionsim::results::cea::figures::{CeaFigures, draw, html_report};
use frictionsim::results::cea::{BaseState, CeaReport};
use frictionsim::results::{Manifest, OutputFolder, Replace, write_report};
use std::time::Instant;

#[test]
fn report_of_an_eigenvalue_analysis_holds_every_figure_table_and_the_case() {
    let mesh = synthetic::mesh(180, 35);
    let mut sweep = synthetic::sweep(11);
    for index in [0, 3, 8] {
        let friction = sweep.points[index].friction_coefficient;
        sweep.points[index].modes = synthetic::modes(friction, Some(&mesh));
    }
    let frictions: Vec<f64> = sweep
        .points
        .iter()
        .map(|p| p.friction_coefficient)
        .collect();
    let report = CeaReport {
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
            torque_n_m: 20.15,
            power_w: 1287.0,
        },
        notes: vec![],
        wall_s: 1.2,
    };
    let data = CeaFigures {
        report: &report,
        mass_coefficient: synthetic::MASS_COEFFICIENT,
        stiffness_coefficient: synthetic::STIFFNESS_COEFFICIENT,
        prestress: None,
        map: None,
    };
    let manifest = Manifest {
        case_text: "[mesh]\ncircumferential_elements = 180\n".into(),
        case_file: "disc.toml".into(),
        ..Manifest::new("cea")
    };
    let start = Instant::now();
    let figures = draw(&data).unwrap();
    println!("{} figures drawn in {:?}", figures.len(), start.elapsed());
    let html = html_report(&data, figures.clone(), &manifest);
    let path = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("report");
    let folder = OutputFolder::open(&path, &manifest, Replace::Anything).unwrap();
    let start = Instant::now();
    write_report(&folder, &html).unwrap();
    println!("written as SVG, PNG and HTML in {:?}", start.elapsed());
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
    for figure in &figures {
        assert!(text.contains(&format!("<figure id=\"{}\">", figure.name)));
        for extension in ["svg", "png"] {
            let file = path.join(format!("figures/{}.{extension}", figure.name));
            assert!(std::fs::metadata(file).unwrap().len() > 1000);
        }
    }
}
