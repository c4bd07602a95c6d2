//! What a case takes from its mesh file beside the mesh: materials, ties, contact pairs, conditions and motions, as the sections
//! that a case would have for them.
//!
//! Sections of the case win: a key that it gives is not taken. A boundary to which the case gives a condition, a contact or a tie
//! whose surfaces it names and a motion whose axis it gives stand as the case has them alone; elastic constants are taken
//! together, and so are the two coefficients of Rayleigh's damping.

use super::diagnostic::{Diagnostic, Location};
use super::imported;
use super::keys;
use super::raw::RawCase;
use super::value::{RawEntry, RawItem, RawTable, RawValue, quote};
use super::words::{FilePart, UnitsWord, words_of};
use crate::mesh::{
    FileConditionKind, FileContact, FileElasticity, FileMaterial, GmshFile, LeftOut, MaterialAxes,
    ModelData,
};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Entries that a warning names.
const MOST_NAMED: usize = 8;

/// A section as a mesh file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct FileSection {
    /// The section of a case and the name in it, such as `materials` and `disc`.
    pub path: (&'static str, String),
    /// Its keys with their values, in SI units.
    pub keys: Vec<(&'static str, RawValue)>,
    /// Where the file says it.
    pub place: String,
    /// The name that the file has for it, where that is another one.
    pub name: String,
}

/// What a case takes from its mesh file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Taken {
    /// Name of the file in the case.
    pub file: String,
    /// What is taken.
    pub sections: Vec<FileSection>,
    /// How the file was read, and what is taken, in sentences.
    pub notes: Vec<String>,
    /// What is not used.
    pub left_out: Vec<LeftOut>,
}

/// The case with all that it takes from its mesh file, and what that is.
pub(super) fn effective(raw: &mut RawCase) -> (RawTable, Taken) {
    let table = raw.root.clone();
    let text = |key: &str| match raw.find(key).map(|item| &item.value) {
        Some(RawValue::String(text)) => Some(text.clone()),
        _ => None,
    };
    let Some(name) = text("mesh.file") else {
        return (table, Taken::default());
    };
    let units = text("mesh.units").and_then(|word| word_of(&word));
    // A file that cannot be read is told where the body is made of it.
    let Ok(bytes) = imported::mesh_bytes(raw, &name) else {
        return (table, Taken::default());
    };
    raw.mesh = Some(bytes.clone());
    let Ok(file) = bytes.read() else {
        return (table, Taken::default());
    };
    let at = raw.place("mesh.file");
    let parts = parts_taken(raw);
    let mut taken = Taken {
        file: name,
        left_out: file.model.left_out.clone(),
        notes: file.model.remarks.clone(),
        ..Taken::default()
    };
    let sections = sections(&file, units.unwrap_or(UnitsWord::MKgS), &mut taken.left_out);
    let mut merged = table;
    for section in sections {
        if !parts.contains(&part_of(&section)) {
            taken.left_out.push(LeftOut {
                keyword: format!("{} {}", section.path.0, section.path.1),
                place: section.place,
                count: 1,
                reason: "mesh.take leaves it out".to_owned(),
            });
        } else if let Some(section) = merge(&mut merged, section, &at) {
            taken.sections.push(section);
        }
    }
    taken.notes.extend(summary(&taken));
    (merged, taken)
}

/// Which parts of the file the case takes: `mesh.take`, or all.
fn parts_taken(raw: &RawCase) -> Vec<FilePart> {
    let Some(item) = raw.find("mesh.take") else {
        return words_of::<FilePart>().map(|pair| pair.1).collect();
    };
    let word = |item: &RawItem| match &item.value {
        RawValue::String(word) => word_of(word),
        _ => None,
    };
    item.listed().iter().filter_map(word).collect()
}

fn word_of<T: super::words::Choice>(word: &str) -> Option<T> {
    let mut known = words_of::<T>();
    known.find(|pair| pair.0 == word).map(|pair| pair.1)
}

