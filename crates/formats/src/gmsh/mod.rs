//! Reader of Gmsh's MSH files, versions 2.2 and 4.1, text and binary.
//!
//! Source: Gmsh reference manual, chapter "File formats".

mod cursor;
mod versions;

use crate::prelude::*;
use cursor::Cursor;

impl FileMesh {
    /// Reads a file.
    ///
    /// Memory stays below a constant times the size of the file, whatever it says.
    ///
    /// # Errors
    /// [`MeshFileError`] with the line, or the byte of a binary file.
    pub fn read(bytes: &[u8]) -> Result<Self, MeshFileError> {
        let mut cursor = Cursor::new(bytes);
        ensure!(bytes.starts_with(b"$MeshFormat"); cursor; "{}", foreign(bytes));
        // The format: version, binary or not, size of a number; of a binary file the order of bytes.
        cursor.text_line();
        let version = cursor.text_line().unwrap_or_default();
        let words: Vec<&str> = version.split_whitespace().collect();
        let is_binary = match words[..] {
            ["2.2" | "2" | "4.1", kind @ ("0" | "1"), "8"] => kind == "1",
            [] | ["2.2" | "2" | "4.1", ..] => {
                refuse!(cursor; "format line expected, such as \"4.1 0 8\"")
            }
            [number, ..] => refuse!(cursor;
                "MSH version {number} is not supported: save the mesh as version 4.1 or 2.2 (Mesh.MshFileVersion)"),
        };
        if is_binary {
            cursor.is_binary = true;
            cursor.is_swapped = match cursor.int("byte order")? {
                1 => false,
                0x0100_0000 => true,
                _ => refuse!(cursor; "the number 1, which gives the byte order, was expected"),
            };
        }
        cursor.end("MeshFormat")?;
        // Sections in their order, those of other content skipped.
        let mut reader = Reader { cursor, ..Reader::default() };
        let is_new = words[0] == "4.1";
        while let Some(section) = reader.cursor.section() {
            reader.cursor.refuse_end()?;
            match section.as_str() {
                "PhysicalNames" => reader.physical_names()?,
                "Entities" if is_new => reader.entities()?,
                "Nodes" if is_new => reader.nodes_4()?,
                "Nodes" => reader.nodes_2()?,
                "Elements" if is_new => reader.elements_4()?,
                "Elements" => reader.elements_2()?,
                _ => {
                    reader.cursor.skip_section(&section)?;
                    continue;
                }
            }
            reader.cursor.end(&section)?;
        }
        // A file of names alone has nothing to compute with.
        ensure!(!reader.file.points.is_empty(); reader.cursor; "the file has no $Nodes");
        reader.finished()
    }
}

/// What a file is that does not begin like one of ours, and how it becomes one.
fn foreign(bytes: &[u8]) -> String {
    /// For formats that Gmsh does not open with the names of their sets.
    const MESHIO: &str = "convert it with Python's meshio: cell sets become the cell data \"gmsh:physical\" with names in \
                          field_data, then mesh.write(\"part.msh\", file_format=\"gmsh22\", binary=False)";
    const GMSH: &str = "save the mesh as MSH 4.1 or 2.2 (gmsh -2 -format msh41)";
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).into_owned();
    let has = |words: &[&str]| words.iter().any(|word| start.contains(word));
    let (what, remedy) = match start.as_str() {
        "" => ("the file is empty", GMSH),
        _ if has(&["VTK", "vtk"]) => ("this looks like a VTK file", MESHIO),
        _ if start.starts_with("solid") || start.starts_with("ISO-10303") => {
            ("this is a geometry, not a mesh", GMSH)
        }
        _ if has(&["Point(", "//", "SetFactory"]) => {
            ("this looks like a Gmsh geometry (.geo), not a mesh", "run gmsh -2 on it")
        }
        _ => (
            "this is no Gmsh mesh, which begins with $MeshFormat, nor does its name end in .inp, .bdf or .unv",
            GMSH,
        ),
    };
    format!("{what}; {remedy}")
}

/// Stands for the physical tag of an element without one.
const NO_GROUP: i64 = i64::MIN;
/// Longest name of a physical group, bytes.
const LONGEST_NAME: usize = 4096;

/// What is gathered on the way through the file.
#[derive(Default)]
struct Reader<'a> {
    cursor: Cursor<'a>,
    file: FileMesh,
    /// Names by dimension and tag.
    names: BTreeMap<(i64, i64), Arc<str>>,
    /// Physical tags of each entity, by dimension and tag.
    physical: BTreeMap<(i64, i64), Vec<i64>>,
    /// Index of each node number.
    index_of: BTreeMap<usize, u32>,
    /// Plane elements and the physical surfaces that each belongs to: faces of a body if there are solid elements.
    surfaces: BTreeMap<String, Vec<SurfaceFace>>,
}

