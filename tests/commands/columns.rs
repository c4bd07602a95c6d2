//! The reference of columns is what the program writes, and the guide's page is the reference.

use crate::prelude::*;
use frictionsim::results::reference::{markdown, reference};
use rayon::prelude::*;

/// Holds a page of the guide to what the declarations say; `FRICTIONSIM_WRITE_TABLE=1` writes it.
pub fn guide_has(name: &str, table: &str) {
    let path = format!("{}/src/guide/{name}.md", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).unwrap();
    let [start, end] =
        [format!("<!-- {name}: generated -->\n"), format!("\n<!-- end of the {name} -->")];
    let (head, rest) = text.split_once(&start).unwrap();
    let (stored, tail) = rest.split_once(&end).unwrap();
    let table = table.trim_end();
    if std::env::var_os("FRICTIONSIM_WRITE_TABLE").is_some() {
        fs::write(path, format!("{head}{start}{table}{end}{tail}")).unwrap();
    } else {
        let same = stored == table;
        assert!(same, "src/guide/{name}.md is not what `frictionsim {name} --markdown` prints");
    }
}

#[test]
fn the_guide_documents_every_column_as_it_is_declared() {
    let mut entries = reference().into_iter().flat_map(|file| file.entries);
    assert_eq!(entries.find(|own| own.meaning.is_empty()).map(|own| own.key), None);
    guide_has("columns", &markdown());
}

/// Shows every value below one with its path, `[]` for each entry of a list.
pub fn visit_all(path: &str, value: &Value, visit: &mut dyn FnMut(&str, &Value)) {
    let dot = if path.is_empty() { "" } else { "." };
    let place = |(key, own)| (format!("{path}{dot}{key}"), own);
    let below: Vec<(String, &Value)> = match value {
        Value::Object(object) => object.iter().map(place).collect(),
        Value::Array(list) => list.iter().map(|own| (format!("{path}[]"), own)).collect(),
        _ => Vec::new(),
    };
    for (path, own) in below {
        visit(&path, own);
        visit_all(&path, own, visit);
    }
}

/// Columns of whole numbers, and of yes and no.
const COUNTS: [&str; 9] =
    ["branch", "harmonic", "mode", "node", "onset", "periods", "phases", "point", "sample"];
const FLAGS: [&str; 4] = ["fold", "stable", "unstable", "unstable_from_start"];

/// Whether a text has a number of more than nine digits.
fn has_long_number(text: &str) -> bool {
    text.split(|c: char| !(c.is_ascii_digit() || c == '.')).into_iter().any(|number| {
        number.chars().filter(char::is_ascii_digit).collect::<String>().trim_matches('0').len() > 9
    })
}

fn check(command: &str, case: &str, set: &[&str]) {
    let answer = Run::of(command, shipped(case)).out("out").set(set).done();
    assert!(!has_long_number(&answer.stdout), "{}", answer.stdout);
    let all = reference();
    let mut read = 0;
    for name in names_in(&answer.out) {
        let path = answer.path(&name);
        let mut names = Vec::new();
        if name.ends_with(".csv") {
            let mut table = csv::Reader::from_path(&path).unwrap();
            names.extend(table.headers().unwrap().iter().map(str::to_owned));
            for row in rows(&path) {
                for (column, cell) in row.0.iter().filter(|own| !own.1.is_empty()) {
                    let is_count = !COUNTS.contains(&&**column) || cell.parse::<i64>().is_ok();
                    let is_flag = !FLAGS.contains(&&**column) || cell.parse::<bool>().is_ok();
                    // Branches are counted from 1, as their column says.
                    let is_right = is_count && is_flag && (column != "branch" || cell != "0");
                    assert!(is_right, "{command}: {column} of {name} is {cell}");
                }
            }
        } else if name == "summary.json" {
            visit_all("", &answer.summary(), &mut |path, _| names.push(path.to_owned()));
            names.retain(|path| !path.ends_with("[]"));
        }
        let is_named = |pattern: &str, any: &str, name: &str| match pattern.split_once(any) {
            Some((start, end)) => name.starts_with(start) && name.ends_with(end),
            None => pattern == name,
        };
        let mut files = all.iter().filter(|file| file.command == command);
        let own = files.find(|file| is_named(file.file, "N", &name));
        let Some(own) = own else {
            assert!(names.is_empty(), "{command}: {name} is not declared");
            continue;
        };
        read += 1;
        let branch = own.entries.iter().find(|entry| entry.key == "branch");
        assert!(branch.is_none_or(|entry| entry.meaning.ends_with("from 1")), "{command}: {name}");
        for name in names {
            let is_known = own.entries.iter().any(|entry| is_named(&entry.key, "KEY", &name));
            assert!(is_known, "{command}: {} has {name}, which is not declared", own.file);
        }
    }
    assert!(read > 0, "{command} wrote nothing that is declared");
}

/// A mesh held at its bore alone; cycles of waves and of a whole mesh.
#[test]
fn every_column_and_key_that_a_command_writes_is_declared() {
    let coarse = "mesh.circumferential_elements=24 ; mesh.radial_elements=4";
    let few = "cea.friction_coefficients=[0.0,0.15,0.3] ; cea.sensitivities=true";
    let samples =
        "cea.max_frequency_hz=14000 ; uncertainty.samples=16 ; uncertainty.index_samples=0";
    let meshes = "convergence={factors=[0.5,0.75,1]} ; cea.friction_coefficients=[0.0,0.3]";
    let cycle = "mesh.circumferential_elements=90 ; mesh.radial_elements=18 ; cycle.frames=1 ; \
                 cycle.continuation.count=3 ; cycle.stability=point";
    let short = "transient.duration=2e-3 ; output={ probes = [1] }";
    let rows: [(&str, &str, &[&str]); 10] = [
        ("cea", "polycarbonate-disc.toml", &[coarse, few]),
        ("mesh", "polycarbonate-disc.toml", &[coarse]),
        ("mesh", "ring-on-disc.toml", &[coarse]),
        ("mesh", "brake.toml", &[]),
        ("transient", "polycarbonate-610rpm.toml", &[coarse, short]),
        ("matrices", "tread-block.toml", &[]),
        ("uncertainty", "squeal-probability.toml", &[coarse, samples]),
        ("convergence", "polycarbonate-disc.toml", &[coarse, meshes]),
        ("cycle", "limit-cycle.toml", &[cycle]),
        ("cycle", "sliding-block.toml", &["contact.friction_coefficient=0.7 ; cycle={}"]),
    ];
    rows.into_par_iter().for_each(|(command, case, set)| check(command, case, set));
}

#[test]
fn columns_lists_what_holds_a_word_and_says_where_nothing_does() {
    let columns = |word: &str| Run::new(&["columns", word]);
    columns("mesh_error").done().says(&["eigenvalues.csv of cea", "mesh_error"]);
    columns("nonesuch").refused(&[]);
}
