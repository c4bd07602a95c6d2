//! Reader of universal files: nodes (datasets 2411, 781, 15), elements (2412), groups (2467, 2477 and their forerunners).
//!
//! A region is a group of solid elements, a surface a group of shells that cover faces of solids or of nodes. Nodes of quadratic
//! elements run around each face from corner to middle to corner. In a plane file groups of beams are curves.
//!
//! Source: Siemens SDRC, universal file format, datasets 164, 2411, 2412, 2467.

mod groups;
mod nodes;

pub use nodes::{universal_fields, universal_node};

use super::ElementKind;
use super::collection::{CollectedElement, dimension, finished, outer_faces, sorted};
use super::deck::{Deck, Place, quoted, real};
use super::file_mesh::{FileMesh, Result};
use std::collections::{BTreeSet, HashMap};

/// Datasets of groups, by the entities that one line lists.
const GROUPS: [usize; 9] = [2417, 2429, 2430, 2432, 2435, 2452, 2467, 2477, 752];

/// Datasets of constraints and loads, which are not read.
const PARTS: [&str; 6] = ["754", "755", "757", "782", "790", "791"];

/// Elements that join nodes: rigid ones, springs, dampers, gaps and masses.
const JOINTS: std::ops::Range<usize> = 121..200;

/// Types of entities in groups.
const NODE: usize = 7;
const ELEMENT: usize = 8;

/// What an element of the file is here.
#[derive(Clone, Debug)]
enum Entity {
    Element(usize),
    /// A shell or a beam by its corners, ascending.
    Skin(Vec<u32>),
}

struct Reader<'d, 'a> {
    deck: &'d Deck<'a>,
    /// Position of the next line.
    at: usize,
    file: FileMesh,
    collected: Vec<CollectedElement>,
    nodes: HashMap<usize, u32>,
    entities: HashMap<usize, Entity>,
    /// Elements whose first group is known.
    is_grouped: BTreeSet<usize>,
    groups: Vec<Group>,
}

/// A group with its entities: type, number and place of each.
struct Group {
    name: String,
    items: Vec<(usize, usize)>,
    place: Place,
}

/// Reads a universal file.
pub(super) fn read(bytes: &[u8]) -> Result<FileMesh> {
    let text = String::from_utf8_lossy(bytes);
    let deck = Deck::new(&text, "\0", true)?;
    let mut reader = Reader {
        deck: &deck,
        at: 0,
        file: FileMesh::default(),
        collected: Vec::new(),
        nodes: HashMap::new(),
        entities: HashMap::new(),
        is_grouped: BTreeSet::new(),
        groups: Vec::new(),
    };
    reader.datasets()?;
    let has_solids = dimension(&reader.collected) == 3;
    if reader.collected.is_empty() {
        refuse!(deck, deck.end(); "the file has no solid or plane elements (dataset 2412)");
    }
    if has_solids {
        reader.shells_to_skins();
    }
    let outer = outer_faces(&reader.collected);
    for group in std::mem::take(&mut reader.groups) {
        reader.group(&group, &outer)?;
    }
    Ok(finished(reader.file, reader.collected))
}

