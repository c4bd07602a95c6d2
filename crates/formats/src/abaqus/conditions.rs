//! `*BOUNDARY`, `*DLOAD`, `*DSLOAD` and `*MOTION`, as the last step leaves them.

use super::Reader;
use super::block::{Row, Scoped};
use super::interactions::unique;
use crate::prelude::*;

/// Directions that words of `*BOUNDARY` hold; rotations mean nothing to solid elements.
const WORDS: [(&str, [bool; 3]); 8] = [
    ("ENCASTRE", [true, true, true]),
    ("PINNED", [true, true, true]),
    ("XSYMM", [true, false, false]),
    ("YSYMM", [false, true, false]),
    ("ZSYMM", [false, false, true]),
    ("XASYMM", [false, true, true]),
    ("YASYMM", [true, false, true]),
    ("ZASYMM", [true, true, false]),
];

/// Name of the boundary of single nodes that are held alike.
const SINGLE_NODES: &str = "held_nodes";

/// What a set of nodes bears: held axes, and where that is said.
pub(super) type Held = BTreeMap<(usize, String), ([bool; 3], Place)>;

/// Pressures by surface.
type Pressures = BTreeMap<String, (f64, Place)>;

impl Reader<'_, '_> {
    /// Reads what holds, loads and turns the bodies. Steps follow each other: each changes what is there, `OP=NEW` begins anew.
    pub(super) fn read_conditions(&mut self) -> Result<()> {
        let (mut held, mut pressures) = (Held::new(), Pressures::new());
        let transformed = self.transformed()?;
        let mut step = 0;
        for &block in self.blocks {
            let is_new = block.is("OP", "NEW");
            match block.keyword.as_str() {
                "STEP" => step += 1,
                // What holds: displacements of zero, of no other kind.
                "BOUNDARY" => {
                    if is_new {
                        held.clear();
                    }
                    let own = block.parameter("TYPE").unwrap_or("DISPLACEMENT").to_uppercase();
                    if own != "DISPLACEMENT" || block.has("SUBMODEL") || block.has("BASE MOTION") {
                        self.lose_part(&format!("*BOUNDARY, TYPE={own}"), block.place, "");
                        continue;
                    }
                    self.boundary(block, &mut held)?;
                }
                // What loads: pressures on faces or surfaces.
                "DLOAD" | "DSLOAD" => {
                    if is_new {
                        pressures.clear();
                    }
                    self.load(block, &mut pressures)?;
                }
                "MOTION" => self.motion(block)?,
                _ => {}
            }
        }
        if step > 0 {
            let plural = if step == 1 { "step" } else { "steps" };
            self.file.model.remarks.push(format!(
                "conditions, pressures and friction are those at the end of {step} {plural}"
            ));
        }
        // What is left at the end; equations need to know which nodes are held.
        let referred = self.read_equations(&held)?;
        self.take_held(held, &transformed, &referred);
        for (boundary, (pressure, place)) in pressures {
            self.bear(boundary, FileConditionKind::Pressure(pressure), place);
        }
        Ok(())
    }

    fn bear(&mut self, boundary: String, kind: FileConditionKind, place: Place) {
        let place = self.deck.name(place);
        self.file.model.conditions.push(FileCondition { boundary, kind, place });
    }

    /// Nodes whose degrees of freedom are along axes of their own.
    fn transformed(&mut self) -> Result<BTreeSet<u32>> {
        let mut nodes = BTreeSet::new();
        for block in self.blocks_of("TRANSFORM") {
            let name = block.required("NSET")?;
            let set = self.nodes.sets.get(&self.key(block.scope, name));
            let set = set.ok_or_else(|| self.unknown(block.place, "node set", name))?;
            nodes.extend(set.items.iter().copied());
        }
        Ok(nodes)
    }

