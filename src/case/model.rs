//! The sections that describe the model: geometry, mesh, material, damping, contact.

use super::reader::Section;
use crate::contact::{ContactStiffness, SlidingContact};
use crate::fem::{ElasticMaterial, RayleighDamping};
use crate::mesh::{AnnulusSpecification, ElementKind};
use std::f64::consts::TAU;

/// `[damping]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// Rayleigh's coefficients.
    pub rayleigh: RayleighDamping,
    /// Whether `beta_R` multiplies the whole tangent, contact and friction terms included, or the
    /// body's stiffness alone.
    pub include_contact: bool,
}

/// `[contact]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The rotating cylinder and its friction law.
    pub sliding: SlidingContact,
    /// Linearised contact of the eigenvalue analysis.
    pub stiffness: ContactStiffness,
}

/// Nodes of a mesh, in a width that no input overflows.
pub(super) fn node_count(annulus: &AnnulusSpecification) -> u128 {
    let radial = annulus.radial_elements as u128;
    let per_sector = match annulus.element {
        ElementKind::Quad4 => radial + 1,
        ElementKind::Quad8 => 3 * radial + 2,
    };
    per_sector.saturating_mul(annulus.circumferential_elements as u128)
}

pub(super) fn annulus(root: &Section<'_>) -> (AnnulusSpecification, f64) {
    let geometry = root.section("geometry", true);
    let inner_radius = geometry.number("inner_radius");
    let outer_radius = geometry.number("outer_radius");
    let thickness = geometry.number("thickness");
    if outer_radius <= inner_radius {
        geometry.reject(
            "outer_radius",
            format!(
                "geometry.outer_radius = {outer_radius} must be above \
                 geometry.inner_radius = {inner_radius}"
            ),
            format!("must be above {inner_radius}"),
            Some("both are radii in metres; are they swapped?".to_owned()),
        );
    }
    geometry.close();
    let mesh = root.section("mesh", true);
    let annulus = AnnulusSpecification {
        inner_radius,
        outer_radius,
        circumferential_elements: mesh.count("circumferential_elements"),
        radial_elements: mesh.count("radial_elements"),
        radial_grading: mesh.number("radial_grading"),
        element: mesh.choice("element"),
    };
    check_mesh(&mesh, &annulus);
    mesh.close();
    (annulus, thickness)
}

fn check_mesh(mesh: &Section<'_>, annulus: &AnnulusSpecification) {
    // Node indices are 32 bits wide, with room for two unknowns at each node.
    let (nodes, limit) = (node_count(annulus), u128::from(u32::MAX / 2));
    if nodes > limit {
        mesh.reject(
            "circumferential_elements",
            format!("the mesh would have {nodes} nodes, above the limit of {limit}"),
            "too many elements".to_owned(),
            Some("lower mesh.circumferential_elements or mesh.radial_elements".to_owned()),
        );
    }
    // Sizes that differ by more than this leave elements without width in double precision.
    let ratio = annulus.radial_grading.ln() * (annulus.radial_elements as f64 - 1.0);
    if ratio.abs() > 1e6f64.ln() {
        mesh.reject(
            "radial_grading",
            format!(
                "mesh.radial_grading = {} makes the largest element {:.1e} times the smallest",
                annulus.radial_grading,
                ratio.abs().exp()
            ),
            "at most a factor 1e6 over all elements".to_owned(),
            Some("bring mesh.radial_grading nearer to 1".to_owned()),
        );
    }
}

pub(super) fn material(root: &Section<'_>) -> ElasticMaterial {
    let section = root.section("material", true);
    let material = ElasticMaterial {
        young_modulus: section.number("young_modulus"),
        poisson_ratio: section.number("poisson_ratio"),
        density: section.number("density"),
        formulation: section.choice("formulation"),
    };
    section.close();
    material
}

pub(super) fn damping(root: &Section<'_>) -> Damping {
    let section = root.section("damping", false);
    let damping = Damping {
        rayleigh: RayleighDamping {
            mass_coefficient: section.number("mass_coefficient"),
            stiffness_coefficient: section.number("stiffness_coefficient"),
        },
        include_contact: section.flag("include_contact"),
    };
    section.close();
    damping
}

pub(super) fn contact(root: &Section<'_>) -> Contact {
    let section = root.section("contact", true);
    let contact = Contact {
        sliding: SlidingContact {
            friction_coefficient: section.number("friction_coefficient"),
            interference: section.number("interference"),
            rotation_speed: section.number("rotation_speed_rpm") * TAU / 60.0,
        },
        stiffness: ContactStiffness {
            normal_stiffness: section.optional_number("normal_stiffness"),
            normal_damping: section.number("normal_damping"),
            tangential_damping: section.number("tangential_damping"),
        },
    };
    let stiffness = &contact.stiffness;
    let is_rigid = !section.has("normal_stiffness") || section.is_text("normal_stiffness", "rigid");
    if is_rigid && stiffness.normal_damping > 0.0 {
        section.reject(
            "normal_damping",
            format!(
                "contact.normal_damping = {} has no effect on a rigid contact",
                stiffness.normal_damping
            ),
            "needs contact.normal_stiffness".to_owned(),
            Some("give contact.normal_stiffness, or leave normal_damping out".to_owned()),
        );
    }
    section.close();
    contact
}
