//! The annulus and its shaft, sector by sector: nodes, elements and edges.

use super::revolution::{SheetElement, SheetNode, elements_between, revolved};
use super::{AnnulusSpecification, Boundary, BoundaryCondition, Counterface, ElementKind, Mesh};
use std::f64::consts::PI;

/// The sheet of a sector: the shaft along a radius, if there is one, then the annulus.
pub(super) struct AnnulusSheet {
    pub nodes: Vec<SheetNode>,
    pub elements: Vec<SheetElement>,
    /// First node of the annulus.
    pub first: usize,
}

impl AnnulusSheet {
    pub fn of(spec: &AnnulusSpecification) -> Self {
        let mut own = Self { nodes: Vec::new(), elements: Vec::new(), first: 0 };
        if let Some(shaft) = spec.shaft {
            let (count, width) = (shaft.radial_elements, spec.inner_radius - shaft.inner_radius);
            let radius = |i: usize| shaft.inner_radius + width * (i as f64 / count as f64);
            let mut radii: Vec<f64> = (0..=count).map(radius).collect();
            radii[count] = spec.inner_radius;
            own.add(&radii, spec.element, 1);
            own.first = own.nodes.len();
        }
        own.add(&graded_radii(spec), spec.element, 0);
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
    match i % 2 {
        0 => radii[i / 2],
        _ => 0.5 * (radii[i / 2] + radii[i / 2 + 1]),
    }
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
pub(super) fn build(spec: &AnnulusSpecification, sheet: &AnnulusSheet, built: usize) -> Mesh {
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
