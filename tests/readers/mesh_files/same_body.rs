//! One body in every format (independent checks: node orders of the manuals, and files that Gmsh wrote).

use super::*;

/// Sides of the block that the files name.
const SIDES: [&str; 2] = ["x0", "z1"];

fn bent([x, y, z]: [f64; 3]) -> [f64; 3] {
    [0.1 * x + 0.01 * y * z, 0.07 * y + 0.02 * x * x, 0.05 * z + 0.01 * x]
}

/// Element number (from 1), local face and nodes of every face of a side.
fn faces_of(file: &FileMesh, side: &str) -> Vec<(usize, Vec<usize>, Vec<u32>)> {
    let faces = file.surfaces[side].iter().map(|(kind, nodes)| {
        let corners = &nodes[..kind.corner_count()];
        let is_own = |own: &FileElement| corners.iter().all(|node| own.nodes.contains(node));
        let element = file.elements.iter().position(is_own).unwrap();
        let place = |node| file.elements[element].nodes.iter().position(|own| own == node).unwrap();
        (element + 1, corners.iter().map(place).collect(), corners.to_vec())
    });
    faces.collect()
}

/// What `kinds.txt` says of a kind: type and faces in Abaqus, card and order in Nastran, descriptor and order in universal files.
fn kind_in_files(kind: ElementKind) -> [&'static str; 6] {
    let mut lines = include_str!("../meshes/kinds.txt").lines();
    let own = format!("{kind:?} | ");
    let mut fields = lines.find_map(|line| line.strip_prefix(&own)).unwrap().split(" | ");
    [(); 6].map(|()| fields.next().unwrap())
}

/// The nodes of an element in an order of the table.
fn ordered(element: &FileElement, order: &str) -> Vec<u32> {
    let own = &element.nodes;
    let place = |at: &str| own[at.parse::<usize>().unwrap()];
    if order == "-" { own.clone() } else { order.split(' ').map(place).collect() }
}

/// Number of the face with these corners.
fn abaqus_face(faces: &str, corners: &[usize]) -> usize {
    let is_same = |face: &str| {
        let has = |corner: &usize| face.contains(&(corner + 1).to_string());
        face.len() == corners.len() && corners.iter().all(has)
    };
    1 + faces.split(' ').position(is_same).unwrap()
}

fn inp(file: &FileMesh) -> String {
    let [name, faces, ..] = kind_in_files(file.elements[0].kind);
    let mut out =
        format!("*Heading\n a block\n{}", abaqus_of(file, &format!("{name}, elset=body")));
    for side in SIDES {
        writeln!(out, "*SURFACE, NAME={side}").unwrap();
        for (element, corners, _) in faces_of(file, side) {
            writeln!(out, "{element}, S{}", abaqus_face(faces, &corners)).unwrap();
        }
    }
    out
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
    let [_, _, name, order, ..] = kind_in_files(kind);
    for element in &file.elements {
        let mut fields = vec![element.label, 7];
        fields.extend(ordered(element, order).iter().map(|&node| file.labels[node as usize]));
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
                (Tet4 | Tet10, _) => {
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

fn unv(file: &FileMesh) -> String {
    let mut out = String::from("    -1\n  2411\n");
    for (label, [x, y, z]) in file.labels.iter().zip(&file.points) {
        let [x, y, z] = [x, y, z].map(|value| format!("{value:.17e}").replace('e', "D"));
        writeln!(out, "{label:10}         1         1        11\n  {x}  {y}  {z}").unwrap();
    }
    out.push_str("    -1\n    -1\n  2412\n");
    let [.., descriptor, order] = kind_in_files(file.elements[0].kind);
    let mut write_element = |label: usize, descriptor: &str, nodes: &[usize]| {
        writeln!(out, "{label:10}{descriptor:>10}         1         1         7{:10}", nodes.len())
            .unwrap();
        for line in nodes.chunks(8) {
            line.iter().for_each(|node| write!(out, "{node:10}").unwrap());
            out.push('\n');
        }
    };
    let label = |node: u32| file.labels[node as usize];
    for element in &file.elements {
        let nodes: Vec<usize> = ordered(element, order).into_iter().map(label).collect();
        write_element(element.label, descriptor, &nodes);
    }
    let mut next = 1 + file.elements.len();
    let mut groups = vec![("body", (1..next).collect::<Vec<usize>>())];
    for side in SIDES {
        let first = next;
        for (_, corners, nodes) in faces_of(file, side) {
            let nodes: Vec<usize> = nodes.iter().map(|&node| label(node)).collect();
            write_element(next, if corners.len() == 3 { "91" } else { "94" }, &nodes);
            next += 1;
        }
        groups.push((side, (first..next).collect()));
    }
    out.push_str("    -1\n    -1\n  2467\n");
    for ((name, items), number) in groups.into_iter().zip(1..) {
        let zeros = "         0".repeat(6);
        writeln!(out, "{number:10}{zeros}{:10}\n{name}", items.len()).unwrap();
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
        let [own, other] = [found.boundary(own), expected.boundary(side)].map(Option::unwrap);
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
        // What is read is not told as left out.
        let [_, _, card, ..] = kind_in_files(kind);
        let left_out = read("block.bdf", &bdf(&file)).unwrap().model.left_out;
        assert!(!left_out.iter().any(|own| own.to_string().contains(card)), "{left_out:?}");
        // Dataset 2412 has no pyramid.
        if kind.corner_count() != 5 {
            assert_same("unv", &body("block.unv", &unv(&file)), &expected, SIDES);
        }
    }
}

/// Volume of all regions and area of the inner face of a quarter of a ring, by file; Gmsh wrote them all.
#[test]
fn files_that_gmsh_wrote_have_the_volume_and_the_faces_of_their_ring() {
    let formats = ["inp", "bdf", "unv"];
    let names = ["tet10", "hex20", "wedge15"].map(|kind| formats.map(|own| [kind, own].join(".")));
    let volume = PI / 4.0 * (0.08_f64.powi(2) - 0.05_f64.powi(2)) * 0.02;
    let bottom = PI / 4.0 * (0.08_f64.powi(2) - 0.05_f64.powi(2));
    for name in names.as_flattened() {
        let path = format!("{}/tests/readers/meshes/ring-{name}", env!("CARGO_MANIFEST_DIR"));
        let mesh = body(name, &fs::read_to_string(path).unwrap());
        let found: f64 = mesh.region_measures().iter().sum();
        // Parabolas for arcs of 22.5 degrees.
        assert!((found / volume - 1.0).abs() < 2e-4, "{name} {found} {volume}");
        // Mid-side nodes in wrong places fold or shear elements.
        assert!(mesh.quality().worst_jacobian > 0.3, "{name}");
        if !name.ends_with("bdf") {
            let found = mesh.face_area(&mesh.boundaries[boundary(&mesh, "bottom")].faces);
            assert!((found / bottom - 1.0).abs() < 2e-4, "{name} {found} {bottom}");
        }
    }
}
