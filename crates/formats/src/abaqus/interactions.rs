//! `*TIE`, `*CONTACT PAIR` and the friction of `*SURFACE INTERACTION`.

use super::Reader;
use super::block::{Block, Row, Scoped};
use crate::prelude::*;

impl Reader<'_, '_> {
    /// Reads ties and contact pairs.
    pub(super) fn read_interactions(&mut self) -> Result<()> {
        let interactions = self.interactions()?;
        for block in self.blocks_of("TIE") {
            let name = block.parameter("NAME").filter(|name| !name.is_empty());
            if !block.parameter("ADJUST").unwrap_or("NO").eq_ignore_ascii_case("NO") {
                let reason = "nodes stay where the file has them; a tie bridges a small gap";
                self.leave_out("*TIE, ADJUST", block.place, reason);
            }
            for (row, [surface, counter]) in self.pairs(block)? {
                let (ties, place) = (&mut self.file.model.ties, self.deck.name(row.place));
                let is_taken = |name: &str| ties.iter().any(|tie| tie.name == name);
                let name = unique(name.unwrap_or(&surface), is_taken);
                ties.push(FileTie { name, surface, counter, place });
            }
        }
        // Contact pairs have the friction and the stiffness of their interaction.
        for block in self.blocks_of("CONTACT PAIR") {
            let name = block.required("INTERACTION")?;
            let interaction = interactions.get(&name.to_uppercase());
            let interaction = interaction
                .ok_or_else(|| self.unknown(block.place, "surface interaction", name))?;
            for parameter in ["ADJUST", "TIED", "TRACKING", "EXTENSION ZONE", "CPSET"] {
                let keyword = format!("*CONTACT PAIR, {parameter}");
                match parameter {
                    _ if !block.has(parameter) => {}
                    "TIED" => self.lose_part(&keyword, block.place, "glue the surfaces by *TIE"),
                    _ => self.leave_out(&keyword, block.place, ""),
                }
            }
            for (row, [surface, counter]) in self.pairs(block)? {
                let (contacts, place) = (&mut self.file.model.contacts, self.deck.name(row.place));
                let is_known = |c: &FileContact| c.surface == surface && c.counter == counter;
                if !contacts.iter().any(is_known) {
                    let name = unique(&surface, |name| contacts.iter().any(|c| c.name == name));
                    let pair = FileContact { name, surface, counter, place, ..interaction.clone() };
                    contacts.push(pair);
                }
            }
        }
        Ok(())
    }

    /// Pairs of surfaces of all data lines; those of which one was left out are left out too.
    fn pairs<'a>(&mut self, block: Scoped<'_, 'a>) -> Result<Vec<(Row<'a>, [String; 2])>> {
        let mut pairs = Vec::new();
        for row in block.rows() {
            let names: Vec<&str> = row.fields().filter(|name| !name.is_empty()).collect();
            let &[first, second, ..] = names.as_slice() else {
                refuse!(row; "*{}: two surfaces expected, found {}", block.keyword, quoted(row.line));
            };
            let missing = match [first, second].map(|name| self.surface_name(row, name)) {
                [Some(first), Some(second)] => {
                    pairs.push((row, [first, second]));
                    continue;
                }
                [None, _] => first,
                _ => second,
            };
            if !self.surfaces.contains_key(&self.key(row.scope, missing)) {
                return Err(self.unknown(row.place, "surface", missing));
            }
            let keyword = format!("*{} of {missing}", block.keyword);
            self.lose_part(&keyword, row.place, "that surface is not used");
        }
        Ok(pairs)
    }

    /// The name among all surfaces of one that is named in a scope; a node or element set may stand for a surface.
    pub(super) fn surface_name(&mut self, row: Row<'_>, name: &str) -> Option<String> {
        let key = self.key(row.scope, name);
        if let Some(Some(found)) = self.surfaces.get(&key) {
            return Some(found.clone());
        }
        let set = self.nodes.sets.get(&key)?;
        let items = set.items.clone();
        self.file.node_sets.entry(set.name.clone()).or_insert(items);
        Some(set.name.clone())
    }

    /// Surface interactions by name, as the last step leaves them, of no surfaces yet.
    fn interactions(&mut self) -> Result<BTreeMap<String, FileContact>> {
        let mut found: BTreeMap<String, FileContact> = BTreeMap::new();
        let mut current = None;
        for block in self.blocks {
            match block.keyword.as_str() {
                "SURFACE INTERACTION" => {
                    let name = block.required("NAME")?.to_uppercase();
                    found.entry(name.clone()).or_default();
                    current = Some(name);
                }
                "CHANGE FRICTION" => {
                    current = Some(block.required("INTERACTION")?.to_uppercase());
                }
                keyword @ ("FRICTION" | "SURFACE BEHAVIOR") => {
                    let known = current.as_ref().and_then(|name| found.get_mut(name));
                    let interaction =
                        found!(known; block; "*{keyword} stands behind no *SURFACE INTERACTION");
                    match keyword {
                        "FRICTION" => self.friction(block, interaction)?,
                        _ => self.behavior(block, interaction)?,
                    }
                }
                _ => {}
            }
        }
        Ok(found)
    }

    fn friction(&mut self, block: &Block<'_>, interaction: &mut FileContact) -> Result<()> {
        let numbers = block.numbers(1)?;
        let is_other = ["ROUGH", "USER", "ANISOTROPIC"].into_iter().any(|kind| block.has(kind));
        if is_other || block.data.len() > 1 {
            let reason =
                "Coulomb's friction with one coefficient, or with EXPONENTIAL DECAY, is read";
            self.leave_out("*FRICTION of another kind", block.place, reason);
            if is_other {
                return Ok(());
            }
        }
        if block.has("EXPONENTIAL DECAY") {
            // mu = mu_k + (mu_s - mu_k) exp(-d v)
            let &[high, low, decay, ..] = numbers.as_slice() else {
                refuse!(block; "*FRICTION, EXPONENTIAL DECAY needs three numbers");
            };
            interaction.friction_coefficient = Some(low);
            let falls = low > 0.0 && decay > 0.0 && high > low;
            interaction.decay = falls.then(|| (high / low, 1.0 / decay));
        } else {
            interaction.friction_coefficient = Some(numbers.first().copied().unwrap_or(0.0));
            interaction.decay = None;
        }
        Ok(())
    }

    fn behavior(&mut self, block: &Block<'_>, interaction: &mut FileContact) -> Result<()> {
        let kind = block.parameter("PRESSURE-OVERCLOSURE").unwrap_or("HARD").to_uppercase();
        match kind.as_str() {
            "LINEAR" => interaction.normal_stiffness = block.numbers(1)?.first().copied(),
            "HARD" => interaction.normal_stiffness = None,
            _ => {
                let keyword = format!("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={kind}");
                let reason = "the contact is rigid unless the case gives its stiffness or law";
                self.leave_out(&keyword, block.place, reason);
            }
        }
        Ok(())
    }
}

/// `wanted`, with a number behind it where it is taken.
pub(super) fn unique(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    if !is_taken(wanted) {
        return wanted.to_owned();
    }
    let numbered = (2..).map(|number| format!("{wanted}_{number}"));
    let mut free = numbered.filter(|name| !is_taken(name));
    free.next().unwrap_or_default()
}
