//! Suggestions for unknown keys: near misses, synonyms, the meaning of a key.

use super::{KEYS, keys::find, value::table_of};
use crate::*;

/// A hint for an unknown part of a range or of a place, which have these parts.
pub(super) fn suggest_part(word: &str, parts: &[CaseKey]) -> String {
    let plain = word.to_lowercase();
    let known: Vec<&str> = parts.iter().map(|part| part.name).collect();
    let synonym = parts.iter().find(|part| part.is_called(&plain)).map(|part| part.name);
    let far = |near: &&str| near.len() > 1 || plain.len() > 1 && plain.starts_with(*near);
    let near = synonym.or_else(|| nearest(&plain, known.iter().copied()).filter(far));
    match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("it takes {}", known.join(", ")),
    }
}

/// Other words for the values of choices.
#[rustfmt::skip]
const WORD_SYNONYMS: &[(&str, &str)] = &[
    ("compliance", "receptance"), ("cpe4", "quad4"), ("cpe8", "quad8"), ("cps4", "quad4"),
    ("cps8", "quad8"), ("dynamic-flexibility", "receptance"), ("inertance", "accelerance"),
    ("logarithmic", "log"), ("q4", "quad4"), ("q8", "quad8"),
    ("sliding-equilibrium", "steady-sliding"),
];

/// What to write for a key: meaning and example.
pub(super) fn usage(name: &str) -> Option<String> {
    let key = find(name)?;
    Some(format!(
        "`{name}` is {}, for example `{} = {}`",
        key.meaning_with_unit(),
        key.short(),
        key.example
    ))
}

/// The candidate nearest to `word`, if it is near enough to be a slip of the keyboard; of some that are equally near
/// one that has all its letters in turn, best that it is the beginning of.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let bound = |own: &str| word.len().max(own.len()).div_ceil(3);
    // The distance is at least the difference of the lengths, and takes their product to find.
    let all = candidates.filter(|own| word.len().abs_diff(own.len()) <= bound(own));
    let all = all.map(|own| (strsim::damerau_levenshtein(word, own), own));
    // Letters are left out rather than taken for others.
    let after = |rest: &'a str, letter: char| Some(rest.split_once(letter)?.1);
    let order = |(distance, own): &(usize, &'a str)| {
        (*distance, word.chars().try_fold(*own, after).is_none(), !own.starts_with(word))
    };
    all.filter(|(distance, own)| *distance <= bound(own)).min_by_key(order).map(|(_, own)| own)
}

/// The word of a choice that is meant by another: its synonym, else the nearest.
pub(super) fn nearest_word<'a>(word: &str, words: &[&'a str]) -> Option<&'a str> {
    let plain = word.to_lowercase().replace([' ', '_'], "-");
    let synonym = WORD_SYNONYMS.iter().find(|pair| pair.0 == plain);
    let meant = synonym.map_or(plain.as_str(), |pair| pair.1);
    let exact = words.iter().find(|known| **known == meant);
    exact.copied().or_else(|| nearest(&plain, words.iter().copied()))
}

/// What other people mean by `word`, likelier first.
fn synonyms(word: &str) -> Vec<&'static str> {
    let plain = word.to_lowercase().replace([' ', '-'], "_");
    KEYS.iter().filter(|key| key.is_called(&plain)).map(CaseKey::short).collect()
}

/// The candidate that `word` is, else that others call so.
fn meant<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let exact = |own: &str| candidates.iter().find(|known| **known == own).copied();
    std::iter::once(word).chain(synonyms(word)).find_map(exact)
}

/// The candidate nearest to `word`, else the only one that begins with it.
fn near<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let mut begun = candidates.iter().filter(|key| word.len() > 2 && key.starts_with(word));
    let short = begun.next().filter(|_| begun.next().is_none()).copied();
    nearest(word, candidates.iter().copied()).or(short)
}

/// What a case may have: its sections and `[damping]`, which needs no other key, less the keys that
/// its reader refuses whatever their value, as they belong to bodies and contacts of another kind.
#[derive(Debug)]
pub(super) struct Scope<'a> {
    root: &'a RawTable,
    pub refused: RefCell<BTreeSet<String>>,
}

impl<'a> Scope<'a> {
    /// The sections of a case of which nothing is refused so far.
    pub fn of(root: &'a RawTable) -> Self {
        Self { root, refused: RefCell::default() }
    }

