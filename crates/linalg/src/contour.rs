//! Zeros of an analytic function inside a rectangle, counted by the argument principle.

use crate::c64;
use std::f64::consts::{PI, TAU};

/// Steps in the shortest piece of the edge: a zero this near lies on it.
const SHORTEST: f64 = 20.0;
/// Difference of the logarithm of the function and of what its slopes predict that is none.
const AGREEMENT: f64 = 0.25;
/// Pieces of the edge beyond which the count is given up.
const MOST_PIECES: usize = 600;

/// Zeros less poles inside a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeroCount {
    /// How many.
    pub count: i64,
    /// The sum of their places.
    pub sum: c64,
}

/// Why zeros could not be counted.
#[derive(Clone, Debug, PartialEq)]
pub enum Uncounted<E> {
    /// One lies on the edge, or so near to this point of it that they are not told apart.
    OnEdge(c64),
    /// The function has no value.
    Failed(E),
}

impl<E> From<E> for Uncounted<E> {
    fn from(error: E) -> Self {
        Self::Failed(error)
    }
}

/// The winding number of `f` about a polygon with these corners, counter-clockwise, and its first moment,
///
/// ```text
/// N = 1 / (2 pi i) int f' / f dz,    sum of the zeros less that of the poles = 1 / (2 pi i) int z f' / f dz.
/// ```
///
/// `ln` gives `ln f` at several points, up to multiples of `2 pi i`; `step` is the distance of the two from which a slope is taken.
/// Where `f` has no zero nearby, few points on the edge serve. Source: L. V. Ahlfors, Complex Analysis (1979), section 4.5.2.
///
/// # Errors
/// [`Uncounted`].
pub fn count_zeros<E>(
    corners: &[c64],
    step: &dyn Fn(c64) -> f64,
    ln: &mut dyn FnMut(Vec<c64>) -> Result<Vec<c64>, E>,
) -> Result<ZeroCount, Uncounted<E>> {
    let mut samples = |points: &[c64]| samples(points, step, ln);
    let n = corners.len(); // Its sides to begin with, each with its middle.
    let middles: Vec<c64> = (0..n).map(|i| 0.5 * (corners[i] + corners[(i + 1) % n])).collect();
    let ends = samples(&[corners, &middles].concat())?;
    let mut open: Vec<[Sample; 3]> =
        (0..n).map(|i| [ends[i], ends[n + i], ends[(i + 1) % n]]).collect();
    let (mut sums, mut pieces) = ([c64::ZERO; 2], open.len());
    while !open.is_empty() {
        let mut rough = Vec::new();
        for piece in open {
            match integral(&piece) {
                Some(own) => sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += own),
                None => rough.push(piece),
            }
        }

        // Halves of the rest, all new points at once: until the phase of each half is that which the slopes predict.
        pieces += rough.len();
        for piece in &rough {
            let [from, middle, to] = piece.map(|sample| sample.at);
            if pieces > MOST_PIECES || (to - from).norm() < SHORTEST * step(middle) {
                return Err(Uncounted::OnEdge(middle));
            }
        }
        let quarters = rough.iter().flat_map(|piece| {
            let at = piece.map(|sample| sample.at);
            [0.5 * (at[0] + at[1]), 0.5 * (at[1] + at[2])]
        });
        let new = samples(&quarters.collect::<Vec<c64>>())?;
        let halves = rough.iter().zip(new.chunks(2));
        open = halves
            .flat_map(|(piece, new)| {
                let [from, middle, to] = *piece;
                [[from, new[0], middle], [middle, new[1], to]]
            })
            .collect();
    }
    // Of an integral over 2 pi i.
    let [winding, sum] = sums.map(|sum| c64::new(sum.im, -sum.re) / TAU);
    Ok(ZeroCount { count: winding.re.round() as i64, sum })
}

