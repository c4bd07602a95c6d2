//! The rigid surface that a body slides on, as geometry.

use std::f64::consts::{FRAC_PI_2, PI};

/// A rigid counterface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Counterface {
    /// A cylinder that turns about its axis.
    Cylinder {
        /// Its axis, m.
        center: [f64; 2],
        /// Its radius, m.
        radius: f64,
        /// Whether it lies in a hole of the body (a shaft) or around the body (a drum).
        is_inside: bool,
    },
    /// A plane that moves along `direction`, the body on its left-hand side.
    Plane {
        /// A point of it, m.
        point: [f64; 2],
        /// Unit vector.
        direction: [f64; 2],
    },
}

impl Default for Counterface {
    fn default() -> Self {
        Self::Cylinder { center: [0.0; 2], radius: 1.0, is_inside: true }
    }
}

impl Counterface {
    /// Angle of the normal into the body at (the foot of) a point, rad: the first axis of a contact node's frame.
    pub fn normal_angle(&self, point: [f64; 2]) -> f64 {
        match *self {
            Self::Cylinder { center, is_inside, .. } => {
                let angle = (point[1] - center[1]).atan2(point[0] - center[0]);
                if is_inside { angle } else { angle + PI }
            }
            Self::Plane { direction, .. } => direction[1].atan2(direction[0]) + FRAC_PI_2,
        }
    }

    /// Distance of a point from the surface, positive where there is a gap, m.
    pub fn gap(&self, point: [f64; 2]) -> f64 {
        match *self {
            Self::Cylinder { center, radius, is_inside } => {
                let distance = (point[0] - center[0]).hypot(point[1] - center[1]);
                if is_inside { distance - radius } else { radius - distance }
            }
            Self::Plane { point: origin, direction: [x, y] } => {
                x * (point[1] - origin[1]) - y * (point[0] - origin[0])
            }
        }
    }

    /// Velocity of the surface along a node's second axis for each unit of its speed: m for a cylinder, whose
    /// speed is `Omega` in rad/s, a pure number for a plane.
    pub fn lever(&self) -> f64 {
        match *self {
            Self::Cylinder { radius, is_inside: true, .. } => radius,
            Self::Cylinder { radius, .. } => -radius,
            // The second axis, a quarter turn ahead of the normal, points against the direction.
            Self::Plane { .. } => -1.0,
        }
    }

    /// Rate at which the normal turns when a node moves along its second axis, 1/m.
    pub fn curvature(&self) -> f64 {
        match self {
            Self::Cylinder { .. } => 1.0 / self.lever(),
            Self::Plane { .. } => 0.0,
        }
    }

    /// Where a point stands along the surface: its angle about a cylinder's axis, rad; for a plane the distance along its direction, m.
    pub fn place(&self, point: [f64; 2]) -> f64 {
        match *self {
            Self::Cylinder { center, .. } => (point[1] - center[1]).atan2(point[0] - center[0]),
            Self::Plane { point: origin, direction: [x, y] } => {
                x * (point[0] - origin[0]) + y * (point[1] - origin[1])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Independent check: the rate of turning of the normal, and the speed of the surface, by differences.
    #[test]
    fn levers_and_curvatures_are_those_of_the_moving_surface() {
        let round =
            |is_inside| Counterface::Cylinder { center: [0.3, -0.2], radius: 0.5, is_inside };
        for counterface in [round(true), round(false)] {
            let at = |angle: f64| [0.3 + 0.5 * angle.cos(), -0.2 + 0.5 * angle.sin()];
            let (angle, small) = (0.7, 1e-6);
            let normal = counterface.normal_angle(at(angle));
            let moved = [at(angle), at(angle + small)];
            let second = [-normal.sin(), normal.cos()];
            let along =
                (moved[1][0] - moved[0][0]) * second[0] + (moved[1][1] - moved[0][1]) * second[1];
            assert!((along / small - counterface.lever()).abs() < 1e-6);
            let turned = counterface.normal_angle(moved[1]) - normal;
            assert!((turned / along - counterface.curvature()).abs() < 1e-5);
            let outside = [at(angle)[0] + 1e-3 * normal.cos(), at(angle)[1] + 1e-3 * normal.sin()];
            assert!((counterface.gap(outside) - 1e-3).abs() < 1e-9);
        }
        let plane = Counterface::Plane { point: [0.0, 1.0], direction: [0.6, 0.8] };
        let normal = plane.normal_angle([0.0; 2]);
        assert!((normal.cos() + 0.8).abs() < 1e-12 && (normal.sin() - 0.6).abs() < 1e-12);
        assert!((plane.gap([-0.8, 1.6]) - 1.0).abs() < 1e-12);
    }
}
