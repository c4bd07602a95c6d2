//! Formats of mesh files, told by their content and their names.

use super::abaqus;
use super::gmsh::{GmshFile, MeshFileError};

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Gmsh's MSH.
    Gmsh,
    /// Input files of Abaqus and CalculiX.
    Abaqus,
}

impl MeshFormat {
    /// The format of a file: what it begins with decides, then its name.
    pub fn of(name: &str, bytes: &[u8]) -> Self {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).to_uppercase();
        if start.starts_with("$MESHFORMAT") {
            return Self::Gmsh;
        }
        let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
        match extension.to_lowercase().as_str() {
            "inp" => return Self::Abaqus,
            "msh" => return Self::Gmsh,
            _ => {}
        }
        let mut lines = start.lines().map(str::trim_start);
        let is_keyword = |line: &str| {
            let rest = line.strip_prefix('*');
            rest.is_some_and(|rest| rest.starts_with(|c: char| c == '*' || c.is_ascii_alphabetic()))
        };
        match lines.find(|line| !line.is_empty()) {
            Some(line) if is_keyword(line) => Self::Abaqus,
            _ => Self::Gmsh,
        }
    }

    /// What begins a comment of the format, if it is one that includes other files.
    pub fn comment(self) -> Option<&'static str> {
        match self {
            Self::Gmsh => None,
            Self::Abaqus => Some("**"),
        }
    }

    /// The file that a line includes, and whether its own line stays before the included text.
    pub fn included(self, line: &str) -> Option<(&str, bool)> {
        match self {
            Self::Gmsh => None,
            Self::Abaqus => abaqus::included(line),
        }
    }
}

impl GmshFile {
    /// Reads a mesh file of any format; `name` tells the format where its content does not.
    ///
    /// Memory stays below a constant times the size of the file, whatever it says.
    ///
    /// # Errors
    /// [`MeshFileError::Syntax`] with the line, or the byte of a binary file.
    pub fn read_as(name: &str, bytes: &[u8]) -> Result<Self, MeshFileError> {
        match MeshFormat::of(name, bytes) {
            MeshFormat::Gmsh => Self::read(bytes),
            MeshFormat::Abaqus => abaqus::read(bytes),
        }
    }
}
