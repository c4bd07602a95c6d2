//! Materials, ties, contact pairs, conditions and motions that a case takes from its mesh file, as
//! the sections that it would have for them.
//!
//! Sections of the case win: a key that it gives is not taken. The case alone says the condition of a boundary that has
//! one there. The same holds for a contact or a tie whose surfaces it names, and for a motion whose axis it gives.
//! Elastic constants are taken together, and so are the two coefficients of Rayleigh's damping.

use super::file_sections::{list, sections, text};
use super::{FileSection, MeshBytes, UnitsWord, elastic::ORTHOTROPIC, imported, value::table_of};
use crate::*;

/// Entries that a warning names.
const MOST_NAMED: usize = 8;

/// Why something is not used that the case does without.
const DROPPED: &str = "mesh.drop leaves it out";

/// What a case takes from its mesh file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    /// Name of the file in the case.
    pub file: String,
    /// Whether the file cannot be read, so that nobody knows what it holds.
    pub is_unread: bool,
    /// What is taken.
    pub sections: Vec<FileSection>,
    /// How the file was read, and what is taken, in sentences.
    pub notes: Vec<String>,
    /// What is not used.
    pub left_out: Vec<LeftOut>,
    /// What would hold, load or join parts and is not understood, and `mesh.drop` does not name.
    pub missing_parts: Vec<LeftOut>,
}

/// The case with all that it takes from its mesh file, and what that is.
pub(super) fn effective(raw: &mut RawCase) -> (RawTable, Taken) {
    let table = raw.root.clone();
    let text = |key: &str| raw.find(key)?.value.text();
    let (name, units) = (text("mesh.file").map(str::to_owned), text("mesh.units"));
    let units = units.and_then(UnitsWord::of).unwrap_or(UnitsWord::MKgS);
    raw.mesh = name.as_ref().and_then(|name| imported::mesh_bytes(raw, name).ok());
    let Some(name) = name else { return (table, Taken::default()) };
    // A file that cannot be read is told where the body is made of it.
    let Some(Ok(file)) = raw.mesh.as_ref().map(MeshBytes::read) else {
        return (table, Taken { is_unread: true, ..Taken::default() });
    };
    let at = raw.place("mesh.file");
    let (sections, left_out) = sections(&file, units);
    let notes = file.model.remarks.clone();
    let mut taken = Taken { file: name, left_out, notes, ..Taken::default() };
    let (takes_all, parts) = (raw.find("mesh.take").is_none(), texts(raw, "mesh.take"));
    let mut merged = table;
    for section in sections {
        let is_named = section.path.0 != "material";
        // A part is called as its sections are; the common material is one of the materials.
        let part = if is_named { section.path.0 } else { "materials" };
        if !takes_all && !parts.iter().any(|own| own == part) {
            let keyword = format!("{} {}", section.path.0, section.path.1);
            let left_out = LeftOut::once(keyword, section.place, "mesh.take leaves it out");
            taken.left_out.extend(Some(left_out).filter(|_| is_named));
        } else if let Some(section) = merge(&mut merged, section, &at) {
            taken.sections.push(section);
        }
    }
    taken.drop_parts(&texts(raw, "mesh.drop"));
    taken.notes.extend(summary(&taken));
    (merged, taken)
}

/// The texts of a key: one, or a list.
fn texts(raw: &RawCase, key: &str) -> Vec<String> {
    let items = raw.find(key).map_or(&[][..], RawItem::listed).iter();
    items.filter_map(|item| item.value.text().map(str::to_owned)).collect()
}

