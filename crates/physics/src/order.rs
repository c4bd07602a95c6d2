//! Order by a number.

use std::collections::BTreeSet;

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

/// Pairs of items of two lists with a number each, the smallest first: each item in one pair at most.
pub fn each_once<A: Copy + Ord, B: Copy + Ord>(mut pairs: Vec<(f64, A, B)>) -> Vec<(A, B)> {
    sort_by_number(&mut pairs, |pair| pair.0);
    let (mut left, mut right) = (BTreeSet::new(), BTreeSet::new());
    let mut kept = Vec::new();
    for (_, a, b) in pairs {
        if !left.contains(&a) && right.insert(b) {
            left.insert(a);
            kept.push((a, b));
        }
    }
    kept
}

/// The smallest and the largest of some numbers; infinite ones of none.
pub fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let all = values.into_iter();
    all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}
