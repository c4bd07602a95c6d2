//! Mesh files of both versions, as texts and in binary.

use crate::fuzz::hold;
use crate::fuzz::mutation::{Random, binary, text};
use crate::msh::{FORMS, write_msh};
use frictionsim::mesh::{
    AnnulusMesh, AnnulusSpecification, BodySpecification, BoundaryCondition,
    CounterfaceSpecification, ElementKind, FileMesh, Mesh,
};

fn ring(element: ElementKind) -> Mesh {
    let specification = AnnulusSpecification {
        inner_radius: 0.02,
        outer_radius: 0.09,
        circumferential_elements: 5,
        radial_elements: 2,
        radial_grading: 1.0,
        element,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    };
    AnnulusMesh::generate(&specification).unwrap().mesh
}

#[test]
fn no_mesh_file_makes_its_reader_panic() {
    let meshes = [ElementKind::Quad4, ElementKind::Quad8].map(ring);
    let files = meshes.iter().flat_map(|mesh| {
        let numbers: Vec<usize> = (1..=mesh.node_count()).collect();
        FORMS.map(|form| (form, write_msh(mesh, form, &numbers, |point| point)))
    });
    let (binaries, texts): (Vec<_>, Vec<_>) = files.partition(|(form, _)| form.is_binary);
    let [binaries, texts] =
        [binaries, texts].map(|files| files.into_iter().map(|file| file.1).collect::<Vec<_>>());
    let specification = BodySpecification {
        scale: 1.0,
        contact: "inner".to_owned(),
        counterface: CounterfaceSpecification::Cylinder { center: [0.0; 2], radius: None },
        opposite: None,
        conditions: vec![("outer".to_owned(), BoundaryCondition::Clamped)],
    };
    hold(
        "mesh",
        |random: &mut Random| match random.below(2) {
            0 => text(random, &texts),
            _ => {
                let file = random.below(binaries.len());
                binary(random, &binaries[file])
            }
        },
        |bytes| {
            if let Ok(file) = FileMesh::read(bytes) {
                // Counts that a file only claims take no room.
                assert!(file.points.len() <= bytes.len() && file.elements.len() <= bytes.len());
                drop(Mesh::from_gmsh(&file, &specification));
            }
        },
    );
}

/// Files of other programs, of solid bodies with all that such files hold.
const OTHERS: [(&str, &str); 6] = [
    ("bricks.inp", crate::mesh_files::ASSEMBLY),
    ("brick.bdf", crate::mesh_files::BULK_DATA),
    ("brick.unv", crate::mesh_files::UNIVERSAL),
    ("ring.inp", include_str!("../meshes/ring-hex20.inp")),
    ("ring.bdf", include_str!("../meshes/ring-hex20.bdf")),
    ("ring.unv", include_str!("../meshes/ring-hex20.unv")),
];

#[test]
fn no_file_of_another_program_makes_its_reader_panic() {
    hold(
        "other-mesh",
        |random: &mut Random| {
            // Which reader it is stands in the first byte.
            let number = random.below(OTHERS.len());
            let original = OTHERS[number].1.as_bytes().to_vec();
            let changed = match random.below(8) {
                0 => original[..random.below(original.len())].to_vec(),
                1 => binary(random, &original),
                _ => text(random, &[original]),
            };
            [vec![number as u8], changed].concat()
        },
        |bytes| {
            let (name, _) = OTHERS[usize::from(bytes[0])];
            let bytes = &bytes[1..];
            match FileMesh::read_as(name, bytes) {
                Ok(file) => {
                    assert!(file.points.len() <= 3 * bytes.len());
                    assert!(file.elements.len() <= 3 * bytes.len());
                    drop(Mesh::from_solids(&file, 1.0, &[]));
                }
                Err(error) => assert!(!error.to_string().is_empty()),
            }
        },
    );
}
