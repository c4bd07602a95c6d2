//! Reader of universal files: nodes (datasets 2411, 781, 15), elements (2412), groups (2467, 2477 and their forerunners).
//!
//! A region is a group of solid elements, a surface a group of shells that cover faces of solids or of nodes. Nodes of quadratic
//! elements run around each face from corner to middle to corner. In a plane file groups of beams are curves.
//!
//! Source: Siemens SDRC, universal file format, datasets 164, 2411, 2412, 2467.

use crate::prelude::*;
use std::ops::{Range, RangeInclusive};

/// Datasets of groups.
const GROUPS: [usize; 9] = [2417, 2429, 2430, 2432, 2435, 2452, 2467, 2477, 752];

/// Datasets of constraints and loads, which are not read.
const PARTS: [&str; 6] = ["754", "755", "757", "782", "790", "791"];

/// Beams, which have a line for their orientation and ends.
const BEAMS: RangeInclusive<usize> = 11..=32;

/// Elements that join nodes: rigid ones, springs, dampers, gaps and masses.
const JOINTS: Range<usize> = 121..200;

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
        nodes: HashMap::new(),
        entities: HashMap::new(),
        is_grouped: BTreeSet::new(),
        groups: Vec::new(),
    };
    reader.datasets()?;
    ensure!(!reader.file.elements.is_empty(); deck, deck.end();
        "the file has no solid or plane elements (dataset 2412)");
    if dimension(&reader.file.elements) == 3 {
        reader.shells_to_skins();
    }
    let outer = outer_faces(&reader.file.elements);
    for group in std::mem::take(&mut reader.groups) {
        reader.group(&group, &outer)?;
    }
    Ok(finished(reader.file))
}