fn part_of(section: &FileSection) -> FilePart {
    match section.path.0 {
        "material" | "materials" => FilePart::Materials,
        "ties" => FilePart::Ties,
        "contacts" => FilePart::Contacts,
        "motion" => FilePart::Motion,
        _ => FilePart::Boundaries,
    }
}

/// All that a file holds as sections of a case, in SI units.
pub(super) fn sections(
    file: &GmshFile,
    units: UnitsWord,
    left_out: &mut Vec<LeftOut>,
) -> Vec<FileSection> {
    let model = &file.model;
    let mut sections: Vec<FileSection> = Vec::new();
    let own = model
        .materials
        .iter()
        .map(|material| material_section(material, units, left_out));
    sections.extend(own);
    sections.extend(common_material(file, &sections));
    if file.dimension == 2 {
        refuse_in_plane(model, left_out);
    } else {
        for tie in &model.ties {
            let keys = vec![
                ("surface", text(&tie.surface)),
                ("counter", text(&tie.counter)),
            ];
            sections.push(section(("ties", &tie.name), keys, &tie.place));
        }
        for contact in &model.contacts {
            let keys = contact_keys(contact, units);
            sections.push(section(("contacts", &contact.name), keys, &contact.place));
        }
        for motion in &model.motions {
            let [from, to] = motion.axis;
            let axis = [0, 1, 2].map(|i| to[i] - from[i]);
            let rpm = motion.angular_velocity * 60.0 / std::f64::consts::TAU;
            let keys = vec![
                ("axis", numbers(&axis)),
                ("center", numbers(&from.map(|x| scaled(x, units.length())))),
                ("rotation_speed_rpm", RawValue::Float(rpm)),
            ];
            sections.push(section(("motion", &motion.region), keys, &motion.place));
        }
    }
    for condition in &model.conditions {
        let keys = match condition.kind {
            FileConditionKind::Pressure(pressure) => vec![
                ("condition", text("pressure")),
                (
                    "pressure",
                    RawValue::Float(scaled(pressure, units.stress())),
                ),
            ],
            FileConditionKind::Fixed(axes) => held(axes, file.dimension),
        };
        sections.push(section(
            ("boundaries", &condition.boundary),
            keys,
            &condition.place,
        ));
    }
    sections
}

