//! Size and quality of a mesh: of plane bodies, bodies of revolution and solid bodies.

use super::{Roles, condition_name, contact_nodes, role_of};
use crate::common::*;
use frictionsim_physics::mesh::{AnnulusMesh, MeshQuality, SolidContact};

keys! {
    /// Size and quality of a mesh.
    #[derive(Default)]
    MeshStatistics {
        nodes: usize = "nodes";
        elements: usize = "elements";
        dofs: usize = "unknowns: two for each node in the plane, three in space, with those that are held";
        contact_nodes: usize = "nodes of the contact edge, or of the surfaces that slide on others";
        axial_elements?: usize = "layers of bricks over the thickness of a body in three \
            dimensions. Edges, quality and areas are of its plane section then";
        nodes_per_sector?: usize = "on the annulus, nodes of one ray of corner nodes: node \
            `1 + j (nodes_per_sector) + i`";
        elements_by_kind?: BTreeMap<String, usize> = "elements of each kind, of solid bodies";
        bodies?: usize = "parts that no element connects";
        lowest_m?: [f64; 3] = "least coordinates, m";
        highest_m?: [f64; 3] = "largest coordinates, m";
        #[serde(flatten)]
        shape: MeshQuality = "sizes and shapes of the elements";
        worst_element_at_m?: [f64; 3] = "centre of the element that has it, m";
        unnamed_free_edges?: usize = "edges of one element alone that belong to no named boundary, of a mesh file";
        area_m2?: f64 = "area of the mesh, m2";
        area_error?: f64 = "its relative difference to the annulus";
        elements_per_wavelength?: f64 = "elements for each shear wavelength at the highest \
            frequency of the case, where it has one: the largest edge counts";
        contact_nodes_per_wave?: f64 = "contact nodes for each such wave, where they are farthest apart on average";
        volume_m3?: f64 = "volume, m3";
        mass_kg?: f64 = "mass, kg";
        regions: Vec<RegionStatistics> = "regions with their elements and areas, or volumes and masses";
        boundaries: Vec<BoundaryStatistics> = "boundaries with their nodes and lengths, or faces and areas";
    }

    /// One region of a mesh.
    RegionStatistics, REGIONS {
        name: String = "its name", Always "region" Plain;
        elements: usize = "its elements", Always "elements" Count;
        area_m2?: f64 = "its area", IfAny "area" Scientific(6);
        volume_m3?: f64 = "its volume", IfAny "volume" Scientific(6);
        mass_kg?: f64 = "its mass", IfAny "mass" Fixed(6);
    }

    /// One boundary of a mesh.
    BoundaryStatistics, BOUNDARIES {
        name: String = "its name", Always "boundary" Plain;
        nodes: usize = "its nodes", Always "nodes" Count;
        faces?: usize = "its faces, of solid bodies", IfAny "faces" Count;
        length_m?: Option<f64> = "its length, around a face of a body of revolution", IfAny "length" Scientific(6);
        area_m2?: f64 = "area of its faces, or of a face of a body of revolution", IfAny "area" Scientific(6);
        condition: String = "what holds or loads it, or what it slides on, in a word", Always "condition" Plain;
    }
}

