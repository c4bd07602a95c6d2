//! Lists drawn together: each item once, runs of numbers by their ends.

/// The items in their order, each where it appears first.
pub fn distinct<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found: Vec<T> = Vec::new();
    for item in items {
        if !found.contains(&item) {
            found.push(item);
        }
    }
    found
}

/// Ascending numbers with runs drawn together: `1-4, 7`.
pub fn number_ranges(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|number, next| number + 1 == *next);
    let texts = runs.map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        one => one[0].to_string(),
    });
    texts.collect::<Vec<_>>().join(", ")
}
