//! Specification of a body of revolution.

use crate::mesh::{AnnulusSpecification, BoundaryCondition};

/// A face of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidFace {
    /// The cylinder of the inner radius.
    Inner,
    /// The cylinder of the outer radius.
    Outer,
    /// The plane at the height of the thickness.
    Top,
    /// The plane at height zero.
    Bottom,
}

impl SolidFace {
    /// All of them, in the order of [`SolidSpecification::conditions`].
    pub const ALL: [Self; 4] = [Self::Inner, Self::Outer, Self::Top, Self::Bottom];

    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inner => "inner",
            Self::Outer => "outer",
            Self::Top => "top",
            Self::Bottom => "bottom",
        }
    }

    /// Component of the displacement `(u_r, u_theta, u_z)` along its normal.
    pub fn normal_component(self) -> usize {
        match self {
            Self::Inner | Self::Outer => 0,
            Self::Top | Self::Bottom => 2,
        }
    }

    /// Component across both the normal and the direction of sliding `e_theta`.
    pub fn across_component(self) -> usize {
        2 - self.normal_component()
    }

    /// Sign of the normal's component that points into the body.
    pub fn inward_sign(self) -> f64 {
        match self {
            Self::Inner | Self::Bottom => 1.0,
            Self::Outer | Self::Top => -1.0,
        }
    }
}

/// Where the rotor touches a body of revolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolidContact {
    /// A rigid cylinder inside the inner radius.
    Inner,
    /// A rigid flat ring on the top face between two radii, m.
    Ring {
        /// Smaller radius, m.
        inner_radius: f64,
        /// Larger radius, m.
        outer_radius: f64,
    },
}

impl SolidContact {
    /// The face it lies on.
    pub fn face(self) -> SolidFace {
        match self {
            Self::Inner => SolidFace::Inner,
            Self::Ring { .. } => SolidFace::Top,
        }
    }
}

/// A part of a body of revolution that has a material of its own: the elements whose middle lies in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidPart {
    /// Its name.
    pub name: String,
    /// Radii from and to, m.
    pub radii: [f64; 2],
    /// Heights over the bottom face from and to, m.
    pub heights: [f64; 2],
}

/// What the generator of a body of revolution needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidSpecification {
    /// Radii and divisions in the plane; its outer condition is that of [`Self::conditions`].
    pub annulus: AnnulusSpecification,
    /// Thickness, m.
    pub thickness: f64,
    /// Elements over the thickness.
    pub axial_elements: usize,
    /// Where the rotor touches.
    pub contact: SolidContact,
    /// What holds each face, in the order of [`SolidFace::ALL`].
    pub conditions: [BoundaryCondition; 4],
    /// Regions beside that of the rest, which is region 0.
    pub parts: Vec<SolidPart>,
}