    fn boundary(&mut self, block: Scoped<'_, '_>, held: &mut Held) -> Result<()> {
        for row in block.rows() {
            let what = row.field(1);
            let word = WORDS.iter().find(|(word, _)| word.eq_ignore_ascii_case(what));
            let axes = if let Some((_, axes)) = word {
                *axes
            } else {
                let first = found!(what.parse::<usize>().ok(); row;
                    "a direction 1 to 6 or a word such as ENCASTRE expected, found {}", quoted(what));
                let last = match row.field(2) {
                    "" => first,
                    last => {
                        found!(last.parse().ok(); row; "a last direction expected, found {}", quoted(last))
                    }
                };
                if real(row.field(3)).unwrap_or(0.0) != 0.0 && !block.has("FIXED") {
                    let reason = "only displacements of zero are taken: these directions stay free";
                    self.lose_part("*BOUNDARY with a displacement", row.place, reason);
                    continue;
                }
                [1, 2, 3].map(|axis| (first..=last).contains(&axis))
            };
            let key = self.target(row, axes)?;
            let known = held.entry(key).or_insert(([false; 3], row.place));
            (0..3).for_each(|axis| known.0[axis] |= axes[axis]);
        }
        Ok(())
    }

    /// The node set that a line of `*BOUNDARY` is about; nodes by their numbers are gathered by the directions held.
    fn target(&mut self, row: Row<'_>, axes: [bool; 3]) -> Result<(usize, String)> {
        let target = row.field(0);
        let key = self.key(row.scope, target);
        if self.nodes.sets.contains_key(&key) {
            return Ok(key);
        }
        let (scope, name) = self.resolved(row.scope, target);
        if name.parse::<usize>().is_err() {
            return Err(self.unknown(row.place, "node set", target));
        }
        let nodes = self.items(&self.nodes, Row { scope, ..row }, name)?;
        let letters = ["_1", "_2", "_3"].into_iter().zip(axes);
        let letters: String = letters.filter(|(_, is_held)| *is_held).map(|l| l.0).collect();
        let (key, single) = self.named(0, &format!("{SINGLE_NODES}{letters}"));
        self.nodes.add(Some((key.clone(), single)), nodes, false);
        Ok(key)
    }

    /// Conditions of the sets that are held; what has no meaning here is left out.
    fn take_held(&mut self, held: Held, transformed: &BTreeSet<u32>, referred: &BTreeSet<u32>) {
        let in_plane = dimension(&self.file.elements) == 2;
        let used = used_nodes(&self.file.elements);
        for (key, (mut axes, place)) in held {
            let Some(set) = self.nodes.sets.get(&key).cloned() else {
                continue;
            };
            if in_plane {
                axes[2] = false;
            }
            let keyword = format!("*BOUNDARY of {}", set.name);
            let nodes: Vec<u32> =
                set.items.iter().copied().filter(|node| used.contains(node)).collect();
            let is_whole = axes == [true, true, !in_plane];
            if !axes.contains(&true) {
                let reason = "rotations of nodes have no meaning in solid elements";
                self.leave_out(&keyword, place, reason);
            } else if nodes.is_empty() && set.items.iter().all(|node| referred.contains(node)) {
                // Its part is played in the equations.
            } else if nodes.is_empty() {
                let reason = "none of its nodes belongs to a solid (plane) element";
                self.leave_out(&keyword, place, reason);
            } else if !is_whole && nodes.iter().any(|node| transformed.contains(node)) {
                let reason = "its directions are those of *TRANSFORM: hold it in the case (condition = \"guide\" or \"fixed\")";
                self.lose_part(&keyword, place, reason);
            } else {
                let is_other = |name: &str| self.file.surfaces.contains_key(name);
                let boundary = match is_other(&set.name) {
                    true => unique(&format!("{}_nodes", set.name), is_other),
                    false => set.name.clone(),
                };
                self.file.node_sets.insert(boundary.clone(), nodes);
                self.bear(boundary, FileConditionKind::Fixed(axes), place);
            }
        }
    }

    /// Pressures on surfaces and on faces of elements.
    fn load(&mut self, block: Scoped<'_, '_>, pressures: &mut Pressures) -> Result<()> {
        let keyword = block.keyword.as_str();
        for row in block.rows() {
            let kind = row.field(1).to_uppercase();
            let face = kind.strip_prefix('P').and_then(|number| number.parse::<usize>().ok());
            let is_surface = match (keyword, kind.as_str()) {
                ("DSLOAD", "P") => true,
                ("DLOAD", "CENTRIF") => {
                    self.centrifugal(row)?;
                    continue;
                }
                ("DLOAD", _) if face.is_some() => false,
                _ => {
                    let reason = "pressures on surfaces and faces are taken, other loads are not";
                    self.lose_part(&format!("*{keyword}, {kind}"), row.place, reason);
                    continue;
                }
            };
            let value = found!(real(row.field(2)); row;
                "*{keyword}: a pressure expected, found {}", quoted(row.line));
            let target = row.field(0);
            let surface = match is_surface {
                true => self
                    .surface_name(row, target)
                    .ok_or_else(|| self.unknown(row.place, "surface", target))?,
                false => self.loaded_faces(row, &kind)?,
            };
            pressures.insert(surface, (value, row.place));
        }
        Ok(())
    }

