//! How what is only looked at is kept: values as levels, and whole numbers as deviations from the straight line through
//! the two before, which are short where places and values vary smoothly.

use crate::prelude::*;
use serde::{Deserializer, Serializer};

/// Values as levels between the smallest and the largest: their ends, and numbers up to `last`; one more is a gap.
pub fn levels(values: &[f64], last: u32) -> ((f64, f64), Vec<u32>) {
    let ends = extremes(values.iter().copied());
    let scale = f64::from(last) / (ends.1 - ends.0).max(f64::MIN_POSITIVE);
    let level = |value: &f64| match value.is_finite() {
        true => (((value - ends.0) * scale).round() as u32).min(last),
        false => last + 1,
    };
    (ends, values.iter().map(level).collect())
}

/// Whole numbers, so many of each thing: component by component, each as twice the difference from the one before.
pub fn steps(numbers: &[u32], components: usize) -> Vec<i32> {
    let of = |component: usize| numbers.iter().skip(component).step_by(components);
    let mut steps: Vec<i32> = (0..components).flat_map(of).map(|&number| number as i32).collect();
    for _ in 0..2 {
        (1..steps.len()).rev().for_each(|at| steps[at] = steps[at].wrapping_sub(steps[at - 1]));
    }
    steps
}

/// The numbers with these [`steps`], of which what is left over is left out.
fn sums(mut steps: Vec<i32>, components: usize) -> impl Iterator<Item = u32> {
    for _ in 0..2 {
        (1..steps.len()).for_each(|at| steps[at] = steps[at].wrapping_add(steps[at - 1]));
    }
    let things = steps.len() / components;
    let place = move |at: usize| at % components * things + at / components;
    (0..things * components).map(move |at| steps[place(at)] as u32)
}

/// Length that all lists have, else 1: numbers at one place of such lists are much alike.
pub fn common_length(lengths: &[usize]) -> usize {
    let first = lengths.first().map_or(1, |&first| first.max(1));
    if lengths.iter().all(|&length| length == first) { first } else { 1 }
}

/// A list of numbers, or of so many for each thing.
pub(super) trait Flat<T> {
    const COMPONENTS: usize;
    fn flat(&self) -> &[T];
    fn of(flat: Vec<T>) -> Self;
}

impl<T> Flat<T> for Vec<T> {
    const COMPONENTS: usize = 1;

    fn flat(&self) -> &[T] {
        self
    }

    fn of(flat: Vec<T>) -> Self {
        flat
    }
}

impl<T: Clone, const N: usize> Flat<T> for Vec<[T; N]> {
    const COMPONENTS: usize = N;

    fn flat(&self) -> &[T] {
        self.as_flattened()
    }

    fn of(flat: Vec<T>) -> Self {
        flat.as_chunks().0.to_vec()
    }
}

/// Stores values as levels up to `LAST`.
pub(super) struct Levels<const LAST: u32>;

impl<const LAST: u32> Levels<LAST> {
    pub fn serialize<T: Flat<f64>, S: Serializer>(values: &T, to: S) -> Result<S::Ok, S::Error> {
        let (ends, levels) = levels(values.flat(), LAST);
        (ends, steps(&levels, T::COMPONENTS)).serialize(to)
    }

    pub fn deserialize<'a, T: Flat<f64>, D: Deserializer<'a>>(from: D) -> Result<T, D::Error> {
        let ((low, high), steps) = <((f64, f64), _)>::deserialize(from)?;
        let value = |level: u32| match level > LAST {
            true => f64::NAN,
            false => low + f64::from(level) / f64::from(LAST) * (high - low),
        };
        Ok(T::of(sums(steps, T::COMPONENTS).map(value).collect()))
    }
}

/// Stores whole numbers, so many of each thing.
pub(super) mod whole {
    use super::*;

    pub fn serialize<T: Flat<u32>, S: Serializer>(numbers: &T, to: S) -> Result<S::Ok, S::Error> {
        steps(numbers.flat(), T::COMPONENTS).serialize(to)
    }

    pub fn deserialize<'a, T: Flat<u32>, D: Deserializer<'a>>(from: D) -> Result<T, D::Error> {
        Ok(T::of(sums(Vec::deserialize(from)?, T::COMPONENTS).collect()))
    }
}

/// Stores lists of whole numbers.
pub(super) mod lists {
    use super::*;

    pub fn serialize<S: Serializer>(lists: &[Vec<u32>], to: S) -> Result<S::Ok, S::Error> {
        let lengths: Vec<usize> = lists.iter().map(Vec::len).collect();
        let steps = steps(&lists.concat(), common_length(&lengths));
        (lengths, steps).serialize(to)
    }

    pub fn deserialize<'a, D: Deserializer<'a>>(from: D) -> Result<Vec<Vec<u32>>, D::Error> {
        let (lengths, steps) = <(Vec<usize>, _)>::deserialize(from)?;
        let mut numbers = sums(steps, common_length(&lengths));
        let list = |length| numbers.by_ref().take(length).collect();
        Ok(lengths.into_iter().map(list).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Kept {
        #[serde(with = "Levels::<65_534>")]
        values: Vec<[f64; 3]>,
        #[serde(with = "Levels::<254>")]
        gaps: Vec<f64>,
        #[serde(with = "whole")]
        triangles: Vec<[u32; 3]>,
        #[serde(with = "lists")]
        lists: Vec<Vec<u32>>,
    }

    #[test]
    fn what_is_kept_comes_back_within_half_a_level_and_stays_as_it_is_then() {
        let value = |i: u32| (0.01 * f64::from(i)).sin() * 3e-4;
        let kept = Kept {
            values: (0..300).map(|i| [value(3 * i), value(3 * i + 1), value(3 * i + 2)]).collect(),
            gaps: vec![1.5, f64::NAN, -2.0],
            triangles: vec![[7, 70_000, 3], [0, u32::MAX, 1]],
            lists: vec![vec![1, 2, 3], vec![], vec![4]],
        };
        let again = |kept: &Kept| -> Kept {
            postcard::from_bytes(&postcard::to_stdvec(kept).unwrap()).unwrap()
        };
        let back = again(&kept);
        let off = kept.values.as_flattened().iter().zip(back.values.as_flattened());
        let off = off.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(back.values.len() == 300 && off <= 0.51 * 6e-4 / 65_534.0, "{off}");
        assert!(back.gaps[0] == 1.5 && back.gaps[1].is_nan() && back.gaps[2] == -2.0);
        assert_eq!((&back.triangles, &back.lists), (&kept.triangles, &kept.lists));
        assert_eq!(again(&back).values, back.values);
    }
}
