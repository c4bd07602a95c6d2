//! `*EQUATION`: sums of displacements that vanish.

use super::Reader;
use super::block::{Row, Scoped};
use super::conditions::Held;
use crate::prelude::*;

/// A node or a set of them, an axis, a coefficient.
type Term<N> = (N, usize, f64);

/// Part of the largest coefficient of an equation below which another one is round-off.
const ROUND_OFF: f64 = 1e-12;

impl Reader<'_, '_> {
    /// Reads the equations, and returns the nodes without elements that are part of them. Those that are held vanish; nothing resists
    /// the others: the first equation says where one is, and those behind hold with that.
    pub(super) fn read_equations(&mut self, held: &Held) -> Result<BTreeSet<u32>> {
        let used = used_nodes(&self.file.elements);
        let is_held = |reader: &Self, node: u32, axis: usize| {
            held.iter()
                .any(|(set, own)| own.0[axis] && reader.nodes.sets[set].items.contains(&node))
        };
        let (mut referred, mut told) = (BTreeSet::new(), BTreeMap::<_, BTreeMap<_, f64>>::new());
        for block in self.blocks_of("EQUATION") {
            for terms in self.equations(block)? {
                let mut own: BTreeMap<(u32, usize), f64> = BTreeMap::new();
                for &(node, axis, factor) in &terms {
                    let is_used = used.contains(&node);
                    referred.extend((!is_used).then_some(node));
                    if is_used || !is_held(self, node, axis) {
                        *own.entry((node, axis)).or_default() += factor;
                    }
                }
                // What equations before it say of loose nodes.
                while let Some(at) = own.keys().copied().find(|at| told.contains_key(at)) {
                    let factor = own.remove(&at).unwrap_or_default();
                    for (at, share) in &told[&at] {
                        *own.entry(*at).or_default() += factor * share;
                    }
                }
                let largest = terms.iter().fold(0.0_f64, |m, term| m.max(term.2.abs()));
                own.retain(|_, factor| factor.abs() > ROUND_OFF * largest);
                // It says where a loose node is, or holds between nodes of the body.
                let loose = own.iter().filter(|(at, _)| !used.contains(&at.0));
                let loose = loose.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
                if let Some((&at, &factor)) = loose {
                    own.remove(&at);
                    own.values_mut().for_each(|share| *share /= -factor);
                    told.insert(at, own);
                } else {
                    let terms = own.into_iter().map(|((node, axis), f)| (node, axis, f));
                    self.file.equations.push(terms.collect());
                }
            }
        }
        // A plane body has no use for them.
        if dimension(&self.file.elements) == 2 && !self.file.equations.is_empty() {
            self.file.equations.clear();
            let place =
                self.blocks_of("EQUATION").next().map_or(self.deck.end(), |block| block.place);
            self.lose_part("*EQUATION", place, "plane bodies have no equations of nodes");
        }
        Ok(referred)
    }

    /// The equations of a block: the number of terms, then node or set, axis and coefficient of each, over any lines. Sets of as many
    /// nodes stand for as many equations; a single node is part of each.
    fn equations(&self, block: Scoped<'_, '_>) -> Result<Vec<Vec<Term<u32>>>> {
        let (mut equations, mut rows) = (Vec::new(), block.rows());
        while let Some(head) = rows.next() {
            let count = head.line.trim().trim_end_matches(',').parse::<usize>().ok();
            let count = count.filter(|count| (1..=1_000_000).contains(count));
            let count = found!(count; head; "*EQUATION: the number of terms expected");
            let mut terms: Vec<Term<Vec<u32>>> = Vec::new();
            while terms.len() < count {
                let row = found!(rows.next(); head;
                    "*EQUATION: {count} terms expected, found {}", terms.len());
                let entry: Vec<&str> = row.fields().collect();
                for term in entry.chunks(3) {
                    terms.push(self.equation_term(row, term)?);
                }
            }
            let size = terms.iter().map(|term| term.0.len()).max().unwrap_or(0);
            ensure!(terms.iter().all(|term| [1, size].contains(&term.0.len())); head;
                "*EQUATION: node sets of one equation have as many nodes each");
            let of = |i: usize| terms.iter().map(move |own| (own.0[i % own.0.len()], own.1, own.2));
            equations.extend((0..size).map(|i| of(i).collect()));
        }
        Ok(equations)
    }

    fn equation_term(&self, row: Row<'_>, term: &[&str]) -> Result<Term<Vec<u32>>> {
        let parsed = match term {
            &[target, axis, factor] => {
                let axis = axis.parse::<usize>().ok().filter(|axis| (1..=3).contains(axis));
                axis.zip(real(factor)).map(|(axis, factor)| (target, axis, factor))
            }
            _ => None,
        };
        let (target, axis, factor) = found!(parsed; row;
            "*EQUATION: a node or node set, a direction 1 to 3 and a coefficient expected");
        Ok((self.items(&self.nodes, row, target)?, axis - 1, factor))
    }
}
