//! Universal files: groups and errors.

use super::*;

/// A brick of 1 x 2 x 3, its bottom a group of nodes, its top a group of one shell; a dataset that is not known before it.
pub const BRICK: &str = include_str!("../meshes/brick.unv");

#[test]
fn groups_are_regions_surfaces_and_sets_of_nodes() {
    let mesh = body("brick.unv", BRICK);
    assert_eq!(mesh.regions, ["iron"]);
    assert!((mesh.region_measures()[0] - 6.0).abs() < 1e-12);
    has_areas(&mesh, &[("foot", 2.0), ("head", 2.0)]);
    let model = read("brick.unv", BRICK).unwrap().model;
    assert_eq!(model.left_out[0].to_string(), "dataset 151 (line 2)");
    assert!(model.remarks[0].contains("divided by 1000"), "{:?}", model.remarks);
}

/// Dataset 15 has three numbers of 13 characters each: a minus may be all that parts them.
#[test]
fn coordinates_that_touch_are_three() {
    let (head, tail) = BRICK.split_once("  2411\n").unwrap();
    let (nodes, tail) = tail.split_once("    -1\n").unwrap();
    let lines: Vec<&str> = nodes.lines().collect();
    let line = |node: &[&str]| {
        let label = node[0].split_whitespace().next().unwrap();
        let number = |x: &str| x.replace('D', "e").parse::<f64>().unwrap() - 5.0;
        let field = |x| format!("{:>13}", format!("{:.6}E+00", number(x)));
        let place: String = node[1].split_whitespace().map(field).collect();
        format!("{label:>10}         0         0        11{place}\n")
    };
    let nodes: String = lines.chunks(2).map(line).collect();
    assert!(nodes.contains("E+00-"), "{nodes}");
    let mesh = body("brick.unv", &format!("{head}    15\n{nodes}    -1\n{tail}"));
    has_areas(&mesh, &[("foot", 2.0), ("head", 2.0)]);
}

#[test]
fn wrong_universal_files_are_told_by_line() {
    check_errors("brick.unv", BRICK, include_str!("../meshes/wrong-universal.txt"));
    // Truncated behind any line.
    let lines: Vec<&str> = BRICK.lines().collect();
    let said = |count| read("brick.unv", &lines[..count].join("\n")).err();
    (11..lines.len()).filter_map(said).for_each(|error| has(&error.to_string(), &["line"]));
}
