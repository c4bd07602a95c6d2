//! The results folder of a sweep, which several processes may share.

use super::super::folder::{
    FolderError, OutputFolder, Replace, check_owner, refuse_foreign, remove_files, write_manifest,
};
use super::super::framed::{Defect, create_folder, is_temporary, read_sealed, write_sealed};
use super::super::manifest::Manifest;
use super::super::reopening::{Contents, MANIFEST, read_contents, read_existing};
use super::super::store::lock::{Company, Lock, remove_remnants, share, try_lock};
use super::{PointClock, PointRecord, tables};
use frictionsim_bounds::{RESULT, read_file};
use std::path::{Path, PathBuf};
use std::{collections::BTreeMap, fs};

/// Files over all points, beside the tables of a sweep.
const OVER_ALL: [&str; 4] = ["samples.csv", "summary.json", "report.html", "figures.bin"];
/// Figures over all points.
const FIGURES: [&str; 10] = [
    "uncertainty",
    "indices",
    "robust",
    "basins",
    "critical-friction",
    "operating-matrix",
    "frequencies",
    "status",
    "branch-frequencies",
    "branch-shares",
];
const POINTS: &str = "points";
const CLAIM: &str = ".claim-";

/// What becomes of finished points that are there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// There must be none.
    Fresh,
    /// They stay.
    Resume,
    /// They go, and so do the results of another case.
    Over,
}

impl Start {
    /// Whose results may go.
    fn replace(self) -> Replace {
        match self {
            Self::Over => Replace::Anything,
            Self::Fresh | Self::Resume => Replace::SameCase,
        }
    }
}

/// The results folder of one sweep.
///
/// ```text
/// manifest.json              case text, overrides, hash: whose folder it is
/// points/point-000001.json   one whole file for each finished point, the same bytes whoever computed it
/// points/clock-000001.json   how long that took
/// points.csv, summary.json   over all points, as are stability.csv, modes.csv, branches.csv and the figures
/// ```
///
/// Processes share the folder: each holds the lock file shared, so that no other command takes the
/// folder, and claims a point by locking a file of its own before it runs it. Locks go with their
/// process; a killed one leaves nothing to clear up by hand. A file system without locks leaves
/// processes that run the same points to do them twice, with one result.
#[derive(Debug)]
pub struct SweepFolder {
    output: OutputFolder,
}

/// What there is of a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// Nothing, or the point of another sweep.
    Nothing,
    /// A file that is no longer as it was written, and what does not fit.
    Damaged(String),
    /// The finished point.
    Point(Box<PointRecord>),
}

/// The right to run one point, until dropped.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    _lock: Lock,
}

impl Drop for Claim {
    fn drop(&mut self) {
        // The point's file is there by now: whoever opened the claim before it goes finds that.
        let _ = fs::remove_file(&self.path);
    }
}

impl SweepFolder {
    /// Takes the folder for a run of `points` (numbers from 1) out of `count`, creating it where it is missing.
    ///
    /// # Errors
    /// [`FolderError::OtherCase`] and [`FolderError::Unusable`] unless `start` is [`Start::Over`];
    /// [`FolderError::Unusable`] if some of `points` are finished and `start` is [`Start::Fresh`];
    /// [`FolderError::Busy`] if another command writes there; those of the file system.
    pub fn open(
        path: &Path,
        manifest: &Manifest,
        count: usize,
        points: &[usize],
        start: Start,
    ) -> Result<Self, FolderError> {
        // A folder that is refused stays as it is, without lock files.
        OutputFolder::may_open(path, manifest, start.replace())?;
        create_folder(path)?;
        let lock = share(path, |company| {
            take_over(path, manifest, count, start, company)?;
            create_folder(&path.join(POINTS))?;
            if company == Company::None {
                remove_remnants(path, |name| is_temporary(name) || name.starts_with(CLAIM));
            }
            if start == Start::Over {
                remove_points(path, points, company)?;
            }
            Ok(())
        })?;
        let folder = Self { output: OutputFolder::shared(path, manifest, lock) };
        if start == Start::Fresh {
            folder.refuse_started(points)?;
        }
        Ok(folder)
    }

    /// Opens the folder that processes of a command share (`sweep`, `uncertainty`) once it has been started.
    ///
    /// # Errors
    /// [`FolderError::Unusable`]; [`FolderError::Busy`]; those of the file system.
    pub fn find(path: &Path, command: &str) -> Result<Self, FolderError> {
        let not_a_sweep = |reason: String| {
            FolderError::unusable(path, format!("is not the results folder of a sweep: {reason}"))
        };
        if !path.join(MANIFEST).is_file() {
            return Err(not_a_sweep(format!("it has no {MANIFEST}")));
        }
        let Some(Contents { manifest, .. }) = read_contents(path)? else {
            return Err(not_a_sweep(format!("its {MANIFEST} is damaged")));
        };
        if manifest.command != command {
            return Err(not_a_sweep(format!("it belongs to frictionsim {}", manifest.command)));
        }
        let lock = share(path, |_| Ok(()))?;
        Ok(Self { output: OutputFolder::shared(path, &manifest, lock) })
    }

