//! `*NODE` and `*ELEMENT`.

use super::Reader;
use super::block::{Block, fields};
use super::element::{ElementType, element_type};
use crate::ElementKind;
use crate::collection::CollectedElement;
use crate::deck::{Place, quoted, real};
use crate::file_mesh::Result;
use std::sync::Arc;

impl Reader<'_, '_> {
    /// Scopes in the order in which their nodes are numbered: instances first.
    fn numbering(&self) -> Vec<usize> {
        (1..self.scopes.len()).chain([0]).collect()
    }

    fn label(&self, place: Place, field: &str, what: &str) -> Result<usize> {
        let number = field.trim().parse::<usize>().ok();
        number
            .filter(|&number| number > 0)
            .ok_or_else(|| fault!(self.deck, place; "{what} expected, found {}", quoted(field)))
    }

    /// Reads all nodes. Numbers of each instance follow those of the instances before.
    pub(super) fn read_nodes(&mut self) -> Result<()> {
        let mut offset = 0;
        for scope in self.numbering() {
            let mut largest = 0;
            for (_, block) in self.blocks_of("NODE").filter(|placed| placed.0 == scope) {
                if block.parameter("SYSTEM").is_some_and(|system| !system.eq_ignore_ascii_case("R"))
                {
                    refuse!(block;
                        "*NODE, SYSTEM= other than R is not supported: write Cartesian \
                         coordinates");
                }
                let first = self.file.points.len();
                for &(place, line) in &block.data {
                    let label = self.node(scope, place, line, offset)?;
                    largest = largest.max(label);
                }
                let items = (first..self.file.points.len()).map(|node| node as u32);
                self.nodes.add(self.named_by(scope, block, "NSET"), items.collect(), false);
            }
            if largest > 0 && offset > 0 && scope > 0 {
                self.file.model.remarks.push(format!(
                    "nodes of instance {} are numbered from {} on: its node 1 is {}",
                    self.scopes[scope].name,
                    offset + 1,
                    offset + 1
                ));
            }
            offset = offset.saturating_add(largest);
        }
        Ok(())
    }

    fn node(&mut self, scope: usize, place: Place, line: &str, offset: usize) -> Result<usize> {
        let mut fields = fields(line);
        let label = self.label(place, fields.next().unwrap_or_default(), "a node number")?;
        let mut point = [0.0; 3];
        for (coordinate, field) in point.iter_mut().zip(fields) {
            *coordinate = match field {
                "" => 0.0,
                _ => real(field).ok_or_else(
                    || fault!(self.deck, place; "a coordinate expected, found {}", quoted(field)),
                )?,
            };
        }
        let point = self.scopes[scope].place(point);
        let next = self.file.points.len() as u32;
        if let Some(&known) = self.nodes.known.get(&(scope, label)) {
            if self.file.points[known as usize] != point {
                refuse!(self.deck, place; "node {label} is given twice, at different places");
            }
            return Ok(label);
        }
        self.nodes.known.insert((scope, label), next);
        self.file.points.push(point);
        self.file.labels.push(label.saturating_add(offset));
        Ok(label)
    }

    /// Reads all elements; of types that have no counterpart here the numbers alone.
    pub(super) fn read_elements(&mut self) -> Result<()> {
        let types = self.blocks_of("ELEMENT").filter_map(|(_, block)| block.parameter("TYPE"));
        let known = types.filter_map(|name| element_type(&name.to_uppercase()));
        let dimension = known.map(|known| known.kind.dimension()).max();
        let mut offset = 0;
        for scope in self.numbering() {
            let mut largest = 0;
            for (_, block) in self.blocks_of("ELEMENT").filter(|placed| placed.0 == scope) {
                let name = block.required("TYPE")?.to_uppercase();
                let known = element_type(&name);
                if known.is_none()
                    && ["C3D", "CPE", "CPS"].iter().any(|solid| name.starts_with(solid))
                {
                    refuse!(block;
                        "elements of type {name} are not supported. Known are {} (C3D4, C3D10, \
                         C3D8, C3D20, C3D6, C3D15, C3D5, C3D13), and CPE and CPS with 3, 4, 6 or 8 \
                         nodes", ElementKind::SOLID_SHAPES);
                }
                let found = match known.filter(|known| Some(known.kind.dimension()) == dimension) {
                    Some(known) => self.element_block(scope, block, &known, offset)?,
                    None => self.skipped_block(scope, block, &name)?,
                };
                largest = largest.max(found);
            }
            offset = offset.saturating_add(largest);
        }
        Ok(())
    }