impl<'a> Reader<'_, 'a> {
    fn line(&mut self) -> Option<(Place, &'a str)> {
        let line = self.deck.lines.get(self.at).copied();
        self.at += 1;
        line
    }

    /// The next line inside a dataset; none at its end.
    fn inner(&mut self) -> Result<Option<(Place, &'a str)>> {
        match self.line() {
            Some((_, line)) if line.trim() == "-1" => Ok(None),
            Some(line) => Ok(Some(line)),
            None => Err(fault!(self.deck, self.deck.end();
                "the file ends inside a dataset: it is truncated (-1 expected)")),
        }
    }

    /// Whole numbers of a line.
    fn ints(&self, (place, line): (Place, &str)) -> Result<Vec<usize>> {
        let numbers = line.split_whitespace().map(|word| {
            let number = word.parse::<i64>().ok();
            // Colours and tags may be negative; they are not used.
            number.map(|n| usize::try_from(n).unwrap_or(0)).ok_or_else(
                || fault!(self.deck, place; "whole numbers expected, found {}", quoted(word)),
            )
        });
        numbers.collect()
    }

    fn must<T>(&self, value: Option<T>) -> Result<T> {
        let place = self.deck.lines.get(self.at.saturating_sub(1)).map_or(self.deck.end(), |l| l.0);
        value.ok_or_else(|| self.deck.error(place, "the dataset is too short here"))
    }

    fn datasets(&mut self) -> Result<()> {
        while let Some((place, line)) = self.line() {
            if line.trim().is_empty() {
                continue;
            }
            if line.trim() != "-1" {
                refuse!(self.deck, place;
                    "-1, which begins a dataset, expected, found {}", quoted(line));
            }
            let Some((place, number)) = self.line() else {
                break;
            };
            let number = number.trim();
            match number.parse::<usize>() {
                Ok(15) => self.nodes(1)?,
                Ok(781 | 2411) => self.nodes(2)?,
                Ok(2412) => self.elements()?,
                Ok(number) if GROUPS.contains(&number) => self.groups(number)?,
                Ok(164) => self.units()?,
                _ => {
                    let shown: String = number.chars().take(20).collect();
                    let keyword = format!("dataset {shown}");
                    let is_part = PARTS.contains(&number);
                    self.file.model.leave_out(&keyword, || self.deck.name(place), ("", is_part));
                    while self.inner()?.is_some() {}
                }
            }
        }
        Ok(())
    }

    /// Dataset 164: units, whose factor of lengths is said where it is not 1.
    fn units(&mut self) -> Result<()> {
        let _ = self.inner()?;
        if let Some((_, line)) = self.inner()? {
            let factor = line.split_whitespace().next().and_then(real);
            if let Some(factor) = factor.filter(|factor| *factor != 1.0) {
                self.file.model.remarks.push(format!(
                    "the file says that its lengths are to be divided by {factor} for metres (dataset 164): mesh.scale does that"
                ));
            }
        }
        while self.inner()?.is_some() {}
        Ok(())
    }

    /// Nodes, one line for each or two.
    fn nodes(&mut self, lines: usize) -> Result<()> {
        while let Some(first) = self.inner()? {
            let next = if lines == 1 { Some(first) } else { self.inner()? };
            let (place, last) = self.must(next)?;
            let node = universal_node(&[first.1, last][2 - lines..]);
            let (label, point) = node.map_err(|problem| self.deck.error(place, problem))?;
            let next = self.file.points.len() as u32;
            if self.nodes.insert(label, next).is_some() {
                refuse!(self.deck, place; "node {label} is given twice");
            }
            self.file.points.push(point);
            self.file.labels.push(label);
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<()> {
        while let Some(head) = self.inner()? {
            let numbers = self.ints(head)?;
            let (Some(&label), Some(&descriptor), Some(&count)) =
                (numbers.first(), numbers.get(1), numbers.get(5))
            else {
                refuse!(self.deck, head.0; "six numbers of an element expected");
            };
            // Beams have a line for their orientation and ends.
            if (11..=32).contains(&descriptor) {
                let _ = self.inner()?;
            }
            let mut nodes = Vec::new();
            while nodes.len() < count {
                let next = self.inner()?;
                let line = self.must(next)?;
                let numbers = self.ints(line)?;
                if numbers.is_empty() {
                    refuse!(self.deck, line.0; "nodes of element {label} expected");
                }
                for node in numbers {
                    let known = self.nodes.get(&node).copied();
                    nodes.push(known.ok_or_else(|| {
                        fault!(self.deck, line.0;
                        "element {label} names node {node}, which the file does not have")
                    })?);
                }
            }
            self.element(head.0, (label, descriptor), &nodes)?;
        }
        Ok(())
    }

    fn element(
        &mut self,
        place: Place,
        (label, descriptor): (usize, usize),
        nodes: &[u32],
    ) -> Result<()> {
        let entity = match ElementKind::listed(|row| row.universal.names.contains(&descriptor)) {
            Some(kind) => {
                if nodes.len() != kind.node_count() {
                    refuse!(self.deck, place;
                        "element {label} has {} nodes, its kind {descriptor} ({}) has {}",
                        nodes.len(), kind.name(), kind.node_count());
                }
                self.collected.push(CollectedElement {
                    label,
                    kind,
                    nodes: kind.row().universal.arranged(nodes),
                    region: None,
                });
                Entity::Element(self.collected.len() - 1)
            }
            None if (11..=32).contains(&descriptor) && nodes.len() >= 2 => {
                Entity::Skin(sorted(nodes))
            }
            None if (101..121).contains(&descriptor) => {
                refuse!(self.deck, place;
                    "element {label} is of kind {descriptor}, which is not supported: tetrahedra, \
                     bricks and wedges are");
            }
            None => {
                let keyword = format!("elements of kind {descriptor}");
                let reason = ("no solid or plane elements", JOINTS.contains(&descriptor));
                self.file.model.leave_out(&keyword, || self.deck.name(place), reason);
                Entity::Skin(Vec::new())
            }
        };
        if self.entities.insert(label, entity).is_some() {
            refuse!(self.deck, place; "element {label} is given twice");
        }
        Ok(())
    }

    /// Beside solids, shells are faces only.
    fn shells_to_skins(&mut self) {
        let mut moved = HashMap::new();
        let mut kept = Vec::new();
        for (place, element) in std::mem::take(&mut self.collected).into_iter().enumerate() {
            if element.kind.dimension() == 3 {
                moved.insert(place, kept.len());
                kept.push(element);
            } else {
                let corners = sorted(&element.nodes[..element.kind.corner_count()]);
                self.entities.insert(element.label, Entity::Skin(corners));
            }
        }
        self.collected = kept;
        for entity in self.entities.values_mut() {
            if let Entity::Element(place) = entity {
                *place = moved.get(place).copied().unwrap_or(*place);
            }
        }
    }
}
