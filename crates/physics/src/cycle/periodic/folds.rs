//! Folds of a branch: those at which it bends, and corners.

use super::corrector::{GOOD, Goal, Place, Point, way};
use super::follower::{ALONG, Follower};
use crate::transient::TransientError;

/// Distances off a branch at which another is looked for beyond a corner, by the largest amplitude, and how much farther along it may be.
const CORNERS: [f64; 3] = [0.005, 0.02, 0.002];
const FAR: f64 = 20.0;
/// Motions spent on a fold.
const REFINED: usize = 12;
/// Difference of the parameter, in units of its scale, to which a fold is found.
const FOLDED: f64 = 1e-6;

impl Follower<'_, '_, '_> {
    /// The way around a corner, where the branch runs back beside itself: at the speed at which nodes only just begin to stick a
    /// cycle with sticking and one without meet, and no tangent leads on. The other cycles lie off the line on which these came.
    pub(super) fn turn(&mut self) -> Result<bool, TransientError> {
        // What hardly repeats itself lies beyond the corner.
        let good = self.points.iter().rposition(|own| own.found.residual < GOOD).unwrap_or(0);
        let at = good.max(self.points.len().saturating_sub(4));
        self.points.truncate(at + 1);
        if at == 0 || self.here().is_fold || self.tangent[0].abs() < ALONG {
            return Ok(false);
        }
        let (place, scales, here) = (self.place(), self.corrector.scales, self.here().clone());
        let along = self.tangent[0];
        for length in CORNERS.map(|length| length * self.largest.max(1.0)) {
            for sense in [1.0, -1.0] {
                // Hardly back, and to a smaller amplitude first: where nodes only just stick they do so no more.
                let amplitude = -sense * length;
                let factor = 1.0 + amplitude / place[1];
                let value = here.value - 0.1 * length * along.signum() * scales[0]; // Back by a tenth of what it goes off.
                let guess = self.corrector.scaled(&here, factor, value)?;
                let goal = Goal::Length { from: place, tangent: [0.0, -sense], length };
                self.corrector.forget();
                let Ok(next) = self.corrector.correct(&here, guess, &goal) else { continue };
                let to = next.place(scales);
                let (direction, distance) = way(place, to);
                let is_other = self.off_branch(to) > 0.2 * length;
                if direction[0] * along < 0.0 && distance < FAR * length && is_other {
                    self.points[at].is_fold = true;
                    (self.tangent, self.length) = (direction, distance);
                    self.points.push(next);
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Difference of the amplitude of a place from that of the points so far at the same value.
    fn off_branch(&self, place: Place) -> f64 {
        let scales = self.corrector.scales;
        let places: Vec<Place> = self.points.iter().map(|own| own.place(scales)).collect();
        let around = places.windows(2).filter(|pair| {
            let [from, to] = [pair[0][0] - place[0], pair[1][0] - place[0]];
            from * to <= 0.0 && from != to
        });
        let differences = around.map(|pair| {
            let share = (place[0] - pair[0][0]) / (pair[1][0] - pair[0][0]);
            (place[1] - pair[0][1] - share * (pair[1][1] - pair[0][1])).abs() // |A - A_branch(value)|, linear between two points.
        });
        differences.fold(f64::INFINITY, f64::min)
    }

    /// Where the last three points turn back, the extreme value between them is sought over the amplitude, and becomes a point.
    pub(super) fn refine_fold(&mut self) {
        let count = self.points.len();
        if count < 3 {
            return;
        }
        let scales = self.corrector.scales;
        let mut three: Vec<Point> = self.points[count - 3..].to_vec();
        let place = |point: &Point| point.place(scales);
        let values: Vec<f64> = three.iter().map(|point| place(point)[0]).collect();
        let sense = (values[1] - values[0]).signum();
        if (values[2] - values[1]) * sense >= 0.0 || self.points[count - 2].is_fold {
            return;
        }
        // By rising amplitude; a branch that turns back in both is left as it is.
        let middle = place(&three[1])[1];
        if (place(&three[0])[1] - middle) * (place(&three[2])[1] - middle) >= 0.0 {
            self.points[count - 2].is_fold = true;
            return;
        }
        if place(&three[0])[1] > middle {
            three.reverse();
        }
        for turn in 0..REFINED {
            let places: Vec<Place> = three.iter().map(place).collect();
            let Some(amplitude) = extreme(&places, turn) else { break };
            let Some(next) = self.at_amplitude(&three, amplitude) else { break };
            let gain = (place(&next)[0] - places[1][0]) * sense;
            let is_above = amplitude > places[1][1];
            let own = if gain > 0.0 { std::mem::replace(&mut three[1], next) } else { next };
            three[if (gain > 0.0) == is_above { 0 } else { 2 }] = own; // An old extreme is the end behind.
            let widths = [0, 2].map(|i| (place(&three[i])[0] - place(&three[1])[0]).abs());
            if widths[0].max(widths[1]) < FOLDED || gain.abs() < 0.01 * FOLDED {
                break;
            }
        }
        self.insert_fold(three.swap_remove(1), count);
    }

    /// The point of the fold, between the last three.
    fn insert_fold(&mut self, fold: Point, count: usize) {
        let scales = self.corrector.scales;
        let amplitudes = [count - 3, count - 2].map(|i| self.points[i].place(scales)[1]);
        let own = fold.place(scales)[1];
        let is_known = own == amplitudes[1];
        let is_before = (own - amplitudes[0]) * (own - amplitudes[1]) < 0.0;
        let at = if is_known || is_before { count - 2 } else { count - 1 };
        if !is_known {
            self.points.insert(at, fold);
        }
        self.points[at].is_fold = true;
    }

    /// The motion of an amplitude, over its scale, between three that lie around it.
    fn at_amplitude(&mut self, three: &[Point], amplitude: f64) -> Option<Point> {
        let scales = self.corrector.scales;
        let places: Vec<f64> = three.iter().map(|point| point.place(scales)[1]).collect();
        let from = usize::from(amplitude > places[1]);
        let share = (amplitude - places[from]) / (places[from + 1] - places[from]); // On the chord of the two around it.
        let guess = three[from].towards(&three[from + 1], share);
        let goal = Goal::Length { from: [0.0, 0.0], tangent: [0.0, 1.0], length: amplitude };
        self.corrector.correct(&three[1], guess, &goal).ok()
    }
}

/// The amplitude at which three places, by rising amplitude, have their extreme parameter: the vertex of the parabola through
/// them, every third time a place well within the longer side, since a branch may have a corner where nodes begin to stick.
fn extreme(places: &[Place], turn: usize) -> Option<f64> {
    let [a, b, c] = [places[0], places[1], places[2]];
    let [low, high] = [b[1] - a[1], c[1] - b[1]];
    let [left, right] = [(b[0] - a[0]) / low, (c[0] - b[0]) / high];
    let longer = if low > high { b[1] - 0.4 * low } else { b[1] + 0.4 * high };
    if !longer.is_finite() || low.max(high) < 1e-7 {
        return None;
    }
    let vertex = b[1] + (left * high + right * low) / (2.0 * (left - right)); // b - p'(b) / p'' by divided differences.
    let margin = 0.02 * low.min(high);
    let is_useful =
        vertex > a[1] + margin && vertex < c[1] - margin && (vertex - b[1]).abs() > 1e-3 * margin;
    Some(if turn % 3 == 2 || !is_useful { longer } else { vertex })
}

#[cfg(test)]
mod tests {
    use super::extreme;

    #[test]
    fn the_vertex_of_a_parabola_is_where_its_parameter_is_extreme() {
        let at = |amplitude: f64| [2.0 - 3.0 * (amplitude - 0.7_f64).powi(2), amplitude];
        let found = extreme(&[at(0.1), at(0.5), at(1.3)], 0).unwrap();
        assert!((found - 0.7).abs() < 1e-12, "{found}");
    }
}
