//! The structured annulus mesh with its shaft, and one sector of it.

use super::revolution::{SheetElement, SheetNode, Strip, elements_between, revolved};
use super::specification::{AnnulusSpecification, MeshError, validate};
use super::{Boundary, BoundaryCondition, Counterface, ElementKind, Mesh};
use std::f64::consts::PI;

/// A structured annulus mesh with its sectors.
///
/// Nodes are numbered radially fastest: corner node `(i, j)` of a Quad4 mesh, `i = 0..=N_r`, `j = 0..N_theta`, has index `j (N_r + 1) + i`.
/// A Quad8 sector holds `2 N_r + 1` nodes on its corner ray (corner and mid-side nodes alternate), then the `N_r + 1` mid-side nodes on its
/// middle ray. Of a shaft all nodes of a sector come before those of the annulus, numbered alike; the two bodies share no node, nodes of
/// the contact lie in pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnulusMesh {
    /// The generated mesh.
    pub mesh: Mesh,
    /// What it was generated from.
    pub specification: AnnulusSpecification,
}

impl AnnulusMesh {
    /// Generates the mesh.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn generate(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        let spec = *specification;
        validate(&spec)?;
        let mesh = build(&spec, &AnnulusSheet::of(&spec), spec.circumferential_elements);
        Ok(Self { mesh, specification: spec })
    }

    /// Nodes of one sector (one element wide in the circumferential direction).
    pub fn sector_node_count(&self) -> usize {
        self.specification.nodes_per_sector() as usize
    }

    /// Number of sectors, `N_theta`.
    pub fn sector_count(&self) -> usize {
        self.specification.circumferential_elements
    }
}

impl Strip {
    /// Sector 0 of an annulus, without the others: its nodes are those of [`AnnulusMesh`] to the last bit.
    ///
    /// Unknowns are in the order of nodes outwards, at one radius the corner-ray node, then the middle-ray node where there is
    /// one; those of a shaft come before the annulus.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn of_annulus(specification: &AnnulusSpecification) -> Result<Self, MeshError> {
        validate(specification)?;
        let sheet = AnnulusSheet::of(specification);
        let mesh = build(specification, &sheet, 1);
        let outwards = |&node: &usize| {
            let own = &sheet.nodes[node];
            (node >= sheet.first, own.place[0], own.half_step)
        };
        let mut order: Vec<usize> = (0..sheet.nodes.len()).collect();
        order.sort_by_key(outwards);
        let held: Vec<usize> = mesh.held_dofs().collect();
        let count = specification.circumferential_elements;
        Ok(Self::new(mesh, (&sheet.nodes, order), count, |dof| held.contains(&dof)))
    }
}

/// The sheet of a sector: the shaft along a radius, if there is one, then the annulus.
struct AnnulusSheet {
    nodes: Vec<SheetNode>,
    elements: Vec<SheetElement>,
    /// First node of the annulus.
    first: usize,
}

impl AnnulusSheet {
    fn of(spec: &AnnulusSpecification) -> Self {
        let mut own = Self { nodes: Vec::new(), elements: Vec::new(), first: 0 };
        if let Some(shaft) = spec.shaft {
            let radii = [shaft.inner_radius, spec.inner_radius];
            own.add(&graded(radii, shaft.radial_elements, 1.0), spec.element, 1);
            own.first = own.nodes.len();
        }
        own.add(&spec.radii(), spec.element, 0);
        own
    }

    /// Adds a body along a radius with its corner nodes at some radii: those of the corner ray, then those of the middle one.
    fn add(&mut self, radii: &[f64], kind: ElementKind, region: usize) {
        let (count, first) = (radii.len() - 1, self.nodes.len());
        let node = |i: usize, half_step: usize| SheetNode {
            radius: radius_at(radii, i),
            height: 0.0,
            half_step,
            place: [i, 1],
        };
        let is_quadratic = kind.is_quadratic();
        let corner_ray = (0..=2 * count).step_by(if is_quadratic { 1 } else { 2 });
        let middle_ray = (0..=2 * count).step_by(2).filter(|_| is_quadratic);
        let nodes = corner_ray.map(|i| node(i, 0)).chain(middle_ray.map(|i| node(i, 1)));
        let nodes: Vec<SheetNode> = nodes.collect();
        let mut elements = elements_between(&nodes, kind, [count, 1], |_| region);
        elements.iter_mut().flat_map(|own| &mut own.nodes).for_each(|node| node.0 += first);
        self.nodes.extend(nodes);
        self.elements.extend(elements);
    }
}