/// Adds to the case what it does not give itself; what was added.
fn merge(root: &mut RawTable, mut section: FileSection, at: &Location) -> Option<FileSection> {
    let (group, name) = (section.path.0, section.path.1.as_str());
    if let Some(of_group) = table_of(root, group) {
        let own = if group == "material" { Some(of_group) } else { table_of(of_group, name) };
        let is_known = |entry: &RawItem| has_sides(entry, &section);
        if let Some(own) = own {
            section.keys.retain(|(key, _)| !is_given(own, group, key));
        } else if ["contacts", "ties"].contains(&group) && of_group.values().any(is_known) {
            return None;
        }
    } else if group == "material" && section.get("density").is_none() {
        // A formulation alone makes no material.
        return None;
    } else if group == "contacts"
        && table_of(root, "contact").is_some_and(|own| own.contains_key("boundary"))
    {
        // A contact of the case's own, not a key meant for those of the file.
        return None;
    }
    if section.keys.is_empty() {
        return None;
    }
    let mut table = entry_table(root, group, at)?;
    if group != "material" {
        table = entry_table(table, name, at)?;
    }
    for (key, value) in &section.keys {
        table.insert((*key).to_owned(), RawItem::at(value.clone(), at));
    }
    Some(section)
}

/// The table of a name, made where there is none; none where the name stands for something else.
fn entry_table<'t>(table: &'t mut RawTable, name: &str, at: &Location) -> Option<&'t mut RawTable> {
    let empty = || RawItem::at(RawValue::Table(RawTable::new()), at);
    table.entry(name.to_owned()).or_insert_with(empty).value.table_mut()
}

/// Whether a contact or a tie of the case joins the same two surfaces.
fn has_sides(entry: &RawItem, section: &FileSection) -> bool {
    let sides = ["surface", "counter"];
    let table = entry.value.table();
    let of_case = sides.map(|key| Some(&table?.get(key)?.value));
    let of_file = sides.map(|key| section.get(key));
    of_case == of_file || of_case == [of_file[1], of_file[0]]
}

/// Whether the case gives a key of a section, or what excludes it.
fn is_given(own: &RawTable, section: &str, key: &str) -> bool {
    let has = |names: &[&str]| names.iter().any(|name| own.contains_key(*name));
    let is = |name: &str, value: RawValue| own.get(name).is_some_and(|own| own.value == value);
    own.contains_key(key)
        || match (section, key) {
            ("boundaries", _) => has(&["condition"]),
            // Another law has no linear stiffness; the inertia that a case leaves out has no frame.
            ("contacts", "normal_stiffness") if is("normal_law", text("exponential")) => true,
            ("motion", "frame") if is("rotation_terms", RawValue::Boolean(false)) => true,
            ("contacts" | "ties", _) => has(&["surface", "counter"]),
            ("motion", _) => has(&["axis"]),
            ("materials", "young_modulus") => has(&ORTHOTROPIC) || has(&["axes", "table"]),
            ("materials", "poisson_ratio") => has(&ORTHOTROPIC) || has(&["axes"]),
            ("materials", "loss_factor") => has(&["table"]),
            ("materials", key) if key == "axes" || ORTHOTROPIC.contains(&key) => {
                has(&["young_modulus", "poisson_ratio", "table"])
            }
            ("materials", "mass_coefficient" | "stiffness_coefficient") => {
                has(&["mass_coefficient", "stiffness_coefficient"])
            }
            _ => false,
        }
}

/// What is taken, in one sentence for each group.
fn summary(taken: &Taken) -> Vec<String> {
    let named = taken.sections.iter().filter(|section| section.path.0 != "material");
    let named: Vec<&FileSection> = named.collect();
    let name = |section: &&FileSection| match section.path.0 {
        "materials" => format!("{} ({})", section.path.1, section.name),
        _ => section.path.1.clone(),
    };
    // The sections of a group stand together.
    let groups = named.chunk_by(|a, b| a.path.0 == b.path.0);
    let taken_of = |group: &[&FileSection]| {
        let names: Vec<String> = group.iter().map(name).collect();
        format!("{} taken from {}: {}", group[0].path.0, taken.file, names.join(", "))
    };
    groups.map(taken_of).collect()
}

