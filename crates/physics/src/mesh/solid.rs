//! One sector of a body of revolution in three dimensions.

use super::annulus::radius_at;
use super::revolution::{SheetElement, SheetNode, Strip, elements_between, revolved};
use super::specification::{at_least, validate};
use super::{
    AnnulusMesh, AnnulusSpecification, Boundary, BoundaryCondition, ElementKind, Mesh, MeshError,
};
use std::collections::BTreeMap;
use std::f64::consts::PI;

mod faces;
mod specification;
mod whole;

pub use faces::{FaceElement, face_quadrature};
pub use specification::{SolidContact, SolidFace, SolidPart, SolidSpecification};

/// Contact nodes of one radius (on a face) or one height (on a cylinder).
#[derive(Clone, Debug, PartialEq)]
pub struct ContactRing {
    /// Sector nodes.
    pub nodes: Vec<usize>,
    /// Radius, m.
    pub radius: f64,
    /// Height, m.
    pub height: f64,
    /// Tributary area of the ring's part of one sector, m2.
    pub area: f64,
}

/// One sector of a body of revolution: a sheet of nodes in the plane `(r, z)`, for quadratic elements a second one
/// with the mid-side nodes half a sector ahead.
///
/// Nodes are numbered along the shorter side first, which makes the matrices of each circumferential harmonic narrow bands.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSector {
    /// What it was generated from.
    pub specification: SolidSpecification,
    /// Its nodes.
    pub nodes: Vec<SheetNode>,
    /// Radii of the corner nodes, m.
    pub radii: Vec<f64>,
    /// Its elements, radial index fastest.
    pub elements: Vec<SheetElement>,
    /// The same as a mesh.
    pub strip: Strip,
    /// The contact, by rising radius or height.
    pub rings: Vec<ContactRing>,
}

impl SolidSector {
    /// Generates the sector.
    ///
    /// Radii of a ring that lie inside the face become radii of corner nodes: the nearest ones move there, the others in proportion.
    ///
    /// # Errors
    /// [`MeshError`] names the key whose value makes no mesh.
    pub fn generate(specification: &SolidSpecification) -> Result<Self, MeshError> {
        let radii = specification.corner_radii()?;
        let nodes = sheet_nodes(specification, &radii);
        let AnnulusSpecification { element, circumferential_elements: count, .. } =
            specification.annulus;
        let kind = if element.is_quadratic() { ElementKind::Hex20 } else { ElementKind::Hex8 };
        let region = |at| specification.region_at(&radii, at);
        let elements = elements_between(&nodes, kind, specification.divisions(), region);
        let order = (0..nodes.len()).collect();
        let mesh = specification.part((&nodes, &elements), 1);
        let is_held = |dof| specification.is_held(&nodes[dof / 3], dof % 3);
        let mut sector = Self {
            strip: Strip::new(mesh, (&nodes, order), count, is_held),
            specification: specification.clone(),
            elements,
            nodes,
            radii,
            rings: Vec::new(),
        };
        sector.rings = sector.contact_rings();
        Ok(sector)
    }

    /// The plane section across the axis, clamped outside: corner nodes at the sector's radii.
    ///
    /// # Errors
    /// [`MeshError`] as in [`Self::generate`].
    pub fn section(&self) -> Result<Mesh, MeshError> {
        let plane = self.specification.plane();
        let annulus = AnnulusSpecification { element: ElementKind::Quad4, ..plane };
        let mut mesh = AnnulusMesh::generate(&annulus)?.mesh;
        for (node, angle) in mesh.frame_angles().to_vec().into_iter().enumerate() {
            let radius = self.radii[node % self.radii.len()];
            mesh.nodes[node] = [radius * angle.cos(), radius * angle.sin(), 0.0];
        }
        Ok(mesh)
    }

    /// The first `count` sectors as a mesh with its faces, closed to a ring where those are all, in polar frames; nodes sector by
    /// sector, of an open one the last sheet behind them.
    pub fn part(&self, count: usize) -> Mesh {
        self.specification.part((&self.nodes, &self.elements), count)
    }

    /// Nodes of one sector.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of sectors, `N_theta`.
    pub fn sector_count(&self) -> usize {
        self.specification.annulus.circumferential_elements
    }

    /// Whether elements have 20 nodes, not 8.
    pub fn is_quadratic(&self) -> bool {
        self.specification.annulus.element.is_quadratic()
    }

    /// Half the angle of a sector, rad.
    pub fn half_angle(&self) -> f64 {
        PI / self.sector_count() as f64
    }

    /// Angle of a node of sector `sector`, rad.
    pub fn angle(&self, node: usize, sector: usize) -> f64 {
        self.nodes[node].angle(sector, self.sector_count())
    }

    /// Whether a node lies on a face.
    pub fn is_on(&self, node: usize, face: SolidFace) -> bool {
        self.specification.is_on(&self.nodes[node], face)
    }

