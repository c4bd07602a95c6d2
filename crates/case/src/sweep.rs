//! `[sweep]`: any case key over several values.

use super::{Analysis, Bound, Combination, VariedKey, parameters, value::range_count};
use crate::*;

/// A swept key and its values.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptKey {
    /// The key.
    pub varied: VariedKey,
    /// Values, as TOML.
    pub values: Vec<String>,
}

/// `[sweep]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Swept keys in alphabetical order.
    pub keys: Vec<SweptKey>,
    /// How they combine.
    pub combination: Combination,
    /// What runs at each point; empty if the case leaves that to the sections it has.
    pub analyses: Vec<Analysis>,
}

impl Sweep {
    /// Number of points.
    pub fn point_count(&self) -> usize {
        let counts = self.keys.iter().map(|key| key.values.len());
        match self.combination {
            Combination::Grid => counts.fold(1, usize::saturating_mul),
            Combination::Zip => counts.min().unwrap_or(0),
        }
    }

    /// The overrides that make point `index`, one for each key and for each that goes with it, in the order of the
    /// keys.
    pub fn overrides(&self, index: usize) -> Vec<String> {
        let mut rest = index;
        let of_key = |key: &SweptKey| {
            let at = match self.combination {
                Combination::Grid => rest % key.values.len(),
                Combination::Zip => index,
            };
            rest /= key.values.len();
            key.varied.overrides(&key.values[at])
        };
        // The last key is the fastest.
        let mut each: Vec<Vec<String>> = self.keys.iter().rev().map(of_key).collect();
        each.reverse();
        each.concat()
    }
}

pub(super) fn read(root: &Section<'_>) -> Option<Sweep> {
    let section = Some(root.section("sweep", false)).filter(Section::is_given)?;
    let combination = section.choice("combine");
    let analyses = section.choices("analyses");
    let entries = parameters::collect(&section, check);
    // Sizes are known before a single value is made.
    if !fits(&section, combination, &entries) {
        return None;
    }
    let keys: Vec<SweptKey> =
        entries.into_iter().map(|own| values(&section, combination, own)).collect();
    parameters::refuse_twice(&section, keys.iter().map(|key| &key.varied));
    if section.remaining().is_empty() {
        refuse_at!(section, &section.place(""), "[sweep] sweeps nothing"; "no key with values";
            "add for example `\"contact.friction_coefficient\" = [0.2, 0.3, 0.4]`");
    }
    if combination == Combination::Zip
        && let Some((first, rest)) = keys.split_first()
        && let Some(other) = rest.iter().find(|k| k.values.len() != first.values.len())
    {
        refuse_at!(section, &other.varied.at, "\"{}\" has {} values but \"{}\" has {}",
            other.varied.key, other.values.len(), first.varied.key, first.values.len();
            "zipped keys need equally many values";
            "give them the same count, or combine = \"grid\"");
    }
    Some(Sweep { keys, combination, analyses })
}

/// Most points of a study, and most values of its keys together.
const MOST_POINTS: usize = 1_000_000;

/// Sections on which no result depends that the points of a sweep have.
const UNUSED: [&str; 7] =
    ["sweep", "frf", "improve", "convergence", "fit", "uncertainty", "output"];

/// Whether a key can be swept; else why not.
fn check(section: &Section<'_>, name: &str) -> Result<(), String> {
    parameters::known(section, name, |_| true)?;
    let unused = UNUSED.iter().find(|own| name.split('.').next() == Some(own));
    unused.map_or(Ok(()), |own| Err(format!("no result of a sweep depends on [{own}]")))
}

/// The values of an entry: its own, or those beside `also`.
fn listed(entry: &RawItem) -> &RawItem {
    entry.value.table().and_then(|table| table.get("values")).unwrap_or(entry)
}

/// How many values an entry stands for.
fn length(entry: &RawItem) -> usize {
    match &listed(entry).value {
        RawValue::Array(items) => items.len(),
        RawValue::Table(table) => range_count(table),
        _ => 1,
    }
}

/// Refuses studies of too many points or values.
fn fits(section: &Section<'_>, how: Combination, entries: &[(VariedKey, &RawItem)]) -> bool {
    let lengths = entries.iter().map(|(_, entry)| length(entry));
    let (count, what) = match how {
        Combination::Grid => (lengths.fold(1, usize::saturating_mul), "points"),
        Combination::Zip => (lengths.fold(0, usize::saturating_add), "values"),
    };
    let most = entries.iter().max_by_key(|(_, entry)| length(entry));
    if let Some((varied, entry)) = most.filter(|_| count > MOST_POINTS) {
        refuse_at!(section, &entry.at,
            "[sweep] has {count} {what}, most of them for \"{}\"", varied.key;
            "at most {MOST_POINTS}"; "sweep fewer values");
    }
    count <= MOST_POINTS
}

