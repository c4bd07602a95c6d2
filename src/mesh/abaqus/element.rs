//! Element types of an input file, and the labels of their faces.

use crate::mesh::ElementKind;

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
    let solid = |kind, difference| ElementType {
        kind,
        is_plane_strain: None,
        difference,
    };
    let brick = "integrated with incompatible modes here";
    let full = "fully integrated here";
    Some(match name {
        "C3D4" => solid(ElementKind::Tet4, ""),
        "C3D10" => solid(ElementKind::Tet10, ""),
        "C3D4H" | "C3D10H" | "C3D10HS" | "C3D10M" | "C3D10MH" | "C3D10I" | "C3D10T" => {
            let kind = match name {
                "C3D4H" => ElementKind::Tet4,
                _ => ElementKind::Tet10,
            };
            solid(kind, "by displacements alone here")
        }
        "C3D8" | "C3D8R" | "C3D8H" | "C3D8RH" => solid(ElementKind::Hex8, brick),
        "C3D8I" | "C3D8IH" => solid(ElementKind::Hex8, ""),
        "C3D20" => solid(ElementKind::Hex20, ""),
        "C3D20H" => solid(ElementKind::Hex20, full),
        "C3D20R" => solid(ElementKind::Hex20R, ""),
        "C3D20RH" => solid(ElementKind::Hex20R, "by displacements alone here"),
        "C3D6" => solid(ElementKind::Wedge6, ""),
        "C3D6R" | "C3D6H" => solid(ElementKind::Wedge6, full),
        "C3D15" => solid(ElementKind::Wedge15, ""),
        "C3D15H" => solid(ElementKind::Wedge15, full),
        _ => {
            let is_plane_strain = match name.get(..3)? {
                "CPE" => true,
                "CPS" => false,
                _ => return None,
            };
            let (kind, difference) = match &name[3..] {
                "3" | "3H" => (ElementKind::Tri3, ""),
                "4" => (ElementKind::Quad4, ""),
                "4R" | "4I" | "4H" | "4RH" | "4IH" => (ElementKind::Quad4, full),
                "6" => (ElementKind::Tri6, ""),
                "6M" | "6H" | "6MH" => (ElementKind::Tri6, "by displacements alone here"),
                "8" => (ElementKind::Quad8, ""),
                "8R" | "8H" | "8RH" => (ElementKind::Quad8, full),
                _ => return None,
            };
            ElementType {
                kind,
                is_plane_strain: Some(is_plane_strain),
                difference,
            }
        }
    })
}

const TETRAHEDRON: &[&[usize]] = &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
const BRICK: &[&[usize]] = &[
    &[0, 1, 2, 3],
    &[4, 7, 6, 5],
    &[0, 4, 5, 1],
    &[1, 5, 6, 2],
    &[2, 6, 7, 3],
    &[3, 7, 4, 0],
];
const WEDGE: &[&[usize]] = &[
    &[0, 1, 2],
    &[3, 5, 4],
    &[0, 3, 4, 1],
    &[1, 4, 5, 2],
    &[2, 5, 3, 0],
];
const TRIANGLE: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 0]];
const SQUARE: &[&[usize]] = &[&[0, 1], &[1, 2], &[2, 3], &[3, 0]];

/// Corners of face `S<number>` of an element, counted from 1; none where it has no such face.
pub(super) fn face_corners(kind: ElementKind, number: usize) -> Option<&'static [usize]> {
    let faces = match kind {
        ElementKind::Tet4 | ElementKind::Tet10 => TETRAHEDRON,
        ElementKind::Hex8 | ElementKind::Hex20 | ElementKind::Hex20R => BRICK,
        ElementKind::Wedge6 | ElementKind::Wedge15 => WEDGE,
        ElementKind::Tri3 | ElementKind::Tri6 => TRIANGLE,
        ElementKind::Quad4 | ElementKind::Quad8 => SQUARE,
    };
    faces.get(number.checked_sub(1)?).copied()
}
