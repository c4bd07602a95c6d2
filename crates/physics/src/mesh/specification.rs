//! Specification of an annulus, and the errors of one that makes no mesh.

use super::{BoundaryCondition, ElementKind};

/// What the annulus generator needs to know (lengths in m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnnulusSpecification {
    /// Inner radius `a`, m.
    pub inner_radius: f64,
    /// Outer radius `b`, m.
    pub outer_radius: f64,
    /// Elements around the circumference, `N_theta`.
    pub circumferential_elements: usize,
    /// Elements along a radius, `N_r`.
    pub radial_elements: usize,
    /// Size ratio of successive elements outwards; 1 for a uniform mesh.
    pub radial_grading: f64,
    /// Element shape, a quadrilateral.
    pub element: ElementKind,
    /// What holds the outer edge, usually [`BoundaryCondition::Clamped`].
    pub outer: BoundaryCondition,
    /// The deformable shaft inside; `None` is a rigid cylinder.
    pub shaft: Option<ShaftSpecification>,
}

/// A deformable shaft, hollow, from its bore to the inner edge of the annulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaftSpecification {
    /// Radius of the bore, m.
    pub inner_radius: f64,
    /// Elements along a radius, of equal size.
    pub radial_elements: usize,
    /// What holds the bore, usually [`BoundaryCondition::Clamped`].
    pub bore: BoundaryCondition,
}

/// A mesh that cannot be built from its specification.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The radii do not describe an annulus.
    #[error(
        "inner radius {inner} m and outer radius {outer} m do not describe an annulus: \
         geometry.inner_radius must be positive and below geometry.outer_radius"
    )]
    Radii {
        /// Inner radius, m.
        inner: f64,
        /// Outer radius, m.
        outer: f64,
    },
    /// Too few elements.
    #[error("{count} elements in mesh.{key}: at least {minimum} are needed")]
    TooFewElements {
        /// Case key without its section.
        key: &'static str,
        /// Given count.
        count: usize,
        /// Smallest valid count.
        minimum: usize,
    },
    /// A ring that no element of its face lies under.
    #[error(
        "{count} elements in mesh.radial_elements: none of them lies under the ring alone, and the \
         contact would have no area. With these radii of the ring at least {minimum} are needed"
    )]
    NothingUnderRing {
        /// Given count.
        count: usize,
        /// Smallest count with an element under the ring.
        minimum: usize,
    },
    /// The node count does not fit 32-bit node indices.
    #[error(
        "the mesh would have {nodes} nodes, more than {limit}: lower mesh.circumferential_elements or mesh.radial_elements"
    )]
    TooManyNodes {
        /// Nodes asked for.
        nodes: u128,
        /// Largest count.
        limit: u32,
    },
    /// Elements that are no quadrilaterals.
    #[error(
        "an annulus is meshed with quadrilaterals: mesh.element must be \"quad4\" or \"quad8\""
    )]
    Triangles,
    /// An outer edge that leaves the disc free to turn with the cylinder.
    #[error(
        "nothing holds the disc against the friction that turns it: boundaries.outer needs condition = \"clamped\", \
         or \"support\" with a tangential_stiffness"
    )]
    NotHeld,
    /// A shaft without material between its bore and its outer edge.
    #[error(
        "the shaft's bore of {bore} m must be positive and smaller than geometry.inner_radius = {radius} m: \
         correct geometry.shaft_inner_radius"
    )]
    Bore {
        /// Radius of the bore, m.
        bore: f64,
        /// Radius of the contact, m.
        radius: f64,
    },
    /// A bore that leaves the shaft free to turn with the disc.
    #[error(
        "nothing holds the shaft against the friction that turns it: boundaries.bore needs condition = \"clamped\", \
         or \"support\" with a tangential_stiffness"
    )]
    ShaftNotHeld,
    /// The grading is not a positive finite ratio.
    #[error("mesh.radial_grading = {value} must be a positive number (1 = uniform)")]
    Grading {
        /// Given ratio.
        value: f64,
    },
}

impl AnnulusSpecification {
    /// Nodes of one sector, in a width that no input overflows.
    pub fn nodes_per_sector(&self) -> u128 {
        let of = |radial: usize| {
            let radial = radial as u128;
            if self.element.is_quadratic() { 3 * radial + 2 } else { radial + 1 }
        };
        let shaft = self.shaft.map_or(0, |shaft| of(shaft.radial_elements));
        of(self.radial_elements) + shaft
    }

    /// Elements of one sector.
    pub fn elements_per_sector(&self) -> usize {
        self.radial_elements.saturating_add(self.shaft.map_or(0, |shaft| shaft.radial_elements))
    }
}

/// Refuses what makes no mesh.
pub(super) fn validate(spec: &AnnulusSpecification) -> Result<(), MeshError> {
    let (inner, outer) = (spec.inner_radius, spec.outer_radius);
    if !(inner > 0.0 && outer > inner && outer.is_finite()) {
        return Err(MeshError::Radii { inner, outer });
    }
    for (key, count, minimum) in [
        ("circumferential_elements", spec.circumferential_elements, 3),
        ("radial_elements", spec.radial_elements, 1),
    ] {
        if count < minimum {
            return Err(MeshError::TooFewElements { key, count, minimum });
        }
    }
    if spec.element.corner_count() != 4 {
        return Err(MeshError::Triangles);
    }
    if !spec.outer.holds_turning() {
        return Err(MeshError::NotHeld);
    }
    if let Some(shaft) = spec.shaft {
        validate_shaft(spec, &shaft)?;
    }
    if !(spec.radial_grading > 0.0 && spec.radial_grading.is_finite()) {
        return Err(MeshError::Grading { value: spec.radial_grading });
    }
    let nodes = spec.nodes_per_sector().saturating_mul(spec.circumferential_elements as u128);
    if nodes > u128::from(u32::MAX / 2) {
        return Err(MeshError::TooManyNodes { nodes, limit: u32::MAX / 2 });
    }
    Ok(())
}

fn validate_shaft(
    spec: &AnnulusSpecification,
    shaft: &ShaftSpecification,
) -> Result<(), MeshError> {
    let (bore, radius) = (shaft.inner_radius, spec.inner_radius);
    if !(bore > 0.0 && bore < radius) {
        return Err(MeshError::Bore { bore, radius });
    }
    if shaft.radial_elements < 1 {
        let (key, count) = ("shaft_radial_elements", shaft.radial_elements);
        return Err(MeshError::TooFewElements { key, count, minimum: 1 });
    }
    if shaft.bore.holds_turning() { Ok(()) } else { Err(MeshError::ShaftNotHeld) }
}
