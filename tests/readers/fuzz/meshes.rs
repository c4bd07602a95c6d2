//! Mesh files of both versions, as texts and in binary.

use crate::mesh_files::{ASSEMBLY, BULK_DATA, UNIVERSAL};
use crate::prelude::*;

#[test]
fn no_mesh_file_makes_its_reader_panic() {
    let meshes = [Quad4, Quad8]
        .map(|element| AnnulusMesh::generate(&ring([0.02, 0.09], element, 5, 2)).unwrap().mesh);
    let [binaries, texts] = [true, false].map(|is_binary| {
        let forms = FORMS.iter().filter(|form| form.is_binary == is_binary);
        let files = forms.flat_map(|form| meshes.iter().map(|mesh| (mesh, *form)));
        files.map(|(mesh, form)| write_msh(mesh, form, &[], |p| p)).collect::<Vec<_>>()
    });
    let specification = plane_body("inner", CYLINDER, None, &[("outer", Clamped)]);
    let make = |random: &mut Random| either(random, &texts, &binaries);
    hold("mesh", make, |bytes| {
        if let Ok(file) = FileMesh::read(bytes) {
            // Counts that a file only claims take no room.
            assert!(file.points.len() <= bytes.len() && file.elements.len() <= bytes.len());
            drop(Mesh::from_gmsh(&file, &specification));
        }
    });
}

/// Files of other programs, of solid bodies with all that such files hold.
const OTHERS: [(&str, &str); 6] = [
    ("bricks.inp", ASSEMBLY),
    ("brick.bdf", BULK_DATA),
    ("brick.unv", UNIVERSAL),
    ("ring.inp", include_str!("../meshes/ring-hex20.inp")),
    ("ring.bdf", include_str!("../meshes/ring-hex20.bdf")),
    ("ring.unv", include_str!("../meshes/ring-hex20.unv")),
];

#[test]
fn no_file_of_another_program_makes_its_reader_panic() {
    // Which reader it is stands in the first byte.
    let make = |random: &mut Random| {
        let number = random.below(OTHERS.len());
        let original = OTHERS[number].1.as_bytes().to_vec();
        let changed = match random.below(8) {
            0 => original[..random.below(original.len())].to_vec(),
            1 => binary(random, &original),
            _ => text(random, &[original]),
        };
        [vec![number as u8], changed].concat()
    };
    hold("other-mesh", make, |bytes| {
        let ((name, _), bytes) = (OTHERS[usize::from(bytes[0])], &bytes[1..]);
        match FileMesh::read_as(name, bytes) {
            Ok(file) => {
                assert!(file.points.len().max(file.elements.len()) <= 3 * bytes.len());
                drop(Mesh::from_solids(&file, 1.0, &[]));
            }
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    });
}

/// Text of a deck with sets that name each other, includes in place, and systems in systems.
fn references(random: &mut Random) -> (&'static str, String) {
    let mut more = String::new();
    let count = 1 + random.below(40);
    for k in 0..count {
        let [other, again] = [0, 1].map(|_| random.below(count));
        let [own, before, node, beside, system] =
            [10 + k, 10 + other, 50 + k, 50 + other, 10 + again];
        more += &match random.below(4) {
            0 => format!("CORD2R,{own},{before},1.,0.,0.,1.,0.,1.,\n,2.,0.,0.\n"),
            1 => format!("CORD1R,{own},{beside},2,3\nGRID,{node},{system},1.,0.,0.\n"),
            2 => format!("*NSET, NSET=s{k}\ns{other}, s{again}, One.Foot\n"),
            _ => format!("*ELSET, ELSET=e{k}\ne{other}, e{again}, One.All\n"),
        };
    }
    // Lines that the other format does not know are no lines of this one.
    let is_deck = random.below(2) == 0;
    let own = |line: &&str| line.starts_with(['*', 's', 'e']) == is_deck;
    let own: String = more.lines().filter(own).flat_map(|line| [line, "\n"]).collect();
    let decks = [("a.bdf", BULK_DATA, "CORD2C,2,1"), ("a.inp", ASSEMBLY, "*TIE, NAME")];
    let (name, whole, place) = decks[usize::from(is_deck)];
    (name, whole.replace(place, &format!("{own}{place}")))
}

#[test]
fn no_sets_or_systems_that_name_each_other_make_their_reader_panic() {
    // The name stands before the text.
    let make = |random: &mut Random| {
        let (name, whole) = references(random);
        let whole = whole.into_bytes();
        let changed = if random.below(2) == 0 { whole } else { text(random, &[whole]) };
        [name.as_bytes(), &changed].concat()
    };
    hold("references", make, |bytes| {
        drop(FileMesh::read_as(std::str::from_utf8(&bytes[..5]).unwrap(), &bytes[5..]));
    });
}

/// Three files that include each other in changed ways, as a case reads them.
#[test]
fn no_includes_make_a_case_panic() {
    let folder = folder();
    let path = folder.path().join("case.toml").display().to_string();
    let case = "[mesh]\nfile = \"a.inp\"\n[cea]\nmodes = 3\n";
    let brick = ASSEMBLY.as_bytes().to_vec();
    let more = "*NODE, INPUT=c.inp\n*INCLUDE, INPUT=c.inp\n";
    let originals = ["b", "c", "a"].map(|name| format!("*INCLUDE, INPUT={name}.inp\n{more}"));
    let originals = originals.map(String::into_bytes).to_vec();
    let corpus = [originals, vec![b"1, 0., 0., 0.\n".to_vec(), brick]].concat();
    let make = |random: &mut Random| [0, 1, 2].map(|_| text(random, &corpus)).join(&b'\x01');
    hold("includes", make, |bytes| {
        for (name, part) in ["a", "b", "c"].iter().zip(bytes.split(|byte| *byte == 1)) {
            fs::write(folder.path().join(format!("{name}.inp")), part).unwrap();
        }
        if let Err(errors) = Case::parse(&path, case.as_bytes(), &[]) {
            assert!(!errors.to_string().is_empty());
        }
    });
}

/// Size lines and entries of matrices.
#[test]
fn no_matrix_makes_its_reader_panic() {
    let banner = "%%MatrixMarket matrix";
    let corpus = [
        format!("{banner} coordinate real symmetric\n% c\n2 2 2\n1 1 4\n2 1 -1\n"),
        format!("{banner} array real general\n2 2\n1\n2\n3\n4\n"),
        format!("{banner} array integer skew-symmetric\n3 3\n7\n8\n9\n"),
    ]
    .map(String::into_bytes);
    let make = |random: &mut Random| text(random, &corpus);
    hold("matrix", make, |bytes| {
        if let Ok(matrix) = MarketMatrix::read(&String::from_utf8_lossy(bytes), 2000) {
            assert!(matrix.entries.len() <= 2 * bytes.len());
        }
    });
}
