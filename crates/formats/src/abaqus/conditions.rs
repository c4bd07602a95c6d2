//! `*BOUNDARY`, `*DLOAD`, `*DSLOAD` and `*MOTION`, as the last step leaves them.

use super::Reader;
use super::block::{Block, fields};
use super::interactions::unique;
use crate::collection::{dimension, used_nodes};
use crate::deck::{Place, quoted, real};
use crate::file_mesh::Result;
use crate::model_data::{FileCondition, FileConditionKind, FileMotion};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

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
        for &(scope, block) in self.blocks {
            match block.keyword.as_str() {
                "STEP" => step += 1,
                // What holds: displacements of zero, of no other kind.
                "BOUNDARY" => {
                    if block.is("OP", "NEW") {
                        held.clear();
                    }
                    let own = block.parameter("TYPE").unwrap_or("DISPLACEMENT").to_uppercase();
                    if own != "DISPLACEMENT" || block.has("SUBMODEL") || block.has("BASE MOTION") {
                        self.lose_part(&format!("*BOUNDARY, TYPE={own}"), block.place, "");
                        continue;
                    }
                    self.boundary(scope, block, &mut held)?;
                }
                // What loads: pressures on faces or surfaces.
                keyword @ ("DLOAD" | "DSLOAD") => {
                    if block.is("OP", "NEW") {
                        pressures.clear();
                    }
                    self.load(scope, block, keyword, &mut pressures)?;
                }
                "MOTION" => self.motion(scope, block)?,
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
            let place = self.deck.name(place);
            let kind = FileConditionKind::Pressure(pressure);
            self.file.model.conditions.push(FileCondition { boundary, kind, place });
        }
        Ok(())
    }

    /// Nodes whose degrees of freedom are along axes of their own.
    fn transformed(&mut self) -> Result<BTreeSet<u32>> {
        let mut nodes = BTreeSet::new();
        for (scope, block) in self.blocks_of("TRANSFORM") {
            let name = block.required("NSET")?;
            let Some(set) = self.nodes.sets.get(&self.key(scope, name)) else {
                return Err(self.unknown(block.place, "node set", name));
            };
            nodes.extend(set.items.iter().copied());
        }
        Ok(nodes)
    }

    fn boundary(&mut self, scope: usize, block: &Block<'_>, held: &mut Held) -> Result<()> {
        for &(place, line) in &block.data {
            let entry: Vec<&str> = fields(line).collect();
            let (target, what) = (entry[0], entry.get(1).copied().unwrap_or_default());
            let word = WORDS.iter().find(|(word, _)| word.eq_ignore_ascii_case(what));
            let axes = match word {
                Some((_, axes)) => *axes,
                None => {
                    let number = |i: usize| {
                        entry.get(i).filter(|f| !f.is_empty()).map(|f| f.parse::<usize>())
                    };
                    let (Some(Ok(first)), last) = (number(1), number(2)) else {
                        refuse!(self.deck, place;
                            "a direction 1 to 6 or a word such as ENCASTRE expected, found {}",
                            quoted(what));
                    };
                    let Ok(last) = last.unwrap_or(Ok(first)) else {
                        refuse!(self.deck, place;
                            "a last direction expected, found {}", quoted(entry[2]));
                    };
                    let value = entry.get(3).and_then(|value| real(value)).unwrap_or(0.0);
                    if value != 0.0 && !block.has("FIXED") {
                        let reason =
                            "only displacements of zero are taken: these directions stay free";
                        self.lose_part("*BOUNDARY with a displacement", place, reason);
                        continue;
                    }
                    [1, 2, 3].map(|axis| (first..=last).contains(&axis))
                }
            };
            let key = self.target(scope, place, target, axes)?;
            let known = held.entry(key).or_insert(([false; 3], place));
            (0..3).for_each(|axis| known.0[axis] |= axes[axis]);
        }
        Ok(())
    }

    /// The node set that a line of `*BOUNDARY` is about; nodes by their numbers are gathered by the directions held.
    fn target(
        &mut self,
        scope: usize,
        place: Place,
        target: &str,
        axes: [bool; 3],
    ) -> Result<(usize, String)> {
        let key = self.key(scope, target);
        if self.nodes.sets.contains_key(&key) {
            return Ok(key);
        }
        let (there, name) = self.resolved(scope, target);
        if name.parse::<usize>().is_err() {
            return Err(self.unknown(place, "node set", target));
        }
        let nodes = self.entry(&self.nodes, there, place, name)?.unwrap_or_default();
        let letters = ["_1", "_2", "_3"].into_iter().zip(axes);
        let letters: String = letters.filter(|(_, is_held)| *is_held).map(|l| l.0).collect();
        let single = format!("{SINGLE_NODES}{letters}");
        self.nodes.add(Some(self.named(0, &single)), nodes, false);
        Ok((0, single.to_uppercase()))
    }

    /// Conditions of the sets that are held; what has no meaning here is left out.
    fn take_held(&mut self, held: Held, transformed: &BTreeSet<u32>, referred: &BTreeSet<u32>) {
        let in_plane = dimension(&self.collected) == 2;
        let used = used_nodes(&self.collected);
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
                let place = self.deck.name(place);
                let kind = FileConditionKind::Fixed(axes);
                self.file.model.conditions.push(FileCondition { boundary, kind, place });
            }
        }
    }

    /// Pressures on surfaces and on faces of elements.
    fn load(
        &mut self,
        scope: usize,
        block: &Block<'_>,
        keyword: &str,
        pressures: &mut Pressures,
    ) -> Result<()> {
        for &(place, line) in &block.data {
            let entry: Vec<&str> = fields(line).collect();
            let kind = entry.get(1).copied().unwrap_or_default().to_uppercase();
            if keyword == "DLOAD" && kind == "CENTRIF" {
                self.centrifugal(scope, place, line)?;
                continue;
            }
            let is_surface = keyword == "DSLOAD" && kind == "P";
            let is_face = keyword == "DLOAD"
                && kind.strip_prefix('P').is_some_and(|n| n.parse::<usize>().is_ok());
            if !is_surface && !is_face {
                let reason = "pressures on surfaces and faces are taken, other loads are not";
                self.lose_part(&format!("*{keyword}, {kind}"), place, reason);
                continue;
            }
            let value = entry.get(2).and_then(|value| real(value)).ok_or_else(|| {
                fault!(self.deck, place; "*{keyword}: a pressure expected, found {}", quoted(line))
            })?;
            let surface = match is_surface {
                true => self
                    .surface_name(scope, entry[0])
                    .ok_or_else(|| self.unknown(place, "surface", entry[0]))?,
                false => self.loaded_faces(scope, place, entry[0], &kind)?,
            };
            pressures.insert(surface, (value, place));
        }
        Ok(())
    }

    /// The surface of face `P<number>` of an element or of a set of them.
    fn loaded_faces(
        &mut self,
        scope: usize,
        place: Place,
        set: &str,
        side: &str,
    ) -> Result<String> {
        let elements = self.items(&self.elements, scope, place, set)?;
        let (there, name) = self.resolved(scope, set);
        let full = match self.elements.sets.get(&self.key(scope, set)) {
            Some(known) => format!("{}_{side}", known.name),
            None => format!("{}_{side}", self.scopes[there].full_name(&format!("element_{name}"))),
        };
        let faces: Result<Vec<_>, _> =
            elements.iter().map(|&e| self.side(e, side, place)).collect();
        self.file.surfaces.insert(full.clone(), faces?);
        Ok(full)
    }

    /// `*MOTION, ROTATION`: the speed at which nodes pass, of the regions that it covers.
    fn motion(&mut self, scope: usize, block: &Block<'_>) -> Result<()> {
        if !block.has("ROTATION") {
            self.leave_out("*MOTION without ROTATION", block.place, "");
            return Ok(());
        }
        for &(place, line) in &block.data {
            let mut entry = fields(line);
            let target = entry.next().unwrap_or_default();
            let numbers: Option<Vec<f64>> = entry.map(real).collect();
            let Some(&[speed, a, b, c, d, e, f]) = numbers.as_deref() else {
                refuse!(self.deck, place;
                    "a speed and two points of the axis (3 + 3 numbers) expected");
            };
            let nodes = self.items(&self.nodes, scope, place, target)?;
            let nodes: BTreeSet<u32> = nodes.into_iter().collect();
            let elements = self.collected.iter();
            let is_inside = elements.map(|e| e.nodes.iter().all(|node| nodes.contains(node)));
            let is_inside: Vec<bool> = is_inside.collect();
            let axis = [[a, b, c], [d, e, f]];
            if !self.turn_regions(&is_inside, place, (axis, speed, false)) {
                let reason = "its nodes are not those of whole regions";
                self.leave_out("*MOTION, ROTATION", place, reason);
            }
        }
        Ok(())
    }

    /// Gives a motion, its axis, speed and whether it is a load, to the regions whose elements are all among those marked; whether
    /// there is one.
    fn turn_regions(
        &mut self,
        is_inside: &[bool],
        place: Place,
        (axis, angular_velocity, is_load): ([[f64; 3]; 2], f64, bool),
    ) -> bool {
        let mut covers: BTreeMap<Option<Arc<str>>, bool> = BTreeMap::new();
        for (element, is_inside) in self.collected.iter().zip(is_inside) {
            *covers.entry(element.region.clone()).or_insert(true) &= is_inside;
        }
        let regions = covers.into_iter().filter(|c| c.1).filter_map(|c| c.0);
        let regions: Vec<Arc<str>> = regions.collect();
        for region in &regions {
            let motions = &mut self.file.model.motions;
            motions.retain(|motion| *motion.region != **region);
            let (region, place) = (region.to_string(), self.deck.name(place));
            motions.push(FileMotion { region, axis, angular_velocity, is_load, place });
        }
        !regions.is_empty()
    }

    /// `*DLOAD`, `CENTRIF`: the squared speed at which elements turn, a point of the axis and its direction.
    fn centrifugal(&mut self, scope: usize, place: Place, line: &str) -> Result<()> {
        let mut entry = fields(line);
        let target = entry.next().unwrap_or_default();
        let numbers: Option<Vec<f64>> = entry.skip(1).map(real).collect();
        let Some(&[square, a, b, c, d, e, f]) = numbers.as_deref() else {
            refuse!(self.deck, place;
                "CENTRIF: the square of a speed, a point of the axis and its direction (1 + 3 + 3 \
                 numbers) expected");
        };
        if square < 0.0 {
            refuse!(self.deck, place; "CENTRIF: the square of a speed is not negative");
        }
        let elements = self.items(&self.elements, scope, place, target)?;
        let mut is_inside = vec![false; self.collected.len()];
        elements.into_iter().for_each(|e| is_inside[e] = true);
        let axis = [[a, b, c], [a + d, b + e, c + f]];
        if !self.turn_regions(&is_inside, place, (axis, square.sqrt(), true)) {
            self.lose_part("*DLOAD, CENTRIF", place, "its elements are not those of whole regions");
        }
        Ok(())
    }
}
