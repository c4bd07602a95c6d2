//! Entities, nodes and elements of MSH 4.1.

use super::{Reader, Result};

/// Physical groups that one entity may belong to: every element of it is kept in each.
const MOST_GROUPS: usize = 64;

impl Reader<'_> {
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
                if groups > MOST_GROUPS {
                    refuse!(self.cursor; "an entity in {groups} physical groups is not valid");
                }
                let groups: Result<Vec<i64>, _> =
                    (0..groups).map(|_| self.cursor.int("physical tag")).collect();
                // A negative tag says that the entity is reversed in its group.
                let groups = groups?.into_iter().map(i64::abs).collect();
                self.physical.insert((dimension as i64, tag), groups);
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
            let labels: Result<Vec<usize>, _> =
                (0..count).map(|_| self.cursor.size("node number")).collect();
            for label in labels? {
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
                let nodes: Result<Vec<usize>, _> =
                    (0..node_count).map(|_| self.cursor.size("node number")).collect();
                self.element(kind, (label, entity), &groups, &nodes?)?;
            }
        }
        Ok(())
    }
}
