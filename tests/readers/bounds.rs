//! Bounds on what is read: input that is small to write and had no end, or ended in an abort or a panic.

use crate::mesh_files::{ASSEMBLY, BULK_DATA, error, said_of};
use crate::prelude::*;
use frictionsim::signal::reader::read_shapes;

const MESH: &str = "[mesh]\nfile = \"a.inp\"\n[cea]\nmodes = 3\n";

#[test]
fn a_huge_size_line_of_a_matrix_is_refused_before_places_are_made() {
    for kind in ["array", "coordinate"] {
        for size in ["18446744073709551615 18446744073709551615", "4000000000 4000000000"] {
            let entries = if kind == "array" { "" } else { " 1" };
            let text = format!("%%MatrixMarket matrix {kind} real general\n{size}{entries}\n1\n");
            let error = MarketMatrix::read(&text, 2000).unwrap_err().to_string();
            has(&error, &["is larger than 2000 x 2000"]);
        }
    }
}

#[test]
fn files_that_include_each_other_twice_are_refused() {
    let ends = [("f25.inp", "** nothing\n"), ("a.inp", "*INCLUDE, INPUT=f0.inp\n")];
    let folder = folder_with(&ends.map(|(name, text)| (name, text.as_bytes())));
    for k in 0..25 {
        let next = format!("*INCLUDE, INPUT=f{}.inp\n", k + 1);
        fs::write(folder.path().join(format!("f{k}.inp")), next.repeat(2)).unwrap();
    }
    has(&said_of(folder.path(), MESH), &["more than 10000 files are included"]);
}

#[test]
fn sets_that_list_another_twice_have_each_member_once() {
    let mut sets = String::new();
    for k in 0..60 {
        let before = if k == 0 { "One.Foot".to_owned() } else { format!("twice{}", k - 1) };
        writeln!(sets, "*NSET, NSET=twice{k}\n{before}, {before}").unwrap();
    }
    let text = ASSEMBLY.replace("*TIE, NAME", &format!("{sets}*TIE, NAME"));
    let file = FileMesh::read_as("a.inp", text.as_bytes()).unwrap();
    assert_eq!(file.surfaces["twice59"].len(), file.surfaces["One_Foot"].len());
}

/// The last of 20,000 systems, each moved by 1e-3 along x in the one before, places a node at x = 20 + 1.
#[test]
fn a_long_chain_of_coordinate_systems_is_walked() {
    let mut chain = String::new();
    for k in 0..20_000_usize {
        let before = if k == 0 { 0 } else { 100 + k - 1 };
        writeln!(chain, "CORD2R,{},{before},.001,0.,0.,.001,0.,1.,\n,1.,0.,0.", 100 + k).unwrap();
    }
    let text = BULK_DATA
        .replace("CORD2C,2,1", &format!("{chain}CORD2C,2,1"))
        .replace("GRID,7,1,1.,2.,3.", "GRID,7,20099,1.,2.,3.");
    let file = FileMesh::read_as("a.bdf", text.as_bytes()).unwrap();
    let node = file.labels.iter().position(|&label| label == 7).unwrap();
    assert!((file.points[node][0] - 21.0).abs() < 1e-6, "{:?}", file.points[node]);
}

#[test]
fn coordinates_beyond_reason_are_refused_with_their_node() {
    let far = ASSEMBLY.replace("7, 1.0D0, 2.0d0, 3.", "7, 1.0, -1e308, 3.");
    has(&error("a.inp", &far), &["node 7 lies at"]);
    let folder = folder_with(&[("a.bdf", BULK_DATA.replace("FORCE ", "$").as_bytes())]);
    let case = "[mesh]\nfile = \"a.bdf\"\nscale = 1e300\n[cea]\nmodes = 3\n";
    has(&said_of(folder.path(), case), &["no coordinate may be beyond 1e12"]);
}

