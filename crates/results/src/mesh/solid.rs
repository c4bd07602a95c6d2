//! Results of `mesh` for solid bodies of a mesh file.

use super::{Measured, MeshSize, role_of};
use crate::finding::finding;
use frictionsim_output::{Described, Section, Table};
use frictionsim_physics::mesh::{Mesh, MeshQuality};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Size and quality of the mesh of solid bodies.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct SolidMeshStatistics {
    /// Counts; unknowns with those that are held.
    #[serde(flatten)]
    pub size: MeshSize,
    /// Elements of each kind.
    pub elements_by_kind: BTreeMap<String, usize>,
    /// Parts that no element connects.
    pub bodies: usize,
    /// Least coordinates, m.
    pub lowest_m: [f64; 3],
    /// Largest coordinates, m.
    pub highest_m: [f64; 3],
    /// Sizes and shapes of the elements.
    #[serde(flatten)]
    pub shape: MeshQuality,
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

finding! {
    /// One region of solid bodies.
    #[derive(Clone, Debug, PartialEq, Described, Serialize)]
    SolidRegion, REGIONS {
        name: String = "its name", Always "region" Plain;
        elements: usize = "its elements", Always "elements" Count;
        volume_m3: f64 = "its volume", Always "volume" Scientific(6);
        mass_kg: f64 = "its mass", Always "mass" Fixed(6);
    }
}

finding! {
    /// One named surface of solid bodies.
    #[derive(Clone, Debug, PartialEq, Described, Serialize)]
    SolidBoundary, BOUNDARIES {
        name: String = "its name", Always "boundary" Plain;
        nodes: usize = "its nodes", Always "nodes" Count;
        faces: usize = "its faces", Always "faces" Count;
        area_m2: f64 = "their area", Always "area" Scientific(6);
        condition: String = "what holds or loads it, or what it slides on, in a word",
            Always "condition" Plain;
    }
}

impl Measured for SolidMeshStatistics {
    fn section(&self) -> Section {
        let kinds = self.elements_by_kind.iter();
        let kinds: Vec<String> = kinds.map(|(kind, count)| format!("{count} {kind}")).collect();
        let point = |[x, y, z]: [f64; 3]| format!("({x:.6}, {y:.6}, {z:.6}) m");
        super::results(&self.size, &self.shape)
            .facts([
                ("elements by kind", kinds.join(", ")),
                ("separate bodies", self.bodies.to_string()),
                ("from", point(self.lowest_m)),
                ("to", point(self.highest_m)),
                ("worst element at", point(self.worst_element_at_m)),
                ("volume", format!("{:.6e} m3", self.volume_m3)),
                ("mass", format!("{:.6} kg", self.mass_kg)),
            ])
            .tables([
                Table::new("", "Regions").columns(REGIONS, &self.regions),
                Table::new("", "Boundaries").columns(BOUNDARIES, &self.boundaries),
            ])
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
        let regions = mesh.regions.iter().enumerate().map(|(r, name)| SolidRegion {
            name: name.clone(),
            elements: counts[r],
            volume_m3: volumes[r],
            mass_kg: densities[r] * volumes[r],
        });
        let regions: Vec<SolidRegion> = regions.collect();
        let contacts = roles.iter().filter(|role| *role.1 == "contact");
        let contact_nodes: BTreeSet<u32> =
            contacts.flat_map(|role| mesh.boundaries[*role.0].nodes.iter().copied()).collect();
        let bound = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| {
            mesh.nodes.iter().map(|point| point[axis]).fold(start, pick)
        };
        let worst = mesh.element_nodes(quality.worst_element);
        let centre = [0, 1, 2].map(|axis| {
            let sum: f64 = worst.iter().map(|&node| mesh.nodes[node as usize][axis]).sum();
            sum / worst.len() as f64
        });
        Self {
            size: MeshSize::new(mesh, contact_nodes.len()),
            elements_by_kind: by_kind,
            bodies: 1 + mesh.bodies().into_iter().max().unwrap_or(0),
            lowest_m: [0, 1, 2].map(|axis| bound(axis, f64::min, f64::INFINITY)),
            highest_m: [0, 1, 2].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY)),
            shape: quality,
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
    let boundaries = mesh.boundaries.iter().enumerate().map(|(b, boundary)| SolidBoundary {
        name: boundary.name.clone(),
        nodes: boundary.nodes.len(),
        faces: boundary.faces.len(),
        area_m2: mesh.face_area(&boundary.faces),
        condition: role_of(mesh, b, roles).to_owned(),
    });
    boundaries.collect()
}
