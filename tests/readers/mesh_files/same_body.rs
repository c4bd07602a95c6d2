//! One body in every format (independent checks: node orders of the manuals, and files that Gmsh wrote).

use super::{area, body};
use crate::prelude::*;

/// Sides of the block that the files name.
const SIDES: [&str; 2] = ["x0", "z1"];

fn bent([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.1 * x + 0.01 * y * z, 0.07 * y + 0.02 * x * x, 0.05 * z + 0.01 * x]
}

/// Element number (from 1), local face and nodes of every face of a side.
fn faces_of(file: &FileMesh, side: &str) -> Vec<(usize, Vec<usize>, Vec<u32>)> {
    let mut found = Vec::new();
    for (kind, nodes) in &file.surfaces[side] {
        let corners = &nodes[..kind.corner_count()];
        let element =
            file.elements.iter().position(|e| corners.iter().all(|n| e.nodes.contains(n)));
        let element = element.unwrap();
        let local =
            |node: &u32| file.elements[element].nodes.iter().position(|n| n == node).unwrap();
        found.push((element + 1, corners.iter().map(local).collect(), corners.to_vec()));
    }
    found
}

/// Number of the face with these corners, Abaqus Analysis User's Guide, "Solid element library": corners of S1, S2, ...
fn abaqus_face(kind: ElementKind, corners: &[usize]) -> usize {
    let faces: &[&[usize]] = match kind {
        ElementKind::Tet4 | ElementKind::Tet10 => &[&[1, 2, 3], &[1, 4, 2], &[2, 4, 3], &[3, 4, 1]],
        ElementKind::Hex8 | ElementKind::Hex20 => &[
            &[1, 2, 3, 4],
            &[5, 8, 7, 6],
            &[1, 5, 6, 2],
            &[2, 6, 7, 3],
            &[3, 7, 8, 4],
            &[4, 8, 5, 1],
        ],
        ElementKind::Pyramid5 | ElementKind::Pyramid13 => {
            &[&[1, 2, 3, 4], &[1, 5, 2], &[2, 5, 3], &[3, 5, 4], &[4, 5, 1]]
        }
        _ => &[&[1, 2, 3], &[4, 6, 5], &[1, 4, 5, 2], &[2, 5, 6, 3], &[3, 6, 4, 1]],
    };
    let is_same = |face: &&[usize]| {
        face.len() == corners.len() && corners.iter().all(|c| face.contains(&(c + 1)))
    };
    1 + faces.iter().position(is_same).unwrap()
}

fn inp(file: &FileMesh) -> String {
    let mut out = String::from("*Heading\n a block\n*NODE, NSET=Nall\n");
    for (label, [x, y, z]) in file.labels.iter().zip(&file.points) {
        writeln!(out, "{label}, {x:?}, {y:?}, {z:?}").unwrap();
    }
    let kind = file.elements[0].kind;
    let name = match kind {
        ElementKind::Tet4 => "C3D4",
        ElementKind::Tet10 => "C3D10",
        ElementKind::Hex8 => "C3D8I",
        ElementKind::Hex20 => "C3D20",
        ElementKind::Wedge6 => "C3D6",
        ElementKind::Pyramid5 => "C3D5",
        ElementKind::Pyramid13 => "C3D13",
        _ => "C3D15",
    };
    writeln!(out, "*Element, type={name}, elset=body").unwrap();
    for element in &file.elements {
        write!(out, "{}", element.label).unwrap();
        for (i, &node) in element.nodes.iter().enumerate() {
            // At most 15 numbers a line; a comma at its end.
            let separator = if i == 14 { ",\n" } else { ", " };
            write!(out, "{separator}{}", file.labels[node as usize]).unwrap();
        }
        out.push('\n');
    }
    for side in SIDES {
        writeln!(out, "*SURFACE, NAME={side}").unwrap();
        for (element, corners, _) in faces_of(file, side) {
            writeln!(out, "{element}, S{}", abaqus_face(kind, &corners)).unwrap();
        }
    }
    out
}

