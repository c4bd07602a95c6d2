//! `*NSET` and `*ELSET`.

use super::block::{Row, Scoped};
use super::{Numbered, Reader};
use crate::prelude::*;

/// The members of a set, or what it names before that is defined.
type Members<T> = Result<Vec<T>, (Place, String)>;

/// What an entry means; none where no set of its name is known.
type Entry<T> = Result<Option<Vec<T>>>;

impl Reader<'_, '_> {
    /// Reads all sets; one may name sets that are defined after it.
    pub(super) fn read_sets(&mut self) -> Result<()> {
        let is_set = |block: &Scoped<'_, '_>| matches!(block.keyword.as_str(), "NSET" | "ELSET");
        let mut open: Vec<_> = self.blocks.iter().copied().filter(is_set).collect();
        let mut depth = 0;
        while !open.is_empty() {
            depth += 1;
            let deep =
                self.budget.borrow().descend(depth, "sets defined after those that list them");
            deep.map_err(|refusal| open[0].error(refusal.to_string()))?;
            let mut later = Vec::new();
            let mut missing = None;
            for &block in &open {
                if let Some((place, name)) = self.set(block)? {
                    let is_node_set = block.keyword == "NSET" && !block.has("ELSET");
                    missing.get_or_insert((place, name, is_node_set));
                    later.push(block);
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
    fn set(&mut self, block: Scoped<'_, '_>) -> Result<Option<(Place, String)>> {
        let named = Some(self.named(block.scope, block.required(&block.keyword)?));
        let inside = Scoped { scope: self.scope_of(block)?, ..block };
        let is_internal = block.has("INTERNAL");
        let found = match block.keyword.as_str() {
            "NSET" => self.nodes_of(inside)?.map(|items| self.nodes.add(named, items, is_internal)),
            _ => self
                .members(&self.elements, inside)?
                .map(|items| self.elements.add(named, items, is_internal)),
        };
        Ok(found.err())
    }

    /// The members of a node set: its own, or the nodes of an element set.
    fn nodes_of(&self, block: Scoped<'_, '_>) -> Result<Members<u32>> {
        let Some(set) = block.parameter("ELSET") else {
            return self.members(&self.nodes, block);
        };
        let Some(elements) = self.elements.sets.get(&self.key(block.scope, set)) else {
            return Ok(Err((block.place, set.to_owned())));
        };
        let nodes = elements.items.iter().flat_map(|&e| &self.file.elements[e].nodes);
        let nodes: BTreeSet<u32> = nodes.copied().collect();
        Ok(Ok(nodes.into_iter().collect()))
    }

    /// The members of a set; listed twice or not they count against what may be read.
    fn members<T: Copy>(&self, all: &Numbered<T>, set: Scoped<'_, '_>) -> Result<Members<T>> {
        if set.has("GENERATE") {
            return generated(set, &all.known).map(Ok);
        }
        let mut items = Vec::new();
        let entries = set.rows().flat_map(Row::entries).filter(|(_, field)| !field.is_empty());
        for (row, field) in entries {
            let Some(found) = self.entry(all, row, field)? else {
                return Ok(Err((row.place, field.to_owned())));
            };
            let taken = self.budget.borrow_mut().take_members(found.len());
            taken.map_err(|refusal| row.error(refusal.to_string()))?;
            items.extend(found);
        }
        Ok(Ok(items))
    }

    /// What an entry means, a number or the name of a set, those that are not used left out.
    pub(super) fn entry<T: Copy>(&self, all: &Numbered<T>, at: Row<'_>, field: &str) -> Entry<T> {
        let (there, name) = self.resolved(at.scope, field);
        let Ok(label) = name.parse::<usize>() else {
            let set = all.sets.get(&self.key(at.scope, field));
            return Ok(set.map(|set| set.items.clone()));
        };
        let item = all.known.get(&(there, label)).copied();
        ensure!(item.is_some() || all.skipped.contains(&(there, label)); at;
            "no {} has the number {}", all.what, quoted(field));
        Ok(Some(item.into_iter().collect()))
    }

    /// What an entry means where a set of its name must be known.
    pub(super) fn items<T: Copy>(
        &self,
        all: &Numbered<T>,
        row: Row<'_>,
        field: &str,
    ) -> Result<Vec<T>> {
        let found = self.entry(all, row, field)?;
        found.ok_or_else(|| self.unknown(row.place, &format!("{} set", all.what), field))
    }
}

/// Items with the numbers first, first + step, ... up to last of each line; numbers without an item are passed over.
fn generated<T: Copy>(set: Scoped<'_, '_>, known: &HashMap<(usize, usize), T>) -> Result<Vec<T>> {
    let mut items = Vec::new();
    for row in set.rows() {
        let numbers: Option<Vec<usize>> = row.fields().map(|f| f.parse().ok()).collect();
        let (first, last, step) = match numbers.as_deref() {
            Some(&[first, last]) => (first, last, 1),
            Some(&[first, last, step]) => (first, last, step),
            _ => (1, 0, 0),
        };
        ensure!(step > 0 && first <= last; row;
            "first, last and step of a generated set expected, found {}", quoted(row.line));
        // No more work than there are items, whatever the numbers say.
        if (last - first) / step < known.len() {
            let labels = (first..=last).step_by(step);
            items.extend(labels.filter_map(|label| known.get(&(row.scope, label))).copied());
        } else {
            let is_meant = |scope: usize, label: usize| {
                scope == row.scope
                    && (first..=last).contains(&label)
                    && (label - first).is_multiple_of(step)
            };
            let own = known.iter().filter(|((scope, label), _)| is_meant(*scope, *label));
            let mut own: Vec<(usize, T)> = own.map(|(&(_, label), &item)| (label, item)).collect();
            own.sort_unstable_by_key(|item| item.0);
            items.extend(own.into_iter().map(|item| item.1));
        }
    }
    Ok(items)
}
