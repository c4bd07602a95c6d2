//! Mesh files with the files that they include.

use crate::*;
use frictionsim_bounds::{Budget, MESH, Refusal};
use frictionsim_physics::mesh::{MeshFormat, included_text};
use std::path::PathBuf;

/// The bytes of a mesh file; lines that include a file are replaced by its text.
///
/// Names are relative to the file that names them, else to the first one.
pub(super) fn mesh_file(path: &Path) -> Result<Vec<u8>, String> {
    let mut budget = Budget::new(MESH);
    let bytes = read(&mut budget, path)
        .map_err(|reason| format!("cannot read the mesh file {}: {reason}", path.display()))?;
    let format = MeshFormat::of(&path.to_string_lossy(), &bytes);
    let text = String::from_utf8_lossy(&bytes);
    if !text.lines().any(|line| format.included(line).is_some()) {
        return Ok(bytes);
    }
    let mut expansion = Expansion { format, chain: vec![path.to_path_buf()], budget };
    expansion.expanded(&text).map(String::into_bytes)
}

/// A file without the byte order mark that editors on Windows put before a text.
fn read(budget: &mut Budget, path: &Path) -> Result<Vec<u8>, Refusal> {
    const MARK: &[u8] = "\u{feff}".as_bytes();
    let mut bytes = budget.read(path)?;
    bytes.drain(..if bytes.starts_with(MARK) { MARK.len() } else { 0 });
    Ok(bytes)
}

/// A text on its way to one without includes.
struct Expansion {
    format: MeshFormat,
    /// The first file and those that lead to the present one.
    chain: Vec<PathBuf>,
    budget: Budget,
}

impl Expansion {
    /// The text of the last file of the chain with all that it includes.
    fn expanded(&mut self, text: &str) -> Result<String, String> {
        let mut out = String::with_capacity(text.len());
        for (number, line) in text.lines().enumerate() {
            let included = self.format.included(line);
            if included.is_none_or(|(_, stays)| stays) {
                out.push_str(line);
                out.push('\n');
            }
            let Some((name, _)) = included else { continue };
            let here = self.chain[self.chain.len() - 1].display().to_string();
            let at = |reason: String| {
                format!("{here}, line {}: cannot include {name}: {reason}", number + 1)
            };
            let path = self.found(name);
            let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
            if self.chain.iter().any(|other| real(other) == real(&path)) {
                return Err(at("it includes this file itself".to_owned()));
            }
            let depth = self.budget.descend(self.chain.len(), "files");
            let bytes = depth.and_then(|()| read(&mut self.budget, &path));
            let bytes = bytes.map_err(|reason| at(reason.to_string()))?;
            self.chain.push(path);
            let inner = self.expanded(&String::from_utf8_lossy(&bytes))?;
            self.chain.pop();
            let comment = self.format.comment().unwrap_or_default();
            out.push_str(&included_text(comment, name, &inner));
        }
        Ok(out)
    }

    /// Where an included file lies: beside the file that names it, else beside the first one.
    fn found(&self, name: &str) -> PathBuf {
        let beside = |file: &Path| file.parent().unwrap_or(Path::new("")).join(name);
        let path = beside(&self.chain[self.chain.len() - 1]);
        if path.exists() { path } else { beside(&self.chain[0]) }
    }
}