/// `ln f` at a point of the edge, its imaginary part up to multiples of `2 pi`, and its slope.
#[derive(Clone, Copy)]
struct Sample {
    at: c64,
    ln: c64,
    slope: c64,
}

/// `ln f` half a step to either side of each point, their mean and their slope.
fn samples<E>(
    points: &[c64],
    step: &dyn Fn(c64) -> f64,
    ln: &mut dyn FnMut(Vec<c64>) -> Result<Vec<c64>, E>,
) -> Result<Vec<Sample>, E> {
    let sides = points.iter().flat_map(|&at| {
        let half = 0.5 * step(at);
        [at - half, at + half]
    });
    let found = ln(sides.collect())?;
    let pairs = points.iter().zip(found.chunks(2));
    let sample = |(&at, ends): (&c64, &[c64])| {
        let change = least(ends[1] - ends[0]); // (ln f)' = f' / f, with steps too short for a full turn.
        Sample { at, ln: ends[0] + 0.5 * change, slope: change / step(at) }
    };
    Ok(pairs.map(sample).collect())
}

/// A difference of logarithms without full turns.
fn least(change: c64) -> c64 {
    c64::new(change.re, (change.im + PI).rem_euclid(TAU) - PI)
}

/// `int d ln f` and `int lambda d ln f` over a piece of the edge with its middle; `None` where slopes and phases disagree.
///
/// With `d` the whole length, the parabola through the slopes predicts `d (5 s_0 + 8 s_1 - s_2) / 24` of the first half; the phases then
/// say which full turns it lacks, and by how much it errs. The moment is integrated by parts.
fn integral(piece: &[Sample; 3]) -> Option<[c64; 2]> {
    let [from, middle, to] = piece;
    let whole = to.at - from.at;
    let mut sums = [c64::ZERO; 2];
    let halves = [([from, middle, to], [5.0, 8.0, -1.0]), ([middle, to, from], [8.0, 5.0, -1.0])];
    for ([near, far, other], weights) in halves {
        let slopes = near.slope * weights[0] + far.slope * weights[1] + other.slope * weights[2];
        let predicted = whole * slopes / 24.0; // int (ln f)' over the half.
        let error = least(far.ln - near.ln - predicted);
        if error.norm().is_nan() || error.norm() > AGREEMENT {
            return None;
        }
        let change = predicted + error;
        let length = far.at - near.at; // int z d ln f = [z ln f] - int ln f dz, trapezoid with end correction.
        sums[0] += change;
        sums[1] +=
            0.5 * (near.at + far.at) * change - length * length * (near.slope - far.slope) / 12.0;
    }
    Some(sums)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Exact: of a rational function the zeros less the poles within a rectangle and the sum of their places; one on the edge is told.
    #[test]
    fn zeros_and_poles_of_a_rational_function_are_counted() {
        let zeros =
            [c64::new(0.1, 2.0), c64::new(-0.2, 3.0), c64::new(-0.2, 3.01), c64::new(0.0, 9.0)];
        let pole = c64::new(0.3, 1.5);
        let count = |half_width: f64| {
            let corners =
                [(-half_width, 1.0), (half_width, 1.0), (half_width, 5.0), (-half_width, 5.0)]
                    .map(|(re, im)| c64::new(re, im));
            count_zeros(&corners, &|_| 1e-4, &mut |points| {
                let ln =
                    |z: c64| zeros.iter().map(|own| (z - own).ln()).sum::<c64>() - (z - pole).ln();
                Ok::<_, Infallible>(points.into_iter().map(ln).collect())
            })
        };
        let found = count(1.0).unwrap();
        assert_eq!(found.count, 2);
        let sum = zeros[..3].iter().sum::<c64>() - pole;
        assert!((found.sum - sum).norm() < 0.05, "{}", found.sum);
        let Err(Uncounted::OnEdge(at)) = count(0.2) else {
            panic!("two zeros lie on the edge");
        };
        assert!((at - zeros[1]).norm() < 0.1, "{at}");
    }
}
