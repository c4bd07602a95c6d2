//! The order of elimination.

use super::Front;
use crate::{LinalgError, SparsityPattern};
use faer::sparse::linalg::cholesky::SymbolicCholeskyRaw;
use std::borrow::Cow;

/// Which unknowns are eliminated together.
pub(super) struct Order {
    /// Unknowns of each front by their place in the order of elimination, rising.
    unknowns: Vec<Vec<usize>>,
    /// Place after the last one that each front eliminates.
    ends: Vec<usize>,
    /// Unknowns of the matrix by their place, and the place of each.
    unknown_at: Vec<usize>,
    place_of: Vec<usize>,
}

impl Order {
    /// That of the Cholesky factors of the symmetric hull of a pattern, neighbours of alike structure in one front.
    pub fn of(pattern: &SparsityPattern) -> Result<Self, LinalgError> {
        let n = pattern.dimension();
        let nonzeros = (0..n).flat_map(|j| pattern.column(j).map(move |(_, i)| (i, j)));
        let hull = nonzeros.flat_map(|(i, j)| [(i, j), (j, i)]);
        let hull = match pattern.is_symmetric() {
            true => Cow::Borrowed(pattern),
            false => Cow::Owned(SparsityPattern::from_positions(n, hull)),
        };
        let symbolic = hull.symbolic_cholesky()?;
        let in_order = || [(); 2].map(|()| (0..n).collect());
        let arrays = symbolic.perm().map(|order| order.arrays());
        let [unknown_at, place_of]: [Vec<usize>; 2] =
            arrays.map_or_else(in_order, |(to, from)| [to.to_vec(), from.to_vec()]); // The order and its inverse.
        let SymbolicCholeskyRaw::Supernodal(blocks) = symbolic.raw() else {
            // A diagonal matrix, where nothing is to be eliminated.
            return Ok(Self {
                unknowns: (0..n).map(|place| vec![place]).collect(),
                ends: (1..=n).collect(),
                unknown_at,
                place_of,
            });
        };
        let (mut unknowns, mut ends) = (Vec::new(), Vec::new());
        for s in 0..blocks.n_supernodes() {
            let (begin, end) = (blocks.supernode_begin()[s], blocks.supernode_end()[s]);
            let mut own: Vec<usize> = (begin..end).collect();
            own.extend_from_slice(blocks.supernode(s).pattern()); // Those eliminated here, and those left coupled.
            own.sort_unstable();
            unknowns.push(own);
            ends.push(end);
        }
        Ok(Self { unknowns, ends, unknown_at, place_of })
    }

    /// The fronts, with the nonzeros that each takes from the matrix.
    pub fn fronts(&self, pattern: &SparsityPattern) -> Vec<Front> {
        let fronts = self.unknowns.iter().zip(&self.ends).map(|(places, &end)| Front {
            unknowns: places.iter().map(|&place| self.unknown_at[place]).collect(),
            width: places.partition_point(|&place| place < end),
            entries: Vec::new(),
            children: Vec::new(),
            places: Vec::new(),
        });
        let mut fronts: Vec<Front> = fronts.collect();
        // What a front leaves goes to the one that eliminates the first of it.
        for s in 0..fronts.len() {
            let left = &self.unknowns[s][fronts[s].width..];
            let Some(&next) = left.first() else { continue };
            let parent = self.front_of(next);
            fronts[s].places = left.iter().map(|&place| self.place_in(parent, place)).collect();
            fronts[parent].children.push(s);
        }
        // Each nonzero belongs where the first of its two unknowns is eliminated.
        for j in 0..pattern.dimension() {
            for (at, i) in pattern.column(j) {
                let (row, column) = (self.place_of[i], self.place_of[j]);
                let front = self.front_of(row.min(column));
                let [row, column] = [row, column].map(|own| self.place_in(front, own));
                fronts[front].entries.push([at, row, column].map(|index| index as u32));
            }
        }
        fronts
    }

    /// The front that eliminates what has a place.
    fn front_of(&self, place: usize) -> usize {
        self.ends.partition_point(|&end| end <= place)
    }

    fn place_in(&self, front: usize, place: usize) -> usize {
        let found = self.unknowns[front].binary_search(&place);
        found.expect("a front holds all unknowns that those before it leave coupled")
    }
}
