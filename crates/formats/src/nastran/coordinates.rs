//! Coordinate systems: `CORD1R`, `CORD1C`, `CORD1S`, `CORD2R`, `CORD2C`, `CORD2S`.

use super::card::Card;
use crate::prelude::*;

/// How a system measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Rectangular,
    Cylindrical,
    Spherical,
}

/// How a system is placed.
#[derive(Clone, Copy, Debug)]
enum Definition {
    /// Three points in another system: origin, on its z axis, in its x-z plane.
    Points(usize, [[f64; 3]; 3]),
    /// Three nodes that lie there.
    Nodes([usize; 3]),
}

/// A point in a system, and the place that gives it.
type Given = (usize, [f64; 3], Place);

/// A coordinate system in basic coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct System {
    pub kind: Kind,
    origin: Vector3<f64>,
    /// Its axes as columns.
    pub axes: Matrix3<f64>,
}

impl System {
    /// A point in basic coordinates.
    fn place(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let local = match self.kind {
            Kind::Rectangular => Vector3::new(a, b, c),
            Kind::Cylindrical => {
                let (sin, cos) = b.to_radians().sin_cos();
                Vector3::new(a * cos, a * sin, c)
            }
            Kind::Spherical => {
                let ((st, ct), (sp, cp)) = (b.to_radians().sin_cos(), c.to_radians().sin_cos());
                Vector3::new(a * st * cp, a * st * sp, a * ct)
            }
        };
        (self.origin + self.axes * local).into()
    }
}

/// Systems and nodes of a file, each found where it is needed.
pub(super) struct Coordinates<'d, 'a> {
    deck: &'d Deck<'a>,
    definitions: BTreeMap<usize, (Kind, Definition, Place)>,
    /// System and coordinates of each node.
    pub grids: BTreeMap<usize, Given>,
    known: BTreeMap<usize, System>,
}

impl<'d, 'a> Coordinates<'d, 'a> {
    /// The systems that cards define.
    pub fn new(deck: &'d Deck<'a>, cards: &[Card<'_>]) -> Result<Self> {
        let mut definitions = BTreeMap::new();
        for card in cards {
            let Some(rest) = card.name.strip_prefix("CORD") else { continue };
            let kind = match rest.get(1..) {
                Some("R") => Kind::Rectangular,
                Some("C") => Kind::Cylindrical,
                Some("S") => Kind::Spherical,
                _ => continue,
            };
            let has_nodes = rest.starts_with('1');
            // A card has room for two systems of three nodes, or for one of three points.
            let starts = [0, 4].into_iter().take(if has_nodes { 2 } else { 1 });
            for start in starts.filter(|&start| !card.field(start).is_empty()) {
                let number = card.number(start)?;
                let definition = if has_nodes {
                    let node = |i: usize| card.number(start + i);
                    Definition::Nodes([node(1)?, node(2)?, node(3)?])
                } else {
                    let reference = card.optional_system(1)?.unwrap_or(0);
                    Definition::Points(reference, [card.point(2)?, card.point(5)?, card.point(8)?])
                };
                let known = definitions.insert(number, (kind, definition, card.place));
                ensure!(known.is_none(); card; "coordinate system {number} is defined twice");
            }
        }
        Ok(Self { deck, definitions, grids: BTreeMap::new(), known: BTreeMap::new() })
    }

    /// A point of a system in basic coordinates; system 0 is the basic one. `place` asks for it.
    pub fn point(&mut self, system: usize, point: [f64; 3], place: Place) -> Result<[f64; 3]> {
        if system == 0 { Ok(point) } else { Ok(self.system(system, place)?.place(point)) }
    }

    /// A system by its number, after those that define it: a chain of them is as long as the file likes.
    pub fn system(&mut self, number: usize, place: Place) -> Result<System> {
        let (mut open, mut is_open) = (vec![(number, place)], BTreeSet::from([number]));
        while let Some(&(number, place)) = open.last() {
            if !self.known.contains_key(&number) {
                let (defined, points) = self.defining_points(number, place)?;
                let missing =
                    points.iter().find(|point| point.0 != 0 && !self.known.contains_key(&point.0));
                if let Some(&(other, _, there)) = missing {
                    ensure!(is_open.insert(other); self.deck, defined;
                        "coordinate system {other} is defined by itself");
                    open.push((other, there));
                    continue;
                }
                let known = |system| self.known.get(&system);
                let basic =
                    points.map(|(system, own, _)| known(system).map_or(own, |k| k.place(own)));
                let system = self.placed(number, basic)?;
                self.known.insert(number, system);
            }
            is_open.remove(&number);
            open.pop();
        }
        Ok(self.known[&number])
    }

    /// The three points of a system, each with the system that it is given in and the place that gives it.
    fn defining_points(&self, number: usize, place: Place) -> Result<(Place, [Given; 3])> {
        let &(_, definition, defined) = found!(self.definitions.get(&number); self.deck, place;
            "no coordinate system has the number {number}");
        let points = match definition {
            Definition::Points(reference, given) => given.map(|own| (reference, own, defined)),
            Definition::Nodes(nodes) => {
                let mut points = [(0, [0.0; 3], defined); 3];
                for (point, node) in points.iter_mut().zip(nodes) {
                    *point = *found!(self.grids.get(&node); self.deck, defined;
                        "coordinate system {number} names node {node}, which the file does not have");
                }
                points
            }
        };
        Ok((defined, points))
    }

    /// The system of three points in basic coordinates.
    fn placed(&self, number: usize, points: [[f64; 3]; 3]) -> Result<System> {
        let (kind, _, defined) = self.definitions[&number];
        let [origin, on_axis, in_plane] = points.map(Vector3::from);
        let third = (on_axis - origin).try_normalize(0.0);
        let second = third.and_then(|z| z.cross(&(in_plane - origin)).try_normalize(0.0));
        let (z, y) = found!(third.zip(second); self.deck, defined;
            "the three points of coordinate system {number} lie on one line");
        Ok(System { kind, origin, axes: Matrix3::from_columns(&[y.cross(&z), y, z]) })
    }
}
