//! Faces of two surfaces that face each other, cut into the segments that both have.

use super::polygon::{clipped, signed_area, without_straight_corners};
use super::{PairError, RigidCounterface, Row, row_along};
use crate::mesh::{Boundary, BoundaryFace, Grid, Mesh};
use nalgebra::{Matrix2, Vector2, Vector3};

/// A point at which one surface faces another: of a segment, or a node with the mean of what lies around it.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where it is on the own surface, m.
    pub position: [f64; 3],
    /// Unit normal into the own body.
    pub normal: [f64; 3],
    /// Area that belongs to it, m2.
    pub area: f64,
    /// Distance from the counter surface along the normal, m; negative where they overlap.
    pub gap: f64,
    /// Nodes of the own surface with the coefficients of their displacements: shape functions on a segment.
    pub own: Vec<(u32, f64)>,
    /// Nodes of the counter surface with theirs.
    pub counter: Vec<(u32, f64)>,
    /// The same with their slopes by arc on the own surface, 1/m.
    pub slopes: Vec<(u32, Vector3<f64>)>,
}

/// A quadrature point of a segment.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentPoint {
    /// Face of the own surface that it lies on.
    pub face: usize,
    /// The point.
    pub at: SurfacePoint,
}

impl SurfacePoint {
    /// `direction . (u_own - u_counter)`, over all dofs.
    pub fn jump(&self, mesh: &Mesh, direction: [f64; 3]) -> Row {
        let mut row = row_along(mesh, &self.own, direction, 1.0);
        row.extend(row_along(mesh, &self.counter, direction, -1.0));
        row
    }
}

/// Two surfaces of a solid mesh that face each other.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePair {
    /// Quadrature points of the segments.
    pub points: Vec<SegmentPoint>,
    /// Area of the own surface, and how much of it has the counter surface before it, m2.
    pub area: f64,
    /// The covered part of it, m2.
    pub covered: f64,
    /// Distance beyond which faces do not meet, m.
    pub reach: f64,
}

/// Degree-4 rule of the triangle (Dunavant 1985): area coordinates and shares of the area.
const RULE: [([f64; 3], f64); 6] = {
    const A: f64 = 0.445_948_490_915_965;
    const B: f64 = 0.091_576_213_509_771;
    const V: f64 = 0.223_381_589_678_011;
    const W: f64 = 0.109_951_743_655_322;
    [
        ([A, A, 1.0 - 2.0 * A], V),
        ([A, 1.0 - 2.0 * A, A], V),
        ([1.0 - 2.0 * A, A, A], V),
        ([B, B, 1.0 - 2.0 * B], W),
        ([B, 1.0 - 2.0 * B, B], W),
        ([1.0 - 2.0 * B, B, B], W),
    ]
};

/// Share of a face's area below which a segment is round-off.
const SLIVER: f64 = 1e-9;

/// Cosine of the angle between normals beyond which faces count as facing each other.
const FACING: f64 = -0.2;

/// A face with what searching it needs.
struct Facet<'a> {
    face: &'a BoundaryFace,
    points: Vec<Vector3<f64>>,
    center: Vector3<f64>,
    /// Unit outward normal of its corners' mean plane.
    normal: Vector3<f64>,
    area: f64,
    radius: f64,
}

/// A point of a facet.
struct FacetPoint {
    /// Shape functions and their slopes by place on the face.
    shapes: Vec<(f64, [f64; 3])>,
    position: Vector3<f64>,
    tangents: [Vector3<f64>; 2],
}

impl FacetPoint {
    /// Unit outward normal.
    fn normal(&self) -> Vector3<f64> {
        self.tangents[0].cross(&self.tangents[1]).normalize()
    }

    fn values(&self) -> Vec<f64> {
        self.shapes.iter().map(|shape| shape.0).collect()
    }

