//! A deformable shaft in the annulus: `geometry.shaft_inner_radius`, `mesh.shaft_radial_elements`, `[materials.shaft]`,
//! `[boundaries.bore]`.

use super::boundaries::NamedCondition;
use super::imported;
use super::reader::Section;
use super::tables::TableFiles;
use super::{Case, CaseErrors};
use super::{refusal, refuse};
use crate::fem::{ElasticMaterial, TabledMaterial};
use crate::mesh::{BoundaryCondition, ShaftSpecification};

/// The shaft, if the case has one, and its material.
pub(super) fn shaft(
    root: &Section<'_>,
    [geometry, mesh]: [&Section<'_>; 2],
    contact_radius: f64,
    boundaries: &[NamedCondition],
    material: &ElasticMaterial,
    tables: &mut TableFiles<'_>,
) -> Option<(ShaftSpecification, TabledMaterial)> {
    let bore = geometry.optional_number("shaft_inner_radius");
    let elements = mesh.optional_count("shaft_radial_elements");
    let found = materials(root, material, bore.is_some(), tables);
    let Some(bore) = bore else {
        if elements.is_some() {
            refuse!(mesh, "shaft_radial_elements",
                "mesh.shaft_radial_elements is for a deformable shaft, and the case has none";
                "the cylinder is rigid";
                "give geometry.shaft_inner_radius and [materials.shaft], or leave it out");
        }
        return None;
    };
    if bore >= contact_radius {
        refuse!(geometry, "shaft_inner_radius",
            "geometry.shaft_inner_radius = {bore} must be below geometry.inner_radius = \
             {contact_radius}: the shaft reaches from its bore to the contact";
            "must be below {contact_radius}");
    }
    if found.is_none() {
        refuse!(geometry, "shaft_inner_radius",
            "the shaft of geometry.shaft_inner_radius has no material"; "needs [materials.shaft]";
            "add [materials.shaft] with young_modulus, poisson_ratio and density, or leave \
             shaft_inner_radius out for a rigid cylinder");
    }
    let shaft = ShaftSpecification {
        inner_radius: bore,
        radial_elements: elements.unwrap_or_else(|| mesh.count("shaft_radial_elements")),
        bore: bore_condition(root, boundaries),
    };
    found.map(|material| (shaft, material))
}

/// `[materials.shaft]`; the annulus has no other surfaces.
fn materials(
    root: &Section<'_>,
    material: &ElasticMaterial,
    has_shaft: bool,
    tables: &mut TableFiles<'_>,
) -> Option<TabledMaterial> {
    let all = root.section("materials", false);
    for (name, _) in all.remaining() {
        let (message, help) = match (name, has_shaft) {
            ("shaft", true) => continue,
            ("shaft", false) => (
                "[materials.shaft] is for a deformable shaft, and the case has none".to_owned(),
                "give geometry.shaft_inner_radius and mesh.shaft_radial_elements, or leave the section out",
            ),
            _ => (
                format!("[materials.{name}] is for a physical surface of a mesh file (mesh.file)"),
                "describe the disc in [material] and a shaft in [materials.shaft]",
            ),
        };
        let label = "the annulus has one material".to_owned();
        all.reject(name, message, label, Some(help.to_owned()));
    }
    let read = imported::materials(root, material, tables);
    let mut shafts = read.into_iter().filter(|(name, _)| name == "shaft");
    shafts.next().map(|(_, material)| material)
}

fn bore_condition(root: &Section<'_>, boundaries: &[NamedCondition]) -> BoundaryCondition {
    let given = boundaries.iter().find(|(name, _)| name == "bore");
    match given.map(|(_, condition)| *condition) {
        None => BoundaryCondition::Clamped,
        Some(condition @ BoundaryCondition::Clamped) => condition,
        Some(condition @ BoundaryCondition::Support(support))
            if support.tangential_stiffness > 0.0 =>
        {
            condition
        }
        Some(_) => {
            root.section("boundaries", false).reject(
                "bore",
                "nothing holds the shaft against the friction that turns it",
                "must hold the bore tangentially",
                "use condition = \"clamped\", or \"support\" with tangential_stiffness above 0",
            );
            BoundaryCondition::Clamped
        }
    }
}

impl Case {
    /// An analysis that a deformable shaft has no part in.
    pub(super) fn require_rigid_shaft(&self, what: &str) -> Result<(), CaseErrors> {
        let grid = self.body.grid();
        if grid.is_none_or(|grid| grid.shaft.is_none()) {
            return Ok(());
        }
        let key = "geometry.shaft_inner_radius";
        Err(refusal!(self, key,
            "{what} takes the cylinder as rigid, and {key} gives a deformable shaft";
            "not with a deformable shaft"; "leave {key} out"))
    }
}
