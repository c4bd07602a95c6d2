//! Entities, nodes and elements of MSH 2.2 and 4.1.

use super::Reader;
use crate::prelude::*;

/// Physical groups that one entity may belong to: every element of it is kept in each.
const MOST_GROUPS: usize = 64;

impl Reader<'_> {
    pub(super) fn nodes_2(&mut self) -> Result<()> {
        for _ in 0..self.cursor.text_count("nodes", 8)? {
            let label = self.node_number()?;
            self.node(label)?;
        }
        Ok(())
    }

    pub(super) fn elements_2(&mut self) -> Result<()> {
        let count = self.cursor.text_count("elements", 6)?;
        let is_binary = self.cursor.is_binary;
        let mut read = 0;
        while read < count {
            // A binary file groups elements of one type under a header; text has one header for each.
            let label = (!is_binary).then(|| self.cursor.int("element number")).transpose()?;
            let kind = self.cursor.int("element type")?;
            let group = if is_binary { self.cursor.int("number of elements")? } else { 1 };
            let tags = self.cursor.int("number of tags")?;
            let is_right = (1..=(count - read) as i64).contains(&group) && (0..=64).contains(&tags);
            ensure!(is_right; self.cursor; "a group of {group} elements with {tags} tags is not valid here");
            for _ in 0..group {
                let label = match label {
                    Some(label) => label,
                    None => self.cursor.int("element number")?,
                };
                self.element_2(kind, label.unsigned_abs() as usize, tags as usize)?;
                read += 1;
            }
        }
        Ok(())
    }

    fn element_2(&mut self, kind: i64, label: usize, tags: usize) -> Result<()> {
        let tags = self.cursor.ints(tags, "tag")?;
        let (node_count, kind) = self.shape_of(kind, label)?;
        let nodes: Result<Vec<usize>> = (0..node_count).map(|_| self.node_number()).collect();
        // The first tag is the physical group, 0 for none; the second the entity.
        let physical: Vec<i64> =
            tags.first().copied().filter(|&tag| tag != 0).into_iter().collect();
        let entity = tags.get(1).copied().unwrap_or(0);
        self.element(kind, (label, entity), &physical, &nodes?)
    }

    fn node_number(&mut self) -> Result<usize> {
        let number = self.cursor.int("node number")?;
        let known = usize::try_from(number).ok().filter(|&number| number > 0);
        Ok(found!(known; self.cursor; "node number {number} is not positive"))
    }

    pub(super) fn entities(&mut self) -> Result<()> {
        let mut counts = [0; 4];
        for (count, what) in counts.iter_mut().zip(["points", "curves", "surfaces", "volumes"]) {
            *count = self.cursor.count(what, 8)?;
        }
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let tag = self.cursor.int("entity tag")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    self.cursor.number("bound")?;
                }
                let groups = self.cursor.count("physical tags", 2)?;
                ensure!(groups <= MOST_GROUPS; self.cursor; "an entity in {groups} physical groups is not valid");
                // A negative tag says that the entity is reversed in its group.
                let groups = self.cursor.ints(groups, "physical tag")?.into_iter().map(i64::abs);
                self.physical.insert((dimension as i64, tag), groups.collect());
                if dimension > 0 {
                    for _ in 0..self.cursor.count("bounding entities", 2)? {
                        self.cursor.int("bounding entity")?;
                    }
                }
            }
        }
        Ok(())
    }

    pub(super) fn nodes_4(&mut self) -> Result<()> {
        let blocks = self.cursor.count("node blocks", 6)?;
        for what in ["nodes", "smallest node", "largest node"] {
            self.cursor.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = self.cursor.int("entity dimension")?;
            self.cursor.int("entity tag")?;
            let is_parametric = self.cursor.int("parametric flag")? != 0;
            let count = self.cursor.count("nodes of a block", 8)?;
            for label in self.cursor.sizes(count, "node number")? {
                self.node(label)?;
                if is_parametric {
                    for _ in 0..dimension.clamp(0, 3) {
                        self.cursor.number("parameter")?;
                    }
                }
            }
        }
        Ok(())
    }

    pub(super) fn elements_4(&mut self) -> Result<()> {
        let blocks = self.cursor.count("element blocks", 8)?;
        for what in ["elements", "smallest element", "largest element"] {
            self.cursor.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = self.cursor.int("entity dimension")?;
            let entity = self.cursor.int("entity tag")?;
            let kind = self.cursor.int("element type")?;
            let count = self.cursor.count("elements of a block", 4)?;
            let groups = self.physical.get(&(dimension, entity)).cloned().unwrap_or_default();
            for _ in 0..count {
                let label = self.cursor.size("element number")?;
                let (node_count, kind) = self.shape_of(kind, label)?;
                let nodes = self.cursor.sizes(node_count, "node number")?;
                self.element(kind, (label, entity), &groups, &nodes)?;
            }
        }
        Ok(())
    }
}
