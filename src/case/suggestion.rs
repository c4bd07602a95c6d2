//! Suggestions for unknown keys: near misses, synonyms, the meaning of a key.

use super::key::CaseKey;
use super::keys::{KEYS, find};

/// Names that other programs and papers use, and what a case calls them.
const SYNONYMS: &[(&str, &str)] = &[
    ("a", "geometry.inner_radius"),
    ("alpha", "damping.mass_coefficient"),
    ("alpha_r", "damping.mass_coefficient"),
    ("angular_velocity", "contact.rotation_speed_rpm"),
    ("b", "geometry.outer_radius"),
    ("beta", "damping.stiffness_coefficient"),
    ("beta_r", "damping.stiffness_coefficient"),
    ("dt", "transient.time_step"),
    ("e", "material.young_modulus"),
    ("elastic_modulus", "material.young_modulus"),
    ("end_time", "transient.duration"),
    ("friction", "contact.friction_coefficient"),
    ("height", "geometry.thickness"),
    ("max_frequency", "cea.max_frequency_hz"),
    ("mu", "contact.friction_coefficient"),
    ("nu", "material.poisson_ratio"),
    ("number_of_modes", "cea.modes"),
    ("omega", "contact.rotation_speed_rpm"),
    ("penalty", "contact.normal_stiffness"),
    ("r_i", "geometry.inner_radius"),
    ("r_o", "geometry.outer_radius"),
    ("rho", "material.density"),
    ("rotation_speed", "contact.rotation_speed_rpm"),
    ("rpm", "contact.rotation_speed_rpm"),
    ("speed", "contact.rotation_speed_rpm"),
    ("step", "transient.time_step"),
    ("t_end", "transient.duration"),
    ("timestep", "transient.time_step"),
    ("youngs_modulus", "material.young_modulus"),
];

/// What other people call the parts of a range and of a place.
const PART_SYNONYMS: &[(&str, &str)] = &[
    ("angle", "angle_deg"),
    ("begin", "from"),
    ("end", "to"),
    ("number", "count"),
    ("num", "count"),
    ("n", "count"),
    ("phi", "angle_deg"),
    ("points", "count"),
    ("r", "radius"),
    ("scale", "spacing"),
    ("start", "from"),
    ("step", "count"),
    ("steps", "count"),
    ("stop", "to"),
    ("theta", "angle_deg"),
    ("x1", "x"),
    ("x2", "y"),
];

/// A hint for an unknown part of a range or of a place, which have the parts `known`.
pub(super) fn suggest_part(word: &str, known: &[&str]) -> Option<String> {
    let plain = word.to_lowercase();
    let synonym = PART_SYNONYMS.iter().find(|pair| pair.0 == plain);
    let synonym = synonym.map(|pair| pair.1).filter(|meant| known.contains(meant));
    let far = |near: &&str| near.len() > 1 || plain.len() > 1 && plain.starts_with(*near);
    let near = synonym.or_else(|| nearest(&plain, known.iter().copied()).filter(far));
    Some(match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("it takes {}", known.join(", ")),
    })
}

/// Other words for the values of choices.
const WORD_SYNONYMS: &[(&str, &str)] = &[
    ("compliance", "receptance"),
    ("cpe4", "quad4"),
    ("cpe8", "quad8"),
    ("cps4", "quad4"),
    ("cps8", "quad8"),
    ("dynamic-flexibility", "receptance"),
    ("inertance", "accelerance"),
    ("logarithmic", "log"),
    ("q4", "quad4"),
    ("q8", "quad8"),
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

/// The candidate nearest to `word`, if it is near enough to be a slip of the keyboard.
pub(super) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    candidates
        // The distance is at least the difference of the lengths, and takes their product to find.
        .filter(|candidate| {
            let longest = word.len().max(candidate.len());
            3 * word.len().abs_diff(candidate.len()) <= longest + 2
        })
        .map(|candidate| (strsim::damerau_levenshtein(word, candidate), candidate))
        .filter(|(distance, candidate)| 3 * distance <= word.len().max(candidate.len()) + 2)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The word of a choice that is meant by another: its synonym, else the nearest.
pub(super) fn nearest_word<'a>(word: &str, words: &[&'a str]) -> Option<&'a str> {
    let plain = word.to_lowercase().replace([' ', '_'], "-");
    let synonym = WORD_SYNONYMS.iter().find(|pair| pair.0 == plain);
    let meant = synonym.map_or(plain.as_str(), |pair| pair.1);
    let exact = words.iter().find(|known| **known == meant);
    exact.copied().or_else(|| nearest(&plain, words.iter().copied()))
}

/// The key that other people call `word`.
fn synonym(word: &str) -> Option<&'static CaseKey> {
    let plain = word.to_lowercase().replace([' ', '-'], "_");
    let pair = SYNONYMS.iter().find(|pair| pair.0 == plain)?;
    find(pair.1)
}

/// The full name of the key nearest to a dotted name.
pub(super) fn nearest_key(name: &str) -> Option<&'static str> {
    let last = name.rsplit('.').next().unwrap_or(name);
    synonym(last).map(|key| key.name).or_else(|| nearest(name, KEYS.iter().map(|key| key.name)))
}

/// Keys of earlier versions, and what stands in their place.
const GONE: &[(&str, &str)] = &[
    ("cea.map", "a sweep of cea draws it: give the key and its values in [sweep]"),
    ("improve.front", "a sweep of cea over modifications.NAME.mass draws it"),
];

/// A hint for a key that does not exist: one that is gone, a synonym, a near miss in its section, the same key of
/// another section, or the keys there are.
pub(super) fn suggest(section: &str, word: &str, known: &[&str]) -> Option<String> {
    let elsewhere = |key: &CaseKey| match key.section() {
        home if home == section => format!("did you mean `{}`?", key.short()),
        home => format!("did you mean `{}` of [{home}]?", key.short()),
    };
    let full = format!("{section}.{word}");
    if let Some((_, place)) = GONE.iter().find(|gone| gone.0 == full) {
        return Some((*place).to_owned());
    }
    if let Some(key) = synonym(word) {
        return Some(elsewhere(key));
    }
    // A word that begins one key alone is short for it.
    let mut begun = known.iter().filter(|key| word.len() > 2 && key.starts_with(word));
    let abbreviated = begun.next().filter(|_| begun.next().is_none());
    if let Some(near) = nearest(word, known.iter().copied()).or(abbreviated.copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    if let Some(found) = KEYS.iter().find(|key| key.short() == word && !key.name.contains('*')) {
        return Some(elsewhere(found));
    }
    if let Some(near) = nearest(&full, KEYS.iter().map(|key| key.name)).and_then(find) {
        return Some(elsewhere(near));
    }
    let mut listed = known.to_vec();
    listed.sort_unstable();
    Some(if section.is_empty() {
        format!("sections and keys here: {}", listed.join(", "))
    } else {
        format!("keys of [{section}]: {}", listed.join(", "))
    })
}
