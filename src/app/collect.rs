//! `frictionsim collect`: the table over the points that a sweep has finished so far.

use super::options::FigureOptions;
use super::prelude::*;
use super::sweep::{SweepPlan, finished, gather};
use crate::case::{MeshBytes, RawCase, RawValue, TableBytes};
use crate::results::MESH;
use crate::results::sweep::SweepFolder;
use clap::ArgAction;
use frictionsim_bounds::{RESULT, read_file};

/// Gather the points of a sweep that several processes share
///
/// Writes points.csv and summary.json. Names missing points and exits with 1 if there are any; the table has the
/// others.
#[derive(Args)]
pub struct Arguments {
    /// Output folder of the sweep
    #[arg(value_name = "DIR", value_hint = ValueHint::DirPath)]
    folder: PathBuf,
    /// Print the summary object, alone, on stdout
    #[arg(long)]
    json: bool,
    /// Draw no figures
    #[arg(long)]
    no_figures: bool,
    #[command(flatten)]
    figures: FigureOptions,
    /// No information messages; twice: errors only, and no table
    #[arg(long, short, action = ArgAction::Count)]
    quiet: u8,
}

pub(super) fn run(asked: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    terminal::start_log(asked.quiet, 0);
    let folder = SweepFolder::find(&asked.folder, "sweep")?;
    let case = recorded_case(&asked.folder, folder.output().manifest())?;
    let plan = SweepPlan::new(&case)?;
    let found = finished(&plan, &folder)?;
    let head = Head::of(&case.title, start.elapsed().as_secs_f64());
    let output = OutputOptions {
        json: asked.json,
        quiet: asked.quiet,
        no_figures: asked.no_figures,
        figures: asked.figures.clone(),
        ..Default::default()
    };
    let (text, summary) = gather(&output, &folder, (&case, &plan), head, &found)?;
    output.print(&text, &summary, folder.output().path())?;
    match found.missing.len() {
        0 => Ok(()),
        missing => Err(Failure::run(format!(
            "{missing} of {} points are missing: run the sweep again with --resume",
            found.points
        ))),
    }
}

/// The case that the manifest of a folder records, overrides included, with the mesh file that the folder holds.
fn recorded_case(folder: &Path, manifest: &Manifest) -> Result<Case, Failure> {
    let text = manifest.case_text.as_bytes();
    let mut raw = RawCase::parse(&manifest.case_file, text, &manifest.overrides)?;
    let file = raw.find("mesh.file").map(|item| &item.value);
    if let (Some(RawValue::String(file)), Ok(bytes)) = (file, read_file(&folder.join(MESH), RESULT))
    {
        raw.mesh = Some(MeshBytes::new(file.clone(), bytes));
    }
    for (name, file) in raw.table_files() {
        if let Ok(bytes) = read_file(&folder.join(&name), RESULT) {
            let bytes = bytes.into();
            raw.tables.push(TableBytes { file, bytes });
        }
    }
    Ok(Case::from_raw(raw)?)
}
