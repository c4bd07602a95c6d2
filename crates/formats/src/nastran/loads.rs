//! `SPC`, `SPC1` and `PLOAD4`: what holds and loads boundaries.

use super::Reader;
use super::card::Card;
use crate::prelude::*;

/// Sets of constraints or loads by their numbers.
type Sets = BTreeSet<usize>;

/// Nodes by set of constraints and directions.
type Held = BTreeMap<(usize, String), (BTreeSet<u32>, Place)>;

/// Faces under each pressure, in the order of the cards.
type Pressed = Vec<(f64, Vec<SurfaceFace>, Place)>;

impl Reader<'_, '_> {
    /// Sets that act: those that subcases name, with what they consist of; all where nothing is named and there is but one.
    fn active(&self, named: &[usize], known: Sets, combined: &'static str) -> Result<Option<Sets>> {
        let mut active: Sets = named.iter().copied().collect();
        for card in self.cards_of(combined) {
            if !active.remove(&card.number(0)?) {
                continue;
            }
            // LOAD has a factor before each set, and one before all.
            let step = if combined == "LOAD" { 2 } else { 1 };
            for factor in (step..card.fields.len()).step_by(step) {
                let set = factor + step - 1;
                if card.field(set).is_empty() {
                    continue;
                }
                let is_one = |field| Result::Ok(card.optional_real(field)? == Some(1.0));
                ensure!(step == 1 || is_one(1)? && is_one(factor)?; card;
                    "LOAD: only factors of 1 are supported: write the pressures themselves");
                active.insert(card.number(set)?);
            }
        }
        if active.is_empty() && known.len() <= 1 {
            return Ok(Some(known));
        }
        let is_one_case = named.windows(2).all(|pair| pair[0] == pair[1]);
        Ok((is_one_case && !active.is_empty()).then_some(active))
    }

    /// Supports.
    pub(super) fn read_supports(&mut self) -> Result<()> {
        let mut held = Held::new();
        for card in self.cards_of("SPC1") {
            self.nodes_of_spc1(card, &mut held)?;
        }
        for card in self.cards_of("SPC") {
            let set = card.number(0)?;
            for first in [1, 4].into_iter().filter(|&first| !card.field(first).is_empty()) {
                if card.real(first + 2)? != 0.0 {
                    let reason = "only displacements of zero are taken: these directions stay free";
                    self.leave_out("SPC with a displacement", card.place, (reason, true));
                    continue;
                }
                let node = self.node(card, first, "SPC")?;
                let key = (set, directions(card, first + 1)?);
                held.entry(key).or_insert((BTreeSet::new(), card.place)).0.insert(node);
            }
        }
        let known = held.keys().map(|key| key.0).collect();
        let active = self.active(&self.control.spc, known, "SPCADD")?;
        self.take_held(held, active.as_ref());
        Ok(())
    }

    fn nodes_of_spc1(&self, card: &Card<'_>, held: &mut Held) -> Result<()> {
        let key = (card.number(0)?, directions(card, 1)?);
        let (nodes, _) = held.entry(key).or_insert((BTreeSet::new(), card.place));
        if card.field(3).eq_ignore_ascii_case("THRU") {
            let range = card.number(2)?..=card.number(4)?;
            let inside = self.nodes.iter().filter(|(label, _)| range.contains(label));
            nodes.extend(inside.map(|(_, &node)| node));
            return Ok(());
        }
        for field in (2..card.fields.len()).filter(|&field| !card.field(field).is_empty()) {
            nodes.insert(self.node(card, field, "SPC1")?);
        }
        Ok(())
    }

    fn take_held(&mut self, held: Held, active: Option<&Sets>) {
        let used = used_nodes(&self.file.elements);
        for ((set, directions), (nodes, place)) in held {
            let nodes: Vec<u32> = nodes.into_iter().filter(|node| used.contains(node)).collect();
            let name = format!("SPC_{set}_{directions}");
            // A set that no subcase names holds nothing.
            let is_meant = active.is_none_or(|active| active.contains(&set));
            let is_turned = |&node: &u32| self.turned.contains(&self.file.labels[node as usize]);
            let reason = if directions.is_empty() {
                "rotations of nodes have no meaning in solid elements"
            } else if nodes.is_empty() {
                "none of its nodes belongs to a solid element"
            } else if active.is_none() {
                "several sets or subcases: give [boundaries.SPC_...] in the case the one that is meant"
            } else if !is_meant {
                "no subcase names this set"
            } else if directions != "123" && nodes.iter().any(is_turned) {
                "its directions are those of the nodes' own systems: hold it in the case"
            } else {
                ""
            };
            if reason.is_empty() {
                let axes = ['1', '2', '3'].map(|axis| directions.contains(axis));
                self.bear(&name, FileConditionKind::Fixed(axes), place);
            } else {
                let keyword = format!("SPC of set {set}, directions {directions}");
                let is_part = is_meant && !directions.is_empty() && !nodes.is_empty();
                self.leave_out(&keyword, place, (reason, is_part));
            }
            if !nodes.is_empty() {
                self.file.node_sets.insert(name, nodes);
            }
        }
    }

