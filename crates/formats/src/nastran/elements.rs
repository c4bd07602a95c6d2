//! `CTETRA`, `CHEXA`, `CPENTA`, `CPYRAM`, and the shells that cover their faces.

use super::Reader;
use super::card::Card;
use crate::ElementKind;
use crate::collection::{CollectedElement, outer_faces, sorted};
use crate::file_mesh::{Result, SurfaceFace};
use std::collections::{BTreeMap, HashMap};

impl Reader<'_, '_> {
    pub(super) fn read_elements(&mut self) -> Result<()> {
        for card in self.cards {
            // What changes the body where it is left out is refused, not listed.
            if card.name == "CHACAB" {
                refuse!(card; "CHACAB: acoustic elements are not supported");
            }
            let of_order = |is_quadratic: bool| {
                ElementKind::listed(|row| {
                    row.is_quadratic == is_quadratic && row.nastran.names.contains(&&*card.name)
                })
            };
            if let (Some(linear), Some(quadratic)) = (of_order(false), of_order(true)) {
                self.element(card, [linear, quadratic])?;
            }
        }
        Ok(())
    }

    fn element(&mut self, card: &Card<'_>, [linear, quadratic]: [ElementKind; 2]) -> Result<()> {
        let label = card.number(0)?;
        let property = card.optional_int(1)?.unwrap_or(label as i64);
        let fields = &card.fields[2..card.fields.len().max(2)];
        let has_middles =
            fields.iter().skip(linear.node_count()).any(|field| !["", "0"].contains(field));
        let kind = if has_middles { quadratic } else { linear };
        let mut listed = Vec::with_capacity(kind.node_count());
        for place in 0..kind.node_count() {
            let node = card.optional_int(2 + place)?.unwrap_or(0);
            let Some(node) = usize::try_from(node).ok().filter(|&node| node > 0) else {
                refuse!(card;
                    "{} {label} lacks node {}: give every node of the element, or its corners \
                     alone", card.name, place + 1);
            };
            listed.push(self.node(node, &format!("{} {label}", card.name), card.place)?);
        }
        let beyond = fields.iter().skip(kind.node_count()).any(|field| !field.is_empty());
        if beyond {
            refuse!(card; "{} {label} has more than {} nodes", card.name, kind.node_count());
        }
        let index = self.collected.len();
        if self.elements.insert(label, index).is_some() {
            refuse!(card; "element {label} is given twice");
        }
        let region = self.region(property.unsigned_abs() as usize);
        self.collected.push(CollectedElement {
            label,
            kind,
            nodes: kind.row().nastran.arranged(&listed),
            region: Some(region.into()),
        });
        Ok(())
    }

    /// Name of the region of a property.
    pub(super) fn region(&self, property: usize) -> String {
        let name = self.control.property_names.get(&property).cloned();
        name.unwrap_or_else(|| format!("PSOLID_{property}"))
    }

    /// Shells and `BSURFS` that cover faces of solids become surfaces.
    pub(super) fn read_skins(&mut self) -> Result<()> {
        let is_skin =
            |card: &&Card<'_>| card.name.starts_with("CTRIA") || card.name.starts_with("CQUAD");
        let faces = match self.cards.iter().any(|card| is_skin(&card)) {
            true => outer_faces(&self.collected),
            false => HashMap::new(),
        };
        let mut skins: BTreeMap<usize, Vec<SurfaceFace>> = BTreeMap::new();
        for card in self.cards.iter().filter(is_skin) {
            let label = card.number(0)?;
            let property = card.number(1)?;
            let count = if card.name.starts_with("CTRIA") { 3 } else { 4 };
            let mut corners = Vec::new();
            for place in 0..count {
                let node = card.number(2 + place)?;
                corners.push(self.node(node, &format!("{} {label}", card.name), card.place)?);
            }
            match faces.get(&sorted(&corners)) {
                Some(face) => {
                    skins.entry(property).or_default().push(face.clone());
                    let reason = "read as a surface of the solids, without stiffness and mass";
                    self.leave_out(&card.name, card.place, reason);
                }
                None => self.lose_part(&card.name, card.place, "shells are not used"),
            }
        }
        for (property, faces) in skins {
            let named = self.control.property_names.get(&property).cloned();
            let name = named.unwrap_or_else(|| format!("PSHELL_{property}"));
            self.file.surfaces.entry(name).or_default().extend(faces);
        }
        self.read_bsurfs()
    }

    /// Faces of solids by three of their nodes.
    fn read_bsurfs(&mut self) -> Result<()> {
        for card in self.cards_of("BSURFS") {
            let name = format!("BSURFS_{}", card.number(0)?);
            // Element and three of its nodes in turns, from the fifth field on.
            let entries = card.fields.get(4..).unwrap_or_default().chunks(4);
            for (i, _) in entries.enumerate().filter(|(_, entry)| !entry[0].is_empty()) {
                let first = 4 + 4 * i;
                let element = self.solid(card.number(first)?, card)?;
                let mut nodes = [0; 3];
                for (k, node) in nodes.iter_mut().enumerate() {
                    let label = card.number(first + 1 + k)?;
                    *node = self.node(label, &name, card.place)?;
                }
                let face = self.collected[element].face_with(&nodes);
                let face = face.ok_or_else(
                    || fault!(card; "{name}: its nodes are on no face of the element"),
                )?;
                self.file.surfaces.entry(name.clone()).or_default().push(face);
            }
        }
        Ok(())
    }

    /// The place of a solid element by its number.
    pub(super) fn solid(&self, label: usize, card: &Card<'_>) -> Result<usize> {
        self.elements.get(&label).copied().ok_or_else(|| {
            fault!(card;
            "{} names element {label}, which is no solid element of the file", card.name)
        })
    }
}