/// Radius at place `i` in halves of an element, between corner nodes at some radii.
pub(super) fn radius_at(radii: &[f64], i: usize) -> f64 {
    if i.is_multiple_of(2) { radii[i / 2] } else { 0.5 * (radii[i / 2] + radii[i / 2 + 1]) }
}

impl AnnulusSpecification {
    /// Radii of the corner nodes.
    pub(super) fn radii(&self) -> Vec<f64> {
        let ends = [self.inner_radius, self.outer_radius];
        graded(ends, self.radial_elements, self.radial_grading)
    }
}

/// Ends of elements between two radii, whose sizes form a geometric sequence of some ratio.
fn graded([from, to]: [f64; 2], count: usize, ratio: f64) -> Vec<f64> {
    let mut radii: Vec<f64> = (0..=count)
        .map(|i| {
            let fraction = if ratio == 1.0 {
                i as f64 / count as f64
            } else {
                // expm1 keeps ratios near 1 exact: (q^i - 1) / (q^n - 1).
                let log = ratio.ln();
                (i as f64 * log).exp_m1() / (count as f64 * log).exp_m1()
            };
            from + (to - from) * fraction
        })
        .collect();
    radii[count] = to;
    radii
}

/// The first `built` sectors: all of them, or one with the corner ray that it shares with the next.
fn build(spec: &AnnulusSpecification, sheet: &AnnulusSheet, built: usize) -> Mesh {
    let mut mesh = revolved(&sheet.nodes, &sheet.elements, [built, spec.circumferential_elements]);
    let regions = ["disc"].into_iter().chain(spec.shaft.map(|_| "shaft"));
    mesh.regions = regions.map(str::to_owned).collect();
    mesh.boundaries = boundaries(spec, sheet, built, mesh.frame_angles());
    mesh.opposite = spec.shaft.map(|_| SHAFT_EDGE);
    mesh.add_edges_of_boundaries();
    mesh.counterface =
        Counterface::Cylinder { center: [0.0; 2], radius: spec.inner_radius, is_inside: true };
    mesh.is_cyclic = true;
    mesh
}

/// Place of the shaft's outer edge among the boundaries.
const SHAFT_EDGE: usize = 2;

/// `inner` and `outer`; of a shaft its edge `shaft` and its `bore`.
fn boundaries(
    spec: &AnnulusSpecification,
    sheet: &AnnulusSheet,
    built: usize,
    frame_angles: &[f64],
) -> Vec<Boundary> {
    let free = BoundaryCondition::Free;
    let (shaft, annulus) = (0..sheet.first, sheet.first..sheet.nodes.len());
    let mut edges = vec![("inner", &annulus, false, free), ("outer", &annulus, true, spec.outer)];
    if let Some(own) = spec.shaft {
        edges.push(("shaft", &shaft, true, free));
        edges.push(("bore", &shaft, false, own.bore));
    }
    let edges = edges.into_iter().map(|(name, body, is_outer, condition)| {
        let ends = [body.start, body.end - 1].map(|node| sheet.nodes[node].place[0]);
        let end = ends[usize::from(is_outer)];
        let own = body.clone().filter(|&node| sheet.nodes[node].place[0] == end);
        let edge = (0..built).flat_map(|sector| {
            own.clone().map(move |node| {
                let place = (sector * sheet.nodes.len() + node) as u32;
                (place, tributary_length(spec, &sheet.nodes[node]))
            })
        });
        let (nodes, tributary_lengths): (Vec<u32>, Vec<f64>) = edge.unzip();
        let turn = if is_outer { 0.0 } else { PI };
        let angles = nodes.iter().map(|&node| frame_angles[node as usize] + turn);
        Boundary {
            name: name.to_owned(),
            faces: Vec::new(),
            normal_angles: angles.collect(),
            is_closed: built == spec.circumferential_elements,
            nodes,
            tributary_lengths,
            condition,
        }
    });
    edges.collect()
}

