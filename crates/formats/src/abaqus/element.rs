//! Element types of an input file.

use crate::ElementKind;

/// An element type that has a counterpart here.
pub(super) struct ElementType {
    pub kind: ElementKind,
    /// Plane strain (true) or plane stress.
    pub is_plane_strain: Option<bool>,
    /// What is different here from what the name asks for; empty for nothing.
    pub difference: &'static str,
}

/// The counterpart of an element type; none for types that are no solid or plane elements of first or second order.
pub(super) fn element_type(name: &str) -> Option<ElementType> {
    let (dimension, is_plane_strain) = match name.get(..3)? {
        "C3D" => (3, None),
        "CPE" => (2, Some(true)),
        "CPS" => (2, Some(false)),
        _ => return None,
    };
    let mut kinds = ElementKind::ALL.into_iter().filter(|kind| kind.dimension() == dimension);
    kinds.find_map(|kind| {
        let mut own = kind.row().abaqus.iter().filter(|(names, _)| names.contains(&&name[3..]));
        own.next().map(|&(_, difference)| ElementType { kind, is_plane_strain, difference })
    })
}
