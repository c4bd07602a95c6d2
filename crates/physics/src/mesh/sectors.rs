//! The sectors of an annulus and its shaft: nodes, elements and edges.

use super::{AnnulusSpecification, Boundary, BoundaryCondition, Counterface, Mesh, NodalFrames};
use std::f64::consts::{PI, TAU};

/// One body along a radius: the shaft or the annulus.
pub(super) struct Ray {
    /// Radii of its corner nodes, m.
    pub radii: Vec<f64>,
    /// First of its nodes within a sector.
    pub start: usize,
    is_quadratic: bool,
}

impl Ray {
    fn element_count(&self) -> usize {
        self.radii.len() - 1
    }

    /// Nodes within a sector.
    pub fn nodes(&self) -> std::ops::Range<usize> {
        let count = self.element_count();
        let nodes = if self.is_quadratic { 3 * count + 2 } else { count + 1 };
        self.start..self.start + nodes
    }

    /// Where the middle ray begins within a sector.
    pub fn middle(&self) -> usize {
        self.start + if self.is_quadratic { 2 * self.element_count() + 1 } else { self.radii.len() }
    }
}

/// The bodies of a sector from the inside out; the annulus is the last.
pub(super) fn rays(spec: &AnnulusSpecification) -> Vec<Ray> {
    let is_quadratic = spec.element.is_quadratic();
    let mut rays = Vec::new();
    if let Some(shaft) = spec.shaft {
        let (count, width) = (shaft.radial_elements, spec.inner_radius - shaft.inner_radius);
        let radius = |i: usize| shaft.inner_radius + width * (i as f64 / count as f64);
        let mut radii: Vec<f64> = (0..=count).map(radius).collect();
        radii[count] = spec.inner_radius;
        rays.push(Ray { radii, start: 0, is_quadratic });
    }
    let start = rays.last().map_or(0, |shaft: &Ray| shaft.nodes().end);
    rays.push(Ray { radii: graded_radii(spec), start, is_quadratic });
    rays
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
pub(super) fn build(spec: &AnnulusSpecification, built: usize) -> Mesh {
    let sectors = spec.circumferential_elements;
    let rays = rays(spec);
    let node_sectors = if built < sectors { built + 1 } else { sectors };
    let node_total = node_sectors * spec.nodes_per_sector() as usize;
    let mut nodes = Vec::with_capacity(node_total);
    let mut frame_angles = Vec::with_capacity(node_total);
    let mut push = |radius: f64, angle: f64| {
        nodes.push([radius * angle.cos(), radius * angle.sin(), 0.0]);
        frame_angles.push(angle);
    };
    for sector in 0..node_sectors {
        let angle = TAU * sector as f64 / sectors as f64;
        for radii in rays.iter().map(|ray| &ray.radii) {
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
    }
    let mut mesh = connect(spec, &rays, built);
    mesh.boundaries = boundaries(spec, &rays, built, &frame_angles);
    mesh.opposite = spec.shaft.map(|_| SHAFT_EDGE);
    mesh.nodes = nodes;
    mesh.frames = NodalFrames::Plane(frame_angles);
    mesh.add_edges_of_boundaries();
    mesh.counterface =
        Counterface::Cylinder { center: [0.0; 2], radius: spec.inner_radius, is_inside: true };
    mesh.is_cyclic = true;
    mesh
}

/// Elements and regions, sector by sector from the inside out; each element's representative is in sector 0.
fn connect(spec: &AnnulusSpecification, rays: &[Ray], built: usize) -> Mesh {
    let sectors = spec.circumferential_elements;
    let per_sector = spec.nodes_per_sector() as usize;
    let regions = vec!["disc".to_owned()];
    let mut mesh = Mesh { dimension: 2, element_starts: vec![0], regions, ..Mesh::default() };
    if spec.shaft.is_some() {
        mesh.regions.push("shaft".to_owned());
    }
    for sector in 0..built {
        let mut representative = 0;
        for (body, ray) in rays.iter().enumerate() {
            let here = sector * per_sector + ray.start;
            let next = (sector + 1) % sectors * per_sector + ray.start;
            // Nodes on a ray: of quadratic elements those at middles of edges are there, but on the middle ray.
            let middle = sector * per_sector + ray.middle();
            let spacing = if spec.element.is_quadratic() { 1 } else { 2 };
            let on_rays = [(here, spacing), (middle, 2), (next, spacing)];
            for i in 0..ray.element_count() {
                // Radially and around, in halves of an element.
                let node = |[a, b, _]: [f64; 3]| {
                    let (start, spacing) = on_rays[1usize.wrapping_add_signed(b as isize)];
                    let place = (2 * i + 1).wrapping_add_signed(a as isize);
                    (start + place / spacing) as u32
                };
                // The annulus, region 0, is the last body.
                let region = usize::from(body + 1 < rays.len());
                let nodes = spec.element.node_places().into_iter().map(node);
                mesh.push_element(spec.element, nodes, (region, representative));
                representative += 1;
            }
        }
    }
    mesh
}

/// Place of the shaft's outer edge among the boundaries.
const SHAFT_EDGE: usize = 2;

/// `inner` and `outer`; of a shaft its edge `shaft` and its `bore`.
fn boundaries(
    spec: &AnnulusSpecification,
    rays: &[Ray],
    built: usize,
    frame_angles: &[f64],
) -> Vec<Boundary> {
    let free = BoundaryCondition::Free;
    let annulus = &rays[rays.len() - 1];
    let mut edges = vec![("inner", annulus, false, free), ("outer", annulus, true, spec.outer)];
    if let Some(shaft) = spec.shaft {
        edges.push(("shaft", &rays[0], true, free));
        edges.push(("bore", &rays[0], false, shaft.bore));
    }
    let edges = edges.into_iter().map(|(name, ray, is_outer, condition)| {
        let (nodes, tributary_lengths): (Vec<u32>, Vec<f64>) =
            edge(spec, ray, is_outer, built).into_iter().unzip();
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

/// Nodes along the inner or outer circle of a body with `∫ N_i (n . e_r,i) ds` of the element edges.
///
/// With `h` half a sector's angle: a straight edge gives `a sin h cos h` to each end; a quadratic edge
/// through three points of the circle gives `(a / 3) sin h (2 - cos h)` to each end and
/// `(4 a / 3) sin h` to its middle.
fn edge(spec: &AnnulusSpecification, ray: &Ray, is_outer: bool, built: usize) -> Vec<(u32, f64)> {
    let count = ray.element_count();
    let radius = ray.radii[if is_outer { count } else { 0 }];
    let (sin, cos) = (PI / spec.circumferential_elements as f64).sin_cos();
    let mut nodes = Vec::new();
    let mut push = |node: usize, length: f64| nodes.push((node as u32, length));
    for sector in 0..built {
        let here = sector * spec.nodes_per_sector() as usize + ray.start;
        if spec.element.is_quadratic() {
            let corner = here + if is_outer { 2 * count } else { 0 };
            push(corner, 2.0 / 3.0 * radius * sin * (2.0 - cos));
            let middle = here + 2 * count + 1 + if is_outer { count } else { 0 };
            push(middle, 4.0 / 3.0 * radius * sin);
        } else {
            let corner = here + if is_outer { count } else { 0 };
            push(corner, 2.0 * radius * sin * cos);
        }
    }
    nodes
}