/// `∫ N_i (n . e_r,i) ds` of the element edges along a circle at a node.
///
/// With `h` half a sector's angle: a straight edge gives `a sin h cos h` to each end; a quadratic edge through three points of the circle
/// gives `(a / 3) sin h (2 - cos h)` to each end and `(4 a / 3) sin h` to its middle.
fn tributary_length(spec: &AnnulusSpecification, node: &SheetNode) -> f64 {
    let (sin, cos) = (PI / spec.circumferential_elements as f64).sin_cos();
    match (spec.element.is_quadratic(), node.half_step) {
        (true, 0) => 2.0 / 3.0 * node.radius * sin * (2.0 - cos),
        (true, _) => 4.0 / 3.0 * node.radius * sin,
        (false, _) => 2.0 * node.radius * sin * cos,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::ElasticSupport;
    use crate::mesh::{BoundaryCondition, ElementKind, ShaftSpecification};
    use std::f64::consts::TAU;

    fn paper(element: ElementKind) -> AnnulusSpecification {
        AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 180,
            radial_elements: 35,
            radial_grading: 1.0,
            element,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        }
    }

    #[test]
    fn node_1621_lies_at_ninety_degrees_and_1641_on_its_ray() {
        let mesh = AnnulusMesh::generate(&paper(ElementKind::Quad4)).unwrap();
        let [x, y, _] = mesh.mesh.nodes[1620];
        assert!(x.abs() < 1e-15 && (y - 0.0205).abs() < 1e-15);
        let [x, y, _] = mesh.mesh.nodes[1640];
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
        let spec = AnnulusSpecification { radial_grading: 1.1, ..paper(ElementKind::Quad4) };
        let radii = spec.radii();
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

    #[test]
    fn sector_is_the_beginning_of_the_full_mesh_bit_for_bit() {
        for element in [ElementKind::Quad4, ElementKind::Quad8] {
            let specification = AnnulusSpecification {
                inner_radius: 0.0205,
                outer_radius: 0.0905,
                circumferential_elements: 24,
                radial_elements: 5,
                radial_grading: 1.1,
                element,
                outer: BoundaryCondition::Clamped,
                shaft: None,
            };
            let full = AnnulusMesh::generate(&specification).unwrap().mesh;
            let sector = Strip::of_annulus(&specification).unwrap();
            let strip = &sector.mesh;
            assert_eq!(strip.nodes, full.nodes[..strip.node_count()]);
            let entries = strip.elements.len();
            assert_eq!(entries, 5 * element.node_count());
            assert_eq!(strip.elements, full.elements[..entries]);
            let radius = |node: usize| full.nodes[node][0].hypot(full.nodes[node][1]);
            let free: Vec<usize> = sector.free_dofs().map(|dof| dof / 2).collect();
            for pair in free.windows(2) {
                assert!(radius(pair[0]) < radius(pair[1]) + 1e-12);
            }
        }
    }

    #[test]
    fn a_clamped_bore_does_not_widen_the_bands() {
        let width = |bore| {
            let specification = AnnulusSpecification {
                inner_radius: 0.0205,
                outer_radius: 0.0905,
                circumferential_elements: 24,
                radial_elements: 5,
                radial_grading: 1.0,
                element: ElementKind::Quad8,
                outer: BoundaryCondition::Clamped,
                shaft: Some(ShaftSpecification { inner_radius: 0.006, radial_elements: 4, bore }),
            };
            Strip::of_annulus(&specification).unwrap().node_bandwidth()
        };
        let held = ElasticSupport { tangential_stiffness: 1e11, ..ElasticSupport::default() };
        assert_eq!(width(BoundaryCondition::Clamped), width(BoundaryCondition::Support(held)));
    }
}