    fn bear(&mut self, boundary: &str, kind: FileConditionKind, place: Place) {
        let (boundary, place) = (boundary.to_owned(), self.deck.name(place));
        self.file.model.conditions.push(FileCondition { boundary, kind, place });
    }

    /// Pressures on faces.
    pub(super) fn read_pressures(&mut self) -> Result<()> {
        let mut sets: BTreeMap<usize, Pressed> = BTreeMap::new();
        for card in self.cards_of("PLOAD4") {
            let set = card.number(0)?;
            let element = self.solid(card, 1)?;
            let pressure = card.real(2)?;
            // Pressures of the other corners, a direction, a line load: only what is one pressure is taken.
            let mut is_plain = card.fields.iter().skip(8).all(|field| field.is_empty());
            for field in 3..6 {
                is_plain &= card.optional_real(field)?.is_none_or(|other| other == pressure);
            }
            if !is_plain {
                let reason = "only one pressure for a face, along its normal, is taken";
                self.leave_out("PLOAD4 of another kind", card.place, (reason, true));
                continue;
            }
            let face = self.loaded_face(card, element)?;
            let known = sets.entry(set).or_default(); // Faces of one set with one pressure are one boundary.
            match known.iter_mut().find(|known| known.0 == pressure) {
                Some(known) => known.1.push(face),
                None => known.push((pressure, vec![face], card.place)),
            }
        }
        // Those that the subcases name act; a boundary has its name in any case.
        let known = sets.keys().copied().collect();
        let active = self.active(&self.control.load, known, "LOAD")?;
        for (set, pressed) in sets {
            let count = pressed.len();
            for (number, (pressure, faces, place)) in (1..).zip(pressed) {
                let name = match count {
                    1 => format!("PLOAD4_{set}"),
                    _ => format!("PLOAD4_{set}_{number}"),
                };
                if active.as_ref().is_some_and(|active| active.contains(&set)) {
                    self.bear(&name, FileConditionKind::Pressure(pressure), place);
                } else {
                    let reason = "the subcases do not say that this set acts, and no other";
                    let keyword = format!("PLOAD4 of set {set}");
                    self.leave_out(&keyword, place, (reason, active.is_none()));
                }
                self.file.surfaces.insert(name, faces);
            }
        }
        Ok(())
    }

    /// The face that `G1` and `G3` or `G4` name: opposite corners of a quadrilateral; of a triangular face of a wedge `G1` alone,
    /// of a pyramid its two corners on the base; of a tetrahedron a corner of the face and the corner that is not on it.
    fn loaded_face(&self, card: &Card<'_>, element: usize) -> Result<SurfaceFace> {
        let element = &self.file.elements[element];
        let first = self.node(card, 6, "PLOAD4")?;
        let has_second = card.optional_int(7)?.is_some();
        let second = has_second.then(|| self.node(card, 7, "PLOAD4")).transpose()?;
        let all = &element.nodes[..element.kind.corner_count()];
        let is_named = |(kind, nodes): &SurfaceFace| {
            let corners = &nodes[..kind.corner_count()];
            let place = |node| corners.iter().position(|&corner| corner == node);
            match (all.len(), corners.len(), second) {
                (4, _, Some(apex)) => {
                    first != apex && all.contains(&apex) && !corners.contains(&apex)
                }
                (6, 3, None) => corners.contains(&first),
                (5, 3, Some(second)) => {
                    let is_on_base = |end| all[..4].contains(&end) && corners.contains(&end);
                    first != second && is_on_base(first) && is_on_base(second)
                }
                (_, 4, Some(second)) => {
                    place(first).zip(place(second)).is_some_and(|(a, b)| a.abs_diff(b) == 2)
                }
                _ => false,
            }
        };
        let found = element.faces().find(is_named);
        Ok(found!(found; card; "PLOAD4: G1 and G3 (G4) name no face of element {}", element.label))
    }
}

/// The directions of a field, of those of rotations none.
fn directions(card: &Card<'_>, field: usize) -> Result<String> {
    let text = card.field(field);
    ensure!(!text.is_empty() && text.chars().all(|c| ('0'..='6').contains(&c)); card;
        "{}: directions 1 to 6 expected, found {}", card.name, quoted(text));
    Ok(text.chars().filter(|c| ('1'..='3').contains(c)).collect())
}
