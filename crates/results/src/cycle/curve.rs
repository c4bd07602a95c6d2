//! A branch of limit cycles as a curve that may turn back.

use super::branch::BranchRecord;
use frictionsim_chart::{Line, Stroke};

/// A point of a curve: part `weight` of the way from cycle `before` to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub value: f64,
    before: usize,
    weight: f64,
}

impl Place {
    fn of(&self, ys: &[f64]) -> f64 {
        let at = |index: usize| ys.get(index).copied().unwrap_or(f64::NAN);
        let next = at((self.before + 1).min(ys.len().saturating_sub(1)));
        at(self.before) + self.weight * (next - at(self.before))
    }
}

impl BranchRecord {
    fn stability(&self, cycle: usize) -> Option<bool> {
        self.stable.get(cycle).copied().flatten()
    }

    /// Every fold on the curve. Where the curve meets the same value before and after, it turns there and is drawn to
    /// turn; two folds between two values are narrower than the spacing of the cycles, and are marked on the curve that
    /// goes on.
    pub(super) fn fold_places(&self) -> (Vec<Place>, Vec<Place>) {
        let (mut left, mut turns) = (self.folds.clone(), Vec::new());
        for (before, pair) in
            self.values.windows(2).enumerate().filter(|(_, pair)| pair[0] == pair[1])
        {
            let distance = |i: &usize| (left[*i] - pair[0]).abs();
            let nearest = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(nearest) = nearest {
                turns.push(Place { value: left.remove(nearest), before, weight: 0.5 });
            }
        }
        let narrow = left.into_iter().filter_map(|value| {
            let holds =
                |pair: &[f64]| (pair[0] - value) * (pair[1] - value) <= 0.0 && pair[0] != pair[1];
            let before = self.values.windows(2).position(holds)?;
            let weight =
                (value - self.values[before]) / (self.values[before + 1] - self.values[before]);
            Some(Place { value, before, weight })
        });
        let narrow = narrow.collect();
        (turns, narrow)
    }

    /// The curve's points, each with the stability of the piece after it.
    fn places(&self) -> Vec<(Place, Option<bool>)> {
        let turns = self.fold_places().0;
        let mut places = Vec::new();
        for before in 0..self.values.len() {
            let turn = turns.iter().find(|place| place.before == before);
            let change = turn.copied().or_else(|| self.change(before));
            let next = (before + 1).min(self.values.len() - 1);
            let (own, after) = (self.stability(before), self.stability(next));
            let piece = if own == after || change.is_some() { own } else { None };
            places.push((Place { value: self.values[before], before, weight: 0.0 }, piece));
            places.extend(change.map(|place| (place, after)));
        }
        places
    }

    /// Where stability changes between a cycle and the next: where the growth rate vanishes on the line between them,
    /// or half-way.
    fn change(&self, before: usize) -> Option<Place> {
        let (a, b) = (self.stability(before)?, self.stability(before + 1)?);
        if a == b {
            return None;
        }
        let rate =
            |cycle: usize| self.growth_rate.get(cycle).copied().flatten().unwrap_or(f64::NAN);
        let (from, to) = (rate(before), rate(before + 1));
        let weight = if from * to < 0.0 { from / (from - to) } else { 0.5 };
        let value = self.values[before] + weight * (self.values[before + 1] - self.values[before]);
        Some(Place { value, before, weight })
    }

    /// One quantity along the branch: stable pieces strong, unstable ones dashed, others plain.
    pub(super) fn lines(&self, ys: &[f64], colour: &'static str) -> Vec<Line> {
        let places = self.places();
        let starts = &places[..places.len().saturating_sub(1)];
        let mut start = 0;
        let line = |own: &[(Place, Option<bool>)]| {
            // A piece ends where the next one begins.
            let piece = &places[start..=start + own.len()];
            start += own.len();
            let points = piece.iter().map(|(place, _)| (place.value, place.of(ys)));
            Line::through(points).stroke(stroke(own[0].1, colour))
        };
        starts.chunk_by(|a, b| a.1 == b.1).map(line).collect()
    }

    pub(super) fn fold_points(&self, ys: &[f64]) -> Vec<(f64, f64)> {
        let (turns, narrow) = self.fold_places();
        turns.iter().chain(&narrow).map(|place| (place.value, place.of(ys))).collect()
    }
}

fn stroke(stability: Option<bool>, colour: &'static str) -> Stroke {
    match stability {
        None => Stroke::solid(colour, 0.9),
        Some(true) => Stroke::solid(colour, 1.6),
        Some(false) => Stroke::dashed(colour, 0.9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch(
        values: &[f64],
        stable: &[Option<bool>],
        growth_rate: &[Option<f64>],
        folds: &[f64],
    ) -> BranchRecord {
        BranchRecord {
            key: "contact.rotation_speed_rpm".into(),
            values: values.to_vec(),
            own_value: values[0],
            stable: stable.to_vec(),
            growth_rate: growth_rate.to_vec(),
            folds: folds.to_vec(),
            ..BranchRecord::default()
        }
    }

    #[test]
    fn stability_changes_where_the_growth_rate_vanishes() {
        let stable = [Some(true), Some(true), Some(false)];
        let found =
            branch(&[1.0, 2.0, 3.0], &stable, &[Some(-5.0), Some(-1.0), Some(3.0)], &[]).places();
        assert_eq!(found[2].0.value, 2.25);
        let pieces: Vec<_> = found.iter().map(|(_, stability)| *stability).collect();
        assert_eq!(pieces, [Some(true), Some(true), Some(false), Some(false)]);
    }

    #[test]
    fn every_fold_is_marked_wide_or_narrow() {
        let wide = branch(&[1.0, 2.0, 2.0], &[None; 3], &[None; 3], &[2.2]);
        assert_eq!(wide.fold_points(&[10.0, 20.0, 30.0]), [(2.2, 25.0)]);
        let narrow = branch(&[1.0, 2.0, 3.0], &[None; 3], &[None; 3], &[2.6, 2.4]);
        let marked = narrow.fold_points(&[10.0, 20.0, 30.0]);
        assert!(
            marked.len() == 2 && marked.iter().all(|(x, y)| (y - 10.0 * x).abs() < 1e-9),
            "{marked:?}"
        );
    }
}