/// The first parts of a list.
fn first_parts(parts: &[impl ToString]) -> String {
    let named: Vec<String> = parts.iter().take(MOST_NAMED).map(ToString::to_string).collect();
    named.join("; ")
}

/// The key that leaves out parts of a file, as a line of a case.
pub(super) fn drop_key(parts: &[LeftOut]) -> String {
    let cards: BTreeSet<&str> = parts.iter().map(LeftOut::card).collect();
    format!("drop = {}", list(cards.into_iter().map(text).collect()))
}

impl Taken {
    /// What of the file is not used, one line each.
    pub fn not_used(&self) -> Vec<String> {
        self.left_out.iter().map(ToString::to_string).collect()
    }

    /// Tells the parts that `mesh.drop` names from those that the answer would lack in silence.
    fn drop_parts(&mut self, entries: &[String]) {
        let lost = self.left_out.iter_mut().filter(|left_out| left_out.is_part);
        for left_out in lost {
            if !entries.iter().any(|entry| left_out.is_named(entry)) {
                self.missing_parts.push(left_out.clone());
                continue;
            }
            self.notes.push(format!("mesh.drop leaves out of {}: {left_out}", self.file));
            let reason = std::mem::take(&mut left_out.reason);
            let why = if reason.is_empty() { reason } else { format!(" ({reason})") };
            left_out.reason = format!("{DROPPED}{why}");
        }
    }

    /// An error that names the parts which the file has and the answer would lack.
    pub(super) fn lack(&self, at: &Location) -> Option<Diagnostic> {
        if self.missing_parts.is_empty() {
            return None;
        }
        let mut named = first_parts(&self.missing_parts);
        if let more @ 1.. = self.missing_parts.len().saturating_sub(MOST_NAMED) {
            let _ = write!(named, "; {more} more");
        }
        Some(placed!(at.clone(),
            "{} holds, loads or joins parts by what is not understood: {named}; the answer would \
             be that of another structure", self.file; "parts would be missing";
            "say the same in the case (boundaries, ties, contacts, modifications), and what may be \
             left out in [mesh]: {}", drop_key(&self.missing_parts)))
    }

    /// A warning that names what of the file is not used; none where all is.
    pub(super) fn warning(&self, at: &Location) -> Option<Diagnostic> {
        // What `mesh.drop` leaves out is known to the user, what is missing is an error.
        let harmless = |left_out: &&LeftOut| {
            left_out.is_part || left_out.reason.starts_with("the case says what")
        };
        let (quiet, loud): (Vec<&LeftOut>, Vec<&LeftOut>) =
            self.left_out.iter().partition(harmless);
        if loud.is_empty() {
            return None;
        }
        let mut message = format!("{} holds what is not used: {}", self.file, first_parts(&loud));
        let more = loud.len().saturating_sub(MOST_NAMED) + quiet.len();
        if more > 0 {
            let _ = write!(message, "; {more} more (`frictionsim mesh` lists them all)");
        }
        Some(placed!(at.clone(), "{message}"; "not all of it is used";
            "put what matters of it into the case"))
    }

    /// Adds to errors about what was taken the line of the file that says it.
    ///
    /// Where the file cannot be read, sections that it may hold are not asked for.
    pub(super) fn name_places(&self, errors: &mut Vec<Diagnostic>) {
        let is_asked = |error: &Diagnostic| error.message.starts_with("missing section [");
        if self.is_unread && !errors.iter().all(is_asked) {
            errors.retain(|error| !is_asked(error));
        }
        for error in errors {
            let is_meant = |own: &&FileSection| {
                own.path.0 != "material" && error.message.contains(&own.dotted())
            };
            if let Some(section) = self.sections.iter().find(is_meant) {
                let _ = write!(error.message, " ({}, {})", self.file, section.place);
            }
        }
    }

    /// The number that the file gives a dotted key of the case.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        let (path, key) = key.rsplit_once('.')?;
        self.sections.iter().find(|own| own.dotted() == path)?.get(key)?.number()
    }
}
