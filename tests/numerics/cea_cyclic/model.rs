//! Models of the paper's disc.

use crate::prelude::*;

pub fn paper_options() -> TangentOptions {
    TangentOptions {
        geometric_stiffness: true,
        contact: ContactStiffness { normal_stiffness: Some(7.4e12), ..RIGID },
        ..TANGENT
    }
}

/// The disc on so many elements around and across.
pub fn paper(element: ElementKind, around: usize, across: usize) -> AnnulusModel {
    WaveModel {
        specification: annulus(element, around, across),
        material: POLYCARBONATE,
        options: paper_options(),
        contact: contact(610.0),
    }
}
