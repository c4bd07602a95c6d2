//! Consistency check of the source tree: a module names only lower floors, and siblings do not name
//! each other.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules by floor, lowest first.
const FLOORS: [&[&str]; 7] = [
    &["linalg", "mesh", "signal"],
    &["fem"],
    &["contact"],
    &["prestress"],
    &["cea", "transient", "frf", "cycle"],
    &["case", "results"],
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

/// Top-level modules that a line of code names through `crate::`.
fn named_modules(line: &str) -> Vec<&str> {
    let code = line.split("//").next().unwrap_or("");
    code.match_indices("crate::")
        .map(|(at, pattern)| {
            let rest = &code[at + pattern.len()..];
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
            &rest[..end.unwrap_or(rest.len())]
        })
        .collect()
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
        for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            for module in named_modules(line) {
                let goes_up = floor_of(module).is_some_and(|other| other >= floor);
                if module != home && goes_up {
                    let place = format!("{}:{}", relative.display(), number + 1);
                    broken.push(format!("{place} names crate::{module}"));
                }
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn a_line_that_names_a_module_is_seen() {
    assert_eq!(
        named_modules("use crate::cea::{A, B}; crate::fem::x()"),
        ["cea", "fem"]
    );
    assert!(named_modules("// see crate::app").is_empty());
}
