//! Reader of Nastran bulk data.
//!
//! `CTETRA`, `CHEXA`, `CPENTA` and `CPYRAM` with corners alone or with every mid-side node. A region is
//! a property, called by its name in the comments of HyperMesh and ANSA, else `PSOLID_<number>`.
//! Nastran has few named surfaces. Faces of `PLOAD4` (`PLOAD4_<set>`) and of `BSURFS`
//! (`BSURFS_<number>`) become boundaries. So do shells that cover faces (`PSHELL_<number>`) and the
//! nodes of `SPC` (`SPC_<set>_<directions>`).
//!
//! Source: MSC Nastran Quick Reference Guide.

mod card;
mod coordinates;
mod elements;
mod loads;
mod properties;

use crate::prelude::*;
use card::{Card, Control, cards, without_tabs};
use coordinates::Coordinates;

/// Cards that are read here, and those that say nothing about the model.
const KNOWN: [&str; 28] = [
    "GRID", "GRDSET", "CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S", "CTETRA",
    "CHEXA", "CPENTA", "CTRIA3", "CTRIA6", "CQUAD4", "CQUAD8", "PSOLID", "PSHELL", "MAT1", "MAT9",
    "SPC", "SPC1", "SPCADD", "PLOAD4", "LOAD", "BSURFS", "INCLUDE", "CPYRAM", "CPYRA",
];

/// Beginnings of cards that hold, load or join parts, and are not read.
#[rustfmt::skip]
const PARTS: [&str; 40] = [
    "RBE1", "RBE2", "RBE3", "RBAR", "RROD", "RSPLINE", "RTRPLT", "RJOINT", "RSSCON", "MPC", "CONM", "CMASS", "CELAS", "CDAMP",
    "CBUSH", "CFAST", "CWELD", "CSEAM", "CGAP", "CVISC", "CROD", "CONROD", "CTUBE", "CBAR", "CBEAM", "CBEND", "CSHEAR",
    "BCONP", "BCTSET", "BCTABLE", "BGSET", "BOLT", "FORCE", "MOMENT", "PLOAD", "GRAV", "RFORCE", "ACCEL", "SPCD", "DMIG",
];

/// What is read so far.
struct Reader<'d, 'a> {
    deck: &'d Deck<'a>,
    cards: &'d [Card<'a>],
    control: Control,
    coordinates: Coordinates<'d, 'a>,
    file: FileMesh,
    nodes: HashMap<usize, u32>,
    elements: HashMap<usize, usize>,
    /// Numbers of nodes whose degrees of freedom are along axes of their own.
    turned: BTreeSet<usize>,
}

/// Reads bulk data; the files that it includes stand in it ([`included_text`](super::included_text)).
pub(super) fn read(bytes: &[u8]) -> Result<FileMesh> {
    let mut text = String::from_utf8_lossy(bytes);
    if text.contains('\t') {
        text = without_tabs(&text).into();
    }
    let deck = Deck::new(&text, "$", false)?;
    let (cards, control) = cards(&deck)?;
    let mut reader = Reader {
        deck: &deck,
        cards: &cards,
        control,
        coordinates: Coordinates::new(&deck, &cards)?,
        file: FileMesh::default(),
        nodes: HashMap::new(),
        elements: HashMap::new(),
        turned: BTreeSet::new(),
    };
    reader.file.model.title = reader.control.title.clone();
    reader.list_unknown();
    reader.read_nodes()?;
    reader.read_elements()?;
    ensure!(!reader.file.elements.is_empty(); deck, deck.end();
        "the file has no solid elements (CTETRA, CHEXA, CPENTA, CPYRAM)");
    reader.read_properties()?;
    reader.read_skins()?;
    reader.read_supports()?;
    reader.read_pressures()?;
    Ok(finished(reader.file))
}

/// The file that a line includes.
pub(super) fn included(line: &str) -> Option<(&str, bool)> {
    let line = line.trim();
    if !line.get(..7)?.eq_ignore_ascii_case("INCLUDE") {
        return None;
    }
    let name = line[7..].trim().trim_matches(['\'', '"']);
    (!name.is_empty()).then_some((name, false))
}

impl<'d, 'a> Reader<'d, 'a> {
    /// Cards of a name.
    fn cards_of(&self, name: &'static str) -> impl Iterator<Item = &'d Card<'a>> + use<'d, 'a> {
        self.cards.iter().filter(move |card| card.name == name)
    }

    /// Notes what is not used, and whether it would hold, load or join parts.
    fn leave_out(&mut self, keyword: &str, place: Place, reason: (&str, bool)) {
        self.file.model.leave_out(keyword, || self.deck.name(place), reason);
    }

    fn list_unknown(&mut self) {
        for card in self.cards.iter().filter(|card| !KNOWN.contains(&card.name.as_str())) {
            let is_analysis = card.name == "PARAM" || card.name.starts_with("EIG");
            let reason = if is_analysis { "the case says what is computed" } else { "" };
            let is_part = PARTS.iter().any(|part| card.name.starts_with(part));
            self.leave_out(&card.name, card.place, (reason, is_part));
        }
    }

    /// Nodes in basic coordinates.
    fn read_nodes(&mut self) -> Result<()> {
        let default = self.cards_of("GRDSET").next();
        let of_default = |field: usize| default.map_or(Ok(None), |card| card.optional_int(field));
        let [system, turned, held] = [of_default(1)?, of_default(5)?, of_default(6)?];
        let system = system.map(|system| usize::try_from(system).unwrap_or(0));
        for card in self.cards_of("GRID") {
            let label = card.number(0)?;
            let system = card.optional_system(1)?.or(system).unwrap_or(0);
            let point = card.point(2)?;
            let known = self.coordinates.grids.insert(label, (system, point, card.place));
            ensure!(known.is_none_or(|known| known.1 == point && known.0 == system); card;
                "node {label} is given twice, at different places");
            if card.optional_int(5)?.or(turned).is_some_and(|own| own != 0) {
                self.turned.insert(label);
            }
            let held = card.optional_int(6)?.or(held).filter(|&held| held > 0);
            if held.is_some_and(|axes| axes.to_string().contains(['1', '2', '3'])) {
                let reason = "permanent constraints of nodes are not taken: hold them by SPC1 or in the case";
                self.leave_out("GRID with PS", card.place, (reason, true));
            }
        }
        for (label, (system, point, place)) in self.coordinates.grids.clone() {
            self.nodes.insert(label, self.file.points.len() as u32);
            self.file.points.push(self.coordinates.point(system, point, place)?);
            self.file.labels.push(label);
        }
        Ok(())
    }

    /// The node that a field of a card names; `owner` is whose node it is.
    fn node(&self, card: &Card<'_>, field: usize, owner: &str) -> Result<u32> {
        let label = card.number(field)?;
        let node = self.nodes.get(&label).copied();
        Ok(found!(node; card; "{owner} names node {label}, which the file does not have"))
    }
}