impl MeshStatistics {
    /// Measures a plane mesh between its corner nodes; areas follow curved edges. `wavelength` is the shortest that the
    /// case is about, m.
    pub fn new(mesh: &Mesh, annulus: Option<&AnnulusMesh>, wavelength: Option<f64>) -> Self {
        let own = Self::measured(mesh, &super::plane_roles(mesh));
        let area: f64 = own.regions.iter().filter_map(|region| region.area_m2).sum();
        let exact = |annulus: &AnnulusMesh| {
            let spec = &annulus.specification;
            let bore = spec.shaft.map_or(spec.inner_radius, |shaft| shaft.inner_radius);
            std::f64::consts::PI * (spec.outer_radius.powi(2) - bore.powi(2))
        };
        let contact = mesh.contact_edge();
        let contact_length: f64 = contact.tributary_lengths.iter().sum();
        let spacing = contact_length / contact.nodes.len() as f64;
        let is_labelled = !mesh.labels.is_empty();
        Self {
            nodes_per_sector: annulus.map(AnnulusMesh::sector_node_count),
            unnamed_free_edges: is_labelled.then(|| mesh.unnamed_edge_count()).flatten(),
            area_m2: Some(area),
            area_error: annulus.map(|annulus| (area / exact(annulus) - 1.0).abs()),
            elements_per_wavelength: wavelength.map(|length| length / own.shape.largest_edge_m),
            contact_nodes_per_wave: wavelength.map(|length| length / spacing),
            ..own
        }
    }

    /// Measures the mesh of solid bodies; `densities` are those of its regions, `roles` names boundaries that slide or
    /// are glued.
    pub fn of_solids(mesh: &Mesh, densities: &[f64], roles: &Roles) -> Self {
        let mut own = Self::measured(mesh, roles);
        for (region, density) in own.regions.iter_mut().zip(densities) {
            region.mass_kg = region.volume_m3.map(|volume| density * volume);
        }
        let mut by_kind: BTreeMap<String, usize> = BTreeMap::new();
        for element in 0..mesh.element_count() {
            *by_kind.entry(mesh.element_kind(element).name().to_owned()).or_default() += 1;
        }
        let ends = [0, 1, 2].map(|axis| extremes(mesh.nodes.iter().map(|point| point[axis])));
        let worst = mesh.element_nodes(own.shape.worst_element);
        let centre = [0, 1, 2].map(|axis| {
            let sum: f64 = worst.iter().map(|&node| mesh.nodes[node as usize][axis]).sum();
            sum / worst.len() as f64
        });
        let regions = || own.regions.iter();
        Self {
            elements_by_kind: Some(by_kind),
            bodies: Some(1 + mesh.bodies().into_iter().max().unwrap_or(0)),
            lowest_m: Some(ends.map(|(low, _)| low)),
            highest_m: Some(ends.map(|(_, high)| high)),
            worst_element_at_m: Some(centre),
            volume_m3: Some(regions().filter_map(|region| region.volume_m3).sum()),
            mass_kg: Some(regions().filter_map(|region| region.mass_kg).sum()),
            ..own
        }
    }

    /// What meshes of every body have.
    fn measured(mesh: &Mesh, roles: &Roles) -> Self {
        let is_solid = mesh.dimension == 3;
        let mut counts = vec![0; mesh.regions.len()];
        (0..mesh.element_count()).for_each(|element| counts[mesh.region(element)] += 1);
        let regions = mesh.regions.iter().zip(counts).zip(mesh.region_measures());
        let regions = regions.map(|((name, elements), measure)| RegionStatistics {
            name: name.clone(),
            elements,
            area_m2: (!is_solid).then_some(measure),
            volume_m3: is_solid.then_some(measure),
            mass_kg: None,
        });
        let boundaries = mesh.boundaries.iter().enumerate().map(|(b, own)| BoundaryStatistics {
            name: own.name.clone(),
            nodes: own.nodes.len(),
            faces: is_solid.then_some(own.faces.len()),
            length_m: (!is_solid).then(|| Some(own.tributary_lengths.iter().sum())),
            area_m2: is_solid.then(|| mesh.face_area(&own.faces)),
            condition: role_of(mesh, b, roles).to_owned(),
        });
        Self {
            nodes: mesh.node_count(),
            elements: mesh.element_count(),
            dofs: mesh.dof_count(),
            contact_nodes: contact_nodes(mesh, roles).len(),
            shape: mesh.quality(),
            regions: regions.collect(),
            boundaries: boundaries.collect(),
            ..Self::default()
        }
    }

