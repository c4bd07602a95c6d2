//! Universal files: groups and errors.

use super::{area, body, check_errors, read};
use crate::prelude::*;

/// A brick of 1 x 2 x 3, its bottom a group of nodes, its top a group of one shell; a dataset that is not known before it.
pub const BRICK: &str = include_str!("../meshes/brick.unv");

#[test]
fn groups_are_regions_surfaces_and_sets_of_nodes() {
    let mesh = body("brick.unv", BRICK);
    assert_eq!(mesh.regions, ["iron"]);
    assert!((mesh.region_measures()[0] - 6.0).abs() < 1e-12);
    assert!((area(&mesh, "foot") - 2.0).abs() < 1e-12);
    assert!((area(&mesh, "head") - 2.0).abs() < 1e-12);
    let model = read("brick.unv", BRICK).unwrap().model;
    assert_eq!(model.left_out[0].to_string(), "dataset 151 (line 2)");
    assert!(model.remarks[0].contains("divided by 1000"), "{:?}", model.remarks);
}

#[test]
fn wrong_universal_files_are_told_by_line() {
    check_errors(
        "brick.unv",
        BRICK,
        r#"
         5         6         7         8\n         3 =>          5         6         7         9\n         3 => element 2 names node 9
  2467\n =>   2411\n => line 43: a coordinate expected
         7         3         0         0 =>          7        33         0         0 => group foot names node 33
         8         2         0         0 =>          8        22         0         0 => group head names element 22
         1       115  =>          1       114  => of kind 114, which is not supported
   1.0D+00   2.0D+00   3.0D+00 =>    1.0D+00   2.0D+00   3.x => a coordinate expected, found "3.x"
"#,
    );
    // Truncated behind any line.
    let lines: Vec<&str> = BRICK.lines().collect();
    for count in 11..lines.len() {
        let text = lines[..count].join("\n");
        if let Err(error) = read("brick.unv", &text) {
            has(&error.to_string(), &["line"]);
        }
    }
}
