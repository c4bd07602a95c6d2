//! Bodies of bricks side by side in one mesh file.

use std::collections::BTreeMap;
use std::fmt::Write;

/// A block of bricks; its sides are the surfaces `NAME_x0`, `NAME_x1`, `NAME_y0` ... of the file.
pub struct Block {
    pub name: &'static str,
    pub origin: [f64; 3],
    pub size: [f64; 3],
    pub counts: [usize; 3],
}

pub const fn brick(
    name: &'static str,
    origin: [f64; 3],
    size: [f64; 3],
    counts: [usize; 3],
) -> Block {
    Block { name, origin, size, counts }
}

/// The blocks as a file in MSH 2.2, every point moved by `place`. Nodes of different blocks are different nodes.
pub fn file_of(blocks: &[Block], place: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<u8> {
    file_of_order(blocks, 1, place)
}

/// Corners of a brick in halves of its edges, and the edges in the order of Gmsh.
const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2]];
pub const EDGES: [usize; 24] =
    [0, 1, 0, 3, 0, 4, 1, 2, 1, 5, 2, 3, 2, 6, 3, 7, 4, 5, 4, 7, 5, 6, 6, 7];

/// The same of bricks with 8 nodes (`order` 1) or 20 nodes (`order` 2).
pub fn file_of_order(
    blocks: &[Block],
    order: usize,
    place: impl Fn([f64; 3]) -> [f64; 3],
) -> Vec<u8> {
    let (mut names, mut nodes, mut elements) = (String::new(), String::new(), String::new());
    let (mut name_count, mut node_count, mut element_count) = (0, 0, 0);
    for block in blocks {
        let counts = block.counts;
        // Nodes by their place in halves of an element; a brick of 20 nodes has none in faces or inside.
        let step = if order == 1 { 2 } else { 1 };
        let mut numbers = BTreeMap::new();
        for k in (0..=2 * counts[2]).step_by(step) {
            for j in (0..=2 * counts[1]).step_by(step) {
                for i in (0..=2 * counts[0]).step_by(step) {
                    if i % 2 + j % 2 + k % 2 > 1 {
                        continue;
                    }
                    let half = [i, j, k];
                    let share = |axis: usize| half[axis] as f64 / (2 * counts[axis]) as f64;
                    let at = |axis: usize| block.origin[axis] + block.size[axis] * share(axis);
                    let [x, y, z] = place([at(0), at(1), at(2)]);
                    node_count += 1;
                    numbers.insert(half, node_count);
                    writeln!(nodes, "{node_count} {x:?} {y:?} {z:?}").unwrap();
                }
            }
        }
        name_count += 1;
        let group = name_count;
        writeln!(names, "3 {group} \"{}\"", block.name).unwrap();
        let mut element = |kind: u32, group: usize, list: &[usize]| {
            element_count += 1;
            let list: Vec<String> = list.iter().map(usize::to_string).collect();
            let list = list.join(" ");
            writeln!(elements, "{element_count} {kind} 2 {group} {group} {list}").unwrap();
        };
        // Corners of an element or a face, and the middles of its edges behind them.
        let with_middles = |corners: &[[usize; 3]], edges: &[[usize; 2]]| -> Vec<usize> {
            let middle = |[a, b]: &[usize; 2]| {
                std::array::from_fn(|axis| (corners[*a][axis] + corners[*b][axis]) / 2)
            };
            let middles = edges.iter().filter(|_| order == 2).map(middle);
            corners.iter().copied().chain(middles).map(|half| numbers[&half]).collect()
        };
        for k in 0..counts[2] {
            for j in 0..counts[1] {
                for i in 0..counts[0] {
                    let at = |[a, b, c]: [usize; 3]| [2 * i + a, 2 * j + b, 2 * k + c];
                    element(
                        [5, 17][order - 1],
                        group,
                        &with_middles(&CORNERS.map(at), EDGES.as_chunks().0),
                    );
                }
            }
        }
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            for (end, at) in [0, block.counts[axis]].into_iter().enumerate() {
                name_count += 1;
                writeln!(names, "2 {name_count} \"{}_{letter}{end}\"", block.name).unwrap();
                let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                for a in 0..block.counts[u] {
                    for b in 0..block.counts[v] {
                        let corner = |da: usize, db: usize| {
                            let mut index = [0; 3];
                            (index[axis], index[u], index[v]) =
                                (2 * at, 2 * (a + da), 2 * (b + db));
                            index
                        };
                        let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                        let list = with_middles(&corners, &[[0, 1], [1, 2], [2, 3], [3, 0]]);
                        element([3, 16][order - 1], name_count, &list);
                    }
                }
            }
        }
    }
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{name_count}\n{names}$EndPhysicalNames\n\
         $Nodes\n{node_count}\n{nodes}$EndNodes\n$Elements\n{element_count}\n{elements}$EndElements\n"
    )
    .into_bytes()
}
