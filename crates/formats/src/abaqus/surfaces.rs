//! `*SURFACE`, and node sets as boundaries.

use super::Reader;
use super::block::{Row, Scoped};
use crate::prelude::*;

impl Reader<'_, '_> {
    /// Reads all surfaces: faces of elements, and sets of nodes.
    pub(super) fn read_surfaces(&mut self) -> Result<()> {
        for block in self.blocks_of("SURFACE") {
            let name = block.required("NAME")?;
            let (key, full) = self.named(block.scope, name);
            let kind = block.parameter("TYPE").unwrap_or("ELEMENT").to_uppercase();
            match kind.as_str() {
                "ELEMENT" => {
                    ensure!(!block.has("COMBINE") && !block.has("CROP"); block;
                        "*SURFACE with COMBINE or CROP is not supported: list its faces");
                    let faces = self.element_faces(block)?;
                    if faces.is_empty() {
                        let reason = "it has no face of a solid (plane) element";
                        self.leave_out(&format!("*SURFACE, NAME={name}"), block.place, reason);
                        self.surfaces.entry(key).or_default();
                        continue;
                    }
                    self.file.surfaces.entry(full.clone()).or_default().extend(faces);
                }
                "NODE" => {
                    let nodes = self.surface_nodes(block)?;
                    self.file.node_sets.entry(full.clone()).or_default().extend(nodes);
                }
                _ => {
                    let keyword = format!("*SURFACE, NAME={name}, TYPE={kind}");
                    let reason = "a rigid surface: model it by elements, or take a rigid counterface of the case";
                    self.leave_out(&keyword, block.place, reason);
                    self.surfaces.entry(key).or_default();
                    continue;
                }
            }
            self.surfaces.insert(key, Some(full));
        }
        Ok(())
    }

    fn surface_nodes(&self, block: Scoped<'_, '_>) -> Result<Vec<u32>> {
        let nodes = block.rows().map(|row| self.items(&self.nodes, row, row.field(0)));
        Ok(nodes.collect::<Result<Vec<_>>>()?.concat())
    }

    fn element_faces(&self, block: Scoped<'_, '_>) -> Result<Vec<SurfaceFace>> {
        let mut faces = Vec::new();
        for row in block.rows() {
            let elements = match row.field(0) {
                "" => (0..self.file.elements.len()).collect(),
                set => self.items(&self.elements, row, set)?,
            };
            match row.field(1).to_uppercase().as_str() {
                "" | "SPOS" | "SNEG" if elements.is_empty() => {}
                "" => faces.extend(free_faces(&self.file.elements, &elements)),
                side => {
                    for &element in &elements {
                        faces.push(self.side(element, side, row)?);
                    }
                }
            }
        }
        Ok(faces)
    }

    /// Face `S<number>` of an element (`P<number>` in loads).
    pub(super) fn side(&self, element: usize, side: &str, row: Row<'_>) -> Result<SurfaceFace> {
        let element = &self.file.elements[element];
        let number = side.strip_prefix(['S', 'P']).and_then(|n| n.parse::<usize>().ok());
        let face = number.and_then(|number| element.faces().nth(number.checked_sub(1)?));
        Ok(found!(face; row;
            "element {} ({}) has no face {}", element.label, element.kind.name(), quoted(side)))
    }

    /// Keeps sets of nodes that the user named as boundaries, where no surface has their name.
    pub(super) fn keep_node_sets(&mut self) {
        let total = self.file.points.len();
        for set in self.nodes.sets.values() {
            let is_kept = !set.is_internal && !set.items.is_empty() && set.items.len() < total;
            if is_kept && !self.file.surfaces.contains_key(&set.name) {
                let kept = self.file.node_sets.entry(set.name.clone());
                kept.or_insert_with(|| set.items.clone());
            }
        }
    }
}
