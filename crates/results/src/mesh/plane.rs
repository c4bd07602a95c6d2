//! Results of `mesh` for plane bodies and bodies of revolution.

use super::{Measured, MeshSize, condition_name, write_nodes};
use crate::finding::finding;
use crate::folder::{FolderError, OutputFolder};
use frictionsim_output::{Described, Format, Section, Table};
use frictionsim_physics::mesh::{
    AnnulusMesh, Mesh, MeshQuality, SolidContact, SolidFace, SolidSector,
};
use serde::Serialize;

/// Size and quality of a mesh.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct MeshStatistics {
    /// Counts.
    #[serde(flatten)]
    pub size: MeshSize,
    /// Layers of bricks over the thickness of a body in three dimensions. Edges, quality and areas are of its plane
    /// section then.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial_elements: Option<usize>,
    /// On the annulus, nodes of one ray of corner nodes: node `1 + j (nodes_per_sector) + i`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes_per_sector: Option<usize>,
    /// Sizes and shapes of the elements.
    #[serde(flatten)]
    pub shape: MeshQuality,
    /// Edges of one element alone that belong to no named boundary, of a mesh file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unnamed_free_edges: Option<usize>,
    /// Area of the mesh, m2.
    pub area_m2: f64,
    /// Its relative difference to the annulus.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area_error: Option<f64>,
    /// Elements for each shear wavelength at the highest frequency of the case, where it has one: the largest edge
    /// counts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elements_per_wavelength: Option<f64>,
    /// Contact nodes for each such wave, where they are farthest apart on average.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_nodes_per_wave: Option<f64>,
    /// Regions with their elements and areas.
    pub regions: Vec<RegionStatistics>,
    /// Boundaries with their nodes and lengths; faces of a body of revolution with their areas.
    pub boundaries: Vec<BoundaryStatistics>,
}

finding! {
    /// One region of a mesh.
    #[derive(Clone, Debug, PartialEq, Described, Serialize)]
    RegionStatistics, REGIONS {
        name: String = "its name", Always "region" Plain;
        elements: usize = "its elements", Always "elements" Count;
        area_m2: f64 = "its area", Always "area" Scientific(6);
    }
}

finding! {
    /// One boundary of a mesh.
    #[derive(Clone, Debug, PartialEq, Described, Serialize)]
    BoundaryStatistics, BOUNDARIES {
        name: String = "its name", Always "boundary" Plain;
        nodes: usize = "its nodes", Always "nodes" Count;
        length_m: Option<f64> = "its length, around a face of a body of revolution",
            IfAny "length" Scientific(6);
        #[serde(skip_serializing_if = "Option::is_none")]
        area_m2: Option<f64> = "its area, of a face of a body of revolution",
            IfAny "area" Scientific(6);
        condition: String = "what holds it, in a word", Always "condition" Plain;
    }
}

impl Measured for MeshStatistics {
    fn section(&self) -> Section {
        let number = |name: &'static str, value: Option<f64>, format: Format| {
            Some((name, format.number(value?)))
        };
        let few = Format::Significant(5);
        let further = [
            number("area off the annulus by", self.area_error, Format::Scientific(1)),
            number("elements per wavelength", self.elements_per_wavelength, few),
            number("contact nodes per wave", self.contact_nodes_per_wave, few),
        ];
        let layers = self.axial_elements.map(|layers| {
            format!(
                "{layers} layers of bricks over the thickness; edges, quality, areas and picture \
                are of the section across the axis"
            )
        });
        let place = match self.axial_elements {
            Some(_) => "k, k in the sheet of a sector",
            None => "i, i outwards along a ray",
        };
        let ids = self.nodes_per_sector;
        let ids = ids.map(|nodes| format!("node ids: 1 + j {nodes} + {place}, j around from +x"));
        let free = match self.unnamed_free_edges {
            None | Some(0) => None,
            Some(1) => Some("1 free edge is in no physical curve".to_owned()),
            Some(count) => Some(format!("{count} free edges are in no physical curve")),
        };
        super::results(&self.size, &self.shape)
            .facts([("area", Format::Scientific(6).text(self.area_m2, "m2"))])
            .facts(further.into_iter().flatten())
            .tables([
                Table::new("", "Regions").columns(REGIONS, &self.regions),
                Table::new("", "Boundaries").columns(BOUNDARIES, &self.boundaries),
            ])
            .text([layers, ids, free].into_iter().flatten())
    }
}

