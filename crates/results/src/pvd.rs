//! ParaView collections: files of one run by time.

use super::vtu::escape;
use frictionsim_output::rounded;
use std::io::{self, Write};

/// One file of a collection.
#[derive(Clone, Debug, PartialEq)]
pub struct PvdEntry {
    /// Time, or whatever the collection is ordered by.
    pub time: f64,
    /// Group that the file belongs to.
    pub group: String,
    /// File name relative to the collection.
    pub file: String,
}

/// Writes a ParaView collection.
pub fn write_pvd(out: &mut dyn Write, entries: &[PvdEntry]) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>"
    )?;
    for entry in entries {
        writeln!(
            out,
            "<DataSet timestep=\"{:?}\" group=\"{}\" part=\"0\" file=\"{}\"/>",
            rounded(entry.time, 12),
            escape(&entry.group),
            escape(&entry.file)
        )?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}
