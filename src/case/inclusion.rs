//! Mesh files with the files that they include.

use crate::mesh::{MeshFormat, included_text};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Largest mesh file with all that it includes, bytes.
const LARGEST_MESH: u64 = 4 << 30;

/// Files that include each other, one in the other, at most.
const DEEPEST: usize = 32;

/// The bytes of a mesh file; lines that include a file are replaced by its text.
///
/// Names are relative to the file that names them, else to the first one.
///
/// # Errors
/// What cannot be read, with the chain of files that leads there; a file that includes itself.
pub(super) fn mesh_file(path: &Path) -> Result<Vec<u8>, String> {
    let mut left = LARGEST_MESH;
    let bytes = bytes_of(path, &mut left)
        .map_err(|reason| format!("cannot read the mesh file {}: {reason}", path.display()))?;
    let format = MeshFormat::of(&path.to_string_lossy(), &bytes);
    if format.comment().is_none() {
        return Ok(bytes);
    }
    let mut chain = vec![path.to_path_buf()];
    expanded(bytes, format, &mut chain, &mut left)
}

fn bytes_of(path: &Path, left: &mut u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let source = std::fs::File::open(path);
    let size = source
        .and_then(|source| source.take(*left + 1).read_to_end(&mut bytes))
        .map_err(|error| error.to_string())? as u64;
    if size > *left {
        return Err(format!("it is larger than {} MiB", LARGEST_MESH >> 20));
    }
    *left -= size;
    Ok(bytes)
}

/// The text of the last file of the chain with all that it includes.
fn expanded(
    bytes: Vec<u8>,
    format: MeshFormat,
    chain: &mut Vec<PathBuf>,
    left: &mut u64,
) -> Result<Vec<u8>, String> {
    let Some(comment) = format.comment() else {
        return Ok(bytes);
    };
    let text = String::from_utf8_lossy(&bytes);
    if !text.lines().any(|line| format.included(line).is_some()) {
        return Ok(bytes);
    }
    let mut out = String::with_capacity(text.len());
    for (number, line) in text.lines().enumerate() {
        let Some((name, stays)) = format.included(line) else {
            out.push_str(line);
            out.push('\n');
            continue;
        };
        let here = chain[chain.len() - 1].display().to_string();
        let at = |reason: String| {
            format!("{here}, line {}: cannot include {name}: {reason}", number + 1)
        };
        let path = found(name, chain);
        if chain.iter().any(|other| is_same(other, &path)) {
            return Err(at("it includes this file itself".to_owned()));
        }
        if chain.len() >= DEEPEST {
            return Err(at(format!("more than {DEEPEST} files include each other")));
        }
        let bytes = bytes_of(&path, left).map_err(at)?;
        chain.push(path);
        let inner = expanded(bytes, format, chain, left)?;
        chain.pop();
        if stays {
            out.push_str(line);
            out.push('\n');
        }
        out.push_str(&included_text(comment, name, &String::from_utf8_lossy(&inner)));
    }
    Ok(out.into_bytes())
}

/// Where an included file lies: beside the file that names it, else beside the first one.
fn found(name: &str, chain: &[PathBuf]) -> PathBuf {
    let beside = |file: &Path| file.parent().unwrap_or(Path::new("")).join(name);
    let path = beside(&chain[chain.len() - 1]);
    match path.exists() {
        true => path,
        false => beside(&chain[0]),
    }
}

fn is_same(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}
