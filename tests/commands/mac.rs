//! `frictionsim mac`: shapes that the program itself computed, turned in phase, scaled and noisy, find their modes again.

use crate::prelude::*;
use frictionsim::signal::reader::{ResponseOptions, read_response, read_shapes};
use frictionsim::study::eigenvalues::{SlidingModel, solve};

const CEA: &str = "[cea]\nmodes = 8";

/// Points and motions of some nodes in each mode, x, y, ux, uy.
type Motion = Vec<([f64; 2], [c64; 2])>;

/// Frequencies and shapes of the case, the last mode first, each turned by a phase of its own, with 3 % of noise; solved once.
static MEASURED: LazyLock<Vec<(f64, Motion)>> = LazyLock::new(|| {
    let case = case_of("case.toml", &coarse_disc(CEA), AS_IT_IS);
    let cea = case.require_cea().unwrap();
    let model = SlidingModel::new(&case, cea).unwrap();
    let solution = solve(&case, cea, &model, None).unwrap();
    let mut draw = crate::draws::draws(12345);
    let mut noise = || 2.0 * draw() - 1.0;
    let shapes = solution.sweep.points[0].modes.iter().rev().enumerate().map(|(k, mode)| {
        let turn = c64::new(0.0, 1.1 + k as f64).exp() * 1e-3;
        let shape = mode.shape.as_ref().unwrap();
        let nodes = (0..model.mesh.node_count()).step_by(5);
        let motion = nodes.map(|node| {
            let frame = model.mesh.frame(node);
            let global = [0, 1].map(|axis| {
                let [u, v] = [0, 1].map(|k| shape[2 * node + k] * frame[(axis, k)]);
                turn * (u + v + c64::new(noise(), noise()) * 0.03)
            });
            (model.mesh.plane_node(node), global)
        });
        (mode.frequency_hz(), motion.collect())
    });
    shapes.collect()
});

fn measured() -> Vec<Motion> {
    MEASURED.iter().map(|(_, shape)| shape.clone()).collect()
}

fn table(shapes: &[Motion], scale: f64) -> String {
    let mut text = "mode,frequency_hz,x,y,ux_re,ux_im,uy\n".to_owned();
    for (k, shape) in shapes.iter().enumerate() {
        for ([x, y], [u, v]) in shape {
            let (head, x, y) = (1000 + k, scale * x, scale * y);
            text += &format!("s{k},{head}.5,{x},{y},{},{},{}{:+}j\n", u.re, u.im, v.re, v.im);
        }
    }
    text
}

/// Datasets 15 and 55.
fn universal(shapes: &[Motion]) -> String {
    let row = |values: &[f64]| -> String { values.iter().map(|x| format!("{x:>13.5e}")).collect() };
    let mut text = "    -1\n    15\n".to_owned();
    for (n, ([x, y], _)) in shapes[0].iter().enumerate() {
        let place = row(&[*x, *y, 0.0]);
        writeln!(text, "{:>10}{:>10}{:>10}{:>10}{place}", n + 1, 0, 0, 11).unwrap();
    }
    text += "    -1\n";
    for (k, shape) in shapes.iter().enumerate() {
        writeln!(text, "    -1\n    55\nNONE\nNONE\nNONE\nNONE\nNONE").unwrap();
        writeln!(text, "         1         3         2         8         5         3").unwrap();
        writeln!(text, "         2         6         1{:>10}", k + 1).unwrap();
        writeln!(text, "  1.0E+00  {:.5e} 0.0 0.0 0.0 0.0", 6283.0 * (k + 1) as f64).unwrap();
        for (n, (_, [u, v])) in shape.iter().enumerate() {
            let parts = row(&[u.re, u.im, v.re, v.im, 0.0, 0.0]);
            writeln!(text, "{:>10}\n{parts}", n + 1).unwrap();
        }
        text += "    -1\n";
    }
    text
}

