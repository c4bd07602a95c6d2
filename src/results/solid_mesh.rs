//! Results of `mesh` for solid bodies of a mesh file: statistics, VTU.

use super::folder::{FolderError, OutputFolder};
use super::manifest::Manifest;
use super::quantity::quantity;
use super::summary::{Entry, Summary};
use super::vtu::{EncodedMesh, Field, write_vtu};
use crate::mesh::{BoundaryCondition, Mesh};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// `summary.json` of `frictionsim mesh` on solid bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidMeshSummary {
    /// `mesh`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Size and quality.
    pub mesh: SolidMeshStatistics,
    /// How the mesh file was read, and what was taken from it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// What of the mesh file is not used: keyword, place, count, reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_used: Vec<String>,
    /// What it was made from.
    pub manifest: Manifest,
}

/// Size and quality of the mesh of solid bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidMeshStatistics {
    /// Nodes.
    pub nodes: usize,
    /// Elements.
    pub elements: usize,
    /// Unknowns, three for each node, held ones included.
    pub dofs: usize,
    /// Nodes of the surfaces that slide on others.
    pub contact_nodes: usize,
    /// Elements of each kind.
    pub elements_by_kind: BTreeMap<String, usize>,
    /// Parts that no element connects.
    pub bodies: usize,
    /// Least coordinates, m.
    pub lowest_m: [f64; 3],
    /// Largest coordinates, m.
    pub highest_m: [f64; 3],
    /// Shortest edge, m.
    pub smallest_edge_m: f64,
    /// Longest edge, m.
    pub largest_edge_m: f64,
    /// Largest ratio of the edges of one element.
    pub largest_aspect_ratio: f64,
    /// Smallest Jacobian determinant of an element over its largest.
    pub worst_jacobian: f64,
    /// Centre of the element that has it, m.
    pub worst_element_at_m: [f64; 3],
    /// Volume, m3.
    pub volume_m3: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Regions with their elements, volumes and masses.
    pub regions: Vec<SolidRegion>,
    /// Named surfaces and sets of nodes.
    pub boundaries: Vec<SolidBoundary>,
}

/// One region of solid bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidRegion {
    /// Its name.
    pub name: String,
    /// Its elements.
    pub elements: usize,
    /// Its volume, m3.
    pub volume_m3: f64,
    /// Its mass, kg.
    pub mass_kg: f64,
}

/// One named surface of solid bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidBoundary {
    /// Its name.
    pub name: String,
    /// Its nodes.
    pub nodes: usize,
    /// Its faces.
    pub faces: usize,
    /// Their area, m2.
    pub area_m2: f64,
    /// What holds or loads it, or what it slides on, in a word.
    pub condition: String,
}

impl Summary for SolidMeshSummary {
    fn headline(&self) -> Vec<Entry> {
        vec![
            Entry::new("mesh.nodes", self.mesh.nodes),
            Entry::new("mesh.elements", self.mesh.elements),
            Entry::new("mesh.dofs", self.mesh.dofs),
            Entry::new("mesh.contact_nodes", self.mesh.contact_nodes),
        ]
    }
}

impl SolidMeshStatistics {
    /// Measures a mesh; `densities` are those of its regions, `roles` names boundaries that slide or are glued.
    pub fn new(mesh: &Mesh, densities: &[f64], roles: &BTreeMap<usize, &'static str>) -> Self {
        let quality = mesh.quality();
        let volumes = mesh.region_measures();
        let mut by_kind: BTreeMap<String, usize> = BTreeMap::new();
        let mut counts = vec![0; mesh.regions.len()];
        for element in 0..mesh.element_count() {
            let name = mesh.element_kind(element).name();
            *by_kind.entry(name.to_owned()).or_default() += 1;
            counts[mesh.region(element)] += 1;
        }
        let regions = mesh
            .regions
            .iter()
            .enumerate()
            .map(|(r, name)| SolidRegion {
                name: name.clone(),
                elements: counts[r],
                volume_m3: volumes[r],
                mass_kg: densities[r] * volumes[r],
            });
        let regions: Vec<SolidRegion> = regions.collect();
        let contact_nodes: BTreeSet<u32> = roles
            .iter()
            .filter(|role| *role.1 == "contact")
            .flat_map(|role| mesh.boundaries[*role.0].nodes.iter().copied())
            .collect();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            mesh.nodes.iter().map(|point| point[axis]).fold(start, pick)
        };
        let worst = mesh.element_nodes(quality.worst_element);
        let centre = [0, 1, 2].map(|axis| {
            let sum: f64 = worst
                .iter()
                .map(|&node| mesh.nodes[node as usize][axis])
                .sum();
            sum / worst.len() as f64
        });
        Self {
            nodes: mesh.node_count(),
            elements: mesh.element_count(),
            dofs: mesh.dof_count(),
            contact_nodes: contact_nodes.len(),
            elements_by_kind: by_kind,
            bodies: 1 + mesh.bodies().into_iter().max().unwrap_or(0),
            lowest_m: [0, 1, 2].map(|axis| bound(axis, f64::min, f64::INFINITY)),
            highest_m: [0, 1, 2].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY)),
            smallest_edge_m: quality.smallest_edge,
            largest_edge_m: quality.largest_edge,
            largest_aspect_ratio: quality.largest_aspect_ratio,
            worst_jacobian: quality.worst_jacobian,
            worst_element_at_m: centre,
            volume_m3: regions.iter().map(|region| region.volume_m3).sum(),
            mass_kg: regions.iter().map(|region| region.mass_kg).sum(),
            regions,
            boundaries: boundaries_of(mesh, roles),
        }
    }
}