    /// Whether boundary conditions hold a dof `3 node + component` at zero.
    pub fn is_held(&self, dof: usize) -> bool {
        self.strip.is_held[dof]
    }

    fn contact_rings(&self) -> Vec<ContactRing> {
        let face = self.specification.contact.face();
        let areas = self.contact_areas();
        let along = face.across_component() / 2;
        let mut rings: BTreeMap<usize, ContactRing> = BTreeMap::new();
        for (k, node) in self.nodes.iter().enumerate() {
            // Nodes that something else holds along the normal take no part.
            let is_held = self.is_held(3 * k + face.normal_component());
            if is_held || !self.is_on(k, face) || !self.specification.touches(node.radius) {
                continue;
            }
            let &SheetNode { radius, height, place, .. } = node;
            let empty = || ContactRing { nodes: Vec::new(), radius, height, area: 0.0 };
            let ring = rings.entry(place[along]).or_insert_with(empty);
            ring.nodes.push(k);
            ring.area += areas[k];
        }
        rings.into_values().collect()
    }

    /// Integral of each node's shape function over the contact, m2.
    pub(crate) fn contact_areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.node_count()];
        for face in self.contact_elements() {
            for point in face_quadrature(self.is_quadratic()) {
                let (values, measure) = face.values_at(self, point);
                for ((node, _), value) in face.nodes.iter().zip(values) {
                    areas[*node] += value * measure;
                }
            }
        }
        areas
    }
}

impl SolidSpecification {
    /// Elements along a radius and over the thickness.
    pub fn divisions(&self) -> [usize; 2] {
        [self.annulus.radial_elements, self.axial_elements]
    }

    /// Whether a node lies on a face.
    fn is_on(&self, node: &SheetNode, face: SolidFace) -> bool {
        let ([i, j], [nr, nz]) = (node.place, self.divisions());
        match face {
            SolidFace::Inner => i == 0,
            SolidFace::Outer => i == 2 * nr,
            SolidFace::Top => j == 2 * nz,
            SolidFace::Bottom => j == 0,
        }
    }

    /// Whether boundary conditions hold a component of a node at zero.
    fn is_held(&self, node: &SheetNode, component: usize) -> bool {
        let conditions = SolidFace::ALL.iter().zip(&self.conditions);
        conditions.filter(|(face, _)| self.is_on(node, **face)).any(|(face, condition)| {
            match condition {
                BoundaryCondition::Clamped => true,
                BoundaryCondition::Guide => component == face.normal_component(),
                // In every sector alike: across the axis both directions or none.
                BoundaryCondition::Fixed([x, y, z]) => [*x && *y, *x && *y, *z][component],
                _ => false,
            }
        })
    }

    /// Region of the element between two radii of the corner nodes and two heights: 0, or the first part that its middle lies in,
    /// counted from 1.
    fn region_at(&self, radii: &[f64], [i, j]: [usize; 2]) -> usize {
        let radius = 0.5 * (radii[i] + radii[i + 1]);
        let height = self.thickness * (j as f64 + 0.5) / self.axial_elements as f64;
        let lies_in = |range: [f64; 2], at: f64| range[0] < at && at < range[1];
        let mut parts = self.parts.iter();
        let own = parts.position(|p| lies_in(p.radii, radius) && lies_in(p.heights, height));
        own.map_or(0, |part| part + 1)
    }

    /// See [`SolidSector::part`].
    fn part(&self, (nodes, elements): (&[SheetNode], &[SheetElement]), count: usize) -> Mesh {
        let mut mesh = revolved(nodes, elements, [count, self.annulus.circumferential_elements]);
        mesh.regions = self.region_names();
        let outer = mesh.outer_faces();
        let boundaries =
            SolidFace::ALL.into_iter().zip(&self.conditions).map(|(face, condition)| {
                let lies_on = |&node: &u32| self.is_on(&nodes[node as usize % nodes.len()], face);
                let own = outer.iter().filter(|own| own.nodes.iter().all(lies_on));
                let surface = Boundary::of_faces(face.name(), own.cloned().collect());
                Boundary { condition: *condition, ..surface }
            });
        mesh.boundaries = boundaries.collect();
        // Layers of one material are alike, as sectors are.
        let [radial, _] = self.divisions();
        for element in 0..mesh.element_count() {
            let own = element % elements.len();
            let mut layers = (own % radial..own).step_by(radial);
            let alike = layers.find(|own| mesh.region(*own) == mesh.region(element));
            mesh.congruent_to[element] = alike.unwrap_or(own) as u32;
        }
        mesh
    }

    /// Names of the regions.
    pub fn region_names(&self) -> Vec<String> {
        let parts = self.parts.iter().map(|part| part.name.clone());
        std::iter::once("disc".to_owned()).chain(parts).collect()
    }