fn run(shapes: &str, further: &[&str]) -> Run {
    let files = [("case.toml", &*coarse_disc(CEA)), ("shapes", shapes)];
    Run::new(&["mac", "case.toml", "shapes"]).beside(&files).out("out").args(further)
}

/// Noise of relative size 0.03 on each part of unit shapes leaves a criterion above 0.97 of the own mode.
#[test]
fn shapes_of_the_program_with_noise_find_their_modes() {
    let shapes = measured();
    for text in [table(&shapes, 1.0), universal(&shapes)] {
        let answer = run(&text, &[]).done();
        let summary = answer.summary();
        let pairs = summary["pairs"].as_array().unwrap();
        assert_eq!(pairs.len(), shapes.len());
        for pair in pairs {
            let number = |key: &str| pair[key].as_u64().unwrap() as usize;
            assert_eq!(number("mode"), shapes.len() + 1 - number("shape"), "{pair}");
            assert!(pair["mac"].as_f64().unwrap() > 0.97, "{pair}");
        }
        assert_eq!(answer.text("mac.csv").lines().count(), 1 + shapes.len() * shapes.len());
        // A cell for each pair, whose edges stay.
        has(&answer.text("figures/mac.svg"), &["image-rendering:pixelated"]);
    }
}

/// Six digits of each displacement leave a criterion of one to ten digits.
#[test]
fn shapes_and_responses_written_as_universal_files_are_read_back() {
    let frf = "[frf]\nforce_node = 40\nfrequencies_hz = { from = 1e3, to = 2e3, count = 11 }";
    let case = coarse_disc(&format!("{CEA}\n[output]\nuniversal = true\n{frf}"));
    let folder = folder_with(&[("case.toml", case.as_bytes())]);
    let run = |words: &[&str], out: &str| {
        Run::new(words).within(&folder).args(&["--no-figures"]).out(out).done().summary()
    };
    run(&["cea", "case.toml"], "cea");
    let mac = run(&["mac", "case.toml", "cea/modes.unv"], "mac");
    let pairs = mac["pairs"].as_array().unwrap();
    assert_eq!(pairs.len(), 8);
    for pair in pairs {
        assert_eq!(pair["mode"], pair["shape"], "{pair}");
        assert!(pair["mac"].as_f64().unwrap() > 1.0 - 1e-9, "{pair}");
    }
    // The mesh beside the shapes.
    let bytes = fs::read(folder.path().join("cea/modes.unv")).unwrap();
    let file = FileMesh::read_as("modes.unv", &bytes).unwrap();
    let case = case_of("case.toml", &case, AS_IT_IS);
    let mesh = case.body.mesh().unwrap();
    assert_eq!(file.points.len(), mesh.node_count());
    let own = (0..mesh.element_count()).map(|element| mesh.element_nodes(element));
    assert!(file.elements.iter().map(|element| &element.nodes[..]).eq(own));
    // The response has the values of the table.
    run(&["frf", "case.toml"], "frf");
    let [table, universal] = ["frf/frf.csv", "frf/frf.unv"].map(|name| {
        let bytes = fs::read(folder.path().join(name)).unwrap();
        let file = read_response(&bytes, name, &ResponseOptions::default()).unwrap();
        file.responses[0].response.values().to_vec()
    });
    near_each(&universal, &table, 1e-11);
}

#[test]
fn points_off_the_body_are_counted_and_wrong_units_recognised() {
    let mut shapes = measured();
    let millimetres = table(&shapes, 1e3);
    run(&millimetres, &[]).refused(&["millimetres: add --scale 0.001"]);
    run(&millimetres, &["--scale", "0.001"]).done();
    shapes[0][3].0 = [0.5, 0.5];
    // Decay has one unit everywhere.
    let said = ["1 of 51 points lie off the body", "growth rate (1/s)", "!real Hz", "!real part"];
    run(&table(&shapes, 1.0), &[]).done().says(&said);
}