/// Places of the nodes on the card, MSC Nastran Quick Reference Guide, CHEXA, CPENTA: mid-side nodes of the bottom, along the height,
/// of the top.
fn nastran_order(kind: ElementKind) -> Vec<usize> {
    match kind {
        ElementKind::Hex20 => {
            vec![0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15]
        }
        ElementKind::Wedge15 => vec![0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11],
        _ => (0..kind.node_count()).collect(),
    }
}

fn bdf(file: &FileMesh) -> String {
    let mut out = String::from(
        "SOL 103\nCEND\nLOAD = 1\nBEGIN BULK\n$HMNAME PROP        7\"body\" 4\nPSOLID,7,1\nMAT1,1,2.+11,,.3,7850.\n",
    );
    for (label, [x, y, z]) in file.labels.iter().zip(&file.points) {
        // Large fields of sixteen columns hold few digits: free ones of any length do not lose any.
        writeln!(out, "GRID*,{label},,{x:?},{y:?}\n*,{z:?}").unwrap();
    }
    let kind = file.elements[0].kind;
    let name = match kind {
        ElementKind::Tet4 | ElementKind::Tet10 => "CTETRA",
        ElementKind::Hex8 | ElementKind::Hex20 => "CHEXA",
        ElementKind::Pyramid5 | ElementKind::Pyramid13 => "CPYRAM",
        _ => "CPENTA",
    };
    for element in &file.elements {
        let mut fields = vec![element.label, 7];
        let place = |at: usize| file.labels[element.nodes[at] as usize];
        fields.extend(nastran_order(kind).into_iter().map(place));
        // Small fields of eight columns, eight on a line.
        for (i, line) in fields.chunks(8).enumerate() {
            write!(out, "{:<8}", if i == 0 { name } else { "+" }).unwrap();
            line.iter().for_each(|field| write!(out, "{field:<8}").unwrap());
            out.push('\n');
        }
    }
    // The set number says the side: one pressure for each.
    for (set, side) in SIDES.into_iter().enumerate() {
        for (element, corners, nodes) in faces_of(file, side) {
            let label = |node: u32| file.labels[node as usize];
            let (first, second) = match (kind, corners.len()) {
                (ElementKind::Tet4 | ElementKind::Tet10, _) => {
                    let apex = (0..4).find(|corner| !corners.contains(corner)).unwrap();
                    (label(nodes[0]), label(file.elements[element - 1].nodes[apex]).to_string())
                }
                (_, 3) => (label(nodes[0]), String::new()),
                _ => (label(nodes[0]), label(nodes[2]).to_string()),
            };
            writeln!(out, "PLOAD4,{},{element},1.5,,,,{first},{second}", set + 1).unwrap();
        }
    }
    out + "ENDDATA\n"
}

/// Nodes in the order of the file, corner, middle, corner around each face.
fn unv_order(kind: ElementKind) -> Vec<usize> {
    match kind {
        ElementKind::Tet10 => vec![0, 4, 1, 5, 2, 6, 7, 8, 9, 3],
        ElementKind::Hex20 => {
            vec![0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15]
        }
        ElementKind::Wedge15 => vec![0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11],
        _ => (0..kind.node_count()).collect(),
    }
}

fn unv(file: &FileMesh) -> String {
    let mut out = String::from("    -1\n  2411\n");
    for (label, [x, y, z]) in file.labels.iter().zip(&file.points) {
        let exponent = |value: &f64| format!("{value:.17e}").replace('e', "D");
        let [x, y, z] = [x, y, z].map(exponent);
        writeln!(out, "{label:10}         1         1        11\n  {x}  {y}  {z}").unwrap();
    }
    out.push_str("    -1\n    -1\n  2412\n");
    let kind = file.elements[0].kind;
    let descriptor = match kind {
        ElementKind::Tet4 => 111,
        ElementKind::Tet10 => 118,
        ElementKind::Hex8 => 115,
        ElementKind::Hex20 => 116,
        ElementKind::Wedge6 => 112,
        _ => 113,
    };
    let mut write_element = |label: usize, descriptor: usize, nodes: &[usize]| {
        writeln!(out, "{label:10}{descriptor:10}         1         1         7{:10}", nodes.len())
            .unwrap();
        for line in nodes.chunks(8) {
            line.iter().for_each(|node| write!(out, "{node:10}").unwrap());
            out.push('\n');
        }
    };
    let label = |node: u32| file.labels[node as usize];
    for element in &file.elements {
        let nodes: Vec<usize> =
            unv_order(kind).into_iter().map(|at| label(element.nodes[at])).collect();
        write_element(element.label, descriptor, &nodes);
    }
    let mut next = 1 + file.elements.len();
    let mut groups = vec![("body", (1..next).collect::<Vec<usize>>())];
    for side in SIDES {
        let first = next;
        for (_, corners, nodes) in faces_of(file, side) {
            let nodes: Vec<usize> = nodes.iter().map(|&node| label(node)).collect();
            write_element(next, if corners.len() == 3 { 91 } else { 94 }, &nodes);
            next += 1;
        }
        groups.push((side, (first..next).collect()));
    }
    out.push_str("    -1\n    -1\n  2467\n");
    for (number, (name, items)) in groups.into_iter().enumerate() {
        writeln!(
            out,
            "{:10}         0         0         0         0         0         0{:10}\n{name}",
            number + 1,
            items.len()
        )
        .unwrap();
        for line in items.chunks(2) {
            line.iter()
                .for_each(|item| write!(out, "         8{item:10}         0         0").unwrap());
            out.push('\n');
        }
    }
    out + "    -1\n"
}