impl Reader<'_> {
    /// The file, of solid elements where there are any: plane ones are then faces of its physical surfaces.
    fn finished(self) -> Result<FileMesh> {
        let mut file = self.file;
        let dimension = dimension(&file.elements);
        file.elements.retain(|element| element.kind.dimension() == dimension);
        if dimension == 3 {
            file.surfaces = self.surfaces;
        }
        ensure!(!file.elements.is_empty(); self.cursor;
            "the file has no triangles or quadrilaterals: mesh the surfaces (gmsh -2), and put them in a physical \
             group if the file has any");
        Ok(FileMesh { dimension, ..file })
    }

    fn physical_names(&mut self) -> Result<()> {
        // Text in binary files too.
        let is_binary = std::mem::replace(&mut self.cursor.is_binary, false);
        let count = self.cursor.count("physical names", 5)?;
        self.cursor.text_line();
        for _ in 0..count {
            let line = self.cursor.text_line().unwrap_or_default();
            let mut parts = line.splitn(3, char::is_whitespace);
            let mut number = || parts.next().and_then(|word| word.parse::<i64>().ok());
            let tag = number().zip(number());
            let (tag, name) = found!(tag.zip(parts.next()); self.cursor;
                "dimension, tag and \"name\" of a physical group expected");
            let name = name.trim().trim_matches('"');
            ensure!(name.len() <= LONGEST_NAME; self.cursor;
                "the name of a physical group has {} bytes, more than {LONGEST_NAME}", name.len());
            self.names.insert(tag, name.into());
        }
        self.cursor.is_binary = is_binary;
        Ok(())
    }

    fn node(&mut self, label: usize) -> Result<()> {
        let [x, y, z] = [0; 3].map(|_| self.cursor.number("coordinate"));
        let point = [x?, y?, z?];
        let known = self.index_of.insert(label, self.file.points.len() as u32);
        ensure!(known.is_none(); self.cursor; "node {label} is given twice");
        self.file.labels.push(label);
        self.file.points.push(point);
        self.file.is_used.push(false);
        Ok(())
    }

    /// Name of a physical group; one without gets its number for a name.
    fn name(&mut self, dimension: i64, tag: i64) -> Arc<str> {
        let plain = || match (dimension, tag) {
            (1, tag) => format!("curve {tag}").into(),
            (_, NO_GROUP) => "body".into(),
            (_, tag) => format!("surface {tag}").into(),
        };
        let known = self.names.entry((dimension, tag)).or_insert_with(plain);
        Arc::clone(known)
    }

    /// Takes one element in, or a point, which has no kind; `groups` are its physical tags.
    fn element(
        &mut self,
        kind: Option<ElementKind>,
        (label, entity): (usize, i64),
        groups: &[i64],
        labels: &[usize],
    ) -> Result<()> {
        let mut nodes = Vec::with_capacity(labels.len());
        for node in labels {
            let &index = found!(self.index_of.get(node); self.cursor;
                "element {label} names node {node}, which the file does not have");
            self.file.is_used[index as usize] = true;
            nodes.push(index);
        }
        let Some(kind) = kind else { return Ok(()) };
        let dimension = kind.dimension() as i64;
        // An edge, and a face of a solid, belong to every physical group that names them, an element to its first one.
        for &tag in if dimension < 3 { groups } else { &[] } {
            let name = self.name(dimension, tag).to_string();
            match dimension {
                1 => self.file.curves.entry(name).or_default().push(edge_of(&nodes)),
                _ => self.surfaces.entry(name).or_default().push((kind, nodes.clone())),
            }
        }
        if dimension > 1 {
            let region = self.name(dimension, groups.first().copied().unwrap_or(NO_GROUP));
            let nodes = kind.row().gmsh.arranged(&nodes);
            self.file.elements.push(FileElement { label, kind, region, entity, nodes });
        }
        Ok(())
    }

    /// Node count and, for all but points, the kind of an element type that can be used.
    fn shape_of(&self, number: i64, label: usize) -> Result<(usize, Option<ElementKind>)> {
        let is_meant = |&kind: &u32| i64::from(kind) == number;
        if let Some(kind) = ElementKind::listed(|row| row.gmsh.names.iter().any(is_meant)) {
            return Ok((kind.node_count(), Some(kind)));
        }
        match number {
            15 => Ok((1, None)),
            10 => refuse!(self.cursor;
                "element {label} is a quadrilateral of nine nodes (type 10), which is not supported: set \
                 Mesh.SecondOrderIncomplete = 1 for eight"),
            12..=14 => refuse!(self.cursor;
                "element {label} has nodes inside its faces (type {number}), which is not supported. Set \
                 Mesh.SecondOrderIncomplete = 1 for bricks of 20, wedges of 15 and pyramids of 13 nodes"),
            _ => refuse!(self.cursor;
                "element {label} has type {number}, which is not supported: triangles, quadrilaterals, {} of first and \
                 second order are", ElementKind::SOLID_SHAPES),
        }
    }
}
