//! Results of `mesh`: statistics, VTU, picture.

mod plane;
mod solid;

pub use plane::figure as plane_figure;
pub use plane::{BoundaryStatistics, MeshStatistics, RegionStatistics, write_revolution};
pub use solid::figure as solid_figure;
pub use solid::{SolidBoundary, SolidMeshStatistics, SolidRegion};

use super::folder::{FolderError, OutputFolder};
use crate::prelude::*;
use crate::{EncodedMesh, Field, write_vtu};
use frictionsim_physics::mesh::{BoundaryCondition, MeshQuality};

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
    fn section(&self) -> Section;
}

impl<S: Measured> MeshSummary<S> {
    /// Tables and sentences.
    pub fn document(&self) -> Document {
        let not_used = self.not_used.iter().map(|line| format!("not used: {line}"));
        Document::new("Mesh")
            .section(self.mesh.section().text(not_used))
            .section(Section::new("Mesh").figures(["mesh"]))
    }
}

keys! {
    /// Counts of a mesh.
    MeshSize {
        nodes: usize = "nodes";
        elements: usize = "elements";
        dofs: usize = "unknowns: two for each node in the plane, three in space";
        contact_nodes: usize = "nodes of the contact edge, or of the surfaces that slide on others";
    }
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

/// What a boundary of solid bodies does, in a word: of one that slides or is glued that.
fn role_of(mesh: &Mesh, boundary: usize, roles: &BTreeMap<usize, &'static str>) -> &'static str {
    let condition = || condition_name(mesh.boundaries[boundary].condition);
    roles.get(&boundary).copied().unwrap_or_else(condition)
}

/// Colours of the elements of the regions, which take them in turns.
const REGION_COLOURS: [&str; 6] =
    ["#7d7d7d", "#b07d2b", "#4f8f5f", "#7a5c99", "#3f7fa8", "#a85858"];

/// Caption of the picture of a case.
fn caption(title: &str) -> String {
    if title.is_empty() { "Mesh".to_owned() } else { literal(title) }
}

/// Writes `mesh.vtu` with node numbers, the nodes of the contact marked, what is held, and the region of each element.
pub fn write_mesh(
    folder: &OutputFolder,
    mesh: &Mesh,
    contact: impl IntoIterator<Item = u32>,
) -> Result<(), FolderError> {
    let mut edge = vec![0; mesh.node_count()];
    mesh.held_dofs().for_each(|dof| edge[dof / mesh.dimension] = 2);
    contact.into_iter().for_each(|node| edge[node as usize] = 1);
    // Counted from 1 in the order in which the summary lists them.
    let regions = (0..mesh.element_count()).map(|element| mesh.region(element) as i64 + 1);
    write_nodes(folder, mesh, edge, &[Field::integers("region_id", regions.collect())])
}

/// Writes `mesh.vtu` with node numbers, `edge` (1 contact, 2 held, 0 elsewhere) and what is known of the elements.
fn write_nodes(
    folder: &OutputFolder,
    mesh: &Mesh,
    edge: Vec<i64>,
    of_elements: &[Field],
) -> Result<(), FolderError> {
    let ids = (0..mesh.node_count()).map(|node| mesh.node_label(node) as i64);
    let fields = [Field::integers("node_id", ids.collect()), Field::integers("edge", edge)];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, of_elements)
    })
}

/// Sizes and quality.
fn results(size: &MeshSize, shape: &MeshQuality) -> Section {
    let metres = |value: f64| Format::Scientific(4).text(value, "m");
    Section::new("Results").facts([
        ("nodes", size.nodes.to_string()),
        ("elements", size.elements.to_string()),
        ("unknowns", size.dofs.to_string()),
        ("contact nodes", size.contact_nodes.to_string()),
        ("shortest edge", metres(shape.smallest_edge_m)),
        ("longest edge", metres(shape.largest_edge_m)),
        ("largest aspect ratio", fixed(shape.largest_aspect_ratio, 2)),
        ("worst Jacobian", significant(shape.worst_jacobian, 5)),
    ])
}
