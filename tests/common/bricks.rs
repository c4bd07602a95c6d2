//! Bodies of bricks side by side in one mesh file.

use std::fmt::Write;

/// A block of bricks; its sides are the surfaces `NAME_x0`, `NAME_x1`, `NAME_y0` ... of the file.
pub struct Block {
    pub name: &'static str,
    pub origin: [f64; 3],
    pub size: [f64; 3],
    pub counts: [usize; 3],
}

/// The blocks as a file in MSH 2.2, every point moved by `place`. Nodes of different blocks are different nodes.
pub fn file_of(blocks: &[Block], place: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<u8> {
    let (mut names, mut nodes, mut elements) = (String::new(), String::new(), String::new());
    let (mut name_count, mut node_count, mut element_count) = (0, 0, 0);
    for block in blocks {
        let [nx, ny, nz] = block.counts;
        let first = node_count + 1;
        let node = |i: usize, j: usize, k: usize| first + i + (nx + 1) * (j + (ny + 1) * k);
        for k in 0..=nz {
            for j in 0..=ny {
                for i in 0..=nx {
                    let share = [i as f64 / nx as f64, j as f64 / ny as f64, k as f64 / nz as f64];
                    let at = |axis: usize| block.origin[axis] + block.size[axis] * share[axis];
                    let [x, y, z] = place([at(0), at(1), at(2)]);
                    node_count += 1;
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
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let ring = |k: usize| {
                        [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
                    };
                    element(5, group, &[ring(k), ring(k + 1)].concat());
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
                            (index[axis], index[u], index[v]) = (at, a + da, b + db);
                            node(index[0], index[1], index[2])
                        };
                        let list = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                        element(3, name_count, &list);
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