/// The values of a swept key.
fn values(
    section: &Section<'_>,
    combination: Combination,
    (varied, entry): (VariedKey, &RawItem),
) -> SweptKey {
    let key = &varied.key;
    if let Some(table) = entry.value.table().filter(|table| table.contains_key("values")) {
        parameters::only(section, table, &["values", "also"]);
    }
    let entry = listed(entry);
    let values: Vec<String> = match &entry.value {
        RawValue::Array(items) => items.iter().map(|item| item.value.to_string()).collect(),
        RawValue::Table(table) => {
            let range = section.range(key, table, entry, Bound::FINITE).into_iter();
            range.map(|value| RawValue::Float(value).to_string()).collect()
        }
        other => vec![other.to_string()],
    };
    if values.is_empty() && matches!(entry.value, RawValue::Array(_)) {
        refuse_at!(section, &entry.at, "\"{key}\" in [sweep] has no values";
            "at least one value"; "list its values or give a range {{ from, to, count }}");
    }
    let mut seen = BTreeSet::new();
    let twice = values.iter().find(|value| !seen.insert(*value));
    if let Some(value) = twice.filter(|_| combination == Combination::Grid) {
        refuse_at!(section, &entry.at, "\"{key}\" in [sweep] has the value {value} twice";
            "its points would run twice"; "list each value once");
    }
    SweptKey { varied: VariedKey { at: entry.at.clone(), ..varied }, values }
}

/// Tries each value of a study on its own, all others as the case has them, so that a bad one is reported before
/// anything runs: swept values, of long lists evenly spaced ones, and the median of what is uncertain.
pub(super) fn check_values(case: &Case) -> Result<(), CaseErrors> {
    // A point is read at the cost of its key lines and of the lists that they stand for.
    const EFFORT: usize = 400_000;
    let point = case.raw.sweep_point(&[])?;
    let each = 200 + RawValue::Table(point.root.clone()).length();
    let keys = case.sweep.iter().flat_map(|sweep| &sweep.keys);
    let most = (EFFORT / (each * keys.clone().count().max(1))).clamp(2, 1000);
    let swept = keys.map(|key| {
        let tried = evenly(key.values.len(), most).map(|k| key.values[k].clone());
        ("swept", &key.varied, tried.collect::<Vec<_>>())
    });
    let uncertain = case.uncertainty.iter().flat_map(|study| &study.parameters);
    let uncertain =
        uncertain.map(|own| ("uncertain", &own.parameter, vec![format!("{:?}", own.value(0.5))]));
    let mut errors = Vec::new();
    for (what, varied, mut values) in swept.chain(uncertain) {
        let given = values.len();
        // Beside the only value another one shows whether anything depends on the key.
        values.extend(values.first().filter(|_| given == 1).and_then(|own| beside(own)));
        let mut before: Option<(&String, Case)> = None;
        for (k, value) in values.iter().enumerate() {
            let read = point.with_overrides(&varied.overrides(value)).and_then(Case::read);
            // What it was read from differs at any rate, and so the title.
            let (raw, title) = (point.clone(), String::new());
            let read = read.map(|own| Case { raw, title, warnings: vec![], ..own });
            match (read, &before) {
                (Ok(found), Some((other, case))) if found == *case && *other != value => {
                    errors.push(placed!(varied.at.clone(),
                        "{what} values {other} and {value} of {} make the same case", varied.key;
                        "nothing depends on this key"; "leave it out: this body does not use it"));
                }
                (Ok(found), _) => before = Some((value, found)),
                (Err(_), _) if k >= given => {}
                (Err(bad), _) => {
                    errors.extend(bad.diagnostics.into_iter().map(|error| Diagnostic {
                        message: format!("{what} value {}={value}: {}", varied.key, error.message),
                        at: varied.at.clone(),
                        ..error
                    }))
                }
            }
        }
    }
    if errors.is_empty() { Ok(()) } else { Err(case.raw.errors(errors)) }
}

/// At most so many of the places in a list, evenly spaced.
pub(super) fn evenly(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let (last, tried) = (count.saturating_sub(1), count.min(most));
    (0..tried).map(move |i| i * last / tried.max(2).saturating_sub(1))
}

/// A number next to one, in TOML.
fn beside(value: &str) -> Option<String> {
    let whole = value.parse::<i64>().map(|own| own.saturating_add(1).to_string());
    whole.ok().or_else(|| Some(format!("{:?}", 0.999 * value.parse::<f64>().ok()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of two keys that the case has itself, one after the other, are no value given twice.
    #[test]
    fn values_that_the_case_has_may_be_swept_and_uncertain() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/polycarbonate-disc.toml");
        let bytes = std::fs::read(path).unwrap();
        for study in [
            "sweep={\"contact.friction_coefficient\"=[0.2,0.3],\"material.young_modulus\"=[2.5e9,3e9]}",
            "uncertainty={samples=4,seed=1,distributions={\"contact.friction_coefficient\"={normal=[0.3,0.01]},\
             \"material.young_modulus\"={normal=[2.5e9,1e8]}}}",
        ] {
            let found = Case::parse(path, &bytes, &[study.to_owned()]);
            assert!(found.is_ok(), "{:?}", found.err().map(|errors| errors.line()));
        }
    }
}
