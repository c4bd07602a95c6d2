//! Limits of the system and of this program on files: how large they may become, how much of one is read.

use super::{Failure, shipped};
use crate::case::nearest;
use frictionsim_bounds::{Budget, Limits, Refusal};
use std::{collections::BTreeSet, fs::File, io, path::Path};

/// Makes a write beyond the file size limit of the shell (`ulimit -f`) an error, as on a full disk, where the signal of
/// it would end the process without a word.
pub fn refuse_writes_beyond_limit() {
    #[cfg(unix)]
    {
        let noticed = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        // Without the handler such a write ends the process, which is no reason not to begin.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, noticed);
    }
}

/// The name that stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Reads a file, a pipe or standard input within the limits of its kind.
///
/// # Errors
/// [`Failure::Usage`] with the file's name: it cannot be read, or has no end within the limit.
pub fn read_input(path: &Path, limits: Limits) -> Result<Vec<u8>, Failure> {
    let mut budget = Budget::new(limits);
    let read = match path == Path::new(STANDARD_INPUT) {
        true => budget.read_all(io::stdin().lock()),
        false => File::open(path).map_err(Refusal::from).and_then(|file| budget.read_all(file)),
    };
    let name = input_name(path);
    read.map_err(|refusal| match refusal {
        Refusal::Bytes { most, .. } => {
            format!("{name} is larger than {} MiB, the limit for such files", most >> 20)
        }
        _ if path.is_dir() => format!("cannot read {name}: it is a folder"),
        _ if !path.exists() => format!("cannot read {name}: {}", missing(path)),
        other => format!("cannot read {name}: {other}"),
    })
    .map_err(Failure::usage)
}

/// Where a file was looked for, and what may be meant.
fn missing(path: &Path) -> String {
    let place = std::path::absolute(path).unwrap_or(path.to_owned());
    let near = near_file(path).map(|near| format!("did you mean {near}?"));
    let all = || "`frictionsim init --all` writes the shipped cases".to_owned();
    let begin = || "`frictionsim init cea -o FILE` writes a case to begin with".to_owned();
    let is_shipped =
        shipped::all_files().iter().any(|(file, _)| Some(file.as_ref()) == path.file_name());
    let help = near.or_else(|| is_shipped.then(all));
    let help = help.or_else(|| (path.extension()? == "toml").then(begin));
    let help = help.map_or_else(String::new, |help| format!("; {help}"));
    format!("there is no file {}{help}", place.display())
}

/// The file beside a path whose name is nearest to its own, if one is near enough to be meant.
fn near_file(path: &Path) -> Option<String> {
    let case = path.with_extension("toml");
    if path.extension().is_none() && case.is_file() {
        return Some(case.display().to_string());
    }
    let files = std::fs::read_dir(std::path::absolute(path).ok()?.parent()?).ok()?;
    let names = files.filter_map(|file| file.ok()?.file_name().into_string().ok());
    // The same one of two that are as near, whatever their order in the folder.
    let names: BTreeSet<String> = names.filter(|name| !path.ends_with(name)).collect();
    let near = nearest(path.file_name()?.to_str()?, names.iter().map(String::as_str))?;
    Some(path.with_file_name(near).display().to_string())
}

/// What an input is called in messages.
pub fn input_name(path: &Path) -> String {
    match path == Path::new(STANDARD_INPUT) {
        true => "standard input".to_owned(),
        false => path.display().to_string(),
    }
}