    /// Elements of a type that is not used.
    fn skipped_block(&mut self, scope: usize, block: &Block<'_>, name: &str) -> Result<usize> {
        let mut largest = 0;
        let mut goes_on = false;
        for &(place, line) in &block.data {
            let is_continued = std::mem::replace(&mut goes_on, line.trim_end().ends_with(','));
            if is_continued {
                continue;
            }
            let label = fields(line).next().unwrap_or_default();
            let label = self.label(place, label, "an element number")?;
            self.elements.skipped.insert((scope, label));
            largest = largest.max(label);
            let keyword = format!("*ELEMENT, TYPE={name}");
            let reason = "elements other than solids (of plane bodies CPE and CPS) are not used";
            self.leave_out(&keyword, place, reason);
        }
        self.elements.add(self.named_by(scope, block, "ELSET"), Vec::new(), false);
        Ok(largest)
    }

    /// Keeps what a type of elements says: what is different here, plane strain or plane stress.
    fn note_type(&mut self, block: &Block<'_>, name: &str, known: &ElementType) -> Result<()> {
        if !known.difference.is_empty() {
            let remark = format!("elements {name} are {}", known.difference);
            if !self.file.model.remarks.contains(&remark) {
                self.file.model.remarks.push(remark);
            }
        }
        if let Some(is_strain) = known.is_plane_strain {
            if self.file.model.is_plane_strain.is_some_and(|other| other != is_strain) {
                refuse!(block;
                    "elements of plane strain (CPE) and of plane stress (CPS) in one file");
            }
            self.file.model.is_plane_strain = Some(is_strain);
        }
        Ok(())
    }

    /// Elements of a type that is known; the largest number.
    fn element_block(
        &mut self,
        scope: usize,
        block: &Block<'_>,
        known: &ElementType,
        offset: usize,
    ) -> Result<usize> {
        let name = block.parameter("TYPE").unwrap_or_default().to_uppercase();
        self.note_type(block, &name, known)?;
        let region = block.parameter("ELSET");
        let region: Option<Arc<str>> = region.map(|name| self.scopes[scope].full_name(name).into());
        let first = self.collected.len();
        let count = 1 + known.kind.node_count();
        let mut largest = 0;
        let mut numbers = Vec::with_capacity(count);
        let mut start = block.place;
        for &(place, line) in &block.data {
            for field in fields(line) {
                if numbers.is_empty() {
                    start = place;
                }
                numbers.push(self.label(place, field, "the number of an element or node")?);
            }
            if numbers.len() > count {
                refuse!(self.deck, start;
                    "element {} has {} nodes, {name} has {}",
                    numbers[0], numbers.len() - 1, count - 1);
            }
            if numbers.len() == count {
                largest = largest.max(numbers[0]);
                self.element((scope, start), known, &numbers, (offset, region.as_ref()))?;
                numbers.clear();
            }
        }
        if let Some(label) = numbers.first() {
            refuse!(self.deck, start;
                "element {label} has too few nodes for {name}, which has {}", count - 1);
        }
        let items = (first..self.collected.len()).collect();
        self.elements.add(self.named_by(scope, block, "ELSET"), items, false);
        Ok(largest)
    }

    fn element(
        &mut self,
        (scope, place): (usize, Place),
        known: &ElementType,
        numbers: &[usize],
        (offset, region): (usize, Option<&Arc<str>>),
    ) -> Result<()> {
        let label = numbers[0];
        let mut nodes = Vec::with_capacity(numbers.len() - 1);
        for node in &numbers[1..] {
            let Some(&index) = self.nodes.known.get(&(scope, *node)) else {
                refuse!(self.deck, place;
                    "element {label} names node {node}, which the file does not have");
            };
            nodes.push(index);
        }
        let next = self.collected.len();
        if self.elements.known.insert((scope, label), next).is_some() {
            refuse!(self.deck, place; "element {label} is given twice");
        }
        self.collected.push(CollectedElement {
            label: label.saturating_add(offset),
            kind: known.kind,
            nodes,
            region: region.cloned(),
        });
        Ok(())
    }
}