#[test]
fn shapes_beyond_the_range_of_numbers_are_refused() {
    for value in ["-inf", "1e200", "nan"] {
        let nodes =
            "    -1\n  2411\n         1         1         1        11\n 0.0 0.0 0.0\n    -1\n";
        let head = "    -1\n    55\nA\nB\nC\nD\nE\n 1 2 2 8 2 3\n 2 4 0 1\n 100. 1. 0. 0.\n";
        let text = format!("{nodes}{head}         1\n {value} 0.0 0.0\n    -1\n");
        let said = read_shapes(text.as_bytes(), "s.unv").unwrap_err().to_string();
        has(&said, &["not finite, or beyond 1e100"]);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_a_file_is_refused() {
    let folder = folder_with(&[]);
    let pipe = folder.path().join("a.inp");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    // Nothing that follows from it stands before it.
    has(said_of(folder.path(), MESH).lines().next().unwrap(), &["it is not a regular file"]);
    fs::write(folder.path().join("b.inp"), "*INCLUDE, INPUT=a.inp\n").unwrap();
    let said = said_of(folder.path(), &MESH.replace("a.inp", "b.inp"));
    has(&said, &["b.inp, line 1: cannot include a.inp: it is not a regular"]);
    // Among results, too.
    fs::rename(&pipe, folder.path().join("manifest.json")).unwrap();
    let said = frictionsim::results::read_manifest(folder.path()).unwrap_err().to_string();
    has(&said, &["manifest.json"]);
}

#[test]
fn a_hundred_thousand_unknown_keywords_take_moments_and_messages_stay_short() {
    let words: String = (0..100_000).map(|k| format!("*WORD{k}\n")).collect();
    let text = ASSEMBLY.to_owned() + &words;
    let start = Instant::now();
    let file = FileMesh::read_as("a.inp", text.as_bytes()).unwrap();
    assert!(file.model.left_out.len() > 100_000);
    assert!(start.elapsed().as_secs_f64() < 5.0, "{:?}", start.elapsed());
    let long = "x".repeat(1 << 20);
    for before in ["MATERIAL=", "*NSET, NSET=Corner, INSTANCE="] {
        let text = ASSEMBLY.replacen(before, &format!("{before}{long}"), 1);
        assert!(error("a.inp", &text).len() < 1000);
    }
}

/// Closed form of the mesh and what is held: the brick of the bulk data, with cards that join it.
#[test]
fn what_joins_parts_and_is_not_understood_is_an_error_unless_the_case_drops_it() {
    let cards = "RBE2,90,1,123,2,3\nRBE2,91,1,123,3,4\nCONM2,92,2,0,0.5\nENDDATA";
    let deck = BULK_DATA.replace("ENDDATA", cards);
    let folder = folder_with(&[("a.bdf", deck.as_bytes())]);
    let case = "[mesh]\nfile = \"a.bdf\"\n";
    let path = folder.path().join("case.toml");
    let errors = read_case(&path, case, AS_IT_IS).unwrap_err();
    let line = 1 + deck.lines().position(|line| line.starts_with("RBE2,90")).unwrap();
    let [before, after] = [line - 1, line + 2];
    let listed =
        format!("FORCE (line {before} ; RBE2 (line {line}, 2 times) ; CONM2 (line {after})");
    let whole = "a.bdf holds, loads or joins parts by what is not understood: FORCE (line ; \
                 the answer would be that of another structure";
    has(&errors.messages().join("\n"), &[&listed, whole]);
    has(&errors.to_string(), &["drop = [\"CONM2\", \"FORCE\", \"RBE2\"]"]);
    // One that is not named stays an error.
    let some = format!("{case}drop = [\"RBE2\", \"FORCE\"]\n");
    has(&said_of(folder.path(), &some), &["CONM2 ; !RBE2"]);
    // What is dropped is listed.
    let all = format!("{case}drop = [\"RBE2\", \"FORCE\", \"conm2\"]\n");
    let dropped = format!("RBE2 (line {line}, 2 times): mesh.drop leaves it out");
    has(&case_of(path, &all, AS_IT_IS).taken.not_used().join("\n"), &[&dropped]);
    // `init --from` proposes no silent drop.
    let text = case_from(&folder.path().join("a.bdf"), "a.bdf").unwrap();
    has(&text, &["\n# drop = [\"CONM2\", \"FORCE\", \"RBE2\"]\n"]);
}

#[test]
fn keywords_of_an_input_file_that_hold_load_or_join_parts_are_told_from_others() {
    for (keyword, is_part) in [
        ("*COUPLING, REF NODE=1, SURFACE=Top, CONSTRAINT NAME=c", true),
        ("*KINEMATIC", true),
        ("*MASS, ELSET=point", true),
        ("*SPRING, ELSET=s", true),
        ("*RIGID BODY, NSET=n, REF NODE=1", true),
        ("*PRE-TENSION SECTION, SURFACE=s, NODE=1", true),
        ("*SHELL SECTION, ELSET=shells, MATERIAL=Mat", true),
        ("*AMPLITUDE, NAME=a", false),
        ("*TEMPERATURE", false),
        ("*EXPANSION", false),
    ] {
        let file = FileMesh::read_as("a.inp", format!("{ASSEMBLY}{keyword}\n").as_bytes()).unwrap();
        let card = keyword.split(',').next().unwrap();
        let found = file.model.left_out.iter().find(|own| own.card() == card).unwrap();
        assert_eq!(found.is_part, is_part, "{keyword}");
        assert!(found.is_named(&card.to_lowercase()) && !found.is_named(&card[..3]));
    }
}
