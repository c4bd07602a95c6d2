//! Figures of branches of limit cycles, whose curves may turn back.

use super::branch::{BranchRecord, FamilyRecord, SHARES};
use super::two_waves::TwoWaveSummary;
use crate::charts::palette::STATUSES;
use crate::common::*;

/// Draws frequency, amplitude, statuses and powers along the branches of several families, each with what its name says
/// besides the harmonic.
pub fn draw_branches(
    families: &[(String, FamilyRecord)],
    two_waves: &[TwoWaveSummary],
) -> Vec<Figure> {
    // A branch of a single cycle is no curve.
    let curves = families.iter().filter_map(|(suffix, family)| {
        let branch = family.branch.as_ref().filter(|branch| branch.values.len() > 1)?;
        Some(Curve { suffix, family, branch })
    });
    let curves: Vec<Curve<'_>> = curves.collect();
    let curves = &curves[..];
    [frequencies(curves, two_waves), shares(curves)].into_iter().filter(Figure::has_data).collect()
}

/// The branch of one family.
struct Curve<'a> {
    suffix: &'a str,
    family: &'a FamilyRecord,
    branch: &'a BranchRecord,
}

impl Curve<'_> {
    fn name(&self) -> String {
        if let Some(mode) = self.family.mode {
            return format!("mode {mode}{}", self.suffix);
        }
        let family = self.family.family().to_string();
        format!("*{}{}", family.replacen(' ', "* ", 1), self.suffix)
    }
}

