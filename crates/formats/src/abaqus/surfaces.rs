//! `*SURFACE`, and node sets as boundaries.

use super::Reader;
use super::block::{Block, fields};
use crate::SurfaceFace;
use crate::collection::free_faces;
use crate::deck::{Place, quoted};
use crate::file_mesh::Result;

impl Reader<'_, '_> {
    /// Reads all surfaces: faces of elements, and sets of nodes.
    pub(super) fn read_surfaces(&mut self) -> Result<()> {
        for (scope, block) in self.blocks_of("SURFACE") {
            let name = block.required("NAME")?.to_owned();
            let key = self.key(scope, &name);
            let full = self.scopes[key.0].full_name(&name);
            let kind = block.parameter("TYPE").unwrap_or("ELEMENT").to_uppercase();
            match kind.as_str() {
                "ELEMENT" => {
                    if block.has("COMBINE") || block.has("CROP") {
                        refuse!(block;
                            "*SURFACE with COMBINE or CROP is not supported: list its faces");
                    }
                    let faces = self.element_faces(scope, block)?;
                    if faces.is_empty() {
                        let keyword = format!("*SURFACE, NAME={name}");
                        let reason = "it has no face of a solid (plane) element";
                        self.leave_out(&keyword, block.place, reason);
                        continue;
                    }
                    self.file.surfaces.entry(full.clone()).or_default().extend(faces);
                }
                "NODE" => {
                    let nodes = self.surface_nodes(scope, block)?;
                    self.file.node_sets.entry(full.clone()).or_default().extend(nodes);
                }
                _ => {
                    let keyword = format!("*SURFACE, NAME={name}, TYPE={kind}");
                    let reason = "a rigid surface: model it by elements, or take a rigid counterface of the case";
                    self.leave_out(&keyword, block.place, reason);
                    continue;
                }
            }
            self.surfaces.insert(key, full);
        }
        Ok(())
    }

    fn surface_nodes(&self, scope: usize, block: &Block<'_>) -> Result<Vec<u32>> {
        let mut nodes = Vec::new();
        for &(place, line) in &block.data {
            let field = fields(line).next().unwrap_or_default();
            nodes.extend(self.items(&self.nodes, scope, place, field)?);
        }
        Ok(nodes)
    }

    fn element_faces(&mut self, scope: usize, block: &Block<'_>) -> Result<Vec<SurfaceFace>> {
        let mut faces = Vec::new();
        for &(place, line) in &block.data {
            let mut entry = fields(line);
            let set = entry.next().unwrap_or_default();
            let side = entry.next().unwrap_or_default().to_uppercase();
            let elements = match set {
                "" => (0..self.collected.len()).collect(),
                _ => self.items(&self.elements, scope, place, set)?,
            };
            match side.as_str() {
                "" if elements.is_empty() => {}
                "" => faces.extend(free_faces(&self.collected, &elements)),
                "SPOS" | "SNEG" if elements.is_empty() => {}
                _ => {
                    for &element in &elements {
                        faces.push(self.side(element, &side, place)?);
                    }
                }
            }
        }
        Ok(faces)
    }

    /// Face `S<number>` of an element (`P<number>` in loads).
    pub(super) fn side(&self, element: usize, side: &str, place: Place) -> Result<SurfaceFace> {
        let element = &self.collected[element];
        let number = side.strip_prefix(['S', 'P']).and_then(|n| n.parse::<usize>().ok());
        let face = number.and_then(|number| element.faces().nth(number.checked_sub(1)?));
        face.ok_or_else(|| {
            fault!(self.deck, place;
            "element {} ({}) has no face {}", element.label, element.kind.name(), quoted(side))
        })
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
