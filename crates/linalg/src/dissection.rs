//! Nested dissection: the order of elimination of large bodies.

use super::SparsityPattern;
use feral_metis::{CscPattern, metis_order};
use std::collections::HashMap;

/// Unknowns in the order of elimination by multilevel nested dissection; nothing where there is no order.
///
/// Unknowns of the same neighbours, as those of one node are, stay together.
///
/// Source: G. Karypis, V. Kumar, A fast and high quality multilevel scheme for partitioning irregular graphs, SIAM J. Sci. Comput. 20
/// (1998).
pub(super) fn nested_dissection(pattern: &SparsityPattern) -> Option<Vec<usize>> {
    let n = pattern.dimension();
    let neighbours = |unknown: usize| {
        let all = pattern.column(unknown).chain(pattern.row(unknown)).map(|(_, other)| other); // The graph of A + A^T.
        let mut all: Vec<usize> = all.chain([unknown]).collect();
        all.sort_unstable();
        all.dedup();
        all
    };

    // Unknowns of the same neighbours are one vertex.
    let (mut vertices, mut members) = (HashMap::new(), Vec::<Vec<usize>>::new());
    let mut vertex_of = vec![0; n];
    for (unknown, vertex) in vertex_of.iter_mut().enumerate() {
        *vertex = *vertices.entry(neighbours(unknown)).or_insert(members.len());
        if *vertex == members.len() {
            members.push(Vec::new());
        }
        members[*vertex].push(unknown);
    }

    let mut adjacent: Vec<(usize, Vec<usize>)> =
        vertices.into_iter().map(|(others, vertex)| (vertex, others)).collect();
    adjacent.sort_unstable();
    // The graph of the vertices by columns, as METIS takes it.
    let (mut pointers, mut others) = (vec![0_i32], Vec::<i32>::new());
    for (vertex, unknowns) in adjacent {
        let mut own: Vec<usize> = unknowns.into_iter().map(|unknown| vertex_of[unknown]).collect();
        own.sort_unstable();
        own.dedup();
        for other in own.into_iter().filter(|other| *other != vertex) {
            others.push(i32::try_from(other).ok()?);
        }
        pointers.push(i32::try_from(others.len()).ok()?);
    }
    let graph = CscPattern::new(members.len(), &pointers, &others)?;
    let order = metis_order(&graph).ok()?;
    Some(order.into_iter().flat_map(|vertex| members[vertex as usize].iter().copied()).collect()) // Those of one vertex stay together.
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LuAnalysis, MatrixPolynomial, SparseLu};
    use faer::Mat;

    /// Springs between the nodes of bricks, `count` along each side, three unknowns a node, and a pattern of all neighbours.
    fn cube(count: usize) -> MatrixPolynomial {
        let places = |node: usize| [node % count, node / count % count, node / count / count];
        let nodes = count.pow(3);
        let mut entries = Vec::new();
        for (node, other) in (0..nodes).flat_map(|a| (0..nodes).map(move |b| (a, b))) {
            let apart: Vec<usize> =
                places(node).iter().zip(places(other)).map(|(a, b)| a.abs_diff(b)).collect();
            if apart.iter().all(|distance| *distance < 2) {
                let value = if node == other { 30.0 } else { -1.0 };
                let pairs = (0..9).map(|k| (3 * node + k / 3, 3 * other + k % 3));
                entries
                    .extend(pairs.map(|(i, j)| (i, j, if i % 3 == j % 3 { value } else { 0.0 })));
            }
        }
        MatrixPolynomial::from_triplets(3 * nodes, &[entries])
    }

    /// Exact: an order of all unknowns, those of a node together; its factors solve.
    #[test]
    fn large_bodies_are_eliminated_by_nested_dissection() {
        let matrix = cube(14);
        let unknowns = nested_dissection(matrix.pattern()).unwrap();
        let mut all = unknowns.clone();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..matrix.dimension()));
        assert!(unknowns.chunks(3).all(|own| own[0] / 3 == own[1] / 3 && own[1] / 3 == own[2] / 3));
        let analysis = LuAnalysis::new(matrix.pattern()).unwrap();
        let factors = SparseLu::symmetric(&analysis, matrix.evaluate(0.0)).unwrap();
        let x = Mat::from_fn(unknowns.len(), 1, |i, _| (i % 7) as f64);
        let mut found = matrix.pattern().multiply(&matrix.evaluate(0.0), x.as_ref());
        factors.solve_in_place(found.as_mut());
        assert!((found - x).norm_max() < 1e-13);
    }
}
