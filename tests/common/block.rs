//! Blocks of solid elements of every kind, as a mesh file holds them.

use super::prelude::*;

pub const SOLIDS: [ElementKind; 8] =
    [Tet4, Tet10, Hex8, Hex20, Wedge6, Wedge15, Pyramid5, Pyramid13];

/// Corners of the linear elements that make up a cell whose corners are numbered as those of a brick, its middle being 8.
fn parts(kind: ElementKind) -> impl Iterator<Item = Vec<usize>> {
    let parts = match kind.corner_count() {
        8 => "01234567",
        6 => "012456 023467",
        5 => "01238 47658 04518 15628 26738 37408",
        // Six tetrahedra about the diagonal from corner 0 to corner 6: neighbouring cells match.
        _ => "0126 0236 0376 0746 0456 0516",
    };
    parts.split(' ').map(|part| part.bytes().map(|digit| usize::from(digit - b'0')).collect())
}

/// Linear elements over places as the mesh of a file, `body` its region; quadratic kinds get nodes in the middles of their edges.
pub fn meshed(
    mut places: Vec<[f64; 3]>,
    elements: impl IntoIterator<Item = (ElementKind, Vec<u32>)>,
) -> FileMesh {
    let mut file = FileMesh { dimension: 3, ..FileMesh::default() };
    let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for (kind, mut nodes) in elements {
        let edges = kind.edges().iter().filter(|_| kind.is_quadratic());
        let ends: Vec<(u32, u32)> = edges.map(|&[p, q]| (nodes[p], nodes[q])).collect();
        nodes.extend(ends.into_iter().map(|(p, q)| {
            *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                let [a, b] = [p, q].map(|node| places[node as usize]);
                places.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
                (places.len() - 1) as u32
            })
        }));
        let (label, region) = (file.elements.len() + 1, "body".into());
        file.elements.push(FileElement { label, kind, region, entity: 1, nodes });
    }
    file.labels = (1..=places.len()).collect();
    file.is_used = vec![true; places.len()];
    file.points = places;
    file
}

/// Such a mesh as an input file of Abaqus, whose order of nodes it has.
pub fn abaqus_of(file: &FileMesh, kind: &str) -> String {
    let points: Vec<_> = file.labels.iter().copied().zip(file.points.iter().copied()).collect();
    let label = |&node: &u32| file.labels[node as usize];
    let elements = file.elements.iter().map(|own| own.nodes.iter().map(label).collect());
    abaqus_text(&points, kind, &elements.collect::<Vec<_>>())
}

/// Every place of a grid of so many cells along x, y, z, that along x changing fastest.
fn grid(counts: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..counts[2])
        .flat_map(move |k| (0..counts[1]).flat_map(move |j| (0..counts[0]).map(move |i| [i, j, k])))
}

/// A block of cells on the unit cube, each cut into elements of a kind, taken to its shape by `map`; sides `x0`, `x1`, `y0`, `y1`,
/// `z0` and `z1` are physical surfaces, `body` is the region. Mid-side nodes are mapped too: edges follow the map.
pub fn block(kind: ElementKind, cells: [usize; 3], map: impl Fn([f64; 3]) -> [f64; 3]) -> FileMesh {
    let share = |at: [usize; 3]| [0, 1, 2].map(|axis| at[axis] as f64 / cells[axis] as f64);
    let mut places: Vec<[f64; 3]> = grid(cells.map(|count| count + 1)).map(share).collect();
    let corner =
        |i: usize, j: usize, k: usize| (i + (cells[0] + 1) * (j + (cells[1] + 1) * k)) as u32;
    let mut elements = Vec::new();
    for [i, j, k] in grid(cells) {
        let ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let mut around = [k, k + 1].map(|k| ring.map(|(i, j)| corner(i, j, k))).concat();
        if kind.corner_count() == 5 {
            let [a, b] = [around[0], around[6]].map(|node| places[node as usize]);
            around.push(places.len() as u32);
            places.push([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])));
        }
        for part in parts(kind) {
            elements.push((kind, part.iter().map(|&local| around[local]).collect()));
        }
    }
    let mut file = meshed(places, elements);
    for element in &file.elements {
        for (face, locals) in kind.faces() {
            let nodes: Vec<u32> = locals.iter().map(|&local| element.nodes[local]).collect();
            for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                for (side, end) in [0.0, 1.0].into_iter().enumerate() {
                    if nodes.iter().all(|&node| file.points[node as usize][axis] == end) {
                        let faces = file.surfaces.entry(format!("{letter}{side}"));
                        faces.or_default().push((*face, nodes.clone()));
                    }
                }
            }
        }
    }
    file.points = file.points.into_iter().map(map).collect();
    file
}
