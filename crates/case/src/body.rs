//! The body of a case: what it is made of, and its kinds, each with data of its own.

use super::{AssemblyBody, ImportedBody};
use crate::*;
use frictionsim_physics::mesh::{AnnulusMesh, MeshError};
use std::f64::consts::PI;

/// The body of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The material of each region of the mesh; of an annulus those of the disc and of its shaft.
    pub materials: Vec<RegionMaterial>,
    /// What it is.
    pub kind: BodyKind,
}

/// What a body is.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyKind {
    /// A plane annulus that is generated from radii and element counts, with or without a deformable shaft in it.
    Annulus(AnnulusSpecification),
    /// A body of revolution in three dimensions that is generated from radii, thickness and element counts.
    Revolution(Box<SolidSpecification>),
    /// A plane body from a mesh file.
    Imported(ImportedBody),
    /// Solid bodies from a mesh file.
    Assembly(AssemblyBody),
}

impl Body {
    /// The plane annulus, if it is one.
    pub fn annulus(&self) -> Option<&AnnulusSpecification> {
        if let BodyKind::Annulus(own) = &self.kind { Some(own) } else { None }
    }

    /// The body of revolution in three dimensions, if it is one.
    pub fn revolution(&self) -> Option<&SolidSpecification> {
        if let BodyKind::Revolution(own) = &self.kind { Some(own) } else { None }
    }

    /// The radii, thickness and element counts of a body of revolution, on its whole mesh or not.
    pub fn revolved(&self) -> Option<&SolidSpecification> {
        self.revolution().or_else(|| self.assembly()?.made_of.as_deref())
    }

    /// The body from a mesh file, if it is one.
    pub fn imported(&self) -> Option<&ImportedBody> {
        if let BodyKind::Imported(own) = &self.kind { Some(own) } else { None }
    }

    /// The solid bodies from a mesh file, if it is some.
    pub fn assembly(&self) -> Option<&AssemblyBody> {
        if let BodyKind::Assembly(own) = &self.kind { Some(own) } else { None }
    }

    /// Radii and element counts across the axis, of a generated body.
    pub fn grid(&self) -> Option<&AnnulusSpecification> {
        self.annulus().or(self.revolution().map(|solid| &solid.annulus))
    }

    /// Whether the body consists of equal sectors, so that its motions have harmonics.
    pub fn has_sectors(&self) -> bool {
        self.grid().is_some()
    }

    /// Whether it was made of one sector of a mesh file.
    pub fn is_of_sectors(&self) -> bool {
        self.whole_mesh().is_some_and(|mesh| mesh.symmetry.is_some())
    }

    /// Number of equal sectors, if the body has them.
    pub fn sector_count(&self) -> Option<usize> {
        self.grid().map(|grid| grid.circumferential_elements)
    }

    /// Components of a displacement.
    pub fn dimension(&self) -> usize {
        match self.kind {
            BodyKind::Revolution(_) | BodyKind::Assembly(_) => 3,
            BodyKind::Annulus(_) | BodyKind::Imported(_) => 2,
        }
    }

    /// Nodes, in a width that no input overflows.
    pub fn node_count(&self) -> u128 {
        match &self.kind {
            BodyKind::Annulus(annulus) => node_count(annulus),
            BodyKind::Revolution(solid) => solid_node_count(solid),
            _ => self.whole_mesh().map_or(0, |mesh| mesh.node_count() as u128),
        }
    }

    /// Elements, in a width that no input overflows.
    pub fn element_count(&self) -> u128 {
        let Some(grid) = self.grid() else {
            return self.whole_mesh().map_or(0, |mesh| mesh.element_count() as u128);
        };
        let around = grid.circumferential_elements as u128 * grid.elements_per_sector() as u128;
        around * self.revolution().map_or(1, |own| own.axial_elements as u128)
    }

    /// Contact nodes, under a ring at most those of the whole face, in a width that no input overflows.
    pub fn contact_node_count(&self) -> u128 {
        let around = |grid: &AnnulusSpecification| {
            (1 + u128::from(grid.element.is_quadratic())) * grid.circumferential_elements as u128
        };
        match &self.kind {
            BodyKind::Annulus(annulus) => around(annulus),
            BodyKind::Revolution(solid) => {
                let rings = match solid.contact {
                    SolidContact::Inner => solid.axial_elements + 1,
                    SolidContact::Ring { .. } => solid.annulus.radial_elements + 1,
                };
                rings as u128 * around(&solid.annulus)
            }
            BodyKind::Imported(imported) => imported.mesh.contact_edge().nodes.len() as u128,
            BodyKind::Assembly(own) => {
                let surfaces = own.contacts.iter().map(|contact| contact.surface);
                surfaces.map(|place| own.mesh.boundaries[place].nodes.len() as u128).sum()
            }
        }
    }

    /// Whether an element has nodes between its corners.
    pub fn is_quadratic(&self) -> bool {
        let kinds = self.whole_mesh().map_or(&[][..], |mesh| &mesh.element_kinds);
        let own = self.grid().map(|grid| &grid.element);
        own.into_iter().chain(kinds).any(|kind| kind.is_quadratic())
    }

    /// Whether the elements are those that the explicit transient of this body takes.
    pub fn suits_transient(&self) -> bool {
        !self.has_sectors() || !self.is_quadratic()
    }

    /// Area of the body across the axis, m2.
    pub fn area(&self) -> f64 {
        match (self.grid(), self.imported()) {
            (Some(grid), _) => PI * (grid.outer_radius.powi(2) - grid.inner_radius.powi(2)),
            (_, Some(imported)) => imported.mesh.area(),
            _ => (2.0 * self.size()).powi(2),
        }
    }

