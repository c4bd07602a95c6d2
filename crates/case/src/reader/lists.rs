//! Lists, ranges, and nodes by number or by place.

use super::Section;
use crate::*;
use crate::{Bound, Kind, Spacing, keys};

/// Longest list that a range may stand for.
const LONGEST_RANGE: usize = 100_000;

/// How a case names a node by its place.
const PLACE: &str = "{ x, y } or { radius, angle_deg }, with z on solid bodies";

/// How a case names a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodePlace {
    /// By its number.
    Number(usize),
    /// As the nearest to a point, m; on the top face of a body of revolution where no `z` is given.
    Point([f64; 2], Option<f64>),
    /// As the nearest to a radius, m, and an angle about the axis, rad.
    Polar { radius: f64, angle: f64, z: Option<f64> },
}

impl<'a> Section<'a> {
    /// Reads the section of a name, if the case has it.
    pub fn read_section<T>(&self, name: &str, read: impl FnOnce(&Section<'a>) -> T) -> Option<T> {
        let section = self.section(name, false);
        section.is_given().then(|| section.closed(read))
    }

    /// What is read of a section, all of whose keys are known then.
    pub fn closed<T>(self, read: impl FnOnce(&Section<'a>) -> T) -> T {
        let value = read(&self);
        self.close();
        value
    }

    /// Reads every section under `name`, which are told apart by names that the case gives.
    pub fn each<T>(&self, name: &str, mut read: impl FnMut(&Section<'_>) -> T) -> Vec<(String, T)> {
        let all = self.section(name, false);
        let mut read = |name: &str| all.section(name, false).closed(&mut read);
        let names = all.remaining().into_iter();
        let found = names.map(|(name, _)| (name.to_owned(), read(name))).collect();
        all.close();
        found
    }

    /// The items of a list; one value is a list of itself alone.
    fn listed(&self, key: &str) -> &'a [RawItem] {
        self.item(key).map_or(&[], RawItem::listed)
    }

    /// A list of words out of a few; empty where it is not given.
    pub fn choices<T: Choice>(&self, key: &str) -> Vec<T> {
        refuse_if!(self.list_length(key) == Some(0); self, key => "is an empty list";
            "at least one word");
        self.listed(key).iter().filter_map(|item| self.read_choice(key, item)).collect()
    }

    /// Texts: one or a list; empty where it is not given.
    pub fn texts(&self, key: &str) -> Vec<String> {
        let text = |item: &RawItem| match &item.value {
            RawValue::String(text) => Some(text.clone()),
            _ => self.reject_at(item, key, "must be a string, or a list of strings"),
        };
        self.listed(key).iter().filter_map(text).collect()
    }

    /// A list of whole numbers without repetition, each with its place, or the default.
    pub fn counts(&self, key: &str) -> Option<Vec<(usize, Location)>> {
        let least = self.least(key);
        let listed = self.held(key)?;
        let mut values: Vec<(usize, Location)> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for item in listed.listed() {
            let Some(value) = self.read_count(key, item, least) else { continue };
            if seen.insert(value) {
                values.push((value, item.at.clone()));
            } else {
                self.reject_at::<()>(item, key, "must not be listed twice");
            }
        }
        Some(values)
    }

    /// The key `harmonics`: those that a mesh of so many elements around can hold.
    pub fn harmonics(&self, sectors: Option<usize>) -> Option<Vec<usize>> {
        let values = self.counts("harmonics")?;
        let elements = sectors.unwrap_or(0);
        let highest = elements / 2;
        for (value, at) in &values {
            if *value > highest && elements > 0 {
                refuse_at!(self, at,
                    "harmonic {value} in {} is above the mesh's highest, {highest}",
                    self.name("harmonics"); "at most half of {elements} elements";
                    "lower the harmonic or raise mesh.circumferential_elements");
            }
        }
        Some(values.into_iter().map(|(value, _)| value).collect())
    }

    /// A list of numbers in rising order; equal ones are an error.
    pub fn rising(&self, key: &str) -> Option<Vec<f64>> {
        let mut values = self.numbers(key)?;
        values.sort_by(f64::total_cmp);
        if let Some(pair) = values.windows(2).find(|pair| pair[0] == pair[1]) {
            refuse!(self, key => "has {} twice", pair[0]; "every value once");
        }
        Some(values)
    }

    /// A list of numbers: one by one, a single number, a range, or the default.
    pub fn numbers(&self, key: &str) -> Option<Vec<f64>> {
        let bound = match self.declared(key).kind {
            Kind::Numbers(bound) => bound,
            _ => Bound::FINITE,
        };
        let item = self.held(key)?;
        if let RawValue::Table(table) = &item.value {
            return Some(self.range(key, table, &item, bound));
        }
        if self.is_some_text(key) {
            let bound = "must be a list of numbers or a range { from, to, count }";
            return self.reject_at(&item, key, bound).or(Some(Vec::new()));
        }
        let values = item.listed().iter();
        Some(values.filter_map(|item| self.read_number(key, item, bound)).collect())
    }

    /// So many numbers: as given, else the default, with 0 where that is shorter.
    pub fn vector<const N: usize>(&self, key: &str) -> [f64; N] {
        let mut values = self.numbers(key).unwrap_or_default();
        if self.has(key) && values.len() != N {
            self.no_vector::<N>(key, &format!("needs {} numbers", ["two", "three"][N - 2]));
            values.clear();
        }
        // A direction is harmless where there is nothing to read.
        std::array::from_fn(|place| match values.as_slice() {
            [] => f64::from(u8::from(place == 0)),
            values => values.get(place).copied().unwrap_or(0.0),
        })
    }

    /// Says what so many numbers look like.
    pub fn no_vector<const N: usize>(&self, key: &str, what: &str) {
        let (names, example) = (["x", "y", "z"][..N].join(", "), &[1.0, 0.0, 0.0][..N]);
        refuse!(self, key => "{what}"; "must be [{names}]"; "for example `{key} = {example:?}`");
    }

    /// A list of lists of numbers; `None` where the key is left out or a word.
    pub fn vectors(&self, key: &str) -> Option<Vec<Vec<f64>>> {
        let item = self.item(key)?;
        if self.is_some_text(key) {
            return None;
        }
        let of_one = |item: &RawItem| -> Vec<f64> {
            let values = item.listed().iter();
            values.filter_map(|item| self.read_number(key, item, Bound::FINITE)).collect()
        };
        Some(item.listed().iter().map(of_one).collect())
    }

    /// The values of `{ from, to, count, spacing }`; none where something is wrong with it.
    pub fn range(&self, key: &str, table: &RawTable, item: &RawItem, bound: Bound) -> Vec<f64> {
        let mut range = Section::new(self.findings, self.name(key), Some(table), item.at.clone());
        range.declarations = Some(&keys::RANGE);
        let [from, to] = ["from", "to"].map(|end| {
            let value = range.number(end);
            match table.get(end) {
                Some(item) if !bound.admits(value) && value.is_finite() => {
                    range.reject_at(item, end, &bound.text()).unwrap_or(f64::NAN)
                }
                _ => value,
            }
        });
        let count = range.count("count");
        let spacing = range.choice("spacing");
        range.close();
        if from.is_nan() || to.is_nan() || count == 0 {
            return Vec::new();
        }
        let refuse = |message: &str| self.reject_at(item, key, message).unwrap_or_default();
        if count > LONGEST_RANGE {
            return refuse(&format!("must have a count of at most {LONGEST_RANGE}"));
        }
        if spacing == Spacing::Logarithmic && !(from > 0.0 && to > 0.0) {
            return refuse("must have positive ends for logarithmic spacing");
        }
        if count > 1 && from == to {
            return refuse("must have two different ends");
        }
        range_values(from, to, count, spacing)
    }

    /// A list of nodes, each with its place in the case.
    pub fn nodes(&self, key: &str) -> Vec<(NodePlace, Location)> {
        let read = |item: &'a RawItem| Some((self.read_node(key, item)?, item.at.clone()));
        self.listed(key).iter().filter_map(read).collect()
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
            _ => return self.reject_at(item, key, &format!("must be a node number, {PLACE}")),
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
            _ => return self.reject_at(item, key, &format!("must be {PLACE}")),
        };
        let is_read = [x, y, z, radius, angle].into_iter().flatten();
        is_read.into_iter().all(f64::is_finite).then_some(found)
    }
}

/// `count` values from `from` to `to`, both included exactly.
///
/// Linear: `from + (to - from) i / (count - 1)`; logarithmic: `from (to / from)^(i / (count - 1))`.
/// Values between the ends are rounded to 15 significant digits, so that the 16th of 51 values from
/// 0 to 1 is the number a person writes as 0.3. One value alone is `from`.
///
/// Does not check its arguments: a logarithmic range wants two positive ends.
pub fn range_values(from: f64, to: f64, count: usize, spacing: Spacing) -> Vec<f64> {
    let last = count.saturating_sub(1);
    (0..count)
        .map(|i| match (spacing, i as f64, last as f64) {
            _ if i == 0 => from,
            _ if i == last => to,
            (Spacing::Linear, step, steps) => rounded(from + (to - from) * step / steps, 15),
            (Spacing::Logarithmic, step, steps) => {
                rounded(from * (to / from).powf(step / steps), 15)
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ranges_hold_the_decimal_values_a_person_expects() {
        for count in [51, 101, 1001] {
            let values = range_values(0.0, 1.0, count, Spacing::Linear);
            assert_eq!(values.len(), count);
            assert_eq!((values[0], values[count - 1]), (0.0, 1.0));
            assert_eq!(values[3 * (count - 1) / 10], 0.3);
            for (i, value) in values.iter().enumerate() {
                let decimals = format!("{value}").len();
                assert!(decimals <= 5, "{i} {value}");
            }
        }
    }

    #[test]
    fn logarithmic_ranges_have_equal_ratios_and_exact_ends() {
        let values = range_values(10.0, 6000.0, 24, Spacing::Logarithmic);
        assert_eq!((values[0], values[23]), (10.0, 6000.0));
        let ratio = 600f64.powf(1.0 / 23.0);
        for pair in values.windows(2) {
            // Both values are rounded to 15 digits.
            assert!((pair[1] / pair[0] / ratio - 1.0).abs() < 1e-13);
        }
    }
}
