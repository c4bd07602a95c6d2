//! Order by a number.

/// Sorts by a number of each item, smallest first; equal ones keep their order. `-0` is below `0`, NaN above all.
///
/// By integers in the order of the numbers, so that one sort serves every kind of item.
pub fn sort_by_number<T>(items: &mut [T], mut number: impl FnMut(&T) -> f64) {
    items.sort_by_cached_key(|item| {
        let bits = number(item).to_bits() as i64;
        // Of negative numbers the larger have the smaller bits behind the sign.
        bits ^ (((bits >> 63) as u64) >> 1) as i64
    });
}