    /// Half the largest extent of the body across the axis, m.
    pub fn size(&self) -> f64 {
        let of_mesh = self.whole_mesh().map(|mesh| mesh.size());
        self.grid().map(|grid| grid.outer_radius).or(of_mesh).unwrap_or(0.0)
    }

    /// Whether its counterface moves along a straight line.
    pub fn slides_straight(&self) -> bool {
        let plane = self.imported().map(|own| &own.mesh.counterface);
        let rigid = self.assembly().and_then(AssemblyBody::rigid_counterface);
        matches!(plane, Some(Counterface::Plane { .. }))
            || matches!(rigid.map(|own| own.motion), Some(RigidMotion::Sliding(_)))
    }

    /// Radii between which a plane body or one of revolution touches a counterface that turns, m.
    pub(super) fn contact_radii(&self) -> Option<[f64; 2]> {
        Some(match &self.kind {
            BodyKind::Annulus(annulus) => [annulus.inner_radius; 2],
            BodyKind::Revolution(solid) => match solid.contact {
                SolidContact::Inner => [solid.annulus.inner_radius; 2],
                SolidContact::Ring { inner_radius, outer_radius } => [inner_radius, outer_radius],
            },
            BodyKind::Imported(own) => match own.mesh.counterface {
                Counterface::Cylinder { radius, .. } => [radius; 2],
                Counterface::Plane { .. } => return None,
            },
            BodyKind::Assembly(_) => return None,
        })
    }

    /// The length that curvatures of the contact are compared with, m: the radius of a cylinder that turns in the body,
    /// else half the body's largest extent.
    pub fn contact_length(&self) -> f64 {
        match (self.grid(), self.imported().map(|own| &own.mesh.counterface)) {
            (Some(grid), _) => grid.inner_radius,
            (_, Some(Counterface::Cylinder { radius, is_inside: true, .. })) => *radius,
            _ => self.size(),
        }
    }

    /// The mesh of the body, of one in three dimensions that of its section across the axis.
    pub fn mesh(&self) -> Result<Arc<Mesh>, MeshError> {
        let generate = |grid: &AnnulusSpecification| Ok(AnnulusMesh::generate(grid)?.mesh);
        match &self.kind {
            BodyKind::Annulus(annulus) => generate(annulus).map(Arc::new),
            BodyKind::Revolution(solid) => {
                let regions = solid.region_names();
                generate(&solid.plane()).map(|mesh| Arc::new(Mesh { regions, ..mesh }))
            }
            BodyKind::Imported(imported) => Ok(Arc::clone(&imported.mesh)),
            BodyKind::Assembly(assembly) => Ok(Arc::clone(&assembly.mesh)),
        }
    }

    /// The mesh of a body from a mesh file, which is whole.
    pub(super) fn whole_mesh(&self) -> Option<&Arc<Mesh>> {
        match &self.kind {
            BodyKind::Imported(imported) => Some(&imported.mesh),
            BodyKind::Assembly(assembly) => Some(&assembly.mesh),
            BodyKind::Annulus(_) | BodyKind::Revolution(_) => None,
        }
    }

    /// The tables over frequency that moduli follow, region by region.
    pub fn tables(&self) -> impl Iterator<Item = &ModulusTable> {
        self.materials.iter().filter_map(|material| material.table.as_deref())
    }

    /// Whether a material or the springs of a support have structural damping.
    pub(super) fn has_structural_damping(&self) -> bool {
        self.has_lossy_supports() || self.has_lossy_materials()
    }

    /// Whether a material has a loss factor or a table.
    pub(super) fn has_lossy_materials(&self) -> bool {
        let is_lossy = |m: &RegionMaterial| m.table.is_some() || m.elastic.loss_factor != 0.0;
        self.materials.iter().any(is_lossy)
    }

    /// Whether the springs of a support have structural damping.
    pub(super) fn has_lossy_supports(&self) -> bool {
        let bore = |own: &AnnulusSpecification| own.shaft.map(|shaft| shaft.bore);
        let edges = self.annulus().into_iter().flat_map(|own| [Some(own.outer), bore(own)]);
        let faces = self.revolution().map_or(&[][..], |own| &own.conditions).iter().copied();
        let boundaries = self.whole_mesh().into_iter().flat_map(|mesh| &mesh.boundaries);
        let mut all = edges.flatten().chain(faces).chain(boundaries.map(|own| own.condition));
        all.any(|own| matches!(own, BoundaryCondition::Support(own) if own.loss_factor != 0.0))
    }

    /// Number of a node, counted from 0, as the user knows it: that of the mesh file, or counted from 1.
    pub fn node_label(&self, node: usize) -> usize {
        self.whole_mesh().map_or(node + 1, |mesh| mesh.node_label(node))
    }
}

/// Nodes of a mesh, in a width that no input overflows.
pub(super) fn node_count(annulus: &AnnulusSpecification) -> u128 {
    let around = annulus.circumferential_elements as u128;
    annulus.nodes_per_sector().saturating_mul(around)
}

/// Nodes of a body of revolution, in a width that no input overflows.
pub(super) fn solid_node_count(solid: &SolidSpecification) -> u128 {
    let annulus = &solid.annulus;
    let (radial, layers) = (annulus.radial_elements as u128, solid.axial_elements as u128);
    let corners = (radial + 1).saturating_mul(layers + 1);
    let between = corners + radial * (layers + 1) + (radial + 1) * layers;
    let per_sector = corners + if annulus.element.is_quadratic() { between } else { 0 };
    per_sector.saturating_mul(annulus.circumferential_elements as u128)
}
