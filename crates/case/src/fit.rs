//! `[fit]`: which parameters are fitted to measured modes, and where they are sought.

use super::parameters::{number, only, read_all};
use super::{Spacing, VariedKey, reader::declared};
use crate::*;

/// A parameter with the bounds between which it is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct FitParameter {
    /// The parameter.
    pub parameter: VariedKey,
    /// Its smallest value.
    pub from: f64,
    /// Its largest value.
    pub to: f64,
    /// Whether it is sought itself or its logarithm.
    pub scale: Spacing,
}

impl FitParameter {
    /// The value at a place, 0 at the lower and 1 at the upper bound.
    pub fn value(&self, place: f64) -> f64 {
        match (place, self.scale) {
            (0.0, _) => self.from,
            (1.0, _) => self.to,
            (_, Spacing::Logarithmic) => self.from * (self.to / self.from).powf(place),
            (_, Spacing::Linear) => self.from + (self.to - self.from) * place,
        }
    }

    /// The place of a value.
    pub fn place(&self, value: f64) -> f64 {
        match self.scale {
            Spacing::Logarithmic => (value / self.from).ln() / (self.to / self.from).ln(),
            Spacing::Linear => (value - self.from) / (self.to - self.from),
        }
    }

    /// `d value / d place`.
    pub fn slope(&self, place: f64) -> f64 {
        match self.scale {
            Spacing::Logarithmic => self.value(place) * (self.to / self.from).ln(),
            Spacing::Linear => self.to - self.from,
        }
    }
}

declared! {
    /// `[fit]`.
    Fit {
        starts: usize = count, "Points within the bounds at which the search looks first.";
        shape_weight: f64 = number, "What a measured shape counts that has nothing of its line's mode: the share of \
            the frequency that counts as much.";
    } with {
        parameters: Vec<FitParameter>, "What is fitted, in alphabetical order.";
    }
}

pub(super) fn fit(section: &Section<'_>) -> Fit {
    Fit::declared(section, read_all(section, "parameters", bounds, |own| &own.parameter))
}

/// `[from, to]` or `{ from, to, scale, also }`.
fn bounds(section: &Section<'_>, parameter: VariedKey, entry: &RawItem) -> FitParameter {
    let key = &parameter.key;
    let at = &entry.at;
    let help = "bounds are [0.3, 0.45] or { from = 1e10, to = 1e13, scale = \"log\" }";
    let mut scale = Spacing::Linear;
    let [from, to] = match &entry.value {
        RawValue::Array(items) if items.len() == 2 => {
            [0, 1].map(|end| number(section, entry, items.get(end)))
        }
        RawValue::Table(table) => {
            only(section, table, &["from", "to", "scale", "also"]);
            if let Some(given) = table.get("scale").map(|scale| &scale.value) {
                match given.text().and_then(Spacing::of) {
                    Some(word) => scale = word,
                    None => refuse_at!(section, at, "scale = {} of {key}", given.shortened();
                        "must be \"linear\" or \"log\""; "{help}"),
                }
            }
            ["from", "to"].map(|end| number(section, entry, table.get(end)))
        }
        other => {
            refuse_at!(section, at, "the bounds of {key} are {}, not two numbers", other.kind();
                "not bounds"; "{help}");
            [f64::NAN; 2]
        }
    };
    for value in [from, to] {
        if value.is_finite() && !parameter.bound().admits(value) {
            refuse_at!(section, at, "{key} = {value} {}", parameter.bound().text();
                "a bound outside what the key allows"; "choose narrower bounds");
        }
    }
    if from >= to {
        refuse_at!(section, at, "the bounds of {key} are {from} and {to}"; "must rise";
            "the first must be below the second");
    } else if scale == Spacing::Logarithmic && from <= 0.0 {
        refuse_at!(section, at, "scale = \"log\" of {key} needs positive bounds, not {from}";
            "no logarithm"; "raise the lower bound above 0, or use scale = \"linear\"");
    }
    FitParameter { parameter, from, to, scale }
}
