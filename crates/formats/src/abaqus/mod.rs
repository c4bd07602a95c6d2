//! Reader of the input files of Abaqus and CalculiX.
//!
//! Solid and plane elements of first and second order, parts and instances, sets, surfaces, and the
//! model data around them ([`ModelData`](super::ModelData)). A region is the element set of a
//! `*SOLID SECTION`. Names of what lies in an instance get its name in front, `PAD-1_LINING`. Names
//! are the same in any case of letters, as those programs have it, and keep the spelling of their
//! definition. What has no meaning here is listed in [`ModelData`](super::ModelData); what would
//! change the mesh is refused.
//!
//! Source: Abaqus Keywords Reference Guide; CalculiX CrunchiX USER'S MANUAL.

mod block;
mod conditions;
mod equations;
mod interactions;
mod materials;
mod nodes;
mod scope;
mod sets;
mod surfaces;

use crate::prelude::*;
use block::{Scoped, blocks};
use scope::{Layout, Scope, layout};
use std::cell::RefCell;
use std::hash::Hash;

/// A set under the name with which it was defined.
#[derive(Clone, Debug)]
struct Set<T> {
    name: String,
    /// Each member once, in the order in which they come first.
    items: Vec<T>,
    is_internal: bool,
    known: HashSet<T>,
}

/// Key of a name: its scope, and its capitals.
type Key = (usize, String);

/// Nodes or elements by scope and number, and their sets.
#[derive(Default)]
struct Numbered<T> {
    /// What one of them is called.
    what: &'static str,
    known: HashMap<(usize, usize), T>,
    /// Those of types that are not used.
    skipped: HashSet<(usize, usize)>,
    sets: BTreeMap<Key, Set<T>>,
}

impl<T: Copy + Eq + Hash> Numbered<T> {
    /// Adds members to a set under its key and its full name, if they have one.
    fn add(&mut self, named: Option<(Key, String)>, items: Vec<T>, is_internal: bool) {
        let Some((key, name)) = named else { return };
        let new = || Set { name, items: Vec::new(), is_internal: false, known: HashSet::new() };
        let set = self.sets.entry(key).or_insert_with(new);
        set.items.extend(items.into_iter().filter(|&item| set.known.insert(item)));
        set.is_internal |= is_internal;
    }
}

/// What is read so far. Names are keyed by scope and capitals.
struct Reader<'d, 'a> {
    deck: &'d Deck<'a>,
    blocks: &'d [Scoped<'d, 'a>],
    /// What sets may take yet.
    budget: RefCell<Budget>,
    scopes: Vec<Scope>,
    file: FileMesh,
    nodes: Numbered<u32>,
    elements: Numbered<usize>,
    /// Names of surfaces among those of the mesh file; none of one that was left out.
    surfaces: BTreeMap<Key, Option<String>>,
}

/// Keywords that make nodes or elements which are not written out.
#[rustfmt::skip]
const GENERATORS: [&str; 9] = [
    "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "SUBMODEL",
    "SYMMETRIC MODEL GENERATION",
];

/// Keywords that are read.
#[rustfmt::skip]
const KNOWN: [&str; 26] = [
    "HEADING", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "SOLID SECTION", "MATERIAL", "ELASTIC", "DENSITY", "DAMPING",
    "ORIENTATION", "TIE", "CONTACT PAIR", "SURFACE INTERACTION", "SURFACE BEHAVIOR", "FRICTION", "CHANGE FRICTION", "BOUNDARY",
    "DLOAD", "DSLOAD", "STEP", "END STEP", "MOTION", "INCLUDE", "EQUATION",
];

