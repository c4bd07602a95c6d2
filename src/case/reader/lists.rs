//! Lists and ranges.

use super::Section;
use crate::case::diagnostic::Location;
use crate::case::key::{Bound, Kind};
use crate::case::range::{Spacing, range_values};
use crate::case::value::{RawItem, RawTable, RawValue};
use crate::case::{keys, refuse, refuse_at};

/// Longest list that a range may stand for.
const LONGEST_RANGE: usize = 100_000;

impl<'a> Section<'a> {
    /// Reads every section under `name`, which are told apart by names that the case gives.
    pub fn each<T>(&self, name: &str, mut read: impl FnMut(&Section<'_>) -> T) -> Vec<(String, T)> {
        let all = self.section(name, false);
        let names: Vec<&str> = all.remaining().into_iter().map(|(name, _)| name).collect();
        let found = names.into_iter().map(|name| {
            let section = all.section(name, false);
            let value = read(&section);
            section.close();
            (name.to_owned(), value)
        });
        let found = found.collect();
        all.close();
        found
    }

    /// A list of whole numbers without repetition, each with its place, or the default.
    pub fn counts(&self, key: &str) -> Option<Vec<(usize, Location)>> {
        let least = self.least(key);
        let Some(item) = self.item(key) else {
            let items = self.default_items(key)?.into_iter();
            let count = |item| Some((self.read_count(key, &item, least)?, self.place(key)));
            return Some(items.filter_map(count).collect());
        };
        let mut values: Vec<(usize, Location)> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for item in item.listed() {
            let Some(value) = self.read_count(key, item, least) else {
                continue;
            };
            if seen.insert(value) {
                values.push((value, item.at.clone()));
            } else {
                self.reject_at(item, key, "must not be listed twice");
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
            _ => Bound::Finite,
        };
        let Some(item) = self.item(key) else {
            let items = self.default_items(key)?.into_iter();
            return Some(items.filter_map(|item| self.read_number(key, &item, bound)).collect());
        };
        if let RawValue::Table(table) = &item.value {
            return Some(self.range(key, table, item, bound));
        }
        if self.is_some_text(key) {
            self.reject_at(item, key, "must be a list of numbers or a range { from, to, count }");
            return Some(Vec::new());
        }
        let values = item.listed().iter();
        Some(values.filter_map(|item| self.read_number(key, item, bound)).collect())
    }

    /// The list that stands for a key that is left out.
    fn default_items(&self, key: &str) -> Option<Vec<RawItem>> {
        match self.declared(key).default_value()? {
            RawValue::Array(items) => Some(items),
            _ => None,
        }
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
            values.filter_map(|item| self.read_number(key, item, Bound::Finite)).collect()
        };
        Some(item.listed().iter().map(of_one).collect())
    }

    /// The values of `{ from, to, count, spacing }`; none where something is wrong with it.
    pub fn range(&self, key: &str, table: &'a RawTable, item: &RawItem, bound: Bound) -> Vec<f64> {
        let mut range = Section::new(self.findings, self.name(key), Some(table), item.at.clone());
        range.declarations = Some(&keys::RANGE);
        let [from, to] = ["from", "to"].map(|end| {
            let value = range.number(end);
            match table.get(end) {
                Some(entry) if !bound.admits(value) && value.is_finite() => {
                    range.reject_at(&entry.item, end, &bound.text());
                    f64::NAN
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
        let refuse = |message: &str| {
            self.reject_at(item, key, message);
            Vec::new()
        };
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
}
