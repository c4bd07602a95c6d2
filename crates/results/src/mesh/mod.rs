//! Results of `mesh`: statistics, VTU, picture.

mod plane;
mod solid;
mod statistics;

pub use plane::{figure as plane_figure, write_revolution};
pub use solid::figure as solid_figure;
pub use statistics::{BoundaryStatistics, MeshStatistics, RegionStatistics};

use crate::common::*;

keys! {
    /// `summary.json` of `frictionsim mesh`.
    MeshSummary {
        mesh: MeshStatistics = "size and quality";
        #[serde(skip_serializing_if = "Vec::is_empty")]
        notes: Vec<String> = "how the mesh file of solid bodies was read, and what was taken from it";
        #[serde(skip_serializing_if = "Vec::is_empty")]
        not_used: Vec<String> = "what of the mesh file is not used: keyword, place, count, reason";
    }
}

impl MeshSummary {
    /// Tables and sentences.
    pub fn document(&self) -> Document {
        let not_used = self.not_used.iter().map(|line| format!("not used: {line}"));
        Document::new("Mesh")
            .section(self.mesh.section().text(not_used))
            .section(Section::new("Mesh").figures(["mesh"]))
    }
}

/// Boundaries that slide, are slid on or glued, in a word.
pub type Roles = BTreeMap<usize, &'static str>;

/// Those of a plane body.
pub fn plane_roles(mesh: &Mesh) -> Roles {
    let counter = mesh.opposite.map(|boundary| (boundary, "counterface"));
    counter.into_iter().chain([(mesh.contact, "contact")]).collect()
}

/// The nodes of the boundaries that slide on others.
fn contact_nodes(mesh: &Mesh, roles: &Roles) -> BTreeSet<u32> {
    let contacts = roles.iter().filter(|role| *role.1 == "contact");
    contacts.flat_map(|role| mesh.boundaries[*role.0].nodes.iter().copied()).collect()
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

/// What a boundary does, in a word: of one that slides or is glued that.
fn role_of(mesh: &Mesh, boundary: usize, roles: &Roles) -> &'static str {
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
pub fn write_mesh(folder: &OutputFolder, mesh: &Mesh, roles: &Roles) -> Result<(), FolderError> {
    let mut edge = vec![0; mesh.node_count()];
    mesh.held_dofs().for_each(|dof| edge[dof / mesh.dimension] = 2);
    contact_nodes(mesh, roles).into_iter().for_each(|node| edge[node as usize] = 1);
    // Counted from 1 in the order in which the summary lists them.
    let regions = (0..mesh.element_count()).map(|element| mesh.region(element) as i64 + 1);
    write_nodes(folder, mesh, edge, &[Field::integers("region_id", regions)])
}

/// Writes `mesh.vtu` with node numbers, `edge` (1 contact, 2 held, 0 elsewhere) and what is known of the elements.
fn write_nodes(
    folder: &OutputFolder,
    mesh: &Mesh,
    edge: Vec<i64>,
    of_elements: &[Field],
) -> Result<(), FolderError> {
    let ids = (0..mesh.node_count()).map(|node| mesh.node_label(node) as i64);
    let fields = [Field::integers("node_id", ids), Field::integers("edge", edge)];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, of_elements)
    })
}