    /// Counts of the body of revolution whose plane section was measured.
    pub fn turn(&mut self, sector: &SolidSector) {
        let sectors = sector.sector_count();
        self.nodes = sectors * sector.node_count();
        self.elements = sectors * sector.elements.len();
        self.dofs = 3 * self.nodes;
        self.contact_nodes = sector.rings.iter().map(|ring| sectors * ring.nodes.len()).sum();
        self.axial_elements = Some(sector.specification.axial_elements);
        self.nodes_per_sector = Some(sector.node_count());
        if sector.specification.contact != SolidContact::Inner {
            self.contact_nodes_per_wave = None;
        }
        let (own, edges) = (&sector.specification, std::mem::take(&mut self.boundaries));
        let faces = SolidFace::ALL.into_iter().zip(own.conditions).map(|(face, condition)| {
            let edge = edges.iter().find(|edge| edge.name == face.name());
            let length = edge.and_then(|edge| edge.length_m?);
            let nodes = (0..sector.node_count()).filter(|&node| sector.is_on(node, face));
            let is_contact = face == own.contact.face();
            BoundaryStatistics {
                name: face.name().to_owned(),
                nodes: sectors * nodes.count(),
                faces: None,
                length_m: Some(length),
                area_m2: length.map_or(self.area_m2, |length| Some(length * own.thickness)),
                condition: if is_contact { "contact" } else { condition_name(condition) }
                    .to_owned(),
            }
        });
        self.boundaries = faces.collect();
    }

    /// What there is to say of it.
    pub(super) fn section(&self) -> Section {
        let shape = &self.shape;
        let number = |name: &'static str, value: Option<f64>, format: Format, unit: &str| {
            Some((name, format.text(value?, unit)))
        };
        let metres = |name, value| number(name, Some(value), Format::Scientific(4), "m");
        let count = |name: &'static str, count: usize| Some((name, count.to_string()));
        let point = |name: &'static str, at: Option<[f64; 3]>| {
            at.map(|[x, y, z]| (name, format!("({x:.6}, {y:.6}, {z:.6}) m")))
        };
        let (few, fine) = (Format::Significant(5), Format::Scientific(6));
        let kinds = self.elements_by_kind.as_ref().map(|kinds| {
            let kinds: Vec<String> =
                kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
            ("elements by kind", kinds.join(", "))
        });
        let facts = [
            count("nodes", self.nodes),
            count("elements", self.elements),
            count("unknowns", self.dofs),
            count("contact nodes", self.contact_nodes),
            metres("shortest edge", shape.smallest_edge_m),
            metres("longest edge", shape.largest_edge_m),
            number("largest aspect ratio", Some(shape.largest_aspect_ratio), Format::Fixed(2), ""),
            Some(("worst Jacobian", significant(shape.worst_jacobian, 5))),
            number("area", self.area_m2, fine, "m2"),
            number("area off the annulus by", self.area_error, Format::Scientific(1), ""),
            number("elements per wavelength", self.elements_per_wavelength, few, ""),
            number("contact nodes per wave", self.contact_nodes_per_wave, few, ""),
            kinds,
            self.bodies.and_then(|bodies| count("separate bodies", bodies)),
            point("from", self.lowest_m),
            point("to", self.highest_m),
            point("worst element at", self.worst_element_at_m),
            number("volume", self.volume_m3, fine, "m3"),
            number("mass", self.mass_kg, Format::Fixed(6), "kg"),
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
        let free = self.unnamed_free_edges.filter(|count| *count > 0);
        let words = ["free edge is in no physical curve", "free edges are in no physical curve"];
        let free = free.map(|count| plural(count, words));
        Section::new("Results")
            .facts(facts.into_iter().flatten())
            .tables([
                Table::new("", "Regions").columns(REGIONS, &self.regions),
                Table::new("", "Boundaries").columns(BOUNDARIES, &self.boundaries),
            ])
            .text([layers, ids, free].into_iter().flatten())
    }
}
