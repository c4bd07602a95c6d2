//! Formats of mesh files, told by their content and their names.

use super::{abaqus, nastran, universal};
use crate::prelude::*;

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Gmsh's MSH.
    Gmsh,
    /// Input files of Abaqus and CalculiX.
    Abaqus,
    /// Bulk data of Nastran.
    Nastran,
    /// Universal files.
    Universal,
}

impl MeshFormat {
    /// The format of a file: its first lines decide where they can, else its name.
    pub fn of(name: &str, bytes: &[u8]) -> Self {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).to_uppercase();
        let is_comment = |line: &str| line.starts_with('$') && !line.starts_with("$MESHFORMAT");
        let mut lines = start.lines().map(str::trim);
        let first = lines.find(|line| !line.is_empty() && !is_comment(line)).unwrap_or_default();
        let is_keyword = |line: &str| {
            let rest = line.strip_prefix('*');
            rest.is_some_and(|rest| rest.starts_with(|c: char| c == '*' || c.is_ascii_alphabetic()))
        };
        let nastran = ["SOL ", "SOL,", "CEND", "BEGIN BULK", "GRID", "ID ", "INIT MASTER", "CORD2"];
        match first {
            "-1" => Self::Universal,
            _ if first.starts_with("$MESHFORMAT") => Self::Gmsh,
            _ if is_keyword(first) => Self::Abaqus,
            _ if nastran.iter().any(|begin| first.starts_with(begin)) => Self::Nastran,
            _ => {
                let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
                match extension.to_lowercase().as_str() {
                    "inp" => Self::Abaqus,
                    "bdf" | "nas" | "fem" => Self::Nastran,
                    "unv" | "uff" => Self::Universal,
                    _ => Self::Gmsh,
                }
            }
        }
    }

    /// What begins a comment of the format, if it is one that includes other files.
    pub fn comment(self) -> Option<&'static str> {
        match self {
            Self::Gmsh | Self::Universal => None,
            Self::Abaqus => Some("**"),
            Self::Nastran => Some("$"),
        }
    }

    /// The file that a line includes, and whether its own line stays before the included text.
    pub fn included(self, line: &str) -> Option<(&str, bool)> {
        match self {
            Self::Gmsh | Self::Universal => None,
            Self::Abaqus => abaqus::included(line),
            Self::Nastran => nastran::included(line),
        }
    }
}

impl FileMesh {
    /// Reads a mesh file of any format; `name` tells the format where its content does not.
    ///
    /// Memory stays below a constant times the size of the file, whatever it says.
    ///
    /// # Errors
    /// [`MeshFileError`] with the line, or the byte of a binary file.
    pub fn read_as(name: &str, bytes: &[u8]) -> Result<Self, MeshFileError> {
        let file = match MeshFormat::of(name, bytes) {
            MeshFormat::Gmsh => Self::read(bytes),
            MeshFormat::Abaqus => abaqus::read(bytes),
            MeshFormat::Nastran => nastran::read(bytes),
            MeshFormat::Universal => universal::read(bytes),
        }?;
        match file.far_node(1.0) {
            Some(message) => Err(MeshFileError { place: "coordinates".to_owned(), message }),
            None => Ok(file),
        }
    }

    /// A node beyond [`LARGEST_COORDINATE`] once its coordinates have a factor, in words.
    pub fn far_node(&self, scale: f64) -> Option<String> {
        let is_far = |x: &f64| !((scale * x).abs() <= LARGEST_COORDINATE);
        let node = self.points.iter().position(|point| point.iter().any(is_far))?;
        let [x, y, z] = self.points[node].map(|x| scale * x);
        Some(format!(
            "node {} lies at [{x:e}, {y:e}, {z:e}]: no coordinate may be beyond {LARGEST_COORDINATE:e}",
            self.labels[node]
        ))
    }
}
