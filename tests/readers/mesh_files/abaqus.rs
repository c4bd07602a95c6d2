//! Input files of Abaqus and CalculiX: parts, sets, surfaces, model data, errors.

use super::*;
use frictionsim::mesh::MaterialAxes;

/// A brick of 1 x 2 x 3, twice in the assembly: as it is, and moved by 10 along x, then turned by 90 degrees about z through (10, 0, 0).
pub const ASSEMBLY: &str = include_str!("../meshes/assembly.inp");

/// Closed form: places and areas of two bricks.
#[test]
fn instances_stand_where_their_translation_and_rotation_put_them() {
    let mesh = body("bricks.inp", ASSEMBLY);
    assert_eq!(mesh.regions, ["One_All", "Two_All"]);
    for volume in mesh.region_measures() {
        assert!((volume - 6.0).abs() < 1e-12);
    }
    has_areas(&mesh, &[("One_Top", 2.0), ("Two_Top", 2.0), ("Two_Skin", 22.0), ("Both_feet", 4.0)]);
    // Node 3 of the second instance, (1, 2, 0): moved to (11, 2, 0), turned to (8, 1, 0). Its number follows those of the first.
    let [x, y, z] = mesh.nodes[mesh.labels.iter().position(|&label| label == 99 + 3).unwrap()];
    assert!((x - 8.0).abs() + (y - 1.0).abs() + z.abs() < 1e-12, "{x} {y} {z}");
    // Two nodes are no surface: they bound nothing but can be held.
    let corner = mesh.boundary("Corner").unwrap();
    assert_eq!((corner.nodes.len(), corner.faces.len()), (2, 0));
}

#[test]
fn materials_ties_contacts_and_conditions_are_those_of_the_file() {
    let model = read("bricks.inp", ASSEMBLY).unwrap().model;
    assert_eq!(model.title.as_deref(), Some("two bricks"));
    let material = &model.materials[1];
    assert_eq!((material.region.as_str(), material.name.as_str()), ("Two_All", "Mat"));
    assert_eq!((material.density, material.mass_coefficient), (Some(2.5e-9), Some(10.0)));
    let Some(FileElasticity::Orthotropic { young_moduli, poisson_ratios, shear_moduli, axes }) =
        &material.elasticity
    else {
        panic!("{material:?}");
    };
    assert_eq!(*young_moduli, [8000.0, 8000.0, 1500.0]);
    assert_eq!(*poisson_ratios, [0.25, 0.1, 0.1]);
    assert_eq!(*shear_moduli, [3000.0, 1000.0, 1000.0]);
    // The orientation turns with its instance: axis 1 from y to -x.
    let MaterialAxes::Vectors([first, second]) = axes else { panic!("{axes:?}") };
    let off = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).sum::<f64>();
    assert!(off(*first, [-1.0, 0.0, 0.0]) < 1e-12 && off(*second, [0.0, -1.0, 0.0]) < 1e-12);
    let tie = &model.ties[0];
    assert_eq!([&tie.name, &tie.surface, &tie.counter], ["Glue", "One_Top", "Two_Top"]);
    let contact = &model.contacts[0];
    assert_eq!([&contact.surface, &contact.counter], ["One_Skin", "Two_Skin"]);
    assert_eq!(contact.friction_coefficient, Some(0.3));
    let (ratio, speed) = contact.decay.unwrap();
    assert!((ratio - 1.5).abs() < 1e-12 && (speed - 200.0).abs() < 1e-9);
    assert_eq!(contact.normal_stiffness, Some(1e5));
    let found = |name: &str| {
        let condition = model.conditions.iter().find(|c| c.boundary == name);
        condition.unwrap_or_else(|| panic!("{name}: {:?}", model.conditions)).kind
    };
    assert_eq!(found("Both_feet"), FileConditionKind::Fixed([false, false, true]));
    assert_eq!(found("One_Foot"), FileConditionKind::Fixed([true; 3]));
    assert_eq!(found("held_nodes_1_2"), FileConditionKind::Fixed([true, true, false]));
    assert_eq!(found("Two_Top"), FileConditionKind::Pressure(2.5));
    assert_eq!(found("One_All_P1"), FileConditionKind::Pressure(1.25));
    assert_eq!(model.conditions.len(), 5);
}

#[test]
fn what_is_not_used_is_listed_with_its_line_and_count() {
    let text = ASSEMBLY.to_owned()
        + "*AMPLITUDE, NAME=A\n0., 1.\n*AMPLITUDE, NAME=B\n0., 1.\n*ELEMENT, TYPE=MASS, ELSET=Point\n7, 99\n";
    let file = read("bricks.inp", &text).unwrap();
    let listed: Vec<String> = file.model.left_out.iter().map(ToString::to_string).collect();
    let line = |begin: &str| 1 + text.lines().position(|line| line.starts_with(begin)).unwrap();
    for expected in [
        format!("*AMPLITUDE (line {}, 2 times)", line("*AMPLITUDE")),
        format!("*CLOAD (line {})", line("*CLOAD")),
        format!("*STATIC (line {}): the case says what is computed", line("*STATIC")),
        format!("*NODE PRINT (line {}): the case says what is written", line("*NODE PRINT")),
        format!("*DSLOAD, HP (line {}): pressures", line("One.Top, HP")),
        format!("*BOUNDARY with a displacement (line {}): only", line("Two.Foot, 1, 1, 0.5")),
        format!("*TIE, ADJUST (line {}): nodes stay", line("*TIE")),
        format!("*ELEMENT, TYPE=MASS (line {}): elements other", line("7, 99")),
    ] {
        assert!(listed.iter().any(|found| found.starts_with(&expected)), "{expected}: {listed:#?}");
    }
    // Nothing else is listed.
    assert_eq!(listed.len(), 8, "{listed:#?}");
    let remarks = format!("\n{}", file.model.remarks.join("\n"));
    has(&remarks, &["C3D8R ; \n2 nodes belong to no element"]);
}