    /// Slopes of the shape functions by arc across `normal`, along which the face is seen, 1/m.
    fn slopes(&self, normal: &Vector3<f64>) -> Vec<Vector3<f64>> {
        let [a, b] = &self.tangents;
        let [across_a, across_b] = [b.cross(normal), normal.cross(a)];
        let dual = [across_a / across_a.dot(a), across_b / across_b.dot(b)];
        self.shapes.iter().map(|(_, slopes)| dual[0] * slopes[0] + dual[1] * slopes[1]).collect()
    }
}

impl<'a> Facet<'a> {
    fn of(mesh: &Mesh, face: &'a BoundaryFace) -> Self {
        let points: Vec<Vector3<f64>> =
            face.nodes.iter().map(|&node| Vector3::from(mesh.nodes[node as usize])).collect();
        let corners = &points[..face.kind.corner_count()];
        let count = corners.len();
        let center = corners.iter().sum::<Vector3<f64>>() / count as f64;
        let fan = (0..count).map(|i| {
            let [a, b] = [corners[i] - center, corners[(i + 1) % count] - center];
            a.cross(&b)
        });
        let twice = fan.sum::<Vector3<f64>>();
        let distances = points.iter().map(|point| (point - center).norm());
        Self {
            center,
            normal: twice.normalize(),
            area: 0.5 * twice.norm(),
            radius: distances.fold(0.0, f64::max),
            points,
            face,
        }
    }

    fn corners(&self) -> &[Vector3<f64>] {
        &self.points[..self.face.kind.corner_count()]
    }

    /// The point that projects onto `target` in `plane`.
    fn at(&self, plane: &Plane, target: Vector2<f64>) -> FacetPoint {
        let is_triangle = self.face.kind.corner_count() == 3;
        let mut place = if is_triangle { [1.0 / 3.0; 2] } else { [0.0; 2] };
        let mut found = None;
        for _ in 0..NEWTON_STEPS {
            let shapes = self.face.kind.shape_functions([place[0], place[1], 0.0]);
            let mut position = Vector3::zeros();
            let mut tangents = [Vector3::zeros(); 2];
            for ((value, slopes), point) in shapes.iter().zip(&self.points) {
                position += point * *value;
                tangents[0] += point * slopes[0];
                tangents[1] += point * slopes[1];
            }
            let off = target - plane.flat(&position);
            let [a, b] = tangents.map(|tangent| plane.flat_direction(&tangent));
            found = Some(FacetPoint { shapes, position, tangents });
            if off.norm() < 1e-14 * self.radius {
                break;
            }
            let Some(step) = Matrix2::from_columns(&[a, b]).lu().solve(&off) else { break };
            place = [place[0] + step[0], place[1] + step[1]];
        }
        found.expect("there is at least one step")
    }
}

/// The facets of a boundary that has some.
fn facets_of<'a>(mesh: &Mesh, boundary: &'a Boundary) -> Result<Vec<Facet<'a>>, PairError> {
    match boundary.faces.is_empty() {
        true => Err(PairError(format!(
            "surface \"{}\" has no faces on the outside of the bodies",
            boundary.name
        ))),
        false => Ok(boundary.faces.iter().map(|face| Facet::of(mesh, face)).collect()),
    }
}

/// Newton steps that find a point on a face at most; plane faces with straight edges take one or two.
const NEWTON_STEPS: usize = 12;

/// The plane of a face, in which segments are cut.
struct Plane {
    origin: Vector3<f64>,
    axes: [Vector3<f64>; 2],
}

impl Plane {
    fn of(facet: &Facet<'_>) -> Self {
        let edge = facet.points[1] - facet.points[0];
        let first = (edge - facet.normal * edge.dot(&facet.normal)).normalize();
        Self { origin: facet.center, axes: [first, facet.normal.cross(&first)] }
    }

    fn flat(&self, point: &Vector3<f64>) -> Vector2<f64> {
        self.flat_direction(&(point - self.origin))
    }

    fn flat_direction(&self, direction: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(direction.dot(&self.axes[0]), direction.dot(&self.axes[1]))
    }
}

