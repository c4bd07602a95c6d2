//! Groups of a universal file: regions, surfaces, sets of nodes.

use super::{ELEMENT, Entity, Group, NODE, Reader};
use crate::SurfaceFace;
use crate::file_mesh::Result;
use std::collections::HashMap;
use std::sync::Arc;

impl Reader<'_, '_> {
    pub(super) fn groups(&mut self, dataset: usize) -> Result<()> {
        while let Some(head) = self.inner()? {
            let numbers = self.ints(head)?;
            let count = self.must(numbers.last().copied())?;
            let next = self.inner()?;
            let name = self.must(next)?.1.trim();
            let name = match name {
                "" => format!("group_{}", numbers.first().copied().unwrap_or(0)),
                name => name.to_owned(),
            };
            // Each entity has its type and number; newer datasets add two more fields.
            let width = if matches!(dataset, 2417 | 752) { 2 } else { 4 };
            let mut items = Vec::new();
            while items.len() < count {
                let next = self.inner()?;
                let line = self.must(next)?;
                let numbers = self.ints(line)?;
                let before = items.len();
                let entities = numbers.chunks(width).filter(|entity| entity.len() == width);
                items.extend(entities.map(|entity| (entity[0], entity[1])));
                if items.len() == before {
                    refuse!(self.deck, line.0; "entities of group {name} expected");
                }
            }
            self.groups.push(Group { name, items, place: head.0 });
        }
        Ok(())
    }

    /// Makes a region, a surface or a set of nodes of a group.
    pub(super) fn group(
        &mut self,
        group: &Group,
        outer: &HashMap<Vec<u32>, SurfaceFace>,
    ) -> Result<()> {
        let region: Arc<str> = group.name.as_str().into();
        let (mut nodes, mut faces, mut lost) = (Vec::new(), Vec::new(), 0);
        let mut is_region = false;
        for &(kind, number) in &group.items {
            let missing = |what: &str| {
                fault!(self.deck, group.place;
                "group {} names {what} {number}, which the file does not have", group.name)
            };
            match kind {
                NODE => nodes.push(*self.nodes.get(&number).ok_or_else(|| missing("node"))?),
                ELEMENT => match self.entities.get(&number).ok_or_else(|| missing("element"))? {
                    Entity::Element(place) => {
                        is_region = true;
                        if self.is_grouped.insert(*place) {
                            self.collected[*place].region = Some(Arc::clone(&region));
                        }
                    }
                    Entity::Skin(corners) => match outer.get(corners) {
                        Some(face) => faces.push(face.clone()),
                        None => lost += 1,
                    },
                },
                _ => lost += 1,
            }
        }
        if lost > 0 {
            let keyword = format!("{lost} entities of group {}", group.name);
            let reason = "no nodes, solid elements or shells on the outside";
            self.file.model.leave_out(&keyword, || self.deck.name(group.place), (reason, false));
        }
        if !faces.is_empty() {
            self.file.surfaces.entry(group.name.clone()).or_default().extend(faces);
        } else if !is_region && !nodes.is_empty() {
            self.file.node_sets.entry(group.name.clone()).or_default().extend(nodes);
        }
        Ok(())
    }
}
