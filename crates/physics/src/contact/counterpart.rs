//! What a surface slides on: another one, a rigid counterface, or what the mesh of a plane body has before its edge.

use super::{PairError, SlidingContact};
use crate::mesh::{Boundary, Chord, Mesh};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// What a surface slides on.
#[derive(Clone, Debug, PartialEq)]
pub enum Counterpart {
    /// Another boundary of the mesh, by its index.
    Surface(usize),
    /// A rigid surface.
    Rigid(RigidCounterface),
    /// Of the contact edge of a plane body: the counterface of its mesh, or the edge of the other body there.
    Edge(SlidingContact),
}

impl Counterpart {
    /// The boundary of the mesh, unless it is a rigid counterface.
    pub fn surface(&self) -> Option<usize> {
        match self {
            Self::Surface(boundary) => Some(*boundary),
            Self::Rigid(_) | Self::Edge(_) => None,
        }
    }

    /// The rigid counterface, if it is one.
    pub fn rigid(&self) -> Option<&RigidCounterface> {
        match self {
            Self::Rigid(rigid) => Some(rigid),
            Self::Surface(_) | Self::Edge(_) => None,
        }
    }

    /// How far it is pushed into the body, m; surfaces of solid bodies are pressed by loads alone.
    pub fn interference(&self) -> f64 {
        match self {
            Self::Surface(_) => 0.0,
            Self::Rigid(rigid) => rigid.interference,
            Self::Edge(contact) => contact.interference,
        }
    }
}

/// A rigid surface that moves along itself and is pushed into a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidCounterface {
    /// Its shape.
    pub shape: RigidShape,
    /// A point of the axis of a cylinder and of its turning, or the centre of a sphere, m.
    pub center: [f64; 3],
    /// Unit vector along that axis, right-handed.
    pub axis: [f64; 3],
    /// How it moves.
    pub motion: RigidMotion,
    /// How far it is pushed into the body along its normal, m.
    pub interference: f64,
}

/// Shape of a rigid counterface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigidShape {
    /// A plane across the mean normal of the contact surface, which touches it where it stands out farthest.
    Plane,
    /// A cylinder inside the contact surface or around it, of a radius (m) or that of the surface.
    Cylinder(Option<f64>),
    /// A sphere inside the contact surface or around it, of a radius (m) or that of the surface.
    Sphere(Option<f64>),
}

/// Motion of a rigid counterface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigidMotion {
    /// About its axis at `Omega`, rad/s.
    Turning(f64),
    /// Along a straight line at a velocity, m/s.
    Sliding([f64; 3]),
}

impl RigidMotion {
    /// `Omega` (rad/s), or the speed along a straight line (m/s).
    pub fn speed(&self) -> f64 {
        match self {
            Self::Turning(speed) => *speed,
            Self::Sliding(velocity) => Vector3::from(*velocity).norm(),
        }
    }
}

/// Deviation of the contact surface from a circle or sphere, of its radius, that counts as round.
const ROUND: f64 = 1e-3;

/// Sine of the angle between a straight motion and a plane above which it leaves the plane.
const ALONG: f64 = 1e-3;

/// A rigid counterface that lies against a contact surface.
pub(super) struct PlacedCounterface<'a> {
    own: &'a RigidCounterface,
    /// Distance of each node of the surface from it, m.
    heights: BTreeMap<u32, f64>,
    /// Unit normal of a plane into the body.
    inward: Vector3<f64>,
    /// Whether a cylinder or sphere lies inside the surface: +1, or around it: -1.
    sense: f64,
}

impl RigidCounterface {
    /// Velocity of its points, m/s.
    pub fn velocity(&self, position: [f64; 3]) -> [f64; 3] {
        match self.motion {
            RigidMotion::Sliding(velocity) => velocity,
            RigidMotion::Turning(speed) => {
                let arm = Vector3::from(position) - Vector3::from(self.center);
                (Vector3::from(self.axis).cross(&arm) * speed).into()
            }
        }
    }

