//! Figures and tables of bodies without symmetry, and of bodies without a thickness.
//!
//! Consistency checks: they look at the drawing, not at the physics.

use crate::figures::{check_texts, synthetic, texts};
use crate::prelude::*;
use frictionsim::results::cea::{Solution, View, document, figures, page, write_fields};

/// A body whose mesh is no annulus to the program, though its hole is round.
fn body() -> Mesh {
    let mut mesh = synthetic::mesh(40, 3);
    mesh.is_cyclic = false;
    mesh
}

/// Modes of that body at five friction coefficients, two of which couple.
fn solution() -> Solution {
    let mut sweep = synthetic::sweep(5);
    for point in &mut sweep.points {
        for (rank, mode) in point.modes.iter_mut().enumerate() {
            (mode.harmonic, mode.direction, mode.branch) = (0, 0, rank);
        }
    }
    let interval = |branch, critical_friction| UnstableInterval {
        direction: 0,
        ..synthetic::onset((0, branch), critical_friction, 1e4)
    };
    // The waves of a pair that travel against the rotor grow.
    sweep.intervals = vec![interval(4, 0.3), interval(6, 0.6)];
    synthetic::solution(sweep)
}

/// The contact of the hole as an imported edge lists it: angles up to half a turn, then on from minus half a turn.
fn field(mesh: &Mesh) -> BaseField {
    let nodes = mesh.contact_edge().nodes.clone();
    let angle = |node: u32| {
        let [x, y] = mesh.plane_node(node as usize);
        (node, y.atan2(x))
    };
    let angles: Vec<(u32, f64)> = nodes.into_iter().map(angle).collect();
    assert!(!angles.iter().map(|own| own.1).is_sorted());
    assert!(angles.iter().any(|own| own.1 < -0.9 * PI));
    let stress = NodalStress { radial: -1e6, ..NodalStress::default() };
    let tractions = |angle: f64| [1e6, 3e5].map(|mean| mean * (2.0 + angle.cos()));
    synthetic::field(mesh, &angles, tractions, vec![stress; mesh.node_count()])
}

fn report<'a>(mesh: &'a Mesh, solution: &'a Solution, extent: Extent) -> CeaReport<'a> {
    CeaReport {
        title: "A body of its own",
        has_harmonics: false,
        friction_coefficients: &[0.0, 0.25, 0.5, 0.75, 1.0],
        contact_changes: &[0.6],
        base: BaseState {
            friction_coefficient: 0.5,
            slipping: 40,
            torque_n_m: Some(2014.0),
            power_w: 9600.0,
            extent,
            ..synthetic::SLIDING
        },
        ..synthetic::report(mesh, solution)
    }
}

fn drawn(report: &CeaReport<'_>, field: &BaseField, width_mm: Option<f64>) -> TempDir {
    let out = folder();
    let path = out.path().join("out");
    let folder = OutputFolder::open(&path, &Manifest::new("cea"), Replace::Anything).unwrap();
    let one = rayleigh_damping(40.0, 4.5e-7);
    let other = RayleighDamping { mass_coefficient: 10.0, ..one };
    let dampings = [("damping of disc".to_owned(), one), ("damping of pad".to_owned(), other)];
    let options =
        DrawingOptions { width_mm, formats: vec![Format::Svg], ..DrawingOptions::default() };
    let (page, figures) = (page(report, field), figures(report, field, &dampings));
    write_page(&folder, page, figures, &options).unwrap();
    folder.finish().unwrap();
    out
}

fn read(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join("out").join(name)).unwrap()
}