    /// The surface of face `P<number>` of an element or of a set of them.
    fn loaded_faces(&mut self, row: Row<'_>, side: &str) -> Result<String> {
        let set = row.field(0);
        let elements = self.items(&self.elements, row, set)?;
        let (there, name) = self.resolved(row.scope, set);
        let full = match self.elements.sets.get(&self.key(row.scope, set)) {
            Some(known) => format!("{}_{side}", known.name),
            None => format!("{}_{side}", self.scopes[there].full_name(&format!("element_{name}"))),
        };
        let faces = elements.iter().map(|&e| self.side(e, side, row)).collect::<Result<_>>()?;
        self.file.surfaces.insert(full.clone(), faces);
        Ok(full)
    }

    /// `*MOTION, ROTATION`: the speed at which nodes pass, of the regions that it covers.
    fn motion(&mut self, block: Scoped<'_, '_>) -> Result<()> {
        if !block.has("ROTATION") {
            self.leave_out("*MOTION without ROTATION", block.place, "");
            return Ok(());
        }
        for row in block.rows() {
            let [speed, a, b, c, d, e, f] = found!(row.all_numbers(1); row;
                "a speed and two points of the axis (3 + 3 numbers) expected");
            let nodes = self.items(&self.nodes, row, row.field(0))?;
            let nodes: BTreeSet<u32> = nodes.into_iter().collect();
            let elements = self.file.elements.iter();
            let is_inside = elements.map(|e| e.nodes.iter().all(|node| nodes.contains(node)));
            let is_inside: Vec<bool> = is_inside.collect();
            if !self.turn_regions(&is_inside, row, ([[a, b, c], [d, e, f]], speed, false)) {
                let reason = "its nodes are not those of whole regions";
                self.leave_out("*MOTION, ROTATION", row.place, reason);
            }
        }
        Ok(())
    }

    /// Gives a motion, its axis, speed and whether it is a load, to the regions whose elements are all among those marked; whether
    /// there is one.
    fn turn_regions(
        &mut self,
        is_inside: &[bool],
        row: Row<'_>,
        (axis, angular_velocity, is_load): ([[f64; 3]; 2], f64, bool),
    ) -> bool {
        let mut covers: BTreeMap<Arc<str>, bool> = BTreeMap::new();
        for (element, is_inside) in self.file.elements.iter().zip(is_inside) {
            *covers.entry(element.region.clone()).or_insert(true) &= is_inside;
        }
        covers.retain(|region, is_covered| *is_covered && !region.is_empty());
        for region in covers.keys() {
            let motions = &mut self.file.model.motions;
            motions.retain(|motion| *motion.region != **region);
            let (region, place) = (region.to_string(), self.deck.name(row.place));
            motions.push(FileMotion { region, axis, angular_velocity, is_load, place });
        }
        !covers.is_empty()
    }

    /// `*DLOAD`, `CENTRIF`: the squared speed at which elements turn, a point of the axis and its direction.
    fn centrifugal(&mut self, row: Row<'_>) -> Result<()> {
        let [square, a, b, c, d, e, f] = found!(row.all_numbers(2); row;
            "CENTRIF: the square of a speed, a point of the axis and its direction (1 + 3 + 3 numbers) expected");
        ensure!(square >= 0.0; row; "CENTRIF: the square of a speed is not negative");
        let mut is_inside = vec![false; self.file.elements.len()];
        for element in self.items(&self.elements, row, row.field(0))? {
            is_inside[element] = true;
        }
        let axis = [[a, b, c], [a + d, b + e, c + f]];
        if !self.turn_regions(&is_inside, row, (axis, square.sqrt(), true)) {
            let reason = "its elements are not those of whole regions";
            self.lose_part("*DLOAD, CENTRIF", row.place, reason);
        }
        Ok(())
    }
}