/// Keywords that hold, load or join parts, and are not read.
#[rustfmt::skip]
const PARTS: [&str; 45] = [
    "COUPLING", "KINEMATIC", "KINEMATIC COUPLING", "DISTRIBUTING", "DISTRIBUTING COUPLING", "MPC", "RIGID BODY", "FASTENER",
    "SHELL TO SOLID COUPLING", "EMBEDDED ELEMENT", "PRE-TENSION SECTION", "CONNECTOR SECTION", "CONNECTOR LOAD",
    "CONNECTOR MOTION", "CONTACT", "CONTACT INCLUSIONS", "CLEARANCE", "CONTACT INTERFERENCE", "CYCLIC SYMMETRY MODEL",
    "SPRING", "DASHPOT", "MASS", "ROTARY INERTIA", "NONSTRUCTURAL MASS", "GAP", "JOINT",
    "BEAM SECTION", "BEAM GENERAL SECTION", "FRAME SECTION", "SHELL SECTION", "SHELL GENERAL SECTION", "MEMBRANE SECTION",
    "SURFACE SECTION", "COHESIVE SECTION", "GASKET SECTION", "SUBSTRUCTURE PROPERTY", "MATRIX INPUT", "MATRIX ASSEMBLE",
    "USER ELEMENT", "UEL PROPERTY", "CLOAD", "FOUNDATION", "BASE MOTION", "REBAR", "REBAR LAYER",
];

/// Keywords of analyses, which the case describes.
#[rustfmt::skip]
const ANALYSES: [&str; 9] = [
    "STATIC", "FREQUENCY", "COMPLEX FREQUENCY", "DYNAMIC", "MODAL DYNAMIC", "STEADY STATE DYNAMICS", "BUCKLE", "VISCO", "CONTROLS",
];

/// Keywords of what is written.
#[rustfmt::skip]
const OUTPUTS: [&str; 14] = [
    "PREPRINT", "RESTART", "OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT", "NODE FILE", "EL FILE", "NODE PRINT",
    "EL PRINT", "CONTACT FILE", "CONTACT PRINT", "FILE FORMAT", "MONITOR",
];

/// Reads an input file; the files that it includes stand in it ([`included_text`](super::included_text)).
pub(super) fn read(bytes: &[u8]) -> Result<FileMesh> {
    let text = String::from_utf8_lossy(bytes);
    let deck = Deck::new(&text, "**", false)?;
    let all = blocks(&deck)?;
    let Layout { scopes, blocks, unused_parts } = layout(&deck, &all)?;
    let mut reader = Reader {
        deck: &deck,
        blocks: &blocks,
        budget: RefCell::new(deck.budget.clone()),
        scopes,
        file: FileMesh::default(),
        nodes: Numbered { what: "node", ..Numbered::default() },
        elements: Numbered { what: "element", ..Numbered::default() },
        surfaces: BTreeMap::new(),
    };
    for (name, place) in unused_parts {
        let keyword = format!("PART {name}");
        reader.leave_out(&keyword, place, "no instance of it is in the assembly");
    }
    reader.refuse_and_list()?;
    reader.read_nodes()?;
    reader.read_elements()?;
    reader.read_sets()?;
    reader.read_surfaces()?;
    reader.read_materials()?;
    reader.read_interactions()?;
    reader.read_conditions()?;
    ensure!(!reader.file.elements.is_empty(); deck, deck.end();
        "the file has no solid or plane elements (*ELEMENT, TYPE=C3D10, C3D8, CPE4, ...)");
    reader.keep_node_sets();
    Ok(finished(reader.file))
}

impl<'d, 'a> Reader<'d, 'a> {
    /// Blocks of a keyword.
    fn blocks_of(
        &self,
        keyword: &'static str,
    ) -> impl Iterator<Item = Scoped<'d, 'a>> + use<'d, 'a> {
        self.blocks.iter().copied().filter(move |block| block.keyword == keyword)
    }

    fn leave_out(&mut self, keyword: &str, place: Place, reason: &str) {
        self.file.model.leave_out(keyword, || self.deck.name(place), (reason, false));
    }

    /// Leaves out what would hold, load or join parts.
    fn lose_part(&mut self, keyword: &str, place: Place, reason: &str) {
        self.file.model.leave_out(keyword, || self.deck.name(place), (reason, true));
    }

