//! Results of `mesh`: statistics, VTU, picture.

mod plane;
mod plane_figure;
mod solid;
mod solid_figure;

pub use plane::{BoundaryStatistics, MeshStatistics, RegionStatistics, write_revolution};
pub use plane_figure::figure as plane_figure;
pub use solid::{SolidBoundary, SolidMeshStatistics, SolidRegion};
pub use solid_figure::figure as solid_figure;

use super::folder::{FolderError, OutputFolder};
use super::vtu::{EncodedMesh, Field, write_vtu};
use crate::chart::literal;
use crate::mesh::{BoundaryCondition, Mesh, MeshQuality};
use crate::output::{Described, Document, Format, Section, fixed, significant};
use serde::Serialize;

/// `summary.json` of `frictionsim mesh`, with the statistics of the kind of body.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct MeshSummary<S> {
    /// Size and quality.
    pub mesh: S,
    /// How the mesh file of solid bodies was read, and what was taken from it.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// What of the mesh file is not used: keyword, place, count, reason.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub not_used: Vec<String>,
}

/// Statistics of a mesh of any kind.
pub trait Measured: Serialize + Described {
    /// What there is to say of it.
    fn section(&self, results: Section) -> Section;
    /// Its counts.
    fn size(&self) -> &MeshSize;
    /// Its elements.
    fn shape(&self) -> &ElementShapes;
}

impl<S: Measured> MeshSummary<S> {
    /// Tables and sentences.
    pub fn document(&self) -> Document {
        let results = Section::new("Results").facts(numbers(self.mesh.size(), self.mesh.shape()));
        let not_used = self.not_used.iter().map(|line| format!("not used: {line}"));
        Document::new("Mesh")
            .section(self.mesh.section(results).text(not_used))
            .section(Section::new("Mesh").figures(["mesh"]))
    }
}

/// Counts of a mesh.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct MeshSize {
    /// Nodes.
    pub nodes: usize,
    /// Elements.
    pub elements: usize,
    /// Unknowns: two for each node in the plane, three in space.
    pub dofs: usize,
    /// Nodes of the contact edge, or of the surfaces that slide on others.
    pub contact_nodes: usize,
}

/// Sizes and shapes of the elements of a mesh.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ElementShapes {
    /// Shortest edge of any element, m.
    pub smallest_edge_m: f64,
    /// Longest edge, m.
    pub largest_edge_m: f64,
    /// Largest ratio of the edges of one element.
    pub largest_aspect_ratio: f64,
    /// Smallest Jacobian determinant of an element over its largest.
    pub worst_jacobian: f64,
}

impl MeshSize {
    /// Counts of a mesh with so many contact nodes.
    fn new(mesh: &Mesh, contact_nodes: usize) -> Self {
        Self {
            nodes: mesh.node_count(),
            elements: mesh.element_count(),
            dofs: mesh.dof_count(),
            contact_nodes,
        }
    }
}

impl From<MeshQuality> for ElementShapes {
    fn from(own: MeshQuality) -> Self {
        Self {
            smallest_edge_m: own.smallest_edge,
            largest_edge_m: own.largest_edge,
            largest_aspect_ratio: own.largest_aspect_ratio,
            worst_jacobian: own.worst_jacobian,
        }
    }
}

/// What a condition does, in a word.
fn condition_name(condition: BoundaryCondition) -> &'static str {
    match condition {
        BoundaryCondition::Clamped => "clamped",
        BoundaryCondition::Support(_) => "support",
        BoundaryCondition::Guide => "guide",
        BoundaryCondition::Fixed(_) => "fixed",
        BoundaryCondition::Pressure(_) => "pressure",
        BoundaryCondition::Free => "free",
    }
}

/// Colours of the elements of the regions, which take them in turns.
const REGION_COLOURS: [&str; 6] =
    ["#7d7d7d", "#b07d2b", "#4f8f5f", "#7a5c99", "#3f7fa8", "#a85858"];

/// Caption of the picture of a case.
fn caption(title: &str) -> String {
    match title {
        "" => "Mesh".to_owned(),
        title => literal(title),
    }
}

/// Writes `mesh.vtu` with node numbers, the nodes of the contact marked, what is held, and the region of each element.
pub fn write_mesh(
    folder: &OutputFolder,
    mesh: &Mesh,
    contact: impl IntoIterator<Item = u32>,
) -> Result<(), FolderError> {
    let ids = (0..mesh.node_count()).map(|node| mesh.node_label(node) as i64);
    let mut edge = vec![0; mesh.node_count()];
    mesh.held_dofs().for_each(|dof| edge[dof / mesh.dimension] = 2);
    contact.into_iter().for_each(|node| edge[node as usize] = 1);
    let fields = [
        Field::integers("node_id", ids.collect()),
        // 1 contact, 2 held, 0 elsewhere.
        Field::integers("edge", edge),
    ];
    // Counted from 1 in the order in which the summary lists them.
    let regions = (0..mesh.element_count()).map(|element| mesh.region(element) as i64 + 1);
    let regions = [Field::integers("region_id", regions.collect())];
    folder.write("mesh.vtu", |out| write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &regions))
}

/// Sizes and quality, name and value.
fn numbers(size: &MeshSize, shape: &ElementShapes) -> Vec<(String, String)> {
    let count = |name: &str, count: usize| (name.to_owned(), count.to_string());
    let metres = |name: &str, value: f64| (name.to_owned(), Format::Scientific(4).text(value, "m"));
    vec![
        count("nodes", size.nodes),
        count("elements", size.elements),
        count("unknowns", size.dofs),
        count("contact nodes", size.contact_nodes),
        metres("shortest edge", shape.smallest_edge_m),
        metres("longest edge", shape.largest_edge_m),
        ("largest aspect ratio".to_owned(), fixed(shape.largest_aspect_ratio, 2)),
        ("worst Jacobian".to_owned(), significant(shape.worst_jacobian, 5)),
    ]
}
