//! Cases that are read from a text, under changes of which several stand in one with ` ; ` between.

use frictionsim::case::Case;
use std::path::{Path, PathBuf};

/// A case whose files lie beside `path`, or what is said of it.
pub fn read_case<S: AsRef<str>>(
    path: impl AsRef<Path>,
    text: &str,
    changes: &[S],
) -> Result<Case, String> {
    let changes = changes.iter().flat_map(|text| text.as_ref().split(" ; "));
    let changes: Vec<String> = changes.map(str::to_owned).collect();
    let case = Case::parse(path.as_ref().to_str().unwrap(), text.as_bytes(), &changes);
    case.map_err(|errors| errors.to_string())
}

/// A case that must be valid.
#[track_caller]
pub fn case_of<S: AsRef<str>>(path: impl AsRef<Path>, text: &str, changes: &[S]) -> Case {
    read_case(path, text, changes).unwrap_or_else(|errors| panic!("{errors}"))
}

#[track_caller]
pub fn shipped_case<S: AsRef<str>>(name: &str, changes: &[S]) -> Case {
    let path = format!("{}/cases/{name}", env!("CARGO_MANIFEST_DIR"));
    case_of(&path, &std::fs::read_to_string(&path).unwrap(), changes)
}

/// A folder of a name, which stays.
pub fn kept(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// No changes.
pub const AS_IT_IS: &[&str] = &[];