/// Nodes, elements and the areas of the sides; regions of Nastran are those of the comment.
fn assert_same(name: &str, found: &Mesh, expected: &Mesh, sides: [&str; 2]) {
    assert_eq!(found.labels, expected.labels, "{name}");
    assert_eq!(found.nodes, expected.nodes, "{name}");
    assert_eq!(found.element_kinds, expected.element_kinds, "{name}");
    assert_eq!(found.elements, expected.elements, "{name}");
    assert_eq!(found.regions, expected.regions, "{name}");
    for (own, side) in sides.into_iter().zip(SIDES) {
        let [own, other] =
            [(found, own), (expected, side)].map(|(mesh, name)| mesh.boundary(name).unwrap());
        assert_eq!(own.faces, other.faces, "{name} {side}");
    }
}

#[test]
fn a_body_is_the_same_to_the_bit_whatever_format_it_comes_in() {
    for kind in SOLIDS {
        let file = block(kind, [3, 2, 2], bent);
        let expected = Mesh::from_solids(&file, 1.0, &[]).unwrap();
        assert_same("inp", &body("block.inp", &inp(&file)), &expected, SIDES);
        assert_same("bdf", &body("block.bdf", &bdf(&file)), &expected, ["PLOAD4_1", "PLOAD4_2"]);
        // Dataset 2412 has no pyramid.
        if kind.corner_count() != 5 {
            assert_same("unv", &body("block.unv", &unv(&file)), &expected, SIDES);
        }
    }
}

/// Volume of all regions and area of the inner face of a quarter of a ring, by file; Gmsh wrote them all.
#[test]
fn files_that_gmsh_wrote_have_the_volume_and_the_faces_of_their_ring() {
    macro_rules! files {
        ($($name:literal),+) => { [$(($name, include_str!(concat!("../meshes/", $name)))),+] };
    }
    let files = files![
        "ring-tet10.inp",
        "ring-tet10.bdf",
        "ring-tet10.unv",
        "ring-hex20.inp",
        "ring-hex20.bdf",
        "ring-hex20.unv",
        "ring-wedge15.inp",
        "ring-wedge15.bdf",
        "ring-wedge15.unv"
    ];
    let volume = PI / 4.0 * (0.08_f64.powi(2) - 0.05_f64.powi(2)) * 0.02;
    let bottom = PI / 4.0 * (0.08_f64.powi(2) - 0.05_f64.powi(2));
    for (name, text) in files {
        let mesh = body(name, text);
        let found: f64 = mesh.region_measures().iter().sum();
        // Parabolas for arcs of 22.5 degrees.
        assert!((found / volume - 1.0).abs() < 2e-4, "{name} {found} {volume}");
        // Mid-side nodes in wrong places fold or shear elements.
        assert!(mesh.quality().worst_jacobian > 0.3, "{name}");
        if !name.ends_with("bdf") {
            let found = area(&mesh, "bottom");
            assert!((found / bottom - 1.0).abs() < 2e-4, "{name} {found} {bottom}");
        }
    }
}
