//! Consistency check of the source tree: a module names only lower floors, and siblings do not name
//! each other.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules by floor, lowest first.
const FLOORS: [&[&str]; 9] = [
    &["linalg", "mesh", "signal", "chart"],
    &["fem"],
    &["contact"],
    &["prestress"],
    &["cea", "transient", "frf"],
    &["cycle"],
    &["case", "results"],
    &["study"],
    &["app"],
];

fn floor_of(module: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&module))
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// Top-level modules that code names through `crate::`, brace groups included, with the line of each.
fn named_modules(code: &str) -> Vec<(usize, String)> {
    let stripped: Vec<&str> = code
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""))
        .collect();
    let stripped = stripped.join("\n");
    let mut named = Vec::new();
    for (at, pattern) in stripped.match_indices("crate::") {
        let line = stripped[..at].matches('\n').count() + 1;
        let rest = &stripped[at + pattern.len()..];
        let paths = match rest.strip_prefix('{') {
            Some(group) => top_level_items(group),
            None => vec![rest],
        };
        for path in paths {
            let path = path.trim_start();
            let end = path.find(|c: char| !c.is_alphanumeric() && c != '_');
            named.push((line, path[..end.unwrap_or(path.len())].to_string()));
        }
    }
    named
}

/// Items of a `use` group up to its closing brace, nested groups left whole.
fn top_level_items(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, character) in group.char_indices() {
        match character {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                items.push(&group[start..at]);
                start = at + 1;
                if character == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    items
}

#[test]
fn every_module_names_only_lower_floors() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    assert!(files.len() > 10, "the source tree was not found");
    let mut broken = Vec::new();
    for path in files {
        let relative = path.strip_prefix(&source).unwrap();
        let home = relative.iter().next().unwrap().to_str().unwrap();
        let Some(floor) = floor_of(home.trim_end_matches(".rs")) else {
            assert!(
                matches!(home, "lib.rs" | "main.rs"),
                "{} stands on no floor",
                relative.display()
            );
            continue;
        };
        for (line, module) in named_modules(&fs::read_to_string(&path).unwrap()) {
            let goes_up = floor_of(&module).is_some_and(|other| other >= floor);
            if module != home && goes_up {
                let place = format!("{}:{line}", relative.display());
                broken.push(format!("{place} names crate::{module}"));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// The producers of eigenproblems stand side by side on one theory, which knows neither; faer is the affair of `linalg`.
#[test]
fn the_eigenvalue_theory_names_none_of_its_producers_and_they_not_each_other() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cea");
    let mut files = Vec::new();
    rust_files(&home, &mut files);
    for path in files {
        let place = path.strip_prefix(&home).unwrap().to_str().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let lines = text
            .lines()
            .map(|line| line.split("//").next().unwrap_or(""));
        let code = lines.collect::<Vec<_>>().join("\n");
        let forbidden: &[&str] = match place {
            "mod.rs" => &["faer::"],
            _ if place.starts_with("sparse") => &["faer::", "cyclic::"],
            _ if place.starts_with("cyclic") => &["faer::", "sparse::"],
            _ => &["faer::", "sparse::", "cyclic::"],
        };
        for name in forbidden {
            assert!(!code.contains(name), "{place} names {name}");
        }
    }
}

#[test]
fn every_way_to_name_a_module_is_seen() {
    let code = "use crate::cea::{A, B}; // crate::app\nuse crate::{fem::{X, y}, mesh};\ncrate::linalg::z()";
    let named = named_modules(code);
    let expected = [(1, "cea"), (2, "fem"), (2, "mesh"), (3, "linalg")];
    assert_eq!(named, expected.map(|(line, name)| (line, name.to_string())));
}
