//! Parts, their instances, and the blocks that belong to each.

use super::block::{Block, fields};
use crate::deck::{Deck, Place, quoted, real};
use crate::file_mesh::Result;
use nalgebra::{Rotation3, Unit, Vector3};
use std::collections::BTreeMap;

/// Copies of parts in one file: more are a mistake.
const MOST_INSTANCES: usize = 10_000;

/// What names belong to: the file as a whole (the first one), or one instance of a part.
#[derive(Debug, Default)]
pub(super) struct Scope {
    /// Name of the instance, as written; empty for the file as a whole.
    pub name: String,
    rotation: Option<(Vector3<f64>, Rotation3<f64>)>,
    translation: Vector3<f64>,
}

impl Scope {
    /// A point of the part where the instance has it: translated, then turned about an axis.
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let point = Vector3::from(point) + self.translation;
        match &self.rotation {
            Some((origin, turn)) => (origin + turn * (point - origin)).into(),
            None => point.into(),
        }
    }

    /// A name of this scope among those of the whole model.
    pub fn full_name(&self, name: &str) -> String {
        match self.name.as_str() {
            "" => name.to_owned(),
            instance => format!("{instance}_{name}"),
        }
    }
}

/// Scopes, and blocks each with the scope that it belongs to; blocks of a part stand once for each of its instances.
pub(super) struct Layout<'b, 'a> {
    pub scopes: Vec<Scope>,
    pub blocks: Vec<(usize, &'b Block<'a>)>,
    /// Parts without an instance, with their places.
    pub unused_parts: Vec<(String, Place)>,
}

type Parts<'b, 'a> = BTreeMap<String, (Place, bool, Vec<&'b Block<'a>>)>;

/// Sorts the blocks of a file by part and instance.
pub(super) fn layout<'b, 'a>(deck: &Deck<'_>, blocks: &'b [Block<'a>]) -> Result<Layout<'b, 'a>> {
    let mut layout =
        Layout { scopes: vec![Scope::default()], blocks: Vec::new(), unused_parts: Vec::new() };
    let mut parts: Parts<'b, 'a> = BTreeMap::new();
    let mut part: Option<(String, Place)> = None;
    let mut instance: Option<usize> = None;
    for block in blocks {
        match block.keyword.as_str() {
            // Parts keep their blocks until an instance asks for them.
            "PART" => {
                let name = block.required("NAME")?.to_uppercase();
                if parts.contains_key(&name) {
                    refuse!(block; "part {} is defined twice", quoted(&name));
                }
                parts.insert(name.clone(), (block.place, false, Vec::new()));
                part = Some((name, block.place));
            }
            "END PART" => part = None,
            // An instance has a scope of its own, with all blocks of its part.
            "INSTANCE" => {
                let name = block.required("PART")?;
                let found = parts.get_mut(&name.to_uppercase());
                let Some((_, is_used, own)) = found else {
                    refuse!(block; "*INSTANCE: no part is called {}", quoted(name));
                };
                *is_used = true;
                let scope = layout.scopes.len();
                if scope > MOST_INSTANCES {
                    refuse!(block; "more than {MOST_INSTANCES} instances");
                }
                layout.blocks.extend(own.iter().map(|&block| (scope, block)));
                layout.scopes.push(placed(block)?);
                instance = Some(scope);
            }
            "END INSTANCE" => instance = None,
            "ASSEMBLY" | "END ASSEMBLY" => {}
            // All else belongs to where it stands: 0 is the assembly and what is outside.
            _ => match (&part, instance) {
                (Some((name, _)), _) => {
                    if let Some((_, _, own)) = parts.get_mut(name) {
                        own.push(block);
                    }
                }
                (None, Some(scope)) => layout.blocks.push((scope, block)),
                (None, None) => layout.blocks.push((0, block)),
            },
        }
    }
    if let Some((name, place)) = part {
        refuse!(deck, place; "*END PART of part {} is missing", quoted(&name));
    }
    let unused = parts.into_iter().filter(|(_, part)| !part.1);
    layout.unused_parts = unused.map(|(name, part)| (name, part.0)).collect();
    Ok(layout)
}

/// The scope of an instance: its data lines say how it is moved, first by a vector, then about the line through two points.
fn placed(block: &Block<'_>) -> Result<Scope> {
    let name = block.required("NAME")?.to_owned();
    let mut rows = Vec::new();
    for &(place, line) in &block.data {
        let row: Option<Vec<f64>> = fields(line).map(real).collect();
        let is_right = |row: &Vec<f64>| row.len() == if rows.is_empty() { 3 } else { 7 };
        let Some(row) = row.filter(is_right) else {
            refuse!(block.deck, place;
                "*INSTANCE {name}: a translation of 3 numbers, then a rotation of 7 (two points of \
                 the axis, an angle in degrees) expected, found {}", quoted(line));
        };
        rows.push(row);
    }
    let translation = rows.first().map_or(Vector3::zeros(), |t| Vector3::new(t[0], t[1], t[2]));
    let rotation = match rows.get(1) {
        None => None,
        Some(r) => {
            let (from, to) = (Vector3::new(r[0], r[1], r[2]), Vector3::new(r[3], r[4], r[5]));
            let Some(axis) = Unit::try_new(to - from, 0.0) else {
                refuse!(block.deck, block.data[1].0;
                    "*INSTANCE {name}: the axis of its rotation is a point");
            };
            Some((from, Rotation3::from_axis_angle(&axis, r[6].to_radians())))
        }
    };
    Ok(Scope { name, rotation, translation })
}
