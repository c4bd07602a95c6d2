//! Roots between two places.

/// Least share of the width that the longer end of a bracket gives up.
const LEAST_SHARE: f64 = 1e-3;

/// Two places with values of unlike sign of one function.
///
/// Narrowed by false position with the Illinois rule: an end that stays twice counts half. As functions may have kinks or values far apart
/// in size, every third step halves the width. Source: M. Dowell, P. Jarratt, A modified regula falsi method for computing the root of an
/// equation, BIT 11 (1971).
#[derive(Clone, Copy, Debug)]
pub struct Bracket {
    ends: [(f64, f64); 2],
    /// Whether values are positive at the second place.
    rises: bool,
    /// Which end moved last.
    last: Option<usize>,
    steps: usize,
}

impl Bracket {
    /// That of two places with their values, in any order.
    pub fn new(ends: [(f64, f64); 2]) -> Self {
        Self { ends, rises: ends[1].1 > 0.0, last: None, steps: 0 }
    }

    /// Distance of the places.
    pub fn width(&self) -> f64 {
        (self.ends[1].0 - self.ends[0].0).abs()
    }

    /// The place amid them.
    pub fn middle(&self) -> f64 {
        0.5 * (self.ends[0].0 + self.ends[1].0)
    }

    /// Moves one end to another place, which is returned with its value.
    ///
    /// # Errors
    /// Those of the function.
    pub fn narrow<E>(
        &mut self,
        value_at: impl FnOnce(f64) -> Result<f64, E>,
    ) -> Result<(f64, f64), E> {
        self.steps += 1;
        let [(first, before), (second, after)] = self.ends;
        let share = before / (before - after); // The root of the straight line between the ends.
        let share = match share.is_finite() && !self.steps.is_multiple_of(3) {
            true => share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE),
            false => 0.5,
        };
        let place = first + share * (second - first);
        let value = value_at(place)?;
        let moved = usize::from((value > 0.0) == self.rises); // The end with a value of the same sign moves.
        self.ends[moved] = (place, value);
        if self.last.replace(moved) == Some(moved) {
            self.ends[1 - moved].1 *= 0.5; // The Illinois rule.
        }
        Ok((place, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: straight lines, kinks and roots of high order, from either side.
    #[test]
    fn roots_are_found_from_either_side_whatever_the_function() {
        let functions: [(&dyn Fn(f64) -> f64, f64); 4] = [
            (&|x| 3.0 * x - 1.0, 1.0 / 3.0),
            (&|x| (x - 0.7).powi(5), 0.7),
            (&|x| if x < 0.2 { -1e-9 } else { 1e9 * (x - 0.2) }, 0.2),
            (&|x| 1.0 - x.exp() / 2.0, 2.0_f64.ln()),
        ];
        for (value, exact) in functions {
            for [from, to] in [[0.0, 1.0], [1.0, 0.0]] {
                let mut bracket = Bracket::new([(from, value(from)), (to, value(to))]);
                for _ in 0..150 {
                    bracket.narrow(|x| Ok::<_, ()>(value(x))).unwrap();
                }
                assert!((bracket.middle() - exact).abs() < 1e-12, "{exact}: {bracket:?}");
            }
        }
    }
}
