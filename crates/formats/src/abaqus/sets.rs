//! `*NSET` and `*ELSET`.

use super::block::{Block, fields};
use super::{Numbered, Reader};
use crate::deck::{Place, quoted};
use crate::file_mesh::Result;
use frictionsim_bounds::Budget;
use std::collections::{BTreeSet, HashMap};

/// A set that is named before it is defined.
type Missing = Option<(Place, String)>;

/// The members of a set, or what it names before that is defined.
type Members<T> = Result<Vec<T>, (Place, String)>;

impl Reader<'_, '_> {
    /// Reads all sets; one may name sets that are defined after it.
    pub(super) fn read_sets(&mut self) -> Result<()> {
        let is_set = |block: &Block<'_>| matches!(block.keyword.as_str(), "NSET" | "ELSET");
        let sets = self.blocks.iter().copied().filter(|(_, block)| is_set(block));
        let mut open: Vec<(usize, &Block<'_>)> = sets.collect();
        let mut depth = 0;
        while !open.is_empty() {
            depth += 1;
            let place = open[0].1.place;
            let deep = self.budget.descend(depth, "sets defined after those that list them");
            deep.map_err(|refusal| self.deck.error(place, refusal.to_string()))?;
            let mut later = Vec::new();
            let mut missing = None;
            for &(scope, block) in &open {
                if let Some((place, name)) = self.set(scope, block)? {
                    let is_node_set = block.keyword == "NSET" && !block.has("ELSET");
                    missing.get_or_insert((place, name, is_node_set));
                    later.push((scope, block));
                }
            }
            if let (true, Some((place, name, is_node_set))) = (later.len() == open.len(), missing) {
                let what = ["element set", "node set"][usize::from(is_node_set)];
                return Err(self.unknown(place, what, &name));
            }
            open = later;
        }
        Ok(())
    }

    /// Reads a set; what it names before that is defined, if so.
    fn set(&mut self, scope: usize, block: &Block<'_>) -> Result<Missing> {
        let name = block.required(&block.keyword)?;
        let inside = self.scope_of(scope, block)?;
        let (named, is_internal) = (Some(self.named(scope, name)), block.has("INTERNAL"));
        let mut budget = self.budget.clone();
        let found = match block.keyword.as_str() {
            "NSET" => self
                .nodes_of(inside, block, &mut budget)?
                .map(|items| self.nodes.add(named, items, is_internal)),
            _ => self
                .members(&self.elements, inside, block, &mut budget)?
                .map(|items| self.elements.add(named, items, is_internal)),
        };
        self.budget = budget;
        Ok(found.err())
    }

    /// The members of a node set: its own, or the nodes of an element set.
    fn nodes_of(
        &self,
        scope: usize,
        block: &Block<'_>,
        budget: &mut Budget,
    ) -> Result<Members<u32>> {
        let Some(set) = block.parameter("ELSET") else {
            return self.members(&self.nodes, scope, block, budget);
        };
        let Some(elements) = self.elements.sets.get(&self.key(scope, set)) else {
            return Ok(Err((block.place, set.to_owned())));
        };
        let nodes = elements.items.iter().flat_map(|&e| &self.collected[e].nodes);
        let nodes: BTreeSet<u32> = nodes.copied().collect();
        Ok(Ok(nodes.into_iter().collect()))
    }

    /// The members of a set; listed twice or not they count against what may be read.
    fn members<T: Copy>(
        &self,
        all: &Numbered<T>,
        scope: usize,
        block: &Block<'_>,
        budget: &mut Budget,
    ) -> Result<Members<T>> {
        if block.has("GENERATE") {
            return self.generated(scope, block, &all.known).map(Ok);
        }
        let mut items = Vec::new();
        for (place, field) in entries(block) {
            let Some(found) = self.entry(all, scope, place, field)? else {
                return Ok(Err((place, field.to_owned())));
            };
            let taken = budget.take_members(found.len());
            taken.map_err(|refusal| self.deck.error(place, refusal.to_string()))?;
            items.extend(found);
        }
        Ok(Ok(items))
    }

    /// What an entry means, a number or the name of a set, those that are not used left out; none where no set of the
    /// name is known.
    pub(super) fn entry<T: Copy>(
        &self,
        all: &Numbered<T>,
        scope: usize,
        place: Place,
        field: &str,
    ) -> Result<Option<Vec<T>>> {
        let (there, name) = self.resolved(scope, field);
        let Ok(label) = name.parse::<usize>() else {
            let set = all.sets.get(&self.key(scope, field));
            return Ok(set.map(|set| set.items.clone()));
        };
        match all.known.get(&(there, label)) {
            Some(&item) => Ok(Some(vec![item])),
            None if all.skipped.contains(&(there, label)) => Ok(Some(Vec::new())),
            None => {
                refuse!(self.deck, place; "no {} has the number {}", all.what, quoted(field))
            }
        }
    }

    /// What an entry means where a set of its name must be known.
    pub(super) fn items<T: Copy>(
        &self,
        all: &Numbered<T>,
        scope: usize,
        place: Place,
        field: &str,
    ) -> Result<Vec<T>> {
        let found = self.entry(all, scope, place, field)?;
        found.ok_or_else(|| self.unknown(place, &format!("{} set", all.what), field))
    }

    /// Items with the numbers first, first + step, ... up to last of each line; numbers without an item are passed over.
    fn generated<T: Copy>(
        &self,
        scope: usize,
        block: &Block<'_>,
        known: &HashMap<(usize, usize), T>,
    ) -> Result<Vec<T>> {
        let mut items = Vec::new();
        for &(place, line) in &block.data {
            let numbers: Option<Vec<usize>> = fields(line).map(|f| f.parse().ok()).collect();
            let (first, last, step) = match numbers.as_deref() {
                Some(&[first, last]) => (first, last, 1),
                Some(&[first, last, step]) => (first, last, step),
                _ => (1, 0, 0),
            };
            if step == 0 || first > last {
                let found = quoted(line);
                refuse!(self.deck, place;
                    "first, last and step of a generated set expected, found {found}");
            }
            // No more work than there are items, whatever the numbers say.
            if (last - first) / step < known.len() {
                let labels = (first..=last).step_by(step);
                items.extend(labels.filter_map(|label| known.get(&(scope, label))).copied());
            } else {
                let is_meant = |label: usize| {
                    (first..=last).contains(&label) && (label - first).is_multiple_of(step)
                };
                let own = known.iter().filter(|((s, label), _)| *s == scope && is_meant(*label));
                let mut own: Vec<(usize, T)> =
                    own.map(|((_, label), &item)| (*label, item)).collect();
                own.sort_unstable_by_key(|item| item.0);
                items.extend(own.into_iter().map(|item| item.1));
            }
        }
        Ok(items)
    }
}

/// Entries of all data lines that are not empty.
fn entries<'a>(block: &Block<'a>) -> impl Iterator<Item = (Place, &'a str)> {
    let lines = block.data.clone().into_iter();
    let entries = lines.flat_map(|(place, line)| fields(line).map(move |field| (place, field)));
    entries.filter(|(_, field)| !field.is_empty())
}