    /// Its rotation, rad/s.
    pub(super) fn spin(&self) -> Vector3<f64> {
        match self.motion {
            RigidMotion::Sliding(_) => Vector3::zeros(),
            RigidMotion::Turning(speed) => Vector3::from(self.axis) * speed,
        }
    }

    /// Its unit normal into the body at a point of the contact surface whose own normal is `mean`.
    pub(super) fn normal(&self, position: [f64; 3], mean: [f64; 3]) -> [f64; 3] {
        let mean = Vector3::from(mean);
        match self.shape {
            RigidShape::Plane => mean.into(),
            RigidShape::Cylinder(_) | RigidShape::Sphere(_) => {
                let radial = self.arm(&position.into()).normalize();
                (radial * radial.dot(&mean).signum()).into()
            }
        }
    }

    /// Rate at which its unit normal `n` into the body turns towards `a` as the point moves along `b`, 1/m; both lie in its surface.
    pub(super) fn curvature(
        &self,
        at: [f64; 3],
        n: Vector3<f64>,
        [a, b]: [Vector3<f64>; 2],
    ) -> f64 {
        let (arm, axis) = (self.arm(&at.into()), Vector3::from(self.axis));
        let along = match self.shape {
            RigidShape::Plane => return 0.0,
            RigidShape::Cylinder(_) => a.dot(&b) - a.dot(&axis) * b.dot(&axis),
            RigidShape::Sphere(_) => a.dot(&b),
        };
        arm.dot(&n).signum() * along / arm.norm()
    }

