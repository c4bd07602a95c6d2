//! Bodies of bricks side by side in one mesh file.

use super::prelude::*;

/// A place, or a size along each axis, m.
pub type Place = [f64; 3];

/// A block of bricks; its sides are the surfaces `NAME_x0`, `NAME_x1`, `NAME_y0` ... of the file.
pub struct Block {
    pub name: &'static str,
    pub origin: [f64; 3],
    pub size: [f64; 3],
    pub counts: [usize; 3],
}

pub const fn brick(name: &'static str, origin: Place, size: Place, counts: [usize; 3]) -> Block {
    Block { name, origin, size, counts }
}

/// Edges of a brick in the order of Gmsh, by their ends.
const EDGES: [usize; 24] = [0, 1, 0, 3, 0, 4, 1, 2, 1, 5, 2, 3, 2, 6, 3, 7, 4, 5, 4, 7, 5, 6, 6, 7];

/// Radius, angle and height as a place.
pub fn polar([radius, angle, z]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = angle.sin_cos();
    [radius * cos, radius * sin, z]
}

/// The blocks as a file in MSH 2.2, every point moved by `place`. Nodes of different blocks are different nodes.
pub fn file_of(blocks: &[Block], place: impl Fn(Place) -> Place) -> Vec<u8> {
    file_of_order(blocks, 1, place)
}

/// The same of bricks with 8 nodes (`order` 1) or 20 nodes (`order` 2).
pub fn file_of_order(blocks: &[Block], order: usize, place: impl Fn(Place) -> Place) -> Vec<u8> {
    write(blocks, order, place, false)
}

/// The same, nodes of all blocks that lie at one place being one node.
pub fn welded_file_of(blocks: &[Block], order: usize, place: impl Fn(Place) -> Place) -> Vec<u8> {
    write(blocks, order, place, true)
}

fn write(blocks: &[Block], order: usize, place: impl Fn(Place) -> Place, weld_it: bool) -> Vec<u8> {
    let kind = [Hex8, Hex20][order - 1];
    let middle_of = |ends: &[usize; 2]| {
        let same = |edge: &[usize; 2]| ends.iter().all(|end| edge.contains(end));
        8 + kind.edges().iter().position(same).unwrap()
    };
    let middles = EDGES.as_chunks().0.iter().filter(|_| order == 2).map(middle_of);
    let locals: Vec<usize> = (0..8).chain(middles).collect();
    let (mut points, mut groups, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for own in blocks {
        let at = |share: [f64; 3]| [0, 1, 2].map(|k| own.origin[k] + own.size[k] * share[k]);
        let file = block(kind, own.counts, |share| place(at(share)));
        let number = |node: u32| points.len() + node as usize;
        for element in &file.elements {
            let nodes = locals.iter().map(|&local| number(element.nodes[local])).collect();
            elements.push((kind.gmsh_type(), groups.len(), nodes));
        }
        groups.push((3, own.name.to_owned()));
        for (side, faces) in &file.surfaces {
            for (_, nodes) in faces {
                let nodes = nodes.iter().map(|&node| number(node)).collect();
                elements.push(([3, 16][order - 1], groups.len(), nodes));
            }
            groups.push((2, format!("{}_{side}", own.name)));
        }
        points.extend(file.points);
    }
    if weld_it {
        // Nodes at one place, to a millionth of a metre, get one number.
        let (mut numbers, mut own) = (BTreeMap::new(), Vec::new());
        let number = points.iter().map(|point: &Place| {
            *numbers.entry(point.map(|x| (1e6 * x).round() as i64)).or_insert_with(|| {
                own.push(*point);
                own.len() - 1
            })
        });
        let number: Vec<usize> = number.collect();
        let nodes = elements.iter_mut().flat_map(|own: &mut Listed| &mut own.2);
        nodes.for_each(|node| *node = number[*node]);
        points = own;
    }
    let groups: Vec<(u32, &str)> = groups.iter().map(|(d, name)| (*d, name.as_str())).collect();
    mesh_text(&points, &groups, &elements)
}