    /// What holds the files over all points.
    pub fn output(&self) -> &OutputFolder {
        &self.output
    }

    /// Where a point's file is.
    pub fn point_path(&self, point: usize) -> PathBuf {
        self.output.path().join(point_name(point))
    }

    /// Reads a finished point.
    pub fn read(&self, point: usize) -> Result<Found, FolderError> {
        let Some(bytes) = read_existing(&self.point_path(point))? else {
            return Ok(Found::Nothing);
        };
        let record = read_sealed(&bytes)
            .and_then(|value| serde_json::from_value::<PointRecord>(value).map_err(Defect::damage));
        let sweep_hash = &self.output.manifest().case_hash;
        Ok(match record {
            Err(defect) => Found::Damaged(defect.to_string()),
            Ok(own) if own.point == point && own.sweep_hash == *sweep_hash => {
                Found::Point(Box::new(own))
            }
            Ok(_) => Found::Nothing,
        })
    }

    /// What the clock said of a finished point; nothing where its file is missing or damaged, which no result depends
    /// on.
    pub fn read_clock(&self, point: usize) -> PointClock {
        let bytes =
            read_file(&self.output.path().join(clock_name(point)), RESULT).unwrap_or_default();
        let value = read_sealed(&bytes).ok();
        value.and_then(|value| serde_json::from_value(value).ok()).unwrap_or_default()
    }

    /// Claims a point for this process; `None` where it is finished or another one has it.
    pub fn take(&self, point: usize) -> Result<Option<Claim>, FolderError> {
        let is_finished =
            || -> Result<bool, FolderError> { Ok(matches!(self.read(point)?, Found::Point(_))) };
        if is_finished()? {
            return Ok(None);
        }
        let path = self.output.path().join(POINTS).join(format!("{CLAIM}{point:06}"));
        let (lock, company) = try_lock(&path)?;
        let claim = (company != Company::Others).then(|| Claim { path, _lock: lock });
        // Another process may have finished it between the look and the claim.
        Ok(if is_finished()? { None } else { claim })
    }

    /// Writes a finished point, whole or not at all, and before it what the clock says of it.
    pub fn write_point(&self, record: &PointRecord, clock: &PointClock) -> Result<(), FolderError> {
        self.output.write(&clock_name(record.point), |out| write_sealed(out, clock))?;
        self.output.write(&point_name(record.point), |out| write_sealed(out, record))
    }

    fn refuse_started(&self, points: &[usize]) -> Result<(), FolderError> {
        let mut found = 0;
        for &point in points {
            found += usize::from(matches!(self.read(point)?, Found::Point(_)));
        }
        if found == 0 {
            return Ok(());
        }
        let asked = points.len();
        let reason = format!(
            "already holds {found} of the {asked} parts of this run: go on with --resume, start \
             over with --force, or choose another folder with --out"
        );
        Err(FolderError::unusable(self.output.path(), reason))
    }
}

fn point_name(point: usize) -> String {
    format!("{POINTS}/point-{point:06}.json")
}

/// Names of the files of points, and of those over all.
fn names_of(points: impl Iterator<Item = usize>) -> impl Iterator<Item = String> {
    let figures = FIGURES.iter().flat_map(|name| {
        ["svg", "png", "pdf"].map(|extension| format!("figures/{name}.{extension}"))
    });
    let tables = tables(&[], &["cea", "cycle"], &[]).into_iter().map(|table| table.file);
    let over_all = tables.chain(OVER_ALL.map(str::to_owned)).chain(figures);
    points.flat_map(|point| [point_name(point), clock_name(point)]).chain(over_all)
}

fn clock_name(point: usize) -> String {
    format!("{POINTS}/clock-{point:06}.json")
}

/// Makes the folder that of this sweep, or finds that it is.
fn take_over(
    path: &Path,
    manifest: &Manifest,
    count: usize,
    start: Start,
    company: Company,
) -> Result<(), FolderError> {
    let contents = read_contents(path)?;
    match &contents {
        Some(contents) if check_owner(path, &contents.manifest, manifest, start.replace())? => {
            return Ok(());
        }
        None if start != Start::Over => refuse_foreign(path)?,
        _ => {}
    }
    if company == Company::Others {
        return Err(FolderError::Busy(path.to_owned()));
    }
    if let Some(contents) = &contents {
        remove_files(path, contents.files.iter())?;
    }
    let files: BTreeMap<String, Option<u32>> =
        names_of(1..=count).map(|name| (name, None)).collect();
    write_manifest(path, manifest, &files)
}

/// Removes the points that are to be run over again, and the table that has them.
fn remove_points(path: &Path, points: &[usize], company: Company) -> Result<(), FolderError> {
    if company == Company::Others {
        return Err(FolderError::Busy(path.to_owned()));
    }
    let names: Vec<String> = names_of(points.iter().copied()).collect();
    remove_files(path, names.iter())
}