    /// Lays it against `surface`.
    pub(super) fn placed(
        &self,
        mesh: &Mesh,
        surface: &Boundary,
    ) -> Result<PlacedCounterface<'_>, PairError> {
        // Middle of each face and its outward normal times its area.
        let faces = surface.faces.iter();
        let outward = faces.map(|face| (mesh.middle(face.corners()), mesh.area_vector(face)));
        let outward: Vec<(Vector3<f64>, Vector3<f64>)> = outward.collect();
        let nodes: BTreeSet<u32> =
            surface.faces.iter().flat_map(|face| &face.nodes).copied().collect();
        let (own, heights, inward) = (self, BTreeMap::new(), Vector3::zeros());
        let mut placed = PlacedCounterface { own, heights, inward, sense: 1.0 };
        let position = |node: u32| Vector3::from(mesh.nodes[node as usize]);
        let radius = match self.shape {
            RigidShape::Plane => {
                let sum: Vector3<f64> = outward.iter().map(|(_, normal)| normal).sum();
                let whole: f64 = outward.iter().map(|(_, normal)| normal.norm()).sum();
                if !(sum.norm() > ALONG * whole) {
                    let name = &surface.name;
                    let text =
                        format!("surface \"{name}\" has faces all around: name those on the plane");
                    return Err(PairError(text));
                }
                placed.inward = -sum.normalize();
                self.check_along(&placed.inward, surface)?;
                let height = |node: u32| position(node).dot(&placed.inward);
                let lowest = nodes.iter().map(|&node| height(node)).fold(f64::INFINITY, f64::min);
                placed.heights = nodes.iter().map(|&node| (node, height(node) - lowest)).collect();
                return Ok(placed);
            }
            RigidShape::Cylinder(radius) | RigidShape::Sphere(radius) => radius,
        };
        // Of a round one the side on which the body lies, and each node's distance from the axis or centre.
        let facing = outward.iter().map(|(at, normal)| self.arm(at).dot(normal));
        placed.sense = if facing.sum::<f64>() < 0.0 { 1.0 } else { -1.0 };
        let radial = |point: [f64; 3]| self.arm(&point.into()).normalize();
        let chords = mesh.chords(&surface.faces, radial);
        let radii = nodes.iter().map(|&node| (node, self.arm(&position(node)).norm()));
        let mut radii: BTreeMap<u32, f64> = radii.collect();
        Chord::bridge(&chords, &mut radii);
        // A radius that is not given is the one that all nodes have.
        let radius = match radius {
            Some(radius) => radius,
            None => self.common_radius(mesh, surface, &radii)?,
        };
        let heights = radii.into_iter().map(|(node, own)| (node, placed.sense * (own - radius)));
        placed.heights = heights.collect();
        Ok(placed)
    }

    /// How far the surface stands inside it before it is pushed in, m; `None` where it does not fit.
    pub fn overlap(&self, mesh: &Mesh, surface: &Boundary) -> Option<f64> {
        let heights = self.placed(mesh, surface).ok()?.heights.into_values();
        heights.map(|height| -height).reduce(f64::max)
    }

    /// From the axis or the centre to a point, m.
    fn arm(&self, position: &Vector3<f64>) -> Vector3<f64> {
        let arm = position - Vector3::from(self.center);
        let axis = Vector3::from(self.axis);
        match self.shape {
            RigidShape::Sphere(_) => arm,
            RigidShape::Cylinder(_) | RigidShape::Plane => arm - axis * axis.dot(&arm),
        }
    }

    /// The mean distance of the nodes of a surface from the axis or the centre, which all have.
    fn common_radius(
        &self,
        mesh: &Mesh,
        surface: &Boundary,
        radii: &BTreeMap<u32, f64>,
    ) -> Result<f64, PairError> {
        let mean = radii.values().sum::<f64>() / radii.len() as f64;
        let off = |&(_, radius): &(&u32, &f64)| (radius - mean).abs();
        let farthest = radii.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
        let outlier = farthest.filter(|own| off(own) > ROUND * mean);
        let Some((&node, distance)) = outlier else { return Ok(mean) };
        Err(PairError(format!(
            "surface \"{}\" is not round about the axis or centre of its counterface: node {} lies {distance:.6e} m away, the \
             mean is {mean:.6e} m. Correct `center` and `axis`, or give its `radius`",
            surface.name, mesh.labels[node as usize]
        )))
    }

    /// Refuses a motion that takes a plane out of itself.
    fn check_along(&self, normal: &Vector3<f64>, surface: &Boundary) -> Result<(), PairError> {
        let (off, whole) = match self.motion {
            RigidMotion::Sliding(velocity) => {
                let velocity = Vector3::from(velocity);
                (velocity.dot(normal).abs(), velocity.norm())
            }
            // A plane turns within itself about its normal alone.
            RigidMotion::Turning(_) => (Vector3::from(self.axis).cross(normal).norm(), 1.0),
        };
        if off <= ALONG * whole {
            return Ok(());
        }
        let [x, y, z]: [f64; 3] = normal.map(|x| x + 0.0).into(); // Without the signs of zeros.
        let [fault, remedy] = match self.motion {
            RigidMotion::Turning(_) => ["tilt", "give that normal as `axis`"],
            RigidMotion::Sliding(_) => ["move along it", "correct `direction`"],
        };
        Err(PairError(format!(
            "the rigid plane under surface \"{}\" has the normal ({x:.6}, {y:.6}, {z:.6}) and would {fault}: {remedy}",
            surface.name
        )))
    }
}

impl PlacedCounterface<'_> {
    /// Unit normal into the body at a point.
    pub fn normal(&self, position: &Vector3<f64>) -> Vector3<f64> {
        match self.own.shape {
            RigidShape::Plane => self.inward,
            RigidShape::Cylinder(_) | RigidShape::Sphere(_) => {
                self.own.arm(position).normalize() * self.sense
            }
        }
    }

    /// Distance of a point of the surface with these shares of its nodes, m.
    pub fn gap(&self, shares: &[(u32, f64)]) -> f64 {
        let parts = shares.iter().map(|(node, share)| self.heights[node] * share);
        parts.sum()
    }
}
