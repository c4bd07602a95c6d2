//! `*EQUATION`: sums of displacements that vanish.

use super::Reader;
use super::block::{Row, Scoped};
use super::conditions::Held;
use crate::collection::{dimension, used_nodes};
use crate::deck::real;
use crate::file_mesh::Result;
use std::collections::BTreeSet;

/// A term: its nodes, an axis, a coefficient.
type Term = (Vec<u32>, usize, f64);

impl Reader<'_, '_> {
    /// Reads the equations, and returns the nodes without elements that are part of them: such a node must be held, and takes no
    /// part then.
    pub(super) fn read_equations(&mut self, held: &Held) -> Result<BTreeSet<u32>> {
        let used = used_nodes(&self.collected);
        let is_held = |reader: &Self, node: u32, axis: usize| {
            let mut sets = held.iter().filter(|(_, (axes, _))| axes[axis]);
            sets.any(|(key, _)| reader.nodes.sets[key].items.contains(&node))
        };
        let mut referred = BTreeSet::new();
        for block in self.blocks_of("EQUATION") {
            for (row, terms) in self.equation_terms(block)? {
                // Sets of as many nodes stand for as many equations; a single node is part of each.
                let count = terms.iter().map(|term| term.0.len()).max().unwrap_or(0);
                ensure!(terms.iter().all(|term| [1, count].contains(&term.0.len())); row;
                    "*EQUATION: node sets of one equation have as many nodes each");
                for i in 0..count {
                    let all = terms.iter().map(|(nodes, axis, factor)| {
                        let node = nodes[if nodes.len() == 1 { 0 } else { i }];
                        (node, *axis, *factor)
                    });
                    let (own, beside): (Vec<_>, Vec<_>) = all.partition(|t| used.contains(&t.0));
                    // Nodes without elements vanish from it if they are held.
                    for (node, axis, _) in beside {
                        ensure!(is_held(self, node, axis); row;
                            "*EQUATION: node {} belongs to no element, and nothing holds it along {}: a node that \
                             moves others freely is not supported",
                            self.file.labels[node as usize], ["x", "y", "z"][axis]);
                        referred.insert(node);
                    }
                    self.file.equations.push(own);
                }
            }
        }
        // A plane body has no use for them.
        if dimension(&self.collected) == 2 && !self.file.equations.is_empty() {
            self.file.equations.clear();
            let place =
                self.blocks_of("EQUATION").next().map_or(self.deck.end(), |block| block.place);
            self.lose_part("*EQUATION", place, "plane bodies have no equations of nodes");
        }
        Ok(referred)
    }

    /// The equations of a block: the number of terms, then node or set, axis and coefficient of each, over any lines.
    fn equation_terms<'a>(&self, block: Scoped<'_, 'a>) -> Result<Vec<(Row<'a>, Vec<Term>)>> {
        let mut equations = Vec::new();
        let mut rows = block.rows();
        while let Some(head) = rows.next() {
            let count = head.line.trim().trim_end_matches(',').parse::<usize>().ok();
            let count = count.filter(|count| (1..=1_000_000).contains(count));
            let count = found!(count; head; "*EQUATION: the number of terms expected");
            let mut terms: Vec<Term> = Vec::new();
            while terms.len() < count {
                let row = found!(rows.next(); head;
                    "*EQUATION: {count} terms expected, found {}", terms.len());
                let entry: Vec<&str> = row.fields().collect();
                for term in entry.chunks(3) {
                    terms.push(self.equation_term(row, term)?);
                }
            }
            equations.push((head, terms));
        }
        Ok(equations)
    }

    fn equation_term(&self, row: Row<'_>, term: &[&str]) -> Result<Term> {
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