fn section(
    path: (&'static str, &str),
    keys: Vec<(&'static str, RawValue)>,
    place: &str,
) -> FileSection {
    FileSection {
        path: (path.0, path.1.to_owned()),
        keys,
        place: place.to_owned(),
        name: path.1.to_owned(),
    }
}

fn held(axes: [bool; 3], dimension: usize) -> Vec<(&'static str, RawValue)> {
    if axes[..dimension].iter().all(|&is_held| is_held) {
        return vec![("condition", text("clamped"))];
    }
    let letters = ["x", "y", "z"].into_iter().zip(axes);
    let letters = letters
        .filter(|(_, is_held)| *is_held)
        .map(|(letter, _)| text(letter));
    vec![
        ("condition", text("fixed")),
        ("directions", list(letters.collect())),
    ]
}

fn contact_keys(contact: &FileContact, units: UnitsWord) -> Vec<(&'static str, RawValue)> {
    let mut keys = vec![
        ("surface", text(&contact.surface)),
        ("counter", text(&contact.counter)),
    ];
    let mut number = |key, value: Option<f64>| {
        keys.extend(value.map(|value| (key, RawValue::Float(value))));
    };
    number("friction_coefficient", contact.friction_coefficient);
    number("static_friction_ratio", contact.decay.map(|decay| decay.0));
    number(
        "decay_speed",
        contact.decay.map(|decay| scaled(decay.1, units.length())),
    );
    let stiffness = |value| scaled(value, units.stress() - units.length());
    number("normal_stiffness", contact.normal_stiffness.map(stiffness));
    keys
}

/// What a plane body cannot take by itself: it has one contact, `[contact]`, and no ties.
fn refuse_in_plane(model: &ModelData, left_out: &mut Vec<LeftOut>) {
    let mut refuse = |what: &str, name: &str, place: &str, reason: &str| {
        left_out.push(LeftOut {
            keyword: format!("{what} {name}"),
            place: place.to_owned(),
            count: 1,
            reason: reason.to_owned(),
        });
    };
    for tie in &model.ties {
        let reason = "plane bodies have no ties: let the parts share their nodes";
        refuse("tie", &tie.name, &tie.place, reason);
    }
    for contact in &model.contacts {
        let reason = "the contact of plane bodies is [contact] with counterface = \"body\"";
        refuse("contact pair", &contact.name, &contact.place, reason);
    }
    for motion in &model.motions {
        refuse(
            "motion of",
            &motion.region,
            &motion.place,
            "the speed of plane bodies is that of [contact]",
        );
    }
}

fn material_section(
    material: &FileMaterial,
    units: UnitsWord,
    left_out: &mut Vec<LeftOut>,
) -> FileSection {
    let stress = |value: f64| RawValue::Float(scaled(value, units.stress()));
    let mut keys = Vec::new();
    match &material.elasticity {
        Some(FileElasticity::Isotropic {
            young_modulus,
            poisson_ratio,
        }) => {
            keys.push(("young_modulus", stress(*young_modulus)));
            keys.push(("poisson_ratio", RawValue::Float(*poisson_ratio)));
        }
        Some(FileElasticity::Orthotropic {
            young_moduli,
            poisson_ratios,
            shear_moduli,
            axes,
        }) => {
            keys.push(("young_moduli", list(young_moduli.map(stress).to_vec())));
            keys.push(("poisson_ratios", numbers(poisson_ratios)));
            keys.push(("shear_moduli", list(shear_moduli.map(stress).to_vec())));
            let axes = match axes {
                MaterialAxes::Global => text("global"),
                MaterialAxes::Vectors([first, second]) => {
                    list(vec![numbers(first), numbers(second)])
                }
                MaterialAxes::Cylindrical(_) => text("cylindrical"),
            };
            keys.push(("axes", axes));
        }
        None => {}
    }
    let density = |value| RawValue::Float(scaled(value, units.density()));
    keys.extend(material.density.map(|value| ("density", density(value))));
    let plain = [
        ("mass_coefficient", material.mass_coefficient),
        ("stiffness_coefficient", material.stiffness_coefficient),
        ("loss_factor", material.loss_factor),
    ];
    for (key, value) in plain
        .into_iter()
        .filter_map(|(key, value)| Some((key, value?)))
    {
        match keys::find(&format!("materials.*.{key}")) {
            Some(_) => keys.push((key, RawValue::Float(value))),
            None => left_out.push(LeftOut {
                keyword: format!("{key} of material {}", material.name),
                place: material.place.clone(),
                count: 1,
                reason: "no material has it here".to_owned(),
            }),
        }
    }
    FileSection {
        name: material.name.clone(),
        ..section(("materials", &material.region), keys, &material.place)
    }
}

/// `[material]` where the file gives every region one of its own: that of the region with most elements, which no region uses.
/// In the plane the formulation, too.
fn common_material(file: &GmshFile, own: &[FileSection]) -> Option<FileSection> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    file.elements
        .iter()
        .for_each(|element| *counts.entry(&element.region).or_default() += 1);
    let of = |region: &str| own.iter().find(|section| section.path.1 == region);
    let is_isotropic = |section: &FileSection| {
        let has = |key: &str| section.keys.iter().any(|known| known.0 == key);
        has("young_modulus") && has("poisson_ratio") && has("density")
    };
    let formulation = match (file.dimension, file.model.is_plane_strain) {
        (3, _) => Some("three-dimensional"),
        (_, Some(true)) => Some("plane-strain"),
        (_, Some(false)) => Some("plane-stress"),
        (_, None) => None,
    };
    let mut keys: Vec<(&'static str, RawValue)> = Vec::new();
    let mut place = String::new();
    let largest = counts.iter().max_by_key(|(_, count)| **count);
    if let (true, Some((region, _))) = (counts.keys().all(|region| of(region).is_some()), largest) {
        let isotropic = of(region).filter(|section| is_isotropic(section));
        let isotropic = isotropic.or_else(|| own.iter().find(|section| is_isotropic(section)))?;
        let common = ["young_modulus", "poisson_ratio", "density"];
        keys = isotropic
            .keys
            .iter()
            .filter(|key| common.contains(&key.0))
            .cloned()
            .collect();
        place.clone_from(&isotropic.place);
    }
    keys.extend(formulation.map(|word| ("formulation", text(word))));
    let is_useful = file.model.is_plane_strain.is_some() || !place.is_empty();
    is_useful.then(|| section(("material", ""), keys, &place))
}

/// Adds to the case what it does not give itself; what was added.
fn merge(root: &mut RawTable, mut section: FileSection, at: &Location) -> Option<FileSection> {
    let (group, name) = (section.path.0, section.path.1.as_str());
    if let Some(of_group) = table_of(root, group) {
        let own = match group {
            "material" => Some(&*of_group),
            _ => table_of(of_group, name),
        };
        if group == "contacts" || group == "ties" {
            let is_known = |entry: &RawEntry| has_sides(entry, &section);
            if own.is_none() && of_group.values().any(is_known) {
                return None;
            }
        }
        if let Some(own) = own {
            section.keys.retain(|(key, _)| !is_given(own, group, key));
        }
    } else if group == "material" && !section.keys.iter().any(|key| key.0 == "density") {
        // A formulation alone makes no material.
        return None;
    } else if group == "contacts" && root.contains_key("contact") {
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
        let item = item(value.clone(), at);
        table.insert(
            (*key).to_owned(),
            RawEntry {
                key_at: at.clone(),
                item,
            },
        );
    }
    Some(section)
}

fn table_of<'t>(table: &'t RawTable, name: &str) -> Option<&'t RawTable> {
    match &table.get(name)?.item.value {
        RawValue::Table(inner) => Some(inner),
        _ => None,
    }
}