impl SurfacePair {
    /// Cuts the faces of `surface` into segments with those of `counter` before them.
    ///
    /// Each face's corners span a plane; the corners of the faces before it are projected along the plane's normal, the two polygons are
    /// clipped (Sutherland and Hodgman 1974), and the segment has a quadrature rule of degree 4 on each of its triangles (segment to
    /// segment, Puso and Laursen 2004): a constant pressure passes exactly between flat surfaces whatever their meshes. Points on curved
    /// faces are found by Newton's method along the normal. Faces meet within half an element's size.
    ///
    /// # Errors
    /// [`PairError`] where no segment is found.
    pub fn of(mesh: &Mesh, surface: &Boundary, counter: &Boundary) -> Result<Self, PairError> {
        let (own, others) = (facets_of(mesh, surface)?, facets_of(mesh, counter)?);
        let size = |facets: &[Facet<'_>]| {
            let area: f64 = facets.iter().map(|facet| facet.area).sum();
            (area / facets.len() as f64).sqrt()
        };
        let reach = 0.5 * size(&own).max(size(&others));
        let largest = others.iter().map(|facet| facet.radius).fold(0.0, f64::max);
        let spheres = others.iter().map(|facet| (facet.center, facet.radius));
        let grid = Grid::of(2.0 * largest, spheres);
        let mut pair = Self {
            points: Vec::new(),
            area: own.iter().map(|facet| facet.area).sum(),
            covered: 0.0,
            reach,
        };
        for (f, facet) in own.iter().enumerate() {
            let plane = Plane::of(facet);
            for other in grid.near(&facet.center, facet.radius + 2.0 * reach) {
                pair.add_segment((f, facet), &others[other], &plane);
            }
        }
        if pair.points.is_empty() {
            let names = [surface, counter].map(|boundary| boundary.name.as_str());
            return Err(pair.why_not(names, &own, &others));
        }
        Ok(pair)
    }

    /// Why no face has a segment with another: what lies over what, however far.
    fn why_not(&self, [a, b]: [&str; 2], own: &[Facet<'_>], others: &[Facet<'_>]) -> PairError {
        let (mut distance, mut is_turned) = (f64::INFINITY, false);
        for facet in own {
            let plane = Plane::of(facet);
            for other in others {
                if shared_polygon(facet, other, &plane).is_none() {
                    continue;
                }
                let apart = (other.center - facet.center).dot(&facet.normal).abs();
                match facet.normal.dot(&other.normal) > FACING {
                    true => is_turned = true,
                    false => distance = distance.min(apart),
                }
            }
        }
        PairError(match (distance.is_finite(), is_turned) {
            (true, _) => format!(
                "surfaces \"{a}\" and \"{b}\" face each other but stand {distance:.3e} m apart, more than half an element ({:.3e} m). \
                 Move the bodies together in the mesh, or name other surfaces",
                self.reach
            ),
            (false, true) => format!(
                "surface \"{a}\" faces away from \"{b}\": where they lie over each other their outward normals point the same way. \
                 Name the surfaces that touch"
            ),
            (false, false) => format!(
                "surfaces \"{a}\" and \"{b}\" never meet: along its normals no face of the one lies over a face of the other. Name \
                 the surfaces that touch"
            ),
        })
    }

