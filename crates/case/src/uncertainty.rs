//! `[uncertainty]`: parameters that are known but roughly.

use super::VariedKey;
use super::parameters::{number, only, read_all};
use crate::*;
use frictionsim_physics::linalg::Distribution;

/// Share of a distribution beyond what its key can take from which on it is refused.
const MOST_BEYOND: f64 = 0.05;

/// Standard deviation of the logarithm beyond which a log-normal distribution is hardly meant: a factor of 20 either
/// way.
const LARGEST_LOG_DEVIATION: f64 = 3.0;

/// A parameter and what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainParameter {
    /// The parameter.
    pub parameter: VariedKey,
    /// Its distribution.
    pub distribution: Distribution,
    /// Probabilities of the distribution between which samples are drawn: all but what its key cannot take.
    pub range: [f64; 2],
}

impl UncertainParameter {
    /// The value at a probability of the part that samples are drawn from.
    pub fn value(&self, probability: f64) -> f64 {
        let [low, high] = self.range;
        self.distribution.quantile(low + (high - low) * probability)
    }
}

/// `[uncertainty]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Samples.
    pub samples: usize,
    /// Samples that the indices are worked out from; each costs one run more than there are parameters. 0 for no
    /// indices.
    pub index_samples: usize,
    /// Seed of their scrambling.
    pub seed: u64,
    /// What is uncertain, in alphabetical order.
    pub parameters: Vec<UncertainParameter>,
}

impl Uncertainty {
    /// Keys of the parameters.
    pub fn keys(&self) -> Vec<String> {
        self.parameters.iter().map(|own| own.parameter.key.clone()).collect()
    }
}

pub(super) fn uncertainty(section: &Section<'_>) -> Uncertainty {
    let samples = section.count("samples");
    let index_samples = section.optional_count("index_samples");
    let found = read_all(section, "distributions", uncertain, |own| &own.parameter);
    const MOST: usize = 16;
    refuse_if!(found.len() > MOST; section, "distributions", "{} parameters are uncertain",
        found.len(); "at most {MOST}"; "leave out those with little influence");
    for (key, count) in [("samples", Some(samples)), ("index_samples", index_samples)] {
        refuse_if!(count.is_some_and(|count| count > 1_000_000); section, key,
            "uncertainty.{key} is above a million"; "at most 1000000");
    }
    refuse_if!(index_samples.is_some_and(|count| count > samples); section, "index_samples",
        "uncertainty.index_samples is above uncertainty.samples"; "at most {samples}");
    Uncertainty {
        samples,
        index_samples: index_samples.unwrap_or_else(|| samples.div_ceil(4)),
        seed: section.count("seed") as u64,
        parameters: found,
    }
}

/// `{ normal = [mean, deviation] }`, `{ log_normal = [median, deviation] }` or `{ uniform = [from, to] }`.
fn uncertain(section: &Section<'_>, parameter: VariedKey, entry: &RawItem) -> UncertainParameter {
    let found = distribution(section, &parameter, entry);
    let harmless = (Distribution::Uniform { from: 0.0, to: 1.0 }, [0.0, 1.0]);
    let (distribution, range) = found.unwrap_or(harmless);
    UncertainParameter { parameter, distribution, range }
}

/// The distribution of a parameter, and its probabilities that samples are drawn between; `None` where something is
/// wrong with it, which is reported.
fn distribution(
    section: &Section<'_>,
    parameter: &VariedKey,
    entry: &RawItem,
) -> Option<(Distribution, [f64; 2])> {
    let key = &parameter.key;
    let help = "a distribution is { normal = [mean, deviation] }, { log_normal = [median, deviation of the logarithm] \
    } or { uniform = [from, to] }";
    let at = &entry.at;
    let refuse = |what: String, label: &str| {
        refuse_at!(section, at, "{what}"; "{label}"; "{help}");
        None
    };
    // One of the three, with a list of two numbers.
    let Some(table) = entry.value.table() else {
        let kind = entry.value.kind();
        return refuse(format!("{key} is {kind}, not a distribution"), "no distribution");
    };
    only(section, table, &["normal", "log_normal", "uniform", "also"]);
    let words = ["normal", "log_normal", "uniform"].into_iter();
    let mut given = words.filter_map(|word| Some((word, table.get(word)?)));
    let Some((word, inner)) = given.next() else {
        return refuse(format!("{key} has no distribution"), "none of the three");
    };
    if given.next().is_some() {
        refuse(format!("{key} has two distributions"), "one of them");
    }
    let RawValue::Array(items) = &inner.value else {
        return refuse(format!("{word} of {key} is no list"), "two numbers");
    };
    let count = items.len();
    if count != 2 {
        return refuse(format!("{word} of {key} takes two numbers, not {count}"), "two numbers");
    }
    let [a, b] = [0, 1].map(|i| number(section, inner, items.get(i)));
    let (distribution, is_valid, needs) = match word {
        "normal" => {
            (Distribution::Normal { mean: a, deviation: b }, b > 0.0, "a positive deviation")
        }
        "log_normal" => {
            let (median, deviation) = (a, b);
            let is_valid = a > 0.0 && b > 0.0;
            (Distribution::LogNormal { median, deviation }, is_valid, "two positive numbers")
        }
        _ => (Distribution::Uniform { from: a, to: b }, a < b, "two rising ends"),
    };
    if !(a.is_finite() && b.is_finite()) {
        // What is no number has been reported.
        return None;
    }
    if !is_valid {
        return refuse(format!("{word} = [{a}, {b}] of {key} needs {needs}"), needs);
    }
    if word == "log_normal" && b > LARGEST_LOG_DEVIATION {
        refuse_at!(section, at,
            "log_normal = [{a}, {b}] of {key}: the second number is the standard deviation of the \
             natural logarithm. One of {b} spans {:.0} powers of ten", b / std::f64::consts::LN_10;
            "at most 3";
            "a scatter of 10 % is {{ log_normal = [median, 0.1] }}; for a deviation in the unit of the key use normal");
        return None;
    }
    let bound = parameter.bound();
    let [least, most] = bound.ends;
    let range = [distribution.below(least), distribution.below(most)];
    let beyond = 1.0 - (range[1] - range[0]);
    let rule = bound.text();
    if beyond > MOST_BEYOND || (beyond > 0.0 && word == "uniform") {
        refuse_at!(section, at,
            "{:.3} % of {word} = [{a}, {b}] of {key} lies where the key {rule}", 100.0 * beyond;
            "reaches forbidden values";
            "make it narrower, or use log_normal, which stays positive");
        return None;
    }
    // What a sample meets once in a million is not worth a word.
    caution_if!(beyond > 1e-6; section, key,
        "{:.4} % of {word} = [{a}, {b}] of {key} lies where the key {rule}: samples are drawn from \
         the rest", 100.0 * beyond; "reaches forbidden values");
    Some((distribution, range))
}