#[test]
fn a_table_has_shapes_by_their_names_in_any_columns_and_a_universal_file_complex_ones() {
    let text = "mode;frequency_hz;x;y;uy_im;uy_re;ux\n\
                a;100;0;1;0,5;1;2+3j\nb;200;0;1;1;2;3\na;100;1;1;;-1;nan\n;;;;;;\n";
    let shapes = read_shapes(text.as_bytes(), "s.csv").unwrap();
    assert_eq!(shapes.len(), 2);
    assert_eq!((shapes[0].name.as_str(), shapes[0].frequency_hz), ("a", Some(100.0)));
    assert_eq!(shapes[0].points, [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    assert_eq!(shapes[0].motion[0], [Some(c64::new(2.0, 3.0)), Some(c64::new(1.0, 0.5)), None]);
    assert_eq!(shapes[0].motion[1][0], None);
    // A universal file has nodes and complex shapes.
    let shapes = read_shapes(include_bytes!("../cases/shape.unv"), "s.unv").unwrap();
    assert_eq!(shapes[0].name, "4");
    assert!((shapes[0].frequency_hz.unwrap() - 1000.0).abs() < 1e-9);
    assert_eq!(shapes[0].points, [[1.0, 2.0, 3.0]]);
    assert_eq!(shapes[0].motion[0][2], Some(c64::new(5.0, 6.0)));
}

#[test]
fn what_is_no_shape_is_named_with_its_place() {
    for (text, part) in [
        ("x,y\n1,2\n", "ux"),
        ("x,y,ux\n1,2,a\n", "s.csv:2:5"),
        ("x,y,ux\n1,,3\n", "s.csv:2"),
        ("x,y,ux\n", "empty"),
        ("", "empty"),
        ("x,y,ux\n1,2,0\n", "no row of numbers"),
        ("-1\n55\na\n-1\n", "header"),
    ] {
        has(&read_shapes(text.as_bytes(), "s.csv").unwrap_err().to_string(), &[part]);
    }
}

/// A table of modes with the frequencies of [`table`]'s shapes replaced by those of the case, and both fitted.
fn fit_with(shapes: &str, set: &[&str]) -> Run {
    let fit =
        format!("{CEA}\n[fit]\nparameters = {{ \"material.young_modulus\" = [1.5e9, 4e9] }}\n");
    let rows: String = MEASURED.iter().map(|(frequency, _)| format!("{frequency}\n")).collect();
    let (case, modes) = (coarse_disc(&fit), format!("frequency_hz\n{rows}"));
    let files = [("case.toml", &*case), ("modes.csv", &modes), ("shapes", shapes)];
    let words = ["fit", "case.toml", "modes.csv", "--shapes", "shapes", "--no-figures"];
    Run::new(&words).beside(&files).out("out").set(set)
}

/// Shapes and frequencies that the program itself computed give back the modulus of the case, each line with its own mode; points in
/// millimetres, a shape of no line and a weight of nothing are refused with the remedy.
#[test]
fn measured_shapes_are_data_of_a_fit() {
    let named = |scale: f64| {
        MEASURED.iter().enumerate().fold(table(&measured(), scale), |text, (k, (own, _))| {
            text.replace(&format!(",{}.5,", 1000 + k), &format!(",{own},"))
        })
    };
    let answer = fit_with(&named(1.0), &[]).done();
    let summary = answer.summary();
    let modulus = summary["parameters"]["material.young_modulus"]["value"].as_f64();
    assert!((modulus.unwrap() / 2.5e9 - 1.0).abs() < 1e-3, "{modulus:?}");
    for line in summary["residuals"].as_array().unwrap() {
        assert!(line["mac"].as_f64().unwrap() > 0.97, "{line}");
    }
    assert!(answer.header("fit.csv").ends_with(",mac"));
    fit_with(&named(1000.0), &[]).refused(&["--scale 0.001"]);
    fit_with(&named(1.0), &["fit.shape_weight=0"]).refused(&["fit.shape_weight"]);
    fit_with(&table(&measured(), 1.0), &[]).refused(&["belongs to no line"]);
}
