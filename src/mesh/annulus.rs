//! The structured annulus mesh.

use super::{Boundary, BoundaryCondition, Counterface, ElementKind, Mesh2d};
use std::f64::consts::{PI, TAU};

/// Name of the inner edge, where the contact is.
const INNER: &str = "inner";

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
    /// The grading is not a positive finite ratio.
    #[error("mesh.radial_grading = {value} must be a positive number (1 = uniform)")]
    Grading {
        /// Given ratio.
        value: f64,
    },
}

/// A structured annulus mesh with its sectors.
///
/// Nodes are numbered radially fastest: corner node `(i, j)` of a Quad4 mesh, `i = 0..=N_r`,
/// `j = 0..N_theta`, has index `j (N_r + 1) + i`. A Quad8 sector holds `2 N_r + 1` nodes on its
/// corner ray (corner and mid-side nodes alternate), then the `N_r + 1` mid-side nodes on its
/// middle ray.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnulusMesh {
    /// The generated mesh.
    pub mesh: Mesh2d,
    /// What it was generated from.
    pub specification: AnnulusSpecification,
    /// Radii of the corner nodes along a ray, `N_r + 1` values, m.
    pub radii: Vec<f64>,
}

impl AnnulusMesh {
    /// Generates the mesh.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn generate(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        let spec = *specification;
        validate(&spec)?;
        let radii = graded_radii(&spec);
        let mesh = build(&spec, &radii, spec.circumferential_elements);
        Ok(Self {
            mesh,
            specification: spec,
            radii,
        })
    }

    /// Nodes of one sector (one element wide in the circumferential direction).
    pub fn sector_node_count(&self) -> usize {
        sector_node_count(&self.specification)
    }

    /// Number of sectors, `N_theta`.
    pub fn sector_count(&self) -> usize {
        self.specification.circumferential_elements
    }
}

pub(super) fn sector_node_count(spec: &AnnulusSpecification) -> usize {
    if spec.element.is_quadratic() {
        3 * spec.radial_elements + 2
    } else {
        spec.radial_elements + 1
    }
}

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
            return Err(MeshError::TooFewElements {
                key,
                count,
                minimum,
            });
        }
    }
    if spec.element.corner_count() != 4 {
        return Err(MeshError::Triangles);
    }
    let is_held = match spec.outer {
        BoundaryCondition::Clamped => true,
        BoundaryCondition::Support(support) => support.tangential_stiffness > 0.0,
        _ => false,
    };
    if !is_held {
        return Err(MeshError::NotHeld);
    }
    if !(spec.radial_grading > 0.0 && spec.radial_grading.is_finite()) {
        return Err(MeshError::Grading {
            value: spec.radial_grading,
        });
    }
    let radial = spec.radial_elements as u128;
    let per_sector = if spec.element.is_quadratic() {
        3 * radial + 2
    } else {
        radial + 1
    };
    let nodes = per_sector.saturating_mul(spec.circumferential_elements as u128);
    if nodes > u128::from(u32::MAX / 2) {
        return Err(MeshError::TooManyNodes {
            nodes,
            limit: u32::MAX / 2,
        });
    }
    Ok(())
}

/// Radii of the corner nodes: element sizes form a geometric sequence of ratio `radial_grading`.
pub(super) fn graded_radii(spec: &AnnulusSpecification) -> Vec<f64> {
    let count = spec.radial_elements;
    let width = spec.outer_radius - spec.inner_radius;
    let ratio = spec.radial_grading;
    let mut radii: Vec<f64> = (0..=count)
        .map(|i| {
            let fraction = if ratio == 1.0 {
                i as f64 / count as f64
            } else {
                // expm1 keeps ratios near 1 exact: (q^i - 1) / (q^n - 1).
                let log = ratio.ln();
                (i as f64 * log).exp_m1() / (count as f64 * log).exp_m1()
            };
            spec.inner_radius + width * fraction
        })
        .collect();
    radii[count] = spec.outer_radius;
    radii
}

/// The first `built` sectors: all of them, or one with the corner ray that it shares with the next.
pub(super) fn build(spec: &AnnulusSpecification, radii: &[f64], built: usize) -> Mesh2d {
    let sectors = spec.circumferential_elements;
    let per_sector = sector_node_count(spec);
    let node_sectors = if built < sectors { built + 1 } else { sectors };
    let node_total = node_sectors * per_sector;
    let mut nodes = Vec::with_capacity(node_total);
    let mut frame_angles = Vec::with_capacity(node_total);
    let mut push = |radius: f64, angle: f64| {
        nodes.push([radius * angle.cos(), radius * angle.sin()]);
        frame_angles.push(angle);
    };
    for sector in 0..node_sectors {
        let angle = TAU * sector as f64 / sectors as f64;
        if spec.element.is_quadratic() {
            push(radii[0], angle);
            for pair in radii.windows(2) {
                push(0.5 * (pair[0] + pair[1]), angle);
                push(pair[1], angle);
            }
            let middle = TAU * (sector as f64 + 0.5) / sectors as f64;
            radii.iter().for_each(|&r| push(r, middle));
        } else {
            radii.iter().for_each(|&r| push(r, angle));
        }
    }
    let (elements, congruent_to) = connect(spec, built);
    let count = congruent_to.len();
    let mut boundaries = [false, true].map(|outer| edge(spec, radii, outer, built));
    for boundary in &mut boundaries {
        let inward = if boundary.name == INNER { PI } else { 0.0 };
        let nodes = boundary.nodes.iter();
        boundary.normal_angles = nodes
            .map(|&node| frame_angles[node as usize] + inward)
            .collect();
    }
    let per_element = spec.element.node_count();
    Mesh2d {
        nodes,
        frame_angles,
        element_kinds: vec![spec.element; count],
        element_starts: (0..=count).map(|e| (per_element * e) as u32).collect(),
        elements,
        congruent_to,
        regions: vec!["disc".to_owned()],
        element_regions: vec![0; count],
        labels: Vec::new(),
        boundaries: boundaries.into(),
        contact: 0,
        counterface: Counterface::Cylinder {
            center: [0.0; 2],
            radius: radii[0],
            is_inside: true,
        },
        is_cyclic: true,
    }
}

