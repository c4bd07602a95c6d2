//! Rules that several sections share.

use super::reader::Section;
use super::{keys, suggestion};
use crate::mesh::AnnulusSpecification;

/// A list of numbers in rising order; equal ones are an error.
pub(super) fn rising(section: &Section<'_>, key: &str) -> Option<Vec<f64>> {
    let mut values = section.numbers(key)?;
    values.sort_by(f64::total_cmp);
    if let Some(pair) = values.windows(2).find(|pair| pair[0] == pair[1]) {
        section.reject(
            key,
            format!("{} has {} twice", section.name(key), pair[0]),
            "every value once".to_owned(),
            None,
        );
    }
    Some(values)
}

/// A key whose value names a numeric case key.
pub(super) fn parameter(section: &Section<'_>, key: &str) -> String {
    let name = section.text(key);
    if section.is_some_text(key) && keys::find(&name).is_none_or(|known| !known.is_numeric()) {
        let numeric = keys::KEYS.iter().filter(|known| known.is_numeric());
        section.reject(
            key,
            format!(
                "{} = \"{name}\" is not a numeric case key",
                section.name(key)
            ),
            "must name a key whose value is a number".to_owned(),
            suggestion::nearest(&name, numeric.map(|known| known.name))
                .map(|near| format!("did you mean \"{near}\"?")),
        );
    }
    name
}

/// A list of harmonics that the mesh can hold.
pub(super) fn harmonics(
    section: &Section<'_>,
    annulus: &AnnulusSpecification,
) -> Option<Vec<usize>> {
    let values = section.counts("harmonics")?;
    let highest = annulus.circumferential_elements / 2;
    for (value, at) in &values {
        if *value > highest && annulus.circumferential_elements > 0 {
            section.reject_there(
                at,
                format!(
                    "harmonic {value} in {} is above the mesh's highest, {highest}",
                    section.name("harmonics")
                ),
                format!(
                    "at most half of {} elements",
                    annulus.circumferential_elements
                ),
                "lower the harmonic or raise mesh.circumferential_elements",
            );
        }
    }
    Some(values.into_iter().map(|(value, _)| value).collect())
}
