//! Blocks of solid elements of every kind, as a mesh file holds them.

use frictionsim::mesh::{ElementKind, FileElement, FileMesh};
use std::collections::BTreeMap;

pub const SOLIDS: [ElementKind; 8] = [
    ElementKind::Tet4,
    ElementKind::Tet10,
    ElementKind::Hex8,
    ElementKind::Hex20,
    ElementKind::Wedge6,
    ElementKind::Wedge15,
    ElementKind::Pyramid5,
    ElementKind::Pyramid13,
];

/// Corners of the linear elements that make up a cell whose corners are numbered as those of a brick, its middle being 8.
fn parts(kind: ElementKind) -> &'static [&'static [usize]] {
    match kind {
        ElementKind::Hex8 | ElementKind::Hex20 => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
        ElementKind::Wedge6 | ElementKind::Wedge15 => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
        ElementKind::Pyramid5 | ElementKind::Pyramid13 => &[
            &[0, 1, 2, 3, 8],
            &[4, 7, 6, 5, 8],
            &[0, 4, 5, 1, 8],
            &[1, 5, 6, 2, 8],
            &[2, 6, 7, 3, 8],
            &[3, 7, 4, 0, 8],
        ],
        // Six tetrahedra about the diagonal from corner 0 to corner 6: neighbouring cells match.
        _ => &[
            &[0, 1, 2, 6],
            &[0, 2, 3, 6],
            &[0, 3, 7, 6],
            &[0, 7, 4, 6],
            &[0, 4, 5, 6],
            &[0, 5, 1, 6],
        ],
    }
}

/// A block of cells on the unit cube, each cut into elements of a kind, taken to its shape by `map`; sides `x0`, `x1`, `y0`, `y1`,
/// `z0` and `z1` are physical surfaces, `body` is the region. Mid-side nodes are mapped too: edges follow the map.
pub fn block(kind: ElementKind, cells: [usize; 3], map: impl Fn([f64; 3]) -> [f64; 3]) -> FileMesh {
    let mut places: Vec<[f64; 3]> = Vec::new();
    for k in 0..=cells[2] {
        for j in 0..=cells[1] {
            for i in 0..=cells[0] {
                let at = [i, j, k];
                places.push([0, 1, 2].map(|axis| at[axis] as f64 / cells[axis] as f64));
            }
        }
    }
    let corner =
        |i: usize, j: usize, k: usize| (i + (cells[0] + 1) * (j + (cells[1] + 1) * k)) as u32;
    let mut file = FileMesh { dimension: 3, ..FileMesh::default() };
    let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for (i, j, k) in (0..cells[2])
        .flat_map(|k| (0..cells[1]).flat_map(move |j| (0..cells[0]).map(move |i| (i, j, k))))
    {
        let mut around = vec![
            corner(i, j, k),
            corner(i + 1, j, k),
            corner(i + 1, j + 1, k),
            corner(i, j + 1, k),
            corner(i, j, k + 1),
            corner(i + 1, j, k + 1),
            corner(i + 1, j + 1, k + 1),
            corner(i, j + 1, k + 1),
        ];
        if kind.corner_count() == 5 {
            let ends = [around[0], around[6]].map(|node| places[node as usize]);
            around.push(places.len() as u32);
            places.push([0, 1, 2].map(|axis| 0.5 * (ends[0][axis] + ends[1][axis])));
        }
        for part in parts(kind) {
            let mut nodes: Vec<u32> = part.iter().map(|&local| around[local]).collect();
            let corners = nodes.clone();
            for &[start, end] in kind.edges().iter().filter(|_| kind.is_quadratic()) {
                let (p, q) = (corners[start], corners[end]);
                nodes.push(*middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    let [a, b] = [p, q].map(|node| places[node as usize]);
                    places.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
                    (places.len() - 1) as u32
                }));
            }
            for (face, locals) in kind.faces() {
                let face_nodes: Vec<u32> = locals.iter().map(|&local| nodes[local]).collect();
                for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                    for (side, end) in [0.0, 1.0].into_iter().enumerate() {
                        let lies = |&node: &u32| places[node as usize][axis] == end;
                        if face_nodes.iter().all(lies) {
                            let faces = file.surfaces.entry(format!("{letter}{side}"));
                            faces.or_default().push((*face, face_nodes.clone()));
                        }
                    }
                }
            }
            file.elements.push(FileElement {
                label: file.elements.len() + 1,
                kind,
                region: "body".into(),
                entity: 1,
                nodes,
            });
        }
    }
    file.labels = (1..=places.len()).collect();
    file.is_used = vec![true; places.len()];
    file.points = places.into_iter().map(map).collect();
    file
}