impl<'a> Reader<'_, 'a> {
    fn line(&mut self) -> Option<(Place, &'a str)> {
        let line = self.deck.lines.get(self.at).copied();
        self.at += 1;
        line
    }

    /// The next line inside a dataset; none at its end.
    fn inner(&mut self) -> Result<Option<(Place, &'a str)>> {
        let line = found!(self.line(); self.deck, self.deck.end();
            "the file ends inside a dataset: it is truncated (-1 expected)");
        Ok((line.1.trim() != "-1").then_some(line))
    }

    /// The next line inside a dataset that must have one.
    fn inside(&mut self) -> Result<(Place, &'a str)> {
        let line = self.inner()?;
        Ok(found!(line; self.deck, self.deck.lines[self.at - 1].0; "the dataset is too short here"))
    }

    /// Whole numbers of a line.
    fn ints(&self, (place, line): (Place, &str)) -> Result<Vec<usize>> {
        let number = |word: &str| {
            let number = found!(word.parse::<i64>().ok(); self.deck, place;
                "whole numbers expected, found {}", quoted(word));
            // Colours and tags may be negative; they are not used.
            Ok(usize::try_from(number).unwrap_or(0))
        };
        line.split_whitespace().map(number).collect()
    }

    fn datasets(&mut self) -> Result<()> {
        while let Some((place, line)) = self.line() {
            if line.trim().is_empty() {
                continue;
            }
            ensure!(line.trim() == "-1"; self.deck, place;
                "-1, which begins a dataset, expected, found {}", quoted(line));
            let Some((place, number)) = self.line() else { break };
            let number = number.trim();
            match number.parse::<usize>() {
                Ok(15) => self.nodes(1)?,
                Ok(781 | 2411) => self.nodes(2)?,
                Ok(2412) => self.elements()?,
                Ok(number) if GROUPS.contains(&number) => self.groups(number)?,
                Ok(164) => self.units()?,
                _ => {
                    let shown: String = number.chars().take(20).collect();
                    let reason = ("", PARTS.contains(&number));
                    self.leave_out(&format!("dataset {shown}"), place, reason);
                    while self.inner()?.is_some() {}
                }
            }
        }
        Ok(())
    }

    /// Notes what is not used, and whether it would hold, load or join parts.
    fn leave_out(&mut self, keyword: &str, place: Place, reason: (&str, bool)) {
        self.file.model.leave_out(keyword, || self.deck.name(place), reason);
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
            let (place, last) = if lines == 1 { first } else { self.inside()? };
            let node = universal_node(&[first.1, last][2 - lines..]);
            let (label, point) = node.map_err(|problem| self.deck.error(place, problem))?;
            let known = self.nodes.insert(label, self.file.points.len() as u32);
            ensure!(known.is_none(); self.deck, place; "node {label} is given twice");
            self.file.points.push(point);
            self.file.labels.push(label);
        }
        Ok(())
    }

    fn elements(&mut self) -> Result<()> {
        while let Some(head) = self.inner()? {
            let numbers = self.ints(head)?;
            let &[label, descriptor, _, _, _, count, ..] = numbers.as_slice() else {
                refuse!(self.deck, head.0; "six numbers of an element expected");
            };
            if BEAMS.contains(&descriptor) {
                self.inner()?;
            }
            let mut nodes = Vec::new();
            while nodes.len() < count {
                let line = self.inside()?;
                let numbers = self.ints(line)?;
                ensure!(!numbers.is_empty(); self.deck, line.0; "nodes of element {label} expected");
                for node in numbers {
                    nodes.push(*found!(self.nodes.get(&node); self.deck, line.0;
                        "element {label} names node {node}, which the file does not have"));
                }
            }
            self.element(head.0, (label, descriptor), &nodes)?;
        }
        Ok(())
    }

    fn element(&mut self, place: Place, of: (usize, usize), nodes: &[u32]) -> Result<()> {
        let (label, descriptor) = of;
        let entity = match ElementKind::listed(|row| row.universal.names.contains(&descriptor)) {
            Some(kind) => {
                ensure!(nodes.len() == kind.node_count(); self.deck, place;
                    "element {label} has {} nodes, its kind {descriptor} ({}) has {}",
                    nodes.len(), kind.name(), kind.node_count());
                let nodes = kind.row().universal.arranged(nodes);
                let region = Arc::default();
                self.file.elements.push(FileElement { label, kind, region, entity: 0, nodes });
                Entity::Element(self.file.elements.len() - 1)
            }
            None if BEAMS.contains(&descriptor) && nodes.len() >= 2 => Entity::Skin(sorted(nodes)),
            None if (101..121).contains(&descriptor) => refuse!(self.deck, place;
                "element {label} is of kind {descriptor}, which is not supported: tetrahedra, bricks and wedges are"),
            None => {
                let reason = ("no solid or plane elements", JOINTS.contains(&descriptor));
                self.leave_out(&format!("elements of kind {descriptor}"), place, reason);
                Entity::Skin(Vec::new())
            }
        };
        let known = self.entities.insert(label, entity);
        ensure!(known.is_none(); self.deck, place; "element {label} is given twice");
        Ok(())
    }

    /// Beside solids, shells are faces only.
    fn shells_to_skins(&mut self) {
        for element in std::mem::take(&mut self.file.elements) {
            let is_solid = element.kind.dimension() == 3;
            let entity = match is_solid {
                true => Entity::Element(self.file.elements.len()),
                false => Entity::Skin(sorted(&element.nodes[..element.kind.corner_count()])),
            };
            self.entities.insert(element.label, entity);
            self.file.elements.extend(is_solid.then_some(element));
        }
    }

    fn groups(&mut self, dataset: usize) -> Result<()> {
        while let Some(head) = self.inner()? {
            let numbers = self.ints(head)?;
            let (&[first, ..], &[.., count]) = (&numbers[..], &numbers[..]) else {
                refuse!(self.deck, head.0; "the dataset is too short here");
            };
            let name = match self.inside()?.1.trim() {
                "" => format!("group_{first}"),
                name => name.to_owned(),
            };
            // Each entity has its type and number; newer datasets add two more fields.
            let width = if matches!(dataset, 2417 | 752) { 2 } else { 4 };
            let mut items = Vec::new();
            while items.len() < count {
                let line = self.inside()?;
                let numbers = self.ints(line)?;
                ensure!(numbers.len() >= width; self.deck, line.0; "entities of group {name} expected");
                items.extend(numbers.chunks_exact(width).map(|entity| (entity[0], entity[1])));
            }
            self.groups.push(Group { name, items, place: head.0 });
        }
        Ok(())
    }

    /// Makes a region, a surface or a set of nodes of a group.
    fn group(&mut self, group: &Group, outer: &HashMap<Vec<u32>, SurfaceFace>) -> Result<()> {
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
                            self.file.elements[*place].region = Arc::clone(&region);
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
            self.leave_out(&keyword, group.place, (reason, false));
        }
        let name = group.name.clone();
        if !faces.is_empty() {
            self.file.surfaces.entry(name).or_default().extend(faces);
        } else if !is_region && !nodes.is_empty() {
            self.file.node_sets.entry(name).or_default().extend(nodes);
        }
        Ok(())
    }
}

/// A line whose numbers are apart, also where a sign is all that separated them: fields of a fixed width may touch.
#[must_use]
pub fn universal_fields(line: &str) -> String {
    let mut spread = String::with_capacity(line.len() + 8);
    let mut before = ' ';
    for c in line.chars() {
        if matches!(c, '-' | '+') && before.is_ascii_digit() {
            spread.push(' ');
        }
        spread.push(if matches!(c, 'd' | 'D') { 'E' } else { c });
        before = c;
    }
    spread
}

/// Label and place of a node by its lines: three numbers, behind the label and three others on a line of their own.
///
/// # Errors
/// What is missing, in words.
pub fn universal_node(lines: &[impl AsRef<str>]) -> Result<(usize, [f64; 3]), String> {
    let [first, last] = [lines.first(), lines.last()].map(|line| line.map_or("", AsRef::as_ref));
    let label = first.split_whitespace().next().unwrap_or_default();
    let Ok(label) = label.parse() else {
        return Err(format!("the number of a node expected, found {}", quoted(label)));
    };
    let before = if lines.len() == 1 { 4 } else { 0 };
    let fields = universal_fields(last);
    let mut words = fields.split_whitespace().skip(before);
    let place = [0; 3].map(|_| {
        let word = words.next().ok_or_else(|| format!("node {label} needs three coordinates"))?;
        real(word).ok_or_else(|| format!("a coordinate expected, found {}", quoted(word)))
    });
    let [x, y, z] = place;
    Ok((label, [x?, y?, z?]))
}
