//! `CTETRA`, `CHEXA`, `CPENTA`, `CPYRAM`, and the shells that cover their faces.

use super::Reader;
use super::card::Card;
use crate::prelude::*;

impl Reader<'_, '_> {
    pub(super) fn read_elements(&mut self) -> Result<()> {
        for card in self.cards {
            // What changes the body where it is left out is refused, not listed.
            ensure!(card.name != "CHACAB"; card; "CHACAB: acoustic elements are not supported");
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
        let owner = format!("{} {label}", card.name);
        let fields = &card.fields[2..card.fields.len().max(2)];
        let mut middles = fields.iter().skip(linear.node_count());
        let kind = if middles.any(|field| !["", "0"].contains(field)) { quadratic } else { linear };
        let count = kind.node_count();
        let mut listed = Vec::with_capacity(count);
        for place in 0..count {
            let is_given = card.optional_int(2 + place)?.is_some_and(|node| node > 0);
            ensure!(is_given; card;
                "{owner} lacks node {}: give every node of the element, or its corners alone", place + 1);
            listed.push(self.node(card, 2 + place, &owner)?);
        }
        let mut beyond = fields.iter().skip(count);
        ensure!(beyond.all(|field| field.is_empty()); card; "{owner} has more than {count} nodes");
        let known = self.elements.insert(label, self.file.elements.len());
        ensure!(known.is_none(); card; "element {label} is given twice");
        let region = self.region(property.unsigned_abs() as usize).into();
        let nodes = kind.row().nastran.arranged(&listed);
        self.file.elements.push(FileElement { label, kind, region, entity: 0, nodes });
        Ok(())
    }

    /// Name of the region of a property.
    pub(super) fn region(&self, property: usize) -> String {
        self.property_name(property, "PSOLID")
    }

    fn property_name(&self, property: usize, card: &str) -> String {
        let name = self.control.property_names.get(&property).cloned();
        name.unwrap_or_else(|| format!("{card}_{property}"))
    }

    /// Shells and `BSURFS` that cover faces of solids become surfaces.
    pub(super) fn read_skins(&mut self) -> Result<()> {
        let corners_of = |card: &Card<'_>| match card.name.get(..5) {
            Some("CTRIA") => Some(3),
            Some("CQUAD") => Some(4),
            _ => None,
        };
        let skins = self.cards.iter().filter_map(|card| Some((card, corners_of(card)?)));
        let mut skins = skins.peekable();
        let faces = skins.peek().map(|_| outer_faces(&self.file.elements)).unwrap_or_default();
        let mut surfaces: BTreeMap<usize, Vec<SurfaceFace>> = BTreeMap::new();
        for (card, count) in skins {
            let owner = format!("{} {}", card.name, card.number(0)?);
            let property = card.number(1)?;
            let corners = (0..count).map(|place| self.node(card, 2 + place, &owner));
            let face = faces.get(&sorted(&corners.collect::<Result<Vec<u32>>>()?));
            let reason = match face {
                Some(_) => "read as a surface of the solids, without stiffness and mass",
                None => "shells are not used",
            };
            self.leave_out(&card.name, card.place, (reason, face.is_none()));
            if let Some(face) = face {
                surfaces.entry(property).or_default().push(face.clone());
            }
        }
        for (property, faces) in surfaces {
            let name = self.property_name(property, "PSHELL");
            self.file.surfaces.entry(name).or_default().extend(faces);
        }
        self.read_bsurfs()
    }

    /// Faces of solids by three of their nodes.
    fn read_bsurfs(&mut self) -> Result<()> {
        for card in self.cards_of("BSURFS") {
            let name = format!("BSURFS_{}", card.number(0)?);
            // Element and three of its nodes in turns, from the fifth field on.
            let entries = (4..card.fields.len()).step_by(4);
            for first in entries.filter(|&first| !card.field(first).is_empty()) {
                let element = self.solid(card, first)?;
                let node = |k: usize| self.node(card, first + k, &name);
                let face = self.file.elements[element].face_with(&[node(1)?, node(2)?, node(3)?]);
                let face = found!(face; card; "{name}: its nodes are on no face of the element");
                self.file.surfaces.entry(name.clone()).or_default().push(face);
            }
        }
        Ok(())
    }

    /// The place of the solid element that a field names.
    pub(super) fn solid(&self, card: &Card<'_>, field: usize) -> Result<usize> {
        let label = card.number(field)?;
        let element = self.elements.get(&label).copied();
        Ok(found!(element; card;
            "{} names element {label}, which is no solid element of the file", card.name))
    }
}
