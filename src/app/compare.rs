//! `frictionsim compare`: runs side by side.

use super::LONGEST_NAME;
use super::prelude::*;
use crate::case::hash_of;
use crate::results::compare::{
    ComparedRun, ComparisonSummary, SharedQuantity, document, file, overlaid, print, shared,
};
use crate::results::{Extent, Page, read_manifest, read_record, read_summary, write_table};

/// Set finished runs side by side: numbers and curves
///
/// Reads summary.json and figures.bin of each results folder; nothing is computed again. The other folders are compared
/// with the first one. Without --out the results are in results/compare, in a folder named after the runs.
#[derive(Args)]
pub struct Arguments {
    /// Results folders, the first of which the others are compared with
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath, required = true, num_args = 2..)]
    folders: Vec<PathBuf>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    terminal::start_log(asked.output.quiet, asked.output.verbose);
    let names = names_of(&asked.folders);
    let runs = asked.folders.iter().zip(names).map(|(path, name)| {
        let (manifest, summary) = (read_manifest(path)?, read_summary(path)?);
        let page = read_record::<Page>(path);
        let page = page.inspect_err(|error| tracing::warn!("without figures of {name}: {error}"));
        Ok(ComparedRun { name, manifest, summary, page: page.ok() })
    });
    let runs: Vec<ComparedRun> = runs.collect::<Result<_, Failure>>()?;
    let quantities = shared(&runs);
    if quantities.iter().all(SharedQuantity::is_cost) && overlaid(&runs).is_empty() {
        let commands: Vec<&str> = runs.iter().map(|run| run.manifest.command.as_str()).collect();
        let commands = commands.join(", ");
        let what = format!("these runs ({commands}) share no number: compare runs of one command");
        return Err(Failure::usage(what));
    }
    let mut extents = runs.iter().filter_map(|run| Extent::of_summary(&run.summary));
    if extents.next().is_some_and(|first| extents.any(|other| other != first)) {
        let what = "forces, torques, powers and energies of some runs are for each metre of \
                    thickness, of others of the whole body";
        tracing::warn!("{what}");
    }
    let manifest = manifest_of(&asked.folders, &runs);
    let mut output = asked.output.clone();
    output.out.get_or_insert_with(|| default_folder(&runs, &manifest, asked.output.force));
    let folder = output.open_folder(&manifest, false)?;
    write_table(&folder, &file(&runs, &quantities))?;
    let text = print(&runs, &quantities);
    let told = Told { text, ..Told::of(Head::default(), document(&runs, &quantities)) };
    let summary =
        ComparisonSummary { runs: runs.iter().map(|run| run.name.clone()).collect(), quantities };
    output.finish_result(folder, told, &summary, || overlaid(&runs))
}

/// `results/compare/A-B`, after the names of the runs; where that holds another comparison, with the beginning of its
/// own hash.
fn default_folder(runs: &[ComparedRun], manifest: &Manifest, is_forced: bool) -> PathBuf {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '.' | '_');
    let names = runs.iter().map(|run| {
        let parts = run.name.split(|c| !is_plain(c)).filter(|part| !part.is_empty());
        parts.collect::<Vec<&str>>().join("-")
    });
    let name: String = names.collect::<Vec<_>>().join("-and-").chars().take(LONGEST_NAME).collect();
    let folder = Path::new("results").join("compare");
    let plain = folder.join(&name);
    let found = read_manifest(&plain).ok();
    let is_other = found.is_some_and(|found| found.case_hash != manifest.case_hash);
    match is_other && !is_forced {
        true => folder.join(format!("{name}-{}", &manifest.case_hash[..8])),
        false => plain,
    }
}

/// What the comparison is made from: the folders and the cases of their results.
fn manifest_of(folders: &[PathBuf], runs: &[ComparedRun]) -> Manifest {
    let parts = |run: &'_ ComparedRun| [&run.name[..], "\0", &run.manifest.case_hash].concat();
    let case_hash = hash_of([runs.iter().map(parts).collect::<String>().as_bytes()]);
    let mut folders = folders.iter().map(|path| path.display().to_string());
    Manifest {
        case_file: folders.next().unwrap_or_default(),
        case_hash,
        arguments: folders.collect(),
        ..Manifest::new("compare")
    }
}

/// The ends of the paths that tell them apart; the paths with a number where nothing does.
fn names_of(paths: &[PathBuf]) -> Vec<String> {
    let parts = |path: &Path| -> Vec<String> {
        let path = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect()
    };
    let all: Vec<Vec<String>> = paths.iter().map(|path| parts(path)).collect();
    let longest = all.iter().map(Vec::len).max().unwrap_or(1);
    for length in 1..=longest {
        let names: Vec<String> =
            all.iter().map(|own| own[own.len().saturating_sub(length)..].join("/")).collect();
        let is_unique = |name: &String| names.iter().filter(|other| *other == name).count() == 1;
        if names.iter().all(is_unique) {
            return names;
        }
    }
    paths.iter().enumerate().map(|(at, path)| format!("{} ({})", path.display(), at + 1)).collect()
}
