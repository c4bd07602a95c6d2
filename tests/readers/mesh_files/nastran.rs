//! Nastran bulk data: fields, coordinate systems, model data, errors.

use super::*;

/// A brick of 1 x 2 x 3 whose nodes stand in a system moved by (5, 0, 0) and turned by 90 degrees about z, one of them in cylindrical
/// coordinates in that; in small, large and free fields.
pub const BRICK: &str = include_str!("../meshes/brick.bdf");

/// Closed form: a brick in systems of coordinates within each other.
#[test]
fn nodes_of_nested_systems_in_all_fields_make_a_brick() {
    let mesh = body("brick.bdf", BRICK);
    assert_eq!(mesh.regions, ["iron"]);
    assert!((mesh.region_measures()[0] - 6.0).abs() < 1e-12);
    // (1, 2, 0) turned to (-2, 1, 0), moved by 5.
    let [x, y, z] = mesh.nodes[2];
    assert!((x - 3.0).abs() + (y - 1.0).abs() + z.abs() < 1e-12, "{x} {y} {z}");
    let [x, y, z] = mesh.nodes[3];
    assert!((x - 3.0).abs() + y.abs() + z.abs() < 1e-12, "{x} {y} {z}");
    let areas = [("PLOAD4_3", 2.0), ("SPC_20_123", 2.0), ("SPC_21_3", 2.0), ("PSHELL_4", 3.0)];
    has_areas(&mesh, &areas);
}

#[test]
fn tabs_lead_to_the_next_field() {
    let tabbed = BRICK.replace("GRID    1       1       0.      0. ", "GRID\t1\t1\t0.\t0.\t");
    assert_ne!(tabbed, BRICK);
    assert_eq!(read("brick.bdf", &tabbed), read("brick.bdf", BRICK));
}

#[test]
fn materials_supports_and_pressures_are_those_that_the_subcase_names() {
    let model = read("brick.bdf", BRICK).unwrap().model;
    assert_eq!(model.title.as_deref(), Some("a brick"));
    let material = &model.materials[0];
    assert_eq!((material.region.as_str(), material.density), ("iron", Some(7200.0)));
    let isotropic = FileElasticity::Isotropic { young_modulus: 1.1e11, poisson_ratio: 0.27 };
    assert_eq!(material.elasticity, Some(isotropic));
    let found: Vec<_> = model.conditions.iter().map(|c| (c.boundary.as_str(), c.kind)).collect();
    let expected = [
        ("SPC_20_123", FileConditionKind::Fixed([true; 3])),
        ("SPC_20_3", FileConditionKind::Fixed([false, false, true])),
        ("PLOAD4_3", FileConditionKind::Pressure(2.5)),
    ];
    assert_eq!(found, expected);
    let listed: Vec<String> = model.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(listed.len(), 3, "{listed:#?}");
    let said = "\nFORCE (line 31) ; set 21, directions 3 ; no subcase names this set ; \
           \nCQUAD4 (line 29): read as a surface";
    has(&format!("\n{}", listed.join("\n")), &[said]);
}

/// MAT9 holds the stiffness; E 2e5, nu 0.3 in it is an isotropic material.
#[test]
fn an_orthotropic_stiffness_gives_engineering_constants() {
    let [lambda, g, d] = isotropic_stiffness();
    let mat9 = format!(
        "MAT9,7,{d},{lambda},{lambda},,,,{d}\n,{lambda},,,,{d},,,\n,{g},,,{g},,{g},7.8-9\n"
    );
    let text = BRICK.replace("MAT1    7       1.1+11          .27     7200.\n", &mat9);
    let material = &read("brick.bdf", &text).unwrap().model.materials[0];
    assert_eq!(material.density, Some(7.8e-9));
    is_that_material(material.elasticity.as_ref());
}

#[test]
fn wrong_bulk_data_is_told_by_line_and_name() {
    check_errors("brick.bdf", BRICK, include_str!("../meshes/wrong-nastran.txt"));
    has(&error("a.bdf", "GRID,1,,0.,0.,0.\n"), &["no solid elements"]);
    let wedge = "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\nGRID,4,,,,1.\nGRID,5,,1.,,1.\nGRID,6,,,1.,1.\n\
                 CPENTA,1,1,1,2,3,4,5,6\nPSOLID,1,1\nMAT1,1,1.,,.3";
    // Two neighbouring corners name none of its faces, on whichever edge of a triangle.
    for ends in ["1,2", "2,3", "1,3", "4,6"] {
        let pressed = format!("{wedge}\nPLOAD4,1,1,1.,,,,{ends}");
        has(&error("wedge.bdf", &pressed), &["name no face of element 1"]);
    }
}
