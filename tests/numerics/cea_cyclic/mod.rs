//! The cyclic eigenvalue analysis against theory, dense solutions, the sparse solver and the paper.

pub mod dense;
mod sensitivity;
mod stability;
mod whole_mesh;

use crate::prelude::*;

/// The paper's disc on so many elements around and across.
pub fn paper(element: ElementKind, around: usize, across: usize) -> AnnulusModel {
    let springs = ContactStiffness { normal_stiffness: Some(7.4e12), ..RIGID };
    WaveModel {
        specification: annulus(element, around, across),
        material: POLYCARBONATE,
        options: TangentOptions { geometric_stiffness: true, contact: springs, ..TANGENT },
        contact: contact(610.0),
    }
}
