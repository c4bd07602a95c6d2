//! Nodes, by number or by place.

use super::Section;
use crate::case::diagnostic::Location;
use crate::case::keys;
use crate::case::value::{RawItem, RawValue};

/// How a case names a node by its place.
const PLACE: &str = "{ x, y } or { radius, angle_deg }, with z on solid bodies";

/// How a case names a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::case) enum NodePlace {
    /// By its number.
    Number(usize),
    /// As the nearest to a point, m; on the top face of a body of revolution where no `z` is given.
    Point([f64; 2], Option<f64>),
    /// As the nearest to a radius, m, and an angle about the axis, rad.
    Polar { radius: f64, angle: f64, z: Option<f64> },
}

impl<'a> Section<'a> {
    /// A list of nodes, each with its place in the case.
    pub fn nodes(&self, key: &str) -> Vec<(NodePlace, Location)> {
        let items = self.item(key).map_or(&[][..], RawItem::listed).iter();
        items.filter_map(|item| Some((self.read_node(key, item)?, item.at.clone()))).collect()
    }

    /// One node; none where it is not given or wrong.
    pub fn node(&self, key: &str) -> Option<(NodePlace, Location)> {
        let item = self.item(key)?;
        Some((self.read_node(key, item)?, item.at.clone()))
    }

    fn read_node(&self, key: &str, item: &'a RawItem) -> Option<NodePlace> {
        let table = match &item.value {
            RawValue::Table(table) => table,
            RawValue::Integer(_) | RawValue::Float(_) => {
                return self.read_count(key, item, 1).map(NodePlace::Number);
            }
            _ => {
                let wanted = format!("must be a node number, {PLACE}");
                self.reject_at(item, key, &wanted);
                return None;
            }
        };
        let mut place = Section::new(self.findings, self.name(key), Some(table), item.at.clone());
        place.declarations = Some(&keys::PLACE);
        let [x, y, z, radius, angle] =
            ["x", "y", "z", "radius", "angle_deg"].map(|part| place.optional_number(part));
        place.close();
        let found = match (x, y, radius, angle) {
            (Some(x), Some(y), None, None) => NodePlace::Point([x, y], z),
            (None, None, Some(radius), Some(angle)) => {
                NodePlace::Polar { radius, angle: angle.to_radians(), z }
            }
            _ => {
                self.reject_at(item, key, &format!("must be {PLACE}"));
                return None;
            }
        };
        let is_read = [x, y, z, radius, angle].into_iter().flatten();
        is_read.into_iter().all(f64::is_finite).then_some(found)
    }
}
