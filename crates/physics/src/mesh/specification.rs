//! Specification of an annulus, and why one makes no mesh.

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

/// Why a specification makes no mesh, and what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct MeshError(pub(super) String);

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
        return Err(MeshError(format!(
            "inner radius {inner} m and outer radius {outer} m do not describe an annulus: geometry.inner_radius must be positive and \
             below geometry.outer_radius"
        )));
    }
    at_least(3, spec.circumferential_elements, "circumferential_elements")?;
    at_least(1, spec.radial_elements, "radial_elements")?;
    if spec.element.corner_count() != 4 {
        let problem =
            "an annulus is meshed with quadrilaterals: mesh.element must be \"quad4\" or \"quad8\"";
        return Err(MeshError(problem.to_owned()));
    }
    check_turning(["disc", "outer"], &spec.outer)?;
    if let Some(shaft) = spec.shaft {
        let bore = shaft.inner_radius;
        if !(bore > 0.0 && bore < inner) {
            return Err(MeshError(format!(
                "the shaft's bore of {bore} m must be positive and smaller than geometry.inner_radius = {inner} m: correct \
                 geometry.shaft_inner_radius"
            )));
        }
        at_least(1, shaft.radial_elements, "shaft_radial_elements")?;
        check_turning(["shaft", "bore"], &shaft.bore)?;
    }
    let grading = spec.radial_grading;
    if !(grading > 0.0 && grading.is_finite()) {
        return Err(MeshError(format!(
            "mesh.radial_grading = {grading} must be a positive number (1 = uniform)"
        )));
    }
    // Indices of nodes are 32 bits wide.
    let nodes = spec.nodes_per_sector().saturating_mul(spec.circumferential_elements as u128);
    let limit = u32::MAX / 2;
    if nodes > u128::from(limit) {
        return Err(MeshError(format!(
            "the mesh would have {nodes} nodes, more than {limit}: lower mesh.circumferential_elements or mesh.radial_elements"
        )));
    }
    Ok(())
}

/// Refuses too few elements under a key of the mesh.
pub(super) fn at_least(minimum: usize, count: usize, key: &str) -> Result<(), MeshError> {
    match count < minimum {
        true => {
            Err(MeshError(format!("{count} elements in mesh.{key}: at least {minimum} are needed")))
        }
        false => Ok(()),
    }
}

/// Refuses a boundary that leaves its body free to turn with the friction.
fn check_turning([body, name]: [&str; 2], own: &BoundaryCondition) -> Result<(), MeshError> {
    match own.holds_turning() {
        true => Ok(()),
        false => Err(MeshError(format!(
            "nothing holds the {body} against the friction that turns it: boundaries.{name} needs condition = \"clamped\", or \"support\" \
             with a tangential_stiffness"
        ))),
    }
}