/// What pairs with a surface that is left out is left out too, by whatever name its scope gives it.
#[test]
fn pairs_with_a_rigid_surface_of_a_part_are_left_out_with_it() {
    let rigid = "*SURFACE, NAME=Rigid, TYPE=CYLINDER\n";
    let contact = "*CONTACT PAIR, INTERACTION=RUB\n";
    let text = ASSEMBLY.replace("*END PART", &format!("{rigid}{contact}Top, Rigid\n*END PART"));
    let text = text.replace("One.Top, Two.Top", "One.Top, Two.rigid");
    let model = read("bricks.inp", &text.replace("One.Skin", "One.Rigid")).unwrap().model;
    assert_eq!((model.ties.len(), model.contacts.len()), (0, 0));
    let listed: Vec<&str> = model.left_out.iter().map(|own| own.keyword.as_str()).collect();
    let pairs = ["*TIE of Two.rigid", "*CONTACT PAIR of Rigid", "*CONTACT PAIR of One.Rigid"];
    for expected in ["*SURFACE, NAME=Rigid, TYPE=CYLINDER"].iter().chain(&pairs) {
        assert!(listed.contains(expected), "{expected}: {listed:#?}");
    }
    // The assembly itself has none of that name.
    let wrong = error("bricks.inp", &text.replace("One.Skin", "Rigid"));
    has(&wrong, &["no surface is called \"Rigid\""]);
}

/// What moves with nodes of the body and resists nothing leaves what holds between these alone.
#[test]
fn nodes_without_elements_vanish_from_equations() {
    let equation = |terms: &str| {
        let terms = terms.replace(" ; ", "\n");
        format!("*EQUATION\n{}\n{terms}\n", terms.lines().count())
    };
    let nodes = "*NODE\n901, 0., 0., 0.\n902, 1., 0., 0.\n903, 2., 0., 0.\n";
    let equations = [
        "901, 1, 2. ; One.1, 1, -1.",
        "902, 1, 1. ; 901, 1, -1. ; 903, 1, -1.",
        "One.2, 1, 1. ; 901, 1, -2.",
        "902, 1, 1. ; 903, 1, -1. ; One.1, 1, -1. ; One.2, 1, 1.",
        "901, 2, 1. ; One.2, 2, -1.",
        "902, 1, 1. ; 903, 1, -1. ; 901, 1, -1.",
    ];
    let equations = equations.map(equation).concat();
    let text = ASSEMBLY.replace("*END ASSEMBLY", &format!("{nodes}{equations}*END ASSEMBLY"));
    let file = read("bricks.inp", &text).unwrap();
    let told: Vec<Vec<_>> = file.equations.iter().filter(|own| !own.is_empty()).cloned().collect();
    assert_eq!(told, [[(0, 0, -1.0), (1, 0, 1.0)], [(0, 0, -0.5), (1, 0, 1.0)]]);
}

/// An element of the patch test of MacNeal and Harder (1985) that folds at a corner and at no point of its quadrature.
#[test]
fn an_element_that_folds_at_a_corner_alone_is_badly_shaped() {
    let nodes = "*NODE\n1, .249, .342, .192\n2, .826, .288, .288\n6, .677, .305, .683\n5, .32, .186, .643\n\
        9, 0, 0, 0\n12, 1, 0, 0\n14, 1, 0, 1\n13, 0, 0, 1\n";
    let element =
        "*ELEMENT, TYPE=C3D8, ELSET=All\n4, 1, 2, 6, 5, 9, 12, 14, 13\n*SOLID SECTION, ELSET=All\n";
    let quality = body("patch.inp", &(nodes.to_owned() + element)).quality();
    assert!((-0.05..-0.02).contains(&quality.worst_jacobian), "{quality:?}");
    let twice = nodes.to_owned() + &element.replace("14, 13", "14, 9");
    let file = read("patch.inp", &twice).unwrap();
    assert!(Mesh::from_solids(&file, 1.0, &[]).unwrap_err().to_string().contains("no volume"));
}

#[test]
fn wrong_input_files_are_told_by_line_and_name() {
    check_errors("bricks.inp", ASSEMBLY, include_str!("../meshes/wrong-abaqus.txt"));
    has(&error("a.inp", "*NODE\n1, 0, 0, 0\n"), &["no solid or plane elements"]);
    has(&error("a.inp", "\u{1}\u{2}garbage"), &["line 1: a keyword such as *NODE"]);
}

/// Stiffness of an orthotropic material and its engineering constants are one material.
#[test]
fn the_stiffness_of_an_orthotropic_material_gives_its_engineering_constants() {
    let [lambda, g, d] = isotropic_stiffness();
    let constants = format!(
        "*ELASTIC, TYPE=ORTHOTROPIC\n{d}, {lambda}, {d}, {lambda}, {lambda}, {d}, {g}, {g},\n{g}\n"
    );
    let begin = ASSEMBLY.find("*ELASTIC").unwrap();
    let end = ASSEMBLY.find("*DENSITY").unwrap();
    let text = [&ASSEMBLY[..begin], &constants, &ASSEMBLY[end..]].concat();
    is_that_material(read("bricks.inp", &text).unwrap().model.materials[0].elasticity.as_ref());
}