    /// The section of a path, if the case gives it.
    fn table(&self, path: &str) -> Option<&'a RawTable> {
        path.split('.').try_fold(self.root, table_of)
    }

    /// The keys of some kinds that the case may have, each with its section; those of sections with
    /// names of their own come last.
    fn keys(&self, fits: impl Fn(&CaseKey) -> bool) -> Vec<(String, &'static str)> {
        let sections = |key: &CaseKey| -> Vec<String> {
            let section = key.section();
            match section.strip_suffix(".*") {
                Some(group) => {
                    let names = self.table(group).into_iter().flat_map(RawTable::keys);
                    names.map(|name| full(group, name)).collect()
                }
                None if matches!(section, "" | "damping") => vec![section.to_owned()],
                None => self.table(section).map(|_| section.to_owned()).into_iter().collect(),
            }
        };
        let (named, plain): (Vec<&CaseKey>, Vec<_>) =
            KEYS.iter().partition(|key| key.name.contains('*'));
        let fitting = plain.into_iter().chain(named).filter(|key| fits(key));
        let all = fitting.flat_map(|key| sections(key).into_iter().map(|own| (own, key.short())));
        all.filter(|(own, key)| !self.refused.borrow().contains(&full(own, key))).collect()
    }

    /// The key of another section that a word means, with that section.
    fn elsewhere(
        &self,
        (section, word): (&str, &str),
        fits: impl Fn(&CaseKey) -> bool,
    ) -> Option<(String, &'static str)> {
        let mut keys = self.keys(fits);
        keys.retain(|key| key.0 != section);
        let found = meant(word, &keys.iter().map(|key| key.1).collect::<Vec<_>>())?;
        keys.into_iter().find(|key| key.1 == found)
    }

    /// A hint for a dotted name that is no key: that of the key which is meant, of those that fit.
    pub fn hint(&self, name: &str, fits: impl Fn(&CaseKey) -> bool) -> Option<String> {
        let (section, word) = name.rsplit_once('.').unwrap_or(("", name));
        let own = self.keys(&fits).into_iter().filter(|key| key.0 == section);
        let own: Vec<&str> = own.map(|key| key.1).collect();
        let found = match meant(word, &own).or_else(|| near(word, &own)) {
            Some(own) => full(section, own),
            None => self.elsewhere((section, word), fits).map(|key| full(&key.0, key.1))?,
        };
        Some(format!("did you mean \"{found}\"?"))
    }

    /// A hint for a key that does not exist: one that is gone, a synonym, a near miss in its section,
    /// the same key of another section that the case has, or the keys there are.
    pub fn suggest(&self, section: &str, (word, value): (&str, &RawValue), own: &[&str]) -> String {
        let name = full(section, word);
        if let Some((_, place)) = GONE.iter().find(|gone| gone.0 == name) {
            return (*place).to_owned();
        }
        let refused = self.refused.borrow();
        let known = own.iter().copied().filter(|key| !refused.contains(&full(section, key)));
        let known: Vec<&str> = known.collect();
        let elsewhere = self.elsewhere((section, word), |key| key.takes(value));
        // A word that others use for a key elsewhere is no slip of the keyboard.
        let is_slip = elsewhere.is_none() || synonyms(word).is_empty();
        let slip = || near(word, &known).filter(|_| is_slip);
        if let Some(found) = meant(word, &known).or_else(slip) {
            let given = self.table(section).filter(|_| found == "normal_force");
            let pushed = given.and_then(|given| given.get("interference"));
            let instead = pushed.map_or("", |_| " in place of `interference`");
            return format!("did you mean `{found}`{instead}?");
        }
        if let Some((home, found)) = elsewhere {
            return format!("did you mean `{found}` of [{home}]?");
        }
        match section {
            "" => format!("sections and keys here: {}", known.join(", ")),
            _ => format!("keys of [{section}]: {}", known.join(", ")),
        }
    }
}

/// The key of the same section that a hint says is meant.
pub(super) fn meant_here(hint: &str) -> Option<&str> {
    let (key, rest) = hint.strip_prefix("did you mean `")?.split_once('`')?;
    (!rest.starts_with(" of [")).then_some(key)
}

/// Keys of earlier versions, and what stands in their place.
const GONE: &[(&str, &str)] = &[
    ("cea.map", "a sweep of cea draws it: give the key and its values in [sweep]"),
    ("improve.front", "a sweep of cea over modifications.NAME.mass draws it"),
];

/// The full name of a key of a section.
fn full(section: &str, key: &str) -> String {
    if section.is_empty() { key.to_owned() } else { format!("{section}.{key}") }
}
