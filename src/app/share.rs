//! Options of the commands whose work is dealt out: parts of it, and a folder that is gone on with.

use super::prelude::*;
use crate::results::sweep::{Start, SweepFolder};
use crate::study::Shard;

/// Which part of the work is done, and whether an earlier run is gone on with.
#[derive(Args)]
pub struct ShareOptions {
    /// Run part K of N only; all parts share the output folder
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Keep what an earlier run has finished and go on
    #[arg(long, conflicts_with = "force")]
    resume: bool,
}

impl ShareOptions {
    /// Numbers of those of `count` pieces of work that belong to this part, ascending from 1.
    pub fn pieces(&self, count: usize) -> Vec<usize> {
        Shard::points(self.shard, count)
    }

    /// The folder that `pieces` of `count` are kept in, with the mesh file of the case.
    ///
    /// # Errors
    /// The folder holds other results or cannot be written; a dry run ends here.
    pub fn open(
        &self,
        session: &Session,
        count: usize,
        pieces: &[usize],
    ) -> Result<SweepFolder, Failure> {
        let output = &session.options.output;
        let start = match (self.resume, output.force) {
            (_, true) => Start::Over,
            (true, false) => Start::Resume,
            (false, false) => Start::Fresh,
        };
        let (path, _) = output.find_folder(&session.manifest, self.resume)?;
        let folder = SweepFolder::open(&path, &session.manifest, count, pieces, start)?;
        session.keep_inputs(folder.output())?;
        Ok(folder)
    }
}
