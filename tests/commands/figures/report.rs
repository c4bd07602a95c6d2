//! The report of an analysis, written to a folder.

use crate::figures::{check_texts, synthetic};
use crate::prelude::*;
use frictionsim::results::cea::{figures, page};

#[test]
fn report_of_an_eigenvalue_analysis_holds_every_figure_table_and_the_case() {
    let mesh = synthetic::mesh(180, 35);
    let mut sweep = synthetic::sweep(11);
    for index in [0, 3, 8] {
        let friction = sweep.points[index].friction_coefficient;
        sweep.points[index].modes = synthetic::modes(friction, Some(&mesh));
    }
    let contact = &mesh.contact_edge().nodes;
    let angles = contact.iter().map(|&node| (node, mesh.frame_angles()[node as usize]));
    let angles: Vec<(u32, f64)> = angles.collect();
    let stress = mesh.nodes.iter().map(|p| NodalStress {
        radial: -2.8e6 * (0.0205 / p[0].hypot(p[1])).powi(2),
        ..NodalStress::default()
    });
    let field = synthetic::field(&mesh, &angles, |_| [2.827e6, 0.848e6], stress.collect());
    let frictions: Vec<f64> = sweep.points.iter().map(|p| p.friction_coefficient).collect();
    let solution = synthetic::solution(sweep);
    let report = synthetic::report(&mesh, &solution);
    let report = CeaReport { friction_coefficients: &frictions, ..report };
    let damping = rayleigh_damping(synthetic::MASS_COEFFICIENT, synthetic::STIFFNESS_COEFFICIENT);
    let dampings = [("damping *ζ*".to_owned(), damping)];
    let case_text = "[mesh]\ncircumferential_elements = 180\n".into();
    let manifest = Manifest { case_text, case_file: "disc.toml".into(), ..Manifest::new("cea") };
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("report");
    let folder = OutputFolder::open(&path, &manifest, Replace::Anything).unwrap();
    let draw = |folder: &OutputFolder, report: &CeaReport<'_>, options: &DrawingOptions| {
        let figures = figures(report, &field, &dampings);
        write_page(folder, page(report, &field), figures, options).unwrap();
    };
    draw(&folder, &report, &DrawingOptions::default());
    folder.finish().unwrap();
    for width in [85.0, 178.0] {
        let (width_mm, formats) = (Some(width), vec![Format::Svg]);
        let options = DrawingOptions { width_mm, formats, ..DrawingOptions::default() };
        let folder = TempDir::new().unwrap();
        let out = folder.path().join("out");
        let folder = OutputFolder::open(&out, &manifest, Replace::Anything).unwrap();
        // How long the run took is no matter of its report: the same bytes another day.
        draw(&folder, &CeaReport { wall_s: 77.7, ..report.clone() }, &options);
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(!read("report.html").contains("77.70 s"));
        for name in names_in(&folder.path().join("figures")) {
            check_texts(&format!("{name} at {width} mm"), &read(&format!("figures/{name}")));
        }
    }
    let text = fs::read_to_string(path.join("report.html")).unwrap();
    let wanted = "<h1>Polycarbonate disc</h1> ; Critical friction of each branch ; \
         Eigenvalues at friction coefficient 0.3 ; circumferential_elements = 180 ; Figure 1.";
    // Pictures are as dark as their page.
    let dark = "@media screen and (prefers-color-scheme:dark){.picture";
    has(&text, &[wanted, dark, "<div class=\"scroll picture\""]);
    for name in ["locus", "pairs", "prestress", "modes-mu-0.3", "branch-n1-0-against"] {
        assert!(text.contains(&format!("<figure id=\"{name}\">")), "{name}");
        for extension in ["svg", "png"] {
            let file = path.join(format!("figures/{name}.{extension}"));
            assert!(fs::metadata(file).unwrap().len() > 1000);
        }
    }
}
