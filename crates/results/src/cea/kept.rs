//! Steps of an eigenvalue sweep that an interrupted run leaves in its folder, for the run that goes on.

use crate::common::*;
use crate::store::framed;
use frictionsim_physics::cea::{SweepProgress, SweepWatch};
use std::sync::atomic::{AtomicBool, Ordering};

/// Where they are in the folder while the run goes on.
const FOLDER: &str = "progress";
const MAGIC: [u8; 8] = *b"FRSWSTEP";
const VERSION: u32 = 2;

/// A step of a sweep or a search.
#[derive(Serialize, Deserialize)]
struct Step {
    /// The program that found them: another one may take other steps.
    program: String,
    bytes: Vec<u8>,
}

/// Keeps the steps of a sweep in its output folder, one whole file each.
pub struct KeptSteps<'a> {
    folder: &'a OutputFolder,
    heard: &'a (dyn Fn(SweepProgress) + Sync),
    has_failed: AtomicBool,
}

impl<'a> KeptSteps<'a> {
    /// Takes up the steps that an earlier run left in `folder` if `is_continued`, else drops them. `heard` is told how
    /// far the sweep has come.
    pub fn new(
        folder: &'a OutputFolder,
        is_continued: bool,
        heard: &'a (dyn Fn(SweepProgress) + Sync),
    ) -> Result<Self, FolderError> {
        let steps = Self { folder, heard, has_failed: AtomicBool::new(false) };
        if !is_continued {
            steps.discard()?;
        }
        Ok(steps)
    }

    /// Drops all steps: the run is complete, or starts anew.
    ///
    /// # Errors
    /// A file that cannot be removed.
    pub fn discard(&self) -> Result<(), FolderError> {
        let path = self.folder.path().join(FOLDER);
        let files = fs::read_dir(&path).into_iter().flatten().flatten();
        let names = files.filter_map(|entry| entry.file_name().into_string().ok());
        let names: Vec<String> = names.map(|name| format!("{FOLDER}/{name}")).collect();
        names.iter().try_for_each(|name| self.folder.discard(name))?;
        // Anything else in there is not ours.
        let _ = fs::remove_dir(path);
        Ok(())
    }

    fn path(name: &str) -> String {
        format!("{FOLDER}/{name}.bin")
    }
}

impl SweepWatch for KeptSteps<'_> {
    fn reached(&self, progress: SweepProgress) {
        (self.heard)(progress);
    }

    fn recall(&self, name: &str) -> Option<Vec<u8>> {
        let bytes = read_file(&self.folder.path().join(Self::path(name)), RESULT).ok()?;
        // A step that is damaged is taken again.
        let payload = framed::read(&bytes, MAGIC, VERSION).ok()?;
        let step: Step = postcard::from_bytes(payload).ok()?;
        (step.program == env!("CARGO_PKG_VERSION")).then_some(step.bytes)
    }

    fn keep(&self, name: &str, bytes: Vec<u8>) {
        let step = Step { program: env!("CARGO_PKG_VERSION").to_owned(), bytes };
        let written = self
            .folder
            .write_bulk(&Self::path(name), |out| framed::write(out, MAGIC, VERSION, &step));
        if let Err(error) = written
            && !self.has_failed.swap(true, Ordering::Relaxed)
        {
            tracing::warn!("{error}: the run goes on, and would start over after an interruption");
        }
    }
}
