//! `*NSET` and `*ELSET`.

use super::block::{Block, fields};
use super::{Placed, Reader};
use crate::deck::{Place, quoted};
use crate::file_mesh::MeshFileError;
use std::collections::{BTreeSet, HashMap};

/// A set that is named before it is defined.
type Missing = Option<(Place, String)>;

impl Reader<'_, '_> {
    /// Reads all sets; one may name sets that are defined after it.
    pub(super) fn read_sets(&mut self, blocks: &Placed<'_, '_>) -> Result<(), MeshFileError> {
        let is_set = |block: &Block<'_>| matches!(block.keyword.as_str(), "NSET" | "ELSET");
        let sets = blocks.iter().filter(|(_, block)| is_set(block));
        let mut open: Vec<(usize, &Block<'_>)> = sets.map(|&(s, block)| (s, block)).collect();
        let mut depth = 0;
        while !open.is_empty() {
            depth += 1;
            let place = open[0].1.place;
            let deep = self.budget.descend(depth, "sets defined after those that list them");
            deep.map_err(|refusal| self.deck.error(place, refusal.to_string()))?;
            let mut later = Vec::new();
            let mut missing = None;
            for &(scope, block) in &open {
                let found = match block.keyword.as_str() {
                    "NSET" => self.node_set(scope, block)?,
                    _ => self.element_set(scope, block)?,
                };
                if let Some((place, name)) = found {
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

    /// Members of a set, listed twice or not, count against what may be read.
    fn take_members(&mut self, place: Place, count: usize) -> Result<(), MeshFileError> {
        let taken = self.budget.take_members(count);
        taken.map_err(|refusal| self.deck.error(place, refusal.to_string()))
    }

    fn node_set(&mut self, scope: usize, block: &Block<'_>) -> Result<Missing, MeshFileError> {
        let name = block.required(self.deck, "NSET")?;
        let inside = self.scope_of(scope, block)?;
        let mut items = Vec::new();
        if let Some(set) = block.parameter("ELSET") {
            let Some(elements) = self.element_sets.get(&self.key(inside, set)) else {
                return Ok(Some((block.place, set.to_owned())));
            };
            let elements = elements.items.iter();
            let nodes = elements.flat_map(|&e| &self.collection.elements[e].nodes);
            items.extend(nodes.copied().collect::<BTreeSet<u32>>());
        } else if block.has("GENERATE") {
            items = self.generated(inside, block, &self.nodes)?;
        } else {
            for (place, field) in entries(block) {
                match self.node_entry(inside, place, field)? {
                    Some(found) => {
                        self.take_members(place, found.len())?;
                        items.extend(found);
                    }
                    None => return Ok(Some((place, field.to_owned()))),
                }
            }
        }
        self.add_node_set(scope, name, items, block.has("INTERNAL"));
        Ok(None)
    }

    /// Nodes that an entry means, a number or the name of a set; none where no set of the name is known.
    pub(super) fn node_entry(
        &self,
        scope: usize,
        place: Place,
        field: &str,
    ) -> Result<Option<Vec<u32>>, MeshFileError> {
        let (there, name) = self.resolved(scope, field);
        if let Ok(label) = name.parse::<usize>() {
            return match self.nodes.get(&(there, label)) {
                Some(&node) => Ok(Some(vec![node])),
                None => {
                    let message = format!("no node has the number {}", quoted(field));
                    Err(self.deck.error(place, message))
                }
            };
        }
        let set = self.node_sets.get(&self.key(scope, field));
        Ok(set.map(|set| set.items.clone()))
    }

    fn element_set(&mut self, scope: usize, block: &Block<'_>) -> Result<Missing, MeshFileError> {
        let name = block.required(self.deck, "ELSET")?;
        let inside = self.scope_of(scope, block)?;
        let mut items = Vec::new();
        if block.has("GENERATE") {
            items = self.generated(inside, block, &self.elements)?;
        } else {
            for (place, field) in entries(block) {
                match self.element_entry(inside, place, field)? {
                    Some(found) => {
                        self.take_members(place, found.len())?;
                        items.extend(found);
                    }
                    None => return Ok(Some((place, field.to_owned()))),
                }
            }
        }
        self.add_element_set(scope, name, items, block.has("INTERNAL"));
        Ok(None)
    }

    /// Elements that an entry means, those that are not used left out; none where no set of the name is known.
    pub(super) fn element_entry(
        &self,
        scope: usize,
        place: Place,
        field: &str,
    ) -> Result<Option<Vec<usize>>, MeshFileError> {
        let (there, name) = self.resolved(scope, field);
        if let Ok(label) = name.parse::<usize>() {
            return match self.elements.get(&(there, label)) {
                Some(&element) => Ok(Some(vec![element])),
                None if self.skipped.contains(&(there, label)) => Ok(Some(Vec::new())),
                None => {
                    let message = format!("no element has the number {}", quoted(field));
                    Err(self.deck.error(place, message))
                }
            };
        }
        let set = self.element_sets.get(&self.key(scope, field));
        Ok(set.map(|set| set.items.clone()))
    }

    /// Items with the numbers first, first + step, ... up to last of each line; numbers without an item are passed over.
    fn generated<T: Copy>(
        &self,
        scope: usize,
        block: &Block<'_>,
        known: &HashMap<(usize, usize), T>,
    ) -> Result<Vec<T>, MeshFileError> {
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
                let message =
                    format!("first, last and step of a generated set expected, found {found}");
                return Err(self.deck.error(place, message));
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
