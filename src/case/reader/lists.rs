//! Lists and ranges.

use super::{Bound, Section};
use crate::case::diagnostic::Location;
use crate::case::range::{Spacing, range_values};
use crate::case::raw::{RawItem, RawTable, RawValue};
use std::cell::RefCell;

/// Longest list that a range may stand for.
const LONGEST_RANGE: usize = 1_000_000;

impl<'a> Section<'a> {
    /// A list of words out of a few.
    pub fn choices<T: Copy>(
        &self,
        key: &'static str,
        choices: &[(&str, T)],
        default: &[T],
    ) -> Vec<T> {
        match self.item(key) {
            None => default.to_vec(),
            Some(RawItem {
                value: RawValue::Array(items),
                ..
            }) if !items.is_empty() => items
                .iter()
                .filter_map(|item| self.read_choice(key, item, choices))
                .collect(),
            Some(item) => self
                .read_choice(key, item, choices)
                .map_or_else(Vec::new, |choice| vec![choice]),
        }
    }

    /// A list of whole numbers of at least `least`, without repetition, each with its place.
    pub fn counts(&self, key: &'static str, least: usize) -> Option<Vec<(usize, Location)>> {
        let item = self.item(key)?;
        let RawValue::Array(items) = &item.value else {
            self.reject_at(item, key, "must be a list of integers");
            return Some(Vec::new());
        };
        let mut values: Vec<(usize, Location)> = Vec::new();
        for item in items {
            let Some(value) = self.read_count(key, item, least) else {
                continue;
            };
            if values.iter().any(|(other, _)| *other == value) {
                self.reject_at(item, key, "must not be listed twice");
            } else {
                values.push((value, item.at.clone()));
            }
        }
        Some(values)
    }

    /// A list of numbers: one by one, a single number, or a range.
    pub fn numbers(&self, key: &'static str, bound: Bound) -> Option<Vec<f64>> {
        let item = self.item(key)?;
        Some(match &item.value {
            RawValue::Array(items) => items
                .iter()
                .filter_map(|item| self.read_number(key, item, bound))
                .collect(),
            RawValue::Table(table) => self.range(key, table, item, bound),
            RawValue::Integer(_) | RawValue::Float(_) => self
                .read_number(key, item, bound)
                .map_or_else(Vec::new, |value| vec![value]),
            _ => {
                self.reject_at(
                    item,
                    key,
                    "must be a list of numbers or a range { from, to, count }",
                );
                Vec::new()
            }
        })
    }

    /// The values of `{ from, to, count, spacing }`; none where something is wrong with it.
    pub fn range(&self, key: &str, table: &'a RawTable, item: &RawItem, bound: Bound) -> Vec<f64> {
        let range = Section {
            findings: self.findings,
            path: self.name(key),
            table: Some(table),
            at: item.at.clone(),
            asked: RefCell::default(),
        };
        let (from, to) = (range.number("from", bound), range.number("to", bound));
        let count = range.count("count", 1);
        let spacing = range.choice(
            "spacing",
            &[("linear", Spacing::Linear), ("log", Spacing::Logarithmic)],
        );
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
