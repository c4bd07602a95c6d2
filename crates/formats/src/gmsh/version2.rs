//! Nodes and elements of MSH 2.2.

use super::{Reader, Result};

impl Reader<'_> {
    pub(super) fn nodes_2(&mut self) -> Result<()> {
        let count = self.cursor.text_count("nodes", 8)?;
        for _ in 0..count {
            let label = self.node_number()?;
            self.node(label)?;
        }
        Ok(())
    }

    pub(super) fn elements_2(&mut self) -> Result<()> {
        let count = self.cursor.text_count("elements", 6)?;
        let mut read = 0;
        while read < count {
            // A binary file groups elements of one type under a header; text has one header for each.
            let (kind, group, tags, label) = if self.cursor.is_binary {
                let kind = self.cursor.int("element type")?;
                let group = self.cursor.int("number of elements")?;
                (kind, group, self.cursor.int("number of tags")?, None)
            } else {
                let label = self.cursor.int("element number")?;
                let kind = self.cursor.int("element type")?;
                (kind, 1, self.cursor.int("number of tags")?, Some(label))
            };
            if group < 1 || group > (count - read) as i64 || !(0..=64).contains(&tags) {
                refuse!(self.cursor; "a group of {group} elements with {tags} tags is not valid here");
            }
            for _ in 0..group {
                let label = match label {
                    Some(label) => label,
                    None => self.cursor.int("element number")?,
                };
                self.element_2(kind, label.unsigned_abs() as usize, tags)?;
                read += 1;
            }
        }
        Ok(())
    }

    fn element_2(&mut self, kind: i64, label: usize, tags: i64) -> Result<()> {
        let tags = (0..tags).map(|_| self.cursor.int("tag")).collect::<Result<Vec<i64>>>()?;
        let (node_count, kind) = self.shape_of(kind, label)?;
        let nodes: Result<Vec<usize>, _> = (0..node_count).map(|_| self.node_number()).collect();
        // The first tag is the physical group, 0 for none; the second the entity.
        let physical: Vec<i64> =
            tags.first().copied().filter(|&tag| tag != 0).into_iter().collect();
        let entity = tags.get(1).copied().unwrap_or(0);
        self.element(kind, (label, entity), &physical, &nodes?)
    }

    fn node_number(&mut self) -> Result<usize> {
        let number = self.cursor.int("node number")?;
        usize::try_from(number)
            .ok()
            .filter(|&number| number > 0)
            .ok_or_else(|| self.cursor.error(format!("node number {number} is not positive")))
    }
}
