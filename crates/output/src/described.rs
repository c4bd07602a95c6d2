//! Keys of JSON with their meaning: `#[derive(Described)]` takes both from the fields of a struct.

use std::collections::BTreeMap;

/// A key of JSON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its path from the root: `[]` for each entry of a list, `KEY` for each key that the case decides.
    pub path: String,
    /// What it means.
    pub meaning: &'static str,
}

/// What knows the keys that it has in JSON; a plain value has none.
pub trait Described {
    /// Adds its keys, which begin with a path.
    fn describe(path: &str, keys: &mut Vec<Key>) {
        let _ = (path, keys);
    }
}

/// The keys of a summary.
pub fn keys_of<T: Described>() -> Vec<Key> {
    let mut keys = Vec::new();
    T::describe("", &mut keys);
    keys
}

/// Adds a field and, by the `describe` of its type, what is in it; the keys of a flat one stand beside it.
pub fn describe_field(
    describe: fn(&str, &mut Vec<Key>),
    path: &str,
    (name, meaning, is_flat): (&str, &'static str, bool),
    keys: &mut Vec<Key>,
) {
    if is_flat {
        return describe(path, keys);
    }
    let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    // What several variants have is told once.
    if keys.iter().all(|key| key.path != path) {
        keys.push(Key { path: path.clone(), meaning: meaning.trim() });
        describe(&path, keys);
    }
}

macro_rules! plain {
    ($($kind:ty),+) => {$(impl Described for $kind {})+};
}

plain!(bool, i8, i64, u8, u32, u64, usize, f64, String, serde_json::Value);

impl Described for serde_json::Map<String, serde_json::Value> {
    fn describe(path: &str, keys: &mut Vec<Key>) {
        let meaning = "value of the key";
        keys.push(Key { path: format!("{path}.KEY"), meaning });
    }
}

macro_rules! holders {
    ($($holder:ident $place:literal),+) => {$(impl<T: Described> Described for $holder<T> {
        fn describe(path: &str, keys: &mut Vec<Key>) {
            T::describe(&format!("{path}{}", $place), keys);
        }
    })+};
}

holders!(Option "", Box "", Vec "[]");

impl<T: Described, const N: usize> Described for [T; N] {
    fn describe(path: &str, keys: &mut Vec<Key>) {
        T::describe(&format!("{path}[]"), keys);
    }
}

impl<T: Described> Described for BTreeMap<String, T> {
    fn describe(path: &str, keys: &mut Vec<Key>) {
        T::describe(&format!("{path}.KEY"), keys);
    }
}
