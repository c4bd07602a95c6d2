//! Elements of the faces of a body of revolution.

use super::{ElementKind, SheetNode, SolidContact, SolidSector};

/// One element's part of a face, in sector 0.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceElement {
    /// Sector nodes with their angle in halves of a sector.
    pub nodes: Vec<(usize, usize)>,
}

/// Gauss points `(place, weight)` of a face element: 2 x 2, or 3 x 3 for 8 nodes.
pub fn face_quadrature(is_quadratic: bool) -> impl Iterator<Item = ([f64; 2], f64)> {
    kind(is_quadratic).quadrature().into_iter().map(|([x, y, _], weight)| ([x, y], weight))
}

/// Kind of the elements of a face; parent axes lead across the sector, then along the face.
fn kind(is_quadratic: bool) -> ElementKind {
    if is_quadratic { ElementKind::Quad8 } else { ElementKind::Quad4 }
}

impl FaceElement {
    /// Shape functions at a point, and the area that belongs to it, m2. Radius and height vary linearly along the element,
    /// the angle across it.
    pub fn values_at(
        &self,
        sector: &SolidSector,
        (at, weight): ([f64; 2], f64),
    ) -> (Vec<f64>, f64) {
        let [from, to] = [0, 2].map(|corner| &sector.nodes[self.nodes[corner].0]);
        let half = 0.5 * (to.radius - from.radius).hypot(to.height - from.height);
        let measure = weight * half * self.radius_at(sector, at) * sector.half_angle();
        let shapes = kind(sector.is_quadratic()).shape_functions([at[0], at[1], 0.0]).into_iter();
        (shapes.map(|shape| shape.0).collect(), measure)
    }

    /// A point of the plane face that the nodes of a linear element span: its area over that of the
    /// arc, its radius, m, and its angle from the middle of the sector.
    pub fn on_chord(&self, sector: &SolidSector, at: [f64; 2]) -> [f64; 3] {
        let [from, to] = [0, 2].map(|corner| &sector.nodes[self.nodes[corner].0]);
        let (half, [along, up]) =
            (sector.half_angle(), [to.radius - from.radius, to.height - from.height]);
        let area = half.sin() / half * (along * half.cos()).hypot(up) / along.hypot(up);
        let angle = (at[0] * half.tan()).atan();
        [area, self.radius_at(sector, at) * half.cos() / angle.cos(), angle]
    }

    /// Radius at a point of the parent element, m.
    pub fn radius_at(&self, sector: &SolidSector, at: [f64; 2]) -> f64 {
        let [from, to] = [0, 2].map(|corner| sector.nodes[self.nodes[corner].0].radius);
        0.5 * ((1.0 - at[1]) * from + (1.0 + at[1]) * to)
    }
}

impl SolidSector {
    /// The elements of the face that the rotor touches.
    pub fn contact_elements(&self) -> Vec<FaceElement> {
        let contact = self.specification.contact;
        let [radial, axial] = self.specification.divisions();
        let count = if contact == SolidContact::Inner { axial } else { radial };
        let places = self.specification.annulus.element.node_places();
        let element = |k: usize| {
            let node = |&[a, b, _]: &[f64; 3]| {
                let along = (2 * k + 1).wrapping_add_signed(b as isize);
                let half = 1usize.wrapping_add_signed(a as isize);
                let place = match contact {
                    SolidContact::Inner => [0, along],
                    SolidContact::Ring { .. } => [along, 2 * axial],
                };
                let is_here = |own: &SheetNode| own.place == place && own.half_step == half % 2;
                (self.nodes.iter().position(is_here).unwrap_or(0), half)
            };
            FaceElement { nodes: places.iter().map(node).collect() }
        };
        let mut elements: Vec<FaceElement> = (0..count).map(element).collect();
        elements.retain(|element| {
            let mut ends = [0, 2].map(|corner| element.nodes[corner].0).into_iter();
            ends.all(|node| self.specification.touches(self.nodes[node].radius))
        });
        elements
    }
}