/// Logarithmic over more than a decade.
fn axis_of(curves: &[Curve<'_>]) -> (Axis, Scale) {
    let key = curves.first().map_or("", |curve| &curve.branch.key);
    let values = curves.iter().flat_map(|curve| curve.branch.values.iter().copied());
    let scale = Scale::for_values(values, 10.0);
    (parameter_axis(key).scaled(scale), scale)
}

/// What the strokes of the curves mean, where any stability is known.
fn with_strokes(figure: Figure, curves: &[Curve<'_>]) -> Figure {
    let is_known = |curve: &Curve<'_>| curve.branch.stable.iter().any(Option::is_some);
    let note = "strong lines: stable; dashed: unstable; thin: stability unknown";
    if curves.iter().any(is_known) { figure.note(note) } else { figure }
}

/// Frequencies and amplitudes of two waves.
const OF_BOTH: [fn(&TwoWaveMotion) -> [f64; 2]; 2] =
    [TwoWaveMotion::frequencies_hz, |motion| motion.amplitudes];

/// One quantity along a branch.
type Column = fn(&BranchRecord) -> &Vec<f64>;

/// Main frequency, amplitude and power of the limit cycles over the parameter, one curve for each family.
fn frequencies(curves: &[Curve<'_>], two_waves: &[TwoWaveSummary]) -> Figure {
    let (x, scale) = axis_of(curves);
    let extent = curves.first().map_or_else(Extent::default, |curve| curve.branch.extent);
    let frequency = Axis::new("main frequency *f*", "kHz").times(1e-3);
    let amplitude = Axis::new("amplitude along the contact", "m").prefixed();
    let amplitude = match scale {
        Scale::Logarithmic => amplitude.logarithmic(),
        Scale::Linear => amplitude.including(0.0),
    };
    let power = Axis::new("power of the counterface", &extent.unit("W")).prefixed();
    let sliding = curves.iter().flat_map(|curve| &curve.branch.sliding_onsets).map(|&onset| {
        let rule = Rule::vertical(onset).stretching().stroke(Stroke::dotted(MUTED, 0.9));
        rule.name("onset: steady sliding loses its stability")
    });
    let panel =
        |y: Axis, height: f64| Panel::new(x.clone(), y).height(height).layers(sliding.clone());
    let quantities: [(Panel, Column, Option<usize>); 3] = [
        (panel(frequency, 150.0).layers(onset_rules(curves)), |b| &b.frequency_hz, Some(0)),
        (panel(amplitude, 92.0), |b| &b.amplitude, Some(1)),
        (panel(power, 76.0), |b| &b.external, None),
    ];
    let panels = quantities.into_iter().map(|(panel, quantity, own)| {
        let of_both = own.map(|own| OF_BOTH[own]);
        let together = two_waves.iter().flat_map(|pair| of_both.map(|own| pair.curves(own)));
        let panel = panel.layers(together.flatten());
        curves.iter().enumerate().fold(panel, |panel, (index, curve)| {
            let (branch, colour) = (curve.branch, SERIES[index % SERIES.len()]);
            let ys = quantity(branch);
            let folds = Points::new(branch.fold_points(ys)).marker(Marker::Diamond, 1.9, colour);
            let at_own = |value: f64, marker: Marker, name: String| {
                Points::new([(branch.own_value, value)]).marker(marker, 2.2, colour).name(name)
            };
            let of = if curves.len() > 1 { format!(", {}", curve.name()) } else { String::new() };
            let cycle = curve.family.cycle.zip(own);
            let cycle = cycle.map(|(cycle, own)| {
                at_own(cycle[own], Marker::Circle, format!("the case's own cycle{of}"))
            });
            let threshold = branch.threshold.filter(|_| own == Some(1));
            let threshold = threshold.map(|[amplitude, velocity]| {
                let name = format!("a kick of more than {velocity:.3e} m/s tips sliding");
                at_own(amplitude, Marker::Square, name)
            });
            panel
                .layers(branch.lines(ys, colour))
                .layer(Line::new(&branch.values, ys).solid(colour, 0.3).name(curve.name()))
                .layer(folds.name("fold"))
                .layers(cycle)
                .layers(threshold)
        })
    });
    let both = curves.iter().flat_map(|curve| &curve.branch.coexistence).map(|ends| {
        let [from, to] = ends.map(|value| significant(value, 4));
        format!(" Stable sliding and a limit cycle coexist from {from} to {to}.")
    });
    let caption = format!(
        "Main frequency (a), amplitude (b) and power of the counterface (c) of the limit cycles \
         along their branches. Dotted: where linear theory has them begin. Diamonds: folds.{}",
        both.collect::<String>()
    );
    let figure = Figure::new("branch-frequencies", caption).shared_x().panels(panels);
    with_strokes(figure, curves)
}

/// The frequencies at which linear theory has waves begin.
fn onset_rules(curves: &[Curve<'_>]) -> impl Iterator<Item = Rule> {
    let onsets = curves.iter().filter_map(|curve| {
        let family = curve.family;
        let [critical, frequency] = *family.onsets.get(family.onset.checked_sub(1)?)?;
        let (kilohertz, n) = (frequency * 1e-3, family.harmonic);
        Some((frequency, format!("{kilohertz:.2} kHz, *n* = {n} at *μ* = {critical:.3}")))
    });
    let mut onsets: Vec<(f64, String)> = onsets.collect();
    onsets.dedup();
    onsets.into_iter().map(|(frequency, text)| {
        let rule = Rule::horizontal(frequency).stretching().stroke(Stroke::dotted(MUTED, 0.8));
        rule.at_rim(text).name("onset of the instability, linear theory")
    })
}

/// Statuses and power shares of the limit cycles over the parameter, one column for each family.
fn shares(curves: &[Curve<'_>]) -> Figure {
    let (x, _) = axis_of(curves);
    let percent = |name: &str| Axis::new(name, "%").times(100.0);
    let statuses = STATUSES.map(|(_, name, _, _, colour)| (name, colour));
    let panel =
        |curve: &Curve<'_>, y: Axis, series: &[Vec<f64>], named: &[(&str, &'static str)]| {
            let (turns, narrow) = curve.branch.fold_places();
            let folds = turns.iter().chain(&narrow).map(|place| {
                Rule::vertical(place.value).stroke(Stroke::dotted(MUTED, 0.7)).name("fold")
            });
            let panel = Panel::new(x.clone(), y).height(104.0).heading(curve.name()).layers(folds);
            series.iter().zip(named).fold(panel, |panel, (values, &(name, colour))| {
                let named = Line::new(&curve.branch.values, values).solid(colour, 0.4).name(name);
                panel.layer(named).layers(curve.branch.lines(values, colour))
            })
        };
    let status = |curve: &Curve<'_>| {
        let axis = percent("contact nodes").between(0.0, 1.0);
        panel(curve, axis, &curve.branch.status, &statuses)
    };
    let power = |curve: &Curve<'_>| {
        let axis = percent("share of external power").including(0.0).including(1.0);
        panel(curve, axis, &curve.branch.shares, &SHARES.map(|(name, colour, _)| (name, colour)))
    };
    let mut figure = Figure::new(
        "branch-shares",
        "Contact status, and powers relative to the external one, along the branch of each family.",
    )
    .columns(curves.len().clamp(1, 3))
    .shared_y();
    for row in curves.chunks(3) {
        let fill = |figure: Figure| {
            (row.len()..curves.len().min(3)).fold(figure, |figure, _| figure.panel_or_gap(None))
        };
        figure = fill(figure.panels(row.iter().map(status)));
        figure = fill(figure.panels(row.iter().map(power)));
    }
    with_strokes(figure, curves)
}

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
