//! Parts, their instances, and the blocks that belong to each.

use super::block::{Block, Row, Scoped};
use crate::prelude::*;

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
    pub blocks: Vec<Scoped<'b, 'a>>,
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
    let mut instance = 0;
    for block in blocks {
        match block.keyword.as_str() {
            // Parts keep their blocks until an instance asks for them.
            "PART" => {
                let name = block.required("NAME")?.to_uppercase();
                ensure!(!parts.contains_key(&name); block; "part {} is defined twice", quoted(&name));
                parts.insert(name.clone(), (block.place, false, Vec::new()));
                part = Some((name, block.place));
            }
            "END PART" => part = None,
            // An instance has a scope of its own, with all blocks of its part.
            "INSTANCE" => {
                let name = block.required("PART")?;
                let (_, is_used, own) = found!(parts.get_mut(&name.to_uppercase()); block;
                    "*INSTANCE: no part is called {}", quoted(name));
                *is_used = true;
                let scope = layout.scopes.len();
                ensure!(scope <= MOST_INSTANCES; block; "more than {MOST_INSTANCES} instances");
                layout.blocks.extend(own.iter().map(|&block| Scoped { scope, block }));
                layout.scopes.push(placed(block)?);
                instance = scope;
            }
            "END INSTANCE" => instance = 0,
            "ASSEMBLY" | "END ASSEMBLY" => {}
            // All else belongs to where it stands: 0 is the assembly and what is outside.
            _ => match part.as_ref().and_then(|(name, _)| parts.get_mut(name)) {
                Some((_, _, own)) => own.push(block),
                None => layout.blocks.push(Scoped { scope: instance, block }),
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
    let wrong = |row: Row<'_>| {
        fault!(row;
            "*INSTANCE {name}: a translation of 3 numbers, then a rotation of 7 (two points of the axis, an angle in \
             degrees) expected, found {}", quoted(row.line))
    };
    let mut rows = block.lines(0);
    let translation = rows.next().map(|row| row.all_numbers::<3>(0).ok_or_else(|| wrong(row)));
    let translation = Vector3::from(translation.transpose()?.unwrap_or_default());
    let turns = rows.map(|row| row.all_numbers(0).ok_or_else(|| wrong(row)));
    let rotation = match turns.collect::<Result<Vec<[f64; 7]>>>()?.first() {
        None => None,
        Some(&[a, b, c, d, e, f, angle]) => {
            let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
            let axis = found!(Unit::try_new(to - from, 0.0); block.deck, block.data[1].0;
                "*INSTANCE {name}: the axis of its rotation is a point");
            Some((from, Rotation3::from_axis_angle(&axis, angle.to_radians())))
        }
    };
    Ok(Scope { name, rotation, translation })
}