    fn add_segment(&mut self, (f, facet): (usize, &Facet<'_>), other: &Facet<'_>, plane: &Plane) {
        if facet.normal.dot(&other.normal) > FACING {
            return;
        }
        let Some(polygon) = shared_polygon(facet, other, plane) else { return };
        let meet = |target: Vector2<f64>, outward: &Vector3<f64>, at: &mut SurfacePoint| {
            let opposite = other.at(plane, target);
            at.gap = (opposite.position - Vector3::from(at.position)).dot(outward);
            at.counter = nodes_with(other.face, opposite.values());
            at.slopes = nodes_with(other.face, opposite.slopes(outward));
            at.gap.abs() <= self.reach
        };
        let points = quadrature((f, facet), &polygon, plane, meet);
        self.covered += points.iter().map(|point| point.at.area).sum::<f64>();
        self.points.extend(points);
    }

    /// The faces of `surface` with a rigid counterface before all of them.
    ///
    /// # Errors
    /// [`PairError`] where there is no face, or the counterface does not fit the surface.
    pub fn on_rigid(
        mesh: &Mesh,
        surface: &Boundary,
        counterface: &RigidCounterface,
    ) -> Result<Self, PairError> {
        let own = facets_of(mesh, surface)?;
        let placed = counterface.placed(mesh, surface)?;
        let points = own.iter().enumerate().flat_map(|(f, facet)| {
            let plane = Plane::of(facet);
            let polygon: Vec<_> = facet.corners().iter().map(|corner| plane.flat(corner)).collect();
            let meet = |_: Vector2<f64>, _: &Vector3<f64>, at: &mut SurfacePoint| {
                at.normal = placed.normal(&at.position.into()).into();
                at.gap = placed.gap(&at.own);
                true
            };
            quadrature((f, facet), &polygon, &plane, meet)
        });
        let points: Vec<SegmentPoint> = points.collect();
        let area: f64 = own.iter().map(|facet| facet.area).sum();
        Ok(Self {
            covered: points.iter().map(|point| point.at.area).sum(),
            reach: 0.5 * (area / own.len() as f64).sqrt(),
            points,
            area,
        })
    }
}

/// The quadrature points of a convex polygon on a face that have something before them: `meet`, asked with the place in the plane and
/// the outward normal of the face, adds to a point what it meets and says whether that is near enough.
fn quadrature(
    (f, facet): (usize, &Facet<'_>),
    polygon: &[Vector2<f64>],
    plane: &Plane,
    meet: impl Fn(Vector2<f64>, &Vector3<f64>, &mut SurfacePoint) -> bool,
) -> Vec<SegmentPoint> {
    let middle = polygon.iter().sum::<Vector2<f64>>() / polygon.len() as f64;
    let mut points = Vec::new();
    for i in 0..polygon.len() {
        let corners = [middle, polygon[i], polygon[(i + 1) % polygon.len()]];
        let triangle = signed_area(&corners);
        for (shares, weight) in RULE {
            let parts = corners.iter().zip(shares).map(|(corner, share)| corner * share);
            let target = parts.sum::<Vector2<f64>>();
            let own = facet.at(plane, target);
            let outward = own.normal();
            let mut at = SurfacePoint {
                position: own.position.into(),
                normal: (-outward).into(),
                // Area on the surface itself, whose normal leans against the plane's.
                area: weight * triangle / outward.dot(&facet.normal),
                gap: 0.0,
                own: nodes_with(facet.face, own.values()),
                counter: Vec::new(),
                slopes: Vec::new(),
            };
            if meet(target, &outward, &mut at) {
                points.push(SegmentPoint { face: f, at });
            }
        }
    }
    points
}

fn nodes_with<T>(face: &BoundaryFace, values: Vec<T>) -> Vec<(u32, T)> {
    face.nodes.iter().copied().zip(values).collect()
}

/// The part of a face in its plane that another lies over; `None` where there is nothing but round-off.
fn shared_polygon(own: &Facet<'_>, other: &Facet<'_>, plane: &Plane) -> Option<Vec<Vector2<f64>>> {
    let flat = |corners: &[Vector3<f64>]| -> Vec<Vector2<f64>> {
        corners.iter().map(|corner| plane.flat(corner)).collect()
    };
    let mut shadow = flat(other.corners());
    if signed_area(&shadow) < 0.0 {
        shadow.reverse();
    }
    let smallest = SLIVER * own.area.min(other.area);
    let polygon = without_straight_corners(clipped(flat(own.corners()), &shadow), smallest);
    (polygon.len() > 2 && signed_area(&polygon) > smallest).then_some(polygon)
}
