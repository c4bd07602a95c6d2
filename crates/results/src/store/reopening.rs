//! Reopening of a results folder: the run that it holds, if it is whole.

use super::framed::{Defect, read_sealed};
use super::{error::FolderError, manifest::Manifest};
use crate::prelude::*;
use frictionsim_bounds::{first_of, read_text};
use std::io::ErrorKind::{NotADirectory, NotFound};
use std::path::Path;

pub(crate) const MANIFEST: &str = "manifest.json";

/// Names of the files that a run has written so far; gone when it is complete.
pub(crate) const JOURNAL: &str = ".written";

/// Name of the summary in its folder.
pub(crate) const SUMMARY: &str = "summary.json";

/// `manifest.json`: the manifest and the files that go with it.
#[derive(Serialize, Deserialize)]
pub(crate) struct Contents {
    #[serde(flatten)]
    pub(crate) manifest: Manifest,
    pub(crate) files: BTreeSet<String>,
    /// CRC-32 of the files of a finished run, hexadecimal.
    #[serde(default)]
    checksums: BTreeMap<String, String>,
}

impl Contents {
    /// Contents of these files.
    pub(crate) fn new(manifest: &Manifest, files: &BTreeMap<String, Option<u32>>) -> Self {
        let known = files.iter().filter_map(|(name, sum)| Some((name, (*sum)?)));
        Self {
            manifest: manifest.clone(),
            files: files.keys().cloned().collect(),
            checksums: known.map(|(name, sum)| (name.clone(), format!("{sum:08x}"))).collect(),
        }
    }

    /// The files and their checksums where they are known.
    pub(crate) fn into_files(self) -> BTreeMap<String, Option<u32>> {
        let checksum = |name: &String| u32::from_str_radix(self.checksums.get(name)?, 16).ok();
        self.files.iter().map(|name| (name.clone(), checksum(name))).collect()
    }
}

/// The contents of a folder: `None` if it has no manifest, or none that is whole.
pub(crate) fn read_contents(path: &Path) -> Result<Option<Contents>, FolderError> {
    let bytes = read_existing(&path.join(MANIFEST))?;
    Ok(bytes.and_then(|bytes| contents_of(&bytes).ok()))
}

/// The bytes of a file, if it is there.
pub(crate) fn read_existing(path: &Path) -> Result<Option<Vec<u8>>, FolderError> {
    match read_file(path, RESULT) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if [NotFound, NotADirectory].contains(&error.kind()) => Ok(None),
        Err(error) => Err(FolderError::io("read", path, error)),
    }
}

/// Whether a file, named from the folder on, is among the results that lie there, or could be: of a run, or of one that
/// `--force` puts there.
pub fn is_result(folder: &Path, name: &Path) -> bool {
    /// Cases that runs write.
    const WRITTEN: [&str; 2] = ["fitted.toml", "damping.toml"];
    let contents = read_contents(folder).ok().flatten();
    let is_listed =
        contents.is_some_and(|found| found.files.iter().any(|file| Path::new(file) == name));
    is_listed || WRITTEN.iter().any(|written| Path::new(written) == name)
}

fn contents_of(bytes: &[u8]) -> Result<Contents, Defect> {
    serde_json::from_value(read_sealed(bytes)?).map_err(Defect::damage)
}

/// The manifest of a results folder.
///
/// # Errors
/// [`FolderError::Unusable`] if there is none or it is damaged; those of the file system.
pub fn read_manifest(path: &Path) -> Result<Manifest, FolderError> {
    Ok(whole_contents(path)?.manifest)
}

fn whole_contents(path: &Path) -> Result<Contents, FolderError> {
    let bytes = read_existing(&path.join(MANIFEST))?;
    let bytes = bytes.ok_or_else(|| FolderError::no_results(path, without_manifest(path)))?;
    contents_of(&bytes).map_err(|defect| {
        FolderError::no_results(path, format!("its {MANIFEST} is damaged ({defect})"))
    })
}

/// Why a path has no manifest, and the folders below it that have one.
fn without_manifest(path: &Path) -> String {
    let folders_in = |path: &PathBuf| {
        let entries = fs::read_dir(path).into_iter().flatten().flatten();
        entries.map(|entry| entry.path()).filter(|path| path.is_dir()).collect::<BTreeSet<_>>()
    };
    let mut below = folders_in(&path.to_owned());
    below.extend(below.clone().iter().flat_map(folders_in));
    let found = below.iter().filter(|folder| folder.join(MANIFEST).is_file());
    let found: Vec<String> = found.map(|folder| folder.display().to_string()).collect();
    match (path.is_file(), path.exists()) {
        (true, _) => "it is a file".to_owned(),
        (_, false) => "there is no such folder".to_owned(),
        _ if found.is_empty() => format!("it has no {MANIFEST}"),
        _ => format!("it has no {MANIFEST} (results are in {})", first_of(found, 3)),
    }
}

/// The bytes of a file of a finished run, as they were written.
pub(crate) fn read_own(path: &Path, name: &str) -> Result<Vec<u8>, FolderError> {
    let contents = whole_contents(path)?;
    let did_not_end =
        || FolderError::no_results(path, format!("it has no {name}: the run did not end"));
    // A run that was killed may have replaced the file already.
    let journal = read_text(&path.join(JOURNAL), RESULT).unwrap_or_default();
    if journal.lines().any(|written| written == name) {
        return Err(did_not_end());
    }
    let bytes = read_existing(&path.join(name))?.ok_or_else(did_not_end)?;
    // A folder that several processes write has no checksums of its files.
    let is_shared = matches!(contents.manifest.command.as_str(), "sweep" | "uncertainty");
    match contents.into_files().remove(name).flatten() {
        Some(wanted) if wanted == crc32fast::hash(&bytes) => Ok(bytes),
        Some(_) => Err(FolderError::no_results(
            path,
            format!("its {name} is damaged (its checksum does not fit its contents): run it again"),
        )),
        None if is_shared => Ok(bytes),
        None => Err(did_not_end()),
    }
}