/// Element connectivity, and for each element its representative in sector 0.
fn connect(spec: &AnnulusSpecification, built: usize) -> (Vec<u32>, Vec<u32>) {
    let (sectors, count) = (spec.circumferential_elements, spec.radial_elements);
    let per_sector = sector_node_count(spec);
    let mut elements = Vec::with_capacity(built * count * spec.element.node_count());
    let mut congruent_to = Vec::with_capacity(built * count);
    for sector in 0..built {
        let here = sector * per_sector;
        let next = (sector + 1) % sectors * per_sector;
        for i in 0..count {
            let ids = if spec.element.is_quadratic() {
                let middle = here + 2 * count + 1;
                vec![
                    here + 2 * i,
                    here + 2 * i + 2,
                    next + 2 * i + 2,
                    next + 2 * i,
                    here + 2 * i + 1,
                    middle + i + 1,
                    next + 2 * i + 1,
                    middle + i,
                ]
            } else {
                vec![here + i, here + i + 1, next + i + 1, next + i]
            };
            elements.extend(ids.into_iter().map(|id| id as u32));
            congruent_to.push(i as u32);
        }
    }
    (elements, congruent_to)
}

/// Nodes along the inner or outer circle with `∫ N_i (n . e_r,i) ds` of the element edges.
///
/// With `h` half a sector's angle: a straight edge gives `a sin h cos h` to each end; a quadratic edge
/// through three points of the circle gives `(a / 3) sin h (2 - cos h)` to each end and
/// `(4 a / 3) sin h` to its middle.
fn edge(spec: &AnnulusSpecification, radii: &[f64], outer: bool, built: usize) -> Boundary {
    let (sectors, count) = (spec.circumferential_elements, spec.radial_elements);
    let per_sector = sector_node_count(spec);
    let radius = if outer { radii[count] } else { radii[0] };
    let (sin, cos) = (PI / sectors as f64).sin_cos();
    let (name, condition) = if outer {
        ("outer", spec.outer)
    } else {
        (INNER, BoundaryCondition::Free)
    };
    let mut boundary = Boundary {
        name: name.to_owned(),
        is_closed: built == sectors,
        condition,
        ..Boundary::default()
    };
    let mut push = |node: usize, length: f64| {
        boundary.nodes.push(node as u32);
        boundary.tributary_lengths.push(length);
    };
    for sector in 0..built {
        let here = sector * per_sector;
        if spec.element.is_quadratic() {
            let corner = here + if outer { 2 * count } else { 0 };
            push(corner, 2.0 / 3.0 * radius * sin * (2.0 - cos));
            let middle = here + 2 * count + 1 + if outer { count } else { 0 };
            push(middle, 4.0 / 3.0 * radius * sin);
        } else {
            let corner = here + if outer { count } else { 0 };
            push(corner, 2.0 * radius * sin * cos);
        }
    }
    boundary
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper(element: ElementKind) -> AnnulusSpecification {
        AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 180,
            radial_elements: 35,
            radial_grading: 1.0,
            element,
            outer: BoundaryCondition::Clamped,
        }
    }

    #[test]
    fn node_1621_lies_at_ninety_degrees_and_1641_on_its_ray() {
        let mesh = AnnulusMesh::generate(&paper(ElementKind::Quad4)).unwrap();
        let [x, y] = mesh.mesh.nodes[1620];
        assert!(x.abs() < 1e-15 && (y - 0.0205).abs() < 1e-15);
        let [x, y] = mesh.mesh.nodes[1640];
        assert!(x.abs() < 1e-15 && (y - 0.0605).abs() < 1e-15);
        assert_eq!(mesh.mesh.element_count(), 6300);
    }

    #[test]
    fn tributary_lengths_sum_to_the_circumference_with_the_mesh() {
        for (element, tolerance) in [(ElementKind::Quad4, 1e-3), (ElementKind::Quad8, 1e-8)] {
            let mesh = AnnulusMesh::generate(&paper(element)).unwrap().mesh;
            let sum: f64 = mesh.contact_edge().tributary_lengths.iter().sum();
            let exact = TAU * 0.0205;
            assert!((sum / exact - 1.0).abs() < tolerance, "{sum} {exact}");
        }
    }

    #[test]
    fn graded_elements_grow_by_the_given_ratio() {
        let spec = AnnulusSpecification {
            radial_grading: 1.1,
            ..paper(ElementKind::Quad4)
        };
        let radii = AnnulusMesh::generate(&spec).unwrap().radii;
        for triple in radii.windows(3) {
            let ratio = (triple[2] - triple[1]) / (triple[1] - triple[0]);
            assert!((ratio - 1.1).abs() < 1e-10);
        }
    }

    #[test]
    fn impossible_specifications_name_their_key() {
        let message =
            |spec: &AnnulusSpecification| AnnulusMesh::generate(spec).unwrap_err().to_string();
        let mut spec = paper(ElementKind::Quad4);
        spec.outer_radius = 0.01;
        assert!(message(&spec).contains("outer_radius"));
        let mut spec = paper(ElementKind::Quad4);
        spec.radial_elements = 0;
        assert!(message(&spec).contains("radial_elements"));
    }
}