#[test]
fn modes_of_a_body_without_symmetry_have_numbers_and_no_harmonic() {
    let (mesh, solution) = (body(), solution());
    let field = field(&mesh);
    let report = report(&mesh, &solution, Extent::WholeBody);
    for width in [None, Some(85.0)] {
        let folder = drawn(&report, &field, width);
        for name in ["locus", "pairs", "prestress"] {
            let svg = read(&folder, &format!("figures/{name}.svg"));
            has(&texts(&svg).join("\n"), &["!n ="]);
            check_texts(name, &svg);
        }
        // Each a line of its own.
        let words = |name: &str| {
            format!("\n{}\n", texts(&read(&folder, &format!("figures/{name}.svg"))).join("\n"))
        };
        let pairs =
            "\nmode 5\n ; contact opens or closes between ; \nmode of the nearest frequency\n";
        has(&words("pairs"), &[pairs]);
        has(&words("locus"), &["\ndamping of disc\n ; \ndamping of pad\n"]);
        has(&read(&folder, "report.html"), &["!harmonic n"]);
    }
    has(&document(&report, View::Short).to_text(), &["branch ; !travels"]);
    // Of one friction value alone, 1, the bars begin at the onsets below, 0.3 and 0.6.
    let mut one = solution.clone();
    one.sweep.points.drain(..4);
    let report = CeaReport { solution: &one, ..report };
    let locus = texts(&read(&drawn(&report, &field, None), "figures/locus.svg")).join(" ");
    has(&locus, &["0.3 0.4 0.5 0.6 ; !lowest friction ; !branch"]);
}

#[test]
fn contact_around_an_imported_hole_is_drawn_and_listed_over_rising_angles() {
    let (mesh, solution) = (body(), solution());
    let field = field(&mesh);
    let places = field.along_contact(&mesh);
    assert!(places.windows(2).all(|pair| pair[0].1 < pair[1].1));
    assert!(places[0].1 >= 0.0 && places[39].1 < 2.0 * PI && places[39].1 > 1.9 * PI);
    let report = report(&mesh, &solution, Extent::WholeBody);
    let folder = drawn(&report, &field, None);
    has(&read(&folder, "report.html"), &["Figure"]);
    // One curve from end to end of its frame: its abscissae rise, and it never crosses the panel backwards.
    let all = figures(&report, &field, &[]);
    let panels = all.iter().find(|own| own.name == "prestress").unwrap().numbers();
    let curves = panels.iter().flat_map(|own| &own.series).filter(|own| own.values.is_none());
    assert!(curves.map(|own| own.xs.is_sorted()).eq([true, true]));
    let path = folder.path().join("base");
    let out = OutputFolder::open(&path, &Manifest::new("cea"), Replace::Anything).unwrap();
    write_tables(&out, &page(&report, &field)).unwrap();
    write_fields(&out, &report, &field).unwrap();
    let table = fs::read_to_string(path.join("prestress.csv")).unwrap();
    let angles = table.lines().skip(1).map(|line| line.split(',').nth(1).unwrap());
    let angles: Vec<f64> = angles.map(|angle| angle.parse().unwrap()).collect();
    assert!(angles.is_sorted() && angles.len() == 40, "{angles:?}");
    let fields = fs::read(path.join("prestress.vtu")).unwrap();
    let names = "status pressure_pa shear_pa stress_xx_pa friction_coefficient power_w";
    let names = names.split(' ').map(|name| format!("Name=\"{name}\"")).collect::<Vec<_>>();
    has(&String::from_utf8_lossy(&fields), &[&names.join(" ; ")]);
}

#[test]
fn torque_and_power_of_a_body_without_a_thickness_are_for_each_metre() {
    let (mesh, solution) = (body(), solution());
    let field = field(&mesh);
    let of = |extent| report(&mesh, &solution, extent);
    let metre = document(&of(Extent::MetreOfThickness), View::Short).to_text();
    has(&metre, &["2014 N m/m ; 9600.0 W/m ; for each metre of thickness"]);
    let html = read(&drawn(&of(Extent::MetreOfThickness), &field, None), "report.html");
    has(&html, &["2014 N m/m ; 9600.0 W/m"]);
    has(&document(&of(Extent::WholeBody), View::Short).to_text(), &["2014 N m, ; !W/m"]);
}
