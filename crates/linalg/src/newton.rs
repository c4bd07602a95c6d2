//! Roots of several functions that lean on each other.

use super::DenseLu;
use faer::Mat;

/// Steps at most, of which halves are tried down to a least share.
const MOST_STEPS: usize = 60;
const LEAST_SHARE: f64 = 1e-4;
/// Step of a place for slopes, relative to it at first, and the change of a value that it may make.
const SMALL_STEP: f64 = 1e-4;
const LITTLE: f64 = 0.1;

/// Places near positive ones at which as many functions, of size 1 away from their roots, vanish to `tolerance`, or as nearly as they can.
///
/// Newton's method with slopes from differences, as short as keeps within one piece of functions with kinks, and as much of each step as
/// comes nearer. Below `rounding` a step that does not halve what is left is the last.
///
/// # Errors
/// Those of the functions.
pub fn newton_root<E>(
    mut places: Vec<f64>,
    [tolerance, rounding]: [f64; 2],
    mut values_at: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<Vec<f64>, E> {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, own| m.max(own.abs()));
    let count = places.len();
    let mut steps: Vec<f64> = places.iter().map(|place| SMALL_STEP * place).collect();
    let mut values = values_at(&places)?;
    for _ in 0..MOST_STEPS {
        let left = largest(&values);
        if left <= tolerance {
            break;
        }
        // Slopes, by steps that serve the next ones too.
        let mut slopes = Mat::zeros(count, count);
        for (j, step) in steps.iter_mut().enumerate() {
            let mut reach = f64::INFINITY;
            while reach > LITTLE {
                let mut moved = places.clone();
                moved[j] += *step;
                let beside = values_at(&moved)?;
                let changes: Vec<f64> = beside.iter().zip(&values).map(|(b, v)| b - v).collect();
                (0..count).for_each(|i| slopes[(i, j)] = changes[i] / *step);
                reach = largest(&changes);
                *step *= (LITTLE / (2.0 * reach)).min(1.0); // Half of LITTLE the next time.
            }
        }
        let mut change = Mat::from_fn(count, 1, |i, _| values[i]); // S dx = f: the step of Newton's method.
        DenseLu::factorize(slopes).solve_in_place(change.as_mut());
        if !change.norm_max().is_finite() {
            break;
        }
        // As much of the step as comes nearer.
        let is_near = left <= rounding;
        let [goal, least] = if is_near { [0.5 * left, 1.0] } else { [left, LEAST_SHARE] };
        let mut share = 1.0;
        let (next, found) = loop {
            let next: Vec<f64> = (0..count).map(|i| places[i] - share * change[(i, 0)]).collect();
            let found = values_at(&next)?;
            if largest(&found) < goal {
                break (next, found);
            }
            share *= 0.5;
            if share < least {
                return Ok(places);
            }
        };
        (places, values) = (next, found);
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: a stiff beam on a soft spring over two contacts that cannot pull, from a place where one is open.
    #[test]
    fn contacts_under_one_stiff_beam_each_get_their_force() {
        let (soft, stiff) = (1.0, 1e6);
        // Each contact gives way by its force, all of them the spring by their sum.
        let forces = |places: &[f64]| -> Vec<f64> {
            let mut rise = 0.0;
            for _ in 0..200 {
                let pressed = places.iter().filter(|place| **place > rise);
                let (sum, count) = pressed.fold((0.0, 0.0), |(s, c), place| (s + place, c + 1.0));
                rise = stiff * sum / (soft + stiff * count);
            }
            places.iter().map(|place| stiff * (place - rise).max(0.0)).collect()
        };
        let wanted = [2.0, 3.0];
        let values = |places: &[f64]| {
            let both = forces(places).into_iter().zip(wanted);
            Ok::<Vec<f64>, ()>(both.map(|(force, wanted)| force / wanted - 1.0).collect())
        };
        let found = newton_root(vec![5.0, 5.0], [1e-12, 1e-4], values).unwrap();
        for (place, wanted) in found.iter().zip(wanted) {
            // Rounding of a place, as a force on the stiff contact, over the soft spring.
            let rounding = 8.0 * 5.0 * f64::EPSILON * stiff / soft;
            assert!((place - (5.0 + wanted / stiff)).abs() < rounding, "{found:?}");
        }
    }

    #[test]
    fn functions_without_a_root_end_at_the_nearest_place() {
        let found = newton_root(vec![3.0], [1e-12, 1e-4], |x| Ok::<_, ()>(vec![1.0 + x[0] * x[0]]));
        assert!(found.unwrap()[0].abs() < 0.1);
    }
}
