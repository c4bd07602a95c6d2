//! Elements of the faces of a body of revolution.

use super::super::FaceKind;
use super::{SolidContact, SolidFace, SolidSector};

/// Parent coordinates of the nodes of a face element: across the sector, then along the face.
const PLACES: [[isize; 2]; 8] =
    [[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]];

/// One element's part of a face, in sector 0.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceElement {
    /// The face.
    pub face: SolidFace,
    /// Sector nodes with their angle in halves of a sector.
    pub nodes: Vec<(usize, usize)>,
}

/// Gauss points `(place, weight)` of a face element: 2 x 2, or 3 x 3 for 8 nodes.
pub fn face_quadrature(is_quadratic: bool) -> impl Iterator<Item = ([f64; 2], f64)> {
    let kind = if is_quadratic { FaceKind::Quad8 } else { FaceKind::Quad4 };
    let points = kind.quadrature().into_iter();
    points.map(|([x, y, _], weight)| ([x, y], weight))
}

/// Shape functions of a face element, bilinear or serendipity.
pub fn face_shapes(is_quadratic: bool, [x, y]: [f64; 2]) -> Vec<f64> {
    let count = if is_quadratic { 8 } else { 4 };
    let places = PLACES[..count].iter();
    places
        .map(|&[a, b]| {
            let (p, q) = (a as f64, b as f64);
            let factor = |sign: f64, at: f64| {
                if sign == 0.0 { 1.0 - at * at } else { 1.0 + sign * at }
            };
            let product = factor(p, x) * factor(q, y);
            match (is_quadratic, a == 0 || b == 0) {
                (false, _) => 0.25 * product,
                (true, true) => 0.5 * product,
                (true, false) => 0.25 * product * (p * x + q * y - 1.0),
            }
        })
        .collect()
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
        (face_shapes(sector.is_quadratic(), at), measure)
    }

    /// Radius at a point of the parent element, m.
    pub fn radius_at(&self, sector: &SolidSector, at: [f64; 2]) -> f64 {
        let [from, to] = [0, 2].map(|corner| sector.nodes[self.nodes[corner].0].radius);
        0.5 * ((1.0 - at[1]) * from + (1.0 + at[1]) * to)
    }
}

impl SolidSector {
    /// The elements of a face.
    pub fn face_elements(&self, face: SolidFace) -> Vec<FaceElement> {
        let [nr, nz] = self.divisions();
        let count = if face.normal_component() == 0 { nz } else { nr };
        let places = &PLACES[..if self.is_quadratic() { 8 } else { 4 }];
        let find = |place: [usize; 2], half: usize| {
            let is_here =
                |node: &super::SheetNode| node.place == place && node.half_step == half % 2;
            self.nodes.iter().position(is_here).unwrap_or(0)
        };
        (0..count)
            .map(|k| {
                let node = |&[a, b]: &[isize; 2]| {
                    let along = (2 * k + 1).wrapping_add_signed(b);
                    let half = 1usize.wrapping_add_signed(a);
                    let place = match face {
                        SolidFace::Inner => [0, along],
                        SolidFace::Outer => [2 * nr, along],
                        SolidFace::Top => [along, 2 * nz],
                        SolidFace::Bottom => [along, 0],
                    };
                    (find(place, half), half)
                };
                FaceElement { face, nodes: places.iter().map(node).collect() }
            })
            .collect()
    }

    /// The elements of the face that the rotor touches.
    pub fn contact_elements(&self) -> Vec<FaceElement> {
        let contact = self.specification.contact;
        let mut elements = self.face_elements(contact.face());
        if let SolidContact::Ring { inner_radius, outer_radius } = contact {
            let slack = 1e-9 * self.specification.annulus.outer_radius;
            elements.retain(|element| {
                let [from, to] = [0, 2].map(|corner| self.nodes[element.nodes[corner].0].radius);
                from >= inner_radius - slack && to <= outer_radius + slack
            });
        }
        elements
    }
}
