//! The order of elimination.

use super::Front;
use crate::{LinalgError, SparsityPattern};
use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;
use std::borrow::Cow;

/// The fronts of a pattern with the nonzeros that each takes from the matrix: those of the Cholesky factors of its symmetric hull,
/// neighbours of alike structure in one.
pub(super) fn fronts(pattern: &SparsityPattern) -> Result<Vec<Front>, LinalgError> {
    let n = pattern.dimension();
    let both = pattern.nonzeros().flat_map(|(_, i, j)| [(i, j), (j, i)]);
    let hull = match pattern.is_symmetric() {
        true => Cow::Borrowed(pattern),
        false => Cow::Owned(SparsityPattern::from_positions(n, both)),
    };
    let symbolic = hull.symbolic_cholesky()?;
    // Unknowns by their place in the order of elimination, and the place of each.
    let natural: Vec<usize> = (0..n).collect();
    let order = symbolic.perm().map(|order| order.arrays());
    let (unknown_at, place_of) = order.unwrap_or((&natural, &natural));
    // Places of the unknowns of each front, rising, and the end of those that are eliminated in it.
    let places: Vec<(Vec<usize>, usize)> = match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(blocks) => {
            let block = |s: usize| {
                let (begin, end) = (blocks.supernode_begin()[s], blocks.supernode_end()[s]);
                let left = blocks.supernode(s).pattern().iter().copied();
                let mut own: Vec<usize> = (begin..end).chain(left).collect();
                own.sort_unstable();
                (own, end)
            };
            (0..blocks.n_supernodes()).map(block).collect()
        }
        _ => (0..n).map(|place| (vec![place], place + 1)).collect(), // Of a diagonal matrix.
    };
    let front_of = |place: usize| places.partition_point(|own| own.1 <= place);
    let place_in = |front: usize, place: usize| {
        let found = places[front].0.binary_search(&place);
        found.expect("a front holds all unknowns that those before it leave coupled")
    };

    let fronts = places.iter().map(|(places, end)| Front {
        unknowns: places.iter().map(|&place| unknown_at[place]).collect(),
        width: places.partition_point(|place| place < end),
        entries: Vec::new(),
        children: Vec::new(),
        places: Vec::new(),
    });
    let mut fronts: Vec<Front> = fronts.collect();
    // What a front leaves goes to the one that eliminates the first of it.
    for s in 0..fronts.len() {
        let left = &places[s].0[fronts[s].width..];
        let Some(&next) = left.first() else { continue };
        let parent = front_of(next);
        fronts[s].places = left.iter().map(|&place| place_in(parent, place)).collect();
        fronts[parent].children.push(s);
    }
    // Each nonzero belongs where the first of its two unknowns is eliminated.
    for (at, i, j) in pattern.nonzeros() {
        let (row, column) = (place_of[i], place_of[j]);
        let front = front_of(row.min(column));
        let [row, column] = [row, column].map(|own| place_in(front, own));
        fronts[front].entries.push([at, row, column].map(|index| index as u32));
    }
    Ok(fronts)
}