    /// Refuses what would change the mesh, and lists the keywords that are not used.
    fn refuse_and_list(&mut self) -> Result<()> {
        for block in self.blocks {
            let keyword = block.keyword.as_str();
            ensure!(!GENERATORS.contains(&keyword); block;
                "*{keyword} is not supported: have the program write the mesh out with every node and element");
            ensure!(keyword != "INCLUDE"; block; "*INCLUDE needs INPUT= and a file beside this one");
            let is_part = match keyword {
                // Temperatures load what expands.
                "TEMPERATURE" => self.blocks_of("EXPANSION").next().is_some(),
                "INITIAL CONDITIONS" => block.is("TYPE", "STRESS"),
                _ => PARTS.contains(&keyword),
            };
            if is_part {
                self.lose_part(&format!("*{keyword}"), block.place, "");
                continue;
            }
            let reason = match keyword {
                _ if KNOWN.contains(&keyword) => continue,
                _ if ANALYSES.contains(&keyword) => "the case says what is computed",
                _ if OUTPUTS.contains(&keyword) => "the case says what is written",
                _ => "",
            };
            self.leave_out(&format!("*{keyword}"), block.place, reason);
        }
        let title = self.blocks_of("HEADING").next().and_then(|block| block.rows().next());
        self.file.model.title = title.map(|row| row.line.trim().to_owned());
        Ok(())
    }

    /// The scope and the name that a reference means, seen from a scope: `INSTANCE.NAME` or `NAME`.
    fn resolved<'n>(&self, scope: usize, name: &'n str) -> (usize, &'n str) {
        let of_instance = |(instance, rest)| Some((self.instance(instance)?, rest));
        name.split_once('.').and_then(of_instance).unwrap_or((scope, name))
    }

    /// The scope of an instance.
    fn instance(&self, name: &str) -> Option<usize> {
        let is_meant = |scope: &Scope| scope.name.eq_ignore_ascii_case(name);
        self.scopes.iter().position(is_meant).filter(|&scope| scope > 0)
    }

    /// The key of a name seen from a scope.
    fn key(&self, scope: usize, name: &str) -> Key {
        let (scope, name) = self.resolved(scope, name.trim().trim_matches('"'));
        (scope, name.to_uppercase())
    }

    /// The key of a name and the name in full.
    fn named(&self, scope: usize, name: &str) -> (Key, String) {
        let key = self.key(scope, name);
        let full = self.scopes[key.0].full_name(name);
        (key, full)
    }

    /// Those of the set that a parameter of a block names, if it does.
    fn named_by(&self, block: Scoped<'_, '_>, parameter: &str) -> Option<(Key, String)> {
        block.parameter(parameter).map(|name| self.named(block.scope, name))
    }

    /// The scope of a block of sets: that of the parameter `INSTANCE`, or its own.
    fn scope_of(&self, block: Scoped<'_, '_>) -> Result<usize> {
        let Some(name) = block.parameter("INSTANCE") else { return Ok(block.scope) };
        Ok(
            found!(self.instance(name); block; "*{}: no instance is called \"{name}\"", block.keyword),
        )
    }

    /// An error that a name is not defined.
    fn unknown(&self, place: Place, what: &str, name: &str) -> MeshFileError {
        let shown: String = name.chars().take(80).collect();
        let own = shown.rsplit('.').next().unwrap_or_default().to_uppercase();
        let has_elements = what == "node set" && self.elements.sets.keys().any(|key| key.1 == own);
        let remedy = match has_elements {
            true => "; an element set is: *NSET, NSET=NAME, ELSET=ITS NAME gives its nodes a name",
            false => "",
        };
        self.deck.error(place, format!("no {what} is called \"{shown}\"{remedy}"))
    }
}

/// The file that a line includes, `*INCLUDE, INPUT=` or `INPUT=` of nodes and elements, whose own line stays.
pub(super) fn included(line: &str) -> Option<(&str, bool)> {
    if !line.trim_start().starts_with('*') {
        return None;
    }
    let upper = line.to_ascii_uppercase();
    let keyword = upper.split(',').next()?.trim().strip_prefix('*')?.trim();
    let stays = match keyword {
        "INCLUDE" => false,
        "NODE" | "ELEMENT" | "NSET" | "ELSET" => true,
        _ => return None,
    };
    let value = upper.find("INPUT")?;
    let rest = line[value + "INPUT".len()..].trim_start().strip_prefix('=')?;
    let name = rest.split(',').next()?.trim().trim_matches('"');
    (!name.is_empty()).then_some((name, stays))
}