/// The table of a name, made where there is none; none where the name stands for something else.
fn entry_table<'t>(table: &'t mut RawTable, name: &str, at: &Location) -> Option<&'t mut RawTable> {
    let entry = table.entry(name.to_owned()).or_insert_with(|| RawEntry {
        key_at: at.clone(),
        item: item(RawValue::Table(RawTable::new()), at),
    });
    match &mut entry.item.value {
        RawValue::Table(inner) => Some(inner),
        _ => None,
    }
}

/// Whether a contact or a tie of the case joins the same two surfaces.
fn has_sides(entry: &RawEntry, section: &FileSection) -> bool {
    let RawValue::Table(table) = &entry.item.value else {
        return false;
    };
    let sides = ["surface", "counter"];
    let of_case = sides.map(|key| table.get(key).map(|entry| &entry.item.value));
    let of_file = sides.map(|key| section.keys.iter().find(|k| k.0 == key).map(|k| &k.1));
    of_case == of_file || of_case == [of_file[1], of_file[0]]
}

/// Whether the case gives a key of a section, or what excludes it.
fn is_given(own: &RawTable, section: &str, key: &str) -> bool {
    let has = |names: &[&str]| names.iter().any(|name| own.contains_key(*name));
    let orthotropic = ["young_moduli", "poisson_ratios", "shear_moduli", "axes"];
    own.contains_key(key)
        || match (section, key) {
            ("boundaries", _) => has(&["condition"]),
            ("contacts" | "ties", _) => has(&["surface", "counter"]),
            ("motion", _) => has(&["axis"]),
            ("materials", "young_modulus" | "poisson_ratio") => {
                has(&orthotropic) || has(&["table"])
            }
            ("materials", key) if orthotropic.contains(&key) => {
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
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for section in taken
        .sections
        .iter()
        .filter(|section| section.path.0 != "material")
    {
        let name = match section.path.0 {
            "materials" => format!("{} ({})", section.path.1, section.name),
            _ => section.path.1.clone(),
        };
        match groups.iter_mut().find(|group| group.0 == section.path.0) {
            Some(group) => group.1.push(name),
            None => groups.push((section.path.0, vec![name])),
        }
    }
    let taken_of = |(group, names): (&str, Vec<String>)| {
        format!("{group} taken from {}: {}", taken.file, names.join(", "))
    };
    groups.into_iter().map(taken_of).collect()
}

impl Taken {
    /// A warning that names what of the file is not used; none where all is.
    pub(super) fn warning(&self, at: &Location) -> Option<Diagnostic> {
        let harmless = |left_out: &&LeftOut| left_out.reason.starts_with("the case says what");
        let (quiet, loud): (Vec<&LeftOut>, Vec<&LeftOut>) =
            self.left_out.iter().partition(harmless);
        if loud.is_empty() {
            return None;
        }
        let mut message = format!("{} holds what is not used: ", self.file);
        let named: Vec<String> = loud
            .iter()
            .take(MOST_NAMED)
            .map(ToString::to_string)
            .collect();
        message.push_str(&named.join("; "));
        let more = loud.len().saturating_sub(MOST_NAMED) + quiet.len();
        if more > 0 {
            let _ = write!(message, "; {more} more (`frictionsim mesh` lists them all)");
        }
        let label = "not all of it is used".to_owned();
        let help = "what matters of it belongs into the case".to_owned();
        Some(Diagnostic::error(message, label, at.clone(), Some(help)))
    }

    /// Adds to errors about what was taken the line of the file that says it.
    pub(super) fn name_places(&self, errors: &mut [Diagnostic]) {
        for error in errors {
            let is_meant = |section: &&FileSection| {
                let path = format!("{}.{}", section.path.0, section.path.1);
                section.path.0 != "material" && error.message.contains(&path)
            };
            if let Some(section) = self.sections.iter().find(is_meant) {
                let _ = write!(error.message, " ({}, {})", self.file, section.place);
            }
        }
    }
}

impl Taken {
    /// The number that the file gives a dotted key of the case.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        let (path, key) = key.rsplit_once('.')?;
        let mut sections = self.sections.iter();
        let section = sections.find(|section| match section.path.0 {
            "material" => path == "material",
            group => {
                path.strip_prefix(group).and_then(|p| p.strip_prefix('.')) == Some(&section.path.1)
            }
        })?;
        section.keys.iter().find(|known| known.0 == key)?.1.number()
    }
}

impl FileSection {
    /// Its head as TOML.
    pub fn head(&self) -> String {
        match self.path.0 {
            "material" => "[material]".to_owned(),
            group => format!("[{group}.{}]", quote(&self.path.1)),
        }
    }
}

fn item(value: RawValue, at: &Location) -> RawItem {
    let value = match value {
        RawValue::Array(items) => {
            let items = items.into_iter().map(|inner| item(inner.value, at));
            RawValue::Array(items.collect())
        }
        other => other,
    };
    RawItem {
        value,
        at: at.clone(),
    }
}

fn text(text: &str) -> RawValue {
    RawValue::String(text.to_owned())
}

fn list(values: Vec<RawValue>) -> RawValue {
    let at = Location::default();
    RawValue::Array(values.into_iter().map(|value| item(value, &at)).collect())
}

fn numbers(values: &[f64]) -> RawValue {
    list(values.iter().map(|&value| RawValue::Float(value)).collect())
}

/// `value 10^power`, its decimal digits kept: 7.85e-9 times 10^12 is 7850.
fn scaled(value: f64, power: i32) -> f64 {
    let text = format!("{value:e}");
    let parts = text.split_once('e').and_then(|(digits, exponent)| {
        let exponent: i32 = exponent.parse().ok()?;
        format!("{digits}e{}", exponent + power).parse().ok()
    });
    parts.unwrap_or(value * 10f64.powi(power))
}
