//! Lists drawn together: items under their keys, each item once, runs of numbers by their ends, or their count.

/// A count with its noun, of one and of several.
pub fn plural(count: usize, [one, several]: [&str; 2]) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// The items under their keys, each key where it appears first.
pub fn grouped<K: PartialEq, T>(items: impl IntoIterator<Item = (K, T)>) -> Vec<(K, Vec<T>)> {
    let mut groups: Vec<(K, Vec<T>)> = Vec::new();
    for (key, item) in items {
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, group)) => group.push(item),
            None => groups.push((key, vec![item])),
        }
    }
    groups
}

/// The items in their order, each where it appears first.
pub fn distinct<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    grouped(items.into_iter().map(|item| (item, ()))).into_iter().map(|(item, _)| item).collect()
}

/// The items by a number of each, the smallest first; equal ones keep their order.
pub fn sorted<T>(items: impl IntoIterator<Item = T>, number: impl FnMut(&T) -> f64) -> Vec<T> {
    let mut items: Vec<T> = items.into_iter().collect();
    frictionsim_physics::order::sort_by_number(&mut items, number);
    items
}

/// Ascending numbers with runs drawn together: `1-4, 7`.
pub fn number_ranges(numbers: &[usize]) -> String {
    let texts = numbers.chunk_by(|number, next| number + 1 == *next).map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        one => one[0].to_string(),
    });
    texts.collect::<Vec<_>>().join(", ")
}