/// The named boundaries of a mesh; `roles` of those that slide or are glued.
fn boundaries_of(mesh: &Mesh, roles: &BTreeMap<usize, &'static str>) -> Vec<SolidBoundary> {
    let boundaries = mesh
        .boundaries
        .iter()
        .enumerate()
        .map(|(b, boundary)| SolidBoundary {
            name: boundary.name.clone(),
            nodes: boundary.nodes.len(),
            faces: boundary.faces.len(),
            area_m2: mesh.face_area(&boundary.faces),
            condition: match roles.get(&b) {
                Some(role) => (*role).to_owned(),
                None => condition_name(boundary.condition).to_owned(),
            },
        });
    boundaries.collect()
}

/// What a condition does, in a word.
pub(super) fn condition_name(condition: BoundaryCondition) -> &'static str {
    match condition {
        BoundaryCondition::Clamped => "clamped",
        BoundaryCondition::Support(_) => "support",
        BoundaryCondition::Guide => "guide",
        BoundaryCondition::Fixed(_) => "fixed",
        BoundaryCondition::Pressure(_) => "pressure",
        BoundaryCondition::Free => "free",
    }
}

/// The summary as text.
pub fn print(summary: &SolidMeshSummary) -> String {
    let mesh = &summary.mesh;
    let text = |key: &str, value: f64| quantity(key).text(value);
    let kinds = mesh.elements_by_kind.iter();
    let kinds: Vec<String> = kinds
        .map(|(kind, count)| format!("{count} {kind}"))
        .collect();
    let plural = if mesh.bodies == 1 { "y" } else { "ies" };
    let mut out = format!(
        "{} nodes, {} elements ({}), {} unknowns, {} contact nodes, {} separate bod{plural}\n",
        mesh.nodes,
        mesh.elements,
        kinds.join(", "),
        mesh.dofs,
        mesh.contact_nodes,
        mesh.bodies,
    );
    let extent = |axis: usize| format!("{:.6} to {:.6}", mesh.lowest_m[axis], mesh.highest_m[axis]);
    let [x, y, z] = mesh.worst_element_at_m;
    let _ = writeln!(
        out,
        "x {}, y {}, z {} m\nedges {} to {}, aspect ratio up to {}, worst Jacobian {:.3} at ({x:.6}, {y:.6}, {z:.6}) m\n\
         volume {:.6e} m3, mass {:.6} kg",
        extent(0),
        extent(1),
        extent(2),
        quantity("smallest_edge_m").number(mesh.smallest_edge_m),
        text("largest_edge_m", mesh.largest_edge_m),
        text("largest_aspect_ratio", mesh.largest_aspect_ratio),
        mesh.worst_jacobian,
        mesh.volume_m3,
        mesh.mass_kg,
    );
    for region in &mesh.regions {
        let _ = writeln!(
            out,
            "region {}: {} elements, {:.6e} m3, {:.6} kg",
            region.name, region.elements, region.volume_m3, region.mass_kg
        );
    }
    for boundary in &mesh.boundaries {
        let _ = writeln!(
            out,
            "boundary {}: {} nodes, {} faces, {}, {}",
            boundary.name,
            boundary.nodes,
            boundary.faces,
            text("area_m2", boundary.area_m2),
            boundary.condition
        );
    }
    for line in &summary.not_used {
        let _ = writeln!(out, "not used: {line}");
    }
    out
}

/// Writes `mesh.vtu` with node numbers, what is held, and the region of each element.
///
/// # Errors
/// Those of the folder.
pub fn write(
    folder: &OutputFolder,
    mesh: &Mesh,
    roles: &BTreeMap<usize, &'static str>,
) -> Result<(), FolderError> {
    let ids = (0..mesh.node_count()).map(|node| mesh.node_label(node) as i64);
    let mut surface = vec![0; mesh.node_count()];
    mesh.held_dofs().for_each(|dof| surface[dof / 3] = 2);
    for (&boundary, _) in roles.iter().filter(|role| *role.1 == "contact") {
        for &node in &mesh.boundaries[boundary].nodes {
            surface[node as usize] = 1;
        }
    }
    let fields = [
        Field::integers("node_id", ids.collect()),
        // 1 contact, 2 held, 0 elsewhere.
        Field::integers("edge", surface),
    ];
    // Counted from 1 in the order in which the summary lists them.
    let regions = (0..mesh.element_count()).map(|element| mesh.region(element) as i64 + 1);
    let regions = [Field::integers("region_id", regions.collect())];
    folder.write("mesh.vtu", |out| {
        write_vtu(out, &EncodedMesh::new(mesh)?, &[], &fields, &regions)
    })?;
    Ok(())
}