impl MeshStatistics {
    /// Counts of the body of revolution whose plane section was measured.
    pub fn turn(&mut self, sector: &SolidSector) {
        let sectors = sector.sector_count();
        self.size.nodes = sectors * sector.node_count();
        self.size.elements = sectors * sector.elements.len();
        self.size.dofs = 3 * self.size.nodes;
        self.size.contact_nodes = sector.rings.iter().map(|ring| sectors * ring.nodes.len()).sum();
        self.axial_elements = Some(sector.specification.axial_elements);
        self.nodes_per_sector = Some(sector.node_count());
        if sector.specification.contact != SolidContact::Inner {
            self.contact_nodes_per_wave = None;
        }
        let (own, edges) = (&sector.specification, std::mem::take(&mut self.boundaries));
        let faces = SolidFace::ALL.into_iter().zip(own.conditions).map(|(face, condition)| {
            let edge = edges.iter().find(|edge| edge.name == face.name());
            let length_m = edge.and_then(|edge| edge.length_m);
            let nodes = (0..sector.node_count()).filter(|&node| sector.is_on(node, face));
            let is_contact = face == own.contact.face();
            BoundaryStatistics {
                name: face.name().to_owned(),
                nodes: sectors * nodes.count(),
                length_m,
                area_m2: Some(length_m.map_or(self.area_m2, |length| length * own.thickness)),
                condition: if is_contact { "contact" } else { condition_name(condition) }
                    .to_owned(),
            }
        });
        self.boundaries = faces.collect();
    }

    /// Measures a mesh between its corner nodes; areas follow curved edges. `wavelength` is the shortest that the case
    /// is about, m.
    pub fn new(mesh: &Mesh, annulus: Option<&AnnulusMesh>, wavelength: Option<f64>) -> Self {
        let quality = mesh.quality();
        let empty =
            |name: &String| RegionStatistics { name: name.clone(), elements: 0, area_m2: 0.0 };
        let mut regions: Vec<RegionStatistics> = mesh.regions.iter().map(empty).collect();
        for element in 0..mesh.element_count() {
            let region = &mut regions[mesh.region(element)];
            region.elements += 1;
            region.area_m2 += mesh.element_measure(element);
        }
        let area: f64 = regions.iter().map(|region| region.area_m2).sum();
        let exact = |annulus: &AnnulusMesh| {
            let spec = &annulus.specification;
            let bore = spec.shaft.map_or(spec.inner_radius, |shaft| shaft.inner_radius);
            std::f64::consts::PI * (spec.outer_radius.powi(2) - bore.powi(2))
        };
        let contact = mesh.contact_edge();
        let contact_length: f64 = contact.tributary_lengths.iter().sum();
        let spacing = contact_length / contact.nodes.len() as f64;
        let boundaries = mesh.boundaries.iter().enumerate().map(|(b, boundary)| {
            let condition = match b {
                b if b == mesh.contact => "contact",
                b if Some(b) == mesh.opposite => "counterface",
                _ => condition_name(boundary.condition),
            };
            BoundaryStatistics {
                name: boundary.name.clone(),
                nodes: boundary.nodes.len(),
                length_m: Some(boundary.tributary_lengths.iter().sum()),
                area_m2: None,
                condition: condition.to_owned(),
            }
        });
        Self {
            size: MeshSize::new(mesh, contact.nodes.len()),
            axial_elements: None,
            nodes_per_sector: annulus.map(AnnulusMesh::sector_node_count),
            shape: quality,
            unnamed_free_edges: (!mesh.labels.is_empty())
                .then(|| mesh.unnamed_edge_count())
                .flatten(),
            area_m2: area,
            area_error: annulus.map(|annulus| (area / exact(annulus) - 1.0).abs()),
            elements_per_wavelength: wavelength.map(|length| length / quality.largest_edge_m),
            contact_nodes_per_wave: wavelength.map(|length| length / spacing),
            regions,
            boundaries: boundaries.collect(),
        }
    }
}

/// Writes the bricks of a body of revolution.
pub fn write_revolution(folder: &OutputFolder, sector: &SolidSector) -> Result<(), FolderError> {
    let per_sector = sector.node_count();
    let edge_of = |node: usize| match node % per_sector {
        node if sector.rings.iter().any(|ring| ring.nodes.contains(&node)) => 1,
        node => 2 * i64::from((3 * node..3 * node + 3).any(|dof| sector.is_held(dof))),
    };
    let mesh = sector.whole();
    let edge = (0..mesh.node_count()).map(edge_of).collect();
    write_nodes(folder, &mesh, edge, &[])
}