    /// Whether the rotor touches the face of contact at a radius.
    pub(super) fn touches(&self, radius: f64) -> bool {
        match self.contact {
            SolidContact::Inner => true,
            SolidContact::Ring { inner_radius, outer_radius } => {
                let slack = 1e-9 * self.annulus.outer_radius;
                (inner_radius - slack..=outer_radius + slack).contains(&radius)
            }
        }
    }

    /// The grid of its section across the axis, clamped outside, wherever the body itself is held.
    pub fn plane(&self) -> AnnulusSpecification {
        AnnulusSpecification { outer: BoundaryCondition::Clamped, ..self.annulus }
    }

    /// Radii of the corner nodes, m.
    ///
    /// # Errors
    /// [`MeshError`] as in [`SolidSector::generate`].
    pub fn corner_radii(&self) -> Result<Vec<f64>, MeshError> {
        let annulus = self.plane();
        validate(&annulus)?;
        at_least(1, self.axial_elements, "axial_elements")?;
        let mut radii = annulus.radii();
        if let SolidContact::Ring { inner_radius, outer_radius } = self.contact {
            fit(&mut radii, inner_radius, outer_radius)?;
        }
        Ok(radii)
    }

    /// The corner node of a sector on radius `i` in layer `j` of the corner nodes, without generating it.
    pub fn corner_node(&self, [i, j]: [usize; 2]) -> usize {
        let (nr, nz) = (self.annulus.radial_elements, self.axial_elements);
        let (slow, fast, [p, q]) = if nr >= nz { (nr, nz, [i, j]) } else { (nz, nr, [j, i]) };
        debug_assert!(p <= slow && q <= fast);
        match self.annulus.element.is_quadratic() {
            // A row of corners has two sheets and the middles between them, a row of middles one.
            true => p * (4 * fast + 3) + 3 * q,
            false => p * (fast + 1) + q,
        }
    }
}

/// Moves the corner radii so that both radii of a ring are among them, where they are not.
fn fit(radii: &mut [f64], inner: f64, outer: f64) -> Result<(), MeshError> {
    let last = radii.len() - 1;
    let (low, high) = (radii[0], radii[last]);
    let nearest = |radii: &[f64], wanted: f64| {
        let distance = |i: &usize| (radii[*i] - wanted).abs();
        (0..=last).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    };
    let slack = 1e-9 * high;
    let beside = [inner > low + slack, outer < high - slack];
    let minimum = 1 + beside.into_iter().map(usize::from).sum::<usize>();
    if last < minimum {
        return Err(MeshError(format!(
            "{last} elements in mesh.radial_elements: none of them lies under the ring alone, and the contact would have no area. With \
             these radii of the ring at least {minimum} are needed"
        )));
    }
    let place = |wanted: f64, radii: &[f64]| match wanted {
        w if w <= low + slack => 0,
        w if w >= high - slack => last,
        w => nearest(radii, w).clamp(1, last.max(2) - 1),
    };
    let first = place(inner, radii).min(last - 1 - usize::from(beside[1]));
    let second = place(outer, radii).max(first + 1).min(last);
    let old = radii.to_vec();
    let ends = [
        (0, low),
        (first, if first == 0 { low } else { inner }),
        (second, if second == last { high } else { outer }),
        (last, high),
    ];
    for pair in ends.windows(2) {
        let ((from, a), (to, b)) = (pair[0], pair[1]);
        for i in from..=to {
            let share = if to > from { (old[i] - old[from]) / (old[to] - old[from]) } else { 0.0 };
            radii[i] = a + (b - a) * share;
        }
        radii[to] = b;
    }
    Ok(())
}

/// Nodes in the order of the band.
fn sheet_nodes(specification: &SolidSpecification, radii: &[f64]) -> Vec<SheetNode> {
    let (nr, nz) = (specification.annulus.radial_elements, specification.axial_elements);
    let is_quadratic = specification.annulus.element.is_quadratic();
    let height = |j: usize| specification.thickness * j as f64 / (2 * nz) as f64;
    let mut nodes = Vec::new();
    let (slow, fast) = if nr >= nz { (nr, nz) } else { (nz, nr) };
    for p in 0..=2 * slow {
        for q in 0..=2 * fast {
            let (i, j) = if nr >= nz { (p, q) } else { (q, p) };
            let is_corner = i % 2 == 0 && j % 2 == 0;
            let is_middle = i % 2 == 0 || j % 2 == 0;
            for half_step in 0..2 {
                let exists = match (half_step, is_quadratic) {
                    (0, true) => is_middle,
                    (0, false) | (1, true) => is_corner,
                    _ => false,
                };
                if exists {
                    let (radius, height, place) = (radius_at(radii, i), height(j), [i, j]);
                    nodes.push(SheetNode { radius, height, half_step, place });
                }
            }
        }
    }
    nodes
}
